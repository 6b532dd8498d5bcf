//! Tangential springs: each follows Coulomb's rule and remembers its displacement.
//!
//! The second Eq. (15) of the paper (the number appears twice): predict that a spring moves with the indenter. If
//! G*|u| ≤ μ q_z it does (stick), otherwise u = ±μ q_z/G* with the predictor's sign (slip). A spring out of contact
//! carries nothing and forgets its displacement: u = 0.

use std::hint::select_unpredictable as select;

use serde::{Deserialize, Serialize};

use super::foundation::{NormalContact, WinklerFoundation};
use crate::math::abel::dome::Dome;
use crate::math::abel::field::Field;
use crate::math::abel::kink;
use crate::math::scan::{changes, leading};
use crate::math::vector::vectorized;

/// A spring still sticks if it exceeds its limit by no more than this fraction of the limit.
///
/// After shakedown a spring touches its limit only once per cycle; rounding must not make it slip there.
const TOUCH: f64 = 1e-10;

/// The same as a fraction of the largest limit, for springs that carry almost nothing.
const TOUCH_OF_LARGEST: f64 = 1e-12;

/// A spring sticks, as far as the stick radius is concerned, if it slips by less than this part of what the outermost one
/// does in the same step. The wear of a step is known after its contact, so a spring that has shaken down finds its limit
/// a little lower in the next cycle, and slips by that.
const SLIGHT: f64 = 0.05;

/// A border closer to a spring than this fraction of the cell counts as being on it.
const ON_A_SPRING: f64 = 1e-9;

/// The motion of a spring in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum SpringState {
    /// Moves with the indenter.
    Stick,
    /// Slips, strained in the direction of x.
    Forward,
    /// Slips, strained against the direction of x.
    Backward,
    /// Out of contact.
    Open,
}

impl SpringState {
    /// +1 or −1 for a spring that slips.
    pub fn sign(self) -> Option<f64> {
        match self {
            Self::Forward => Some(1.0),
            Self::Backward => Some(-1.0),
            Self::Stick | Self::Open => None,
        }
    }
}

/// Input of the tangential springs: the normal contact and their previous displacements.
#[derive(Debug, Clone, Copy)]
pub struct SlipInput<'a> {
    /// Positions of the springs.
    pub foundation: &'a WinklerFoundation,
    /// The normal line load q_z, N/m, nodal.
    pub normal_load: &'a [f64],
    /// How the load falls to zero at the end of a scar, if it does.
    pub dome: Option<Dome>,
    /// The edge of the contact and the largest load.
    pub contact: NormalContact,
    /// μ/G*, 1/Pa: the largest strain of a spring under unit load.
    pub reach: f64,
    /// Previous u_x, m.
    pub before: &'a [f64],
    /// Spring states in the previous step.
    pub held: &'a [SpringState],
}

/// Moves the indenter by `increment` (m). `spring` (m) receives the new displacement of every spring, `slip` (m) the
/// part of the motion that the spring did not follow, and `hold` its state.
///
/// The slip is exactly zero where a spring sticks, so a transform that looks inwards gives a surface slip of exactly
/// zero inside the stick zone.
pub fn slide(
    input: SlipInput<'_>,
    increment: f64,
    spring: &mut [f64],
    slip: &mut [f64],
    hold: &mut [SpringState],
) {
    let SlipInput { reach, before, .. } = input;
    let NormalContact {
        strongest, nodes, ..
    } = input.contact;
    let load = &input.normal_load[..nodes];
    spring[nodes..].fill(0.0);
    slip[nodes..].fill(increment);
    hold[nodes..].fill(SpringState::Open);
    // Branchless, so that the processor handles several springs at a time.
    vectorized(
        #[inline(always)]
        move || {
            let dead_band = TOUCH_OF_LARGEST * reach * strongest;
            let springs = spring.iter_mut().zip(slip).zip(hold).zip(before);
            for ((((after, slip), hold), &before), &load) in springs.zip(load) {
                let limit = reach * load;
                let predicted = before + increment;
                let strain = predicted.abs();
                let open = load <= 0.0;
                let sticks = (strain <= limit * (1.0 + TOUCH) + dead_band) & (limit > 0.0);
                let within = sticks & (strain <= limit);
                let held = select(within, predicted, limit.copysign(predicted));
                let slipped = select(sticks, 0.0, increment - (held - before));
                *after = select(open, 0.0, held);
                *slip = select(open, increment, slipped);
                let slips = select(predicted > 0.0, SpringState::Forward, SpringState::Backward);
                *hold = select(
                    open,
                    SpringState::Open,
                    select(sticks, SpringState::Stick, slips),
                );
            }
        },
    );
}

