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

/// Closes for a command; stays if there is none.
pub(super) fn leave_for(command: Option<Command>) -> Answer {
    command.map_or(Answer::Stay, Answer::Run)
}

/// Answers a command beside which the run can be watched: those that close do nothing else, and those that are
/// `watched` leave open what is open.
pub(super) fn watch(command: Option<Command>, closing: &[Command], watched: &[Command]) -> Answer {
    match command {
        Some(command) if closing.contains(&command) => Answer::Close,
        Some(command) if watched.contains(&command) => Answer::Watch(command),
        command => leave_for(command),
    }
}

/// The keys that a page up and a page down pass in a list.
pub(super) const PAGE: usize = 10;

/// Selects another one of `count` entries by a key that moves in lists; false for other keys.
pub(super) fn select(at: &mut usize, count: usize, key: Key) -> bool {
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
