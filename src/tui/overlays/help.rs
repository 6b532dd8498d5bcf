//! The keys and what they do, searched by a word.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget};

use super::{Answer, App, Command, Key, LineEdit, popup, typing};
use crate::tui::command::{self, BINDINGS};
use crate::tui::keys::Named;
use crate::tui::manual::{Entry, keys, long, short};
use crate::tui::theme::Role;

/// The help: scrolled down by some lines, or searched.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Help {
    first: u16,
    search: Option<LineEdit>,
}

/// The commands that have all of the words in key, name or help.
fn found(search: &str) -> Vec<Entry> {
    let words: Vec<String> = search.split_whitespace().map(str::to_lowercase).collect();
    BINDINGS
        .iter()
        .filter(|binding| {
            let keys = keys(binding).join(" ");
            let text = format!("{keys} {} {}", binding.name, binding.help);
            let text = text.to_lowercase();
            words.iter().all(|word| text.contains(word.as_str()))
        })
        .map(Entry::of)
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
            None if usize::from(area.height) < BINDINGS.len() + 2 => short(),
            None => long(),
        };
        let mut lines: Vec<Line> = entries
            .into_iter()
            .map(|Entry { keys, help }| {
                Line::from(vec![
                    Span::styled(
                        format!(" {:>21}  ", keys.join(" ")),
                        app.theme.style(Role::Title),
                    ),
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
