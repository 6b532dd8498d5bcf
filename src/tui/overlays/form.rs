//! The parameters of the scenario, edited while it runs: value, unit, range and effect of each.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::{Answer, App, Command, Frame, Key, LineEdit, docked, first_shown, typing};
use crate::scenario::schema::Kind;
use crate::tui::command;
use crate::tui::keys::Named;
use crate::tui::order::Order;
use crate::tui::settings::Setting;
use crate::tui::theme::Role;

/// The selected parameter, and its value while that is typed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Form {
    at: usize,
    typed: Option<LineEdit>,
    /// The value before the change that was asked for, until the answer is seen: a refused text stays.
    sent: Option<Option<String>>,
}

/// Where the values begin, in cells.
const VALUES: usize = 38;

impl Form {
    /// The value being typed, if there is one.
    pub(super) fn line(&mut self) -> Option<&mut LineEdit> {
        self.typed.as_mut()
    }

    pub(super) fn press(&mut self, key: Key, frame: Option<&Frame>) -> Answer {
        let settings = frame.map_or(&[][..], |frame| frame.settings.as_slice());
        // Another shape has other keys: the list can have become shorter.
        self.at = self.at.min(settings.len().saturating_sub(1));
        let Some(setting) = settings.get(self.at) else {
            return Answer::Close;
        };
        if self.is_taken(setting) {
            self.typed = None;
        }
        if self.typed.is_some() {
            return self.type_on(key, setting);
        }
        self.sent = None;
        let last = settings.len() - 1;
        match (key, command::of_key(key)) {
            (Key::Named(Named::PageUp), _) => self.at = self.at.saturating_sub(5),
            (Key::Named(Named::PageDown), _) => self.at = (self.at + 5).min(last),
            (Key::Named(Named::Home), _) => self.at = 0,
            (Key::Named(Named::End), _) => self.at = last,
            (Key::Char(character @ ('0'..='9')), _) => {
                self.typed = Some(LineEdit::new(&character.to_string()));
            }
            (_, Some(Command::Up | Command::PreviousPanel)) => {
                self.at = self.at.checked_sub(1).unwrap_or(last);
            }
            (_, Some(Command::Down | Command::NextPanel)) => self.at = (self.at + 1) % (last + 1),
            (_, Some(Command::Faster | Command::Right)) => return next(setting, true),
            (_, Some(Command::Slower | Command::Left)) => return next(setting, false),
            (_, Some(Command::Accept)) => match setting.parameter.kind {
                Kind::Choice(_) | Kind::Flag => return next(setting, true),
                _ => {
                    let value = setting.value.as_ref().map(|_| setting.shown(true));
                    self.typed = Some(LineEdit::new(&value.unwrap_or_default()));
                }
            },
            (_, Some(Command::Back | Command::Edit)) => return Answer::Close,
            // The run can be watched from here.
            (
                _,
                Some(
                    watch @ (Command::RunPause
                    | Command::Step
                    | Command::Cycle
                    | Command::TimeBack
                    | Command::TimeForth
                    | Command::Snapshot
                    | Command::Theory),
                ),
            ) => return Answer::Meanwhile(watch),
            (_, Some(other)) => return Answer::Through(other),
            (_, None) => {}
        }
        Answer::Stay
    }

    /// Whether the change that was asked for has been made.
    fn is_taken(&self, setting: &Setting) -> bool {
        let sent = self.sent.as_ref();
        sent.is_some_and(|before| *before != setting.value)
    }

    fn type_on(&mut self, key: Key, setting: &Setting) -> Answer {
        let Some(line) = &mut self.typed else {
            return Answer::Stay;
        };
        match key {
            Key::Named(Named::Esc) => {
                self.typed = None;
                self.sent = None;
            }
            Key::Named(Named::Enter) => {
                let value = line.text().trim().to_owned();
                let is_same =
                    setting.value.as_ref() == Some(&value) || setting.shown(true) == value;
                if value.is_empty() || is_same {
                    self.typed = None;
                } else {
                    self.sent = Some(setting.value.clone());
                    return change(setting, value);
                }
            }
            key => {
                line.press(key);
            }
        }
        Answer::Stay
    }

    pub(super) fn draw(&self, app: &App, area: Rect, buffer: &mut Buffer) {
        let frame = app.frame.as_deref();
        let settings = frame.map_or(&[][..], |frame| frame.settings.as_slice());
        let at = self.at.min(settings.len().saturating_sub(1));
        let rows = (area.height / 2).clamp(8, 20);
        let title = match self.typed {
            None => "parameters (Enter edits, + - steps, Space runs, Esc closes)",
            Some(_) => "parameters (Enter applies, Esc cancels)",
        };
        let inside = docked(app, title, (100, rows + 3), area, buffer);
        let about = 3.min(inside.height);
        let list = Rect {
            height: inside.height - about,
            ..inside
        };
        let shown = settings
            .iter()
            .enumerate()
            .skip(first_shown(at, settings.len(), list.height));
        for ((i, setting), row) in shown.zip(list.rows()) {
            let path = format!(" {:1$}", setting.parameter.path, VALUES - 1);
            match &self.typed {
                Some(line) if i == at && !self.is_taken(setting) => {
                    typing(&path, line, app.theme.style(Role::Title)).render(row, buffer);
                    let unit = match setting.unit {
                        "" => String::new(),
                        unit => format!("{unit}, or with a unit "),
                    };
                    let unit = Line::raw(app.theme.printable(&unit));
                    unit.right_aligned().render(row, buffer);
                }
                _ => {
                    Line::raw(format!("{path}{}", setting.shown(app.theme.ascii())))
                        .render(row, buffer);
                    if i == at {
                        buffer.set_style(row, app.theme.style(Role::Focus));
                    }
                }
            }
        }
        if let Some(setting) = settings.get(at) {
            let below = Rect {
                y: list.bottom(),
                height: about,
                ..inside
            };
            for (line, row) in self.about(setting, app).into_iter().zip(below.rows()) {
                line.render(row, buffer);
            }
        }
    }

    /// Meaning and range, effect, and what was answered to the last change.
    fn about(&self, setting: &Setting, app: &App) -> Vec<Line<'static>> {
        let quiet = app.theme.style(Role::Quiet);
        let told = match &app.notice {
            Some(text) => Span::styled(app.theme.printable(text), app.theme.style(Role::Notice)),
            None => Span::styled(format!("must be {}", setting.rule()), quiet),
        };
        vec![
            Line::raw(format!(" {}", setting.parameter.meaning)),
            Line::styled(format!(" {}", setting.parameter.effect), quiet),
            Line::from(vec![Span::raw(" "), told]),
        ]
    }
}

/// The next value of a parameter, if there is one.
fn next(setting: &Setting, up: bool) -> Answer {
    match setting
        .next(up)
        .filter(|next| setting.value.as_ref() != Some(next))
    {
        Some(value) => change(setting, value),
        None => Answer::Say("+ and - cannot change this value; press Enter to type one".into()),
    }
}

fn change(setting: &Setting, value: String) -> Answer {
    Answer::Ask(Order::Change {
        key: setting.parameter.path.to_owned(),
        value,
    })
}
