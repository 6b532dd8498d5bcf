//! The parameters of the scenario, edited while it runs: the value, unit, range and effect of each.

use ratatui::layout::Constraint::{Fill, Length};
use ratatui::layout::Layout;
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use super::Overlay;
use crate::plot::theme::{Role, Theme};
use crate::scenario::value::Value;
use crate::tui::canvas::Canvas;
use crate::tui::command::{self, Command};
use crate::tui::explorer::Explorer;
use crate::tui::keys::{Keystroke, Named};
use crate::tui::line::LineEdit;
use crate::tui::overlays::answer::{Answer, select, typing};
use crate::tui::overlays::palette::Palette;
use crate::tui::settings::Setting;
use crate::tui::stage::LIST;
use crate::tui::worker::{Order, changes};

/// The list, and the selected parameter's value while it is being typed.
#[derive(Debug, Default)]
pub struct Form {
    /// The index of the selected parameter among those that pass the filter.
    at: usize,
    /// The text typed to find a parameter.
    pub(super) filter: LineEdit,
    /// The value being typed, if any.
    pub(super) typed: Option<LineEdit>,
    /// The value before the requested change, until the answer is known: if the change is refused, the typed text
    /// stays.
    sent: Option<Option<Value>>,
}

/// Commands that run while the list stays open: the run can be watched, and an edit undone.
const WATCHED: &[Command] = &[
    Command::RunPause,
    Command::Cycle,
    Command::TimeBack,
    Command::TimeForth,
];

/// The width of the keys, in cells; the second is for a narrow list or one next to the panels.
const KEYS: usize = 38;
const BRIEF: usize = 30;

/// Minimum width for whole keys and a title with all of the keys.
const WIDE: u16 = 76;

/// The rows of the description below the list; the second is for the list next to the panels.
const BELOW: u16 = 4;
const NEXT_TO_PANELS: u16 = 6;

