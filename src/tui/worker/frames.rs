//! Frames: what the screen shows of the present state.

use std::sync::Arc;

use super::Worker;
use crate::charts::{Live, Run};
use crate::export::state;
use crate::math::scan::largest;
use crate::reading::subsurface::Stress;
use crate::reading::{Curves, CycleFigures, Observation};
use crate::traces::Table;
use crate::tui::comparison::ComparisonRun;
use crate::tui::facts::Facts;
use crate::tui::frame::{Activity, Frame};
use crate::tui::twin::Twin;

impl Worker {
    /// Shows the present state.
    pub(super) fn publish(&mut self) {
        let frame = self.frame();
        self.screen.show(frame);
    }

    /// The present frame, when all that runs beside has come to it.
    pub(super) fn settled_frame(&mut self) -> Arc<Frame> {
        while self.is_awaited() && !self.is_over() {
            self.catch_up();
        }
        Arc::new(self.frame())
    }

    fn frame(&mut self) -> Frame {
        // The pressure may pass the hardness in any step, and has not yet in an earlier state.
        if self.facts.passed_hardness != self.run.session.log().passed_hardness() {
            self.facts = Facts::of(&self.run.session);
        }
        let simulation = self.run.simulation();
        // A comparison subtracts profiles; the screen that asked for it may not have shown one.
        let compared = match self.companions.comparison {
            Some(_) => Curves::PROFILE | Curves::PRESSURE,
            None => Curves::empty(),
        };
        let observation = simulation.observe(self.curves | compared);
        let load = self.curves.contains(Curves::SPRINGS).then(|| {
            let poisson = simulation.setup().material.poisson();
            Arc::new(observation.spring_load(poisson))
        });
        let touches = observation.moment.contact_radius > 0.0;
        let shown: [fn(&Stress) -> f64; 2] = [Stress::von_mises, Stress::max_principal];
        let peaks = load.as_ref().filter(|_| touches);
        let peaks = peaks.map(|load| shown.map(|of| load.largest(of)));
        let checks = match observation.pressure.is_empty() {
            true => Vec::new(),
            false => self.run.session.checks(),
        };
        let is_running = self.activity == Activity::Running;
        let changes = self.past.line(&self.run).session.changes().iter();
        // The twin has looked at the present.
        let twin = self.companions.twin.as_ref();
        let twin = twin.filter(|_| self.past.present().is_none());
        let figures = self.run.session.cycle_figures();
        Frame {
            run: self.charted(&observation, figures.as_ref()),
            facts: Arc::clone(&self.facts),
            load,
            cycle_loads: self.cycle_loads.all(),
            peaks,
            observation,
            figures,
            phase: self.clock.held_phase(simulation),
            activity: self.activity.clone(),
            pace: self.clock.pace(),
            speed: self.clock.speed.filter(|_| is_running),
            step_cost: self.clock.step_cost,
            present: self.past.present(),
            changes: (changes.map(|change| (change.at_cycle, change.set.clone()))).collect(),
            snapshots: self.snapshots.clone(),
            error: twin.and_then(Twin::error),
            checks,
            comparison: self.companions.comparison.as_ref().map(ComparisonRun::seen),
        }
    }

    /// What charts are made of: what is `seen` of the present moment, the past, and other sources.
    fn charted(&self, seen: &Observation, figures: Option<&CycleFigures>) -> Run {
        let (facts, trend) = (&self.facts, &self.run.trend);
        let (moment, load) = (seen.moment, &seen.normal_load);
        let setup = self.run.simulation().setup();
        let material = &setup.material;
        let ghosts = self.companions.ghosts.iter();
        Run {
            states: vec![Table::of_columns(
                vec![("cycle".to_owned(), moment.cycle.to_string())],
                state::columns(seen),
            )],
            history: Some(trend.history()),
            loops: vec![trend.loops.last(moment.cycle)],
            ghosts: ghosts.map(|ghost| ghost.seen(self.curves)).collect(),
            field: None,
            theory: Some(Arc::clone(&facts.theory)),
            indenter: Some(setup.indenter.clone()),
            live: Some(Live {
                moment,
                wears: seen.law.is_some(),
                friction: material.friction(),
                planned_cycles: facts.planned_cycles,
                expected_wear: facts.expected_wear,
                is_within_a_cycle: trend.is_within_a_cycle(),
                regime: figures.map(|figures| figures.regime.title()),
                slip_border: (!load.is_empty())
                    .then(|| largest(load) / (material.normal_modulus() * material.stick_ratio())),
                log: trend.loops.kept().to_vec(),
            }),
        }
    }
}
