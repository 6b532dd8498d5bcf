//! What the worker sends to the screen: frames of the present state, and notices.

use std::fmt::Display;
use std::path::Path;
use std::sync::mpsc::Sender;
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use super::Worker;
use crate::charts::{Live, Medium, Run};
use crate::math::geometry::Geometry;
use crate::math::scan::largest;
use crate::reading::{Curves, CycleFigures, Observation};
use crate::tui::beside::{COMPARED, ComparisonRun};
use crate::tui::event::Event;
use crate::tui::frame::{Activity, Facts, Frame, Slot};
use crate::tui::line::one_line;

/// Sends frames through a slot, at most one per interval, and everything else as events.
pub(super) struct Outlet {
    slot: Arc<Slot>,
    pub events: Sender<Event>,
    interval: Duration,
    shown: Instant,
}

impl Outlet {
    pub fn new(events: Sender<Event>, interval: Duration) -> Self {
        Self {
            slot: Arc::default(),
            events,
            interval,
            shown: Instant::now(),
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

    /// Returns the value, or shows the error as a notice.
    pub fn or_notice<T>(&self, result: Result<T, impl Display>) -> Option<T> {
        let told = |error| self.notice(&format!("{error}"));
        result.map_err(told).ok()
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
        while (self.is_awaited() || self.stop_at.is_some()) && !self.is_over() {
            match self.stop_at {
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
            self.facts = Facts::of(&self.run.session);
        }
        let simulation = self.run.simulation();
        let curves = match self.comparison {
            Some(_) => self.curves | COMPARED,
            None => self.curves,
        };
        let observation = Arc::new(simulation.observe(curves));
        let load = self.curves.contains(Curves::SPRINGS).then(|| {
            let poisson = simulation.setup().material.poisson();
            Arc::new(observation.spring_load(poisson))
        });
        let is_running = self.activity == Activity::Running;
        let figures = self.run.session.cycle_figures();
        Frame {
            run: self.charted(&observation, figures.as_ref(), curves),
            facts: Arc::clone(&self.facts),
            load,
            cycle_loads: self.cycle_loads.all(),
            found_peaks: OnceLock::new(),
            observation,
            figures,
            shows_ends: self.clock.shows_ends(simulation),
            activity: self.activity.clone(),
            pace: self.clock.pace(),
            speed: self.clock.speed.filter(|_| is_running),
            step_cost: self.clock.step_cost,
            present: self.past.present(),
            changes: self.past.line(&self.run).session.changes().to_vec(),
            snapshots: self.snapshots.clone(),
            errors: self.errors(),
            checks: self.run.session.checks(),
            comparison: self.comparison.as_ref().map(ComparisonRun::seen),
        }
    }

    /// Returns the data for charts: `seen` at the present moment, the past, and `curves` of the ghosts.
    fn charted(
        &self,
        seen: &Arc<Observation>,
        figures: Option<&CycleFigures>,
        curves: Curves,
    ) -> Run {
        let (facts, trend) = (&self.facts, &self.run.trend);
        let load = seen.normal_load();
        let setup = self.run.simulation().setup();
        let material = &setup.material;
        let ghosts = self.ghosts.iter().chain(&self.before);
        Run {
            ghosts: ghosts.map(|ghost| ghost.seen(curves)).collect(),
            theory: Some(Arc::clone(&facts.theory)),
            indenter: Some(setup.indenter.clone()),
            medium: Medium::Screen,
            live: Some(Live {
                seen: Arc::clone(seen),
                friction: material.friction(),
                planned_cycles: facts.scenario.run().cycles,
                expected_wear: facts.expected_wear,
                is_within_a_cycle: trend.is_within_a_cycle(),
                regime: figures.map(|figures| figures.regime.title()),
                slip_border: (!load.is_empty()).then(|| match setup.geometry {
                    Geometry::Round => {
                        largest(load) / (material.normal_modulus() * material.stick_ratio())
                    }
                    Geometry::Line { .. } => self.run.simulation().line_slip_border(),
                }),
                log: trend.loops.kept.clone(),
            }),
            ..self.run.charted(seen)
        }
    }
}
