//! The state of a run: everything that the next step needs and that cannot be computed again.

use serde::{Deserialize, Serialize};

/// What is saved, restored, and carried over when a method or a law is switched.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Cycles since the start.
    pub cycle: f64,
    /// Steps taken since the start.
    pub steps: u64,
    /// Depth d = u_z, m.
    pub depth: f64,
    /// Tangential displacement of the indenter u_x⁽⁰⁾, m.
    pub shift: f64,
    /// Worn depth f − f₀, m, at the nodes. Kept by itself: a mild step adds 1e-20 m to it, which
    /// would be lost in f.
    pub wear: Vec<f64>,
    /// Displacement of the tangential springs u_x, m, at the nodes; empty without tangential motion.
    pub spring: Vec<f64>,
    /// Work of friction since the start, E_d, J.
    pub dissipated_energy: f64,
    /// The part of the volume that a law in proportion to friction work must have worn, ∫k dE_d, m³.
    pub expected_volume: f64,
    /// Volume worn under other laws, m³: left out where wear is compared with work.
    pub unexplained_volume: f64,
    /// The smallest stick radius since the cycle began, m.
    pub smallest_stick_radius: f64,
    /// The smallest stick radius of the last complete cycle, m; none before there is one.
    pub settled_stick_radius: Option<f64>,
}

impl State {
    /// An unworn, unloaded contact.
    pub fn new(nodes: usize, has_springs: bool) -> Self {
        Self {
            cycle: 0.0,
            steps: 0,
            depth: 0.0,
            shift: 0.0,
            wear: vec![0.0; nodes],
            spring: vec![0.0; if has_springs { nodes } else { 0 }],
            dissipated_energy: 0.0,
            expected_volume: 0.0,
            unexplained_volume: 0.0,
            smallest_stick_radius: f64::INFINITY,
            settled_stick_radius: None,
        }
    }

    /// The permanent stick radius, m: the smallest of the last complete cycle, or so far in the first.
    pub fn permanent_stick_radius(&self) -> f64 {
        self.settled_stick_radius
            .unwrap_or(self.smallest_stick_radius)
    }
}
