//! Steps finely through the last period of the motion, on the present profile.
//!
//! Steps of a run are as long as its wear allows. A loop drawn through their ends is a polygon: at 12 steps its area is
//! 4 % below the friction work, and a stiffness fitted to it takes the missing corners for compliance. Here only the
//! springs are stepped, which is cheap, since nothing wears and no transform is needed.
//!
//! # Method
//!
//! - The springs start from the state. A first passage through the period settles them, the second one is the
//!   result: a steady-state cycle on the present profile, after jumps and direct steps alike.
//! - Steps end where the motion turns and where contact is made or lost. Between these, a step is halved until the
//!   triangle of its ends and its middle in the (u, F_x) plane is small compared with the loop's area.
//! - Without a common period of the two motions, the passage covers the last tangential cycle, and the springs settle
//!   during the cycles before it.
//!
//! At a held depth each point is exact except for the grid, so the area matches the closed forms; with a moving depth
//! the error is of second order in the step.

use super::contact::{Contact, ContactProblem};
use super::moments::{Touch, rounding};
use super::profile::{Profile, even_end};
use super::{Cause, Simulation};

/// Pairs of steps per cycle of the faster motion, before halving.
const FEWEST: f64 = 20.0;

/// The same in the first passage at a held depth: only the turning points settle the springs, the other points merely
/// trace the loop.
const FEWEST_TO_SETTLE: f64 = 4.0;

/// Steps are halved until they miss about this fraction of the loop's area.
const MISSED: f64 = 1e-4;

/// A loop thinner than this fraction of its bounding box counts as a line: no step is halved for its area.
const THINNEST: f64 = 1e-3;

/// Maximum number of halvings of a step.
const MOST_HALVINGS: i32 = 6;

/// The period that ends at the present moment of a simulation.
#[derive(Debug, Clone)]
pub struct FinePeriod {
    /// Its moments, from its beginning to its end, at least two.
    pub points: Vec<PeriodPoint>,
    /// Number of cycles.
    pub cycles: f64,
}

/// One moment of a period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeriodPoint {
    /// Cycles since the start of the run.
    pub cycle: f64,
    /// u_x⁽⁰⁾, m.
    pub shift: f64,
    /// Displacement of the rig's actuator, m, which its sensor sees: u_x⁽⁰⁾ on a stiff rig.
    pub sensed: f64,
    /// F_x, N.
    pub tangential_force: f64,
    /// F_z, N.
    pub normal_force: f64,
    /// a, m.
    pub contact_radius: f64,
    /// c of the moment, m.
    pub stick_radius: f64,
}

impl FinePeriod {
    /// The work of friction per cycle, J: the area of the loop.
    pub fn energy_per_cycle(&self) -> f64 {
        area(&self.points).abs() / self.cycles
    }

    /// Returns half the range of the values that `of` picks, such as F_x, N.
    pub fn amplitude(&self, of: fn(&PeriodPoint) -> f64) -> f64 {
        let values = || self.points.iter().map(of);
        let highest = values().fold(f64::NEG_INFINITY, f64::max);
        0.5 * (highest - values().fold(f64::INFINITY, f64::min))
    }

    /// Returns F_x, N, at a `cycle` of the period, by linear interpolation.
    pub fn force_at(&self, cycle: f64) -> f64 {
        let last = self.points.len() - 1;
        let next = self.points.partition_point(|point| point.cycle < cycle);
        let next = next.clamp(1, last);
        let [before, after] = [self.points[next - 1], self.points[next]];
        let length = (after.cycle - before.cycle).max(f64::MIN_POSITIVE);
        let share = ((cycle - before.cycle) / length).clamp(0.0, 1.0);
        before.tangential_force + share * (after.tangential_force - before.tangential_force)
    }

    /// The smallest stick radius, m.
    pub fn permanent_stick_radius(&self) -> f64 {
        let radii = self.points.iter().map(|point| point.stick_radius);
        radii.fold(f64::INFINITY, f64::min)
    }
}

impl Simulation {
    /// Steps the springs finely through the last period of the motion on the present profile, without wear.
    ///
    /// `None` without tangential motion, and if the contact cannot be solved.
    pub fn fine_period(&self) -> Option<FinePeriod> {
        let setup = self.setup();
        let period = setup.drive.repeats_after();
        let now = self.cycle();
        let cycles = f64::from(period.unwrap_or(1));
        // Phases are the run's; a periodic motion may as well continue into the next periods.
        let (start, begin) = match period {
            Some(_) => (now, now + cycles),
            None if now < 1.0 => (now, now),
            None => {
                let settling = f64::from(setup.drive.cycles_to_settle());
                ((now - 1.0 - settling).max(0.0), now - 1.0)
            }
        };
        let mut passage = PeriodPass::begin(self, start)?;
        let is_held = setup.drive.normal().oscillation().amplitude() == 0.0;
        let to_settle = if is_held { FEWEST_TO_SETTLE } else { FEWEST };
        let first = passage.go(begin, to_settle, None).ok()?;
        let box_area = bounding_box(&first);
        let enclosed = area(&first[first.partition_point(|point| point.cycle < begin - cycles)..]);
        let scale = enclosed.abs().max(THINNEST * box_area) / cycles;
        let mut points = passage
            .go(begin + cycles, FEWEST, Some(MISSED * scale))
            .ok()?;
        let late = begin + cycles - now;
        points.iter_mut().for_each(|point| point.cycle -= late);
        Some(FinePeriod { points, cycles })
    }
}

