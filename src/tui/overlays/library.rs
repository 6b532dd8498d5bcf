//! The presets, one of them selected.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::{Paragraph, Widget};

use super::{Answer, App, Command, Frame, Key, first_shown, popup};
use crate::scenario::preset;
use crate::tui::command;
use crate::tui::theme::Role;

/// The list of presets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Library {
    at: usize,
}

impl Library {
    /// The list, the scenario on the screen selected.
    pub fn open(frame: Option<&Frame>) -> Self {
        let origin = frame.map_or("", |frame| frame.origin.as_str());
        let at = preset::ALL.iter().position(|preset| preset.name == origin);
        Self {
            at: at.unwrap_or(0),
        }
    }

    pub(super) fn press(&mut self, key: Key) -> Answer {
        let count = preset::ALL.len();
        match command::of_key(key) {
            Some(Command::Up | Command::PreviousPanel) => self.at = (self.at + count - 1) % count,
            Some(Command::Down | Command::NextPanel) => self.at = (self.at + 1) % count,
            Some(Command::Back | Command::Presets) => return Answer::Close,
            Some(Command::Accept | Command::RunPause) => {
                return Answer::Load(preset::ALL[self.at].name.to_owned());
            }
            Some(other) => return Answer::Through(other),
            None => {}
        }
        Answer::Stay
    }

    pub(super) fn draw(&self, app: &App, area: Rect, buffer: &mut Buffer) {
        let names = preset::ALL.iter().map(|preset| preset.name.len());
        let width = names.max().unwrap_or(0);
        let lines: Vec<Line> = preset::ALL
            .iter()
            .enumerate()
            .map(|(i, preset)| {
                let text = format!(" {:width$}  {} ", preset.name, preset.title());
                if i == self.at {
                    Line::styled(text, app.theme.style(Role::Focus))
                } else {
                    Line::raw(text)
                }
            })
            .collect();
        let height = lines.len() as u16 + 2;
        let title = "presets (Enter starts, Esc closes)";
        let inside = popup(app, title, (76, height), area, buffer);
        let first = first_shown(self.at, inside.height) as u16;
        Paragraph::new(lines)
            .scroll((first, 0))
            .render(inside, buffer);
    }
}
