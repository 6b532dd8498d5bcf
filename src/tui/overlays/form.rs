//! The parameters of the scenario, edited while it runs: value, unit, range and effect of each.

use ratatui::layout::Constraint::{Fill, Length};
use ratatui::prelude::*;
use ratatui::widgets::Paragraph;

use super::{
    Answer, App, Command, Frame, Key, LineEdit, docked, leave_for, list, select, settings, typing,
    watch,
};
use crate::tui::command;
use crate::tui::keys::Named;
use crate::tui::settings::Setting;
use crate::tui::theme::Role;

/// The selected parameter, and its value while that is given.
#[derive(Debug, Default)]
pub struct Form {
    at: usize,
    giving: Giving,
    /// The value before the change that was asked for, until the answer is seen: a refused text stays.
    sent: Option<Option<String>>,
}

/// How a value is being given.
#[derive(Debug, Clone, Default)]
enum Giving {
    /// Not at all: a parameter is chosen.
    #[default]
    Nothing,
    /// Typed.
    Typed(LineEdit),
    /// Chosen from its words, of which this one is selected.
    Chosen(usize),
}

/// What is done while the list stays open: the run can be watched from here, and an edit undone.
const WATCHED: &[Command] = &[
    Command::RunPause,
    Command::Cycle,
    Command::TimeBack,
    Command::TimeForth,
];

/// Where the values begin, in cells.
const VALUES: usize = 38;

impl Form {
    /// A form with the words of this key; `None` where the scenario does not have it.
    pub fn choosing(path: &str, frame: Option<&Frame>) -> Option<Self> {
        let settings = settings(frame);
        let is_sought = |setting: &Setting| setting.parameter.path == path;
        let at = settings.iter().position(is_sought)?;
        Some(Self {
            at,
            giving: begin(&settings[at], None),
            sent: None,
        })
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
        // Another shape has other keys: the list can have become shorter.
        let at = self.at.min(settings.len().saturating_sub(1));
        let setting = settings.get(at)?;
        // The change that was asked for has been made.
        let sent = self.sent.as_ref();
        let is_taken = sent.is_some_and(|before| *before != setting.value);
        let giving = match is_taken {
            true => Giving::Nothing,
            false => self.giving.clone(),
        };
        Some((at, setting, giving))
    }

    pub(super) fn press(&mut self, key: Key, app: &mut App) -> Answer {
        let frame = app.frame.clone();
        let settings = settings(frame.as_deref());
        let Some((at, setting, giving)) = self.seen(settings) else {
            return Answer::Close;
        };
        (self.at, self.giving) = (at, giving);
        let words = setting.words().unwrap_or_default();
        match (&mut self.giving, key) {
            (Giving::Nothing, key) => return self.choose(key, setting, settings.len(), app),
            (_, Key::Named(Named::Esc)) => (self.giving, self.sent) = (Giving::Nothing, None),
            (Giving::Typed(line), Key::Named(Named::Enter)) => {
                let value = setting.in_shown_unit(line.text().trim());
                return self.give(setting, value, app);
            }
            (Giving::Chosen(word), Key::Named(Named::Enter)) => {
                let value = words.get(*word).copied().unwrap_or_default();
                return self.give(setting, value.to_owned(), app);
            }
            (Giving::Typed(line), key) => {
                line.press(key);
            }
            (Giving::Chosen(word), key) => {
                if !select(word, words.len(), key)
                    && let Key::Char(character) = key
                {
                    *word = beginning_with(&words, character, *word);
                }
            }
        }
        Answer::Stay
    }

