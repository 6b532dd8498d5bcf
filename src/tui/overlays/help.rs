//! The help: keys and their meanings, one per row, in groups. The palette can search it.

use std::cell::Cell;

use ratatui::layout::Constraint::Fill;
use ratatui::layout::Layout;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Paragraph;

use crate::plot::theme::Role;
use crate::tui::canvas::Canvas;
use crate::tui::command::{self, Command, Row};
use crate::tui::keys::{Key, Named};
use crate::tui::manual::groups;
use crate::tui::overlays::answer::{Answer, PAGE, watch};

/// The commands that close it.
const CLOSING: &[Command] = &[Command::Back, Command::Help, Command::Accept];

/// The help, scrolled down by some lines; drawing limits them to the length of the text.
#[derive(Debug, Default)]
pub struct Help {
    first: Cell<u16>,
}

impl Help {
    pub(super) fn press(&mut self, key: Key) -> Answer {
        let first = self.first.get();
        let first = match (key, command::of_key(key)) {
            (Key::Named(Named::PageUp), _) => first.saturating_sub(PAGE as u16),
            (Key::Named(Named::PageDown), _) => first.saturating_add(PAGE as u16),
            (Key::Named(Named::Home), _) => 0,
            (Key::Named(Named::End), _) => u16::MAX,
            (_, Some(Command::Up)) => first.saturating_sub(1),
            (_, Some(Command::Down)) => first.saturating_add(1),
            _ => return watch(key, CLOSING, &[Command::Search]),
        };
        self.first.set(first);
        Answer::Stay
    }

    /// Draws all keys by group, in two columns if there is room, else scrolled.
    pub(super) fn draw(&self, mut canvas: Canvas) {
        let (area, style) = (canvas.area, canvas.style(Role::Title));
        let mut lines = Vec::new();
        for (group, rows) in groups() {
            if !lines.is_empty() {
                lines.push(Line::default());
            }
            lines.push(Line::styled(format!(" {group}"), style));
            lines.extend(rows.iter().map(|row| line(row, style)));
        }
        lines.extend([Line::default(), Line::styled(" mouse", style)]);
        lines.extend(MOUSE.map(|text| Line::raw(format!(" {:KEYS$}  {text}", ""))));
        let count = lines.len();
        let height = usize::from(area.height);
        let columns = 1 + usize::from(area.width >= 2 * WIDTH && count + 2 > height);
        let rows = count.div_ceil(columns);
        let title = if rows + 2 <= height {
            "keys (/ searches, Esc closes)"
        } else {
            "keys (arrows, PgUp, PgDn scroll, / searches, Esc closes)"
        };
        let size = (columns as u16 * WIDTH, rows as u16 + 2);
        let mut inside = canvas.popup(title, size);
        let below = (rows as u16).saturating_sub(inside.area.height);
        let first = self.first.get().min(below);
        self.first.set(first);
        let places = Layout::horizontal(vec![Fill(1); columns]).split(inside.area);
        for (part, place) in lines.chunks(rows.max(1)).zip(places.iter()) {
            let part = Paragraph::new(part.to_vec()).scroll((first, 0));
            inside.at(*place).show(part);
        }
    }
}

/// How the mouse is used.
const MOUSE: [&str; 3] = [
    "with --mouse, or mouse = true in the configuration:",
    "a click focuses, moves the cursor or travels in time;",
    "a second one zooms; the wheel zooms about the cursor",
];

/// The width of a column, and of the keys in it.
const WIDTH: u16 = 80;
const KEYS: usize = 15;

/// Returns the keys of a command, and what it does.
fn line(row: &Row, style: Style) -> Line<'static> {
    let keys = format!(" {:>KEYS$}  ", row.key_names().join(" "));
    Line::from(vec![Span::styled(keys, style), Span::raw(row.help)])
}
