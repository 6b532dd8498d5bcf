//! Overlays, one per file: each has its own state, handles keys and draws itself.

use ratatui::prelude::*;
use ratatui::widgets::{Borders, Clear, List, ListState};

use super::app::App;
use super::command::{self, Command};
use super::frame::Frame;
use super::keys::{Key, Named};
use super::line::LineEdit;
use super::map::live::Live;
use super::panels::framed;
use super::settings::Setting;
use super::theme::{Role, Theme};

mod accuracy;
mod explain;
mod form;
mod help;
mod library;
pub(super) mod palette;

pub use form::Form;
pub use help::Help;
pub use library::Library;
pub use palette::{Completion, Palette};

/// The overlay on the panels.
#[derive(Debug, Default)]
pub enum Overlay {
    /// Nothing.
    #[default]
    None,
    /// The keys.
    Help(Help),
    /// The presets.
    Library(Library),
    /// The checks and the refinement check, or a second page that explains each check.
    Accuracy {
        /// Whether it is the second page.
        explains: bool,
    },
    /// What the focused panel shows.
    Explain,
    /// The command palette.
    Palette(Palette),
    /// The parameters.
    Form(Form),
    /// The note of a snapshot.
    Note(LineEdit),
    /// A study of one key.
    Sweep(Live),
}

/// Whether an overlay stays open after a key.
#[derive(Debug, PartialEq, Eq)]
pub enum Answer {
    /// It stays.
    Stay,
    /// It closes.
    Close,
}

impl Overlay {
    /// Answers a key. Meanwhile the app has no overlay: what opens one takes this one's place.
    pub fn press(&mut self, key: Key, app: &mut App) -> Answer {
        let command = command::of_key(key);
        match self {
            Self::None => leave_for(command, app),
            Self::Help(help) => help.press(key, app),
            Self::Library(library) => library.press(key, app),
            Self::Explain => watch(command, explain::CLOSING, explain::WATCHED, app),
            Self::Accuracy { explains } => match command {
                Some(Command::NextPanel | Command::PreviousPanel) => {
                    *explains ^= true;
                    Answer::Stay
                }
                _ => watch(command, accuracy::CLOSING, accuracy::WATCHED, app),
            },
            Self::Palette(palette) => palette.press(key, app),
            Self::Form(form) => form.press(key, app),
            Self::Note(line) => note(line, key, app),
            Self::Sweep(live) => live.press(key, app),
        }
    }

    /// The line being typed, if there is one.
    pub fn line(&mut self) -> Option<&mut LineEdit> {
        match self {
            Self::Help(help) => help.search.as_mut(),
            Self::Palette(palette) => Some(&mut palette.line),
            Self::Form(form) => form.line(),
            Self::Note(line) => Some(line),
            _ => None,
        }
    }

    /// Draws it over `area`.
    pub fn draw(&self, app: &App, area: Rect, buffer: &mut Buffer) {
        match self {
            Self::None => {}
            Self::Help(help) => help.draw(app, area, buffer),
            Self::Library(library) => library.draw(app, area, buffer),
            Self::Accuracy { explains: false } => accuracy::draw(app, area, buffer),
            Self::Accuracy { explains: true } => accuracy::draw_explanations(app, area, buffer),
            Self::Explain => explain::draw(app, area, buffer),
            Self::Palette(palette) => palette.draw(app, area, buffer),
            Self::Form(form) => form.draw(app, area, buffer),
            Self::Sweep(live) => live.draw(&app.theme, area, buffer),
            Self::Note(line) => {
                let title = "snapshot with a note (Enter writes, Esc closes)";
                let inside = docked(&app.theme, title, (100, 3), area, buffer);
                typing(" ", line, Style::new()).render(inside, buffer);
            }
        }
    }
}

/// Closes for a command; stays if there is none.
fn leave_for(command: Option<Command>, app: &mut App) -> Answer {
    watch(command, &[], &[], app)
}

