//! The worker: a thread that owns the simulation, handles orders between steps and publishes frames.
//!
//! It steps no further ahead than the pace allows, and publishes a frame only after the previous one has been taken, so
//! that a slow terminal does not slow the simulation down.
//!
//! An [`Order`] reaches only the part of the worker that it concerns: the pace, the past, the running scenario, the
//! ghosts, or the files. There is one file for each.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use super::event::Event;
use super::following::Twin;
use super::frame::Frame;
use super::ghosts::Source;
use super::loops::CycleLoads;
use super::recorded::Recorded;
use super::undo::{Past, Way};
use crate::export::autosave::Autosave;
use crate::panics::locked;
use crate::reading::Curves;
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use ghosts::Ghosts;
use outlet::{Outlet, ScenarioFacts};
use pace::Pace;

pub mod changes;
pub(super) mod files;
pub mod ghosts;
mod outlet;
pub mod pace;
mod stepping;
mod thread;
mod travel;

pub(super) use thread::WorkerThread;
pub(super) use travel::ends_cycle;

/// The notice when the user asks a failed run to continue.
const BROKEN_DOWN: &str = "the run has failed; r restarts it, m changes the method";

/// An order to the worker. Closures return what to tell the user.
pub enum Order {
    /// Runs or pauses, or changes what a fast run shows.
    Run(fn(&mut Pace) -> Option<&'static str>),
    /// Changes the pace by this many rungs.
    Pace(i32),
    /// Pauses and steps until this, called with the cycles before and now, returns true.
    Step(fn(f64, f64) -> bool),
    /// Shows another stored state, and pauses.
    Travel(Way),
    /// Shows the run at a cycle, past or to come.
    GoTo(f64),
    /// Goes to the next (true) or the previous cycle at which the scenario writes a state.
    GoToPlanned(bool),
    /// Changes the scenario from here on.
    Change(SessionChange),
    /// The same. The run from before the first such change continues as a ghost, until it is dropped.
    ChangeWithGhost(SessionChange),
    /// Steps by this many places through the transform methods, of a comparison if there is one.
    Method(isize),
    /// Changes what is drawn over the plots.
    Ghosts(GhostChange),
    /// Estimates the errors of the present moment.
    EstimateErrors,
    /// Restarts the scenario as it was loaded; the user can go back to the run so far.
    Restart,
    /// Starts another scenario.
    Load(Box<Scenario>),
    /// Starts a point of a study, and closes the study's map.
    OpenPoint(Box<Scenario>),
    /// Continues another run.
    Continue(Box<Recorded>),
    /// Makes something of the run, for a file or for the screen.
    Make(RunTask),
    /// Selects the curves in frames.
    Show(Curves),
    /// Returns the frame after all companions have caught up.
    Answer(Sender<Arc<Frame>>),
    /// Ends the worker.
    Quit,
}

/// A change of a run from here on; returns what it has done.
pub type SessionChange = Box<dyn FnOnce(&mut Session) -> Result<String, SessionError> + Send>;

/// A change of what is drawn over the plots of a run; returns the notice about it.
pub type GhostChange = Box<dyn FnOnce(&mut Ghosts, &Recorded) -> Option<String> + Send>;

/// Makes something of the run, and sends it to the screen.
pub type RunTask = Box<dyn FnOnce(&Recorded, &mut Outlet) + Send>;

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
    pub fn send(&self, order: Order) {
        let _ = self.0.send(order);
    }

    /// Waits until all earlier orders are done; returns the frame then, or `None` if the worker has ended.
    pub fn frame(&self) -> Option<Arc<Frame>> {
        let (reply, answer) = channel();
        self.send(Order::Answer(reply));
        answer.recv().ok()
    }
}

