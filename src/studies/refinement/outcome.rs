//! The quantities by which two runs of a scenario are compared: see [`Quantity`].

use std::ops::Index;

use strum::EnumCount;

use crate::math::abel::worn;
use crate::math::grid::RadialGrid;
use crate::math::quadrature::weighted;
use crate::math::scan::{largest, rms};
use crate::reading::{Errors, Quantity};
use crate::scenario::session::Session;
use crate::simulation::Simulation;

/// Radii at which scars and pressures are compared.
const RADII: usize = 401;

/// Moments of the last cycle at which forces are compared; the [fine period](Simulation::fine_period) includes them.
const MOMENTS: usize = 20;

/// p is not compared within this distance, in contact radii, of the axis, the stick border and the contact's edge:
/// there p or its slope is singular, and nodal values depend on where the node lies.
const BORDER: f64 = 0.05;

/// Errors of E_d and of the loop's area are relative to at least this fraction of 4μF_zU: a rig sees a thinner loop as
/// a line.
const LEAST_AREA: f64 = 1e-3;

/// Lower bound on the error of V and E_d, relative to the error of the worn depth.
const OF_SCAR: f64 = 0.3;

/// Lower bound on the error of the deepest wear, which is one node's, relative to the rms error of the worn depth.
const OF_DEEPEST: f64 = 1.0;

/// The order assumed in estimating errors. Orders of 1.5 to 2 are usual, so estimates are twice the true error in the
/// median. An order inferred from two differences is no better, since neighbouring levels scatter.
const ORDER: f64 = 1.1;

/// Errors cannot fall with a higher order; if they seem to, two runs agree by chance.
const HIGHEST_ORDER: f64 = 2.0;

/// A grid resolves a scar if its volume on the grid is off by less than this fraction.
const SEEN: f64 = 0.5;

/// The state of a run at its end.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    pub(super) grid: RadialGrid,
    /// Worn depth at the nodes, m, including the scar that the run began with.
    pub(super) profile: Vec<f64>,
    /// Wear since then, m.
    pub(super) wear: Vec<f64>,
    /// V worn by the run itself, m³.
    pub volume: f64,
    /// E_d, J.
    work: f64,
    /// Cycles.
    cycles: f64,
    /// Relative difference of V and k E_d, two computations of one number.
    pub imbalance: f64,
    last: LastCycle,
    pressure: Vec<f64>,
    /// a, m.
    radius: f64,
    /// Stick radii, present and permanent, m; 0 without tangential motion.
    stick_radii: [f64; 2],
    /// d or the present depth, m, to which the tolerance of jumps is relative.
    pub depth: f64,
}

/// The compared values of the last fretting loop; empty without tangential motion.
#[derive(Debug, Clone, PartialEq, Default)]
struct LastCycle {
    /// F_x at [`MOMENTS`] equidistant moments of the last cycle, N.
    forces: Vec<f64>,
    /// Largest μF_z, N.
    friction: f64,
    /// Area of the loop, per cycle, J.
    area: f64,
    /// 4μF_zU, J.
    sliding: f64,
}

impl LastCycle {
    fn new(simulation: &Simulation) -> Self {
        let Some(period) = simulation.fine_period() else {
            return Self::default();
        };
        let friction = simulation.setup().material.friction();
        let strongest = period.points.iter().map(|at| at.normal_force);
        let friction = friction * strongest.fold(0.0, f64::max);
        let first = ((simulation.cycle() - 1.0) * MOMENTS as f64).ceil();
        let moment = |part: usize| (first + part as f64) / MOMENTS as f64;
        Self {
            forces: (0..MOMENTS)
                .map(|part| period.force_at(moment(part)))
                .collect(),
            friction,
            area: period.energy_per_cycle(),
            sliding: 4.0 * friction * period.amplitude(|at| at.shift),
        }
    }

    /// Returns the largest difference of the forces from another cycle's, N.
    fn force_difference(&self, other: &Self) -> f64 {
        let pairs = self.forces.iter().zip(&other.forces);
        // Keeps NaN, unlike a fold by `f64::max`.
        pairs
            .map(|(a, b)| (a - b).abs())
            .max_by(f64::total_cmp)
            .unwrap_or(0.0)
    }
}

/// The difference between two runs: the error of each [`Quantity`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Difference([f64; Quantity::COUNT]);

impl Index<Quantity> for Difference {
    type Output = f64;

    fn index(&self, quantity: Quantity) -> &f64 {
        &self.0[quantity as usize]
    }
}

