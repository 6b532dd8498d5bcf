//! Overlays, one per file: each has its own state, handles keys and draws itself. What they have in common is imported
//! here; each of them begins with `use super::*`.

use std::path::Path;

use ratatui::layout::Constraint::{Fill, Length};
use ratatui::prelude::*;
use ratatui::widgets::Paragraph;

use super::app::App;
use super::canvas::Canvas;
use super::command::{self, Command, Row};
use super::frame::Frame;
use super::keys::{Key, Named};
use super::line::LineEdit;
use super::map::live::Live;
use super::settings::Setting;
use super::theme::Role;

mod accuracy;
mod explain;
mod form;
mod help;
mod library;
pub(super) mod palette;

pub use form::Form;
pub use help::Help;
pub use library::Library;
pub use palette::{Completion, Palette};

/// The overlay on the panels.
#[derive(Debug, Default)]
pub enum Overlay {
    /// Nothing.
    #[default]
    None,
    /// The keys.
    Help(Help),
    /// The presets.
    Library(Library),
    /// The checks and the refinement check, or a second page that explains each check.
    Accuracy {
        /// Whether it is the second page.
        explains: bool,
    },
    /// What the focused panel shows.
    Explain,
    /// The command palette.
    Palette(Palette),
    /// The parameters.
    Form(Form),
    /// A study, on the whole screen.
    Sweep(Live),
}

/// Whether an overlay stays open after a key.
#[derive(Debug, PartialEq, Eq)]
pub enum Answer {
    /// It stays.
    Stay,
    /// It closes.
    Close,
}

impl Overlay {
    /// Answers a key. Meanwhile the app has no overlay: what opens one takes this one's place.
    pub fn press(&mut self, key: Key, app: &mut App) -> Answer {
        let command = command::of_key(key);
        match self {
            Self::None => leave_for(command, app),
            Self::Help(help) => help.press(key, app),
            Self::Library(library) => library.press(key, app),
            Self::Explain => watch(command, explain::CLOSING, explain::WATCHED, app),
            Self::Accuracy { explains } => match command {
                Some(Command::NextPanel | Command::PreviousPanel) => {
                    *explains ^= true;
                    Answer::Stay
                }
                _ => watch(command, accuracy::CLOSING, accuracy::WATCHED, app),
            },
            Self::Palette(palette) => palette.press(key, app),
            Self::Form(form) => form.press(key, app),
            Self::Sweep(live) => live.press(key, app),
        }
    }

    /// The line being typed, if there is one.
    pub fn line(&mut self) -> Option<&mut LineEdit> {
        match self {
            Self::Palette(palette) => Some(&mut palette.line),
            Self::Form(form) => form.typed.as_mut(),
            _ => None,
        }
    }

    /// Draws it over the panels, unless it has the whole screen.
    pub fn draw(&self, app: &App, canvas: Canvas) {
        match self {
            Self::None | Self::Sweep(_) => {}
            Self::Help(help) => help.draw(canvas),
            Self::Library(library) => library.draw(canvas),
            Self::Accuracy { explains: false } => accuracy::draw(&app.frame, canvas),
            Self::Accuracy { explains: true } => accuracy::draw_explanations(&app.frame, canvas),
            Self::Explain => explain::draw(app, canvas),
            Self::Palette(palette) => palette.draw(app, canvas),
            Self::Form(form) => form.draw(app, canvas),
        }
    }
}

/// Closes for a command; stays if there is none.
fn leave_for(command: Option<Command>, app: &mut App) -> Answer {
    watch(command, &[], &[], app)
}

/// Answers a command beside which the run can be watched: those that close do nothing else, and those that are
/// `watched` leave open what is open.
fn watch(
    command: Option<Command>,
    closing: &[Command],
    watched: &[Command],
    app: &mut App,
) -> Answer {
    match command {
        Some(command) if closing.contains(&command) => Answer::Close,
        Some(command) => {
            app.run(command);
            match watched.contains(&command) {
                true => Answer::Stay,
                false => Answer::Close,
            }
        }
        None => Answer::Stay,
    }
}

/// The keys that a page up and a page down pass in a list.
const PAGE: usize = 10;

/// Selects another one of `count` entries by a key that moves in lists; false for other keys.
fn select(at: &mut usize, count: usize, key: Key) -> bool {
    let last = count.saturating_sub(1);
    *at = match (key, command::of_key(key)) {
        (Key::Named(Named::Home), _) => 0,
        (Key::Named(Named::End), _) => last,
        (Key::Named(Named::PageUp), _) => at.saturating_sub(PAGE),
        (Key::Named(Named::PageDown), _) => (*at + PAGE).min(last),
        (Key::Named(Named::Up), _) | (_, Some(Command::Up | Command::PreviousPanel)) => {
            at.checked_sub(1).unwrap_or(last)
        }
        (Key::Named(Named::Down), _) | (_, Some(Command::Down | Command::NextPanel)) => {
            (*at + 1) % (last + 1)
        }
        _ => return false,
    };
    true
}

/// A line being typed behind a prompt, its cursor shown.
fn typing(prompt: &str, line: &LineEdit, style: Style) -> Line<'static> {
    let [before, after] = line.halves();
    let mut after = after.chars();
    let under = after.next().unwrap_or(' ');
    Line::from(vec![
        Span::styled(prompt.to_owned(), style),
        Span::raw(before.to_owned()),
        Span::styled(under.to_string(), Modifier::REVERSED),
        Span::raw(after.as_str().to_owned()),
    ])
}
