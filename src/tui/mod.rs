//! The explorer: a worker thread steps the simulation, an input thread reads the keys, and the
//! screen is drawn when one of them has something new.
//!
//! ```text
//! keys ── Event ──▶ App ── Order ──▶ worker (Session)
//!                    ▲                  │
//!                    └── Event, Frame ──┘
//! ```

use std::io::{self, IsTerminal};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};
use crossterm::event::{self, KeyEventKind};
use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGTERM, SIGTSTP};
use signal_hook::iterator::Signals;

use crate::scenario::session::Session;

pub mod app;
pub mod command;
pub mod companion;
#[cfg(debug_assertions)]
pub(crate) mod fault;
pub mod frame;
pub mod keeping;
pub mod keys;
pub mod layout;
pub mod line;
pub mod manual;
pub mod mouse;
pub mod order;
pub mod overlays;
pub mod pace;
pub mod panels;
pub(crate) mod panics;
mod past;
pub mod plot;
mod readout;
mod rival;
pub mod screen;
mod script;
pub mod settings;
mod snapshot;
mod suspend;
mod terminal;
pub mod theme;
pub mod theory;
pub mod trend;
pub mod trust;
pub mod wire;
pub mod worker;

use app::{App, Leave};
use companion::Companion;
use frame::Slot;
use keeping::Keeping;
use keys::Key;
use mouse::{Gesture, Mouse};
use order::Order;
use plot::Marker;
pub use script::Size;
pub use terminal::Capture;
use theme::{Look, Theme};
use worker::Worker;

/// What can happen while the screen waits.
#[derive(Debug)]
pub enum Event {
    /// A key was pressed.
    Key(Key),
    /// The mouse was used.
    Point(Gesture),
    /// The terminal has another size.
    Resize,
    /// A frame waits in the slot.
    Frame,
    /// A word for the user.
    Notice(String),
    /// The companion has come to its end.
    Companion(Result<Companion, String>),
    /// The process is asked to stop for a while.
    Suspend,
    /// The process goes on after it was stopped.
    Continue,
    /// The terminal is gone, or the process was asked to end.
    HangUp,
    /// The worker has ended.
    WorkerGone,
}

/// What the explorer is opened with.
#[derive(Debug)]
pub struct Options {
    /// The session to show.
    pub session: Session,
    /// Whether it runs at once.
    pub running: bool,
    /// Where checkpoints are kept; none: nowhere.
    pub keep_in: Option<PathBuf>,
    /// How often; none: only at the end.
    pub keep_every: Option<Duration>,
    /// The most frames drawn in a second.
    pub fps: u16,
    /// How curves are drawn; by the locale if not said.
    pub marker: Option<Marker>,
    /// Whether to use colour; by NO_COLOR if not said.
    pub colored: Option<bool>,
    /// Which colours; by the terminal's own word on its background if not said.
    pub look: Option<Look>,
    /// Whom the mouse belongs to.
    pub mouse: Capture,
    /// Keys to press instead of reading the keyboard, and the size of the screen to print.
    pub script: Option<(Vec<Key>, Size)>,
}

