//! Arguments of commands: their completions, and what each of them does.

use std::path::Path;

use super::explorer::Explorer;
use super::frame::Frame;
use super::map::range::{POINTS, SweepRange};
use super::panels::Panel;
use super::settings::Setting;
use super::worker::files::{self, Copied};
use super::worker::{Order, changes};
use crate::charts::About;
use crate::scenario::key::Kind;
use crate::scenario::preset;

/// The action of a completion.
type Deed = Box<dyn FnOnce(&mut Explorer)>;

/// One completion of the typed text.
pub struct Completion {
    /// The whole line.
    pub(super) line: String,
    /// Its meaning.
    pub(super) help: String,
    /// Text on the right: a key, or a value and its unit.
    pub(super) right: String,
    /// The action when accepted; `None` while more must be typed.
    pub(super) act: Option<Deed>,
}

impl Completion {
    pub(super) fn new(line: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            line: line.into(),
            help: help.into(),
            right: String::new(),
            act: None,
        }
    }

    pub(super) fn with_right(self, right: impl Into<String>) -> Self {
        let right = right.into();
        Self { right, ..self }
    }

    fn doing(mut self, act: impl FnOnce(&mut Explorer) + 'static) -> Self {
        self.act = Some(Box::new(act));
        self
    }
}

/// Completes `KEY`, or `KEY=` with the values that the key accepts.
pub fn set(typed: &str, frame: &Frame) -> Vec<Completion> {
    let known = &frame.settings();
    let Some((key, value)) = typed.split_once('=') else {
        return keys(known.iter(), typed.trim_end(), |setting| {
            let line = format!("set {}=", setting.key.path);
            Completion::new(line, setting.key.meaning)
        });
    };
    let (key, value) = (key.trim(), value.trim());
    let found = known.iter().find(|setting| setting.key.path == key);
    let now = found.map_or_else(String::new, |setting| setting.shown(true));
    let set = |value: &str, help: String| {
        let (key, given) = (key.to_owned(), value.to_owned());
        let right = if value == now { "now" } else { "" };
        Completion::new(format!("set {key}={value}"), help)
            .with_right(right)
            .doing(move |explorer| explorer.order(Order::Change(changes::set(key, given))))
    };
    let words = found.and_then(Setting::words).unwrap_or_default();
    let begun = words.iter().filter(|word| word.starts_with(value));
    let meaning = |word: &str| found?.key.meaning_of(word);
    let list: Vec<_> = begun
        .map(|word| set(word, meaning(word).unwrap_or_default().to_owned()))
        .collect();
    if !list.is_empty() {
        return list;
    }
    let help = found.map(|setting| setting.key.described());
    let now = found.map(|_| format!("now {now}")).unwrap_or_default();
    let mut typed = set(value, help.unwrap_or_default()).with_right(now);
    typed.act = typed.act.filter(|_| !value.is_empty());
    vec![typed]
}

/// Completes `KEY`, or `KEY FROM..TO`.
pub fn sweep(typed: &str, frame: &Frame) -> Vec<Completion> {
    let is_number = |of: &&Setting| matches!(of.key.kind, Kind::Number | Kind::Whole);
    let settings = frame.settings();
    let numbers = settings.iter().filter(is_number);
    let units = numbers.clone().map(|of| (of.key.path, of.unit));
    if let Some(range) = SweepRange::parse(typed, &units.collect::<Vec<_>>()) {
        let help = format!("runs {POINTS} values on all cores and shows the curve");
        let sweep = Completion::new(format!("sweep {typed}"), help)
            .doing(move |explorer| explorer.order(files::sweep(range)));
        return vec![sweep];
    }
    let key = typed.split([' ', '=']).next().unwrap_or_default();
    keys(numbers, key, |setting| {
        let line = format!("sweep {} ", setting.key.path);
        Completion::new(line, format!("FROM..TO: {}", setting.key.meaning))
    })
}

/// Returns the keys that contain a text, with their values. Keys that begin with the text, or in which it follows a
/// dot, come first.
fn keys<'a>(
    known: impl Iterator<Item = &'a Setting>,
    text: &str,
    completion: fn(&Setting) -> Completion,
) -> Vec<Completion> {
    let after_dot = format!(".{text}");
    let mut fitting: Vec<_> = known
        .filter(|setting| setting.key.path.contains(text))
        .collect();
    fitting.sort_by_key(|setting| {
        let path = setting.key.path;
        !(path.starts_with(text) || path.contains(&after_dot))
    });
    let shown = |setting: &Setting| completion(setting).with_right(setting.shown(true));
    fitting.into_iter().map(shown).collect()
}