    /// Selects another parameter of `count`, or begins to give the value of the one that is selected.
    fn choose(&mut self, key: Key, setting: &Setting, count: usize, app: &mut App) -> Answer {
        self.sent = None;
        if select(&mut self.at, count, key) {
            return Answer::Stay;
        }
        match (key, command::of_key(key)) {
            (Key::Char('+' | '-' | '=') | Key::Named(Named::Left | Named::Right), Some(step)) => {
                let up = matches!(step, Command::Faster | Command::Right);
                self.step(key, up, setting, app)
            }
            (_, Some(Command::Back)) => Answer::Close,
            (Key::Char(' ' | ',' | '[' | ']'), Some(watched)) if WATCHED.contains(&watched) => {
                watch(Some(watched), &[], WATCHED, app)
            }
            (Key::Char('?' | ':'), other) => leave_for(other, app),
            (Key::Char(character), _) => self.edit(setting, Some(character), app),
            (_, Some(Command::Accept)) => self.edit(setting, None, app),
            (_, other) => leave_for(other, app),
        }
    }

    /// Begins to give the value, with the character typed.
    fn edit(&mut self, setting: &Setting, typed: Option<char>, app: &mut App) -> Answer {
        app.notice = setting.fixed();
        if app.notice.is_none() {
            self.giving = begin(setting, typed);
        }
        Answer::Stay
    }

    /// The next value of a parameter. Where there is none, the key is the first of a text.
    fn step(&mut self, key: Key, up: bool, setting: &Setting, app: &mut App) -> Answer {
        let next = setting.next(up).filter(|_| setting.fixed().is_none());
        match next {
            Some(value) if setting.value.as_ref() != Some(&value) => change(setting, value, app),
            _ => self.edit(setting, Some('-').filter(|_| key == Key::Char('-')), app),
        }
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
        let settings = settings(app.frame.as_deref());
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
        let [above, below] = Layout::vertical([Fill(1), Length(about)]).areas(inside);
        let focus = app.theme.style(Role::Focus);
        match giving {
            Giving::Chosen(word) => list(words(setting, app), word, focus, above, buffer),
            giving => {
                let mut lines: Vec<Line> = settings.iter().map(|of| value(of, app)).collect();
                let mut style = focus;
                if let Giving::Typed(line) = &giving {
                    lines[at] = typed(setting, line, above.width, app);
                    style = Style::new();
                }
                list(lines, at, style, above, buffer);
            }
        }
        Paragraph::new(about_it(setting, app)).render(below, buffer);
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
            Giving::Chosen(typed.map_or(now, |typed| beginning_with(&words, typed, now)))
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

/// The key of a setting as far as its value.
fn key(setting: &Setting) -> String {
    format!(" {:1$}", setting.parameter.path, VALUES - 1)
}

/// A row of the list.
fn value(setting: &Setting, app: &App) -> Line<'static> {
    let style = match setting.fixed() {
        Some(_) => app.theme.style(Role::Faint),
        None => Style::new(),
    };
    let shown = setting.shown(app.theme.ascii());
    Line::styled(key(setting) + &shown, style)
}

/// The row of a value that is typed, with the unit that it is in.
fn typed(setting: &Setting, line: &LineEdit, width: u16, app: &App) -> Line<'static> {
    let mut row = typing(&key(setting), line, app.theme.style(Role::Title));
    let unit = match setting.typed_unit() {
        unit if unit.is_empty() => unit,
        unit => app.theme.printable(&format!("{unit}, or with a unit ")),
    };
    let room = usize::from(width).saturating_sub(row.width());
    row.push_span(format!("{unit:>room$}"));
    row
}

/// The words of a choice, and what each is.
fn words<'a>(setting: &'a Setting, app: &'a App) -> impl Iterator<Item = Line<'a>> {
    let words = setting.words().unwrap_or_default();
    let quiet = app.theme.style(Role::Quiet);
    let width = words.iter().map(|word| word.len()).max().unwrap_or(0);
    words.into_iter().map(move |word| {
        let is_now = setting.value.as_deref() == Some(word);
        let mark = if is_now { '*' } else { ' ' };
        let meaning = setting.parameter.meaning_of(word).unwrap_or_default();
        Line::from(vec![
            Span::raw(format!(" {mark} {word:width$}  ")),
            Span::styled(app.theme.printable(meaning), quiet),
        ])
    })
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
