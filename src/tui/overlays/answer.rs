//! An overlay's answer to a key, and what overlays share: selection in a list, and a line being typed.

use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};

use super::Overlay;
use crate::tui::command::{self, Command};
use crate::tui::keys::{Keystroke, Named};
use crate::tui::line::LineEdit;

/// What follows a key that an overlay has handled.
#[derive(Debug)]
pub enum Answer {
    /// The overlay stays.
    Stay,
    /// The overlay closes, and the one below it shows.
    Close,
    /// The overlay has done its work. All overlays close, except the form, which waits for the next change.
    Done,
    /// Another overlay opens on top.
    Open(Overlay),
    /// The command runs and the overlay stays, so that the run can be watched.
    Watch(Command),
    /// All overlays close, and the command runs.
    Run(Command),
}

/// Handles a key in an overlay that leaves the run visible: `closing` commands only close it, `watched` commands run
/// while it stays, and other keys do nothing.
pub(super) fn watch(key: Keystroke, closing: &[Command], watched: &[Command]) -> Answer {
    match command::of_key(key) {
        Some(Command::Quit) => Answer::Close,
        Some(command) if closing.contains(&command) => Answer::Close,
        Some(command) if watched.contains(&command) => Answer::Watch(command),
        _ => Answer::Stay,
    }
}

/// The number of entries that a page key moves in a list.
pub(super) const PAGE: usize = 10;

/// Selects another of `count` entries if the key moves in lists; returns false for other keys.
pub(super) fn select(at: &mut usize, count: usize, key: Keystroke) -> bool {
    let last = count.saturating_sub(1);
    let Keystroke::Named(key) = key else {
        return false;
    };
    *at = match key {
        Named::Home => 0,
        Named::End => last,
        Named::PageUp => at.saturating_sub(PAGE),
        Named::PageDown => (*at + PAGE).min(last),
        Named::Up | Named::BackTab => at.checked_sub(1).unwrap_or(last),
        Named::Down | Named::Tab => (*at + 1) % (last + 1),
        _ => return false,
    };
    true
}

/// Returns a line being typed, with its prompt and its cursor.
pub(super) fn typing(prompt: &str, line: &LineEdit, style: Style) -> Line<'static> {
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