impl Difference {
    /// Returns the largest error of the quantities that an accuracy guarantees; NaN if one of them is NaN.
    pub fn promised(&self) -> f64 {
        self.worst(Quantity::is_promised)
    }

    /// Returns these errors for the files of a run; if nothing has worn, the errors of wear mean nothing.
    pub fn stated(&self, has_worn: bool) -> Errors {
        Errors::new(|of| (has_worn || !of.is_of_wear()).then(|| self[of]))
    }

    /// Returns the largest error of the quantities of wear.
    pub fn of_wear(&self) -> f64 {
        self.worst(Quantity::is_of_wear)
    }

    fn worst(&self, counts: impl Fn(Quantity) -> bool) -> f64 {
        let counted = Quantity::ALL.iter().filter(|&&of| counts(of));
        // `total_cmp` sorts NaN last.
        let worst = counted.map(|&of| self[of]).max_by(f64::total_cmp);
        worst.unwrap_or_default()
    }

    /// Turns the difference into an estimate. V and E_d are integrals of the same scar: if two runs differ in its depth
    /// but not in these, that is chance.
    pub(super) fn as_estimate(&self) -> Self {
        let mut estimate = *self;
        for (of, least) in [
            (Quantity::Volume, OF_SCAR),
            (Quantity::Energy, OF_SCAR),
            (Quantity::Deepest, OF_DEEPEST),
        ] {
            let error = &mut estimate.0[of as usize];
            *error = error.max(least * self[Quantity::WornDepth]);
        }
        estimate
    }

    /// Returns the error of a run with this difference from its twin, than which it is `ratio` times finer.
    pub(super) fn error_at(&self, ratio: f64) -> Self {
        let per_error = difference_per_error(ratio);
        self.combined(self, |d, _| d / per_error)
    }

    /// As [`error_at`](Self::error_at), if the twin is coarser and has the error `before`: at least 1/ρ² of it remains.
    pub(super) fn error_above(&self, before: &Self, ratio: f64) -> Self {
        let left = ratio.powf(-HIGHEST_ORDER);
        let error = self.error_at(ratio);
        error.combined(before, |error, before| error.max(before * left))
    }

    /// Combines two differences, number by number.
    pub(super) fn combined(&self, other: &Self, combine: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|k| combine(self.0[k], other.0[k])))
    }
}

/// Returns how far two runs differ, relative to the error of one that is `ratio` times finer than the other, or coarser
/// for a ratio below 1: |ρᵖ − 1|, for errors that fall with the power p of cells and steps.
pub fn difference_per_error(ratio: f64) -> f64 {
    (ratio.powf(ORDER) - 1.0).abs()
}

impl Outcome {
    /// Records the present moment of a run.
    pub fn from_session(session: &Session) -> Self {
        let simulation = session.simulation();
        let (setup, moment) = (simulation.setup(), simulation.moment());
        let stick_radii = [moment.stick_radius, moment.permanent_stick_radius];
        Self {
            grid: setup.grid.clone(),
            profile: simulation.worn_depth().to_vec(),
            wear: simulation.worn_since_start(),
            volume: moment.wear_volume - moment.initial_volume,
            work: moment.dissipated_energy,
            cycles: moment.cycle,
            imbalance: moment.energy_residual.unwrap_or(0.0).abs(),
            last: LastCycle::new(simulation),
            pressure: simulation.pressure(),
            radius: moment.contact_radius,
            stick_radii: stick_radii.map(Option::unwrap_or_default),
            depth: setup.depth_scale(moment.depth),
        }
    }

    /// Returns the largest new worn depth, m.
    pub fn scar_depth(&self) -> f64 {
        largest(&self.wear)
    }

    /// Whether the nodes of a grid resolve most of the scar.
    pub(super) fn is_resolved_by(&self, grid: &RadialGrid) -> bool {
        let volume =
            |grid: &RadialGrid, depth: &[f64]| weighted(&worn::volume_weights(grid), depth);
        let there = grid.nodes().iter();
        let there: Vec<f64> = there
            .map(|&r| worn::interpolate(&self.grid, &self.wear, r))
            .collect();
        let ratio = volume(grid, &there) / volume(&self.grid, &self.wear);
        (1.0 - SEEN..1.0 + SEEN).contains(&ratio)
    }

    /// Returns where the scar begins and ends, m, if there is one.
    fn scar(&self) -> Option<(f64, f64)> {
        let [first, last] = worn::scar(&self.wear)?;
        let before = first.saturating_sub(1);
        let after = (last + 1).min(self.grid.cells());
        Some((self.grid.nodes()[before], self.grid.nodes()[after]))
    }

