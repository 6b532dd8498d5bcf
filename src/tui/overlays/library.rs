//! Scenarios to choose from: the presets, and the user's own files, with what they show.

use std::path::{Path, PathBuf};

use ratatui::buffer::Buffer;
use ratatui::layout::Constraint::{Fill, Length};
use ratatui::layout::{Layout, Margin, Rect};
use ratatui::text::Line;
use ratatui::widgets::{Paragraph, Widget, Wrap};

use super::{Answer, App, Command, Frame, Key, leave_for, list, popup, select};
use crate::scenario::preset::{self, Preset};
use crate::scenario::{Scenario, printable};
use crate::tui::command;
use crate::tui::line::one_line;
use crate::tui::snapshot;
use crate::tui::theme::Role;

/// The most entries of a directory that are listed.
const LONGEST: usize = 1000;

/// Rows of words on what is selected.
const WORDS: u16 = 4;

/// The list: presets first, then what is in a directory.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Library {
    at: usize,
    directory: PathBuf,
    entries: Vec<Entry>,
    /// What is said of the selected entry.
    about: String,
}

/// An entry of the list.
#[derive(Debug, Clone, PartialEq)]
enum Entry {
    Preset(&'static Preset),
    Directory(PathBuf),
    /// A directory that holds a state to go on from, and what is said of it.
    Snapshot(PathBuf, String),
    File(PathBuf),
}

impl Entry {
    fn name(&self) -> String {
        let last = |path: &Path| {
            let name = path.file_name().unwrap_or(path.as_os_str());
            printable(&name.to_string_lossy())
        };
        match self {
            Self::Preset(preset) => preset.name.to_owned(),
            Self::Directory(path) if path.ends_with("..") => "../".to_owned(),
            Self::Directory(path) | Self::Snapshot(path, _) => format!("{}/", last(path)),
            Self::File(path) => last(path),
        }
    }

    fn title(&self) -> &'static str {
        match self {
            Self::Preset(preset) => preset.title(),
            Self::Snapshot(..) => "snapshot",
            Self::Directory(_) | Self::File(_) => "",
        }
    }

    /// Its description, or why it cannot be run.
    fn about(&self) -> String {
        match self {
            Self::Preset(preset) => preset.summary().to_owned(),
            Self::Directory(path) => format!("the scenarios in {}", path.display()),
            Self::Snapshot(_, about) => about.clone(),
            Self::File(path) => match Scenario::load(&path.to_string_lossy(), &[]) {
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
            },
        }
    }
}

/// The directories and the scenarios in a directory, by name.
fn files(directory: &Path) -> Vec<Entry> {
    let mut found: Vec<Entry> = std::fs::read_dir(directory)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| {
            let name = path.file_name().and_then(|name| name.to_str());
            name.is_some_and(|name| !name.starts_with('.'))
        })
        .filter_map(|path| {
            if path.is_dir() {
                return Some(match snapshot::about(&path) {
                    Some(about) => Entry::Snapshot(path, about),
                    None => Entry::Directory(path),
                });
            }
            let is_scenario = path
                .extension()
                .is_some_and(|end| end.eq_ignore_ascii_case("toml"));
            is_scenario.then_some(Entry::File(path))
        })
        .take(LONGEST)
        .collect();
    found.sort_by_key(|entry| (!matches!(entry, Entry::File(_)), entry.name()));
    found.push(Entry::Directory(directory.join("..")));
    found
}

impl Library {
    /// The list with the scenario on the screen selected, and the working directory.
    pub fn open(frame: Option<&Frame>) -> Self {
        let mut library = Self::default();
        library.enter(PathBuf::from("."));
        let origin = frame.map_or("", |frame| frame.facts.origin.as_str());
        let is_shown = |entry: &Entry| match entry {
            Entry::Preset(preset) => preset.name == origin,
            Entry::File(path) => path.as_path() == Path::new(".").join(origin),
            Entry::Directory(_) | Entry::Snapshot(..) => false,
        };
        let at = library.entries.iter().position(is_shown);
        library.select(at.unwrap_or(0));
        library
    }

    fn enter(&mut self, directory: PathBuf) {
        self.entries = preset::ALL.iter().map(Entry::Preset).collect();
        self.entries.extend(files(&directory));
        self.directory = directory;
    }

    fn select(&mut self, at: usize) {
        self.at = at.min(self.entries.len() - 1);
        self.about = self.entries[self.at].about();
    }

    pub(super) fn press(&mut self, key: Key, app: &mut App) -> Answer {
        let mut at = self.at;
        if select(&mut at, self.entries.len(), key) {
            self.select(at);
            return Answer::Stay;
        }
        match command::of_key(key) {
            Some(Command::Back | Command::Presets) => Answer::Close,
            Some(Command::Accept | Command::RunPause) => self.take(app),
            other => leave_for(other, app),
        }
    }

    /// Loads the selected scenario, or opens the selected directory.
    fn take(&mut self, app: &mut App) -> Answer {
        match &self.entries[self.at] {
            Entry::Preset(preset) => app.load(preset.name),
            Entry::File(path) | Entry::Snapshot(path, _) => app.load(&path.to_string_lossy()),
            Entry::Directory(path) => {
                let path = path.clone();
                self.enter(path);
                self.select(preset::ALL.len());
                return Answer::Stay;
            }
        }
        Answer::Close
    }

    pub(super) fn draw(&self, app: &App, area: Rect, buffer: &mut Buffer) {
        let names = preset::ALL.iter().map(|preset| preset.name.len());
        let width = names.max().unwrap_or(0);
        let height = self.entries.len() as u16 + WORDS + 2;
        let title = "presets and your own files (Enter starts, Esc closes)";
        let inside = popup(&app.theme, title, (80, height), area, buffer);
        let shown = inside.height.saturating_sub(WORDS);
        let [above, _, below] = Layout::vertical([Length(shown), Length(1), Fill(1)]).areas(inside);
        let line = |entry: &Entry| {
            let [name, title] =
                [&entry.name(), entry.title()].map(|text| app.theme.printable(text));
            Line::raw(format!(" {name:width$}  {title} "))
        };
        let (lines, focus) = (self.entries.iter().map(line), app.theme.style(Role::Focus));
        list(lines, self.at, focus, above, buffer);
        Paragraph::new(app.theme.printable(&self.about))
            .style(app.theme.style(Role::Quiet))
            .wrap(Wrap { trim: true })
            .render(below.inner(Margin::new(1, 0)), buffer);
    }
}
