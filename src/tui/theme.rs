//! Colours: one per quantity, the same in every panel.
//!
//! Explanatory text (titles, ticks, names, keys) has the terminal's default foreground: one of the
//! bright colours may be the background, as "bright black" is in Solarized. Rules and frames are
//! dim. Quantities have the colours of M. Okabe and K. Ito (2008), which people with any kind of
//! colour vision tell apart, some darker on a light background; a terminal of 256 colours gets the
//! nearest of its cube, one of sixteen the plain colours, which its user has chosen.

use ratatui::style::{Color, Modifier, Style};

use crate::plot::Marker;
use crate::plot::units::to_ascii;

/// Quantities and parts of the screen that have a style of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The unworn profile, and past states.
    Unworn,
    /// A curve of another source.
    Ghost,
    /// Closed forms.
    Limit,
    /// The worn profile f.
    Profile,
    /// The 1D profile g.
    Profile1d,
    /// Pressure p and normal loads.
    Pressure,
    /// Shear stress τ and tangential loads.
    Shear,
    /// The contact radius a.
    Contact,
    /// The stick zone and its radius c.
    Stick,
    /// The slip zone.
    Slip,
    /// What is not in contact.
    Open,
    /// Axes, labels, explanations: the terminal's own foreground.
    Quiet,
    /// Rules and frames, which may vanish without loss.
    Faint,
    /// Titles.
    Title,
    /// The title of the focused panel, the selected line.
    Focus,
    /// The status bar.
    Bar,
    /// A notice for the user.
    Notice,
    /// An error.
    Alarm,
}

/// Which colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// For a dark background.
    Dark,
    /// For a light background.
    Light,
    /// No colours at all: bold, dim and reversed.
    Mono,
}

impl Look {
    /// All themes, in the order in which a key cycles through them.
    pub const ALL: [Self; 3] = [Self::Dark, Self::Light, Self::Mono];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dark => "dark",
            Self::Light => "light",
            Self::Mono => "mono",
        }
    }

    /// The look after this one.
    pub fn next(self) -> Self {
        match self {
            Self::Dark => Self::Light,
            Self::Light => Self::Mono,
            Self::Mono => Self::Dark,
        }
    }
}

/// How many colours the terminal has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// The sixteen that its user has chosen.
    Sixteen,
    /// The cube of 256.
    Indexed,
    /// All.
    True,
}

impl Depth {
    /// Reads the variables COLORTERM and TERM.
    pub fn of(colorterm: &str, term: &str) -> Self {
        if matches!(colorterm, "truecolor" | "24bit") || term.ends_with("-direct") {
            Self::True
        } else if term.contains("256color") {
            Self::Indexed
        } else {
            Self::Sixteen
        }
    }
}

/// The look in this terminal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Theme {
    /// Which colours.
    pub look: Look,
    /// How many of them.
    pub depth: Depth,
    /// How curves are drawn.
    pub marker: Marker,
}

/// A colour of the palette: red, green, blue.
type Rgb = [u8; 3];

/// The palette after Okabe and Ito, for a dark and for a light background. On white their yellow and
/// their sky blue are too pale for a line; their orange and purple are darkened.
const ORANGE: [Rgb; 2] = [[0xe6, 0x9f, 0x00], [0xa8, 0x66, 0x00]];
const SKY: [Rgb; 2] = [[0x56, 0xb4, 0xe9], [0x00, 0x72, 0xb2]];
const GREEN: [Rgb; 2] = [[0x00, 0xb8, 0x86], [0x00, 0x80, 0x5c]];
const VERMILLION: [Rgb; 2] = [[0xf0, 0x6a, 0x1e], [0xd0, 0x4e, 0x00]];
const PURPLE: [Rgb; 2] = [[0xcc, 0x79, 0xa7], [0xa8, 0x49, 0x7f]];
const YELLOW: [Rgb; 2] = [[0xf0, 0xe4, 0x42], [0x6a, 0x51, 0xa3]];

