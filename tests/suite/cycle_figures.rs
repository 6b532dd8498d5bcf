//! The figures of a cycle against closed forms: Mindlin's force, the ratios at the border of gross
//! slip, and the running conditions of the presets.

use crate::common::{change, energy, near, ran};
use mdr_tui::reading::{CycleFigures, Regime};
use mdr_tui::scenario::Scenario;
use mdr_tui::scenario::session::Session;

/// The session of a preset with `sets` after so many cycles.
fn after(preset: &str, sets: &[String], cycles: f64) -> Session {
    let scenario = Scenario::load(preset, sets).expect("a scenario");
    ran(scenario, cycles)
}

fn figures(preset: &str, sets: &[String], cycles: f64) -> CycleFigures {
    let session = after(preset, sets, cycles);
    session.cycle_figures().expect("a whole cycle")
}

fn amplitude(value: f64) -> Vec<String> {
    vec![format!("motion.tangential.amplitude={value:e}")]
}

/// The amplitude from which the paraboloid of the preset `mindlin` slips as a whole, d/κ.
fn gross_slip(preset: &str) -> f64 {
    let scenario = Scenario::load(preset, &[]).expect("a preset");
    1e-6 / scenario.setup().material.stick_ratio()
}

fn close(seen: Option<f64>, expected: f64, tolerance: f64) {
    let seen = seen.expect("a ratio");
    assert!((seen - expected).abs() < tolerance, "{seen} {expected}");
}

/// F_x = μF_z[1 − (1 − U/U_s)^{3/2}], and 2G*aU what the contact would carry without slip.
#[test]
fn partial_slip_is_mindlins() {
    for share in [0.2, 0.5, 0.9] {
        let seen = figures("mindlin", &amplitude(share * gross_slip("mindlin")), 2.0);
        let force = 1.0 - (1.0 - share).powf(1.5);
        close(seen.force_ratio, force, 1e-3);
        close(seen.slip_ratio, 1.0 - force / (1.5 * share), 1e-3);
        // The area of the loop: (μF)²-free, by the integral of Mindlin's force over the loop.
        let steps = 20_000;
        let unloading = |u: f64| {
            let reversed = (share - u) / 2.0;
            force - 2.0 * (1.0 - (1.0 - reversed).powf(1.5))
        };
        let area: f64 = (0..steps)
            .map(|i| {
                let u = -share + 2.0 * share * (f64::from(i) + 0.5) / f64::from(steps);
                // Both branches are alike but for the sign.
                (-unloading(u) - unloading(-u)).abs() * 2.0 * share / f64::from(steps)
            })
            .sum();
        close(seen.energy_ratio, area / (4.0 * force * share), 2e-3);
    }
}

#[test]
fn the_regime_is_the_running_condition() {
    let border = gross_slip("mindlin");
    for (preset, sets, expected) in [
        ("mindlin", amplitude(0.02 * border), Regime::Stick),
        ("mindlin", amplitude(0.5 * border), Regime::Partial),
        ("mindlin", amplitude(1.05 * border), Regime::Gross),
        ("li2019-fig3", Vec::new(), Regime::Partial),
        ("gross-slip", Vec::new(), Regime::Gross),
        ("separation", Vec::new(), Regime::Open),
        ("two-frequencies", Vec::new(), Regime::Partial),
    ] {
        let seen = figures(preset, &sets, 2.0);
        assert_eq!(seen.regime, expected, "{preset} {sets:?} {seen:?}");
    }
    let hertz = after("hertz", &[], 2.0);
    assert_eq!(hertz.cycle_figures(), None);
}

#[test]
fn there_are_none_before_the_first_period_ends_and_within_that_of_a_change() {
    let mut session = after("li2019-fig3", &[], 0.5);
    assert_eq!(session.cycle_figures(), None);
    session.advance_to(2.5).expect("cycles");
    let before = session.cycle_figures().expect("figures");
    // A period that was begun under other parameters tells of neither.
    change(&mut session, "friction.coefficient", "0.2");
    session.advance_to(3.0).expect("cycles");
    assert_eq!(session.cycle_figures(), None);
    session.advance_to(4.0).expect("cycles");
    let after = session.cycle_figures().expect("figures");
    assert!(after.force_ratio < before.force_ratio);
    // Two frequencies repeat after two cycles.
    let session = self::after("two-frequencies", &[], 1.0);
    assert_eq!(session.cycle_figures(), None);
}

#[test]
fn after_a_jump_they_are_those_of_the_cycle_that_follows() {
    let mut session = after("mild-million", &[], 20_000.0);
    assert!(session.simulation().state().stats.jumps > 0);
    let jumped = session.cycle_figures().expect("figures");
    change(&mut session, "numerics.integrator", "\"direct\"");
    session.advance_to(20_001.0).expect("a cycle");
    let stepped = session.cycle_figures().expect("figures");
    let told = |of: &CycleFigures| {
        let amplitudes = [of.force_amplitude, of.displacement_amplitude];
        [amplitudes, [of.energy, of.normal_force]].concat()
    };
    for (jumped, stepped) in told(&jumped).into_iter().zip(told(&stepped)) {
        near("a figure", jumped, stepped, 1e-4);
    }
    assert_eq!(jumped.regime, stepped.regime);
}

#[test]
fn energy_per_cycle_adds_up_to_the_work_of_friction() {
    let session = after("li2019-fig3", &[], 3.0);
    let figures = session.cycle_figures().expect("figures");
    let work = energy(&session) - energy(&after("li2019-fig3", &[], 2.0));
    near("energy", figures.energy, work, 1e-12);
    let per_energy = session.simulation().moment().wear_per_energy();
    close(per_energy.map(|k| k / 1.3e-10), 1.0, 5e-3);
}

/// F_x bends in a long step: a straight line would miss its zero by 6 %, and give loops that none can have, B > 1.
#[test]
fn the_opening_of_a_loop_does_not_depend_on_the_steps() {
    for share in [0.3, 0.7, 0.95, 1.5] {
        let of_steps = |steps: u32| {
            let mut sets = amplitude(share * gross_slip("mindlin"));
            sets.push(format!("numerics.steps_per_cycle={steps}"));
            figures("mindlin", &sets, 2.0)
        };
        let (few, many) = (of_steps(12), of_steps(400));
        let [few, exact] = [few, many].map(|figures| figures.sliding_ratio.expect("a loop"));
        assert!((few / exact - 1.0).abs() < 2e-3, "{share}: {few} {exact}");
        let b = many.energy_ratio_b.expect("a loop");
        assert!(b <= 1.0, "{share}: {b}");
    }
}
