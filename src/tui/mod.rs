//! The explorer: a worker thread steps the simulation, an input thread reads the keys, an output
//! thread writes to the terminal, and the main thread connects them without ever waiting for one.
//!
//! ```text
//!              keys ── Event ──▶ App ── Order ──▶ worker (Session)
//!                               ▲ │ ▲                │
//! terminal ◀── output ◀── bytes ──┘ └─ Event, Frame ─┘
//! ```
//!
//! On exit the session is saved within a second, whatever the terminal and the worker are doing:
//! the terminal gets a moment to take the last output, and if the worker is in a long step, its
//! most recent copy is saved instead.

use std::fs;
use std::io::{self, IsTerminal};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, TryLockError};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};
use signal_hook::consts::{
    SIGABRT, SIGALRM, SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP, SIGUSR1, SIGUSR2,
    SIGWINCH, SIGXCPU,
};
use signal_hook::iterator::Signals;

use crate::scenario::session::Session;

pub mod ansi_backend;
pub mod app;
pub mod autosave;
mod beside;
pub mod command;
mod comparison;
mod cycle_loads;
mod figure;
mod flow;
pub mod footer;
pub mod frame;
pub mod ghosts;
mod held;
mod input;
pub mod keys;
pub mod layout;
pub mod line;
pub mod manual;
pub mod map;
pub mod mouse;
mod output;
pub mod overlays;
pub mod pace;
pub mod panels;
mod present;
mod readout;
pub mod refinement_check;
pub mod screen;
mod script;
pub mod settings;
pub mod snapshot;
mod suspend;
mod terminal;
mod timeline;
pub mod tour;
pub mod trend;
mod twin;
mod undo;
pub mod worker;

use crate::plot::Marker;
pub use crate::plot::theme;
use app::{App, Leave};
use autosave::ScreenAutosave;
use flow::When;
use frame::Slot;
use input::Waiting;
use keys::Key;
use mouse::Gesture;
use overlays::Overlay;
use refinement_check::RefinementCheck;
pub use script::{Format, Script, Size, Stroke, rehearse};
pub use terminal::Capture;
use theme::{Depth, Look, Theme};
use worker::{Order, Orders, Worker};

/// The default preset, whose tour begins by itself.
pub(crate) const FIRST: &str = "li2019-fig3";

/// How long the worker may take to finish its step on exit.
const PATIENCE: Duration = Duration::from_millis(500);

/// How long a checkpoint being written may take on exit.
const PATIENCE_WITH_DISKS: Duration = Duration::from_secs(5);

/// An event for the main thread.
#[derive(Debug)]
pub enum Event {
    /// A key was pressed.
    Key(Key),
    /// Text was pasted.
    Paste(String),
    /// The mouse was used.
    Point(Gesture),
    /// The terminal has read a frame.
    Ready,
    /// The background of the terminal is of this red, green and blue.
    Background([u8; 3]),
    /// A frame was written.
    Written,
    /// The terminal has another size.
    Resize,
    /// A frame waits in the slot.
    Frame,
    /// A notice for the user.
    Notice(String),
    /// A file that was asked for could not be written, and why: a notice, and a failure of a script.
    Unwritten(String),
    /// The refinement_check has come to its end.
    RefinementCheck(Result<RefinementCheck, String>),
    /// A study has begun.
    Sweep(map::live::Live),
    /// The process is asked to suspend.
    Suspend,
    /// The process continues after a suspension.
    Continue,
    /// The terminal has closed, or the process was asked to end.
    HangUp,
    /// The worker has ended.
    WorkerGone,
}

/// What the explorer is opened with.
pub struct Options {
    /// The session to show.
    pub session: Session,
    /// What is known of its past.
    pub past: Option<trend::Trend>,
    /// What lies over the plots.
    pub ghosts: Vec<ghosts::Source>,
    /// Whether it runs at once.
    pub running: bool,
    /// Directory for checkpoints; `None`: no checkpoints.
    pub keep_in: Option<PathBuf>,
    /// Their interval; `None`: only at the end.
    pub keep_every: Option<Duration>,
    /// Maximum frame rate per second.
    pub fps: u16,
    /// Characters for curves; by default from the locale.
    pub marker: Option<Marker>,
    /// Whether to use colour; by default from NO_COLOR.
    pub colored: Option<bool>,
    /// The colours; by default from the background that the terminal reports.
    pub look: Option<Look>,
    /// Whether it is for a projector.
    pub present: bool,
    /// Who handles the mouse.
    pub mouse: Capture,
    /// Keys to press instead of reading the keyboard, and the screen to print.
    pub script: Option<Script>,
}