/// Completes a past or future cycle; offers the cycles at which the scenario writes states.
pub fn goto(typed: &str, frame: &Frame) -> Vec<Completion> {
    let go = |cycle: f64, help: String| {
        let there = Completion::new(format!("goto {cycle}"), help);
        there.doing(move |explorer| explorer.order(Order::GoTo(cycle)))
    };
    let given = typed
        .parse()
        .ok()
        .filter(|cycle: &f64| cycle.is_finite() && *cycle >= 0.0);
    if let Some(cycle) = given {
        return vec![go(
            cycle,
            "past: as it was; to come: runs there and pauses".into(),
        )];
    }
    let plan = frame.live.scenario.run();
    let planned = plan.snapshot_at.iter().chain(&plan.cycles);
    let help = || "the scenario writes the state there".to_owned();
    let mut list = vec![Completion::new(
        "goto ",
        "a number of cycles, such as 50.72",
    )];
    if typed.is_empty() {
        list.extend(planned.map(|cycle| go(*cycle, help())));
    }
    list
}

/// Completes what can be copied.
pub fn copy(typed: &str, _: &Frame) -> Vec<Completion> {
    let all = [
        (
            "readings",
            "the numbers of this moment, and those under the cursor",
            Copied::Readings,
        ),
        (
            "scenario",
            "the scenario that repeats this run, with all changes",
            Copied::Scenario,
        ),
        (
            "run command",
            "the command that repeats this run without a screen",
            Copied::Command,
        ),
    ];
    let fitting = all.into_iter().filter(|(name, ..)| name.starts_with(typed));
    let copy = |(name, help, what)| {
        Completion::new(format!("copy {name}"), help).doing(move |on| on.copy(what))
    };
    fitting.map(copy).collect()
}

/// Completes the title of a panel.
pub fn focus(typed: &str, _: &Frame) -> Vec<Completion> {
    let panels = Panel::ALL.into_iter().map(|panel| (panel, panel.recipe()));
    let fitting = panels.filter(|(_, recipe)| recipe.title.contains(typed));
    let focus = |(panel, recipe): (Panel, &About)| {
        let text = recipe.text.split_inclusive('.').next().unwrap_or_default();
        Completion::new(format!("focus {}", recipe.title), text)
            .doing(move |on| on.stage.focus_on(panel))
    };
    fitting.map(focus).collect()
}

/// Completes the name of a figure's file.
pub fn figure(typed: &str, _: &Frame) -> Vec<Completion> {
    let help = "a figure of this state: a file that ends in .svg, .png or .pdf";
    vec![argument("figure", typed, help, |explorer, file| {
        explorer.order(files::figure(file.into()));
    })]
}

/// Completes a preset's name, or takes a file.
pub fn load(typed: &str, _: &Frame) -> Vec<Completion> {
    let help = "a preset's name, or a path to a .toml file";
    preset_or(typed, "load", help, |explorer, name| {
        explorer.load(name.as_ref())
    })
}

/// Completes a preset's name, or takes any file or directory.
pub fn overlay(typed: &str, _: &Frame) -> Vec<Completion> {
    let help = "a CSV file, a run's directory, or a scenario";
    preset_or(typed, "overlay", help, |explorer, given| {
        explorer.order(Order::Ghosts(Box::new(move |with, run| {
            with.overlay(run, &given)
        })));
    })
}

/// Takes a note for a snapshot; it may be empty.
pub fn note(typed: &str, _: &Frame) -> Vec<Completion> {
    let note = Some(typed.to_owned()).filter(|note| !note.is_empty());
    let help = "writes state, history and loop with this note";
    let written = Completion::new(format!("snapshot, note {typed}"), help);
    vec![written.doing(|explorer| explorer.order(files::snapshot(note)))]
}

/// Offers a command with the typed argument, and with each preset whose name contains it.
fn preset_or(
    typed: &str,
    command: &str,
    help: &str,
    act: fn(&mut Explorer, String),
) -> Vec<Completion> {
    let is_path = typed.contains(['/', '.']);
    let presets = preset::ALL
        .iter()
        .filter(|preset| !is_path && preset.name.contains(typed));
    let mut list = vec![argument(command, typed, help, act)];
    list.extend(presets.map(|preset| argument(command, preset.name, preset.title(), act)));
    // The typed text comes first, unless it can only be the beginning of a preset's name.
    let is_begun = list.len() > 1 && !Path::new(typed).exists();
    list.rotate_left(usize::from(is_begun && !typed.is_empty()));
    list
}

/// Offers a command with an argument; without one it does nothing.
fn argument(command: &str, given: &str, help: &str, act: fn(&mut Explorer, String)) -> Completion {
    let completion = Completion::new(format!("{command} {given}"), help);
    let given = given.to_owned();
    if given.is_empty() {
        completion
    } else {
        completion.doing(move |explorer| act(explorer, given))
    }
}
