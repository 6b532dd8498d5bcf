//! Overlays, one per file: each has its own state, handles keys and draws itself.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Widget};

use super::app::App;
use super::command::{self, Command};
use super::frame::Frame;
use super::keys::{Key, Named};
use super::line::LineEdit;
use super::map::live::Live;
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
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Overlay {
    /// Nothing.
    #[default]
    None,
    /// The keys.
    Help(Help),
    /// The presets.
    Library(Library),
    /// Checks and the refinement check.
    Accuracy,
    /// What the focused panel shows.
    Explain,
    /// The checks, each explained: the second page of the one before.
    Checks,
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
            Self::Explain => command.map_or(Answer::Stay, |command| explain::press(command, app)),
            Self::Accuracy | Self::Checks => match command {
                None => Answer::Stay,
                Some(Command::NextPanel | Command::PreviousPanel) => {
                    *self = match self {
                        Self::Checks => Self::Accuracy,
                        _ => Self::Checks,
                    };
                    Answer::Stay
                }
                Some(command) => accuracy::press(command, app),
            },
            Self::Palette(palette) => palette.press(key, app),
            Self::Form(form) => form.press(key, app),
            Self::Note(line) => note(line, key, app),
            Self::Sweep(live) => match live.press(key) {
                None => Answer::Stay,
                Some(Ok(None)) => Answer::Close,
                Some(Ok(Some(scenario))) => {
                    app.order(|run| run.load(scenario));
                    Answer::Close
                }
                Some(Err(error)) => say(error, app),
            },
        }
    }

    /// The line being typed, if there is one.
    pub fn line(&mut self) -> Option<&mut LineEdit> {
        match self {
            Self::None
            | Self::Library(_)
            | Self::Accuracy
            | Self::Checks
            | Self::Explain
            | Self::Sweep(_) => None,
            Self::Help(help) => help.line(),
            Self::Palette(palette) => Some(palette.line()),
            Self::Form(form) => form.line(),
            Self::Note(line) => Some(line),
        }
    }

    /// Draws it over `area`.
    pub fn draw(&self, app: &App, area: Rect, buffer: &mut Buffer) {
        match self {
            Self::None => {}
            Self::Help(help) => help.draw(app, area, buffer),
            Self::Library(library) => library.draw(app, area, buffer),
            Self::Accuracy => accuracy::draw(app, area, buffer),
            Self::Explain => explain::draw(app, area, buffer),
            Self::Checks => accuracy::draw_explanations(app, area, buffer),
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
    let Some(command) = command else {
        return Answer::Stay;
    };
    app.run(command);
    Answer::Close
}

/// Stays while a command is carried out.
fn stay_for(command: Command, app: &mut App) -> Answer {
    app.run(command);
    Answer::Stay
}

/// Stays and tells the user.
fn say(text: String, app: &mut App) -> Answer {
    app.notice = Some(text);
    Answer::Stay
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
    let height = size.1.min(area.height);
    let place = Rect {
        y: area.y + (area.height - height) / 2,
        ..area
    };
    boxed(theme, title, (size.0, height), place, buffer)
}

/// The same at the lower end of `area`: what lies above can be watched.
fn docked(theme: &Theme, title: &str, size: (u16, u16), area: Rect, buffer: &mut Buffer) -> Rect {
    let height = size.1.min(area.height);
    let place = Rect {
        y: area.bottom() - height,
        ..area
    };
    boxed(theme, title, (size.0, height), place, buffer)
}

fn boxed(theme: &Theme, title: &str, size: (u16, u16), area: Rect, buffer: &mut Buffer) -> Rect {
    let width = size.0.min(area.width);
    let place = Rect::new(
        area.x + (area.width - width) / 2,
        area.y,
        width,
        size.1.min(area.height),
    );
    Clear.render(place, buffer);
    let mut block = Block::bordered()
        .border_style(theme.style(Role::Faint))
        .title(Span::styled(
            format!(" {title} "),
            theme.style(Role::Title).remove_modifier(Modifier::DIM),
        ));
    if theme.ascii() {
        block = block.border_set(ASCII_BORDER);
    }
    let inside = block.inner(place);
    block.render(place, buffer);
    inside
}

const ASCII_BORDER: ratatui::symbols::border::Set = ratatui::symbols::border::Set {
    top_left: "+",
    top_right: "+",
    bottom_left: "+",
    bottom_right: "+",
    vertical_left: "|",
    vertical_right: "|",
    horizontal_top: "-",
    horizontal_bottom: "-",
};

/// The first of `count` entries to show so that entry `at` is among the `rows` shown, and a few that
/// follow it.
fn first_shown(at: usize, count: usize, rows: u16) -> usize {
    let following = usize::from(rows / 3);
    (at + 1 + following)
        .min(count)
        .saturating_sub(usize::from(rows))
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
