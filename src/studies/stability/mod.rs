//! Where wear becomes unstable: runs a scenario with increasing wear coefficients, by every method and on every grid,
//! and compares the boundary with the [prediction](predict).
//!
//! Looks for a sawtooth at the end of every cycle: stiff wear may remove it again, so the last profile alone would not
//! show it.

use crate::math::abel::AbelMethod;
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::simulation::Stability;
use crate::studies::refinement::Level;
use predict::predict;

mod growth;
pub mod predict;
pub mod report;
mod sawtooth;

pub use sawtooth::sawtooth;

/// Numbers of cells to try.
pub const POINTS: [usize; 4] = [25, 50, 100, 200];

/// Wear numbers K to try: half decades.
pub const WEAR_NUMBERS: [f64; 9] = [0.1, 0.316, 1.0, 3.16, 10.0, 31.6, 100.0, 316.0, 1000.0];

/// Smallest height of a sawtooth that counts, relative to the largest depth. The presets reach 7e-5 at most, and runs
/// with the guard end with 3e-4 next to the stick border, at a single node.
pub const VISIBLE: f64 = 5e-4;

/// Halvings of the interval that contains the boundary, on a logarithmic scale.
const HALVINGS: u32 = 3;

/// Numerics of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variant {
    /// The transforms; they determine grid and scheme, unless the scenario gives them.
    pub method: AbelMethod,
    /// N.
    pub points: usize,
    /// Steps per cycle.
    pub steps: u32,
    /// Whether stiff steps are split into sub-steps.
    pub guard: bool,
}

/// How a run ended: stable if both are `None`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ending {
    /// Height of a sawtooth at the end of a cycle, relative to the largest depth.
    pub sawtooth: Option<f64>,
    /// Number of cycles before it broke down, and the reason in a plain word.
    pub exploded: Option<(f64, String)>,
}

impl Ending {
    /// Whether it stayed smooth to the end.
    pub fn is_stable(&self) -> bool {
        *self == Self::default()
    }
}

/// The scenario and the length of its runs.
#[derive(Debug, Clone)]
pub struct StabilityStudy {
    scenario: Scenario,
    cycles: f64,
    /// k for K = 1, 1/Pa.
    unit: f64,
}

/// The results of the runs of one setting.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// Numerics of the runs.
    pub setting: Variant,
    /// The wear numbers tried on the ladder, and their outcomes.
    pub outcomes: Vec<(f64, Ending)>,
    /// The wear number from which a sawtooth is [predicted](predict); `None` if nothing slips.
    pub predicted: Option<f64>,
    /// The smallest wear number with a sawtooth, to one part in seven; `None` if there was none.
    pub seen: Option<f64>,
}

impl StabilityStudy {
    /// Makes a study of a scenario that wears, over `cycles`. `None` if nothing wears, or if nothing touches at the
    /// beginning: K = k E* d/a, with the depth and the contact radius there.
    pub fn new(scenario: Scenario, cycles: f64) -> Result<Option<Self>, SessionError> {
        // A stability limit belongs to one number of cells and steps, not to an accuracy.
        let scenario = match scenario.accuracy() {
            Some(_) => Level::from_scenario(&scenario).of_scenario(&scenario)?,
            None => scenario,
        };
        let session = Session::start(scenario.clone())?;
        let moment = session.simulation().moment();
        let modulus = scenario.setup().material.normal_modulus();
        let unit = moment.contact_radius / (modulus * moment.depth);
        let wears = scenario.setup().wear.is_some();
        Ok((wears && unit.is_finite() && unit > 0.0).then_some(Self {
            scenario,
            cycles,
            unit,
        }))
    }

    fn start(&self, setting: Variant, wear_number: f64) -> Result<Session, SessionError> {
        let scenario = self.scenario.with_changes(Vec::new()).edited(|spec| {
            let guarded = setting.guard.then_some(Stability::SubStep);
            let numerics = &mut spec.numerics;
            (numerics.method, numerics.stability) =
                (Some(setting.method), guarded.or(Some(Stability::Off)));
            Level::new(setting.points, setting.steps, None).set(numerics);
            if let Some(wear) = &mut spec.wear {
                wear.per_work.coefficient = Some(wear_number * self.unit);
                wear.coefficient_per_load = None;
            }
        });
        Session::start(scenario?)
    }

    /// Runs one setting at one wear number; `None` if `go_on` returned false.
    fn run(
        &self,
        setting: Variant,
        wear_number: f64,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Option<Ending>, SessionError> {
        let mut session = self.start(setting, wear_number)?;
        let depth = predict::depth(session.simulation());
        let (mut outcome, mut highest) = (Ending::default(), 0.0_f64);
        while session.simulation().cycle() < self.cycles {
            let end = (session.simulation().cycle().floor() + 1.0).min(self.cycles);
            match session.advance_while(end, |_| go_on()) {
                Err(SessionError::Breakdown(breakdown)) => {
                    outcome.exploded = Some((breakdown.cycle, breakdown.cause.to_string()));
                    return Ok(Some(outcome));
                }
                Err(SessionError::Interrupted) => return Ok(None),
                other => other?,
            }
            highest = highest.max(sawtooth(session.simulation().worn_depth()) / depth);
        }
        outcome.sawtooth = Some(highest).filter(|highest| *highest > VISIBLE);
        Ok(Some(outcome))
    }

    /// Runs the ladder, and then between its last stable rung and the next to find the boundary. Calls `on_run` after
    /// every rung. If `go_on` returns false, the line stays incomplete.
    ///
    /// # Errors
    /// If a scenario cannot be made.
    pub fn line(
        &self,
        setting: Variant,
        wear_numbers: &[f64],
        go_on: &dyn Fn() -> bool,
        mut on_run: impl FnMut(),
    ) -> Result<Limit, SessionError> {
        let mut line = Limit {
            setting,
            outcomes: Vec::new(),
            predicted: predict(self, setting)?,
            seen: None,
        };
        for &wear_number in wear_numbers {
            let Some(outcome) = self.run(setting, wear_number, go_on)? else {
                return Ok(line);
            };
            line.outcomes.push((wear_number, outcome));
            on_run();
        }
        let tried = &line.outcomes;
        let Some(above) = tried.iter().position(|(_, outcome)| !outcome.is_stable()) else {
            return Ok(line);
        };
        let mut high = tried[above].0;
        // If even the lowest rung shows a sawtooth, the boundary lies below the ladder.
        if above > 0 {
            let mut low = tried[above - 1].0;
            for _ in 0..HALVINGS {
                let middle = (low * high).sqrt();
                match self.run(setting, middle, go_on)? {
                    None => return Ok(line),
                    Some(outcome) if outcome.is_stable() => low = middle,
                    Some(_) => high = middle,
                }
            }
        }
        line.seen = Some(high);
        Ok(line)
    }
}
