//! `mdr-tui sweep --view`: a study as a map in the terminal, also while it runs.
//!
//! Two axes make a map in half blocks, one axis a curve; the cursor reads a point, Enter opens it
//! in the explorer. The file is read again whenever it has grown, so that a running study shows its
//! points as they finish.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::flow::When;
use super::input::{self, Waiting};
use super::keys::Key;
use super::terminal::{Capture, Screen};
use super::theme::Theme;
use super::{Event, Size, script};

mod draw;
pub mod live;
mod ramp;
mod view;

pub use view::{Leave, View};

/// How often the file is checked.
const LOOK_INTERVAL: Duration = Duration::from_millis(300);

/// Shows `view` until the user leaves it; calls `renew` regularly to update it.
///
/// # Errors
///
/// If stdout is not a terminal, or cannot be switched to raw mode.
pub fn run(view: &mut View, theme: &Theme, mut renew: impl FnMut(&mut View)) -> Result<Leave> {
    super::refuse_what_is_no_terminal()?;
    crate::panics::keep();
    let (events, inbox) = channel();
    let waiting = Arc::new(Waiting::default());
    super::listen_for_signals(events.clone(), Arc::clone(&waiting))?;
    let screen = Screen::open(Capture::None, theme.follows_background, events.clone());
    let mut screen = screen.context("cannot take over the terminal")?;
    let keys = Arc::clone(&waiting);
    let listener = thread::spawn(move || input::listen(&events, &keys, Capture::None));
    let outcome = attend(view, *theme, &mut renew, &mut screen, &inbox, &waiting);
    super::hear_out(&mut screen, &inbox);
    // Further keys are for the explorer or the shell.
    waiting.close();
    let _ = listener.join();
    outcome
}

fn attend(
    view: &mut View,
    mut theme: Theme,
    renew: &mut impl FnMut(&mut View),
    screen: &mut Screen,
    inbox: &Receiver<Event>,
    waiting: &Waiting,
) -> Result<Leave> {
    while !waiting.is_over() {
        if screen.when() == When::Now {
            screen.paint(|area, buffer| draw::draw(view, &theme, area, buffer))?;
        }
        match inbox.recv_timeout(LOOK_INTERVAL) {
            Err(RecvTimeoutError::Timeout) => renew(view),
            Ok(Event::Key(key)) => {
                waiting.leave();
                screen.flow().hurry(Instant::now());
                if let Some(leave) = view.press(key) {
                    return Ok(leave);
                }
            }
            Ok(Event::Paste(_)) => waiting.leave(),
            Ok(Event::Ready) => screen.flow().answered(Instant::now()),
            Ok(Event::Background(color)) => theme.follow(color),
            Ok(Event::Written) => screen.flow().written(),
            Ok(Event::Resize) => screen.start_afresh()?,
            Ok(Event::HangUp) | Err(RecvTimeoutError::Disconnected) => break,
            Ok(_) => {}
        }
    }
    Ok(Leave::Quit)
}

/// Presses keys and prints the last screen, without a terminal.
///
/// # Errors
///
/// Fails where stdout cannot be written.
pub fn play(view: &mut View, theme: &Theme, keys: &[Key], size: Size) -> Result<Leave> {
    let mut leave = Leave::Quit;
    for key in keys {
        if let Some(asked) = view.press(*key) {
            leave = asked;
            break;
        }
    }
    let area = Rect::new(0, 0, size.columns, size.rows);
    let mut buffer = Buffer::empty(area);
    draw::draw(view, theme, area, &mut buffer);
    if leave == Leave::Quit {
        let mut out = io::stdout().lock();
        out.write_all(script::lines(&buffer).as_bytes())?;
    }
    Ok(leave)
}
