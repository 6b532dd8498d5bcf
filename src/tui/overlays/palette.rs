//! The palette: every command by name, and every scenario key by `set KEY=VALUE`, with completion.

use std::path::Path;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::{Answer, App, Command, Frame, Key, LineEdit, docked, first_shown, typing};
use crate::scenario::preset;
use crate::scenario::schema::Kind;
use crate::scenario::words::meaning;
use crate::tui::command::BINDINGS;
use crate::tui::keys::Named;
use crate::tui::map::live::{POINTS, Range};
use crate::tui::order::Order;
use crate::tui::settings::Setting;
use crate::tui::theme::Role;

/// The line being typed, and which of its completions is selected.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Palette {
    line: LineEdit,
    at: usize,
}

/// What a completion does when accepted.
#[derive(Debug, Clone, PartialEq)]
enum Act {
    /// A command of the table.
    Command(Command),
    /// More must be typed.
    Complete,
    /// A key gets a value.
    Set(String, String),
    /// Another scenario.
    Load(String),
    /// Many values of a key.
    Sweep(Range),
    /// A figure in a file.
    Figure(String),
    /// Curves over the plots.
    Overlay(String),
}

/// One completion of the typed text.
#[derive(Debug, Clone, PartialEq)]
struct Completion {
    /// The whole line.
    line: String,
    /// What it means.
    help: String,
    /// What stands on the right: a key, or a value and its unit.
    right: String,
    act: Act,
}

/// Commands that make no sense by name: they move within lists.
fn is_listed(command: Command) -> bool {
    !matches!(command, Command::Palette | Command::Accept | Command::Back)
}

