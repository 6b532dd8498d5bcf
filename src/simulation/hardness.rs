//! The hardness limit: an elastic calculation continues where a metal would yield, so a warning says when the
//! pressure exceeds the hardness of the softer body. Without a hardness in the scenario nothing is computed.

use serde::{Deserialize, Serialize};

use super::drive::{Control, Drive, Oscillation};
use super::{Setup, Simulation};
use crate::math::invalid::Invalid;

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
    fn highest_pressure(&self) -> (f64, f64) {
        let pressure = self.pressure();
        let points = self.setup().grid.nodes().iter().copied().zip(pressure);
        points.fold(
            (0.0, 0.0),
            |most, point| {
                if point.1 > most.1 { point } else { most }
            },
        )
    }

    /// What there is to say of the hardness: that the pressure has passed it, or, before the first step, that it
    /// will when the contact is deepest.
    pub(super) fn hardness_warning(&self) -> Option<String> {
        let hardness = self.setup().hardness?;
        let (pressure, radius, when) = match self.state.passed_hardness {
            Some(passed) => (
                passed.pressure,
                passed.radius,
                format!("at cycle {:.4}", passed.cycle),
            ),
            None if self.state.steps > 0 => return None,
            None => {
                let deepest = Self::begin(at_deepest(self.setup()).ok()?).ok()?;
                let (radius, pressure) = deepest.highest_pressure();
                (pressure, radius, "where the contact is deepest".to_owned())
            }
        };
        (pressure > hardness).then(|| {
            format!(
                "outside the theory: the pressure exceeds the hardness, {hardness:.3e} Pa: it is \
                 {pressure:.3e} Pa at r = {radius:.2e} m {when}, and the material yields there"
            )
        })
    }
}

/// The same contact, held at the deepest point of its motion, on the same nodes.
fn at_deepest(setup: &Setup) -> Result<Setup, Invalid> {
    let normal = setup.drive.normal();
    let held = Oscillation::new(normal.oscillation().highest(), 0.0, 1.0, 0.0)?;
    Ok(Setup {
        drive: Drive::new(
            match normal {
                Control::Displacement(_) => Control::Displacement(held),
                Control::Force(_) => Control::Force(held),
            },
            None,
        ),
        wear: None,
        running_in: None,
        hardness: None,
        ..setup.clone()
    })
}
