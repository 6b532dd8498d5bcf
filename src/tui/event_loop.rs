//! Shows the app on the terminal and passes keys to it, until the user leaves.

use std::io::{self, IsTerminal};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::Duration;

use anyhow::{Context, Result};
use signal_hook::consts::{
    SIGABRT, SIGALRM, SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP, SIGUSR1, SIGUSR2,
    SIGWINCH, SIGXCPU,
};
use signal_hook::iterator::Signals;

use super::app::App;
use super::event::Event;
use super::explorer::Next;
use super::input::{self, Waiting};
use super::reader::Input;
use super::terminal::{self, TerminalScreen};
use super::{screen, suspend};
use crate::panics::catch;

/// Error if there is no usable terminal.
#[derive(Debug, thiserror::Error)]
#[error("{0}; mdr-tui run SCENARIO works without a screen")]
pub struct NoTerminal(&'static str);

/// # Errors
/// Fails if there is no terminal to draw on.
pub fn require_terminal() -> Result<(), NoTerminal> {
    if !io::stdout().is_terminal() || !io::stdin().is_terminal() {
        return Err(NoTerminal("the explorer needs a terminal"));
    }
    if std::env::var("TERM").is_ok_and(|term| term == "dumb") {
        return Err(NoTerminal(
            "a dumb terminal (TERM=dumb) cannot show the explorer",
        ));
    }
    Ok(())
}

/// Shows `app` until the user leaves; calls `ending` before restoring the terminal. Returns whether it was restored.
///
/// # Errors
/// If the terminal cannot be taken over or drawn on.
pub fn run(
    app: &mut App,
    mouse: bool,
    events: &Sender<Event>,
    inbox: &Receiver<Event>,
    ending: impl FnOnce(),
) -> Result<bool> {
    let waiting = Arc::new(Waiting::default());
    listen_for_signals(events.clone(), Arc::clone(&waiting))?;
    suspend::wait_for_terminal(|| waiting.is_over());
    if waiting.is_over() {
        ending();
        return Ok(true);
    }
    let asks = app.explorer.theme.follows_background;
    let screen = TerminalScreen::open(mouse, asks, events.clone());
    let mut screen = screen.context("cannot take over the terminal")?;
    let (keys, to_loop) = (Arc::clone(&waiting), events.clone());
    let listener = thread::spawn(move || input::listen(&to_loop, &keys, mouse));
    let outcome = catch(|| handle_events(app, &mut screen, inbox, &waiting));
    ending();
    drain_replies(&mut screen, inbox);
    let is_restored = screen.release();
    // Further keys belong to the next program on the terminal.
    waiting.close();
    let _ = listener.join();
    match outcome {
        // If the terminal closes while being drawn on, it has hung up, which is not an error.
        Err(_) if !io::stdout().is_terminal() => Ok(false),
        outcome => outcome.map(|()| is_restored),
    }
}

fn handle_events(
    app: &mut App,
    screen: &mut TerminalScreen,
    inbox: &Receiver<Event>,
    waiting: &Waiting,
) -> Result<()> {
    app.explorer.resize(terminal::size()?);
    let mut is_due = !screen.draw(|area, buffer| screen::draw(app, area, buffer))?;
    // Between suspension and continuation, the screen belongs to the shell.
    let mut is_away = false;
    // Events that arrived while waiting for the terminal's answers.
    let mut held = Vec::new();
    loop {
        let wait = match screen.flow.delay(screen.now()) {
            _ if !held.is_empty() => Duration::ZERO,
            Some(delay) if is_due && !is_away => Duration::from_secs_f64(delay),
            _ => Duration::MAX,
        };
        let first = match inbox.recv_timeout(wait) {
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
            event => event.ok(),
        };
        crate::failpoint::hit("screen");
        let mut suspends = false;
        // Everything else that has arrived is answered with the same drawing.
        for event in held.drain(..).chain(first).chain(inbox.try_iter()) {
            if waiting.is_over() {
                return Ok(());
            }
            is_due |= !matches!(event, Event::Input(Input::Answer(_)) | Event::Written);
            match event {
                Event::Input(Input::Answer(to)) => screen.flow.answered(screen.now(), to),
                Event::Written => screen.flow.written(),
                Event::Input(Input::Background(color)) => app.explorer.theme.follow(color),
                Event::Suspend => suspends = true,
                Event::Resize if is_away => {}
                Event::Resize => {
                    screen.forget_contents();
                    app.explorer.resize(terminal::size()?);
                }
                Event::Continue => {
                    suspend::wait_for_terminal(|| waiting.is_over());
                    if waiting.is_over() {
                        return Ok(());
                    }
                    screen.acquire()?;
                    app.explorer.resize(terminal::size()?);
                    is_away = false;
                }
                Event::HangUp => return Ok(()),
                event => {
                    if let Event::Input(input) = &event {
                        if matches!(input, Input::Key(_) | Input::Paste(_)) {
                            waiting.leave();
                        }
                        screen.flow.hurry(screen.now());
                    }
                    app.handle(event);
                    if let Some(request) = app.explorer.to_clipboard.take() {
                        screen.output.send(&request);
                    }
                    match app.explorer.next {
                        Next::Stay => {}
                        Next::Suspend => (suspends, app.explorer.next) = (true, Next::Stay),
                        Next::Repaint => {
                            app.explorer.next = Next::Stay;
                            screen.forget_contents();
                        }
                        Next::Leave | Next::LeaveScreen => return Ok(()),
                    }
                }
            }
        }
        if waiting.has_dropped() {
            let word = "keys came faster than they could be handled; some were dropped";
            app.handle(Event::Notice(word.into()));
        }
        if suspends && !is_away {
            held = drain_replies(screen, inbox);
            if waiting.is_over() {
                return Ok(());
            }
            screen.release();
            is_away = suspend::stop();
            if !is_away {
                app.handle(Event::Notice("there is no shell to return to".into()));
                screen.acquire()?;
            }
        }
        if !is_away && is_due && screen.flow.delay(screen.now()) == Some(0.0) {
            is_due = !screen.draw(|area, buffer| screen::draw(app, area, buffer))?;
        }
    }
}

/// Waits for outstanding answers of the terminal, so that they do not reach the shell. Returns the other events.
fn drain_replies(screen: &mut TerminalScreen, inbox: &Receiver<Event>) -> Vec<Event> {
    let mut held = Vec::new();
    let start = screen.now();
    while let Some(most) = screen.flow.last_answers(start) {
        let left = (start + most - screen.now()).max(0.0);
        match inbox.recv_timeout(Duration::from_secs_f64(left)) {
            Ok(Event::Input(Input::Answer(to))) => screen.flow.answered(screen.now(), to),
            Ok(event) => held.push(event),
            Err(_) => break,
        }
    }
    held
}

/// Handles signals: those that end a process act like `q`, but before all waiting keys; SIGTSTP and SIGCONT suspend and
/// continue it.
fn listen_for_signals(events: Sender<Event>, waiting: Arc<Waiting>) -> Result<()> {
    let mut signals = Signals::new([
        SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGABRT, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU, SIGTSTP,
        SIGCONT, SIGWINCH,
    ])
    .context("cannot listen for signals")?;
    thread::spawn(move || {
        for signal in signals.forever() {
            let event = match signal {
                SIGTSTP => Event::Suspend,
                SIGCONT => Event::Continue,
                SIGWINCH => Event::Resize,
                _ => {
                    waiting.end();
                    Event::HangUp
                }
            };
            if events.send(event).is_err() {
                return;
            }
        }
    });
    Ok(())
}