    /// Estimates the error of this run by a `twin`, than which it is `ratio` times finer, or coarser for a ratio below 1.
    pub fn error_by(&self, twin: &Self, ratio: f64) -> Difference {
        let [coarse, fine] = if ratio < 1.0 {
            [self, twin]
        } else {
            [twin, self]
        };
        coarse.difference_from(fine).error_at(ratio)
    }

    /// Returns how many times as many cells it has as a `twin` whose steps differ alike; rounding to whole cells makes
    /// this differ from what was asked for.
    pub fn finer_than(&self, twin: &Self) -> f64 {
        self.grid.cells() as f64 / twin.grid.cells() as f64
    }

    /// Returns the difference of this run from a finer one, in units of the finer one.
    pub fn difference_from(&self, fine: &Self) -> Difference {
        let least = LEAST_AREA * fine.last.sliding;
        let stick = self.stick_radii.iter().zip(&fine.stick_radii);
        let stick = stick
            .map(|(one, other)| (one - other).abs())
            .fold(0.0, f64::max);
        Difference(std::array::from_fn(|k| match Quantity::ALL[k] {
            Quantity::WornDepth => relative(self.worn_difference(fine), fine.scar_depth()),
            Quantity::Deepest => relative(self.scar_depth() - fine.scar_depth(), fine.scar_depth()),
            Quantity::Volume => relative(self.volume - fine.volume, fine.volume),
            Quantity::Energy => relative(self.work - fine.work, fine.work.max(least * fine.cycles)),
            Quantity::Force => relative(
                self.last.force_difference(&fine.last),
                // At lift-off one of the two may carry no force at all.
                fine.last.friction.max(self.last.friction),
            ),
            Quantity::Loop => relative(self.last.area - fine.last.area, fine.last.area.max(least)),
            Quantity::Pressure => self.pressure_difference(fine),
            Quantity::ContactRadius => relative(self.radius - fine.radius, fine.radius),
            Quantity::StickRadius => relative(stick, fine.radius),
        }))
    }

    /// Returns the largest difference of p away from borders, relative to the largest p there.
    fn pressure_difference(&self, fine: &Self) -> f64 {
        let away = BORDER * fine.radius;
        let end = self.radius.min(fine.radius) - away;
        let borders = self.stick_radii.iter().chain(&fine.stick_radii);
        let is_away = |r: f64| borders.clone().all(|border| (r - border).abs() > away);
        let (mut difference, mut most) = (0.0_f64, 0.0_f64);
        for r in (1..RADII).map(|i| end * i as f64 / (RADII - 1) as f64) {
            if r > away && is_away(r) {
                let here = self.grid.interpolate(&self.pressure, r);
                let there = fine.grid.interpolate(&fine.pressure, r);
                difference = difference.max((here - there).abs());
                most = most.max(there);
            }
        }
        relative(difference, most)
    }

    /// Returns the rms difference of the worn depth over both scars, m.
    fn worn_difference(&self, fine: &Self) -> f64 {
        let (here, there) = (self.scar(), fine.scar());
        let both = here.into_iter().chain(there);
        let Some((from, to)) = both.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))) else {
            return 0.0;
        };
        let difference = |i: usize| {
            let r = from + (to - from) * i as f64 / (RADII - 1) as f64;
            let here = worn::interpolate(&self.grid, &self.wear, r);
            let there = worn::interpolate(&fine.grid, &fine.wear, r);
            here - there
        };
        rms(&(0..RADII).map(difference).collect::<Vec<_>>())
    }
}

/// Returns a difference relative to a size; 0 if there is no difference.
fn relative(difference: f64, size: f64) -> f64 {
    match difference.abs() {
        0.0 => 0.0,
        difference => difference / size.abs(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(value: f64) -> Difference {
        Difference([value; Quantity::COUNT])
    }

    #[test]
    fn differences_tell_errors_of_the_usual_order_and_no_coincidence() {
        // e(h) = hᵖ: with a ratio of 2 an error of 1 of the finer level gives a difference of 2ᵖ − 1.
        let difference = all(2f64.powf(ORDER) - 1.0);
        assert!((difference.error_at(2.0).promised() - 1.0).abs() < 1e-12);
        // The coarser one errs by the difference and the finer one's error.
        let coarser = all(2f64.powf(ORDER));
        assert!((difference.error_at(0.5).promised() / coarser.promised() - 1.0).abs() < 1e-12);
        assert_eq!(difference.error_above(&all(3.0), 2.0).promised(), 1.0);
        // If two levels agree, a quarter of the coarser one's error remains.
        assert_eq!(all(0.0).error_above(&all(1.0), 2.0).promised(), 0.25);
    }
}