/// Corrects [`slide`] for springs that came into contact during the step, from the depth `before` to the depth `now`
/// (m) with the 1D profile `g` (m): the indenter moves a spring only from the moment it touches, not over the whole
/// `increment` (m).
pub fn correct_late_contact(
    input: SlipInput<'_>,
    increment: f64,
    [before, now]: [f64; 2],
    g: &[f64],
    springs: (&mut [f64], &mut [f64], &mut [SpringState]),
) {
    if now <= before {
        return;
    }
    let (spring, slip, hold) = springs;
    let held = input.held;
    let first = leading(held, |&state| state != SpringState::Open);
    for j in first..input.contact.nodes {
        if held[j] != SpringState::Open || hold[j] == SpringState::Open {
            continue;
        }
        let limit = input.reach * input.normal_load[j];
        let share = ((now - g[j]) / (now - before)).clamp(0.0, 1.0);
        let taken = share * increment;
        let sticks = taken.abs() <= limit;
        spring[j] = if sticks { taken } else { limit.copysign(taken) };
        slip[j] = increment - spring[j];
        hold[j] = match (sticks, taken > 0.0) {
            (true, _) => SpringState::Stick,
            (false, true) => SpringState::Forward,
            (false, false) => SpringState::Backward,
        };
    }
}

/// Finds the borders of stick and slip between springs, which slipped by `slip` (m): writes the kinks of u_x (m) that they
/// and the contact's edge make, and returns the radius within which every spring sticks, m.
///
/// At a border the line of the springs that stick meets the line of the limits, μ q_z/G*. A spring
/// that stuck in the step before and slips now tells the slope of the first line by where it stood;
/// else the last cell that sticks does.
pub fn borders(
    input: SlipInput<'_>,
    spring: &mut Field,
    slip: &[f64],
    states: &[SpringState],
) -> f64 {
    let contact_radius = input.contact.radius;
    let Field {
        nodal: spring,
        kinks,
        dome,
    } = spring;
    kinks.clear();
    // Springs that slip at the edge are at their limit, which ends as the load does.
    let outermost = input.contact.nodes.checked_sub(1);
    let sign = outermost.and_then(|last| states[last].sign());
    *dome = input
        .dome
        .zip(sign)
        .map(|(dome, sign)| dome.scaled(sign * input.reach));
    let squares = input.foundation.squares();
    let mut stick_radius = end_of_slight_slip(&slip[..input.contact.nodes], squares, states);
    if states
        .first()
        .is_some_and(|&first| first != SpringState::Stick)
    {
        stick_radius = stick_radius.or(Some(0.0));
    }
    for k in changes(states, |&state| state).map(|behind| behind - 1) {
        let cell = Cell {
            input,
            spring,
            states,
            k,
        };
        let width = squares[k + 1] - squares[k];
        let edge = (states[k] == SpringState::Open || states[k + 1] == SpringState::Open)
            .then_some(contact_radius * contact_radius)
            .filter(|&at| {
                at > squares[k] + ON_A_SPRING * width && at < squares[k + 1] - ON_A_SPRING * width
            });
        let border = cell.border(edge);
        if stick_radius.is_none() && states[k] == SpringState::Stick {
            let outside = if states[k + 1] == SpringState::Open {
                edge.unwrap_or(squares[k + 1])
            } else {
                squares[k + 1]
            };
            stick_radius = Some(border.map_or(outside, |(at, _)| at.max(squares[k])).sqrt());
        }
        let mut bend = |inner: &[(f64, f64)]| {
            let (t, v) = ([squares[k], squares[k + 1]], [spring[k], spring[k + 1]]);
            kink::polyline(t, v, inner, kinks);
        };
        let border = border.filter(|&(at, _)| at > squares[k] + ON_A_SPRING * width);
        match (border, edge.map(|at| (at, 0.0))) {
            (Some(border), Some(edge)) => bend(&[border, edge]),
            (Some(inner), None) | (None, Some(inner)) => bend(&[inner]),
            (None, None) => {}
        }
    }
    stick_radius.unwrap_or(contact_radius).min(contact_radius)
}