/// There is nothing here that the explorer could be shown on.
#[derive(Debug, thiserror::Error)]
#[error("{0}; mdr-tui run SCENARIO computes without a screen")]
pub struct NoTerminal(&'static str);

/// What is left to print when the terminal is itself again.
#[derive(Debug, Default)]
pub struct Farewell {
    /// Where the session is kept.
    pub word: Option<String>,
    /// The last screen, if it is to stay.
    pub screen: Option<String>,
}

/// Opens the explorer, or plays a script of keys to it.
pub fn run(options: Options) -> Result<Farewell> {
    if options.script.is_none() {
        refuse_what_is_no_terminal()?;
    }
    let theme = theme(&options);
    let (orders, to_worker) = channel();
    let (events, from_threads) = channel();
    let slot = Arc::new(Slot::default());
    let interval = Duration::from_secs_f64(1.0 / f64::from(options.fps));
    let keeping = options
        .keep_in
        .filter(|_| options.script.is_none())
        .map(|directory| Keeping::new(directory, options.keep_every, &options.session));
    let worker = Worker::new(
        options.session,
        Arc::clone(&slot),
        events.clone(),
        interval,
        options.running && options.script.is_none(),
    );
    let halt = worker.halt();
    let mut app = App::new(theme, orders.clone());
    panics::keep();
    let thread = spawn_worker(worker, keeping, to_worker, events.clone())?;
    let outcome = match options.script {
        Some((keys, size)) => {
            script::play(&mut app, &keys, size, &orders, &from_threads).map(|()| None)
        }
        None => converse(&mut app, options.mouse, &slot, &events, &from_threads),
    };
    halt.store(true, Ordering::Relaxed);
    let _ = orders.send(Order::Quit);
    let kept = thread.join().unwrap_or_default();
    if let Some(word) = panics::word() {
        let kept = kept.unwrap_or_else(|| "nothing was to be kept".into());
        bail!("a defect in mdr-tui: {word}; {kept}");
    }
    match (outcome, kept) {
        (Err(error), Some(kept)) => Err(error.context(kept)),
        (outcome, word) => outcome.map(|screen| Farewell { word, screen }),
    }
}

/// Draws and listens until told to leave; returns the last screen if it is to stay.
fn converse(
    app: &mut App,
    mouse: Capture,
    slot: &Slot,
    events: &Sender<Event>,
    inbox: &Receiver<Event>,
) -> Result<Option<String>> {
    listen_for_signals(events.clone())?;
    let mut screen = terminal::Screen::open(mouse).context("cannot take over the terminal")?;
    listen_for_hands(events.clone(), mouse);
    let outcome = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        attend(app, slot, inbox, &mut screen)
    }));
    drop(screen);
    let Ok(outcome) = outcome else {
        // The panic's own word is told by the caller.
        return Ok(None);
    };
    match outcome {
        // A terminal that goes away while it is drawn on has hung up; nothing has failed.
        Err(_) if !io::stdout().is_terminal() => return Ok(None),
        outcome => outcome?,
    }
    if app.leave != Some(Leave::KeepScreen) {
        return Ok(None);
    }
    let (columns, rows) = crossterm::terminal::size()?;
    let rows = rows.saturating_sub(1);
    Ok(Some(script::text(app, Size { columns, rows })))
}

/// Fits the screen and the app to the terminal's present size.
fn refit(app: &mut App, screen: &mut terminal::Screen) -> Result<()> {
    screen.start_afresh()?;
    let (columns, rows) = crossterm::terminal::size()?;
    app.resize(columns, rows);
    Ok(())
}

fn attend(
    app: &mut App,
    slot: &Slot,
    inbox: &Receiver<Event>,
    screen: &mut terminal::Screen,
) -> Result<()> {
    let (columns, rows) = crossterm::terminal::size()?;
    app.resize(columns, rows);
    screen.draw(app)?;
    // Between the order to stop and the word that the process goes on, the screen is the shell's.
    let mut is_away = false;
    while let Ok(first) = inbox.recv() {
        #[cfg(debug_assertions)]
        fault::strike("screen");
        // Whatever else has come in is answered with the same drawing.
        for event in std::iter::once(first).chain(inbox.try_iter()) {
            match event {
                Event::Key(key) => app.press(key),
                Event::Point(gesture) => app.point(gesture),
                Event::Frame => {
                    if let Some(frame) = slot.take() {
                        app.take_frame(frame);
                    }
                }
                Event::Notice(text) => app.notice = Some(text),
                Event::Companion(answer) => app.companion = Some(answer),
                Event::Resize if is_away => {}
                Event::Suspend => app.suspend = true,
                Event::Resize => refit(app, screen)?,
                Event::Continue => {
                    screen.take_back()?;
                    refit(app, screen)?;
                    is_away = false;
                }
                Event::HangUp | Event::WorkerGone => return Ok(()),
            }
        }
        if app.leave.is_some() {
            return Ok(());
        }
        if std::mem::take(&mut app.suspend) && !is_away {
            screen.give_back();
            is_away = suspend::stop();
            if !is_away {
                app.notice = Some("there is no shell to go back to".into());
                screen.take_back()?;
            }
        }
        if !is_away {
            screen.draw(app)?;
        }
    }
    Ok(())
}

