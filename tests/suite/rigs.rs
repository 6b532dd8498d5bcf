//! A rig that yields, and load blocks, against closed forms.

use std::f64::consts::FRAC_2_PI;

use crate::closed_forms::partial_slip::stiffness_ratio;
use mdr_tui::contact::indenter::Indenter;
use mdr_tui::reading::{CheckSubject, CycleFigures, Log, Regime};
use mdr_tui::simulation::{Setup, Simulation};

use crate::common::{
    Scene, again, cattaneo, energy, load, near, ours, ran, text_of, try_load, volume,
};
use crate::test_dir::TestDir;

/// E* = d = a₀ = 1, μ = 0.1, ν = 0.3: a contact moved by ±`amplitude` through a rig of this compliance.
fn on_rig(indenter: Indenter, amplitude: f64, compliance: f64) -> Setup {
    let scene = Scene::default().indenter(indenter).cells(200).steps(200);
    let mut setup = ours(scene.domain(1.2).shaken(amplitude));
    if compliance > 0.0 {
        let drive = setup.drive.with_rig(compliance.recip());
        setup.drive = drive.expect("a rig");
    }
    setup
}

/// Two cycles, and the figures of the second.
fn after_two_cycles(setup: Setup) -> (Simulation, CycleFigures) {
    let mut simulation = Simulation::new(setup).expect("a contact");
    let mut log = Log::new(&simulation);
    log.advance(&mut simulation, 2.0).expect("two cycles");
    let figures = log.cycle_figures(&simulation).expect("figures");
    (simulation, figures)
}

fn close(what: &str, found: f64, expected: f64, bound: f64) {
    let error = (found - expected).abs();
    eprintln!("{what}: {found:.5} {expected:.5} ({error:.1e})");
    assert!(error <= bound, "{what}: {found} instead of {expected}");
}

/// A = (m − 1)/(m + 1)/(1 + ρ), D = (2^(1−1/m) − 1)/(1 + ρ), B = A/D for a tip ∝ rⁿ, m = 1 + 1/n, at the
/// border of gross slip; ρ = μNC/u_t. B is free of the rig.
#[test]
fn ratios_at_the_border_of_gross_slip_on_rigs() {
    // g(1) = d = 1: κₙA = 1.
    let shapes = [
        ("cone", 1.0, Indenter::cone(FRAC_2_PI.atan())),
        ("sphere", 2.0, Indenter::paraboloid(1.0)),
        ("quartic", 4.0, Indenter::power(0.375, 4.0)),
    ];
    let (mu, border) = (0.1, 0.1 / stiffness_ratio(0.3));
    for (name, n, shape) in shapes {
        let shape = shape.expect("a shape");
        let load = 2.0 * n / (n + 1.0);
        let m: f64 = 1.0 + 1.0 / n;
        for rho in [0.0, 1.0, 3.0] {
            let compliance = rho * border / (mu * load);
            let setup = on_rig(shape.clone(), border * (1.0 + rho), compliance);
            let (_, figures) = after_two_cycles(setup);
            let a = (m - 1.0) / (m + 1.0) / (1.0 + rho);
            let d = (2f64.powf(1.0 - 1.0 / m) - 1.0) / (1.0 + rho);
            let found = |value: Option<f64>| value.expect("a ratio");
            let what = |ratio: &str| format!("{name}, rho = {rho}: {ratio}");
            close(&what("A"), found(figures.energy_ratio), a, 1e-3);
            close(&what("D"), found(figures.sliding_ratio), d, 1e-3);
            close(&what("B"), found(figures.energy_ratio_b), a / d, 1e-3);
            close(&what("Q*"), found(figures.force_ratio), 1.0, 1e-3);
            // A hundredth of the amplitude before and behind the border.
            let regime = |share: f64| {
                let setup = on_rig(shape.clone(), share * border * (1.0 + rho), compliance);
                after_two_cycles(setup).1.regime
            };
            let both = [Regime::Partial, Regime::Gross];
            assert_eq!([0.99, 1.01].map(regime), both, "{name} {rho}");
        }
    }
}