/// Returns the radius, m, within which springs slip only [slightly](SLIGHT); `None` if none do, or if they slip by more
/// than a line in t = x² (`squares`) that rises from a border to the first of the other springs. `slip` (m) covers the
/// springs in contact.
fn end_of_slight_slip(slip: &[f64], squares: &[f64], states: &[SpringState]) -> Option<f64> {
    let slight = SLIGHT * slip.last()?.abs();
    let stuck = leading(&states[..slip.len()], |&state| state == SpringState::Stick);
    let first = stuck + leading(&slip[stuck..], |slip| slip.abs() <= slight);
    if first == stuck || first == slip.len() {
        return None;
    }
    let [start, last, next] = [stuck, first - 1, first].map(|j| squares[j]);
    let rising = slip[first].abs() * (last - start) / (next - start);
    if slip[first - 1].abs() >= 0.5 * rising {
        return None;
    }
    let outer = (first + 1).min(slip.len() - 1);
    let rises = (slip[outer] - slip[first]) / (squares[outer] - next);
    // Not a number where only the last spring slips more than slightly.
    Some((next - slip[first] / rises).max(last).min(next).sqrt())
}

/// A cell whose two springs do different things.
struct Cell<'a> {
    input: SlipInput<'a>,
    spring: &'a [f64],
    states: &'a [SpringState],
    k: usize,
}

