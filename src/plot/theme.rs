//! Colours: one per quantity, the same in every panel.
//!
//! Explanatory text (titles, ticks, names, keys) has the terminal's default foreground, because one of the bright
//! colours may be the background, as "bright black" is in Solarized. Rules and frames are dim. Quantities have the
//! colours of M. Okabe and K. Ito (2008), which people with any kind of colour vision can tell apart; some are darker
//! on a light background. They are rounded to the cube of every 256-colour terminal, whose codes are half as long on
//! the wire as red, green and blue. A terminal of sixteen colours gets the plain ones, as its user has chosen them.

use clap::ValueEnum;
use ratatui::style::{Color, Modifier, Style};

use super::Marker;
use super::units::to_ascii;
use crate::math::scan::shifted;
use crate::reading::Zone;

/// Quantities and parts of the screen with a style. The same quantity has the same colour in every chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Role {
    /// The unworn profile, and past states.
    Unworn,
    /// One of several curves of other sources.
    Ghost(usize),
    /// One of several states or methods.
    Series(usize),
    /// One of several borders on a map.
    Border(usize),
    /// Closed forms.
    Limit,
    /// The worn profile f, and its 1D image g.
    Profile,
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
    /// Anything that is not in contact.
    Open,
    /// Axes, labels, explanations: the terminal's own foreground.
    #[default]
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

/// Returns the role that colours a zone, and the letter that replaces it without colours.
pub fn look_of(zone: Zone) -> (Role, char) {
    match zone {
        Zone::Stick => (Role::Stick, 's'),
        Zone::Slip => (Role::Slip, '~'),
        Zone::Open => (Role::Open, '.'),
    }
}

/// The choice of colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, strum::Display, serde::Deserialize)]
#[strum(serialize_all = "lowercase")]
#[serde(rename_all = "lowercase")]
pub enum Look {
    /// For a dark background.
    Dark,
    /// For a light background.
    Light,
    /// No colours: bold, dim and reversed only.
    Mono,
}

impl Look {
    /// Returns the look for a background of this red, green and blue.
    pub fn for_background(background: [u8; 3]) -> Self {
        // At a luminance of 0.18, black and white text have the same contrast.
        if luminance(background) > 0.18 {
            Self::Light
        } else {
            Self::Dark
        }
    }

    /// Returns the next look.
    pub fn next(self) -> Self {
        shifted(Self::value_variants(), self, 1)
    }
}

/// Returns the relative luminance of an sRGB colour, 0 to 1.
fn luminance(color: [u8; 3]) -> f64 {
    let [red, green, blue] = color.map(|value| match f64::from(value) / 255.0 {
        share if share <= 0.04045 => share / 12.92,
        share => ((share + 0.055) / 1.055).powf(2.4),
    });
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// How many colours the terminal has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// The sixteen that its user has chosen.
    Sixteen,
    /// The cube of 256.
    Indexed,
    /// All of red, green and blue: the shades of maps and stresses flow into each other.
    True,
}

