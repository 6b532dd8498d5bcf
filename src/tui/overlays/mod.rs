//! Overlays, one per file. Each has its state, handles keys and draws itself.

use super::canvas::Canvas;
use super::command::Command;
use super::explorer::Explorer;
use super::keys::{Keystroke, Named};
use super::line::LineEdit;
use super::map::live::LiveStudy;
use answer::watch;

mod accuracy;
mod answer;
mod explain;
mod form;
mod help;
mod library;
mod palette;
mod sweep;

pub use answer::Answer;
pub use form::Form;
pub use help::Help;
pub use library::Library;
pub use palette::Palette;
pub(super) use sweep::OPENING;

/// An overlay.
#[derive(Debug)]
pub enum Overlay {
    /// The help on keys.
    Help(Help),
    /// The presets and files.
    Library(Library),
    /// The checks and the refinement check, or a second page that explains each check.
    Accuracy {
        /// Whether the second page is shown.
        explains: bool,
    },
    /// An explanation of the focused panel.
    Explain,
    /// The command palette.
    Palette(Palette),
    /// The list of parameters.
    Form(Form),
    /// A study, on the whole screen.
    Sweep(LiveStudy),
    /// The keys of a study.
    MapKeys,
}

impl Overlay {
    /// Handles a key.
    pub fn press(&mut self, key: Keystroke, explorer: &mut Explorer) -> Answer {
        match self {
            Self::Help(help) => help.press(key),
            Self::Library(library) => library.press(key, explorer),
            Self::Explain => watch(key, explain::CLOSING, explain::WATCHED),
            Self::Accuracy { explains } => match key {
                Keystroke::Named(Named::Tab | Named::BackTab) => {
                    *explains ^= true;
                    Answer::Stay
                }
                _ => watch(key, accuracy::CLOSING, accuracy::WATCHED),
            },
            Self::Palette(palette) => palette.press(key, explorer),
            Self::Form(form) => form.press(key, explorer),
            Self::Sweep(live) => sweep::press(live, key, explorer),
            Self::MapKeys => watch(key, &[Command::Back, Command::Help, Command::Accept], &[]),
        }
    }

    /// Returns the line being typed, if there is one.
    pub fn line(&mut self) -> Option<&mut LineEdit> {
        match self {
            Self::Palette(palette) => Some(&mut palette.line),
            Self::Form(form) => form.typed.as_mut().or(Some(&mut form.filter)),
            Self::Library(library) => Some(&mut library.filter),
            _ => None,
        }
    }

    /// Draws it over the panels; a study takes the whole screen.
    pub fn draw(&self, explorer: &Explorer, canvas: Canvas) {
        match self {
            Self::Help(help) => help.draw(canvas),
            Self::Library(library) => library.draw(canvas),
            Self::Accuracy { explains: false } => accuracy::draw(&explorer.frame, canvas),
            Self::Accuracy { explains: true } => {
                accuracy::draw_explanations(&explorer.frame, canvas);
            }
            Self::Explain => explain::draw(explorer, canvas),
            Self::Palette(palette) => palette.draw(&explorer.frame, canvas),
            Self::Form(form) => form.draw(explorer, canvas),
            Self::Sweep(live) => sweep::draw(live, explorer.notice.as_deref(), canvas),
            Self::MapKeys => sweep::draw_keys(canvas),
        }
    }
}