/// A passage through the motion, step by step.
struct PeriodPass<'a> {
    simulation: &'a Simulation,
    profile: Profile,
    touch: Touch,
    cycle: f64,
    contact: Contact,
    /// Buffers for further contacts, and for the slip of the springs.
    spare: [Contact; 2],
    slip: Vec<f64>,
}

impl<'a> PeriodPass<'a> {
    /// Begins at `cycle` with the springs of a simulation.
    fn begin(simulation: &'a Simulation, cycle: f64) -> Option<Self> {
        let (setup, state) = (simulation.setup(), simulation.state());
        if setup.springs() == 0 {
            return None;
        }
        let worn = [&state.wear[..], &state.image];
        let even = even_end(simulation.model(), &state.contact.load);
        let profile = Profile::of_worn(simulation.model(), worn, even);
        let contact = state.contact.clone();
        let mut passage = Self {
            simulation,
            touch: Touch::new(setup, state, profile.g.iter().copied()),
            profile,
            cycle,
            spare: [contact.clone(), contact.clone()],
            contact,
            slip: vec![0.0; setup.springs()],
        };
        passage.solve(0, cycle).ok()?;
        let [first, _] = &mut passage.spare;
        std::mem::swap(&mut passage.contact, first);
        Some(passage)
    }

    /// Solves the contact at `cycle` into a spare one: the first from the present one, the second from the first.
    fn solve(&mut self, into: usize, cycle: f64) -> Result<(), Cause> {
        let model = self.simulation.model();
        let targets = model.setup.drive.targets(cycle);
        let [first, second] = &mut self.spare;
        let (before, after) = match into {
            0 => (&self.contact, first),
            _ => (&*first, second),
        };
        ContactProblem::new(model, &self.profile, before).solve(targets, after, &mut self.slip)
    }

    /// Goes to the cycle `end` in `pairs` of steps per cycle of the faster motion; returns the moments on the way, this
    /// one and that one included. Steps are halved until they miss no more area (J) per cycle than `missed`.
    fn go(&mut self, end: f64, pairs: f64, missed: Option<f64>) -> Result<Vec<PeriodPoint>, Cause> {
        let setup = self.simulation.setup();
        let longest = (pairs * f64::from(setup.drive.turns_of_the_faster())).recip();
        let shortest = longest * 0.5_f64.powi(MOST_HALVINGS);
        let mut points = vec![self.point(&self.contact, self.cycle)];
        // Ends of steps that follow later.
        let mut waiting = Vec::new();
        while self.cycle < end {
            let next = match waiting.pop() {
                Some(next) => next,
                None => self.next_stop(longest, end),
            };
            let duration = next - self.cycle;
            let middle = self.cycle + 0.5 * duration;
            self.solve(0, middle)?;
            self.solve(1, next)?;
            let here = points[points.len() - 1];
            let ahead =
                [(0, middle), (1, next)].map(|(at, when)| self.point(&self.spare[at], when));
            let triangle = 0.5 * area(&[here, ahead[0], ahead[1], here]).abs();
            let is_fine = missed.is_none_or(|missed| triangle <= 3.0 * missed * duration);
            if is_fine || duration <= 2.0 * shortest {
                points.extend(ahead);
                std::mem::swap(&mut self.contact, &mut self.spare[1]);
                self.cycle = next;
            } else {
                waiting.extend([next, middle]);
            }
        }
        Ok(points)
    }

    /// Returns the end of the next step: at most `longest` away and at `end`, or where the motion turns or touches.
    fn next_stop(&self, longest: f64, end: f64) -> f64 {
        let (setup, now) = (self.simulation.setup(), self.cycle);
        let rounding = rounding(setup, now);
        let regular = ((now / longest + 1e-6).floor() + 1.0) * longest;
        let until = if regular > end - rounding {
            end
        } else {
            regular
        };
        let turn = self.touch.turning_point(setup, now + rounding, until);
        let touching =
            (setup.drive).touching_point(self.touch.tip(), now + rounding, turn.unwrap_or(until));
        touching.or(turn).unwrap_or(until)
    }

    fn point(&self, contact: &Contact, cycle: f64) -> PeriodPoint {
        let model = self.simulation.model();
        let tangential_force = contact.tangential_force(model);
        PeriodPoint {
            cycle,
            shift: contact.shift,
            sensed: contact.shift + model.setup.drive.rig_compliance() * tangential_force,
            tangential_force,
            normal_force: contact.normal_force(model),
            contact_radius: contact.normal.radius,
            stick_radius: contact.stick_radius.unwrap_or(contact.normal.radius),
        }
    }
}

/// ∮F_x du_x over points, J, closed by a straight line.
fn area(points: &[PeriodPoint]) -> f64 {
    let Some(last) = points.last() else {
        return 0.0;
    };
    let mut before = last;
    let mut sum = 0.0;
    for point in points {
        sum +=
            0.5 * (before.tangential_force + point.tangential_force) * (point.shift - before.shift);
        before = point;
    }
    sum
}

/// Returns the area of the smallest upright rectangle around points, J.
fn bounding_box(points: &[PeriodPoint]) -> f64 {
    let span = |of: fn(&PeriodPoint) -> f64| {
        let values = points.iter().map(of);
        let highest = values.clone().fold(f64::NEG_INFINITY, f64::max);
        highest - values.fold(f64::INFINITY, f64::min)
    };
    span(|point| point.shift) * span(|point| point.tangential_force)
}
