//! The palette: every command by name, and every scenario key by `set KEY=VALUE`, with completion.

use super::*;
use crate::scenario::preset;
use crate::scenario::schema::Kind;
use crate::tui::command::{Act, COMMANDS};
use crate::tui::map::live::{POINTS, Range};

/// The line being typed, which of its completions is selected, and what it leads back to.
#[derive(Debug, Default)]
pub struct Palette {
    pub(super) line: LineEdit,
    at: usize,
    back: Box<Overlay>,
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
fn completions(typed: &str, frame: &Frame) -> Vec<Completion> {
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
        let key = row
            .keys
            .first()
            .map_or_else(String::new, ToString::to_string);
        let completion = match row.act {
            Act::Palette(complete) => {
                let argument = typed.strip_prefix(row.name);
                if let Some(argument) = argument.and_then(|rest| rest.strip_prefix(' ')) {
                    return complete(argument.trim(), frame);
                }
                Completion::new(format!("{} ", row.name), row.help)
            }
            _ => Completion::new(row.name, row.help).doing(|app| app.run(row.command)),
        };
        let rank = rank(typed, row);
        list.extend(rank.map(|rank| (rank, completion.with_right(key))));
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

/// How well `typed` matches: at the start of a name, within it, or by its words in keys, name and help.
fn rank(typed: &str, row: &Row) -> Option<usize> {
    let typed = typed.trim_end().to_lowercase();
    let all = format!("{} {} {}", row.key_names().join(" "), row.name, row.help).to_lowercase();
    let position = [
        row.name.starts_with(&typed),
        row.name.contains(&typed),
        typed.split_whitespace().all(|word| all.contains(word)),
    ];
    position.into_iter().position(|fits| fits)
}

/// `KEY`, or `KEY=` with the values that the key takes.
pub fn changes(typed: &str, frame: &Frame) -> Vec<Completion> {
    let known = &frame.facts.settings;
    let Some((key, value)) = typed.split_once('=') else {
        return keys(known.iter(), typed.trim_end(), |setting| {
            let line = format!("set {}=", setting.parameter.path);
            Completion::new(line, setting.parameter.meaning)
        });
    };
    let (key, value) = (key.trim(), value.trim());
    let found = known.iter().find(|setting| setting.parameter.path == key);
    let now = found.map_or_else(String::new, |setting| setting.shown(true));
    let set = |value: &str, help: String| {
        let (key, given) = (key.to_owned(), value.to_owned());
        let right = if value == now { "now" } else { "" };
        Completion::new(format!("set {key}={value}"), help)
            .with_right(right)
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
    let now = found.map(|_| format!("now {now}")).unwrap_or_default();
    let mut typed = set(value, help.unwrap_or_default()).with_right(now);
    typed.act = typed.act.filter(|_| !value.is_empty());
    vec![typed]
}

/// `KEY`, or `KEY FROM..TO`.
pub fn sweeps(typed: &str, frame: &Frame) -> Vec<Completion> {
    let numbers = frame
        .facts
        .settings
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
pub fn figures(typed: &str, _: &Frame) -> Vec<Completion> {
    let help = "a figure of this state: a file that ends in .svg, .png or .pdf";
    vec![argument("figure", typed, help, |app, file| {
        app.order(move |run| run.write_figure(Path::new(&file)));
    })]
}

/// A preset by its name, or a file.
pub fn presets(typed: &str, _: &Frame) -> Vec<Completion> {
    let help = "a preset's name, or a path to a .toml file";
    preset_or(typed, "load", help, |app, name| app.load(&name))
}

/// Any file or directory; a preset by its name.
pub fn overlays(typed: &str, _: &Frame) -> Vec<Completion> {
    let help = "a CSV file, a run's directory, or a scenario";
    preset_or(typed, "overlay", help, |app, given| {
        app.order(move |run| run.overlay(&given));
    })
}

/// A note for a snapshot, which may be empty.
pub fn notes(typed: &str, _: &Frame) -> Vec<Completion> {
    let note = Some(typed.to_owned()).filter(|note| !note.is_empty());
    let help = "writes state, history and loop with this note";
    let written = Completion::new(format!("snapshot, note {typed}"), help);
    vec![written.doing(|app| app.order(move |run| run.write_snapshot(note.as_deref())))]
}

/// A command with what is typed, or with a preset whose name has that.
fn preset_or(typed: &str, command: &str, help: &str, act: fn(&mut App, String)) -> Vec<Completion> {
    let is_path = typed.contains(['/', '.']);
    let presets = preset::ALL
        .iter()
        .filter(|preset| !is_path && preset.name.contains(typed));
    let mut list = vec![argument(command, typed, help, act)];
    list.extend(presets.map(|preset| argument(command, preset.name, preset.title(), act)));
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

impl Palette {
    /// The palette with the beginning of a line, over what it leads back to.
    pub fn begun(line: &str, back: Overlay) -> Self {
        Self {
            line: LineEdit::new(line),
            at: 0,
            back: Box::new(back),
        }
    }

    /// The words of a setting, the present one selected, or those that begin with what was typed.
    pub fn choosing(setting: &Setting, typed: Option<char>, back: Overlay) -> Self {
        let line = format!("set {}=", setting.parameter.path);
        if let Some(typed) = typed {
            return Self::begun(&format!("{line}{typed}"), back);
        }
        let mut words = setting.words().unwrap_or_default().into_iter();
        let now = words.position(|word| setting.value.as_deref() == Some(word));
        Self {
            at: now.unwrap_or(0),
            ..Self::begun(&line, back)
        }
    }

    /// Leads back, unless something else was opened.
    fn leave(&mut self, app: &mut App) -> Answer {
        if matches!(app.overlay, Overlay::None) {
            app.overlay = std::mem::take(&mut *self.back);
        }
        Answer::Close
    }

    pub(super) fn press(&mut self, key: Key, app: &mut App) -> Answer {
        let mut list = completions(&self.line.text(), &app.frame);
        let last = list.len().saturating_sub(1);
        let at = self.at.min(last);
        match (key, list.get_mut(at)) {
            (Key::Named(Named::Esc), _) => return self.leave(app),
            (Key::Named(Named::Backspace), _) if self.line.is_empty() => return self.leave(app),
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
                    // What was found in the help is to be seen; the form waits for the next change.
                    return match *self.back {
                        Overlay::Form(_) => self.leave(app),
                        _ => Answer::Close,
                    };
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

    pub(super) fn draw(&self, app: &App, mut canvas: Canvas) {
        let found = completions(&self.line.text(), &app.frame);
        let rows = (canvas.area.height / 2).clamp(6, 12);
        let title = "commands (Tab completes, Enter runs, Esc closes)";
        let mut inside = canvas.docked(title, rows + 3);
        let roles = [Role::Quiet, Role::Focus, Role::Title];
        let [quiet, focus, title] = roles.map(|role| inside.style(role));
        inside.show(typing(" :", &self.line, title));
        let [_, below] = Layout::vertical([Length(1), Fill(1)]).areas(inside.area);
        let mut below_line = inside.at(below);
        if found.is_empty() {
            return below_line.say("no such command", Role::Quiet);
        }
        // Of values the key is seen above.
        let typed = self.line.text();
        let key = typed.rfind('=').map_or("", |at| &typed[..=at]);
        let name = |of: &Completion| of.line.strip_prefix(key).unwrap_or(&of.line).to_owned();
        let longest = found.iter().map(|of| name(of).len()).max().unwrap_or(0);
        let line = |completion: &Completion| {
            let name = format!(" {:1$} ", name(completion), longest.min(22));
            let name = Span::raw(name);
            let right = Span::styled(format!(" {} ", completion.right), title);
            let room = usize::from(below.width).saturating_sub(name.width() + right.width());
            let help = Span::styled(format!("{:room$.room$}", completion.help), quiet);
            Line::from(vec![name, help, right])
        };
        let at = self.at.min(found.len() - 1);
        below_line.list(found.iter().map(line), at, focus);
    }
}
