//! The help: keys and what they do, one per row, in groups, with a search.

use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget};

use super::{Answer, App, Command, Key, LineEdit, leave_for, popup, typing};
use crate::tui::command::{self, Row, with_keys};
use crate::tui::keys::Named;
use crate::tui::manual::groups;
use crate::tui::theme::Role;

/// The help: scrolled down by some lines, or searched.
#[derive(Debug, Default)]
pub struct Help {
    first: u16,
    pub(super) search: Option<LineEdit>,
}

/// The commands that have all of the words in key, name or help.
fn found(search: &str) -> impl Iterator<Item = &'static Row> + use<> {
    let words: Vec<String> = search.split_whitespace().map(str::to_lowercase).collect();
    with_keys().filter(move |row| {
        let text = format!("{} {} {}", row.key_names().join(" "), row.name, row.help);
        let text = text.to_lowercase();
        words.iter().all(|word| text.contains(word.as_str()))
    })
}

impl Help {
    /// The help with its search open.
    pub fn searching() -> Self {
        Self {
            search: Some(LineEdit::default()),
            ..Self::default()
        }
    }

    pub(super) fn press(&mut self, key: Key, app: &mut App) -> Answer {
        if let Some(line) = &mut self.search {
            match key {
                Key::Named(Named::Esc) => self.search = None,
                Key::Named(Named::Enter) => return Answer::Close,
                key if line.press(key) => self.first = 0,
                _ => {}
            }
            return Answer::Stay;
        }
        const PAGE: u16 = 10;
        let last = 2 * with_keys().count() as u16;
        match key {
            Key::Named(Named::PageUp) => self.first = self.first.saturating_sub(PAGE),
            Key::Named(Named::PageDown) => self.first = (self.first + PAGE).min(last),
            Key::Named(Named::Home) => self.first = 0,
            Key::Named(Named::End) => self.first = last,
            _ => {}
        }
        match command::of_key(key) {
            Some(Command::Up) => self.first = self.first.saturating_sub(1),
            Some(Command::Down) => self.first = (self.first + 1).min(last),
            Some(Command::Search) => self.search = Some(LineEdit::default()),
            Some(Command::Back | Command::Help | Command::Accept) => return Answer::Close,
            other => return leave_for(other, app),
        }
        Answer::Stay
    }

    pub(super) fn draw(&self, app: &App, area: Rect, buffer: &mut Buffer) {
        match &self.search {
            Some(line) => self.draw_search(line, app, area, buffer),
            None => self.draw_groups(app, area, buffer),
        }
    }

    /// All keys by groups: in two columns where there is room for them, else scrolled.
    fn draw_groups(&self, app: &App, area: Rect, buffer: &mut Buffer) {
        let mut lines = Vec::new();
        for (group, rows) in groups() {
            if !lines.is_empty() {
                lines.push(Line::default());
            }
            lines.push(Line::styled(
                format!(" {group}"),
                app.theme.style(Role::Title),
            ));
            lines.extend(rows.iter().map(|row| line(row, app)));
        }
        let count = lines.len();
        let columns = if area.width >= 2 * WIDTH && count + 2 > usize::from(area.height) {
            2
        } else {
            1
        };
        let rows = count.div_ceil(columns);
        let fits = rows + 2 <= usize::from(area.height);
        let title = if fits {
            "keys (/ searches, Esc closes)"
        } else {
            "keys (arrows, PgUp, PgDn scroll, / searches, Esc closes)"
        };
        let size = (columns as u16 * WIDTH, rows as u16 + 2);
        let inside = popup(&app.theme, title, size, area, buffer);
        let first = self.first.min((rows as u16).saturating_sub(inside.height));
        let places = Layout::horizontal(vec![Constraint::Fill(1); columns]).split(inside);
        for (part, place) in lines.chunks(rows.max(1)).zip(places.iter()) {
            Paragraph::new(part.to_vec())
                .scroll((first, 0))
                .render(*place, buffer);
        }
    }

    fn draw_search(&self, search: &LineEdit, app: &App, area: Rect, buffer: &mut Buffer) {
        let found = found(&search.text());
        let mut lines: Vec<Line> = found.map(|row| line(row, app)).collect();
        if lines.is_empty() {
            let text = format!("{:>KEYS$}   no command matches", "");
            lines.push(Line::styled(text, app.theme.style(Role::Quiet)));
        }
        let prompt = format!("{:>1$}", "/", KEYS + 3);
        lines.insert(0, typing(&prompt, search, app.theme.style(Role::Title)));
        // The box keeps its height while the list gets shorter.
        let height = with_keys().count() as u16 + 3;
        let title = "search the help (Esc ends)";
        let inside = popup(&app.theme, title, (WIDTH, height), area, buffer);
        Paragraph::new(lines).render(inside, buffer);
    }
}

/// The width of a column, and that of the keys in it.
const WIDTH: u16 = 80;
const KEYS: usize = 15;

/// The keys of a command, and what they do.
fn line(row: &Row, app: &App) -> Line<'static> {
    let keys = format!(" {:>KEYS$}  ", row.key_names().join(" "));
    let keys = Span::styled(keys, app.theme.style(Role::Title));
    Line::from(vec![keys, Span::raw(row.help)])
}
