//! What an overlay answers to a key, and what overlays share: moving in a list, and a line being typed.

use super::*;

/// What follows a key that an overlay has taken.
#[derive(Debug)]
pub enum Answer {
    /// It stays.
    Stay,
    /// It closes, and what lies under it is seen.
    Close,
    /// It has done what it was opened for: of what lies under it, only the form waits for the next change.
    Done,
    /// Another one is laid on it.
    Open(Overlay),
    /// A command is carried out, and it stays: the run can be watched from there.
    Watch(Command),
    /// All overlays close, and a command is carried out.
    Run(Command),
}

/// Answers a key beside which the run can be watched: those of commands that close do nothing else, those of `watched`
/// ones leave open what is open, and no other key does anything.
pub(super) fn watch(key: Key, closing: &[Command], watched: &[Command]) -> Answer {
    match command::of_key(key) {
        Some(Command::Quit) => Answer::Close,
        Some(command) if closing.contains(&command) => Answer::Close,
        Some(command) if watched.contains(&command) => Answer::Watch(command),
        _ => Answer::Stay,
    }
}

/// The keys that a page up and a page down pass in a list.
pub(super) const PAGE: usize = 10;

/// Selects another one of `count` entries by a key that moves in lists; false for other keys.
pub(super) fn select(at: &mut usize, count: usize, key: Key) -> bool {
    let last = count.saturating_sub(1);
    let Key::Named(key) = key else {
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

/// A line being typed behind a prompt, its cursor shown.
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
