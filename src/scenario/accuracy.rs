//! What accuracy costs: the N, the steps a cycle and the tolerance of jumps that the default method needs for
//! an error, and the error to expect of them. Known beforehand, so that nothing is searched when a run begins.
//!
//! The error is the rms error of the worn profile at the end, in largest depths. It has three sources, each with
//! a law of its own, measured by `mdr-tui trade` on twenty scenes (the README names some):
//!
//! ```text
//! cells   E = 8.8e-4 c f (R'/R · 50/N)^1.55      f = (M/3.7)^0.7 ≤ 1.1
//!         E = 8.8e-3 f 50/N                      a punch, whose pressure is infinite at its rim
//! steps   E = 2.2e-4 t g (12/steps)²             g = (M/1.6)^0.8 ≤ 1, times M/2.2 where that is above 1
//! jumps   E ≤ tolerance, and the less the smaller M is
//! ```
//!
//! - **M = 4kμE*Uz/R**, the wear number: what rubbing by all of the shift ±U wears in z cycles under the
//!   stress μE*d/R, in depths d. R is the radius that touches at the largest depth, R' that of the domain.
//!   A profile that is hardly worn hardly errs; one that is worn through wants more steps, as little pressure
//!   is left to be right about. The wear coefficient and the number of cycles matter by their product alone.
//! - **c**: 4.5 for a tip sharper than a paraboloid, 1.5 for a truncated cone; 2 where a force is prescribed,
//!   0.8 where the depth is held.
//! - **t**: (11 Δd/d)², at least 0.5, with Δd the amplitude of the depth; where it is 0, each spring moves one
//!   way from turn to turn, and M/2.2 is left out. 20 where a force is prescribed: steps do not meet the turns.
//!
//! Whether cycles are jumped is decided on the way: a jump that costs more than it saves is not made, and trying
//! costs 7 %. Only motions that never repeat are known before to be stepped.

use super::{RunPlan, derive};
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::simulation::Integrator;
use crate::simulation::drive::{Control, Drive};
use crate::wear::WearLaw;

/// The accuracies that keys step through, the coarsest first; those in between can be asked for as well.
pub const RUNGS: [f64; 9] = [0.1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5];

/// The parts of an accuracy that cells, steps and jumps may take up.
const SHARES: (f64, f64, f64) = (0.93, 0.75, 0.7);

/// The fewest cells and steps that are any good, and the most that are chosen.
const POINTS: (f64, f64) = (12.0, 20_000.0);
const STEPS: (f64, f64) = (8.0, 2_000.0);

/// The order of the error in N, but for flat punches.
const ORDER: f64 = 1.55;

/// Cycles of a run without an end.
const WITHOUT_END: f64 = 1000.0;

/// The length of a run that an accuracy chooses by, in cycles.
pub(super) fn planned(run: &RunPlan) -> f64 {
    run.planned.or(run.cycles).unwrap_or(WITHOUT_END)
}

/// What is chosen for an accuracy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Choices {
    /// N.
    pub points: i64,
    /// Steps a cycle.
    pub steps: i64,
    /// Whether cycles may be jumped.
    pub jumps: bool,
    /// The tolerance of jumps.
    pub tolerance: f64,
}

impl Choices {
    /// The name of the integrator.
    pub fn integrator(&self) -> &'static str {
        Integrator::NAMES[usize::from(self.jumps)]
    }
}

/// What is known of a scene before it runs, as far as its errors depend on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scene {
    /// The error of 50 cells, and the order in N.
    cells: (f64, f64),
    /// The error of 12 steps a cycle, and the fewest that are any good.
    steps: (f64, f64),
    /// Steps a cycle that a cell needs at the least.
    steps_a_cell: f64,
    /// Tolerance of jumps over their error.
    tolerance: f64,
    /// Whether the motion repeats.
    repeats: bool,
}

impl Scene {
    /// One that nothing is known of.
    pub const ANY: Self = Self {
        cells: (8.8e-4, ORDER),
        steps: (2.2e-4, STEPS.0),
        steps_a_cell: 0.0,
        tolerance: 1.0,
        repeats: true,
    };

