//! The palette: every command by name, and every scenario key by `set KEY=VALUE`, with completion.

use std::path::{Path, PathBuf};

use ratatui::buffer::Buffer;
use ratatui::layout::Constraint::{Fill, Length};
use ratatui::layout::{Layout, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::{Answer, App, Command, Frame, Key, LineEdit, docked, first_shown, typing};
use crate::scenario::preset;
use crate::scenario::schema::Kind;
use crate::scenario::words::meaning;
use crate::tui::command::{Act, COMMANDS};
use crate::tui::keys::Named;
use crate::tui::map::live::{POINTS, Range};
use crate::tui::settings::Setting;
use crate::tui::theme::Role;

/// The line being typed, and which of its completions is selected.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Palette {
    line: LineEdit,
    at: usize,
}

type Deed = Box<dyn FnOnce(&mut App)>;

/// One completion of the typed text.
pub struct Completion {
    /// The whole line.
    line: String,
    /// What it means.
    help: String,
    /// What stands on the right: a key, or a value and its unit.
    right: String,
    /// What it does when accepted; `None` while more must be typed.
    act: Option<Deed>,
}

impl Completion {
    fn new(line: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            line: line.into(),
            help: help.into(),
            right: String::new(),
            act: None,
        }
    }

    fn with_right(self, right: impl Into<String>) -> Self {
        let right = right.into();
        Self { right, ..self }
    }

    fn doing(mut self, act: impl FnOnce(&mut App) + 'static) -> Self {
        self.act = Some(Box::new(act));
        self
    }
}

/// The completions, most likely first.
fn completions(typed: &str, frame: Option<&Frame>) -> Vec<Completion> {
    let typed = typed.trim_start();
    let mut list: Vec<(usize, Completion)> = Vec::new();
    for row in COMMANDS {
        // These make no sense by name: they move within lists.
        if matches!(
            row.command,
            Command::Palette | Command::Accept | Command::Back
        ) {
            continue;
        }
        let completion = match row.act {
            Act::Palette(complete) => {
                let argument = typed.strip_prefix(row.name);
                if let Some(argument) = argument.and_then(|rest| rest.strip_prefix(' ')) {
                    return complete(argument.trim(), frame);
                }
                Completion::new(format!("{} ", row.name), row.help)
            }
            _ => Completion::new(row.name, row.help)
                .with_right(row.keys[0].to_string())
                .doing(|app| app.run(row.command)),
        };
        list.extend(rank(typed, row.name, row.help).map(|rank| (rank, completion)));
    }
    // A key of the scenario is found without `set` as well.
    if typed.len() >= 2 {
        let settings = settings(typed, frame).into_iter();
        list.extend(settings.map(|setting| (3, setting)));
        let sweeps = sweeps(typed, frame).into_iter();
        let is_key = !typed.trim_end().contains(' ');
        let sweeps = sweeps.filter(|sweep| is_key && sweep.act.is_none());
        list.extend(sweeps.map(|sweep| (4, sweep)));
    }
    list.sort_by_key(|(rank, _)| *rank);
    list.into_iter().map(|(_, completion)| completion).collect()
}

/// How well `typed` matches: at the start of a name, within it, or within its help.
fn rank(typed: &str, name: &str, help: &str) -> Option<usize> {
    let typed = typed.trim_end().to_lowercase();
    let position = [
        name.starts_with(&typed),
        name.contains(&typed),
        help.contains(&typed),
    ];
    position.into_iter().position(|fits| fits)
}