/// Answers a command beside which the run can be watched: those that close do nothing else, and those that are
/// `watched` leave open what is open.
fn watch(
    command: Option<Command>,
    closing: &[Command],
    watched: &[Command],
    app: &mut App,
) -> Answer {
    match command {
        Some(command) if closing.contains(&command) => Answer::Close,
        Some(command) => {
            app.run(command);
            match watched.contains(&command) {
                true => Answer::Stay,
                false => Answer::Close,
            }
        }
        None => Answer::Stay,
    }
}

/// The settings on the screen.
fn settings(frame: Option<&Frame>) -> &[Setting] {
    frame.map_or(&[], |frame| &frame.facts.settings)
}

/// A note is typed; Enter takes the snapshot.
fn note(line: &mut LineEdit, key: Key, app: &mut App) -> Answer {
    match key {
        Key::Named(Named::Esc) => return Answer::Close,
        Key::Named(Named::Enter) => {
            let text = line.text().trim().to_owned();
            let note = Some(text).filter(|text| !text.is_empty());
            app.order(move |run| run.write_snapshot(note.as_deref()));
            return Answer::Close;
        }
        key => line.press(key),
    };
    Answer::Stay
}

/// A cleared box in the middle of `area`, with a title; returns its inside.
fn popup(theme: &Theme, title: &str, size: (u16, u16), area: Rect, buffer: &mut Buffer) -> Rect {
    let (width, height) = (size.0.min(area.width), size.1.min(area.height));
    let (left, top) = ((area.width - width) / 2, (area.height - height) / 2);
    let place = Rect::new(area.x + left, area.y + top, width, height);
    Clear.render(place, buffer);
    framed(title, Role::Title, Borders::ALL, theme, place, buffer)
}

/// The same at the lower end of `area`: what lies above can be watched.
fn docked(theme: &Theme, title: &str, size: (u16, u16), area: Rect, buffer: &mut Buffer) -> Rect {
    let height = size.1.min(area.height);
    let place = Rect::new(area.x, area.bottom() - height, area.width, height);
    popup(theme, title, size, place, buffer)
}

/// The keys that a page up and a page down pass in a list.
const PAGE: usize = 10;

/// Selects another one of `count` entries by a key that moves in lists; false for other keys.
fn select(at: &mut usize, count: usize, key: Key) -> bool {
    let last = count.saturating_sub(1);
    *at = match (key, command::of_key(key)) {
        (Key::Named(Named::Home), _) => 0,
        (Key::Named(Named::End), _) => last,
        (Key::Named(Named::PageUp), _) => at.saturating_sub(PAGE),
        (Key::Named(Named::PageDown), _) => (*at + PAGE).min(last),
        (Key::Named(Named::Up), _) | (_, Some(Command::Up | Command::PreviousPanel)) => {
            at.checked_sub(1).unwrap_or(last)
        }
        (Key::Named(Named::Down), _) | (_, Some(Command::Down | Command::NextPanel)) => {
            (*at + 1) % (last + 1)
        }
        _ => return false,
    };
    true
}

/// Draws the entries around the one `at`, which has a style of its own, and a few that follow it.
fn list<'a>(
    entries: impl IntoIterator<Item = Line<'a>>,
    at: usize,
    style: Style,
    area: Rect,
    buffer: &mut Buffer,
) {
    let list = List::new(entries).highlight_style(style);
    let rows = usize::from(area.height);
    let first = (at + 1 + rows / 3).min(list.len()).saturating_sub(rows);
    let selected = ListState::default().with_selected(Some(at));
    StatefulWidget::render(list, area, buffer, &mut selected.with_offset(first));
}

/// A line being typed behind a prompt, its cursor shown.
fn typing(prompt: &str, line: &LineEdit, style: Style) -> Line<'static> {
    let (before, after) = line.halves();
    let mut after = after.chars();
    let under = after.next().unwrap_or(' ');
    Line::from(vec![
        Span::styled(prompt.to_owned(), style),
        Span::raw(before),
        Span::styled(under.to_string(), Modifier::REVERSED),
        Span::raw(after.collect::<String>()),
    ])
}
