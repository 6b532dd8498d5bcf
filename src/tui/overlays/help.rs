//! The keys and what they do, searched by a word.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget};

use super::{Answer, App, Command, Key, LineEdit, popup, typing};
use crate::tui::command::{self, BINDINGS, Binding};
use crate::tui::keys::Named;
use crate::tui::theme::Role;

/// The help: scrolled down by some lines, or searched.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Help {
    first: u16,
    search: Option<LineEdit>,
}

/// Commands that share a line of the help where the screen is short.
const GROUPS: &[(&[Command], &str)] = &[
    (
        &[Command::Step, Command::Cycle],
        "pause and take one step; go on to the end of the cycle",
    ),
    (
        &[Command::Faster, Command::Slower],
        "more, fewer cycles a second, up to as fast as it can",
    ),
    (
        &[Command::NextMethod, Command::PreviousMethod],
        "next, previous transform method; the state stays",
    ),
    (
        &[Command::NextLaw, Command::PreviousLaw],
        "next, previous wear law; the state stays",
    ),
    (
        &[
            Command::NextPage,
            Command::NextPanel,
            Command::PreviousPanel,
        ],
        "more panels; focus the next, previous panel",
    ),
    (
        &[Command::Zoom, Command::LogScale, Command::Theme],
        "the focused panel alone; its log scale; colours",
    ),
    (
        &[Command::Snapshot, Command::SnapshotNote],
        "state and scenario to a new directory; with a note",
    ),
    (
        &[
            Command::TimeBack,
            Command::TimeForth,
            Command::Mark,
            Command::Visit,
        ],
        "back and forth in time; mark a state, go to a mark",
    ),
    (
        &[Command::Presets, Command::Restart],
        "choose another scenario; start this one again",
    ),
    (
        &[Command::Theory, Command::Accuracy, Command::Compare],
        "closed forms; how far to trust; a second method (m M)",
    ),
    (
        &[Command::Cursor, Command::Left, Command::Right],
        "a cursor that reads all curves at r; it moves",
    ),
    (
        &[Command::Up, Command::Down, Command::Accept, Command::Back],
        "up, down; take what is selected; close what is open",
    ),
    (
        &[Command::Help, Command::Search],
        "show or hide this help; search in it",
    ),
];

/// One line: the keys, and what they do.
type Entry = (String, &'static str);

/// Every command, one a line, or groups of commands where `rows` are few.
fn entries(rows: u16) -> Vec<Entry> {
    let is_short = usize::from(rows) < BINDINGS.len();
    let group_of = |command: Command| {
        GROUPS
            .iter()
            .find(|(group, _)| is_short && group.contains(&command))
    };
    let mut lines = Vec::new();
    for binding in BINDINGS {
        match group_of(binding.command) {
            None => lines.push((keys(binding), binding.help)),
            Some((group, help)) if group[0] == binding.command => {
                let all: Vec<String> = group
                    .iter()
                    .filter_map(|command| BINDINGS.iter().find(|other| other.command == *command))
                    .map(keys)
                    .collect();
                lines.push((all.join(" "), help));
            }
            Some(_) => {}
        }
    }
    lines
}

fn keys(binding: &Binding) -> String {
    let keys: Vec<String> = binding.keys.iter().map(ToString::to_string).collect();
    keys.join(" ")
}

/// The commands that have all of the words in key, name or help.
fn found(search: &str) -> Vec<Entry> {
    let words: Vec<String> = search.split_whitespace().map(str::to_lowercase).collect();
    BINDINGS
        .iter()
        .filter(|binding| {
            let text = format!("{} {} {}", keys(binding), binding.name, binding.help);
            let text = text.to_lowercase();
            words.iter().all(|word| text.contains(word.as_str()))
        })
        .map(|binding| (keys(binding), binding.help))
        .collect()
}

impl Help {
    /// The help with its search open.
    pub fn searching() -> Self {
        Self {
            search: Some(LineEdit::default()),
            ..Self::default()
        }
    }

    pub(super) fn press(&mut self, key: Key) -> Answer {
        let command = command::of_key(key);
        if let Some(line) = &mut self.search {
            match key {
                Key::Named(Named::Esc) => self.search = None,
                Key::Named(Named::Enter) => return Answer::Close,
                key if line.press(key) => self.first = 0,
                _ => {}
            }
            return Answer::Stay;
        }
        match command {
            Some(Command::Up) => self.first = self.first.saturating_sub(1),
            Some(Command::Down) => self.first = (self.first + 1).min(BINDINGS.len() as u16 - 1),
            Some(Command::Search) => self.search = Some(LineEdit::default()),
            Some(Command::Back | Command::Help | Command::Accept) => return Answer::Close,
            Some(other) => return Answer::Through(other),
            None => {}
        }
        Answer::Stay
    }

    pub(super) fn draw(&self, app: &App, area: Rect, buffer: &mut Buffer) {
        let entries = match &self.search {
            Some(line) => found(&line.text()),
            None => entries(area.height.saturating_sub(2)),
        };
        let mut lines: Vec<Line> = entries
            .into_iter()
            .map(|(keys, help)| {
                Line::from(vec![
                    Span::styled(format!(" {keys:>21}  "), app.theme.style(Role::Title)),
                    Span::raw(help),
                ])
            })
            .collect();
        let mut height = lines.len() as u16 + 2;
        let mut title = "keys (Esc closes)";
        if let Some(line) = &self.search {
            if lines.is_empty() {
                let text = format!("{:>24}no command has these words", "");
                lines.push(Line::styled(text, app.theme.style(Role::Quiet)));
            }
            lines.insert(
                0,
                typing(&format!("{:>24}", "/"), line, app.theme.style(Role::Title)),
            );
            // The box keeps its height while the list gets shorter.
            height = BINDINGS.len() as u16 + 3;
            title = "search in the help (Esc ends)";
        } else if height > area.height {
            title = "keys (up and down scroll, Esc closes)";
        }
        let inside = popup(app, title, (80, height), area, buffer);
        let first = self
            .first
            .min((lines.len() as u16).saturating_sub(inside.height));
        Paragraph::new(lines)
            .scroll((first, 0))
            .render(inside, buffer);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_cut() {
        for rows in [20, 100] {
            for (keys, help) in entries(rows) {
                assert!(keys.chars().count() <= 21, "{keys}");
                assert!(help.chars().count() <= 54, "{help}");
            }
        }
        assert!(entries(20).len() <= 20);
    }
}