impl Cell<'_> {
    /// Returns x² and u_x where stick ends in this cell, which may be at its inner spring.
    fn border(&self, edge: Option<f64>) -> Option<(f64, f64)> {
        let (k, t) = (self.k, self.input.foundation.squares());
        let width = t[k + 1] - t[k];
        let limit = |j: usize| self.input.reach * self.input.normal_load[j];
        // The limit falls to zero at the contact's edge.
        let end = edge.unwrap_or(t[k + 1]);
        let limit_slope = (limit(k + 1) - limit(k)) / (end - t[k]);
        let (from, sign, stick_slope) = match (self.states[k], self.states[k + 1]) {
            (SpringState::Stick, other) => {
                let sign = other.sign().unwrap_or(self.spring[k].signum());
                let slope =
                    if other != SpringState::Open && self.input.held[k + 1] == SpringState::Stick {
                        (self.input.before[k + 1] - self.input.before[k]) / width
                    } else if k > 0 && self.states[k - 1] == SpringState::Stick {
                        (self.spring[k] - self.spring[k - 1]) / (t[k] - t[k - 1])
                    } else {
                        0.0
                    };
                (k, sign, slope)
            }
            (other, SpringState::Stick) => {
                let slope = if self.input.held[k] == SpringState::Stick {
                    (self.input.before[k + 1] - self.input.before[k]) / width
                } else if self.states.get(k + 2) == Some(&SpringState::Stick) {
                    (self.spring[k + 2] - self.spring[k + 1]) / (t[k + 2] - t[k + 1])
                } else {
                    0.0
                };
                (k + 1, other.sign()?, slope)
            }
            _ => return None,
        };
        // u + slope·(t − t_from) = ±(limit + limit_slope·(t − t_from))
        let limit_here = limit(from);
        let offset = (sign * limit_here - self.spring[from]) / (stick_slope - sign * limit_slope);
        let at = t[from] + offset;
        let inside = at > t[k] - ON_A_SPRING * width && at < end - ON_A_SPRING * width;
        inside.then(|| (at, self.spring[from] + stick_slope * offset))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::grid::RadialGrid;

    /// Test springs under a Hertzian load in units of d = a = E* = G* = 1, μ = 0.1.
    struct Bench {
        row: WinklerFoundation,
        load: Vec<f64>,
        spring: Field,
        slip: Vec<f64>,
        states: Vec<SpringState>,
    }

    impl Bench {
        const CONTACT: NormalContact = NormalContact {
            strongest: 1.0,
            radius: 1.0,
            nodes: 200,
        };

        fn new() -> Self {
            let grid = RadialGrid::uniform(300, 1.5).expect("a grid");
            let load: Vec<f64> = grid.squares().iter().map(|t| (1.0 - t).max(0.0)).collect();
            let n = load.len();
            Self {
                row: WinklerFoundation::new(&grid),
                load,
                spring: Field::zeros(n),
                slip: vec![f64::NAN; n],
                states: vec![SpringState::Stick; n],
            }
        }

        /// Moves by `increment` with `reach`; returns the stick radius.
        fn slide(&mut self, increment: f64, reach: f64) -> f64 {
            let (before, held) = (self.spring.nodal.clone(), self.states.clone());
            let input = SlipInput {
                foundation: &self.row,
                normal_load: &self.load,
                dome: None,
                contact: Self::CONTACT,
                reach,
                before: &before,
                held: &held,
            };
            slide(
                input,
                increment,
                &mut self.spring.nodal,
                &mut self.slip,
                &mut self.states,
            );
            borders(input, &mut self.spring, &self.slip, &self.states)
        }
    }

    #[test]
    fn the_stick_border_is_cattaneos() {
        // 1 − c² = U/μ: with U = 0.05, c = √½; F_x = μF_z[1 − (1 − U/U_s)^{3/2}], F_z = 4/3, U_s = 0.1.
        for steps in [1, 20] {
            let mut bench = Bench::new();
            let mut stick = 0.0;
            for _ in 0..steps {
                stick = bench.slide(0.05 / f64::from(steps), 0.1);
            }
            assert!((stick - 0.5f64.sqrt()).abs() < 1e-13, "{stick}");
            let force = bench.row.force(&bench.spring, Bench::CONTACT);
            let expected = 0.1 * 4.0 / 3.0 * (1.0 - 0.5f64.powf(1.5));
            assert!((force / expected - 1.0).abs() < 1e-12, "{force} {expected}");
            assert!(
                bench
                    .slip
                    .iter()
                    .zip(&bench.states)
                    .all(|(&s, &state)| (s == 0.0) == (state == SpringState::Stick))
            );
        }
    }

    #[test]
    fn history_is_kept_and_a_reversal_sticks_everywhere() {
        let mut bench = Bench::new();
        bench.slide(0.05, 0.1);
        let there = bench.spring.nodal.clone();
        // All springs stick except at the very edge, where they carry less than the increment.
        assert!(bench.slide(-1e-9, 0.1) > 0.99);
        assert!(
            bench
                .spring
                .nodal
                .iter()
                .zip(&there)
                .take(190)
                .all(|(now, then)| (now - then + 1e-9).abs() < 1e-15)
        );
    }

    #[test]
    fn a_spring_that_only_touches_its_limit_sticks() {
        let mut bench = Bench::new();
        bench.slide(0.05, 0.1);
        bench.slide(-0.03, 0.1);
        // Slip reverses only where 2μ(1 − x²) < 0.03. Further in, up to √½, springs just touch their limits.
        let stick = bench.slide(0.03 * (1.0 + 1e-12), 0.1);
        assert!((stick - 0.85f64.sqrt()).abs() < 0.005, "{stick}");
    }

    #[test]
    fn a_limit_that_wear_has_lowered_a_little_moves_no_border() {
        let mut bench = Bench::new();
        for increment in [0.05, -0.05, 0.049] {
            bench.slide(increment, 0.1);
        }
        // Springs between 0.5 and √½ have slipped once and now find their limits lower by 1e-6.
        let squares = bench.row.squares().to_vec();
        let shaken_down = |t: &f64| (0.25..0.5).contains(t);
        for (j, _) in squares.iter().enumerate().filter(|(_, t)| shaken_down(t)) {
            bench.spring.nodal[j] = 0.1 * bench.load[j] - 0.001 + 1e-7;
        }
        // Where 2μ(1 − x²) < 0.05 they slip there and back; further in, limits are touched.
        let stick = bench.slide(0.001, 0.1);
        let slipping = squares.partition_point(|t| *t < 0.3);
        assert_eq!(bench.states[slipping], SpringState::Forward);
        assert!((stick - 0.75f64.sqrt()).abs() < 0.005, "{stick}");
    }

    #[test]
    fn an_open_spring_forgets() {
        let mut bench = Bench::new();
        bench.spring.nodal.fill(0.02);
        bench.slide(0.0, 0.1);
        assert!(
            bench
                .spring
                .nodal
                .iter()
                .zip(&bench.load)
                .all(|(&u, &q)| q > 0.0 || u == 0.0)
        );
        assert!(
            bench
                .spring
                .nodal
                .iter()
                .zip(&bench.load)
                .all(|(&u, &q)| u.abs() <= 0.1 * q)
        );
    }

    #[test]
    fn without_friction_everything_slips() {
        let mut bench = Bench::new();
        assert_eq!(bench.slide(0.05, 0.0), 0.0);
        assert!(bench.spring.nodal.iter().all(|&u| u == 0.0));
        assert!(bench.slip.iter().all(|&s| s == 0.05));
    }
}
