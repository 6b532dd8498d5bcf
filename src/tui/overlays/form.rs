//! The parameters of the scenario, edited while it runs: value, unit, range and effect of each.

use ratatui::buffer::Buffer;
use ratatui::layout::Constraint::{Fill, Length};
use ratatui::layout::{Layout, Rect};
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::{
    Answer, App, Command, Key, LineEdit, docked, first_shown, leave_for, say, stay_for, typing,
};
use crate::scenario::words::meaning;
use crate::tui::command;
use crate::tui::keys::Named;
use crate::tui::settings::Setting;
use crate::tui::theme::Role;

/// The selected parameter, and its value while that is given.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Form {
    at: usize,
    giving: Giving,
    /// The key to select when the list is first seen.
    goal: Option<&'static str>,
    /// The value before the change that was asked for, until the answer is seen: a refused text stays.
    sent: Option<Option<String>>,
}

/// How a value is being given.
#[derive(Debug, Clone, PartialEq, Default)]
enum Giving {
    /// Not at all: a parameter is chosen.
    #[default]
    Nothing,
    /// Typed.
    Typed(LineEdit),
    /// Chosen from its words, of which this one is selected.
    Chosen(usize),
}

/// Where the values begin, in cells.
const VALUES: usize = 38;

impl Form {
    /// A form with the words of this key.
    pub fn choosing(path: &'static str) -> Self {
        Self {
            goal: Some(path),
            ..Self::default()
        }
    }

    /// The value being typed, if there is one.
    pub(super) fn line(&mut self) -> Option<&mut LineEdit> {
        match &mut self.giving {
            Giving::Typed(line) => Some(line),
            _ => None,
        }
    }

