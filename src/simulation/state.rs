//! The state of a run: everything that the next step needs and that cannot be recomputed.

use serde::{Deserialize, Serialize};

use super::contact::Contact;
use super::traction::Pressure;

/// What is saved, restored, and carried over when a method or a law changes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Cycles since the start.
    pub cycle: f64,
    /// Steps taken since the start.
    pub steps: u64,
    /// Worn depth f − f₀, m, at the nodes. Kept separately: a mild step adds 1e-20 m to it, which would be lost in f.
    pub wear: Vec<f64>,
    /// Its 1D image by Eq. (1), m, accumulated by the steps.
    pub image: Vec<f64>,
    /// The contact as the last step solved it.
    pub contact: Contact,
    /// Its pressure; unknown without springs.
    pub pressure: Pressure,
    /// Memory of the previous step for a second-order scheme.
    pub last: LastStep,
    /// Memory of jumps over cycles.
    pub jump: JumpMemory,
    /// Counts of the computations so far.
    pub stats: Stats,
    /// Accumulated quantities.
    pub ledger: Ledger,
}

/// The work done since the start, counted independently of the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Stats {
    /// Contact problems solved.
    pub contacts: u64,
    /// Transforms between the 3D contact and its 1D image.
    pub transforms: u64,
    /// Sub-steps of steps that were too stiff to take whole.
    pub parts: u64,
    /// Cycles stepped through on a frozen profile, for jumps.
    pub evaluated_cycles: u64,
    /// Jumps made.
    pub jumps: u64,
    /// Jumps rejected because their error was too large.
    pub rejected_jumps: u64,
}

/// Memory of a jump over cycles for the next one.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct JumpMemory {
    /// How many cycles the next jump should cover; 0 before the first one.
    pub length: f64,
    /// Cycles are stepped directly up to this one.
    pub rest_until: f64,
    /// Periods to step directly the next time a jump does not pay.
    pub patience: u32,
    /// Wear and work of a steady-state cycle at the present state; `None` if that has changed since.
    pub settled: Option<SteadyCycle>,
}

/// What a steady-state cycle does on a frozen profile, per cycle.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SteadyCycle {
    /// Wear, m, nodal.
    pub wear: Vec<f64>,
    /// Work of friction, J.
    pub friction_work: f64,
    /// The largest compression of a spring, m.
    pub elastic_depth: f64,
    /// The stiffness of each node: h cycles at once are explicitly stable for h times the largest < 2.
    pub stiffness: Vec<f64>,
    /// How many springs touch at the largest depth, or nearly do.
    pub touching: usize,
    /// The smallest stick radius, m.
    pub stick_radius: f64,
}

/// The previous step, as far as the next one needs it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct LastStep {
    /// Its length in cycles; 0 where the motion turned, or smoothness was broken otherwise, so that nothing must be
    /// extrapolated from it.
    pub duration: f64,
    /// The largest stiffness z of a node in it, or in its stiffest sub-step; 0 without wear.
    pub stiffness: f64,
    /// Growth of f, m, nodal.
    pub wear: Vec<f64>,
    /// Growth of g, m, nodal.
    pub growth: Vec<f64>,
}

/// Sums over the run since it began.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// Work of friction since the start, E_d, J.
    pub dissipated_energy: f64,
    /// The volume that laws in proportion to friction work must have worn, ∫k dE_d, m³.
    pub expected_volume: f64,
    /// Volume not explained by friction work, m³: worn before the run, or under other laws. Excluded when wear is
    /// compared with work.
    pub unexplained_volume: f64,
    /// Volume that was worn before the run, m³.
    pub initial_volume: f64,
    /// Smallest stick radius since the current period of the motion began, m.
    pub smallest_stick_radius: f64,
    /// Smallest stick radius of the last complete period, m; `None` before the first.
    pub settled_stick_radius: Option<f64>,
}

impl Ledger {
    const EMPTY: Self = Self {
        dissipated_energy: 0.0,
        expected_volume: 0.0,
        unexplained_volume: 0.0,
        initial_volume: 0.0,
        smallest_stick_radius: f64::INFINITY,
        settled_stick_radius: None,
    };
}

impl State {
    /// An unworn, unloaded contact.
    pub fn new(nodes: usize, has_springs: bool) -> Self {
        let springs = if has_springs { nodes } else { 0 };
        Self {
            cycle: 0.0,
            steps: 0,
            wear: vec![0.0; nodes],
            image: vec![0.0; nodes],
            contact: Contact::new(nodes, springs),
            pressure: Pressure::unknown(springs),
            last: LastStep {
                wear: vec![0.0; nodes],
                growth: vec![0.0; nodes],
                ..LastStep::default()
            },
            jump: JumpMemory::default(),
            stats: Stats::default(),
            ledger: Ledger::EMPTY,
        }
    }

    /// Copies the counters and sums of another state, but not its nodal values.
    pub(super) fn carry_sums(&mut self, from: &Self) {
        self.cycle = from.cycle;
        self.steps = from.steps;
        self.stats = from.stats;
        self.ledger = from.ledger;
        self.jump = JumpMemory {
            settled: None,
            ..from.jump
        };
    }

    /// Returns the permanent stick radius, m: the smallest of the last complete period, or so far in the first.
    pub fn permanent_stick_radius(&self) -> f64 {
        let ledger = &self.ledger;
        ledger
            .settled_stick_radius
            .unwrap_or(ledger.smallest_stick_radius)
    }
}
