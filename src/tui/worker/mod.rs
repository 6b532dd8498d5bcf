//! The worker: a thread that owns the simulation, takes orders between steps and publishes frames.
//!
//! It steps no further ahead than the pace allows, and it publishes a frame only after the one
//! before has been taken, so that a slow terminal costs the simulation nothing.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
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
use crate::scenario::session::Session;
use crate::simulation::Curves;

mod changes;
mod stepping;
mod travel;

use travel::ends_cycle;

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

    fn obey(&mut self, order: Order) {
        match order {
            Order::RunPause => self.run_or_pause(),
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
            Order::Method(places) => self.change_method(places),
            Order::Law(places) => self.change_law(places),
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
