//! The palette: every command by name, and every scenario key by `set KEY=VALUE`, with completion.

use std::path::Path;

use ratatui::layout::Constraint::{Fill, Length};
use ratatui::prelude::*;

use super::{Answer, App, Command, Frame, Key, LineEdit, docked, list, select, settings, typing};
use crate::scenario::preset::{self, Preset};
use crate::scenario::schema::Kind;
use crate::tui::command::{Act, COMMANDS};
use crate::tui::keys::Named;
use crate::tui::map::live::{POINTS, Range};
use crate::tui::settings::Setting;
use crate::tui::theme::Role;

/// The line being typed, and which of its completions is selected.
#[derive(Debug, Default)]
pub struct Palette {
    pub(super) line: LineEdit,
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
        let changes = changes(typed, frame).into_iter();
        list.extend(changes.map(|change| (3, change)));
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
pub fn changes(typed: &str, frame: Option<&Frame>) -> Vec<Completion> {
    let known = settings(frame);
    let Some((key, value)) = typed.split_once('=') else {
        return keys(known.iter(), typed.trim_end(), |setting| {
            let line = format!("set {}=", setting.parameter.path);
            Completion::new(line, setting.parameter.meaning)
        });
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
    let meaning = |word: &str| found?.parameter.meaning_of(word);
    let list: Vec<_> = begun
        .map(|word| set(word, meaning(word).unwrap_or_default().to_owned()))
        .collect();
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
    let numbers = settings(frame)
        .iter()
        .filter(|setting| matches!(setting.parameter.kind, Kind::Number | Kind::Whole));
    let units = numbers.clone();
    let units: Vec<_> = units
        .map(|setting| (setting.parameter.path, setting.unit))
        .collect();
    if let Some(range) = Range::parse(typed, &units) {
        let help = format!("runs {POINTS} values on all cores and shows the curve");
        let sweep = Completion::new(format!("sweep {typed}"), help)
            .doing(move |app| app.order(move |run| run.sweep(&range)));
        return vec![sweep];
    }
    let key = typed.split([' ', '=']).next().unwrap_or_default();
    keys(numbers, key, |setting| {
        let line = format!("sweep {} ", setting.parameter.path);
        Completion::new(line, format!("FROM..TO: {}", setting.parameter.meaning))
    })
}

/// The keys that have a text, with their values. Where a key begins with it, or a part of the key after a dot, the key
/// is likelier than where its middle has it.
fn keys<'a>(
    known: impl Iterator<Item = &'a Setting>,
    text: &str,
    completion: fn(&Setting) -> Completion,
) -> Vec<Completion> {
    let after_dot = format!(".{text}");
    let mut fitting: Vec<_> = known
        .filter(|setting| setting.parameter.path.contains(text))
        .collect();
    fitting.sort_by_key(|setting| {
        let path = setting.parameter.path;
        !(path.starts_with(text) || path.contains(&after_dot))
    });
    let shown = |setting: &Setting| completion(setting).with_right(setting.shown(true));
    fitting.into_iter().map(shown).collect()
}

/// A file to draw into.
pub fn figures(typed: &str, _: Option<&Frame>) -> Vec<Completion> {
    let help = "a figure of this state: a file that ends in .svg, .png or .pdf";
    vec![argument("figure", typed, help, |app, file| {
        app.order(move |run| run.write_figure(Path::new(&file)));
    })]
}

/// Presets by name; anything else is taken for a file.
pub fn presets(typed: &str, _: Option<&Frame>) -> Vec<Completion> {
    let load = |name: &str, help| argument("load", name, help, |app, name| app.load(&name));
    let fitting = named(typed).map(|preset| load(preset.name, preset.title()));
    let mut list: Vec<_> = fitting.collect();
    if list.is_empty() {
        list.push(load(typed, "a preset's name, or a path to a .toml file"));
    }
    list
}

/// Any file or directory; a preset by its name.
pub fn overlays(typed: &str, _: Option<&Frame>) -> Vec<Completion> {
    let overlay = |given: &str, help| {
        argument("overlay", given, help, |app, given| {
            app.order(move |run| run.overlay(&given));
        })
    };
    let is_path = typed.contains(['/', '.']);
    let presets = named(typed).filter(|_| !is_path);
    let presets = presets.map(|preset| overlay(preset.name, preset.title()));
    let mut list = vec![overlay(
        typed,
        "a CSV file, a run's directory, or a scenario",
    )];
    list.extend(presets);
    // What is typed comes first, unless it can only be the beginning of a preset's name.
    let is_begun = list.len() > 1 && !Path::new(typed).exists();
    list.rotate_left(usize::from(is_begun && !typed.is_empty()));
    list
}

/// A command with an argument, which does nothing without one.
fn argument(command: &str, given: &str, help: &str, act: fn(&mut App, String)) -> Completion {
    let completion = Completion::new(format!("{command} {given}"), help);
    let given = given.to_owned();
    match given.is_empty() {
        true => completion,
        false => completion.doing(move |app| act(app, given)),
    }
}

/// The presets whose names have this text.
fn named(text: &str) -> impl Iterator<Item = &'static Preset> {
    preset::ALL
        .iter()
        .filter(move |preset| preset.name.contains(text))
}

impl Palette {
    /// The palette with a command typed, its argument still missing.
    pub fn begun(name: &str) -> Self {
        Self {
            line: LineEdit::new(&format!("{name} ")),
            at: 0,
        }
    }

    pub(super) fn press(&mut self, key: Key, app: &mut App) -> Answer {
        let mut list = completions(&self.line.text(), app.frame.as_deref());
        let last = list.len().saturating_sub(1);
        let at = self.at.min(last);
        match (key, list.get_mut(at)) {
            (Key::Named(Named::Esc), _) => return Answer::Close,
            (Key::Named(Named::Backspace), _) if self.line.is_empty() => return Answer::Close,
            (Key::Named(Named::Up | Named::BackTab) | Key::Ctrl('p'), _) => {
                select(&mut self.at, list.len(), Key::Named(Named::Up));
            }
            (Key::Named(Named::Down) | Key::Ctrl('n'), _) => {
                select(&mut self.at, list.len(), Key::Named(Named::Down));
            }
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
        let found = completions(&self.line.text(), app.frame.as_deref());
        let rows = (area.height / 2).clamp(6, 12);
        let title = "commands (Tab completes, Enter runs, Esc closes)";
        let inside = docked(&app.theme, title, (100, rows + 3), area, buffer);
        let roles = [Role::Quiet, Role::Focus, Role::Title];
        let [quiet, focus, title] = roles.map(|role| app.theme.style(role));
        typing(" :", &self.line, title).render(inside, buffer);
        let [_, below] = Layout::vertical([Length(1), Fill(1)]).areas(inside);
        if found.is_empty() {
            return Line::styled(" no such command", quiet).render(below, buffer);
        }
        let line = |completion: &Completion| {
            let name = Span::raw(format!(" {:22} ", completion.line));
            let right = Span::styled(format!(" {} ", completion.right), title);
            let room = usize::from(below.width).saturating_sub(name.width() + right.width());
            let help = Span::styled(format!("{:room$.room$}", completion.help), quiet);
            Line::from(vec![name, help, right])
        };
        let at = self.at.min(found.len() - 1);
        list(found.iter().map(line), at, focus, below, buffer);
    }
}
