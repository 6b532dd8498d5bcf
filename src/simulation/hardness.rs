//! The hardness limit: an elastic calculation continues where a metal would yield, so a warning says when the
//! pressure exceeds the hardness of the softer body. Without a hardness in the scenario nothing is computed.

use serde::{Deserialize, Serialize};

use super::Simulation;

/// Where and when the pressure first passed the hardness.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Passed {
    /// Cycles since the start.
    pub cycle: f64,
    /// r, m.
    pub radius: f64,
    /// The largest p there and then, Pa.
    pub pressure: f64,
}

impl Simulation {
    /// Where and when the pressure first passed the hardness; none if it never has, or none is given.
    pub fn passed_hardness(&self) -> Option<Passed> {
        self.state.passed_hardness
    }

    /// Notes the first moment at which p lies above the hardness.
    pub(super) fn watch_hardness(&mut self) {
        if let Some(hardness) = self.setup().hardness
            && self.state.passed_hardness.is_none()
        {
            let (radius, pressure) = self.highest_pressure();
            self.state.passed_hardness = (pressure > hardness).then_some(Passed {
                cycle: self.state.cycle,
                radius,
                pressure,
            });
        }
    }

    /// Where the largest pressure acts, m, and how large it is, Pa.
    pub(crate) fn highest_pressure(&self) -> (f64, f64) {
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
