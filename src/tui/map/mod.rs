//! `mdr-tui sweep --view`: a study as a map in the terminal, also while it runs.
//!
//! Two axes make a map in half blocks, one axis a curve; the cursor reads a point, Enter opens it
//! in the explorer. The file is read again whenever it has grown, so that a running study shows its
//! points as they finish.

use std::io::{self, Write};
use std::sync::mpsc::channel;
use std::thread;
use std::time::Duration;

use anyhow::Result;
use ratatui::prelude::*;

use super::canvas::Canvas;
use super::command::{self, Command};
use super::event_loop::{self, Next, Scene};
use super::keys::Key;
use super::theme::Theme;
use super::{Event, Input, script};

mod draw;
pub mod live;
mod view;

pub use view::{Leave, View};

/// How often the file is checked.
const LOOK_INTERVAL: Duration = Duration::from_millis(300);

/// A map on the terminal.
struct Shown<'a, F> {
    view: &'a mut View,
    theme: Theme,
    renew: F,
    leave: Option<Leave>,
}

impl<F: FnMut(&mut View)> Scene for Shown<'_, F> {
    fn theme(&mut self) -> &mut Theme {
        &mut self.theme
    }

    fn draw(&self, area: Rect, buffer: &mut Buffer) {
        draw::draw(self.view, Canvas::new(&self.theme, area, buffer));
    }

    fn handle(&mut self, event: Event) -> Next {
        match event {
            Event::Input(Input::Key(key)) if command::of_key(key) == Some(Command::Suspend) => {
                return Next::Suspend;
            }
            Event::Input(Input::Key(key)) => self.leave = self.view.press(key),
            Event::News => (self.renew)(self.view),
            Event::Notice(text) => self.view.notice = Some(text),
            _ => {}
        }
        self.leave.map_or(Next::Stay, |_| Next::Leave)
    }
}

/// Shows `view` until the user leaves it; calls `renew` regularly to update it.
///
/// # Errors
///
/// If stdout is not a terminal, or cannot be switched to raw mode.
pub fn run(view: &mut View, theme: &Theme, renew: impl FnMut(&mut View)) -> Result<Leave> {
    event_loop::require_terminal()?;
    crate::panics::capture();
    let (events, inbox) = channel();
    let watcher = events.clone();
    thread::spawn(move || {
        while watcher.send(Event::News).is_ok() {
            thread::sleep(LOOK_INTERVAL);
        }
    });
    let mut shown = Shown {
        view,
        theme: *theme,
        renew,
        leave: None,
    };
    event_loop::run(&mut shown, false, &events, &inbox, || {})?;
    Ok(shown.leave.unwrap_or(Leave::Quit))
}

/// Presses keys and prints the last screen, without a terminal.
///
/// # Errors
///
/// Fails where stdout cannot be written.
pub fn play(view: &mut View, theme: &Theme, keys: &[Key], size: Size) -> Result<Leave> {
    let leave = keys.iter().find_map(|key| view.press(*key));
    let leave = leave.unwrap_or(Leave::Quit);
    if leave == Leave::Quit {
        let draw = |area, buffer: &mut _| draw::draw(view, Canvas::new(theme, area, buffer));
        let drawn = script::drawn(size, draw);
        io::stdout().write_all(script::lines(&drawn).as_bytes())?;
    }
    Ok(leave)
}
