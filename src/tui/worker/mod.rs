//! The worker: a thread that owns the simulation, takes orders between steps and publishes frames.
//!
//! It steps no further ahead than the pace allows, and it publishes a frame only after the one
//! before has been taken, so that a slow terminal costs the simulation nothing.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

use super::Event;
use super::companion;
use super::frame::{Activity, Frame, Slot};
use super::keeping::Keeping;
use super::order::Order;
use super::pace::{Meter, Pace};
use super::past::Past;
use super::rival::RivalRun;
use super::settings::Setting;
use super::snapshot;
use super::theory::Theory;
use super::trend::Trend;
use crate::math::abel::AbelMethod;
use crate::scenario::Scenario;
use crate::scenario::accuracy;
use crate::scenario::parameters::{Kind, find};
use crate::scenario::session::Session;
use crate::simulation::Curves;

mod travel;

use travel::ends_cycle;

/// Laws that keys step through.
const LAWS: [&str; 2] = ["archard", "power"];

/// The time between two jumps over cycles, unless the pace is without limit.
const JUMP_EVERY: Duration = Duration::from_millis(100);

/// How long the worker steps before it looks for orders again.
const STINT: Duration = Duration::from_millis(4);

/// The worker's side.
pub struct Worker {
    session: Session,
    rival: Option<RivalRun>,
    theory: Arc<Theory>,
    settings: Arc<Vec<Setting>>,
    trend: Trend,
    /// The trend up to the present, while the screen is in the past.
    whole_trend: Option<Trend>,
    past: Past,
    kept_at: Instant,
    curves: Curves,
    activity: Activity,
    rung: i32,
    meter: Meter,
    slot: Arc<Slot>,
    events: Sender<Event>,
    interval: Duration,
    published: Instant,
    stepped: Instant,
    keeping: Option<Keeping>,
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
        trend.record(&session.simulation().moment());
        let activity = if running {
            Activity::Running
        } else {
            Activity::Paused
        };
        Self {
            theory: Arc::new(Theory::of(session.simulation().setup())),
            settings: Arc::new(Setting::all(session.scenario())),
            session,
            rival: None,
            trend,
            whole_trend: None,
            past: Past::default(),
            kept_at: Instant::now(),
            curves: Curves::all(),
            activity,
            rung: 3,
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

    /// What to set for the worker to cut short what it does, before it is told to quit.
    pub fn halt(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.halt)
    }

    /// Carries out orders and steps in between, until told to quit.
    pub fn serve(mut self, orders: &Receiver<Order>) {
        self.attend(orders);
    }

    /// [`serve`](Self::serve), and keeps the session on the way and at the end, a panic included;
    /// returns what there is to say of that.
    pub fn serve_and_keep(
        mut self,
        orders: &Receiver<Order>,
        keeping: Option<Keeping>,
    ) -> Option<String> {
        self.keeping = keeping;
        let served = catch_unwind(AssertUnwindSafe(|| self.attend(orders)));
        // A step that was cut short has left half a state.
        let session = served.is_ok().then(|| self.past.line(&self.session));
        self.keeping.take()?.finish(session)
    }

    fn attend(&mut self, orders: &Receiver<Order>) {
        self.publish();
        loop {
            #[cfg(debug_assertions)]
            super::fault::strike("worker");
            self.look_after();
            let wait = self.until_next_step();
            match wait.map_or_else(
                || orders.recv().map_err(RecvTimeoutError::from),
                |wait| orders.recv_timeout(wait),
            ) {
                Ok(Order::Quit) | Err(RecvTimeoutError::Disconnected) => return,
                Ok(order) => {
                    self.obey(order);
                    self.meter.restart(self.session.simulation().cycle());
                    self.publish();
                }
                Err(RecvTimeoutError::Timeout) if self.activity != Activity::Running => {}
                Err(RecvTimeoutError::Timeout) => self.step_for_a_stint(),
            }
        }
    }

    /// Keeps the session when that is due.
    fn look_after(&mut self) {
        let keeping = self.keeping.as_mut();
        if let Some(word) =
            keeping.and_then(|keeping| keeping.look_after(self.past.line(&self.session)))
        {
            self.notice(&word);
        }
    }

    /// How long to wait for orders before the next step or checkpoint is due; forever when there is
    /// none.
    fn until_next_step(&self) -> Option<Duration> {
        if self.activity != Activity::Running {
            return self.keeping.as_ref()?.wait(self.past.line(&self.session));
        }
        Some(Duration::from_secs_f64(self.ahead().clamp(0.0, 0.1)))
    }

    /// Seconds until the next step is due. A jump over many cycles is due a moment after the one before:
    /// how far it goes is not for the pace to say, or no run could be repeated.
    fn ahead(&self) -> f64 {
        let simulation = self.session.simulation();
        match Pace::of_rung(self.rung) {
            Pace::Unlimited => 0.0,
            Pace::Cycles(_) if simulation.may_jump() => {
                JUMP_EVERY.as_secs_f64() - self.stepped.elapsed().as_secs_f64()
            }
            Pace::Cycles(pace) => self.meter.ahead(simulation.next_moment(), pace),
        }
    }