/// The state of the worker.
pub struct Worker {
    /// The run on the screen, present or past.
    run: Recorded,
    facts: ScenarioFacts,
    past: Past,
    ghosts: Ghosts,
    /// The coarser run that estimates the errors of this one.
    twin: Option<Twin>,
    pace: Pace,
    /// The curves in frames, and the loads of the last cycle if they are among them.
    curves: Curves,
    cycle_loads: CycleLoads,
    screen: Outlet,
    /// Shared with the thread that ends the program during a long step.
    autosave: Arc<Mutex<Autosave<Recorded>>>,
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
        let autosave = Autosave::new(None, None, Duration::ZERO, run.clone());
        Self {
            facts: ScenarioFacts::new(&run.session),
            ghosts: Ghosts::default(),
            twin: Twin::new(&run.session),
            autosave: Arc::new(Mutex::new(autosave)),
            run,
            past: Past::default(),
            pace: Pace::new(running),
            curves: Curves::all(),
            cycle_loads: CycleLoads::default(),
            screen: Outlet::new(events, interval),
            halt: Arc::default(),
        }
    }

    /// Begins with these ghosts over the plots.
    #[must_use]
    pub(super) fn with_ghosts(mut self, ghosts: Vec<Source>) -> Self {
        self.ghosts.fixed = ghosts;
        self
    }

    /// Runs [`serve`](Self::serve), saving the session regularly and at the end, even after a panic; returns the
    /// message for the user.
    fn run_with_checkpoints(mut self, orders: &Receiver<Order>) -> Option<String> {
        let served = catch_unwind(AssertUnwindSafe(|| self.serve(orders)));
        // After a panic, the interrupted step has left an inconsistent state, so the copy is saved.
        let run = served.is_ok().then(|| self.past.line(&self.run));
        locked(&self.autosave).finish(run)
    }

    /// Handles orders and steps in between, until ordered to quit.
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
                        self.carry_out(order);
                        if self.is_over() {
                            return;
                        }
                        if self.screen.is_due() {
                            self.publish();
                        }
                        self.checkpoint_if_due();
                    }
                    self.pace.restart(self.run.simulation());
                    self.publish();
                }
                Err(RecvTimeoutError::Timeout) if self.is_awaited() => self.catch_up(),
                Err(RecvTimeoutError::Timeout) if self.pace.is_running() => {
                    self.step_for_a_while();
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
    }

    fn carry_out(&mut self, order: Order) {
        match order {
            Order::Run(act) => self.screen.tell(act(&mut self.pace)),
            Order::Pace(rungs) => self.pace.change(rungs),
            Order::Step(is_done) => self.step_manually(is_done),
            Order::Travel(way) => self.travel(way),
            Order::GoTo(cycle) => self.go_to(cycle),
            Order::GoToPlanned(forward) => self.go_to_planned(forward),
            Order::Change(change) => self.change(change, false),
            Order::ChangeWithGhost(change) => self.change(change, true),
            Order::Method(places) => self.change_method(places),
            Order::Ghosts(act) => self.screen.tell(act(&mut self.ghosts, &self.run)),
            Order::EstimateErrors => self.compare_twin(true),
            Order::Restart => self.restart(),
            Order::Load(scenario) => _ = self.load(*scenario),
            Order::OpenPoint(scenario) => {
                if self.load(*scenario) {
                    self.publish();
                    self.screen.send(Event::Opened);
                }
            }
            Order::Continue(run) => self.replace_run(*run),
            Order::Make(make) => make(&self.run, &mut self.screen),
            Order::Show(curves) => self.curves = curves,
            Order::Answer(reply) => _ = reply.send(self.settled_frame()),
            Order::Quit => self.halt.store(true, Ordering::Relaxed),
        }
    }

    /// Saves the session if due.
    fn checkpoint_if_due(&mut self) {
        let run = self.past.line(&self.run);
        let word = locked(&self.autosave).update(&run.session, || run.clone());
        self.screen.tell(word);
    }

    fn is_over(&self) -> bool {
        self.halt.load(Ordering::Relaxed)
    }
}
