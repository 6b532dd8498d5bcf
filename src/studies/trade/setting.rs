//! A setting of everything that trades speed for accuracy, and the ladders of settings to try.

use std::fmt::{self, Display, Formatter};

use crate::math::abel::AbelMethod;
use crate::scenario::{Change, Scenario, ScenarioError};
use crate::simulation::{Integrator, Scheme};

/// Numbers of cells that are tried.
pub const POINTS: [usize; 3] = [25, 50, 100];

/// Steps per cycle that are tried.
pub const STEPS: [u32; 3] = [12, 25, 50];

/// Tolerances of jumps that are tried.
const TOLERANCES: [f64; 5] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5];

/// Steps per cycle under jumps by any but the best method.
const STEPS_UNDER_JUMPS: u32 = 50;

/// A method, its scheme, and how fine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// The transforms; the grid is the one that goes with them.
    pub method: AbelMethod,
    /// How a step is taken.
    pub scheme: Scheme,
    /// N.
    pub points: usize,
    /// Steps per cycle.
    pub steps: u32,
    /// The tolerance of jumps over cycles; none: every cycle is stepped.
    pub tolerance: Option<f64>,
}

impl Display for Setting {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        write!(
            f,
            "{}, N = {}, {} steps",
            self.method, self.points, self.steps
        )
    }
}

impl Setting {
    /// The keys of a scenario and their values.
    pub fn keys(&self) -> Vec<(&'static str, String)> {
        let mut keys = vec![
            ("numerics.method", self.method.name().to_owned()),
            ("numerics.scheme", self.scheme.name().to_owned()),
            ("numerics.points", self.points.to_string()),
            ("numerics.steps_per_cycle", self.steps.to_string()),
            ("numerics.integrator", self.integrator().to_owned()),
        ];
        let tolerance = self.tolerance.iter();
        keys.extend(tolerance.map(|tolerance| ("numerics.tolerance", format!("{tolerance:e}"))));
        keys
    }

    /// How cycles are gone through, by its name.
    pub fn integrator(&self) -> &'static str {
        Integrator::NAMES[usize::from(self.tolerance.is_some())]
    }

    /// The scenario computed so.
    ///
    /// # Errors
    /// If it cannot be.
    pub fn of(&self, scenario: &Scenario) -> Result<Scenario, ScenarioError> {
        let changes = self
            .keys()
            .into_iter()
            .map(|(key, value)| Change::new(0.0, key, &value));
        changes
            .into_iter()
            .try_fold(scenario.clone(), |scenario, change| scenario.after(&change))
    }

    /// The same half as fine.
    pub fn halved(self) -> Self {
        Self {
            points: self.points / 2,
            steps: self.steps / 2,
            tolerance: self.tolerance.map(|tolerance| 4.0 * tolerance),
            ..self
        }
    }

    /// An estimate of the work of a run of `cycles`, in kernel values.
    pub fn effort(&self, cycles: f64) -> f64 {
        let cycles = match self.tolerance {
            // What a jump looks at hardly depends on how far it goes.
            Some(tolerance) => cycles.min(60.0 * tolerance.powf(-0.25)),
            None => cycles,
        };
        let nodes = self.points as f64;
        cycles * f64::from(self.steps) * (nodes * nodes + 60.0 * nodes + 1500.0)
    }
}

/// Every setting of these methods, cells and steps, the cheapest first. Where cycles are alike they are tried with
/// jumps as well, by the best method; a scenario that asks for jumps is not tried without.
pub fn settings(
    scenario: &Scenario,
    methods: &[AbelMethod],
    points: &[usize],
    steps: &[u32],
) -> Vec<Setting> {
    let setup = scenario.setup();
    let wants_jumps = wants_jumps(scenario);
    let repeats = setup.drive.repeats_after().is_some() && setup.wear.is_some();
    let mut settings = Vec::new();
    for &method in methods {
        for scheme in Scheme::ALL {
            let is_best = method == AbelMethod::Product && scheme == Scheme::Trapezoid;
            let mut ways: Vec<(u32, Option<f64>)> = Vec::new();
            if !wants_jumps {
                ways.extend(steps.iter().map(|&steps| (steps, None)));
            }
            if repeats && (is_best || wants_jumps) {
                let steps = if is_best { steps } else { &[STEPS_UNDER_JUMPS] };
                let jumps = |&steps| TOLERANCES.map(|tolerance| (steps, Some(tolerance)));
                ways.extend(steps.iter().flat_map(jumps));
            }
            for (steps, tolerance) in ways {
                settings.extend(points.iter().map(|&points| Setting {
                    method,
                    scheme,
                    points,
                    steps,
                    tolerance,
                }));
            }
        }
    }
    settings.sort_by(|a, b| a.effort(1.0).total_cmp(&b.effort(1.0)));
    settings
}

/// The reference: twice as fine as the finest of these cells and steps, by the best method.
pub fn reference(scenario: &Scenario, points: &[usize], steps: &[u32]) -> Setting {
    Setting {
        method: AbelMethod::Product,
        scheme: Scheme::Trapezoid,
        points: 2 * points.iter().copied().max().unwrap_or(100),
        steps: 2 * steps.iter().copied().max().unwrap_or(100),
        tolerance: wants_jumps(scenario).then(|| 0.1 * TOLERANCES.into_iter().fold(1.0, f64::min)),
    }
}

/// Whether the user asks for jumps; an accuracy that chooses them does not.
fn wants_jumps(scenario: &Scenario) -> bool {
    scenario.setup().integrator != Integrator::Direct
        && scenario.value("numerics.integrator").is_some()
}