impl Depth {
    /// Determines the number of colours from COLORTERM and TERM.
    pub fn detect(colorterm: &str, term: &str) -> Self {
        let is_true = matches!(colorterm, "truecolor" | "24bit") || term.ends_with("-direct");
        if is_true {
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
    /// The choice of colours.
    pub look: Look,
    /// How many of them.
    pub depth: Depth,
    /// How curves are drawn.
    pub marker: Marker,
    /// Whether no look was chosen, so that it follows the background that the terminal reports.
    pub follows_background: bool,
}

/// A colour of the cube of 256, for a dark and for a light background.
pub type Pair = [u8; 2];

/// The palette of Okabe and Ito. On white, their yellow and sky blue are too pale for a line; their orange and purple
/// are darkened.
const ORANGE: Pair = [178, 130];
const SKY: Pair = [74, 25];
const GREEN: Pair = [36, 29];
const VERMILLION: Pair = [202, 166];
const PURPLE: Pair = [175, 132];
const YELLOW: Pair = [227, 97];

impl Theme {
    /// A look in the sixteen colours that every terminal has, and what curves are made of.
    pub fn new(look: Look, marker: Marker) -> Self {
        Self {
            look,
            depth: Depth::Sixteen,
            marker,
            follows_background: false,
        }
    }

    /// The same theme with as many colours as the terminal has.
    #[must_use]
    pub fn with_depth(self, depth: Depth) -> Self {
        Self { depth, ..self }
    }

    /// Adapts the look to the background that the terminal has reported, unless a look was chosen.
    pub fn follow(&mut self, background: [u8; 3]) {
        if self.follows_background {
            self.look = Look::for_background(background);
        }
    }

    /// Whether colours distinguish things.
    pub fn colored(&self) -> bool {
        self.look != Look::Mono
    }

    /// Whether text must stay within ASCII.
    pub fn ascii(&self) -> bool {
        self.marker == Marker::Ascii
    }

    /// Returns a text as this terminal can show it: without control characters, and in ASCII if necessary.
    pub fn printable(&self, text: &str) -> String {
        let text = text.replace(char::is_control, " ");
        if self.ascii() {
            to_ascii(&text).into_owned()
        } else {
            text
        }
    }

    /// Returns a colour of the 256-colour cube for the terminal's background; `None` if there are only sixteen.
    pub fn indexed(&self, [dark, light]: Pair) -> Option<Color> {
        let number = if self.look == Look::Light {
            light
        } else {
            dark
        };
        (self.depth != Depth::Sixteen).then_some(Color::Indexed(number))
    }

    /// Returns the style of a role.
    pub fn style(&self, role: Role) -> Style {
        let plain = Style::new();
        // Uses only plain colours of the sixteen: in some palettes the bright ones are greys.
        let with = |pair: Pair, dark: Color, light: Color| match self.look {
            Look::Mono => plain,
            Look::Dark => plain.fg(self.indexed(pair).unwrap_or(dark)),
            Look::Light => plain.fg(self.indexed(pair).unwrap_or(light)),
        };
        match role {
            Role::Unworn | Role::Quiet => plain,
            Role::Ghost(_) | Role::Series(_) | Role::Border(_) => plain,
            Role::Open | Role::Faint => plain.add_modifier(Modifier::DIM),
            Role::Limit => with(YELLOW, Color::Blue, Color::Cyan),
            Role::Profile => with(ORANGE, Color::Yellow, Color::Blue),
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

#[cfg(test)]
mod tests {
    use super::*;

    const DEPTHS: [Depth; 3] = [Depth::Sixteen, Depth::Indexed, Depth::True];

    #[test]
    fn no_two_curves_of_a_plot_share_a_colour() {
        use Role::{Contact, Limit, Pressure, Profile, Shear, Slip, Stick, Unworn};
        for (look, depth) in [Look::Dark, Look::Light]
            .into_iter()
            .flat_map(|look| DEPTHS.map(|depth| (look, depth)))
        {
            let theme = Theme::new(look, Marker::Braille).with_depth(depth);
            for plot in [
                &[Unworn, Profile, Limit, Contact, Stick, Slip][..],
                &[Pressure, Shear, Limit, Unworn, Stick],
                &[Profile, Contact, Stick],
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
        use Role::{Alarm, Contact, Limit, Notice, Open, Pressure, Profile, Quiet};
        use Role::{Shear, Slip, Stick, Title, Unworn};
        for look in [Look::Dark, Look::Light] {
            let theme = Theme::new(look, Marker::Braille);
            for role in [Quiet, Title, Unworn] {
                let style = theme.style(role);
                assert_eq!(style.fg, None, "{role:?}");
                assert!(!style.add_modifier.contains(Modifier::DIM), "{role:?}");
            }
            for role in [
                Limit, Profile, Pressure, Contact, Shear, Stick, Slip, Open, Notice, Alarm,
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

    /// WCAG's contrast for a line: at least 3 against each background that a theme is for.
    #[test]
    fn colours_stand_out_on_their_backgrounds() {
        const LEVELS: [u8; 6] = [0, 95, 135, 175, 215, 255];
        let contrast = |a: [u8; 3], b: [u8; 3]| {
            let (a, b) = (luminance(a), luminance(b));
            (a.max(b) + 0.05) / (a.min(b) + 0.05)
        };
        for pair in [ORANGE, SKY, GREEN, VERMILLION, PURPLE, YELLOW] {
            // Black and Solarized's dark background; white and Solarized's light one.
            for (at, grounds) in [
                (0, [[0, 0, 0], [0x00, 0x2b, 0x36]]),
                (1, [[0xff; 3], [0xfd, 0xf6, 0xe3]]),
            ] {
                // The cube begins after the sixteen named colours.
                let place = usize::from(pair[at]) - 16;
                let color = [place / 36, place / 6 % 6, place % 6].map(|level| LEVELS[level]);
                for ground in grounds {
                    assert_eq!(
                        Look::for_background(ground) == Look::Light,
                        at == 1,
                        "{ground:?}"
                    );
                    let found = contrast(color, ground);
                    assert!(found >= 3.0, "{color:?} on {ground:?}: {found:.2}");
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
            ("truecolor", "xterm", Depth::True),
            ("24bit", "xterm-256color", Depth::True),
        ] {
            assert_eq!(Depth::detect(colorterm, term), depth, "{colorterm} {term}");
        }
    }
}