    /// The form as it is seen with these settings: which one is selected, and how its value is given.
    fn seen<'a>(&self, settings: &'a [Setting]) -> Option<(usize, &'a Setting, Giving)> {
        let sought = |path| {
            let mut paths = settings.iter().map(|setting| setting.parameter.path);
            paths.position(|known| known == path)
        };
        let goal = self.goal.and_then(sought);
        // Another shape has other keys: the list can have become shorter.
        let at = goal.unwrap_or(self.at.min(settings.len().saturating_sub(1)));
        let setting = settings.get(at)?;
        let giving = match goal {
            Some(_) => begin(setting, None),
            None if self.is_taken(setting) => Giving::Nothing,
            None => self.giving.clone(),
        };
        Some((at, setting, giving))
    }

    pub(super) fn press(&mut self, key: Key, app: &mut App) -> Answer {
        let frame = app.frame.clone();
        let settings = frame.as_ref();
        let settings = settings.map_or(&[][..], |frame| frame.facts.settings.as_slice());
        let Some((at, setting, giving)) = self.seen(settings) else {
            return Answer::Close;
        };
        (self.at, self.giving, self.goal) = (at, giving, None);
        match self.giving {
            Giving::Typed(_) => return self.type_on(key, setting, app),
            Giving::Chosen(at) => return self.choose(key, at, setting, app),
            Giving::Nothing => self.sent = None,
        }
        let last = settings.len() - 1;
        match (key, command::of_key(key)) {
            (Key::Named(Named::PageUp), _) => self.at = self.at.saturating_sub(5),
            (Key::Named(Named::PageDown), _) => self.at = (self.at + 5).min(last),
            (Key::Named(Named::Home), _) => self.at = 0,
            (Key::Named(Named::End), _) => self.at = last,
            (_, Some(Command::Up | Command::PreviousPanel)) => {
                self.at = self.at.checked_sub(1).unwrap_or(last);
            }
            (_, Some(Command::Down | Command::NextPanel)) => self.at = (self.at + 1) % (last + 1),
            (Key::Char('+' | '-' | '=') | Key::Named(Named::Left | Named::Right), Some(step)) => {
                let up = matches!(step, Command::Faster | Command::Right);
                return self.step(key, up, setting, app);
            }
            (_, Some(Command::Back)) => return Answer::Close,
            // The run can be watched from here, and an edit undone.
            (
                Key::Char(' ' | ',' | '[' | ']'),
                Some(
                    watch @ (Command::RunPause
                    | Command::Cycle
                    | Command::TimeBack
                    | Command::TimeForth),
                ),
            ) => return stay_for(watch, app),
            (Key::Char('?' | ':'), other) => return leave_for(other, app),
            (Key::Char(character), _) => return self.edit(setting, Some(character), app),
            (_, Some(Command::Accept)) => return self.edit(setting, None, app),
            (_, other) => return leave_for(other, app),
        }
        Answer::Stay
    }

    /// Begins to give the value, with the character typed.
    fn edit(&mut self, setting: &Setting, typed: Option<char>, app: &mut App) -> Answer {
        if let Some(because) = setting.fixed() {
            return say(because, app);
        }
        self.giving = begin(setting, typed);
        Answer::Stay
    }

    /// The next value of a parameter. Where there is none, the key is the first of a text.
    fn step(&mut self, key: Key, up: bool, setting: &Setting, app: &mut App) -> Answer {
        let next = setting.next(up).filter(|_| setting.fixed().is_none());
        match (next, key) {
            (Some(value), _) if setting.value.as_ref() != Some(&value) => {
                change(setting, value, app)
            }
            (_, Key::Char('-')) => self.edit(setting, Some('-'), app),
            _ => self.edit(setting, None, app),
        }
    }

    /// Whether the change that was asked for has been made.
    fn is_taken(&self, setting: &Setting) -> bool {
        let sent = self.sent.as_ref();
        sent.is_some_and(|before| *before != setting.value)
    }

    fn type_on(&mut self, key: Key, setting: &Setting, app: &mut App) -> Answer {
        let Giving::Typed(line) = &mut self.giving else {
            return Answer::Stay;
        };
        match key {
            Key::Named(Named::Esc) => {
                self.giving = Giving::Nothing;
                self.sent = None;
            }
            Key::Named(Named::Enter) => {
                let value = setting.in_shown_unit(line.text().trim());
                return self.give(setting, value, app);
            }
            key => {
                line.press(key);
            }
        }
        Answer::Stay
    }

    fn choose(&mut self, key: Key, at: usize, setting: &Setting, app: &mut App) -> Answer {
        let words = setting.words().unwrap_or_default();
        let last = words.len().saturating_sub(1);
        match (key, command::of_key(key)) {
            (Key::Named(Named::Enter), _) => {
                let word = words.get(at).copied().unwrap_or_default();
                return self.give(setting, word.to_owned(), app);
            }
            (Key::Named(Named::Esc), _) => {
                self.giving = Giving::Nothing;
                self.sent = None;
            }
            (Key::Named(Named::Home), _) => self.giving = Giving::Chosen(0),
            (Key::Named(Named::End), _) => self.giving = Giving::Chosen(last),
            (_, Some(Command::Up | Command::PreviousPanel)) => {
                self.giving = Giving::Chosen(at.checked_sub(1).unwrap_or(last));
            }
            (_, Some(Command::Down | Command::NextPanel)) => {
                self.giving = Giving::Chosen((at + 1) % (last + 1));
            }
            (Key::Char(character), _) => {
                self.giving = Giving::Chosen(beginning_with(words, character, at));
            }
            _ => {}
        }
        Answer::Stay
    }

    /// Asks for a change to `value`, unless it is there already.
    fn give(&mut self, setting: &Setting, value: String, app: &mut App) -> Answer {
        let is_same = setting.value.as_ref() == Some(&value) || setting.shown(true) == value;
        if value.is_empty() || is_same {
            self.giving = Giving::Nothing;
            return Answer::Stay;
        }
        self.sent = Some(setting.value.clone());
        change(setting, value, app)
    }

    pub(super) fn draw(&self, app: &App, area: Rect, buffer: &mut Buffer) {
        let frame = app.frame.as_deref();
        let settings = frame.map_or(&[][..], |frame| frame.facts.settings.as_slice());
        let seen = self.seen(settings);
        let rows = (area.height / 2).clamp(8, 20);
        let title = match &seen {
            Some((_, _, Giving::Typed(_))) => "parameters (Enter applies, Esc cancels)".to_owned(),
            Some((_, setting, Giving::Chosen(_))) => {
                format!("{} (Enter takes, Esc cancels)", setting.parameter.path)
            }
            _ => "parameters (type or Enter: edit, + -: step, [: undo, Esc: close)".to_owned(),
        };
        let inside = docked(&app.theme, &title, (100, rows + 3), area, buffer);
        let Some((at, setting, giving)) = seen else {
            return;
        };
        let about = 3.min(inside.height);
        let [list, below] = Layout::vertical([Fill(1), Length(about)]).areas(inside);
        match giving {
            Giving::Chosen(word) => words(setting, word, app, list, buffer),
            giving => {
                let shown = settings.iter().enumerate();
                let first = first_shown(at, settings.len(), list.height);
                for ((i, setting), row) in shown.skip(first).zip(list.rows()) {
                    let typed = match &giving {
                        Giving::Typed(line) if i == at => Some(line),
                        _ => None,
                    };
                    value(setting, typed, i == at, app, row, buffer);
                }
            }
        }
        for (line, row) in about_it(setting, app).into_iter().zip(below.rows()) {
            line.render(row, buffer);
        }
    }
}

