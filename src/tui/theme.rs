//! Colours: one for each quantity, the same in every panel.

use ratatui::style::{Color, Modifier, Style};

use super::plot::Marker;

/// Quantities and parts of the screen that have a style of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The unworn profile, and what is past.
    Unworn,
    /// What theory says.
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
    /// Axes, frames, footnotes.
    Quiet,
    /// Titles.
    Title,
    /// The title of the focused panel, the selected line.
    Focus,
    /// The status bar.
    Bar,
    /// A word for the user.
    Notice,
    /// Something is wrong.
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
    /// Every look, in the order in which a key goes through them.
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

/// How things look in this terminal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Theme {
    /// Which colours: of the 16 that every terminal has and its user has chosen.
    pub look: Look,
    /// How curves are drawn.
    pub marker: Marker,
}

impl Theme {
    /// A look, and what curves are made of.
    pub fn new(look: Look, marker: Marker) -> Self {
        Self { look, marker }
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
        text.chars()
            .map(|c| match c {
                c if c.is_control() => ' ',
                c if self.ascii() && !c.is_ascii() => '?',
                c => c,
            })
            .collect()
    }

    /// The style of a role.
    pub fn style(&self, role: Role) -> Style {
        let plain = Style::new();
        let with = |dark, light| match self.look {
            Look::Dark => plain.fg(dark),
            Look::Light => plain.fg(light),
            Look::Mono => plain,
        };
        match role {
            Role::Unworn | Role::Open | Role::Quiet if self.colored() => plain.fg(Color::DarkGray),
            Role::Unworn | Role::Open | Role::Quiet => plain.add_modifier(Modifier::DIM),
            Role::Limit => with(Color::LightGreen, Color::LightMagenta),
            Role::Profile => with(Color::Yellow, Color::Blue),
            Role::Profile1d => with(Color::LightBlue, Color::LightBlue),
            Role::Pressure | Role::Contact => with(Color::Cyan, Color::Cyan),
            Role::Shear => with(Color::Magenta, Color::Magenta),
            Role::Stick => with(Color::Green, Color::Green),
            Role::Slip => with(Color::LightRed, Color::Red),
            Role::Title => plain.add_modifier(Modifier::BOLD),
            Role::Focus | Role::Bar => plain.add_modifier(Modifier::REVERSED),
            Role::Notice => with(Color::Yellow, Color::Blue),
            Role::Alarm => with(Color::LightRed, Color::Red).add_modifier(Modifier::BOLD),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_curves_of_a_plot_share_a_colour() {
        use Role::{Contact, Limit, Pressure, Profile, Profile1d, Shear, Slip, Stick, Unworn};
        for look in [Look::Dark, Look::Light] {
            let theme = Theme::new(look, Marker::Braille);
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
                assert_eq!(colors.len(), count, "{look:?} {plot:?}");
            }
        }
    }

    #[test]
    fn mono_has_no_colour() {
        let theme = Theme::new(Look::Mono, Marker::Braille);
        for role in [Role::Profile, Role::Alarm, Role::Quiet, Role::Notice] {
            assert_eq!(theme.style(role).fg, None);
        }
    }
}