/// `KEY`, or `KEY=` with the values that the key takes.
pub fn settings(typed: &str, frame: Option<&Frame>) -> Vec<Completion> {
    let known = frame.map_or(&[][..], |frame| frame.facts.settings.as_slice());
    let Some((key, value)) = typed.split_once('=') else {
        let typed = typed.trim_end();
        let mut fitting: Vec<_> = known
            .iter()
            .filter(|setting| setting.parameter.path.contains(typed))
            .collect();
        // Where a key begins, or a part of it after a dot, is likelier than its middle.
        fitting.sort_by_key(|setting| {
            let path = setting.parameter.path;
            !(path.starts_with(typed) || path.contains(&format!(".{typed}")))
        });
        let completion = |setting: &Setting| {
            let line = format!("set {}=", setting.parameter.path);
            Completion::new(line, setting.parameter.meaning).with_right(setting.shown(true))
        };
        return fitting.into_iter().map(completion).collect();
    };
    let (key, value) = (key.trim(), value.trim());
    let found = known.iter().find(|setting| setting.parameter.path == key);
    let set = |value: &str, help: String| {
        let (key, given) = (key.to_owned(), value.to_owned());
        Completion::new(format!("set {key}={value}"), help)
            .doing(move |app| app.order(move |run| run.change(&key, &given)))
    };
    let words = found.and_then(Setting::words).unwrap_or_default();
    let begun = words.iter().filter(|word| word.starts_with(value));
    let meaning = |word: &str| meaning(key, word).unwrap_or_default().to_owned();
    let list: Vec<_> = begun.map(|word| set(word, meaning(word))).collect();
    if !list.is_empty() {
        return list;
    }
    let help = found.map(|setting| setting.parameter.described());
    let now = found.map(|setting| format!("now {}", setting.shown(true)));
    let mut typed = set(value, help.unwrap_or_default()).with_right(now.unwrap_or_default());
    typed.act = typed.act.filter(|_| !value.is_empty());
    vec![typed]
}

/// `KEY`, or `KEY FROM..TO`.
pub fn sweeps(typed: &str, frame: Option<&Frame>) -> Vec<Completion> {
    let known = frame.map_or(&[][..], |frame| frame.facts.settings.as_slice());
    let numbers = known
        .iter()
        .filter(|setting| matches!(setting.parameter.kind, Kind::Number | Kind::Whole));
    let keys = numbers.clone();
    let keys: Vec<_> = keys
        .map(|setting| (setting.parameter.path, setting.unit))
        .collect();
    if let Some(range) = Range::parse(typed, &keys) {
        let help = format!("runs {POINTS} values on all cores and shows the curve");
        let sweep = Completion::new(format!("sweep {typed}"), help)
            .doing(move |app| app.order(move |run| run.sweep(&range)));
        return vec![sweep];
    }
    let key = typed.split([' ', '=']).next().unwrap_or_default();
    let numbers = numbers.filter(|setting| setting.parameter.path.contains(key));
    let completion = |setting: &Setting| {
        let line = format!("sweep {} ", setting.parameter.path);
        Completion::new(line, format!("FROM..TO: {}", setting.parameter.meaning))
            .with_right(setting.shown(true))
    };
    numbers.map(completion).collect()
}

/// A file to draw into.
pub fn figures(typed: &str, _: Option<&Frame>) -> Vec<Completion> {
    let help = "a figure of this state: a file that ends in .svg, .png or .pdf";
    let path = PathBuf::from(typed);
    let mut figure = Completion::new(format!("figure {typed}"), help)
        .doing(move |app| app.order(move |run| run.write_figure(&path)));
    figure.act = figure.act.filter(|_| !typed.is_empty());
    vec![figure]
}

/// Presets by name; anything else is taken for a file.
pub fn presets(typed: &str, _: Option<&Frame>) -> Vec<Completion> {
    let load = |name: &str, help: &str| {
        let line = format!("load {name}");
        let name = name.to_owned();
        Completion::new(line, help).doing(move |app| app.load(&name))
    };
    let fitting = preset::ALL
        .iter()
        .filter(|preset| preset.name.contains(typed));
    let mut list: Vec<_> = fitting
        .map(|preset| load(preset.name, preset.title()))
        .collect();
    if list.is_empty() {
        list.push(load(typed, "a preset's name, or a path to a .toml file"));
    }
    list
}

