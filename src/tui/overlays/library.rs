//! Scenarios to choose from: the presets and the user's files, each with a description.

use std::path::{Path, PathBuf};

use ratatui::layout::Constraint::{Fill, Length};
use ratatui::layout::Layout;
use ratatui::text::Line;

use crate::plot::theme::Role;
use crate::scenario::preset::{self, Preset};
use crate::scenario::{Scenario, printable};
use crate::tui::canvas::Canvas;
use crate::tui::command::{self, Command};
use crate::tui::explorer::Explorer;
use crate::tui::keys::{Keystroke, Named};
use crate::tui::line::{LineEdit, one_line};
use crate::tui::overlays::answer::{Answer, select};
use crate::tui::snapshot;

/// Maximum number of directory entries listed.
const LONGEST: usize = 1000;

/// Rows for the description of the selected entry.
const WORDS: u16 = 4;

/// The list: presets first, then the entries of a directory.
#[derive(Debug, Default)]
pub struct Library {
    /// The index of the selected entry among those that pass the filter.
    at: usize,
    /// The text typed to find an entry.
    pub(super) filter: LineEdit,
    entries: Vec<LibraryEntry>,
    /// The description of the selected entry.
    about: String,
}

/// An entry of the list.
#[derive(Debug)]
struct LibraryEntry {
    name: String,
    /// A path, or the name of a preset.
    path: PathBuf,
    kind: EntryKind,
}

#[derive(Debug)]
enum EntryKind {
    Preset(&'static Preset),
    /// A scenario file, read only for its description.
    Scenario,
    /// A directory with a state to continue from, and its description.
    Snapshot(String),
    /// A directory to open.
    Directory,
}

impl LibraryEntry {
    fn preset(preset: &'static Preset) -> Self {
        Self {
            name: preset.name.to_owned(),
            path: preset.name.into(),
            kind: EntryKind::Preset(preset),
        }
    }

    /// Returns the entry for a path, if it is listed.
    fn at(path: PathBuf) -> Option<Self> {
        let name = path.file_name()?.to_str()?;
        let name = printable(Some(name).filter(|name| !name.starts_with('.'))?);
        if path.is_dir() {
            let kind = snapshot::about(&path).map_or(EntryKind::Directory, EntryKind::Snapshot);
            let name = name + "/";
            return Some(Self { name, path, kind });
        }
        let is_scenario = path.extension()?.eq_ignore_ascii_case("toml");
        let kind = is_scenario.then_some(EntryKind::Scenario)?;
        Some(Self { name, path, kind })
    }

    fn title(&self) -> &'static str {
        match &self.kind {
            EntryKind::Preset(preset) => preset.title(),
            EntryKind::Snapshot(_) => "snapshot",
            EntryKind::Scenario | EntryKind::Directory => "",
        }
    }

    /// Returns its description, or why it cannot be run.
    fn about(&self) -> String {
        match &self.kind {
            EntryKind::Preset(preset) => return preset.summary().to_owned(),
            EntryKind::Snapshot(about) => return about.clone(),
            EntryKind::Directory => return format!("the scenarios in {}", self.path.display()),
            EntryKind::Scenario => {}
        }
        match Scenario::load(&self.path, &[]) {
            Ok(scenario) => {
                let mut about = scenario.title().to_owned();
                if !scenario.description().is_empty() {
                    about = format!("{about}: {}", scenario.description());
                }
                match &scenario.run().note {
                    Some(note) => format!("{about} Note: {}", printable(note)),
                    None => about,
                }
            }
            Err(error) => one_line(&error.to_string()),
        }
    }
}

/// Lists a directory, in any order.
fn list(directory: &Path) -> std::io::Result<Vec<LibraryEntry>> {
    let entries = std::fs::read_dir(directory)?;
    let found = entries.map(|entry| Ok(LibraryEntry::at(entry?.path())));
    found.filter_map(Result::transpose).take(LONGEST).collect()
}

