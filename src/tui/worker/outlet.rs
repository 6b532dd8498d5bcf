//! What the worker sends to the screen: frames of the present state, and notices.

use std::fmt::Display;
use std::path::Path;
use std::sync::mpsc::Sender;
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use super::Worker;
use crate::charts::{Live, Run};
use crate::math::geometry::Geometry;
use crate::math::scan::largest;
use crate::reading::{Curves, Observation, Passed};
use crate::scenario::Scenario;
use crate::scenario::session::Session;
use crate::studies::theory::Theory;
use crate::tui::event::Event;
use crate::tui::frame::{Frame, Slot};
use crate::tui::line::one_line;

/// Sends frames through a slot, at most one per interval, and everything else as events.
pub struct Outlet {
    slot: Arc<Slot>,
    pub events: Sender<Event>,
    interval: Duration,
    shown: Instant,
    /// The cycles of this run's snapshots, for the timeline.
    pub snapshots: Vec<f64>,
}

impl Outlet {
    pub fn new(events: Sender<Event>, interval: Duration) -> Self {
        Self {
            slot: Arc::default(),
            events,
            interval,
            shown: Instant::now(),
            snapshots: Vec::new(),
        }
    }

    /// Whether the next frame is due.
    pub fn is_due(&self) -> bool {
        self.is_due_after(self.interval)
    }

    /// Whether the next frame is due if each lasts for `interval`.
    pub fn is_due_after(&self, interval: Duration) -> bool {
        self.shown.elapsed() >= interval
    }

    pub fn show(&mut self, frame: Frame) {
        self.shown = Instant::now();
        if self.slot.put(Arc::new(frame)) {
            self.send(Event::Frame(Arc::clone(&self.slot)));
        }
    }

    /// Shows the user a notice.
    pub fn notice(&self, text: &str) {
        self.send(Event::Notice(one_line(text)));
    }

    /// Shows the user a notice, if there is one.
    pub fn tell(&self, notice: Option<impl AsRef<str>>) {
        if let Some(notice) = notice {
            self.notice(notice.as_ref());
        }
    }

    /// Returns the value, or shows the error as a notice.
    pub fn or_notice<T>(&self, result: Result<T, impl Display>) -> Option<T> {
        let report = |error| self.notice(&format!("{error}"));
        result.map_err(report).ok()
    }

    /// Tells the user where `what` was written, or why it was not.
    pub fn written(&self, what: &str, path: Result<impl AsRef<Path>, impl Display>) {
        match path {
            Ok(path) => self.notice(&format!("{what} in {}", path.as_ref().display())),
            Err(error) => self.send(Event::Unwritten(one_line(&error.to_string()))),
        }
    }

    /// Sends an event; if the screen is gone, it is dropped.
    pub fn send(&self, event: Event) {
        let _ = self.events.send(event);
    }
}

impl Worker {
    /// Publishes the present state.
    pub(super) fn publish(&mut self) {
        let frame = self.frame();
        self.screen.show(frame);
    }

    /// Returns the present frame after all companions have caught up.
    pub(super) fn settled_frame(&mut self) -> Arc<Frame> {
        while (self.is_awaited() || self.pace.stop_at.is_some()) && !self.is_over() {
            match self.pace.stop_at {
                Some(_) => self.step(),
                None => self.catch_up(),
            }
        }
        Arc::new(self.frame())
    }

    /// Returns the present frame.
    pub fn frame(&mut self) -> Frame {
        // The pressure may exceed the hardness in any step, and may not have done so yet in an earlier state.
        if self.facts.passed_hardness != self.run.session.log().passed_hardness() {
            self.facts = ScenarioFacts::new(&self.run.session);
        }
        let simulation = self.run.simulation();
        let curves = self.curves;
        let observation = simulation.observe(curves);
        let load = curves.contains(Curves::SPRINGS).then(|| {
            let poisson = simulation.setup().material.poisson();
            Arc::new(observation.spring_load(poisson))
        });
        let ghosts = self.ghosts.all();
        let present = self.past.present();
        Frame {
            run: Run {
                ghosts: ghosts.map(|ghost| ghost.curves(curves)).collect(),
                theory: Some(Arc::clone(&self.facts.theory)),
                indenter: Some(simulation.setup().indenter.clone()),
                ..self.run.charted(&observation)
            },
            warnings: Arc::clone(&self.facts.warnings),
            load,
            cycle_loads: self.cycle_loads.all(),
            found_peaks: OnceLock::new(),
            live: self.live(observation),
            shows_ends: self.pace.shows_ends(simulation),
            activity: self.pace.activity.clone(),
            pace: self.pace.requested(),
            speed: self.pace.speed.filter(|_| self.pace.is_running()),
            step_cost: self.pace.step_cost,
            present,
            changes: self.past.line(&self.run).session.changes().to_vec(),
            snapshots: self.screen.snapshots.clone(),
            errors: match &self.twin {
                // The twin has compared with the present, not with the past.
                _ if present.is_some() => Err("of the present: ] leads there".into()),
                Some(twin) => twin.errors(self.run.cycle()),
                None => Err("this run is too coarse to be halved".into()),
            },
            checks: self.run.session.checks(),
            compares: self.ghosts.rival.is_some(),
        }
    }

    /// Returns the present moment with its `observation`.
    fn live(&self, observation: Observation) -> Live {
        let simulation = self.run.simulation();
        let material = &simulation.setup().material;
        let load = observation.normal_load();
        let slip_border = (!load.is_empty()).then(|| match observation.geometry {
            Geometry::Round => largest(load) / (material.normal_modulus() * material.stick_ratio()),
            Geometry::Line { .. } => simulation.line_slip_border(),
        });
        Live {
            observation,
            figures: self.run.session.cycle_figures(),
            scenario: Arc::clone(&self.facts.scenario),
            expected_wear: self.facts.expected_wear,
            is_within_a_cycle: self.run.past.is_open(),
            slip_border,
            log: self.run.loops.kept.clone(),
        }
    }
}

/// What frames have of the scenario; made when it changes.
pub(super) struct ScenarioFacts {
    scenario: Arc<Scenario>,
    theory: Arc<Theory>,
    expected_wear: f64,
    warnings: Arc<[String]>,
    /// Where the pressure first exceeded the hardness, as the warnings say.
    passed_hardness: Option<Passed>,
}

impl ScenarioFacts {
    /// Collects the facts of the scenario that `session` runs now.
    pub fn new(session: &Session) -> Self {
        let scenario = session.scenario();
        let loaded = session.loaded().setup();
        let expected_wear = Theory::new(loaded).expected_wear(loaded, scenario.run().cycles);
        Self {
            scenario: Arc::new(scenario.clone()),
            theory: Arc::new(Theory::new(session.simulation().setup())),
            expected_wear: expected_wear.unwrap_or(0.0),
            warnings: session.warnings().into(),
            passed_hardness: session.log().passed_hardness(),
        }
    }
}
