//! The worker: a thread that owns the simulation, handles orders between steps and publishes
//! frames.
//!
//! It steps no further ahead than the pace allows, and publishes a frame only after the previous
//! one has been taken, so that a slow terminal does not slow the simulation.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::Event;
use super::autosave::ScreenAutosave;
use super::comparison::{ComparisonRun, From};
use super::cycle_loads::CycleLoads;
use super::figure;
use super::frame::{Activity, Frame, Slot};
use super::ghosts::{self, Source};
use super::line::one_line;
use super::map::live::{Live, Range};
use super::pace::{Meter, Pace};
use super::refinement_check;
use super::settings::Setting;
use super::snapshot::{self, Opened};
use super::trend::Trend;
use super::twin::Twin;
use super::undo::Past;
use crate::math::scan::largest;
use crate::reading::Curves;
use crate::reading::subsurface::Stress;
use crate::scenario::session::Session;
use crate::simulation::Passed;
use crate::studies::theory::Theory;

mod changes;
mod stepping;
mod travel;

use travel::ends_cycle;

/// How long a comparison catches up before the worker looks for orders again.
const CATCH_UP: Duration = Duration::from_millis(10);

/// What the worker is to do next.
pub type Order = Box<dyn FnOnce(&mut Worker) + Send>;

/// The way to the worker. One that has ended has reported it already.
#[derive(Clone)]
pub struct Orders(Sender<Order>);

impl Orders {
    /// A way to a worker that is to [`serve`](Worker::serve) its other end.
    pub fn channel() -> (Self, Receiver<Order>) {
        let (orders, to_worker) = channel();
        (Self(orders), to_worker)
    }

    /// Sends an order.
    pub fn send(&self, order: impl FnOnce(&mut Worker) + Send + 'static) {
        let _ = self.0.send(Box::new(order));
    }

    /// Waits until all earlier orders are carried out; returns the frame then, and `None` if the worker has ended.
    pub fn frame(&self) -> Option<Arc<Frame>> {
        let (reply, answer) = channel();
        self.send(move |worker| {
            let _ = reply.send(worker.settled_frame());
        });
        answer.recv().ok()
    }
}

/// The worker's side.
pub struct Worker {
    session: Session,
    comparison: Option<ComparisonRun>,
    ghosts: Vec<Source>,
    theory: Arc<Theory>,
    expected_wear: f64,
    twin: Option<Twin>,
    cycle_loads: CycleLoads,
    settings: Arc<Vec<Setting>>,
    warnings: Arc<Vec<String>>,
    /// What the warnings say of the hardness.
    passed_hardness: Option<Passed>,
    trend: Trend,
    past: Past,
    /// The cycles of the snapshots of this run.
    snapshots: Vec<f64>,
    kept_at: Instant,
    curves: Curves,
    activity: Activity,
    /// Whether the user has been told that the planned end is reached.
    told_of_end: bool,
    /// Whether frames of a fast run are taken at one phase of the motion.
    holds_phase: bool,
    rung: i32,
    meter: Meter,
    slot: Arc<Slot>,
    events: Sender<Event>,
    interval: Duration,
    published: Instant,
    stepped: Instant,
    /// Shared with whoever ends the program while a step takes long.
    keeping: Option<Arc<Mutex<ScreenAutosave>>>,
    /// Set when orders that take long are to be cut short.
    halt: Arc<AtomicBool>,
}

impl Worker {
    /// A worker on `session` that publishes at most every `interval`.
    pub fn new(
        session: Session,
        slot: Arc<Slot>,
        events: Sender<Event>,
        interval: Duration,
        running: bool,
    ) -> Self {
        let mut trend = Trend::default();
        ghosts::record(&mut trend, &session);
        let activity = if running {
            Activity::Running
        } else {
            Activity::Paused
        };
        let theory = Theory::of(session.simulation().setup());
        Self {
            expected_wear: expected_wear(&theory, &session),
            theory: Arc::new(theory),
            settings: Arc::new(Setting::all(session.scenario())),
            warnings: Arc::new(session.simulation().warnings()),
            passed_hardness: session.simulation().passed_hardness(),
            twin: Twin::of(&session),
            session,
            comparison: None,
            ghosts: Vec::new(),
            cycle_loads: CycleLoads::default(),
            trend,
            past: Past::default(),
            snapshots: Vec::new(),
            kept_at: Instant::now(),
            curves: Curves::all(),
            activity,
            told_of_end: false,
            holds_phase: true,
            rung: Pace::START,
            meter: Meter::default(),
            slot,
            events,
            interval,
            published: Instant::now(),
            stepped: Instant::now(),
            keeping: None,
            halt: Arc::default(),
        }
    }