    /// The scene of these parts, on a domain of this radius (m), for a run of so many cycles.
    pub fn of(
        indenter: &Indenter,
        material: &Material,
        drive: &Drive,
        wear: Option<&WearLaw>,
        domain: Option<f64>,
        cycles: f64,
    ) -> Self {
        let touching = derive::touching_radius(indenter, material, drive.normal());
        let worn = wear_number(touching, material, drive, wear, cycles);
        // Cells beyond what touches are there for a contact that grows.
        let room = domain.zip(touching).map_or(1.0, |(all, part)| all / part);
        let (by_shape, order) = match indenter {
            _ if indenter.rim().is_some() => (10.0, 1.0),
            Indenter::Cone { .. } => (4.5, ORDER),
            Indenter::Power { exponent, .. } if *exponent < 2.0 => (4.5, ORDER),
            Indenter::TruncatedCone { .. } => (1.5, ORDER),
            _ => (1.0, ORDER),
        };
        let is_force = |control: &Control| matches!(control, Control::Force(_));
        let by_force = is_force(drive.normal()) || drive.tangential().is_some_and(is_force);
        let normal = drive.normal().oscillation();
        let is_held = normal.amplitude() == 0.0;
        let cells = match (by_force, is_held) {
            (true, _) => 2.0,
            (false, true) => 0.8,
            (false, false) => 1.0,
        };
        let swing = normal.amplitude() / normal.highest();
        let (steps, fewest) = match by_force {
            true => (20.0, 12.0),
            false if normal.lowest() <= 0.0 => ((11.0 * swing).powi(2), 12.0),
            false => ((11.0 * swing).powi(2).max(0.5), STEPS.0),
        };
        let of_cells = (worn / 3.7).powf(0.7).min(1.1) * room.powf(order);
        let late = if is_held { 1.0 } else { worn / 2.2 };
        let of_steps = (worn / 1.6).powf(0.8).min(1.0) * late.clamp(1.0, 30.0);
        Self {
            cells: (8.8e-4 * by_shape * cells * of_cells, order),
            steps: (2.2e-4 * steps * of_steps, fewest),
            steps_a_cell: indenter.rim().map_or(0.0, |_| 1.0 / 12.0),
            tolerance: (1.6 / worn).clamp(1.0, 5.0).floor(),
            repeats: drive.repeats_after().is_some() && wear.is_some(),
        }
    }

    /// What a worn profile whose error is at most `accuracy` needs.
    pub fn choices(&self, accuracy: f64) -> Choices {
        let ((by_cells, order), (by_steps, fewest)) = (self.cells, self.steps);
        let points = 50.0 * (by_cells / (SHARES.0 * accuracy)).powf(1.0 / order);
        let points = points.clamp(POINTS.0, POINTS.1).ceil();
        let steps = 12.0 * (by_steps / (SHARES.1 * accuracy)).sqrt();
        let steps = steps.max(self.steps_a_cell * points);
        Choices {
            points: points as i64,
            steps: steps.clamp(fewest, STEPS.1).ceil() as i64,
            jumps: self.repeats,
            // No more digits than anybody would write.
            tolerance: (1e6 * SHARES.2 * self.tolerance * accuracy)
                .round()
                .min(1e5)
                / 1e6,
        }
    }

    /// The error to expect of so many cells and steps, and of jumps with a tolerance, where cycles are jumped:
    /// the accuracy that asks for the worst of them.
    pub fn expected(&self, points: usize, steps: u32, tolerance: Option<f64>) -> f64 {
        let ((by_cells, order), (by_steps, _)) = (self.cells, self.steps);
        let of_cells = by_cells * (50.0 / points as f64).powf(order) / SHARES.0;
        let of_steps = by_steps * (12.0 / f64::from(steps)).powi(2) / SHARES.1;
        let of_jumps = tolerance.unwrap_or_default() / (SHARES.2 * self.tolerance);
        of_cells.max(of_steps).max(of_jumps)
    }
}

/// M = 4kμE*Uz/R; infinite where no unworn contact carries the load.
fn wear_number(
    touching: Option<f64>,
    material: &Material,
    drive: &Drive,
    wear: Option<&WearLaw>,
    cycles: f64,
) -> f64 {
    let Some(radius) = touching else {
        return f64::INFINITY;
    };
    let shift = match drive.tangential() {
        None => 0.0,
        Some(Control::Displacement(shift)) => shift.amplitude(),
        // Twice what a contact that sticks gives way by.
        Some(Control::Force(force)) => force.amplitude() / (material.tangential_modulus() * radius),
    };
    let wear = wear.map_or(0.0, WearLaw::coefficient);
    let stiffness = material.friction() * material.normal_modulus();
    4.0 * wear * stiffness * shift / radius * cycles
}