impl Theme {
    /// A look in the sixteen colours that every terminal has, and what curves are made of.
    pub fn new(look: Look, marker: Marker) -> Self {
        Self {
            look,
            depth: Depth::Sixteen,
            marker,
        }
    }

    /// The same in as many colours as the terminal has.
    #[must_use]
    pub fn with_depth(self, depth: Depth) -> Self {
        Self { depth, ..self }
    }

    /// Whether colours tell things apart.
    pub fn colored(&self) -> bool {
        self.look != Look::Mono
    }

    /// Whether text must stay within ASCII.
    pub fn ascii(&self) -> bool {
        self.marker == Marker::Ascii
    }

    /// A text from outside as this terminal can show it: no control characters, and ASCII where it
    /// must be.
    pub fn printable(&self, text: &str) -> String {
        let text = text.replace(char::is_control, " ");
        match self.ascii() {
            true => to_ascii(&text).into_owned(),
            false => text,
        }
    }

    /// The style of a role.
    pub fn style(&self, role: Role) -> Style {
        let plain = Style::new();
        // Only plain colours of the sixteen: in some palettes the bright ones are greys.
        let with = |palette: [Rgb; 2], dark: Color, light: Color| match (self.look, self.depth) {
            (Look::Mono, _) => plain,
            (Look::Dark, Depth::Sixteen) => plain.fg(dark),
            (Look::Light, Depth::Sixteen) => plain.fg(light),
            (look, depth) => {
                let rgb = palette[usize::from(look == Look::Light)];
                plain.fg(match depth {
                    Depth::True => Color::Rgb(rgb[0], rgb[1], rgb[2]),
                    _ => Color::Indexed(nearest_in_cube(rgb)),
                })
            }
        };
        match role {
            Role::Unworn | Role::Ghost | Role::Quiet => plain,
            Role::Open | Role::Faint => plain.add_modifier(Modifier::DIM),
            Role::Limit => with(YELLOW, Color::Blue, Color::Cyan),
            Role::Profile | Role::Profile1d => with(ORANGE, Color::Yellow, Color::Blue),
            Role::Pressure | Role::Contact => with(SKY, Color::Cyan, Color::Magenta),
            Role::Shear => with(PURPLE, Color::Magenta, Color::Red),
            Role::Stick => with(GREEN, Color::Green, Color::Green),
            Role::Slip => with(VERMILLION, Color::Red, Color::Red),
            Role::Title => plain.add_modifier(Modifier::BOLD),
            Role::Focus | Role::Bar => plain.add_modifier(Modifier::REVERSED),
            Role::Notice => with(ORANGE, Color::Yellow, Color::Blue).add_modifier(Modifier::BOLD),
            Role::Alarm => with(VERMILLION, Color::Red, Color::Red).add_modifier(Modifier::BOLD),
        }
    }
}

