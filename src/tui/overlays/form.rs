//! The parameters of the scenario, edited while it runs: value, unit, range and effect of each.

use std::sync::Arc;

use super::*;
use crate::plot::theme::Theme;

/// The selected parameter, and its value while that is typed.
#[derive(Debug, Default)]
pub struct Form {
    at: usize,
    pub(super) typed: Option<LineEdit>,
    /// The value before the change that was asked for, until the answer is seen: a refused text stays.
    sent: Option<Option<String>>,
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
    /// The form as it is seen with these settings: which one is selected, and its value while that is typed.
    fn seen<'a>(&self, settings: &'a [Setting]) -> (usize, &'a Setting, Option<LineEdit>) {
        // Another shape has other keys: the list can have become shorter.
        let at = self.at.min(settings.len() - 1);
        let setting = &settings[at];
        // The change that was asked for has been made.
        let sent = self.sent.as_ref();
        let is_taken = sent.is_some_and(|before| *before != setting.value);
        (at, setting, self.typed.clone().filter(|_| !is_taken))
    }

    pub(super) fn press(&mut self, key: Key, explorer: &mut Explorer) -> Answer {
        let facts = Arc::clone(&explorer.frame.facts);
        let (at, setting, typed) = self.seen(&facts.settings);
        (self.at, self.typed) = (at, typed);
        match (&mut self.typed, key) {
            (None, key) => return self.choose(key, setting, facts.settings.len(), explorer),
            (_, Key::Named(Named::Esc)) => (self.typed, self.sent) = (None, None),
            (Some(line), Key::Named(Named::Enter)) => {
                let value = setting.in_shown_unit(line.text().trim());
                let is_same =
                    setting.value.as_ref() == Some(&value) || setting.shown(true) == value;
                if value.is_empty() || is_same {
                    self.typed = None;
                } else {
                    self.sent = Some(setting.value.clone());
                    change(setting, value, explorer);
                }
            }
            (Some(line), key) => _ = line.press(key),
        }
        Answer::Stay
    }

    /// Selects another parameter of `count`, or begins to give the value of the one that is selected.
    fn choose(
        &mut self,
        key: Key,
        setting: &Setting,
        count: usize,
        explorer: &mut Explorer,
    ) -> Answer {
        self.sent = None;
        if select(&mut self.at, count, key) {
            return Answer::Stay;
        }
        match (key, command::of_key(key)) {
            (Key::Char('+' | '-' | '=') | Key::Named(Named::Left | Named::Right), Some(step)) => {
                let up = matches!(step, Command::Faster | Command::Right);
                let next = setting.next(up).filter(|_| setting.fixed().is_none());
                let Some(next) = next.filter(|next| setting.value.as_ref() != Some(next)) else {
                    // Where there is no next value, the key is the first of a text.
                    let sign = Some('-').filter(|_| key == Key::Char('-'));
                    return self.edit(setting, sign, explorer);
                };
                change(setting, next, explorer);
                Answer::Stay
            }
            (_, Some(Command::Back)) => Answer::Close,
            (Key::Char(' ' | ',' | '[' | ']'), Some(watched)) if WATCHED.contains(&watched) => {
                Answer::Watch(watched)
            }
            (Key::Char('?' | ':'), other) => leave_for(other),
            (Key::Char(character), _) => self.edit(setting, Some(character), explorer),
            (_, Some(Command::Accept)) => self.edit(setting, None, explorer),
            (_, other) => leave_for(other),
        }
    }

    /// Begins to give the value: one of its words in the palette, else the text as it stands, or what was typed in its
    /// place.
    fn edit(&mut self, setting: &Setting, typed: Option<char>, explorer: &mut Explorer) -> Answer {
        explorer.notice = setting.fixed();
        if explorer.notice.is_some() {
            return Answer::Stay;
        }
        if setting.words().is_some() {
            return Answer::Open(Overlay::Palette(Palette::choosing(setting, typed)));
        }
        let now = setting.value.as_ref().map(|_| setting.shown(true));
        let text = typed.map(String::from).or(now);
        self.typed = Some(LineEdit::new(&text.unwrap_or_default()));
        Answer::Stay
    }

    pub(super) fn draw(&self, explorer: &Explorer, mut canvas: Canvas) {
        let settings = &explorer.frame.facts.settings;
        let (at, setting, line) = self.seen(settings);
        let rows = (canvas.area.height / 2).clamp(8, 20);
        let title = match &line {
            Some(_) => "parameters (Enter applies, Esc cancels)",
            None => "parameters (type or Enter: edit, + -: step, [: undo, Esc: close)",
        };
        let mut inside = canvas.docked(title, rows + 3);
        let theme = inside.theme;
        let rows = [Fill(1), Length(3.min(inside.area.height))];
        let [above, below] = Layout::vertical(rows).areas(inside.area);
        let mut lines: Vec<Line> = settings.iter().map(|of| value(of, &theme)).collect();
        let mut style = inside.style(Role::Focus);
        if let Some(line) = &line {
            lines[at] = typed(setting, line, above.width, &theme);
            style = Style::new();
        }
        inside.at(above).list(lines, at, style);
        let about = about_it(setting, explorer.notice.as_deref(), &theme);
        inside.at(below).show(Paragraph::new(about));
    }
}

/// The key of a setting as far as its value.
fn key(setting: &Setting) -> String {
    format!(" {:1$}", setting.parameter.path, VALUES - 1)
}

/// A row of the list.
fn value(setting: &Setting, theme: &Theme) -> Line<'static> {
    let style = match setting.fixed() {
        Some(_) => theme.style(Role::Faint),
        None => Style::new(),
    };
    let shown = setting.shown(theme.ascii());
    Line::styled(key(setting) + &shown, style)
}

/// The row of a value that is typed, with the unit that it is in.
fn typed(setting: &Setting, line: &LineEdit, width: u16, theme: &Theme) -> Line<'static> {
    let mut row = typing(&key(setting), line, theme.style(Role::Title));
    let unit = match setting.typed_unit() {
        unit if unit.is_empty() => unit,
        unit => theme.printable(&format!("{unit}, or with a unit ")),
    };
    let room = usize::from(width).saturating_sub(row.width());
    row.push_span(format!("{unit:>room$}"));
    row
}

/// Meaning and range, effect, and what was answered to the last change.
fn about_it(setting: &Setting, told: Option<&str>, theme: &Theme) -> Vec<Line<'static>> {
    let quiet = theme.style(Role::Quiet);
    let told = match (told, setting.fixed()) {
        (Some(text), _) => Span::styled(theme.printable(text), theme.style(Role::Notice)),
        (None, Some(because)) => Span::styled(because, quiet),
        (None, None) => {
            let (kind, allowed) = (setting.parameter.kind, setting.parameter.allowed());
            Span::styled(format!("must be {}{allowed}", kind.wanted()), quiet)
        }
    };
    vec![
        Line::raw(format!(" {}", setting.parameter.meaning)),
        Line::styled(format!(" {}", setting.parameter.effect), quiet),
        Line::from(vec![Span::raw(" "), told]),
    ]
}

fn change(setting: &Setting, value: String, explorer: &mut Explorer) {
    let key = setting.parameter.path;
    explorer.order(move |run| run.change(key, &value));
}