/// The rung `places` further on, to finer ones if positive, from the one nearest to `accuracy`; the last one
/// at the end of the ladder.
pub fn rung(accuracy: f64, places: isize) -> f64 {
    let distance = |rung: f64| (rung / accuracy).ln().abs();
    let nearest = (0..RUNGS.len())
        .min_by(|&a, &b| distance(RUNGS[a]).total_cmp(&distance(RUNGS[b])))
        .unwrap_or(0);
    let at = nearest as isize + places;
    RUNGS[at.clamp(0, RUNGS.len() as isize - 1) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    fn scene(name: &str, sets: &[&str]) -> Scene {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        Scenario::load(name, &sets).expect("a scenario").scene
    }

    fn sizes(scene: &Scene, accuracy: f64) -> (i64, i64) {
        let chosen = scene.choices(accuracy);
        (chosen.points, chosen.steps)
    }

    #[test]
    fn finer_is_dearer_and_expected_to_be_finer() {
        for name in [
            "li2019-fig3",
            "cone",
            "gross-slip",
            "separation",
            "flat-punch",
        ] {
            let scene = scene(name, &[]);
            for pair in RUNGS.windows(2) {
                let (coarse, fine) = (scene.choices(pair[0]), scene.choices(pair[1]));
                assert!(
                    coarse.points <= fine.points && coarse.steps <= fine.steps,
                    "{pair:?}"
                );
                assert!(
                    coarse.tolerance > fine.tolerance || fine.tolerance == 0.1,
                    "{pair:?}"
                );
            }
            for accuracy in [1e-3, 1e-4] {
                let chosen = scene.choices(accuracy);
                let (points, steps) = (chosen.points as usize, chosen.steps as u32);
                let expected = scene.expected(points, steps, Some(chosen.tolerance));
                assert!(
                    expected <= accuracy * (1.0 + 1e-12) && expected > 0.9 * accuracy,
                    "{name}: {expected}"
                );
            }
        }
    }

    /// What the laws were made from: the sizes that were seen to be enough, by scene.
    #[test]
    fn what_is_known_of_a_scene_chooses() {
        let figure = scene("li2019-fig3", &[]);
        assert_eq!(sizes(&figure, 1e-2), (12, 8));
        assert_eq!(sizes(&figure, 1e-3), (34, 8));
        assert_eq!(sizes(&figure, 1e-4), (147, 21));
        // Ten times the wear in a tenth of the cycles is the same; less of it is easier.
        let harsher = ["wear.coefficient=1.3e-9", "run.cycles=19.924"];
        assert_eq!(sizes(&scene("li2019-fig3", &harsher), 1e-4), (147, 21));
        let shorter = scene("li2019-fig3", &["run.cycles=20"]);
        assert!(sizes(&shorter, 1e-4) < (60, 10));
        assert!(shorter.choices(1e-4).tolerance > figure.choices(1e-4).tolerance);
        // A tip, a rim, a force and lost contact are harder.
        assert!(sizes(&scene("cone", &[]), 1e-3).0 > 80);
        assert!(sizes(&scene("flat-punch", &[]), 1e-3).0 > 180);
        assert!(sizes(&scene("gross-slip", &[]), 1e-3).0 > 40);
        assert!(sizes(&scene("separation", &[]), 1e-3).1 > 16);
        // What never repeats cannot be jumped.
        let never = ["motion.normal.angular_frequency=141.4213562373095"];
        assert!(figure.choices(1e-3).jumps);
        assert!(!scene("li2019-fig3", &never).choices(1e-3).jumps);
    }

    #[test]
    fn the_ladder_ends() {
        assert_eq!(rung(1.9e-4, 0), 3e-4);
        assert_eq!(rung(1e-3, 1), 3e-4);
        assert_eq!(rung(1e-3, -2), 1e-2);
        assert_eq!(rung(0.1, -1), 0.1);
        assert_eq!(rung(1e-5, 1), 1e-5);
    }
}
