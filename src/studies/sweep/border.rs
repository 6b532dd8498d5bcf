//! Where the running condition changes, in closed form: the borders of a running-condition map.
//!
//! # Formulas
//!
//! - **Gross slip** begins where no spring sticks through the whole cycle. If both displacements are
//!   prescribed, Melan's theorem gives the depth g(c) at the border of the permanent stick zone, and
//!   gross slip begins where it reaches 0. At a held depth d this is U = d/κ, κ = G*/(μE*), for
//!   any shape. If a normal force is prescribed, d is the depth at the smallest force on the unworn
//!   shape. A rig of compliance C takes part of the motion: under a steady load N, U = d/κ + μNC.
//! - In a line contact, forces move the springs: Melan's theorem holds for them, and gives Q = μP for a held load. A
//!   displacement has its border against the gauge length, see [`Unworn`].
//! - **Lift-off** begins where the depth, or the normal force, passes through 0.
//!
//! Both hold for the unworn shape. If a force is prescribed, wear moves the border of gross slip.

use super::Study;
use crate::math::root;
use crate::scenario::Scenario;
use crate::simulation::Unworn;
use crate::simulation::drive::Control;

/// Distance of a scenario from a border: negative beyond it, `None` without a closed form.
pub type Distance = fn(&Scenario) -> Option<f64>;

/// Returns the [distance](Distance), m or N, from the border between a contact that stays closed and one that opens.
pub fn to_lift_off(scenario: &Scenario) -> Option<f64> {
    Some(scenario.setup().drive.normal().oscillation().lowest())
}

/// Returns the [distance](Distance), m, from the border between partial and gross slip.
pub fn to_gross_slip(scenario: &Scenario) -> Option<f64> {
    let setup = scenario.setup();
    let drive = &setup.drive;
    if let Some(depth) = drive.shakedown_depth(setup.material.stick_ratio()) {
        return Some(depth);
    }
    let shift = drive.tangential()?.displacement()?;
    let normal = drive.normal().oscillation();
    // A varying load on a rig, or on a line that is moved, has no closed form.
    if (setup.geometry.is_line() || drive.has_rig()) && normal.amplitude() != 0.0 {
        return None;
    }
    let unworn = Unworn::new(setup);
    let depth = match drive.normal() {
        Control::Force(_) => unworn.depth(normal.lowest().max(0.0)),
        Control::Displacement(_) => normal.lowest(),
    };
    Some(unworn.gross_slip_amplitude(depth) - shift.amplitude())
}

/// Returns the value of axis `along` at which a border is crossed, with the other axes at `places`; `None` if the
/// border is not crossed between the ends of the axis, or if the axis holds no numbers.
pub fn crossing(to_border: Distance, study: &Study, places: &[usize], along: usize) -> Option<f64> {
    let axis = &study.axes[along];
    let ends = [axis.number(0)?, axis.number(axis.count() - 1)?];
    let distance = |value: f64| {
        let scenario = study.scenario_at(places, Some((along, value))).ok()?;
        to_border(&scenario)
    };
    let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
    let (at_low, at_high) = (distance(low)?, distance(high)?);
    if at_low * at_high > 0.0 {
        return None;
    }
    // Values that do not form a valid scenario count as beyond the border.
    let sign = |value| distance(value).unwrap_or(at_high);
    root::bracketed(sign, low, high, 1e-9 * (high - low))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::indenter::Indenter;
    use crate::contact::material::Material;
    use crate::simulation::Setup;

    #[test]
    fn the_depth_under_a_force_is_that_of_the_closed_forms() {
        let material = Material::new(2e11, 0.3, 0.1).expect("a material");
        let scenario = Scenario::load("li2019-fig3", &[]).expect("a scenario");
        let setup = scenario.setup();
        for (indenter, depth_per_force) in [
            // F = 2n/(n+1) E* d a.
            (Indenter::paraboloid(0.01).expect("a shape"), 4.0 / 3.0),
            (Indenter::cone(0.02).expect("a shape"), 1.0),
            (Indenter::power(3e5, 4.0).expect("a shape"), 8.0 / 5.0),
        ] {
            let radius = 1.3e-4;
            let depth = indenter.profile_1d(radius);
            let force = depth_per_force * 2e11 * depth * radius;
            let setup = Setup {
                indenter: indenter.clone(),
                material,
                ..setup.clone()
            };
            let found = Unworn::new(&setup).depth(force);
            assert!(
                (found / depth - 1.0).abs() < 1e-6,
                "{indenter:?}: {found:e} {depth:e}"
            );
            let back = Unworn::new(&setup).force(depth);
            assert!(
                (back / force - 1.0).abs() < 1e-6,
                "{indenter:?}: {back:e} {force:e}"
            );
        }
    }

    /// U = d/κ + μNC, with d held or N held.
    #[test]
    fn a_rig_moves_the_border_of_gross_slip_by_its_share() {
        let (depth, load) = (1e-6, 4.0 / 3.0 * 2.3077e11 * 1e-6 * 1e-4);
        let stiff = depth * 0.1 * 1.7 / 1.4;
        let scenario = |sets: &[String]| Scenario::load("li2019-fig3", sets).expect("a scenario");
        let set = |key: &str, value: f64| format!("{key}={value:e}");
        for share in [0.0, 1.0, 3.0] {
            let mut sets = vec![
                set("motion.normal.amplitude", 0.0),
                set("motion.tangential.amplitude", stiff * (1.0 + share)),
            ];
            if share > 0.0 {
                let stiffness = 0.1 * load / (share * stiff);
                sets.push(set("motion.tangential.rig_stiffness", stiffness));
            }
            let held = scenario(&sets);
            sets.push("motion.normal.control=force".to_owned());
            sets.push(set("motion.normal.mean", load));
            for scenario in [held, scenario(&sets)] {
                let distance = to_gross_slip(&scenario).expect("a closed form");
                assert!(distance.abs() < 1e-5 * depth, "{share}: {distance:e}");
            }
        }
        // Under a varying load there is no closed form.
        let swinging = scenario(&[set("motion.tangential.rig_stiffness", 1e7)]);
        assert_eq!(to_gross_slip(&swinging), None);
    }
}
