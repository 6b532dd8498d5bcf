//! Notes on a run that no step needs: a [`Log`] follows a simulation while someone drives it.

use serde::{Deserialize, Serialize};

use super::cycle_figures::{CycleFigures, LoopTally};
use crate::simulation::{Breakdown, Simulation};

/// The notes of a run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Log {
    /// The current period of the motion so far.
    tally: LoopTally,
    /// Figures of the last complete period; `None` before the first, or if it was jumped over.
    figures: Option<CycleFigures>,
    balance: PeriodBalance,
    passed_hardness: Option<Passed>,
}

/// Compares V with k E_d over one period of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
struct PeriodBalance {
    /// Worn volume and ∫k dE_d at the start of the period, m³.
    start: [f64; 2],
    /// 1 − ΔV/∫k dE_d of the last complete period; `None` before the first, or if nothing wore.
    residual: Option<f64>,
}

/// Where and when the pressure first passed the hardness.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Passed {
    /// Cycles since the start.
    pub cycle: f64,
    /// r, m.
    pub radius: f64,
    /// The largest p at that moment, Pa.
    pub pressure: f64,
}

impl Log {
    /// Begins a log of a simulation that has not stepped yet.
    pub fn new(simulation: &Simulation) -> Self {
        let mut log = Self::default();
        log.restart(simulation);
        log
    }

    /// Forgets the figures and begins a new period, after a change of the parts or a jump over cycles.
    pub fn restart(&mut self, simulation: &Simulation) {
        self.figures = None;
        self.tally = LoopTally::begin(simulation);
        self.watch_hardness(simulation);
    }

    /// Notes the last step or jump of the simulation, if there was one.
    pub fn follow(&mut self, simulation: &Simulation) {
        let (before, cycle) = (self.tally.cycle(), simulation.cycle());
        if cycle == before {
            return;
        }
        if simulation.has_jumped() {
            self.balance.close(simulation);
            return self.restart(simulation);
        }
        self.tally.add(simulation);
        let period = period(simulation);
        // Periods are whole numbers of cycles.
        if cycle.floor() > before.floor() && (cycle / period).floor() > (before / period).floor() {
            self.figures = self.tally.close(simulation, period);
            self.tally = LoopTally::begin(simulation);
            self.balance.close(simulation);
        }
        self.watch_hardness(simulation);
    }

    /// Steps a simulation to `cycle` exactly, and follows it.
    ///
    /// # Errors
    ///
    /// If the simulation stops.
    pub fn advance(&mut self, simulation: &mut Simulation, cycle: f64) -> Result<(), Breakdown> {
        while simulation.cycle() < cycle {
            simulation.step_until(cycle)?;
            self.follow(simulation);
        }
        Ok(())
    }

    /// Returns the figures of the last complete period of the motion; after a jump over cycles, of a period finely
    /// stepped on the present profile. `None` before the end of the first period, within the period of a change, and
    /// without tangential motion.
    pub fn cycle_figures(&self, simulation: &Simulation) -> Option<CycleFigures> {
        if self.figures.is_some() || !simulation.has_jumped() {
            return self.figures;
        }
        let period = simulation.fine_period()?;
        Some(CycleFigures::from_period(&period, simulation.setup()))
    }

    /// Returns the figures of the last complete period if it was stepped.
    pub(super) fn stepped_figures(&self) -> Option<&CycleFigures> {
        self.figures.as_ref()
    }

    /// Returns 1 − ΔV/∫k dE_d over the last complete period of the motion.
    pub fn period_residual(&self) -> Option<f64> {
        self.balance.residual
    }

    /// Returns where and when the pressure first passed the
    /// hardness; `None` if it never did, or if no hardness is given.
    pub fn passed_hardness(&self) -> Option<Passed> {
        self.passed_hardness
    }

    /// Notes the first moment at which p exceeds the hardness: an elastic calculation continues where a metal would
    /// yield. Computes nothing without a hardness.
    fn watch_hardness(&mut self, simulation: &Simulation) {
        if let Some(hardness) = simulation.setup().hardness
            && self.passed_hardness.is_none()
        {
            let (radius, pressure) = simulation.highest_pressure();
            self.passed_hardness = (pressure > hardness).then_some(Passed {
                cycle: simulation.cycle(),
                radius,
                pressure,
            });
        }
    }
}

impl PeriodBalance {
    /// Ends a period at the present moment of a simulation.
    fn close(&mut self, simulation: &Simulation) {
        let state = simulation.state();
        let volume = simulation.wear_volume() - state.ledger.unexplained_volume;
        let expected = state.ledger.expected_volume;
        let (worn, due) = (volume - self.start[0], expected - self.start[1]);
        self.residual = (due > 0.0).then(|| 1.0 - worn / due);
        self.start = [volume, expected];
    }
}

impl Simulation {
    /// Returns the radius of the largest pressure, m, and its value, Pa.
    pub(super) fn highest_pressure(&self) -> (f64, f64) {
        let pressure = self.pressure();
        let points = self.setup().grid.nodes().iter().copied().zip(pressure);
        points.fold(
            (0.0, 0.0),
            |most, point| {
                if point.1 > most.1 { point } else { most }
            },
        )
    }
}

/// Returns the period of the motion, in cycles.
fn period(simulation: &Simulation) -> f64 {
    f64::from(simulation.setup().drive.cycles_to_settle())
}
