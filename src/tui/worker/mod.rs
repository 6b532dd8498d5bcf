//! The worker: a thread that owns the simulation, handles orders between steps and publishes frames.
//!
//! It steps no further ahead than the pace allows, and publishes a frame only after the previous one has been taken, so
//! that a slow terminal does not slow the simulation down.
//!
//! The orders are grouped by subject, one file each.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use super::autosave::ScreenAutosave;
use super::beside::Twin;
use super::event::Event;
use super::frame::{Activity, Frame};
use super::ghosts::Source;
use super::loops::CycleLoads;
use super::pace::Clock;
use super::trend::Recorded;
use super::undo::Past;
use crate::panics::locked;
use crate::reading::Curves;
use companions::Rival;
use outlet::{Facts, Outlet};

mod changes;
mod companions;
mod files;
mod outlet;
mod stepping;
mod thread;
mod travel;

pub(super) use thread::WorkerThread;
pub(super) use travel::ends_cycle;

/// The notice when the user asks a failed run to continue.
const BROKEN_DOWN: &str = "the run has failed; r restarts it, m changes the method";

/// An order to the worker.
pub type Order = Box<dyn FnOnce(&mut Worker) + Send>;

/// The channel to the worker. A worker that has ended has already reported it.
#[derive(Clone)]
pub struct Orders(Sender<Order>);

impl Orders {
    /// Makes a channel, whose other end a worker must [`serve`](Worker::serve).
    pub fn channel() -> (Self, Receiver<Order>) {
        let (orders, to_worker) = channel();
        (Self(orders), to_worker)
    }

    /// Sends an order.
    pub fn send(&self, order: impl FnOnce(&mut Worker) + Send + 'static) {
        let _ = self.0.send(Box::new(order));
    }

    /// Waits until all earlier orders are done; returns the frame then, or `None` if the worker has ended.
    pub fn frame(&self) -> Option<Arc<Frame>> {
        let (reply, answer) = channel();
        self.send(move |worker| {
            let _ = reply.send(worker.settled_frame());
        });
        answer.recv().ok()
    }
}

/// The state of the worker.
pub struct Worker {
    run: Recorded,
    facts: Facts,
    past: Past,
    kept_at: Instant,
    /// The cycles of this run's snapshots.
    snapshots: Vec<f64>,
    cycle_loads: CycleLoads,
    /// The ghosts over the plots, and the run by another method.
    pub(super) ghosts: Vec<Source>,
    rival: Option<Rival>,
    /// The coarser run that estimates the errors of this one.
    twin: Option<Twin>,
    activity: Activity,
    /// The cycle to which the run goes at full speed, to pause there.
    stop_at: Option<f64>,
    /// A copy of the run from before the first change in the list of parameters, while the list is open.
    before: Option<Source>,
    /// Whether the user knows that the planned end is reached.
    told_of_end: bool,
    clock: Clock,
    /// The curves in frames.
    pub(super) curves: Curves,
    screen: Outlet,
    /// Shared with the thread that ends the program during a long step.
    autosave: Arc<Mutex<ScreenAutosave>>,
    /// Set to interrupt long orders.
    halt: Arc<AtomicBool>,
}

impl Worker {
    /// Makes a worker on a run. It publishes at most every `interval`.
    pub fn new(
        run: impl Into<Recorded>,
        events: Sender<Event>,
        interval: Duration,
        running: bool,
    ) -> Self {
        let run = run.into();
        Self {
            facts: Facts::new(&run.session),
            ghosts: Vec::new(),
            rival: None,
            twin: Twin::new(&run.session),
            autosave: Arc::new(Mutex::new(ScreenAutosave::new(
                None,
                Duration::ZERO,
                &run.session,
            ))),
            run,
            past: Past::default(),
            kept_at: Instant::now(),
            snapshots: Vec::new(),
            cycle_loads: CycleLoads::default(),
            activity: if running {
                Activity::Running
            } else {
                Activity::Paused
            },
            stop_at: None,
            before: None,
            told_of_end: false,
            clock: Clock::default(),
            curves: Curves::all(),
            screen: Outlet::new(events, interval),
            halt: Arc::default(),
        }
    }

    /// Runs [`serve`](Self::serve), saving the session regularly and at the end, even after a panic; returns the
    /// message for the user.
    fn run_with_checkpoints(mut self, orders: &Receiver<Order>) -> Option<String> {
        let served = catch_unwind(AssertUnwindSafe(|| self.serve(orders)));
        // After a panic, the interrupted step has left an inconsistent state, so the copy is saved.
        let session = served.is_ok().then(|| &self.past.line(&self.run).session);
        locked(&self.autosave).finish(session)
    }

    /// Handles orders and steps in between, until told to quit.
    pub fn serve(&mut self, orders: &Receiver<Order>) {
        self.publish();
        loop {
            crate::failpoint::hit("worker");
            self.checkpoint_if_due();
            let wait = if self.is_awaited() {
                Duration::ZERO
            } else {
                self.until_next_step()
            };
            match orders.recv_timeout(wait) {
                Err(RecvTimeoutError::Disconnected) => return,
                Ok(order) => {
                    // If many orders are waiting, not every one gets a frame.
                    for order in std::iter::once(order).chain(orders.try_iter()) {
                        order(self);
                        if self.is_over() {
                            return;
                        }
                        if self.screen.is_due() {
                            self.publish();
                        }
                        self.checkpoint_if_due();
                    }
                    self.clock.restart(self.run.simulation());
                    self.publish();
                }
                Err(RecvTimeoutError::Timeout) if self.is_awaited() => self.catch_up(),
                Err(RecvTimeoutError::Timeout) if self.activity != Activity::Running => {}
                Err(RecvTimeoutError::Timeout) => self.step_for_a_while(),
            }
        }
    }

    /// Saves the session if due.
    fn checkpoint_if_due(&mut self) {
        let session = &self.past.line(&self.run).session;
        if let Some(word) = locked(&self.autosave).save_if_due(session) {
            self.screen.notice(&word);
        }
    }

    /// Takes one step and pauses.
    pub fn step_once(&mut self) {
        self.step_manually(|_, _| true);
    }

    /// Changes the pace by this many rungs.
    pub fn change_pace(&mut self, rungs: i32) {
        self.clock.change(rungs);
    }

    /// Ends the worker.
    pub fn quit(&mut self) {
        self.halt.store(true, Ordering::Relaxed);
    }

    fn is_over(&self) -> bool {
        self.halt.load(Ordering::Relaxed)
    }
}