/// Any file or directory; a preset by its name.
pub fn overlays(typed: &str, _: Option<&Frame>) -> Vec<Completion> {
    let overlay = |given: &str, help: &str| {
        let line = format!("overlay {given}");
        let given = given.to_owned();
        Completion::new(line, help).doing(move |app| app.order(move |run| run.overlay(&given)))
    };
    let is_path = typed.contains(['/', '.']);
    let fitting = preset::ALL
        .iter()
        .filter(|preset| !is_path && preset.name.contains(typed));
    let presets = fitting.map(|preset| overlay(preset.name, preset.title()));
    let mut any = overlay(typed, "a CSV file, a run's directory, or a scenario");
    any.act = any.act.filter(|_| !typed.is_empty());
    let mut list = vec![any];
    list.extend(presets);
    // What is typed comes first, unless it can only be the beginning of a preset's name.
    let is_begun = list.len() > 1 && !Path::new(typed).exists();
    list.rotate_left(usize::from(is_begun && !typed.is_empty()));
    list
}

impl Palette {
    /// The palette with a command typed, its argument still missing.
    pub fn begun(name: &str) -> Self {
        Self {
            line: LineEdit::new(&format!("{name} ")),
            at: 0,
        }
    }

    /// The typed text.
    pub(super) fn line(&mut self) -> &mut LineEdit {
        &mut self.line
    }

    pub(super) fn press(&mut self, key: Key, app: &mut App) -> Answer {
        let mut list = completions(&self.line.text(), app.frame.as_deref());
        let last = list.len().saturating_sub(1);
        let at = self.at.min(last);
        match (key, list.get_mut(at)) {
            (Key::Named(Named::Esc), _) => return Answer::Close,
            (Key::Named(Named::Backspace), _) if self.line.is_empty() => return Answer::Close,
            (Key::Named(Named::Up | Named::BackTab) | Key::Ctrl('p'), _) => {
                self.at = self.at.checked_sub(1).unwrap_or(last);
            }
            (Key::Named(Named::Down) | Key::Ctrl('n'), _) => self.at = (self.at + 1) % (last + 1),
            (Key::Named(Named::Tab), Some(selected)) => self.take(&selected.line),
            (Key::Named(Named::Enter), Some(selected)) => match selected.act.take() {
                Some(act) => {
                    act(app);
                    return Answer::Close;
                }
                None => self.take(&selected.line),
            },
            (Key::Named(Named::Enter), None) => {
                let typed = self.line.text();
                app.notice = Some(format!("no such command: {}", typed.trim()));
            }
            _ if self.line.press(key) => self.at = 0,
            _ => {}
        }
        Answer::Stay
    }

    fn take(&mut self, line: &str) {
        self.line = LineEdit::new(line);
        self.at = 0;
    }

    pub(super) fn draw(&self, app: &App, area: Rect, buffer: &mut Buffer) {
        let list = completions(&self.line.text(), app.frame.as_deref());
        let rows = (area.height / 2).clamp(6, 12);
        let title = "commands (Tab completes, Enter runs, Esc closes)";
        let inside = docked(&app.theme, title, (100, rows + 3), area, buffer);
        let [quiet, focus] = [Role::Quiet, Role::Focus].map(|role| app.theme.style(role));
        typing(" :", &self.line, app.theme.style(Role::Title)).render(inside, buffer);
        let at = self.at.min(list.len().saturating_sub(1));
        let shown = list.iter().enumerate();
        let [_, below] = Layout::vertical([Length(1), Fill(1)]).areas(inside);
        for ((i, completion), row) in shown
            .skip(first_shown(at, list.len(), below.height))
            .zip(below.rows())
        {
            let name = Span::raw(format!(" {:22} ", completion.line));
            let right = format!(" {} ", completion.right);
            let room = usize::from(row.width)
                .saturating_sub(name.width() + Span::raw(right.as_str()).width());
            let help: String = completion.help.chars().take(room).collect();
            Line::from(vec![name, Span::styled(help, quiet)]).render(row, buffer);
            Line::styled(right, app.theme.style(Role::Title))
                .right_aligned()
                .render(row, buffer);
            if i == at {
                buffer.set_style(row, focus);
            }
        }
        if list.is_empty() {
            Line::styled(" no such command", quiet).render(below, buffer);
        }
    }
}
