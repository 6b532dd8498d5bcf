//! A setting of everything that trades speed for accuracy, and the ladders of settings to try.

use crate::math::abel::AbelMethod;
use crate::scenario::{Change, Scenario, ScenarioError};
use crate::simulation::{Integrator, Scheme};

/// Numbers of cells that are tried.
pub const POINTS: [usize; 3] = [25, 50, 100];

/// Steps a cycle that are tried.
pub const STEPS: [u32; 3] = [12, 25, 50];

/// Tolerances of jumps that are tried.
pub const TOLERANCES: [f64; 5] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5];

/// Steps a cycle under jumps by another method than the best.
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
    /// Steps a cycle.
    pub steps: u32,
    /// The tolerance of jumps over cycles; none: every cycle is stepped.
    pub tolerance: Option<f64>,
}

impl Setting {
    /// The keys of a scenario and their values.
    pub fn keys(&self) -> Vec<(&'static str, String)> {
        let mut keys = vec![
            ("numerics.method", self.method.name().to_owned()),
            ("numerics.scheme", self.scheme.name().to_owned()),
            ("numerics.points", self.points.to_string()),
            ("numerics.steps_per_cycle", self.steps.to_string()),
        ];
        let integrator = usize::from(self.tolerance.is_some());
        keys.push((
            "numerics.integrator",
            Integrator::NAMES[integrator].to_owned(),
        ));
        if let Some(tolerance) = self.tolerance {
            keys.push(("numerics.tolerance", format!("{tolerance:e}")));
        }
        keys
    }

    /// The scenario computed so.
    pub fn of(&self, scenario: &Scenario) -> Result<Scenario, ScenarioError> {
        self.keys()
            .iter()
            .try_fold(scenario.clone(), |scenario, (key, value)| {
                scenario.after(&Change::new(0.0, key, value))
            })
    }

    /// How much there is to compute in a run of `cycles`, to tell the progress by: kernel values.
    pub fn effort(&self, cycles: f64) -> u64 {
        let cycles = match self.tolerance {
            // What a jump looks at hardly depends on how far it goes.
            Some(tolerance) => cycles.min(60.0 * tolerance.powf(-0.25)),
            None => cycles,
        };
        let nodes = self.points as f64;
        (cycles * f64::from(self.steps) * (nodes * nodes + 60.0 * nodes + 1500.0)) as u64
    }
}

/// What is tried.
#[derive(Debug, Clone, PartialEq)]
pub struct Ladder {
    /// Methods.
    pub methods: Vec<AbelMethod>,
    /// Numbers of cells.
    pub points: Vec<usize>,
    /// Steps a cycle.
    pub steps: Vec<u32>,
    /// Tolerances of jumps.
    pub tolerances: Vec<f64>,
}

impl Default for Ladder {
    fn default() -> Self {
        Self {
            methods: AbelMethod::ALL.to_vec(),
            points: POINTS.to_vec(),
            steps: STEPS.to_vec(),
            tolerances: TOLERANCES.to_vec(),
        }
    }
}

impl Ladder {
    /// Every setting, the cheapest first. Where cycles are alike they are tried with jumps as well, by
    /// the best method; a scenario that asks for jumps is not tried without.
    pub fn settings(&self, scenario: &Scenario) -> Vec<Setting> {
        let setup = scenario.setup();
        let wants_jumps = wants_jumps(scenario);
        let repeats = setup.drive.repeats_after().is_some() && setup.wear.is_some();
        let mut settings = Vec::new();
        for &method in &self.methods {
            for scheme in Scheme::ALL {
                for &points in &self.points {
                    let setting = |steps, tolerance| Setting {
                        method,
                        scheme,
                        points,
                        steps,
                        tolerance,
                    };
                    if !wants_jumps {
                        settings.extend(self.steps.iter().map(|&steps| setting(steps, None)));
                    }
                    let best = method == AbelMethod::Product && scheme == Scheme::Trapezoid;
                    if repeats && (best || wants_jumps) {
                        let steps = if best {
                            &self.steps[..]
                        } else {
                            &[STEPS_UNDER_JUMPS]
                        };
                        for &tolerance in &self.tolerances {
                            let jumps = steps.iter();
                            settings.extend(jumps.map(|&steps| setting(steps, Some(tolerance))));
                        }
                    }
                }
            }
        }
        settings.sort_by_key(|setting| setting.effort(1.0));
        settings
    }

    /// The reference: twice as fine as the finest of the ladder, by the best method.
    pub fn reference(&self, scenario: &Scenario) -> Setting {
        let wants_jumps = wants_jumps(scenario);
        let finest = |ladder: &[f64]| ladder.iter().copied().fold(1.0, f64::min);
        Setting {
            method: AbelMethod::Product,
            scheme: Scheme::Trapezoid,
            points: 2 * self.points.iter().copied().max().unwrap_or(100),
            steps: 2 * self.steps.iter().copied().max().unwrap_or(100),
            tolerance: wants_jumps.then(|| 0.1 * finest(&self.tolerances)),
        }
    }
}

/// Whether the user asks for jumps; an accuracy that chooses them does not.
fn wants_jumps(scenario: &Scenario) -> bool {
    scenario.setup().integrator != Integrator::Direct
        && scenario.value("numerics.integrator").is_some()
}