/// How a value begins to be given: chosen from words where it has some, with the text as it stands or
/// with what was typed in its place.
fn begin(setting: &Setting, typed: Option<char>) -> Giving {
    match (setting.words(), typed) {
        (Some(words), typed) => {
            let now = words
                .iter()
                .position(|word| setting.value.as_deref() == Some(word));
            let now = now.unwrap_or(0);
            Giving::Chosen(typed.map_or(now, |typed| beginning_with(words, typed, now)))
        }
        (None, Some(typed)) => Giving::Typed(LineEdit::new(&typed.to_string())),
        (None, None) => {
            let value = setting.value.as_ref().map(|_| setting.shown(true));
            Giving::Typed(LineEdit::new(&value.unwrap_or_default()))
        }
    }
}

/// The next word after `at` that begins with a character, around the end; `at` where none does.
fn beginning_with(words: &[&str], character: char, at: usize) -> usize {
    let mut following = (1..=words.len()).map(|places| (at + places) % words.len());
    let found = following.find(|&i| words[i].starts_with(character));
    found.unwrap_or(at)
}

/// A row of the list.
fn value(
    setting: &Setting,
    typed: Option<&LineEdit>,
    is_selected: bool,
    app: &App,
    row: Rect,
    buffer: &mut Buffer,
) {
    let path = format!(" {:1$}", setting.parameter.path, VALUES - 1);
    if let Some(line) = typed {
        typing(&path, line, app.theme.style(Role::Title)).render(row, buffer);
        let unit = match setting.typed_unit() {
            unit if unit.is_empty() => unit,
            unit => format!("{unit}, or with a unit "),
        };
        let unit = Line::raw(app.theme.printable(&unit));
        return unit.right_aligned().render(row, buffer);
    }
    let style = match setting.fixed() {
        Some(_) => app.theme.style(Role::Faint),
        None => Style::new(),
    };
    let shown = setting.shown(app.theme.ascii());
    Line::styled(format!("{path}{shown}"), style).render(row, buffer);
    if is_selected {
        buffer.set_style(row, app.theme.style(Role::Focus));
    }
}

/// The words of a choice, and what each is.
fn words(setting: &Setting, at: usize, app: &App, list: Rect, buffer: &mut Buffer) {
    let words = setting.words().unwrap_or_default();
    let quiet = app.theme.style(Role::Quiet);
    let width = words.iter().map(|word| word.len()).max().unwrap_or(0);
    let shown = words.iter().enumerate();
    let first = first_shown(at, words.len(), list.height);
    for ((i, word), row) in shown.skip(first).zip(list.rows()) {
        let is_now = setting.value.as_deref() == Some(*word);
        let mark = if is_now { '*' } else { ' ' };
        let meaning = meaning(setting.parameter.path, word).unwrap_or_default();
        let spans = vec![
            Span::raw(format!(" {mark} {word:width$}  ")),
            Span::styled(app.theme.printable(meaning), quiet),
        ];
        Line::from(spans).render(row, buffer);
        if i == at {
            buffer.set_style(row, app.theme.style(Role::Focus));
        }
    }
}

/// Meaning and range, effect, and what was answered to the last change.
fn about_it(setting: &Setting, app: &App) -> Vec<Line<'static>> {
    let quiet = app.theme.style(Role::Quiet);
    let told = match (&app.notice, setting.fixed()) {
        (Some(text), _) => Span::styled(app.theme.printable(text), app.theme.style(Role::Notice)),
        (None, Some(because)) => Span::styled(because, quiet),
        (None, None) => Span::styled(format!("must be {}", setting.rule()), quiet),
    };
    vec![
        Line::raw(format!(" {}", setting.parameter.meaning)),
        Line::styled(format!(" {}", setting.parameter.effect), quiet),
        Line::from(vec![Span::raw(" "), told]),
    ]
}

fn change(setting: &Setting, value: String, app: &mut App) -> Answer {
    let key = setting.parameter.path;
    app.order(move |run| run.change(key, &value));
    Answer::Stay
}