    /// The same with a past of the run, where it is known.
    #[must_use]
    pub fn with_past(self, trend: Option<Trend>) -> Self {
        Self {
            trend: trend.unwrap_or(self.trend),
            ..self
        }
    }

    /// The same with ghosts over the plots.
    #[must_use]
    pub fn with_ghosts(self, ghosts: Vec<Source>) -> Self {
        Self { ghosts, ..self }
    }

    /// A flag that makes the worker interrupt its work, to be set before it is told to quit.
    pub fn halt(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.halt)
    }

    /// Handles orders and steps in between, until told to quit.
    pub fn serve(mut self, orders: &Receiver<Order>) {
        self.handle_orders(orders);
    }

    /// [`serve`](Self::serve), and saves the session regularly and at the end, even after a panic;
    /// returns the message for the user.
    pub fn run_with_checkpoints(
        mut self,
        orders: &Receiver<Order>,
        keeping: Option<Arc<Mutex<ScreenAutosave>>>,
    ) -> Option<String> {
        self.keeping = keeping;
        let served = catch_unwind(AssertUnwindSafe(|| self.handle_orders(orders)));
        // The interrupted step has left half a state.
        let session = served.is_ok().then(|| self.past.line(&self.session));
        let keeping = self.keeping.take()?;
        locked(&keeping).finish(session)
    }

    fn handle_orders(&mut self, orders: &Receiver<Order>) {
        self.publish();
        loop {
            #[cfg(debug_assertions)]
            crate::failpoint::hit("worker");
            self.checkpoint_if_due();
            let wait = if self.is_awaited() {
                Some(Duration::ZERO)
            } else {
                self.until_next_step()
            };
            match wait.map_or_else(
                || orders.recv().map_err(RecvTimeoutError::from),
                |wait| orders.recv_timeout(wait),
            ) {
                Err(RecvTimeoutError::Disconnected) => return,
                Ok(order) => {
                    // If many orders are waiting, not every one is shown.
                    for order in std::iter::once(order).chain(orders.try_iter()) {
                        if self.is_over() {
                            return;
                        }
                        order(self);
                        if self.is_over() {
                            return;
                        }
                        if self.published.elapsed() >= self.interval {
                            self.publish();
                        }
                        self.checkpoint_if_due();
                    }
                    self.meter.restart(self.session.simulation().cycle());
                    self.publish();
                }
                Err(RecvTimeoutError::Timeout) if self.is_awaited() => self.catch_up(),
                Err(RecvTimeoutError::Timeout) if self.activity != Activity::Running => {}
                Err(RecvTimeoutError::Timeout) => self.step_for_a_stint(),
            }
        }
    }

    /// Saves the session when due.
    fn checkpoint_if_due(&mut self) {
        let keeping = self.keeping.as_ref();
        let word =
            keeping.and_then(|keeping| locked(keeping).save_if_due(self.past.line(&self.session)));
        if let Some(word) = word {
            self.notice(&word);
        }
    }

    /// Starts a comparison, this many places after the previous one, from now or from the start.
    fn compare(&mut self, places: isize, from: From) {
        match ComparisonRun::beside(&self.session, self.comparison.as_ref(), places, from) {
            Ok(comparison) => {
                let name = comparison.name();
                self.notice(&match from {
                    From::Now => format!("comparing with {name} from here; C: from the start"),
                    From::Start => format!("comparing with {name} from the start"),
                });
                self.comparison = Some(comparison);
            }
            Err(error) => self.notice(&error.to_string()),
        }
    }

    /// Whether the comparison or a ghost is not yet where the run is.
    fn is_awaited(&self) -> bool {
        let cycle = self.session.simulation().cycle();
        let comparison = self.comparison.as_ref();
        comparison.is_some_and(|comparison| comparison.lags(cycle))
            || self.ghosts.iter().any(|ghost| ghost.lags(cycle))
            // A run does not wait for its twin.
            || self.activity != Activity::Running
                && self.twin.as_ref().is_some_and(|twin| twin.lags(cycle))
    }

    /// Lets what runs beside come nearer to the run for a moment.
    fn catch_up(&mut self) {
        let cycle = self.session.simulation().cycle();
        if let Some(comparison) = &mut self.comparison {
            comparison.follow_for(cycle, CATCH_UP);
        }
        for ghost in &mut self.ghosts {
            ghost.follow_for(cycle, CATCH_UP);
        }
        self.follow_with_twin(CATCH_UP);
        if self.published.elapsed() >= self.interval || !self.is_awaited() {
            self.publish();
        }
    }

    /// Lets the twin come nearer to the run.
    fn follow_with_twin(&mut self, budget: Duration) {
        let cycle = self.session.simulation().cycle();
        if let Some(twin) = &mut self.twin {
            twin.follow_for(cycle, budget);
        }
    }

    /// Runs the refinement check in its own thread; its result comes as an event.
    pub fn check_refinement(&self) {
        let (session, events) = (self.session.clone(), self.events.clone());
        thread::spawn(move || {
            // The receiver waits for an answer, whatever happens.
            let answer = std::panic::catch_unwind(|| refinement_check::run(&session))
                .map_err(|_| "the refinement check failed".to_owned())
                .and_then(|answer| answer.map_err(|error| error.to_string()));
            let _ = events.send(Event::RefinementCheck(answer));
        });
    }

    /// Starts a study around the present scenario, up to the present cycle.
    pub fn sweep(&self, range: &Range) {
        let cycle = self.session.simulation().cycle();
        let planned = self.session.loaded().run().cycles;
        let cycles = if cycle > 0.0 {
            cycle
        } else {
            planned.unwrap_or(1.0)
        };
        let events = self.events.clone();
        let tell = move || {
            let _ = events.send(Event::News);
        };
        match Live::start(range, self.session.scenario(), cycles, tell) {
            Ok(live) => {
                let _ = self.events.send(Event::Sweep(live));
            }
            Err(error) => self.notice(&error.to_string()),
        }
    }

    /// Takes one step, paused.
    pub fn step_once(&mut self) {
        self.step_by_hand(|_, _| true);
    }

    /// Steps to the end of the cycle, paused.
    pub fn step_to_end_of_cycle(&mut self) {
        self.step_by_hand(ends_cycle);
    }

    /// Changes the pace by this many rungs.
    pub fn change_pace(&mut self, rungs: i32) {
        self.rung = (self.rung + rungs).clamp(Pace::SLOWEST, Pace::UNLIMITED);
    }

    /// Begins or ends the comparison with another method.
    pub fn compare_or_stop(&mut self) {
        if self.comparison.take().is_none() {
            self.compare(0, From::Now);
        }
    }

    /// Compares from the start of the scenario on.
    pub fn compare_from_start(&mut self) {
        self.compare(0, From::Start);
    }

    /// Computes these curves from now on.
    pub fn compute(&mut self, curves: Curves) {
        self.curves = curves;
    }

    /// Goes on from a state that was read.
    pub fn open(&mut self, opened: Opened) {
        self.replace_run(opened.session, opened.trend);
    }

    /// Lays the present state over the panels.
    pub fn freeze(&mut self) {
        self.add_ghost(Source::frozen(&self.session, &self.trend));
    }

    /// Ends the worker.
    pub fn quit(&mut self) {
        self.halt.store(true, Ordering::Relaxed);
    }

    /// The present frame, when all that runs beside has come to it.
    fn settled_frame(&mut self) -> Arc<Frame> {
        while self.is_awaited() && !self.is_over() {
            self.catch_up();
        }
        self.follow_hardness();
        Arc::new(self.frame())
    }

    fn is_over(&self) -> bool {
        self.halt.load(Ordering::Relaxed)
    }

    /// Lays the curves of a file, a directory or a scenario over the panels.
    pub fn overlay(&mut self, given: &str) {
        let reach = self.session.simulation().setup().grid.radius();
        match Source::load(given, reach) {
            Ok(ghost) => self.add_ghost(ghost),
            Err(error) => self.notice(&error),
        }
    }

    fn add_ghost(&mut self, ghost: Source) {
        if self.ghosts.len() >= ghosts::MOST {
            let most = ghosts::MOST;
            return self.notice(&format!("{most} ghosts are there already; G removes them"));
        }
        let name = ghost.name();
        self.notice(&format!("{name} is over the plots now; G removes it"));
        self.ghosts.push(ghost);
    }

    /// Takes all of them away.
    pub fn drop_ghosts(&mut self) {
        if std::mem::take(&mut self.ghosts).is_empty() {
            self.notice("there is no ghost; g freezes this state, :overlay FILE takes a file");
        }
    }

    /// Writes the state to a new directory, with a note if there is one.
    pub fn write_snapshot(&mut self, note: Option<&str>) {
        match snapshot::write(&self.session, &self.trend, note) {
            Ok(path) => {
                self.snapshots.push(self.session.simulation().cycle());
                self.notice(&format!("snapshot in {}", path.display()));
            }
            Err(error) => self.unwritten(&error.to_string()),
        }
    }

    /// Draws a figure of the state into a file, its data beside it.
    pub fn write_figure(&self, path: &Path) {
        match figure::write(&self.session, &self.trend, path) {
            Ok(()) => self.notice(&format!("figure in {}", path.display())),
            Err(error) => self.unwritten(&error),
        }
    }

    fn unwritten(&self, text: &str) {
        let _ = self.events.send(Event::Unwritten(one_line(text)));
    }

    fn notice(&self, text: &str) {
        let _ = self.events.send(Event::Notice(one_line(text)));
    }

    fn publish(&mut self) {
        self.follow_hardness();
        self.published = Instant::now();
        if self.slot.put(Arc::new(self.frame())) {
            let _ = self.events.send(Event::Frame(Arc::clone(&self.slot)));
        }
    }

    /// The pressure may pass the hardness in any step, and has not yet in an earlier state.
    fn follow_hardness(&mut self) {
        let passed = self.session.simulation().passed_hardness();
        if self.passed_hardness != passed {
            self.passed_hardness = passed;
            self.warnings = Arc::new(self.session.simulation().warnings());
        }
    }

    fn frame(&self) -> Frame {
        let simulation = self.session.simulation();
        let scenario = self.session.scenario();
        // A comparison subtracts profiles; the screen that asked for it may not have shown one.
        let compared = match self.comparison {
            Some(_) => Curves::PROFILE | Curves::PRESSURE,
            None => Curves::empty(),
        };
        let observation = simulation.observe(self.curves | compared);
        let load = self.curves.contains(Curves::SPRINGS).then(|| {
            let poisson = simulation.setup().material.poisson();
            Arc::new(observation.spring_load(poisson))
        });
        let peaks = load
            .as_ref()
            .filter(|_| observation.moment.contact_radius > 0.0);
        let peaks = peaks.map(|load| {
            [
                load.largest(Stress::von_mises),
                load.largest(Stress::max_principal),
            ]
        });
        let material = &simulation.setup().material;
        let slip_border = (!observation.normal_load.is_empty()).then(|| {
            largest(&observation.normal_load) / (material.normal_modulus() * material.stick_ratio())
        });
        let checks = if observation.pressure.is_empty() {
            Vec::new()
        } else {
            simulation.checks()
        };
        Frame {
            slip_border,
            load,
            cycle_loads: self.cycle_loads.all(),
            peaks,
            observation,
            figures: simulation.cycle_figures(),
            wear_coefficient: simulation.setup().wear.map(|law| law.coefficient()),
            phase: self.held_phase(),
            trend: self.trend.clone(),
            activity: self.activity.clone(),
            pace: Pace::of_rung(self.rung),
            speed: self
                .meter
                .speed
                .filter(|_| self.activity == Activity::Running),
            step_cost: self.meter.step_cost,
            title: scenario.title().to_owned(),
            origin: scenario.origin().to_owned(),
            planned_cycles: self.session.loaded().run().cycles,
            expected_wear: self.expected_wear,
            steps_per_cycle: simulation.setup().steps_in_a_cycle() as u32,
            present: self.past.present(),
            changes: self
                .past
                .line(&self.session)
                .changes()
                .iter()
                .map(|change| (change.at_cycle, change.set.clone()))
                .collect(),
            snapshots: self.snapshots.clone(),
            settings: Arc::clone(&self.settings),
            indenter: simulation.setup().indenter.clone(),
            wear_share: scenario.wear_share(),
            friction: simulation.setup().material.friction(),
            // The twin has looked at the present.
            error: (self.twin.as_ref())
                .filter(|_| self.past.present().is_none())
                .and_then(Twin::error),
            checks,
            warnings: Arc::clone(&self.warnings),
            theory: Arc::clone(&self.theory),
            ghosts: self
                .ghosts
                .iter()
                .map(|ghost| ghost.seen(self.curves))
                .collect(),
            comparison: self.comparison.as_ref().map(ComparisonRun::seen),
        }
    }
}

/// About the deepest wear of a run at its planned end, m; 0 where it is not known.
fn expected_wear(theory: &Theory, session: &Session) -> f64 {
    let planned = session.loaded().run().cycles;
    let expected = theory.expected_wear(session.simulation().setup(), planned);
    expected.unwrap_or(0.0)
}

/// The value is never half written, even after a panic.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