    fn step_for_a_stint(&mut self) {
        let start = Instant::now();
        while self.activity == Activity::Running && start.elapsed() < STINT {
            if self.ahead() > 0.0 {
                break;
            }
            let before = self.session.simulation().cycle();
            #[cfg(debug_assertions)]
            if before > 5.0 {
                super::fault::strike("sixth cycle");
            }
            self.step();
            self.keep_cycle(before);
            self.end_where_planned(before);
        }
        self.meter.measure(
            self.session.simulation().cycle(),
            self.session.simulation().state().steps,
            start.elapsed(),
        );
        self.trend.note_cost(self.meter.step_cost);
        if self.published.elapsed() >= self.interval || self.activity != Activity::Running {
            self.publish();
        }
    }

    fn step(&mut self) {
        self.branch();
        if self.session.simulation().state().steps == 0 {
            self.keep();
        }
        self.stepped = Instant::now();
        let now = self.session.simulation().cycle();
        let end = self.session.loaded().run().cycles;
        let end = end.filter(|&end| now < end).unwrap_or(f64::INFINITY);
        match self.session.step_until(end) {
            Ok(()) => {
                self.trend.record(&self.session.simulation().moment());
                if let Some(rival) = &mut self.rival {
                    rival.follow(self.session.simulation().cycle());
                }
            }
            Err(error) => self.activity = Activity::Stopped(error.to_string()),
        }
    }

    /// Sets a rival beside this run, so many places after the one before.
    fn rival(&mut self, places: isize) {
        match RivalRun::beside(&self.session, self.rival.as_ref(), places) {
            Ok(rival) => self.rival = Some(rival),
            Err(error) => self.notice(&error.to_string()),
        }
    }

    /// Runs the companion beside the worker; its answer comes as an event.
    fn companion(&self) {
        let (session, events) = (self.session.clone(), self.events.clone());
        thread::spawn(move || {
            // Whatever happens, somebody waits for the answer.
            let answer = std::panic::catch_unwind(|| companion::run(&session))
                .map_err(|_| "the companion failed".to_owned())
                .and_then(|answer| answer.map_err(|error| error.to_string()));
            let _ = events.send(Event::Companion(answer));
        });
    }

    /// Pauses when a running simulation passes the end of the scenario's plan.
    fn end_where_planned(&mut self, before: f64) {
        let Some(end) = self.session.loaded().run().cycles else {
            return;
        };
        let simulation = self.session.simulation();
        let end = end - simulation.rounding();
        if self.activity == Activity::Running && before < end && simulation.cycle() >= end {
            self.activity = Activity::Done;
        }
    }

    fn obey(&mut self, order: Order) {
        match order {
            Order::RunPause => match self.activity {
                Activity::Running => self.activity = Activity::Paused,
                Activity::Paused | Activity::Done => self.activity = Activity::Running,
                Activity::Stopped(_) => {
                    self.notice("the run has broken down; r starts again, m changes the method")
                }
            },
            Order::Step => self.by_hand(|_, _| true),
            Order::Cycle => self.by_hand(ends_cycle),
            Order::Back => self.travel(Past::back, "the run begins here"),
            Order::Forth => self.travel(Past::forth, "this is the present"),
            Order::Mark => self.mark(),
            Order::Visit => self.visit(),
            Order::Compare => match self.rival.take() {
                Some(_) => {}
                None => self.rival(0),
            },
            Order::Companion => self.companion(),
            Order::Method(places) if self.rival.is_some() => self.rival(places),
            Order::Method(places) => {
                let now = self.session.simulation().setup().method;
                let method = shifted(&AbelMethod::ALL, |method| *method == now, places);
                self.change("numerics.method", method.name());
            }
            Order::Law(places) => match self.session.simulation().setup().wear {
                None => self.notice("this scenario has no wear: there is no law to change"),
                Some(now) => {
                    let law = shifted(&LAWS, |law| *law == now.name(), places);
                    self.change("wear.law", law);
                }
            },
            Order::Change { key, value } => self.change(&key, &value),
            Order::Accuracy(places) => self.refine(places),
            Order::Pace(rungs) => {
                self.rung = (self.rung + rungs).clamp(Pace::SLOWEST, Pace::UNLIMITED)
            }
            Order::Restart => self.load(self.session.loaded().clone()),
            Order::Load(scenario) => self.load(*scenario),
            Order::Snapshot(note) => self.snapshot(note.as_deref()),
            Order::Show(curves) => self.curves = curves,
            Order::Sync(reply) => {
                let _ = reply.send(Arc::new(self.frame()));
            }
            Order::Quit => {}
        }
    }