/// Says so when it ends, whichever way it ends.
struct LastWord(Sender<Event>);

impl Drop for LastWord {
    fn drop(&mut self) {
        let _ = self.0.send(Event::WorkerGone);
    }
}

fn spawn_worker(
    worker: Worker,
    keeping: Option<Keeping>,
    orders: Receiver<Order>,
    events: Sender<Event>,
) -> Result<thread::JoinHandle<Option<String>>> {
    thread::Builder::new()
        .name("simulation".into())
        .spawn(move || {
            let _last_word = LastWord(events);
            worker.serve_and_keep(&orders, keeping)
        })
        .context("cannot start the simulation's thread")
}

/// Reads keyboard and mouse until the terminal is gone. The thread ends with the process.
fn listen_for_hands(events: Sender<Event>, capture: Capture) {
    thread::spawn(move || {
        let mut mouse = Mouse::default();
        loop {
            let event = match event::read() {
                Ok(event::Event::Key(key)) if key.kind != KeyEventKind::Release => {
                    Key::of_event(&key).map(Event::Key)
                }
                Ok(event::Event::Mouse(event)) if capture == Capture::Clicks => {
                    mouse.gesture(&event, Instant::now()).map(Event::Point)
                }
                Ok(event::Event::Resize(_, _)) => Some(Event::Resize),
                Ok(_) => None,
                Err(_) => Some(Event::HangUp),
            };
            let over = matches!(event, Some(Event::HangUp));
            if event.is_some_and(|event| events.send(event).is_err()) || over {
                return;
            }
        }
    });
}

/// SIGTERM, SIGINT and SIGHUP end the explorer as `q` does; SIGTSTP and SIGCONT stop it and have it
/// go on.
fn listen_for_signals(events: Sender<Event>) -> Result<()> {
    let mut signals = Signals::new([SIGTERM, SIGINT, SIGHUP, SIGTSTP, SIGCONT])
        .context("cannot listen for signals")?;
    thread::spawn(move || {
        for signal in signals.forever() {
            let event = match signal {
                SIGTSTP => Event::Suspend,
                SIGCONT => Event::Continue,
                _ => Event::HangUp,
            };
            if events.send(event).is_err() {
                return;
            }
        }
    });
    Ok(())
}

fn refuse_what_is_no_terminal() -> Result<(), NoTerminal> {
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

fn theme(options: &Options) -> Theme {
    let no_color = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let colored = options.colored.unwrap_or(!no_color);
    // The console of Linux has half blocks in its fonts, but no Braille.
    let is_console = std::env::var("TERM").is_ok_and(|term| term == "linux");
    let marker = options.marker.unwrap_or(match utf8_locale() {
        true if is_console => Marker::HalfBlock,
        true => Marker::Braille,
        false => Marker::Ascii,
    });
    let look = match options.look {
        _ if !colored => Look::Mono,
        Some(look) => look,
        None if light_background() => Look::Light,
        None => Look::Dark,
    };
    Theme::new(look, marker)
}

/// Whether the terminal says that its background is light: the last number of COLORFGBG.
fn light_background() -> bool {
    let colors = std::env::var("COLORFGBG").unwrap_or_default();
    matches!(colors.rsplit(';').next(), Some("7" | "15"))
}

/// Whether the locale says UTF-8: the first of LC_ALL, LC_CTYPE and LANG that is set decides, and a
/// terminal that says nothing is taken for a modern one.
fn utf8_locale() -> bool {
    ["LC_ALL", "LC_CTYPE", "LANG"]
        .iter()
        .find_map(|name| std::env::var(name).ok().filter(|value| !value.is_empty()))
        .is_none_or(|locale| {
            let locale = locale.to_ascii_lowercase();
            locale.contains("utf-8") || locale.contains("utf8")
        })
}
