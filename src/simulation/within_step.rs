//! Follows springs through a step in which their load changes: when they touch, begin to slip, and leave.
//!
//! # Formula
//!
//! Over a step, the load and the indenter move at constant rates, q(σ) = q₀ + σ Δq and U(σ) = σ ΔU with σ from 0 to 1.
//! A spring displaced by u₀ sticks until it meets its limit, and then slips to the end of the step, or until it leaves:
//!
//! ```text
//! ±(u₀ + σ ΔU) = (μ/G*) q(σ)               where slip begins
//! |ds/dσ|      = ±ΔU − (μ/G*) Δq            how fast it slips
//! work         = μ (q_begin + q_end)/2 · |s|
//! ```
//!
//! This is exact for a single spring, however long the step. Using the mean load of the whole step is not: when a
//! spring leaves, it loses the energy G* u²/2 to friction for any μ, at small loads and over a short slip, and the
//! indenter's motion before a spring touches or after it leaves rubs nothing.

use super::contact::Contact;
use super::model::Model;
use crate::contact::tangential::SpringState;
use crate::math::geometry::Geometry;

/// The slip of a spring under load within a step.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Slip {
    /// Signed, m.
    length: f64,
    /// Mean load during the slip, N/m.
    load: f64,
    /// Whether the spring stuck first.
    is_late: bool,
}

/// Returns the slip of a spring at `before` (m) while its load changes between the two `loads` (N/m), negative out of
/// contact, and the indenter moves by `increment` (m). `reach` is μ/G*. `None` if it does not slip.
fn slip_of(loads: [f64; 2], before: f64, increment: f64, reach: f64) -> Option<Slip> {
    let [from, to] = loads;
    let change = to - from;
    let passes_zero = (-from / change).clamp(0.0, 1.0);
    let (start, end) = match (from > 0.0, to > 0.0) {
        (true, true) => (0.0, 1.0),
        (true, false) => (0.0, passes_zero),
        (false, true) => (passes_zero, 1.0),
        (false, false) => return None,
    };
    // A spring is at zero when it touches.
    let held = if from > 0.0 { before } else { 0.0 };
    let limit = reach * from.max(0.0);
    let begins = |sign: f64| {
        let speed = sign * increment - reach * change;
        let begin = start + (limit - sign * held).max(0.0) / speed;
        (speed > 0.0 && begin < end).then_some((begin, sign * speed))
    };
    let (begin, speed) = match (begins(1.0), begins(-1.0)) {
        (Some(one), Some(other)) if other.0 < one.0 => other,
        (one, other) => one.or(other)?,
    };
    let at = |share: f64| (from + share * change).max(0.0);
    Some(Slip {
        length: (end - begin) * speed,
        load: 0.5 * (at(begin) + at(end)),
        is_late: begin > start,
    })
}

/// Springs that slip, touch or leave within a step, and their loads meanwhile.
#[derive(Debug, Clone, Default)]
pub(super) struct Within {
    /// State of each spring while it was in contact.
    pub states: Vec<SpringState>,
    /// Its load while it slipped, relative to the mean load of the step.
    pub share: Vec<f64>,
    /// Slip that does work, m.
    pub slip: Vec<f64>,
    /// Whether springs stick for part of the step and then leave, or too few slip to show where slip ends between them.
    pub is_ragged: bool,
}

/// Up to this many springs do not show where slip begins and ends between them.
const FEW: usize = 2;

impl Within {
    /// Allocates for this many `springs`.
    pub fn new(springs: usize) -> Self {
        Self {
            states: vec![SpringState::Open; springs],
            share: vec![1.0; springs],
            slip: vec![0.0; springs],
            is_ragged: false,
        }
    }