/// Lists the scenarios and directories in a directory, by name.
fn files(directory: &Path) -> Vec<LibraryEntry> {
    let mut found = list(directory).unwrap_or_else(|error| {
        vec![LibraryEntry {
            name: format!("cannot be listed: {error}"),
            path: directory.to_owned(),
            kind: EntryKind::Directory,
        }]
    });
    let is_file = |entry: &LibraryEntry| matches!(entry.kind, EntryKind::Scenario);
    found.sort_by_cached_key(|entry| (!is_file(entry), entry.name.clone()));
    found.push(LibraryEntry {
        name: "../".into(),
        path: directory.join(".."),
        kind: EntryKind::Directory,
    });
    found
}

impl Library {
    /// Opens the list with the working directory, and selects the scenario on the screen.
    pub fn open(origin: &str) -> Self {
        let mut library = Self::default();
        library.enter(".".into());
        let here = Path::new(".").join(origin);
        let is_shown = |entry: &LibraryEntry| entry.path == Path::new(origin) || entry.path == here;
        let at = library.entries.iter().position(is_shown);
        library.select(at.unwrap_or(0));
        library
    }

    fn enter(&mut self, directory: PathBuf) {
        self.entries = preset::ALL.iter().map(LibraryEntry::preset).collect();
        self.entries.extend(files(&directory));
    }

    /// Returns the entries that pass the filter.
    fn fitting(&self) -> Vec<&LibraryEntry> {
        let fits = |of: &&LibraryEntry| self.filter.fits(&format!("{} {}", of.name, of.title()));
        self.entries.iter().filter(fits).collect()
    }

    fn select(&mut self, at: usize) {
        let fitting = self.fitting();
        let at = at.min(fitting.len().saturating_sub(1));
        let about = fitting.get(at).map(|entry| entry.about());
        (self.at, self.about) = (at, about.unwrap_or_else(|| "nothing has that".into()));
    }

    pub(super) fn press(&mut self, key: Keystroke, explorer: &mut Explorer) -> Answer {
        let mut at = self.at;
        match (key, command::of_key(key)) {
            _ if select(&mut at, self.fitting().len(), key) => self.select(at),
            (Keystroke::Named(Named::Enter), _) => return self.accept(explorer),
            (_, Some(Command::Back)) => return Answer::Close,
            _ if self.filter.filter(key) => self.select(0),
            _ => {}
        }
        Answer::Stay
    }

    /// Loads the selected scenario, or opens the selected directory.
    fn accept(&mut self, explorer: &mut Explorer) -> Answer {
        let fitting = self.fitting();
        let Some(entry) = fitting.get(self.at) else {
            return Answer::Stay;
        };
        let path = entry.path.clone();
        if !matches!(entry.kind, EntryKind::Directory) {
            explorer.load(&path);
            return Answer::Close;
        }
        self.filter = LineEdit::default();
        self.enter(path);
        self.select(preset::ALL.len());
        Answer::Stay
    }

    pub(super) fn draw(&self, mut canvas: Canvas) {
        let names = preset::ALL.iter().map(|preset| preset.name.len());
        let width = names.max().unwrap_or(0);
        let height = self.entries.len() as u16 + WORDS + 2;
        let filter = self.filter.text();
        let title = if filter.is_empty() {
            "presets and your own files (type: find, Enter: start, Esc: close)".to_owned()
        } else {
            format!("presets and files: {filter} (Enter: start, Esc: close)")
        };
        let mut inside = canvas.popup(&title, (80, height));
        let (theme, shown) = (inside.theme, inside.area.height.saturating_sub(WORDS));
        let rows = Layout::vertical([Length(shown), Length(1), Fill(1)]);
        let [above, _, below] = rows.areas(inside.area);
        let line = |entry: &LibraryEntry| {
            let [name, title] = [&*entry.name, entry.title()].map(|text| theme.printable(text));
            Line::raw(format!(" {name:width$}  {title} "))
        };
        let focus = inside.style(Role::Focus);
        let entries = self.fitting().into_iter().map(line);
        inside.at(above).list(entries, self.at, focus);
        let about = theme.printable(&self.about);
        inside.at(below).indented().write(about);
    }
}
