//! The help: keys and their meanings, one per row, in groups. The palette can search it.

use std::cell::Cell;

use ratatui::layout::Constraint::Fill;
use ratatui::layout::Layout;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Paragraph;

use crate::plot::theme::Role;
use crate::tui::canvas::Canvas;
use crate::tui::command::{self, Command, CommandRow};
use crate::tui::keys::{Keystroke, Named};
use crate::tui::line::wrapped;
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
    pub(super) fn press(&mut self, key: Keystroke) -> Answer {
        let first = self.first.get();
        let first = match (key, command::of_key(key)) {
            (Keystroke::Named(Named::PageUp), _) => first.saturating_sub(PAGE as u16),
            (Keystroke::Named(Named::PageDown), _) => first.saturating_add(PAGE as u16),
            (Keystroke::Named(Named::Home), _) => 0,
            (Keystroke::Named(Named::End), _) => u16::MAX,
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
        let room = usize::from(area.width.min(WIDTH)).saturating_sub(BEFORE + 2);
        let mut lines = Vec::new();
        for (group, rows) in groups() {
            if !lines.is_empty() {
                lines.push(Line::default());
            }
            lines.push(Line::styled(format!(" {group}"), style));
            let explained =
                |row: &CommandRow| explain(&row.key_names().join(" "), row.help, room, style);
            lines.extend(rows.iter().flat_map(explained));
        }
        lines.extend([Line::default(), Line::styled(" mouse", style)]);
        lines.extend(explain("", MOUSE, room, style));
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
const MOUSE: &str = "with --mouse, or mouse = true in the configuration:\n\
                     a click focuses, moves the cursor or travels in time;\n\
                     a second one zooms; the wheel zooms about the cursor";

/// The width of a column, of the keys in it, and of what stands before an explanation.
const WIDTH: u16 = 80;
const KEYS: usize = 15;
const BEFORE: usize = KEYS + 3;

/// Returns keys and their explanation, in lines with this `room` for it.
fn explain(keys: &str, text: &str, room: usize, style: Style) -> Vec<Line<'static>> {
    let lines = wrapped(text, room).into_iter().enumerate();
    let line = |(k, text)| {
        let keys = if k == 0 { keys } else { "" };
        let keys = Span::styled(format!(" {keys:>KEYS$}  "), style);
        Line::from(vec![keys, Span::raw(text)])
    };
    lines.map(line).collect()
}