impl Form {
    /// Returns the settings that pass the filter.
    fn fitting<'a>(&self, settings: &'a [Setting]) -> Vec<&'a Setting> {
        let fits = |of: &&Setting| {
            let known = of.key;
            self.filter
                .fits(&[known.path, known.meaning, known.effect].join(" "))
        };
        settings.iter().filter(fits).collect()
    }

    /// Returns the selected setting with its index, and its value if being typed; `None` if the list is empty.
    fn selected<'a>(
        &self,
        settings: &[&'a Setting],
    ) -> Option<(usize, &'a Setting, Option<LineEdit>)> {
        // Another indenter shape has other keys, so the list may have become shorter.
        let at = self.at.min(settings.len().checked_sub(1)?);
        let setting = settings[at];
        // The requested change has been made.
        let sent = self.sent.as_ref();
        let is_taken = sent.is_some_and(|before| *before != setting.value);
        Some((at, setting, self.typed.clone().filter(|_| !is_taken)))
    }

    pub(super) fn press(&mut self, key: Keystroke, explorer: &mut Explorer) -> Answer {
        let known = explorer.frame.settings();
        let settings = self.fitting(&known);
        let Some((at, setting, typed)) = self.selected(&settings) else {
            return self.edit_filter(key);
        };
        (self.at, self.typed) = (at, typed);
        match (&mut self.typed, key) {
            (None, key) => return self.choose(key, setting, settings.len(), explorer),
            (_, Keystroke::Named(Named::Esc)) => (self.typed, self.sent) = (None, None),
            (Some(line), Keystroke::Named(Named::Enter)) => {
                let value = line.text().trim().to_owned();
                let is_same =
                    setting.text().as_ref() == Some(&value) || setting.shown(true) == value;
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

    /// Handles a key that filters the parameters or closes the list.
    fn edit_filter(&mut self, key: Keystroke) -> Answer {
        if command::of_key(key) == Some(Command::Back) {
            return Answer::Close;
        }
        if self.filter.filter(key) {
            self.at = 0;
        }
        Answer::Stay
    }

    /// Selects another of `count` parameters, or changes or edits the selected one. `+` and `-` change it only while
    /// nothing is typed.
    fn choose(
        &mut self,
        key: Keystroke,
        setting: &Setting,
        count: usize,
        explorer: &mut Explorer,
    ) -> Answer {
        self.sent = None;
        if select(&mut self.at, count, key) {
            return Answer::Stay;
        }
        let is_free = self.filter.is_empty();
        match (key, command::of_key(key)) {
            (Keystroke::Named(Named::Right), _) => step(setting, true, explorer),
            (Keystroke::Named(Named::Left), _) => step(setting, false, explorer),
            (Keystroke::Char('+' | '='), _) if is_free => step(setting, true, explorer),
            (Keystroke::Char('-'), _) if is_free => step(setting, false, explorer),
            (Keystroke::Named(Named::Enter), _) => return self.edit(setting, explorer),
            (_, Some(watched)) if is_free && WATCHED.contains(&watched) => {
                return Answer::Watch(watched);
            }
            _ => return self.edit_filter(key),
        }
        Answer::Stay
    }

    /// Begins to edit the value: a choice opens the palette, anything else its text.
    fn edit(&mut self, setting: &Setting, explorer: &mut Explorer) -> Answer {
        explorer.notice = setting.fixed();
        if explorer.notice.is_some() {
            return Answer::Stay;
        }
        if setting.words().is_some() {
            return Answer::Open(Overlay::Palette(Palette::choosing(setting)));
        }
        let now = setting.value.as_ref().map(|_| setting.shown(true));
        self.typed = Some(LineEdit::new(&now.unwrap_or_default()));
        Answer::Stay
    }

    pub(super) fn draw(&self, explorer: &Explorer, mut canvas: Canvas) {
        let known = explorer.frame.settings();
        let settings = self.fitting(&known);
        let seen = self.selected(&settings);
        let filter = self.filter.text();
        let is_typed = matches!(seen, Some((.., Some(_))));
        let is_next_to_panels = canvas.area.width <= LIST;
        let is_narrow = canvas.area.width < WIDE;
        let title = match filter.as_str() {
            _ if is_typed => "parameters (Enter applies, Esc cancels)".to_owned(),
            "" if is_narrow => "parameters (type: find, + -: step)".to_owned(),
            "" => "parameters (type: find, Enter: edit, + -: step, [: undo, Esc: close)".to_owned(),
            filter => format!("parameters: {filter} (Enter: edit, arrows: step)"),
        };
        let rows = (canvas.area.height / 2).clamp(8, 20);
        let (mut inside, described) = if is_next_to_panels {
            (canvas.popup(&title, (LIST, u16::MAX)), NEXT_TO_PANELS)
        } else {
            (canvas.docked(&title, rows + BELOW), BELOW)
        };
        let Some((at, setting, line)) = seen else {
            return inside.write_text("no parameter has that", Role::Quiet);
        };
        let theme = inside.theme;
        let rows = [Fill(1), Length(described.min(inside.area.height))];
        let [above, below] = Layout::vertical(rows).areas(inside.area);
        let room = if is_narrow { BRIEF } else { KEYS };
        let key = |setting: &Setting| key(setting.key.path, room);
        let mut lines: Vec<Line> = settings
            .iter()
            .map(|of| value(key(of), of, &theme))
            .collect();
        let mut style = inside.style(Role::Focus);
        if let Some(line) = &line {
            lines[at] = typed(&key(setting), setting, line, above.width, &theme);
            style = Style::new();
        }
        inside.at(above).list(lines, at, style);
        let about = describe(setting, explorer.notice.as_deref(), &theme);
        inside.at(below).indented().write(about);
    }
}

/// Changes to the next value up or down, if there is one.
fn step(setting: &Setting, up: bool, explorer: &mut Explorer) {
    explorer.notice = setting.fixed();
    let next = setting.next(up).filter(|_| setting.fixed().is_none());
    if let Some(next) = next.filter(|next| setting.text().as_ref() != Some(next)) {
        change(setting, next, explorer);
    }
}

/// Shortens a key to this width: its end says more than its beginning.
fn key(path: &str, room: usize) -> String {
    let mut path = path;
    while path.len() + 2 > room
        && let Some((_, rest)) = path.split_once('.')
    {
        path = rest;
    }
    format!(" {:1$}", path, room - 1)
}

/// Returns a row of the list.
fn value(key: String, setting: &Setting, theme: &Theme) -> Line<'static> {
    let style = match setting.fixed() {
        Some(_) => theme.style(Role::Faint),
        None => Style::new(),
    };
    let shown = setting.shown(theme.ascii());
    Line::styled(key + &shown, style)
}

/// Returns the row of a value being typed, with its unit.
fn typed(
    key: &str,
    setting: &Setting,
    line: &LineEdit,
    width: u16,
    theme: &Theme,
) -> Line<'static> {
    let mut row = typing(key, line, theme.style(Role::Title));
    let unit = theme.printable(&format!("{} ", setting.typed_unit()));
    let room = usize::from(width).saturating_sub(row.width());
    row.push_span(format!("{unit:>room$}"));
    row
}

/// Returns the meaning and range of a setting, its effect, and the answer to the last change.
fn describe(setting: &Setting, notice: Option<&str>, theme: &Theme) -> Vec<Line<'static>> {
    let quiet = theme.style(Role::Quiet);
    let hint = match (notice, setting.fixed()) {
        (Some(text), _) => Span::styled(theme.printable(text), theme.style(Role::Notice)),
        (None, Some(because)) => Span::styled(because, quiet),
        (None, None) => {
            let (kind, allowed) = (setting.key.kind, setting.key.allowed());
            Span::styled(format!("must be {}{allowed}", kind.wanted()), quiet)
        }
    };
    vec![
        Line::raw(setting.key.meaning),
        Line::from(hint),
        Line::styled(setting.key.effect, quiet),
    ]
}

fn change(setting: &Setting, value: String, explorer: &mut Explorer) {
    let key = setting.key.path;
    explorer.order(Order::ChangeWithGhost(changes::set(key, value)));
}
