//! Frames: what the screen shows of the present state.

use std::sync::Arc;

use super::Worker;
use crate::math::scan::largest;
use crate::reading::Curves;
use crate::reading::subsurface::Stress;
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
        if self.facts.passed_hardness != self.run.simulation().passed_hardness() {
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
            facts: Arc::clone(&self.facts),
            slip_border,
            load,
            cycle_loads: self.cycle_loads.all(),
            peaks,
            observation,
            figures: simulation.cycle_figures(),
            phase: self.clock.held_phase(simulation),
            trend: self.run.trend.clone(),
            activity: self.activity.clone(),
            pace: self.clock.pace(),
            speed: self
                .clock
                .speed
                .filter(|_| self.activity == Activity::Running),
            step_cost: self.clock.step_cost,
            present: self.past.present(),
            changes: self
                .past
                .line(&self.run)
                .session
                .changes()
                .iter()
                .map(|change| (change.at_cycle, change.set.clone()))
                .collect(),
            snapshots: self.snapshots.clone(),
            // The twin has looked at the present.
            error: (self.companions.twin.as_ref())
                .filter(|_| self.past.present().is_none())
                .and_then(Twin::error),
            checks,
            ghosts: self
                .companions
                .ghosts
                .iter()
                .map(|ghost| ghost.seen(self.curves))
                .collect(),
            comparison: self.companions.comparison.as_ref().map(ComparisonRun::seen),
        }
    }
}