/// u + C F_x(u) = U by Cattaneo and Mindlin: the contact's loop, its energy, and the sensor's loop.
#[test]
fn a_compliant_rig_in_partial_slip_is_the_closed_form() {
    let border = cattaneo(0.0).gross_slip_displacement();
    for (share, compliance) in [(0.4, 0.3), (0.8, 1.0), (0.9, 3.0)] {
        let reached = cattaneo(share * border);
        let force = reached.first_loading_force(share * border);
        let amplitude = share * border + compliance * force;
        let shape = Indenter::paraboloid(1.0).expect("a shape");
        let setup = on_rig(shape, amplitude, compliance);
        let (simulation, figures) = after_two_cycles(setup);
        let what = |value: &str| format!("u = {share} of the border, C = {compliance}: {value}");
        let relative =
            |name: &str, found: f64, exact: f64| close(&what(name), found / exact, 1.0, 1e-3);
        relative("E_d", figures.energy, reached.energy_per_cycle());
        relative("Q*", figures.force_amplitude, force);
        relative("U", figures.displacement_amplitude, amplitude);
        // At the end of a cycle the actuator stands at 0 on its way up, and the contact somewhere else.
        let moment = simulation.moment();
        let sensed = moment.rig_displacement.expect("a rig");
        assert!((sensed - (moment.shift + compliance * moment.tangential_force)).abs() < 1e-15);
        let is_elsewhere = sensed.abs() < 1e-12 && moment.shift.abs() > 1e-4;
        assert!(is_elsewhere, "{sensed} {}", moment.shift);
        let stick = moment.permanent_stick_radius.expect("springs");
        relative("c", stick, reached.stick_radius());
    }
}

/// The checks compare F_x and E_d with the closed forms of what the rig leaves to the contact, in partial and in gross
/// slip.
#[test]
fn the_checks_know_what_a_rig_takes() {
    for (amplitude, stiffness) in [(2e-7, 3e7), (3.47e-7, 3.1e7), (3e-7, 1e9), (2e-6, 2e7)] {
        let sets = [
            "friction.coefficient=0.3",
            &format!("motion.tangential.amplitude={amplitude:e}"),
            &format!("motion.tangential.rig_stiffness={stiffness:e}"),
        ];
        let checks = ran(load("mindlin", &sets), 2.0).checks();
        let subjects: Vec<CheckSubject> = checks.iter().map(|check| check.subject).collect();
        assert!(
            subjects.contains(&CheckSubject::TangentialForce),
            "{subjects:?}"
        );
        for check in checks {
            assert!(
                check.error.abs() < 3e-3,
                "{amplitude:e} {stiffness:e}: {check:?}"
            );
        }
    }
}

/// Both motions turn in every cycle, and the rig says when slip begins: steps that end there leave an error of second
/// order. With the actuator's turning points in place of the contact's it was 2e-3 on 50 steps, and no order at all.
#[test]
fn steps_end_where_a_contact_on_a_rig_turns() {
    let energy = |steps: u32| {
        let sets = [
            "motion.tangential.rig_stiffness=2e7",
            "motion.tangential.amplitude=4e-7",
            "motion.normal.amplitude=3e-7",
            "numerics.points=200",
            "numerics.grid=uniform",
            &format!("numerics.steps_per_cycle={steps}"),
        ];
        energy(&ran(load("li2019-fig3", &sets), 2.0))
    };
    let exact = energy(1600);
    let errors = [25, 50, 100, 200].map(|steps| (energy(steps) / exact - 1.0).abs());
    eprintln!("{errors:?}");
    assert!(errors[2] < 3e-4, "{errors:?}");
    for pair in errors.windows(2) {
        assert!(pair[0] > 2.5 * pair[1], "{errors:?}");
    }
}

