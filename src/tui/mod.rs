//! The explorer. A worker thread steps the simulation, an input thread reads the keys, an output thread writes to the
//! terminal, and the main thread connects them without ever waiting for one.
//!
//! ```text
//!              keys ── Event ──▶ App ── Order ──▶ worker (Session)
//!                               ▲ │ ▲                │
//! terminal ◀── output ◀── bytes ──┘ └─ Event, Frame ─┘
//! ```
//!
//! On exit the session is saved within a second, whatever the terminal and the worker are doing: the terminal gets a
//! moment for the last output, and if the worker is in a long step, its most recent copy is saved instead.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::channel;
use std::time::Duration;

use anyhow::{Result, bail};

pub mod ansi_writer;
pub mod app;
mod appearance;
mod canvas;
mod clipboard;
pub mod command;
mod completion;
pub mod cursor;
pub mod event;
mod event_loop;
pub mod explorer;
mod figure;
pub mod flow;
mod following;
pub mod footer;
pub mod frame;
pub mod ghosts;
mod held;
mod input;
pub mod keys;
pub mod layout;
pub mod line;
mod live_charts;
pub mod loops;
pub mod manual;
pub mod map;
pub mod modes;
pub mod mouse;
mod output;
pub mod overlays;
pub mod panels;
mod present;
pub mod reader;
mod readout;
pub mod recorded;
mod remembered;
pub mod screen;
mod script;
pub mod settings;
pub mod snapshot;
pub mod stage;
mod suspend;
mod terminal;
mod timeline;
pub mod tour;
mod undo;
pub mod worker;

use crate::export::autosave::{Autosave, left_by_a_crash};
use crate::export::file::shell_path;
use crate::panics::catch;
use crate::plot::theme::Theme;
use app::App;
pub use appearance::theme_of;
use event::Event;
pub use event_loop::NoTerminal;
use explorer::Next;
use recorded::Recorded;
use remembered::Remembered;
pub use script::{Script, ScriptStep, parse_size, press, text};
use worker::{Orders, Worker, WorkerThread};

/// Options for opening the explorer.
pub struct Options {
    /// The run to show.
    pub run: Recorded,
    /// The overlays on the plots.
    pub ghosts: Vec<ghosts::Source>,
    /// Whether it runs at once.
    pub running: bool,
    /// Directory for checkpoints; `None` saves none.
    pub keep_in: Option<PathBuf>,
    /// The checkpoint interval; 0 saves only at the end.
    pub keep_every: Duration,
    /// Maximum frame rate per second.
    pub fps: u16,
    /// The look of the terminal, from [`theme_of`].
    pub theme: Theme,
    /// The map of a study to begin with.
    pub map: Option<map::live::LiveStudy>,
    /// Whether to present on a projector.
    pub present: bool,
    /// The panels to show first.
    pub panels: Vec<panels::Panel>,
    /// Whether the explorer uses clicks and the wheel; otherwise the terminal selects text with them.
    pub mouse: bool,
    /// Keys to press instead of reading the keyboard, and the screen to print.
    pub script: Option<Script>,
}

/// What to print after the terminal is restored.
#[derive(Debug, Default)]
pub struct Farewell {
    /// Where the session is saved.
    pub saved: Option<String>,
    /// The last screen, if it should stay visible.
    pub screen: Option<String>,
}

/// Opens the explorer, or plays a script of keys to it.
pub fn run(options: Options) -> Result<Farewell> {
    let is_live = options.script.is_none();
    if is_live {
        event_loop::require_terminal()?;
    }
    let is_first = is_first_time(&options);
    let origin = options.run.session.loaded().origin().to_owned();
    let (orders, to_worker) = Orders::channel();
    let (events, from_threads) = channel();
    let interval = Duration::from_secs_f64(1.0 / f64::from(options.fps));
    let keep_in = options.keep_in.filter(|_| is_live);
    let looks_in = keep_in
        .clone()
        .filter(|_| !options.present && options.map.is_none());
    let running = options.running && is_live;
    let killed = keep_in.as_deref().filter(|_| running);
    if let Some(path) = killed.and_then(left_by_a_crash) {
        let path = shell_path(&path);
        let word = format!("a session was killed; mdr-tui --resume {path} continues it");
        let _ = events.send(Event::Notice(line::one_line(&word)));
    }
    let autosave = Autosave::new(None, keep_in, options.keep_every, options.run.clone());
    let worker = Worker::new(options.run, events.clone(), interval, running);
    let mut worker = worker.with_ghosts(options.ghosts);
    let mut app = App::new(options.theme, orders.clone(), Arc::new(worker.frame()));
    app.explorer.stage.put_first(options.panels);
    if let Some(map) = options.map {
        let events = events.clone();
        map.watch(move || events.send(Event::News).is_ok());
        app.handle(Event::Sweep(map));
    } else if options.present {
        app.explorer.stage.present();
    } else if is_first && let Ok(size) = terminal::size() {
        app.explorer.resize(size);
        app.explorer.stage.welcome(&origin);
    } else if let Some(directory) = &looks_in {
        Remembered::read(directory).apply(&mut app.explorer);
    }
    crate::panics::capture();
    let worker = WorkerThread::start(worker, orders.clone(), to_worker, autosave)?;
    let outcome = match options.script {
        Some(script) => catch(|| script::play(&mut app, &script, &from_threads).map(|()| None)),
        None => {
            let end = || worker.end();
            let shown = event_loop::run(&mut app, options.mouse, &events, &from_threads, end);
            if let Some(directory) = &looks_in {
                Remembered::new(&app.explorer).write(directory);
            }
            shown.and_then(|is_restored| left_behind(&app, is_restored))
        }
    };
    worker.end();
    let kept = worker.saved();
    if let Some(word) = crate::panics::take_message() {
        let kept = kept.unwrap_or_else(|| "there was nothing to save".into());
        bail!("bug in mdr-tui: {word}; {kept}");
    }
    match (outcome, kept) {
        (Err(error), Some(kept)) => Err(error.context(kept)),
        (outcome, saved) => outcome.map(|screen| Farewell { saved, screen }),
    }
}

/// Whether the user sees a running contact for the first time. It is then shown large, and the default preset begins
/// its tour.
fn is_first_time(options: &Options) -> bool {
    let is_live = options.script.is_none() && options.running;
    let Some(keep_in) = options.keep_in.as_ref().filter(|_| is_live) else {
        return false;
    };
    let seen = keep_in.join("tour-seen");
    // If the file cannot be written, every time would be the first, so skip it.
    !seen.exists()
        && fs::create_dir_all(keep_in).is_ok()
        && fs::write(&seen, "The contact and the tour have been shown once.\n").is_ok()
}

/// Returns the last screen, if it should stay visible.
fn left_behind(app: &App, is_restored: bool) -> Result<Option<String>> {
    if app.explorer.next != Next::LeaveScreen || !is_restored {
        return Ok(None);
    }
    let mut size = terminal::size()?;
    size.height = size.height.saturating_sub(1);
    Ok(Some(script::text(app, size)))
}