/// The completions, most likely first.
fn completions(typed: &str, frame: Option<&Frame>) -> Vec<Completion> {
    let typed = typed.trim_start();
    if let Some(assignment) = typed.strip_prefix("set ") {
        return settings(assignment.trim_start(), frame);
    }
    if let Some(range) = typed.strip_prefix("sweep ") {
        return sweeps(range.trim_start(), frame);
    }
    if let Some(name) = typed.strip_prefix("load ") {
        return loads(name.trim());
    }
    if let Some(given) = typed.strip_prefix("overlay ") {
        return overlays(given.trim());
    }
    if let Some(name) = typed.strip_prefix("figure ").map(str::trim) {
        let act = match name.is_empty() {
            true => Act::Complete,
            false => Act::Figure(name.to_owned()),
        };
        return vec![Completion {
            line: format!("figure {name}"),
            help: "a figure of this state: a file that ends in .svg, .png or .pdf".into(),
            right: String::new(),
            act,
        }];
    }
    let mut list: Vec<(usize, Completion)> = Vec::new();
    let words = [
        (
            "set ",
            "change keys of the scenario: set KEY=VALUE, KEY=VALUE",
        ),
        ("load ", "another preset, or a file: load NAME"),
        (
            "sweep ",
            "run many values of a key up to this cycle: sweep KEY FROM..TO",
        ),
        ("figure ", "draw this state for a paper: figure FILE.svg"),
        (
            "overlay ",
            "data, a run or a scenario over the plots: overlay FILE",
        ),
    ];
    for (word, help) in words {
        if let Some(rank) = rank(typed, word.trim_end(), help) {
            list.push((
                rank,
                Completion {
                    line: word.into(),
                    help: help.into(),
                    right: String::new(),
                    act: Act::Complete,
                },
            ));
        }
    }
    for binding in BINDINGS.iter().filter(|known| is_listed(known.command)) {
        if let Some(rank) = rank(typed, binding.name, binding.help) {
            list.push((
                rank,
                Completion {
                    line: binding.name.into(),
                    help: binding.help.into(),
                    right: binding.keys[0].to_string(),
                    act: Act::Command(binding.command),
                },
            ));
        }
    }
    // A key of the scenario is found without `set` as well.
    if typed.len() >= 2 {
        let settings = settings(typed, frame).into_iter();
        list.extend(settings.map(|setting| (3, setting)));
        let sweeps = sweeps(typed, frame).into_iter();
        let is_key = !typed.trim_end().contains(' ');
        let sweeps = sweeps.filter(|sweep| is_key && sweep.act == Act::Complete);
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
fn settings(typed: &str, frame: Option<&Frame>) -> Vec<Completion> {
    let known = frame.map_or(&[][..], |frame| frame.settings.as_slice());
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
        return fitting
            .into_iter()
            .map(|setting| Completion {
                line: format!("set {}=", setting.parameter.path),
                help: setting.parameter.meaning.to_owned(),
                right: setting.shown(true),
                act: Act::Complete,
            })
            .collect();
    };
    let (key, value) = (key.trim(), value.trim());
    let found = known.iter().find(|setting| setting.parameter.path == key);
    let mut list = Vec::new();
    let set = |value: &str, help: String, right: String| Completion {
        line: format!("set {key}={value}"),
        help,
        right,
        act: Act::Set(key.to_owned(), value.to_owned()),
    };
    let words = found.and_then(Setting::words).unwrap_or_default();
    let begun = words.iter().filter(|word| word.starts_with(value));
    let meaning = |word: &str| meaning(key, word).unwrap_or_default().to_owned();
    list.extend(begun.map(|word| set(word, meaning(word), String::new())));
    if list.is_empty() {
        let help = found.map(|setting| setting.parameter.described());
        let now = found.map(|setting| format!("now {}", setting.shown(true)));
        let mut typed = set(value, help.unwrap_or_default(), now.unwrap_or_default());
        if value.is_empty() {
            typed.act = Act::Complete;
        }
        list.push(typed);
    }
    list
}

/// `KEY`, or `KEY FROM..TO`.
fn sweeps(typed: &str, frame: Option<&Frame>) -> Vec<Completion> {
    let known = frame.map_or(&[][..], |frame| frame.settings.as_slice());
    let is_number =
        |setting: &&Setting| matches!(setting.parameter.kind, Kind::Number | Kind::Whole);
    let keys = known.iter().filter(is_number);
    let keys: Vec<_> = keys
        .map(|setting| (setting.parameter.path, setting.unit))
        .collect();
    if let Some(range) = Range::parse(typed, &keys) {
        return vec![Completion {
            line: format!("sweep {typed}"),
            help: format!("runs {POINTS} values on all cores and shows the curve"),
            right: String::new(),
            act: Act::Sweep(range),
        }];
    }
    let key = typed.split([' ', '=']).next().unwrap_or_default();
    let numbers = known.iter().filter(is_number);
    let numbers = numbers.filter(|setting| setting.parameter.path.contains(key));
    let completion = |path: &str, help: &str, right: String| Completion {
        line: format!("sweep {path} "),
        help: format!("FROM..TO: {help}"),
        right,
        act: Act::Complete,
    };
    numbers
        .map(|setting| {
            completion(
                setting.parameter.path,
                setting.parameter.meaning,
                setting.shown(true),
            )
        })
        .collect()
}

/// Presets by name; anything else is taken for a file.
fn loads(typed: &str) -> Vec<Completion> {
    let load = |name: &str, help: String| Completion {
        line: format!("load {name}"),
        help,
        right: String::new(),
        act: Act::Load(name.to_owned()),
    };
    let fitting = preset::ALL
        .iter()
        .filter(|preset| preset.name.contains(typed));
    let mut list: Vec<_> = fitting
        .map(|preset| load(preset.name, preset.title().to_owned()))
        .collect();
    if list.is_empty() && !typed.is_empty() {
        list.push(load(
            typed,
            "a preset's name, or a path to a .toml file".into(),
        ));
    }
    list
}

/// Any file or directory; a preset by its name.
fn overlays(typed: &str) -> Vec<Completion> {
    let overlay = |given: &str, help: &str, act: Act| Completion {
        line: format!("overlay {given}"),
        help: help.to_owned(),
        right: String::new(),
        act,
    };
    let is_path = typed.contains(['/', '.']);
    let fitting = preset::ALL
        .iter()
        .filter(|preset| !is_path && preset.name.contains(typed));
    let presets = fitting.map(|preset| {
        let act = Act::Overlay(preset.name.to_owned());
        overlay(preset.name, preset.title(), act)
    });
    let act = match typed.is_empty() {
        true => Act::Complete,
        false => Act::Overlay(typed.to_owned()),
    };
    let help = "a CSV file, a run's directory, or a scenario";
    let mut list = vec![overlay(typed, help, act)];
    list.extend(presets);
    // What is typed comes first, unless it can only be the beginning of a preset's name.
    let is_begun = list.len() > 1 && !Path::new(typed).exists();
    list.rotate_left(usize::from(is_begun && !typed.is_empty()));
    list
}

impl Palette {
    /// The typed text.
    pub(super) fn line(&mut self) -> &mut LineEdit {
        &mut self.line
    }

    pub(super) fn press(&mut self, key: Key, frame: Option<&Frame>) -> Answer {
        let list = completions(&self.line.text(), frame);
        let selected = list.get(self.at.min(list.len().saturating_sub(1)));
        match (key, selected) {
            (Key::Named(Named::Esc), _) => return Answer::Close,
            (Key::Named(Named::Backspace), _) if self.line.is_empty() => return Answer::Close,
            (Key::Named(Named::Up | Named::BackTab) | Key::Ctrl('p'), _) => {
                self.at = self
                    .at
                    .checked_sub(1)
                    .unwrap_or(list.len().saturating_sub(1));
            }
            (Key::Named(Named::Down) | Key::Ctrl('n'), _) => {
                self.at = (self.at + 1) % list.len().max(1);
            }
            (Key::Named(Named::Tab), Some(selected)) => self.take(&selected.line),
            (Key::Named(Named::Enter), Some(selected)) => match selected.act.clone() {
                Act::Command(command) => return Answer::Through(command),
                Act::Complete => self.take(&selected.line),
                Act::Set(key, value) => return Answer::Order(Order::Change { key, value }),
                Act::Load(name) => return Answer::Load(name),
                Act::Sweep(range) => return Answer::Order(Order::Sweep(range)),
                Act::Overlay(given) => return Answer::Order(Order::Overlay(given)),
                Act::Figure(name) => return Answer::Order(Order::Figure(name.into())),
            },
            (Key::Named(Named::Enter), None) => {
                let typed = self.line.text();
                return Answer::Say(format!("no such command: {}", typed.trim()));
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
        let inside = docked(app, title, (100, rows + 3), area, buffer);
        let [quiet, focus] = [Role::Quiet, Role::Focus].map(|role| app.theme.style(role));
        typing(" :", &self.line, app.theme.style(Role::Title)).render(inside, buffer);
        let at = self.at.min(list.len().saturating_sub(1));
        let shown = list.iter().enumerate();
        let below = Rect {
            y: inside.y + 1,
            height: inside.height.saturating_sub(1),
            ..inside
        };
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
