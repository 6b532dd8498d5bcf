//! The quantities by which two runs of a scenario are compared: the scar, its volume, and forces
//! and pressures at the end.

use crate::math::abel::worn;
use crate::math::grid::RadialGrid;
use crate::math::quadrature::weighted;
use crate::math::scan::{largest, rms};
use crate::scenario::session::Session;
use crate::simulation::drive::Control;

/// Radii at which scars are compared.
const RADII: usize = 401;

/// p is compared up to this part of the contact radius, and this far from the stick border: at both, p
/// or its slope is singular, and what a node shows depends on where it lies.
const INSIDE: f64 = 0.95;

/// V and E_d err by at least this part of what the worn depth does.
const OF_SCAR: f64 = 0.3;

/// The order that an error is estimated by. Orders of 1.5 to 2 are usual, so that estimates are twice the true error in
/// the median. An order that is read from two differences is no better, since neighbouring levels scatter.
const ORDER: f64 = 1.1;

/// No error falls faster than with this order; what seems to is a coincidence of two runs.
const HIGHEST_ORDER: f64 = 2.0;

/// A grid sees a scar if its volume there differs by less than this part.
const SEEN: f64 = 0.5;

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    pub(super) grid: RadialGrid,
    /// Worn depth at the nodes, m, with the scar that the run began with.
    pub(super) profile: Vec<f64>,
    /// What has worn of it since, m.
    pub(super) wear: Vec<f64>,
    /// V that has worn since the run began, m³.
    pub volume: f64,
    /// E_d, J.
    pub work: f64,
    /// How far V is from k E_d, relative to it: two computations of one number.
    pub imbalance: f64,
    /// F_x at the end, N.
    pub force: f64,
    /// What F_x is compared in, N: μF_z, or what the whole contact would carry without slip if that is less.
    force_scale: f64,
    pressure: Vec<f64>,
    /// a, m.
    radius: f64,
    /// c, m.
    stick_radius: f64,
    /// d or the present depth, m: what the tolerance of jumps is measured in.
    pub depth: f64,
}

/// How far a run is from another one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Difference {
    /// Of the worn depth, rms over the scar, relative to its largest value.
    pub worn_depth: f64,
    /// Of V, relative.
    pub volume: f64,
    /// Of E_d, relative.
    pub work: f64,
    /// Of F_x, relative to μF_z, or to what the whole contact would carry without slip if that is less.
    pub force: f64,
    /// Of p away from the axis and from borders, the largest, relative to its largest value there.
    pub pressure: f64,
}

impl Difference {
    /// The larger of the two that an accuracy promises: worn depth and volume.
    pub fn promised(&self) -> f64 {
        self.worn_depth.max(self.volume)
    }

    /// All of them: of depth, volume, work, force and pressure.
    pub fn numbers(&self) -> [f64; 5] {
        [
            self.worn_depth,
            self.volume,
            self.work,
            self.force,
            self.pressure,
        ]
    }

    /// The worst of depth, volume, work and force; NaN if one of them is.
    pub fn worst(&self) -> f64 {
        let [errors @ .., _] = self.numbers();
        // In this order NaN is the largest.
        let worst = errors
            .into_iter()
            .max_by(|a, b| a.abs().total_cmp(&b.abs()));
        worst.unwrap_or(f64::NAN)
    }

    /// As an estimate. V and E_d are integrals of one scar: where two runs differ in its depth, that theirs agree is
    /// chance.
    pub(super) fn as_estimate(&self) -> Self {
        let least = OF_SCAR * self.worn_depth;
        Self {
            volume: self.volume.max(least),
            work: self.work.max(least),
            ..*self
        }
    }

    /// The error of the finer one of two levels that differ by this, the one `ratio` times finer: D/(ρᵖ − 1).
    pub(super) fn error_of_finer(&self, ratio: f64) -> Self {
        self.with(self, |d, _| d / (ratio.powf(ORDER) - 1.0))
    }

    /// The same where the coarser one has an error of `before`, of which at least 1/ρ² is left.
    pub(super) fn error_above(&self, before: &Self, ratio: f64) -> Self {
        let left = ratio.powf(-HIGHEST_ORDER);
        let error = self.error_of_finer(ratio);
        error.with(before, |error, before| error.max(before * left))
    }

    /// Combines two differences, number by number.
    pub(super) fn with(&self, other: &Self, combine: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            worn_depth: combine(self.worn_depth, other.worn_depth),
            volume: combine(self.volume, other.volume),
            work: combine(self.work, other.work),
            force: combine(self.force, other.force),
            pressure: combine(self.pressure, other.pressure),
        }
    }
}