/// There is no usable terminal.
#[derive(Debug, thiserror::Error)]
#[error("{0}; mdr-tui run SCENARIO works without a screen")]
pub struct NoTerminal(&'static str);

/// What to print after the terminal is restored.
#[derive(Debug, Default)]
pub struct Farewell {
    /// Where the session is saved.
    pub word: Option<String>,
    /// The last screen, if it should stay visible.
    pub screen: Option<String>,
}

/// Opens the explorer, or plays a script of keys to it.
pub fn run(options: Options) -> Result<Farewell> {
    if options.script.is_none() {
        refuse_what_is_no_terminal()?;
    }
    let theme = theme(&options);
    let is_first = is_first_time(&options);
    let origin = options.session.loaded().origin().to_owned();
    let waiting = Arc::new(Waiting::default());
    let (orders, to_worker) = Orders::channel();
    let (events, from_threads) = channel();
    let slot = Arc::new(Slot::default());
    let interval = Duration::from_secs_f64(1.0 / f64::from(options.fps));
    let keeping = options
        .keep_in
        .filter(|_| options.script.is_none())
        .map(|directory| ScreenAutosave::new(directory, options.keep_every, &options.session))
        .map(|keeping| Arc::new(Mutex::new(keeping)));
    let worker = Worker::new(
        options.session,
        Arc::clone(&slot),
        events.clone(),
        interval,
        options.running && options.script.is_none(),
    )
    .with_past(options.past)
    .with_ghosts(options.ghosts);
    let halt = worker.halt();
    let mut app = App::new(theme, orders.clone());
    if options.present {
        app.present();
    } else if is_first && let Ok(size) = terminal::size() {
        app.resize(size.width, size.height);
        app.welcome(&origin);
    }
    crate::panics::keep();
    let kept = spawn_worker(worker, keeping.clone(), to_worker, events.clone())?;
    let end_worker = || {
        halt.store(true, Ordering::SeqCst);
        orders.send(Worker::quit);
    };
    let outcome = match options.script {
        Some(script) => {
            survive(|| script::play(&mut app, &script, &orders, &from_threads).map(|()| None))
        }
        None => {
            let ways = Ways {
                slot: &slot,
                events: &events,
                inbox: &from_threads,
                waiting: &waiting,
            };
            converse(&mut app, options.mouse, &ways, end_worker)
        }
    };
    end_worker();
    let kept = farewell(&kept, keeping.as_deref());
    if let Some(word) = crate::panics::word() {
        let kept = kept.unwrap_or_else(|| "there was nothing to save".into());
        bail!("bug in mdr-tui: {word}; {kept}");
    }
    match (outcome, kept) {
        (Err(error), Some(kept)) => Err(error.context(kept)),
        (outcome, word) => outcome.map(|screen| Farewell { word, screen }),
    }
}

/// Whether nobody has seen a running contact on a screen before: it is then shown large, and the default preset
/// begins its tour.
fn is_first_time(options: &Options) -> bool {
    let is_live = options.script.is_none() && options.running;
    let Some(keep_in) = options.keep_in.as_ref().filter(|_| is_live) else {
        return false;
    };
    let seen = keep_in.join("tour-seen");
    // If no file can be written, every time would be the first, so skip it.
    !seen.exists()
        && fs::create_dir_all(keep_in).is_ok()
        && fs::write(&seen, "The contact and the tour have been shown once.\n").is_ok()
}

/// Returns the worker's message about what it has saved. A worker in the middle of a long step is
/// not waited for: its most recent copy is saved instead.
fn farewell(
    kept: &Receiver<Option<String>>,
    keeping: Option<&Mutex<ScreenAutosave>>,
) -> Option<String> {
    match kept.recv_timeout(PATIENCE) {
        Ok(word) => return word,
        Err(RecvTimeoutError::Disconnected) => return None,
        Err(RecvTimeoutError::Timeout) => {}
    }
    match keeping?.try_lock() {
        Ok(mut keeping) => keeping.finish(None),
        Err(TryLockError::Poisoned(keeping)) => keeping.into_inner().finish(None),
        // It is being saved, which may take a while on a slow disk.
        Err(TryLockError::WouldBlock) => kept.recv_timeout(PATIENCE_WITH_DISKS).ok().flatten(),
    }
}

/// The channels to the main thread.
struct Ways<'a> {
    slot: &'a Slot,
    events: &'a Sender<Event>,
    inbox: &'a Receiver<Event>,
    waiting: &'a Arc<Waiting>,
}

