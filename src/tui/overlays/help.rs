//! The help: keys and what they do, one per row, in groups, with a search.

use ratatui::prelude::*;
use ratatui::widgets::Paragraph;

use super::{Answer, App, Command, Key, LineEdit, PAGE, leave_for, popup, typing};
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
        let (first, last) = (self.first, 2 * with_keys().count() as u16);
        self.first = match (key, command::of_key(key)) {
            (Key::Named(Named::PageUp), _) => first.saturating_sub(PAGE as u16),
            (Key::Named(Named::PageDown), _) => (first + PAGE as u16).min(last),
            (Key::Named(Named::Home), _) => 0,
            (Key::Named(Named::End), _) => last,
            (_, Some(Command::Up)) => first.saturating_sub(1),
            (_, Some(Command::Down)) => (first + 1).min(last),
            (_, Some(Command::Back | Command::Help | Command::Accept)) => return Answer::Close,
            (_, Some(Command::Search)) => {
                self.search = Some(LineEdit::default());
                first
            }
            (_, other) => return leave_for(other, app),
        };
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
            let style = app.theme.style(Role::Title);
            lines.push(Line::styled(format!(" {group}"), style));
            lines.extend(rows.iter().map(|row| line(row, app)));
        }
        let count = lines.len();
        let height = usize::from(area.height);
        let columns = 1 + usize::from(area.width >= 2 * WIDTH && count + 2 > height);
        let rows = count.div_ceil(columns);
        let title = match rows + 2 <= height {
            true => "keys (/ searches, Esc closes)",
            false => "keys (arrows, PgUp, PgDn scroll, / searches, Esc closes)",
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