/// The nearest colour of the 6×6×6 cube of a terminal of 256 colours.
fn nearest_in_cube(rgb: Rgb) -> u8 {
    const LEVELS: [i32; 6] = [0, 95, 135, 175, 215, 255];
    let level = |value: u8| {
        let distance = |&at: &usize| (LEVELS[at] - i32::from(value)).abs();
        (0..LEVELS.len()).min_by_key(distance).unwrap_or(0) as u8
    };
    16 + 36 * level(rgb[0]) + 6 * level(rgb[1]) + level(rgb[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEPTHS: [Depth; 3] = [Depth::Sixteen, Depth::Indexed, Depth::True];

    #[test]
    fn no_two_curves_of_a_plot_share_a_colour() {
        use Role::{Contact, Limit, Pressure, Profile, Profile1d, Shear, Slip, Stick, Unworn};
        for (look, depth) in [Look::Dark, Look::Light]
            .into_iter()
            .flat_map(|look| DEPTHS.map(|depth| (look, depth)))
        {
            let theme = Theme::new(look, Marker::Braille).with_depth(depth);
            for plot in [
                &[Unworn, Profile, Limit, Contact, Stick, Slip][..],
                &[Pressure, Shear, Limit, Unworn, Stick],
                &[Profile1d, Contact, Stick],
                &[Profile, Shear],
            ] {
                let mut colors: Vec<_> = plot.iter().map(|role| theme.style(*role).fg).collect();
                let count = colors.len();
                colors.sort_by_key(|color| format!("{color:?}"));
                colors.dedup();
                assert_eq!(colors.len(), count, "{look:?} {depth:?} {plot:?}");
            }
        }
    }

    #[test]
    fn mono_has_no_colour() {
        for depth in DEPTHS {
            let theme = Theme::new(Look::Mono, Marker::Braille).with_depth(depth);
            for role in [Role::Profile, Role::Alarm, Role::Quiet, Role::Notice] {
                assert_eq!(theme.style(role).fg, None);
            }
        }
    }

    /// In Solarized the bright colours are the background and greys near it.
    #[test]
    fn what_explains_has_the_foreground_and_no_colour_is_a_bright_one() {
        use Color::{Blue, Cyan, Green, Magenta, Red, Yellow};
        use Role::{Alarm, Contact, Limit, Notice, Open, Pressure, Profile, Profile1d, Quiet};
        use Role::{Shear, Slip, Stick, Title, Unworn};
        for look in [Look::Dark, Look::Light] {
            let theme = Theme::new(look, Marker::Braille);
            for role in [Quiet, Title, Unworn] {
                let style = theme.style(role);
                assert_eq!(style.fg, None, "{role:?}");
                assert!(!style.add_modifier.contains(Modifier::DIM), "{role:?}");
            }
            for role in [
                Limit, Profile, Profile1d, Pressure, Contact, Shear, Stick, Slip, Open, Notice,
                Alarm,
            ] {
                if let Some(color) = theme.style(role).fg {
                    let plain = [Red, Green, Yellow, Blue, Magenta, Cyan];
                    assert!(plain.contains(&color), "{role:?} {color:?}");
                }
            }
            // Pale on white.
            let pale = [Some(Color::Yellow), Some(Color::White)];
            assert!(look == Look::Dark || !pale.contains(&theme.style(Profile).fg));
        }
    }

    /// WCAG's contrast of a line: 3 against each background that a theme is for.
    #[test]
    fn colours_stand_out_on_their_backgrounds() {
        let linear = |value: u8| {
            let share = f64::from(value) / 255.0;
            if share <= 0.04045 {
                share / 12.92
            } else {
                ((share + 0.055) / 1.055).powf(2.4)
            }
        };
        let luminance =
            |[r, g, b]: Rgb| 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
        let contrast = |a: Rgb, b: Rgb| {
            let (a, b) = (luminance(a), luminance(b));
            (a.max(b) + 0.05) / (a.min(b) + 0.05)
        };
        for palette in [ORANGE, SKY, GREEN, VERMILLION, PURPLE, YELLOW] {
            // Black and Solarized's dark background; white and Solarized's light one.
            for (at, grounds) in [
                (0, [[0, 0, 0], [0x00, 0x2b, 0x36]]),
                (1, [[0xff; 3], [0xfd, 0xf6, 0xe3]]),
            ] {
                for ground in grounds {
                    let found = contrast(palette[at], ground);
                    assert!(found >= 3.0, "{:?} on {ground:?}: {found:.2}", palette[at]);
                }
            }
        }
    }

    #[test]
    fn the_terminal_says_how_many_colours_it_has() {
        for (colorterm, term, depth) in [
            ("", "xterm", Depth::Sixteen),
            ("", "linux", Depth::Sixteen),
            ("", "tmux-256color", Depth::Indexed),
            ("truecolor", "xterm-256color", Depth::True),
            ("24bit", "xterm", Depth::True),
        ] {
            assert_eq!(Depth::of(colorterm, term), depth, "{colorterm} {term}");
        }
        assert_eq!(nearest_in_cube([0xe6, 0x9f, 0x00]), 178);
        assert_eq!(nearest_in_cube([0, 0, 0]), 16);
    }
}