/// A contact that is lost and made again in every cycle bends its rig by next to nothing there: the run goes on, and
/// what it wears does its work. A rig that hardly yields is none.
#[test]
fn a_contact_on_a_rig_is_lost_and_made_again() {
    let run = |more: &[&str]| {
        let lifts_off = [
            "motion.normal.control=force",
            "motion.normal.mean=10",
            "motion.normal.amplitude=15",
            "motion.tangential.amplitude=2e-6",
            "friction.coefficient=0.5",
            "wear.coefficient=1e-13",
        ];
        let sets = [&lifts_off[..], more].concat();
        let session = ran(load("li2019-fig3", &sets), 3.0);
        session.simulation().moment()
    };
    let shapes: [&[&str]; 4] = [
        &[],
        &["indenter.shape=cone", "indenter.angle=0.02"],
        &["indenter.shape=flat-punch", "indenter.radius=1e-4"],
        &[
            "indenter.shape=truncated-paraboloid",
            "indenter.tip_radius=3e-5",
        ],
    ];
    for shape in shapes {
        let on_rig = run(&[shape, &["motion.tangential.rig_stiffness=1e7"]].concat());
        let by_work = on_rig.wear_volume / (1e-13 * on_rig.dissipated_energy);
        close(&format!("{shape:?}"), by_work, 1.0, 0.05);
    }
    let [stiff, none] = [&["motion.tangential.rig_stiffness=1e13"][..], &[]].map(run);
    let works = stiff.dissipated_energy / none.dissipated_energy;
    close("a stiff rig", works, 1.0, 1e-4);
}

/// The actuator's motion is shared: a rig of a tenth of the contact's stiffness leaves it a tenth.
#[test]
fn a_scenario_names_its_rig() {
    let sets = |stiffness: &str| {
        let rig = format!("motion.tangential.rig_stiffness={stiffness}");
        let rig = Some(&*rig).filter(|_| !stiffness.is_empty());
        let sets: Vec<&str> = rig.into_iter().chain(["numerics.points=50"]).collect();
        try_load("gross-slip", &sets)
    };
    let energy = |stiffness: &str| {
        let session = ran(sets(stiffness).expect("a scenario"), 2.0);
        let moment = session.simulation().moment();
        (moment.dissipated_energy, moment.rig_displacement)
    };
    let (stiff, none) = energy("");
    assert_eq!(none, None);
    let (stiffer, _) = energy("1e15");
    near("stiffer", stiffer, stiff, 1e-6);
    let (soft, sensed) = energy("1e7");
    assert!(soft < 0.1 * stiff && sensed.is_some(), "{soft} {stiff}");
}

/// μ after n cycles is what its course says, and what runs in less wears less.
#[test]
fn friction_and_wear_run_in() {
    let after = |sets: &[&str]| {
        let small = ["numerics.points=40", "numerics.steps_per_cycle=40"];
        ran(load("gross-slip", &[&small[..], sets].concat()), 6.0)
    };
    let steady = after(&[]);
    let fading = after(&["friction.settled=0.05", "friction.running_in_cycles=2"]);
    let friction = fading.simulation().setup().material.friction();
    close("μ", friction, 0.05 + 0.05 * f64::exp(-3.0), 1e-12);
    let moment = fading.simulation().moment();
    assert!(moment.tangential_force.abs() <= 1.01 * friction * moment.normal_force);
    assert!(energy(&fading) < 0.8 * energy(&steady));
    // V = k(E_d − E_th), to a step's work.
    let threshold = 0.4 * energy(&steady);
    let late = after(&[&format!("wear.threshold_energy={threshold:e}")]);
    let expected = 1.3e-10 * (energy(&late) - threshold);
    near("volume", volume(&late), expected, 0.03);
    let halved = after(&["wear.settled=6.5e-11", "wear.running_in_energy=1e-9"]);
    near("volume", volume(&halved), 6.5e-11 * energy(&halved), 0.05);
}

#[test]
fn a_course_from_a_table_and_what_contradicts_it() {
    let dir = TestDir::new();
    let mine = text_of("gross-slip").replace("coefficient = 0.1", "file = \"mu.csv\"");
    dir.write("mine.toml", mine.as_bytes());
    dir.write("mu.csv", b"cycle,coefficient\n0,0.1\n2,0.3\n");
    let path = dir.path("mine.toml").display().to_string();
    let scenario = load(&path, &["numerics.points=40"]);
    assert_eq!(again(&scenario).setup(), scenario.setup());
    let session = ran(scenario, 1.0);
    let friction = session.simulation().setup().material.friction();
    close("μ", friction, 0.2, 1e-12);
}