/// Draws and handles events until the user quits, then ends the worker while the terminal is being
/// restored. Returns the last screen if it should stay visible.
fn converse(
    app: &mut App,
    mouse: Capture,
    ways: &Ways,
    end_worker: impl Fn(),
) -> Result<Option<String>> {
    listen_for_signals(ways.events.clone(), Arc::clone(ways.waiting))?;
    let asks = app.theme.follows_background;
    let screen = terminal::Screen::open(mouse, asks, ways.events.clone());
    let mut screen = screen.context("cannot take over the terminal")?;
    let (events, waiting) = (ways.events.clone(), Arc::clone(ways.waiting));
    thread::spawn(move || input::listen(&events, &waiting, mouse));
    let outcome = survive(|| attend(app, ways, &mut screen));
    end_worker();
    hear_out(&mut screen, ways.inbox);
    let is_restored = screen.give_back();
    match outcome {
        // A terminal that closes while being drawn on has hung up; this is not an error.
        Err(_) if !io::stdout().is_terminal() => return Ok(None),
        outcome => outcome?,
    }
    if app.leave != Some(Leave::KeepScreen) || !is_restored {
        return Ok(None);
    }
    let size = terminal::size()?;
    let (columns, rows) = (size.width, size.height.saturating_sub(1));
    Ok(Some(script::text(app, Size { columns, rows })))
}

/// Carries out `action`. A panic in it is told by the caller of [`converse`], when the terminal is
/// itself again.
fn survive<T: Default>(action: impl FnOnce() -> Result<T>) -> Result<T> {
    catch_unwind(AssertUnwindSafe(action)).unwrap_or_else(|_| Ok(T::default()))
}

/// Fits the screen and the app to the terminal's present size.
fn refit(app: &mut App, screen: &mut terminal::Screen) -> Result<()> {
    screen.start_afresh()?;
    let size = terminal::size()?;
    app.resize(size.width, size.height);
    Ok(())
}

/// Waits for outstanding answers of the terminal, so that they do not reach the shell.
fn hear_out(screen: &mut terminal::Screen, inbox: &Receiver<Event>) {
    let end = Instant::now() + PATIENCE;
    while screen.flow().is_awaited(Instant::now()) {
        match inbox.recv_timeout(end.saturating_duration_since(Instant::now())) {
            Ok(Event::Ready) => screen.flow().answered(Instant::now()),
            Ok(_) => {}
            Err(_) => return,
        }
    }
}