impl Outcome {
    /// The present moment of a run.
    pub fn of(session: &Session) -> Self {
        let simulation = session.simulation();
        let (setup, moment) = (simulation.setup(), simulation.moment());
        let material = &setup.material;
        let sliding = material.friction() * moment.normal_force;
        let stiffness = setup.drive.stiffness(material, moment.contact_radius);
        let shift = setup.drive.tangential().and_then(Control::displacement);
        let sticking = shift.map_or(f64::INFINITY, |shift| stiffness * shift.amplitude());
        Self {
            grid: setup.grid.clone(),
            profile: simulation.worn_depth().to_vec(),
            wear: simulation.worn_since_start(),
            volume: moment.wear_volume - moment.initial_volume,
            work: moment.dissipated_energy,
            imbalance: moment.energy_residual.unwrap_or(0.0).abs(),
            force: moment.tangential_force,
            force_scale: sliding.min(sticking).max(moment.tangential_force.abs()),
            pressure: simulation.pressure(),
            radius: moment.contact_radius,
            stick_radius: moment.stick_radius.unwrap_or(0.0),
            depth: setup.depth_scale(moment.depth),
        }
    }

    /// The largest worn depth, m.
    pub fn scar_depth(&self) -> f64 {
        largest(&self.wear)
    }

    /// Whether the nodes of a grid see about as much of the scar as there is.
    pub(super) fn is_seen_by(&self, grid: &RadialGrid) -> bool {
        let volume =
            |grid: &RadialGrid, depth: &[f64]| weighted(&worn::volume_weights(grid), depth);
        let there = grid.nodes().iter();
        let there: Vec<f64> = there
            .map(|&r| worn::interpolate(&self.grid, &self.wear, r))
            .collect();
        let ratio = volume(grid, &there) / volume(&self.grid, &self.wear);
        (1.0 - SEEN..1.0 + SEEN).contains(&ratio)
    }

    /// Where the scar begins and ends, m, if there is one.
    fn scar(&self) -> Option<(f64, f64)> {
        let least = worn::SCAR * self.scar_depth();
        let is_worn = |&wear: &f64| wear > least;
        let first = self.wear.iter().position(is_worn)?;
        let last = self.wear.iter().rposition(is_worn)?;
        let before = first.saturating_sub(1);
        let after = (last + 1).min(self.grid.cells());
        Some((self.grid.nodes()[before], self.grid.nodes()[after]))
    }

    /// How far this run is from a finer one, in the finer one's measures.
    pub fn against(&self, fine: &Self) -> Difference {
        let relative = |difference: f64, scale: f64| match difference.abs() {
            0.0 => 0.0,
            size => size / scale.abs(),
        };
        let inside = INSIDE * self.radius.min(fine.radius);
        let stick = fine.stick_radius;
        // At the moment of lift-off one of the two may carry no force at all.
        let force_scale = fine.force_scale.max(self.force_scale);
        let away = (1.0 - INSIDE) * fine.radius;
        Difference {
            worn_depth: relative(self.worn_difference(fine), fine.scar_depth()),
            volume: relative(self.volume - fine.volume, fine.volume),
            work: relative(self.work - fine.work, fine.work),
            force: relative(self.force - fine.force, force_scale),
            pressure: relative_largest(
                (1..RADII)
                    .map(|i| inside * i as f64 / (RADII - 1) as f64)
                    .filter(|r| (r - stick).abs() > away && *r > away)
                    .map(|r| {
                        let here = self.grid.interpolate(&self.pressure, r);
                        (here, fine.grid.interpolate(&fine.pressure, r))
                    }),
            ),
        }
    }

    /// The rms difference of the worn depth over both scars, m.
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

/// The largest difference of pairs, relative to the largest of the second ones; 0 without any.
fn relative_largest(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    let pairs = pairs.map(|(here, there)| ((here - there).abs(), there.abs()));
    let (differences, sizes): (Vec<f64>, Vec<f64>) = pairs.unzip();
    match largest(&sizes) {
        0.0 => 0.0,
        scale => largest(&differences) / scale,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(value: f64) -> Difference {
        Difference::default().with(&Difference::default(), |_, _| value)
    }

    #[test]
    fn differences_tell_errors_of_the_usual_order_and_no_coincidence() {
        // e(h) = hᵖ: a ratio of 2 makes a difference of 2ᵖ − 1 for an error of 1 of the finer level.
        let difference = all(2f64.powf(ORDER) - 1.0);
        assert!((difference.error_of_finer(2.0).worst() - 1.0).abs() < 1e-12);
        assert_eq!(difference.error_above(&all(3.0), 2.0).worst(), 1.0);
        // Two levels that agree have a quarter of the error of the one below, not none.
        assert_eq!(all(0.0).error_above(&all(1.0), 2.0).worst(), 0.25);
    }
}
