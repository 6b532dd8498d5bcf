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

/// How things look in this terminal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Theme {
    colored: bool,
    /// How curves are drawn.
    pub marker: Marker,
}

impl Theme {
    /// A theme with or without colour.
    pub fn new(colored: bool, marker: Marker) -> Self {
        Self { colored, marker }
    }

    /// Whether colours tell things apart.
    pub fn colored(&self) -> bool {
        self.colored
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
        let with = |color| if self.colored { plain.fg(color) } else { plain };
        match role {
            Role::Unworn | Role::Open | Role::Quiet => {
                if self.colored {
                    plain.fg(Color::DarkGray)
                } else {
                    plain.add_modifier(Modifier::DIM)
                }
            }
            Role::Limit => with(Color::LightGreen),
            Role::Profile => with(Color::Yellow),
            Role::Profile1d => with(Color::LightBlue),
            Role::Pressure | Role::Contact => with(Color::Cyan),
            Role::Shear => with(Color::Magenta),
            Role::Stick => with(Color::Green),
            Role::Slip => with(Color::LightRed),
            Role::Title => plain.add_modifier(Modifier::BOLD),
            Role::Focus | Role::Bar => plain.add_modifier(Modifier::REVERSED),
            Role::Notice => with(Color::Yellow),
            Role::Alarm => with(Color::LightRed).add_modifier(Modifier::BOLD),
        }
    }
}