fn attend(app: &mut App, ways: &Ways, screen: &mut terminal::Screen) -> Result<()> {
    let size = terminal::size()?;
    app.resize(size.width, size.height);
    let mut is_due = !screen.draw(app)?;
    // Between suspension and continuation, the screen belongs to the shell.
    let mut is_away = false;
    loop {
        let wait = match screen.when() {
            When::At(then) if is_due && !is_away => {
                Some(then.saturating_duration_since(Instant::now()))
            }
            _ => None,
        };
        let first = match wait {
            Some(wait) => match ways.inbox.recv_timeout(wait) {
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
                event => event.ok(),
            },
            None => match ways.inbox.recv() {
                Err(_) => return Ok(()),
                event => event.ok(),
            },
        };
        #[cfg(debug_assertions)]
        crate::failpoint::hit("screen");
        // Whatever else has come in is answered with the same drawing.
        for event in first.into_iter().chain(ways.inbox.try_iter()) {
            if ways.waiting.is_over() {
                return Ok(());
            }
            is_due |= !matches!(event, Event::Ready | Event::Written);
            match event {
                Event::Key(key) => {
                    ways.waiting.leave();
                    screen.flow().hurry(Instant::now());
                    app.press(key);
                }
                Event::Paste(text) => {
                    ways.waiting.leave();
                    screen.flow().hurry(Instant::now());
                    app.paste(&text);
                }
                Event::Point(gesture) => {
                    screen.flow().hurry(Instant::now());
                    app.point(gesture);
                }
                Event::Ready => screen.flow().answered(Instant::now()),
                Event::Background(color) => app.theme.follow(color),
                Event::Written => screen.flow().written(),
                Event::Frame => {
                    if let Some(frame) = ways.slot.take() {
                        app.take_frame(frame);
                    }
                }
                Event::Notice(text) | Event::Unwritten(text) => app.notice = Some(text),
                Event::RefinementCheck(answer) => app.refinement_check = Some(answer),
                Event::Sweep(live) => app.overlay = Overlay::Sweep(live),
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
            if app.leave.is_some() {
                return Ok(());
            }
        }
        if ways.waiting.has_dropped() {
            app.notice = Some(
                "keys came faster than they could be handled; some were \
                dropped"
                    .into(),
            );
        }
        if std::mem::take(&mut app.suspend) && !is_away {
            hear_out(screen, ways.inbox);
            if ways.waiting.is_over() {
                return Ok(());
            }
            screen.give_back();
            is_away = suspend::stop();
            if !is_away {
                app.notice = Some("there is no shell to return to".into());
                screen.take_back()?;
            }
        }
        if !is_away && is_due && screen.when() == When::Now {
            is_due = !screen.draw(app)?;
        }
    }
}

/// Reports its end, however it ends.
struct LastWord(Sender<Event>);

impl Drop for LastWord {
    fn drop(&mut self) {
        let _ = self.0.send(Event::WorkerGone);
    }
}

/// Starts the worker; its final message about what it has saved comes from the returned receiver.
fn spawn_worker(
    worker: Worker,
    keeping: Option<Arc<Mutex<ScreenAutosave>>>,
    orders: Receiver<Order>,
    events: Sender<Event>,
) -> Result<Receiver<Option<String>>> {
    let (tell, kept) = channel();
    thread::Builder::new()
        .name("simulation".into())
        .spawn(move || {
            let _last_word = LastWord(events);
            let _ = tell.send(worker.serve_and_keep(&orders, keeping));
        })
        .context("cannot start the simulation's thread")?;
    Ok(kept)
}

/// Signals that ask a process to end do so as `q` does, before all waiting keys; SIGTSTP and
/// SIGCONT suspend and continue it.
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
    let theme = theme_of(options.marker, options.colored, options.look);
    let is_picture = |script: &Script| script.format == Format::Svg;
    match options.script.as_ref().is_some_and(is_picture) {
        true => theme.with_depth(Depth::Indexed),
        false => theme,
    }
}

/// The theme of this terminal, unless one was chosen.
pub fn theme_of(marker: Option<Marker>, colored: Option<bool>, look: Option<Look>) -> Theme {
    let no_color = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let colored = colored.unwrap_or(!no_color);
    // The console of Linux has half blocks in its fonts, but no Braille.
    let is_console = std::env::var("TERM").is_ok_and(|term| term == "linux");
    let marker = marker.unwrap_or(match utf8_locale() {
        true if is_console => Marker::HalfBlock,
        true => Marker::Braille,
        false => Marker::Ascii,
    });
    // The console of Linux does not know the question for its background and would print it.
    let follows_background = look.is_none() && colored && !is_console;
    let look = match look {
        _ if !colored => Look::Mono,
        Some(look) => look,
        None if light_background() => Look::Light,
        None => Look::Dark,
    };
    let variable = |name: &str| std::env::var(name).unwrap_or_default();
    let depth = Depth::of(&variable("COLORTERM"), &variable("TERM"));
    Theme {
        follows_background,
        ..Theme::new(look, marker).with_depth(depth)
    }
}

/// Whether the terminal says that its background is light: the last number of COLORFGBG.
fn light_background() -> bool {
    let colors = std::env::var("COLORFGBG").unwrap_or_default();
    matches!(colors.rsplit(';').next(), Some("7" | "15"))
}

/// Whether the locale says UTF-8: the first of LC_ALL, LC_CTYPE and LANG that is set decides;
/// without any, the terminal is assumed to be a modern one.
fn utf8_locale() -> bool {
    ["LC_ALL", "LC_CTYPE", "LANG"]
        .iter()
        .find_map(|name| std::env::var(name).ok().filter(|value| !value.is_empty()))
        .is_none_or(|locale| {
            let locale = locale.to_ascii_lowercase();
            locale.contains("utf-8") || locale.contains("utf8")
        })
}