    /// Pauses and steps until `done`, which is given the cycles before and now, is true.
    fn by_hand(&mut self, done: impl Fn(f64, f64) -> bool) {
        if matches!(self.activity, Activity::Stopped(_)) {
            return self.notice("the run has broken down; r starts again, m changes the method");
        }
        self.activity = Activity::Paused;
        let before = self.session.simulation().cycle();
        loop {
            self.step();
            if ends_cycle(before, self.session.simulation().cycle()) {
                self.keep();
            }
            if self.activity != Activity::Paused
                || done(before, self.session.simulation().cycle())
                || self.halt.load(Ordering::Relaxed)
            {
                break;
            }
        }
        self.keep();
    }

    /// Goes along the front of speed and accuracy, from where the present numerics stand on it.
    fn refine(&mut self, places: isize) {
        let scenario = self.session.scenario();
        let cells = scenario.setup().grid.cells();
        let now = scenario.expected_error();
        let now = now.unwrap_or_else(|| accuracy::expected(cells));
        let next = accuracy::rung(now, places);
        if scenario.value("numerics.accuracy").is_some() && next == now {
            let end = if places > 0 { "finest" } else { "coarsest" };
            return self.notice(&format!("{next:e} is the {end} accuracy there is"));
        }
        self.change("numerics.accuracy", &format!("{next:e}"));
        let setup = self.session.scenario().setup();
        if self.session.scenario().expected_error() == Some(next) {
            self.notice(&format!(
                "expected error {next:e} of the depth: N = {}, {} steps a cycle",
                setup.grid.cells(),
                setup.steps_per_cycle
            ));
        }
    }

    fn change(&mut self, key: &str, value: &str) {
        self.keep();
        let quoted = format!("\"{value}\"");
        let is_word = find(key).is_some_and(|known| matches!(known.kind, Kind::Choice(_)));
        match self
            .session
            .change(key, if is_word { &quoted } else { value })
        {
            Ok(()) => {
                self.branch();
                self.learn();
                if matches!(self.activity, Activity::Stopped(_)) {
                    self.activity = Activity::Paused;
                }
                let cycle = self.session.simulation().cycle();
                self.notice(&format!("{key} = {value} from cycle {cycle:.2} on"));
            }
            Err(error) => self.notice(&error.to_string()),
        }
    }

    /// What follows from the scenario as it is now.
    fn learn(&mut self) {
        self.theory = Arc::new(Theory::of(self.session.simulation().setup()));
        self.settings = Arc::new(Setting::all(self.session.scenario()));
    }

    fn load(&mut self, scenario: Scenario) {
        match Session::start(scenario) {
            Ok(session) => {
                if let Some(keeping) = &mut self.keeping {
                    keeping.turn_over(self.past.line(&self.session), &session);
                }
                self.session = session;
                self.rival = None;
                self.past = Past::default();
                self.whole_trend = None;
                self.learn();
                self.trend = Trend::default();
                self.trend.record(&self.session.simulation().moment());
                if self.activity != Activity::Running {
                    self.activity = Activity::Paused;
                }
            }
            Err(error) => self.notice(&error.to_string()),
        }
    }

    fn snapshot(&self, note: Option<&str>) {
        match snapshot::write(&self.session, note) {
            Ok(path) => self.notice(&format!("snapshot in {}", path.display())),
            Err(error) => self.notice(&error.to_string()),
        }
    }

    fn notice(&self, text: &str) {
        let _ = self.events.send(Event::Notice(text.to_owned()));
    }

    fn publish(&mut self) {
        self.published = Instant::now();
        if self.slot.put(Arc::new(self.frame())) {
            let _ = self.events.send(Event::Frame);
        }
    }

    fn frame(&self) -> Frame {
        let simulation = self.session.simulation();
        let scenario = self.session.scenario();
        let observation = simulation.observe(self.curves);
        let shown = !observation.pressure.is_empty();
        let force_residual = shown
            .then(|| simulation.force_residual(&observation.pressure))
            .flatten();
        Frame {
            observation,
            trend: self.trend.clone(),
            activity: self.activity.clone(),
            pace: Pace::of_rung(self.rung),
            speed: self
                .meter
                .speed
                .filter(|_| self.activity == Activity::Running),
            step_cost: self.meter.step_cost,
            expected_error: scenario.expected_error(),
            title: scenario.title().to_owned(),
            origin: scenario.origin().to_owned(),
            planned_cycles: self.session.loaded().run().cycles,
            steps_per_cycle: simulation.setup().steps_per_cycle,
            present: self.past.present(),
            settings: Arc::clone(&self.settings),
            indenter: simulation.setup().indenter,
            friction: simulation.setup().material.friction(),
            force_residual,
            theory: Arc::clone(&self.theory),
            rival: self.rival.as_ref().map(RivalRun::seen),
        }
    }
}

/// The element so many places after the one that is `now`, around the ends.
fn shifted<T: Copy>(all: &[T], now: impl Fn(&T) -> bool, places: isize) -> T {
    let at = all.iter().position(now).unwrap_or(0) as isize;
    all[(at + places).rem_euclid(all.len() as isize) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn methods_go_around() {
        assert_eq!(shifted(&[1, 2, 3], |n| *n == 3, 1), 1);
        assert_eq!(shifted(&[1, 2, 3], |n| *n == 1, -1), 3);
    }
}