    /// Follows the springs from one of two contacts to the other, whose friction at the mean load is `friction` (N/m).
    /// Corrects slip (m) and friction if springs stick for part of the step before they slip and leave; if all of them
    /// slip from the beginning, the mean load is used unchanged.
    pub fn follow(
        &mut self,
        model: &Model,
        [before, after]: [&Contact; 2],
        friction: &mut [f64],
        slip: &mut [f64],
    ) {
        let material = &model.setup.material;
        let (coefficient, reach) = (material.friction(), material.reach());
        // The displacement of a line contact is measured relative to a gauge: its springs move by less.
        let increment = match model.setup.geometry {
            Geometry::Round => after.shift - before.shift,
            Geometry::Line { .. } => slip[0] + after.spring.nodal[0] - before.spring.nodal[0],
        };
        let sinks = material.normal_modulus() * (after.depth - before.depth);
        let end = before.normal.nodes.max(after.normal.nodes);
        let loads = |j: usize| [before.load.nodal[j], after.load.nodal[j]];
        // Slip of a spring that touches or leaves during the step.
        let follow = |j: usize| {
            let changed = match (loads(j), loads(j).map(|load| load > 0.0)) {
                ([from, _], [true, false]) => [from, (from + sinks).min(0.0)],
                ([_, to], [false, true]) => [(to - sinks).min(0.0), to],
                _ => return None,
            };
            Some(slip_of(changed, before.spring.nodal[j], increment, reach))
        };
        self.states.copy_from_slice(&after.spring_state);
        self.share.fill(1.0);
        let (mut is_late, mut slipping) = (false, 0);
        for (j, slip) in slip[..end].iter_mut().enumerate() {
            match follow(j) {
                // Motion of the indenter before it takes the spring along is not slip.
                Some(None) => *slip = 0.0,
                Some(Some(found)) => is_late |= found.is_late,
                None => {}
            }
            slipping += usize::from(*slip != 0.0);
        }
        self.is_ragged = is_late || slipping <= FEW;
        if self.is_ragged {
            for (j, friction) in friction[..end].iter_mut().enumerate() {
                let load = if let Some(Some(found)) = follow(j) {
                    slip[j] = found.length;
                    self.states[j] = if found.length > 0.0 {
                        SpringState::Forward
                    } else {
                        SpringState::Backward
                    };
                    found.load
                } else if slip[j] != 0.0 {
                    let [from, to] = loads(j);
                    let whole = increment - slip[j].signum() * reach * (to - from);
                    let late = (1.0 - slip[j] / whole).clamp(0.0, 1.0);
                    0.5 * (from + to + late * (to - from))
                } else {
                    continue;
                };
                if *friction > 0.0 {
                    self.share[j] = coefficient * load / *friction;
                }
                *friction = coefficient * load;
            }
        }
        self.slip.copy_from_slice(slip);
        let at_edge = end.checked_sub(1).map_or(0.0, |last| slip[last]);
        if self.is_ragged {
            self.end_slip(friction, end);
        } else if at_edge == 0.0 {
            // Next to a spring that sticks, open springs move with the indenter and rub nothing.
            self.slip[end..].fill(0.0);
        }
    }

    /// Lets the work fall linearly to zero towards springs that do none, whatever they carry.
    fn end_slip(&mut self, friction: &mut [f64], end: usize) {
        self.slip[end..].fill(0.0);
        for j in 0..friction.len().min(end + 1) {
            if self.slip[j] != 0.0 {
                continue;
            }
            let next = self.slip.get(j + 1).is_some_and(|&slip| slip != 0.0);
            if next {
                friction[j] = friction[j + 1];
            } else if j > 0 && self.slip[j - 1] != 0.0 {
                friction[j] = friction[j - 1];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Applies Coulomb's rule in many small steps: returns the work per μ, N m/m, and the slip under load, m.
    fn stepped(loads: [f64; 2], before: f64, increment: f64, reach: f64) -> [f64; 2] {
        let steps = 200_000;
        let load = |i: i32| loads[0] + (loads[1] - loads[0]) * f64::from(i) / f64::from(steps);
        let mut u = before;
        let (mut work, mut slid) = (0.0, 0.0);
        for i in 0..steps {
            let [was, is] = [load(i), load(i + 1)].map(|load| load.max(0.0));
            if is == 0.0 && was == 0.0 {
                u = 0.0;
                continue;
            }
            let moved = u + increment / f64::from(steps);
            let held = moved.clamp(-reach * is, reach * is);
            work += 0.5 * (was + is) * (moved - held).abs();
            slid += moved - held;
            u = held;
        }
        [work, slid]
    }

    #[test]
    fn a_spring_slips_in_one_step_as_in_many() {
        for (loads, before, increment, reach) in [
            ([1.0, 2.0], 0.0, 0.7, 0.2),
            ([2.0, 1.0], 0.1, -0.7, 0.2),
            ([1.0, -0.5], 0.05, 0.02, 0.2),
            ([1.0, -0.5], 0.05, -0.3, 50.0),
            ([1.0, -3.0], -0.05, 0.01, 1e3),
            ([-1.0, 2.0], 0.0, 0.5, 0.1),
            ([-1.0, 2.0], 0.0, -0.5, 0.1),
        ] {
            let found = slip_of(loads, before, increment, reach).expect("slip");
            let [work, slid] = stepped(loads, before, increment, reach);
            let [of_work, of_slip] = [found.load * found.length.abs() - work, found.length - slid];
            // Small steps know the load only to its change per step.
            let change = (loads[1] - loads[0]).abs() / 200_000.0;
            assert!(
                of_work.abs() < 2e-4 * work + change * slid.abs()
                    && of_slip.abs() < 2e-4 * slid.abs(),
                "{found:?} {work} {slid}"
            );
        }
    }

    #[test]
    fn what_sticks_or_is_open_does_not_slip() {
        assert_eq!(slip_of([1.0, 2.0], 0.0, 0.1, 0.2), None);
        assert_eq!(slip_of([-1.0, 2.0], 0.0, 0.1, 0.2), None);
        assert_eq!(slip_of([-1.0, -2.0], 0.0, 0.1, 0.2), None);
    }
}
