//! Closed forms that are drawn over plots, against those that tests judge by.

use crate::closed_forms::cattaneo_mindlin::CattaneoMindlin;
use crate::closed_forms::fretting_loop::Branch;
use crate::closed_forms::limiting_profile::LimitingProfile;
use crate::closed_forms::line_contact::Cylinder;
use crate::closed_forms::power_law::PowerLaw;
use mdr_tui::scenario::Scenario;
use mdr_tui::simulation::Setup;
use mdr_tui::studies::theory::Theory;

const SHARES: [f64; 8] = [0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.3];

fn load(preset: &str, sets: &[&str]) -> (Setup, Theory) {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let scenario = Scenario::load(preset, &sets).expect("a scenario");
    let setup = scenario.setup().clone();
    let theory = Theory::new(&setup);
    (setup, theory)
}

/// Holds values at radii in units of `radius` against a closed form, to 1e-9 of its largest value.
fn meets(what: &str, found: Option<Vec<f64>>, radius: f64, exact: impl Fn(f64) -> f64) {
    let found = found.unwrap_or_else(|| panic!("{what}: no closed form"));
    let exact: Vec<f64> = SHARES.iter().map(|share| exact(share * radius)).collect();
    let finite = exact.iter().copied().filter(|exact| exact.is_finite());
    let size = finite.fold(0.0, |most: f64, exact| most.max(exact.abs()));
    for ((share, found), exact) in SHARES.iter().zip(&found).zip(&exact) {
        let is_met = found == exact || (found - exact).abs() < 1e-9 * size;
        assert!(is_met, "{what} at {share}: {found:e} {exact:e}");
    }
}

fn radii(radius: f64) -> [f64; 8] {
    SHARES.map(|share| share * radius)
}

fn cylinder(setup: &Setup) -> (Cylinder, f64) {
    let length = setup.geometry.length().expect("a line");
    let exact = Cylinder {
        e_star: setup.material.normal_modulus(),
        radius: setup.indenter.ball_radius().expect("a cylinder"),
        friction: setup.material.friction(),
        load: setup.drive.normal().oscillation().highest() / length,
    };
    (exact, length)
}

#[test]
fn wear_ends_on_the_limiting_profile() {
    let (setup, theory) = load("limit-shape", &[]);
    let exact = LimitingProfile {
        e_star: setup.material.normal_modulus(),
        radius: setup.indenter.ball_radius().expect("a ball"),
        depth: setup.drive.normal().oscillation().highest(),
        stick_radius: theory.stick_radius.expect("a stick zone"),
    };
    let b = exact.outer_radius();
    meets("round", theory.limiting_profile(&radii(b)), b, |r| {
        exact.profile(r)
    });

    let (setup, theory) = load("cylinder-partial-slip", &[]);
    let (exact, _) = cylinder(&setup);
    let stick = theory.stick_radius.expect("a stick zone");
    let b = exact.scar_half_width(stick);
    let profile = |x: f64| 0.5 * x * x / exact.radius + exact.limit_depth(stick, x);
    meets("line", theory.limiting_profile(&radii(b)), b, profile);
}

/// What the traits of a law say decides: here, that nothing wears.
#[test]
fn a_law_that_never_gets_there_has_no_limiting_profile() {
    let (setup, theory) = load("limit-shape", &["wear.coefficient=0"]);
    let b = setup.grid.nodes().last().expect("a domain");
    assert_eq!(theory.limiting_profile(&radii(*b)), None);
}

#[test]
fn pressures_are_those_of_power_laws() {
    let cone = ["indenter.shape=cone", "indenter.angle=0.01"];
    let quartic = [
        "indenter.shape=power",
        "indenter.coefficient=4e7",
        "indenter.exponent=4",
    ];
    let odd = [
        "indenter.shape=power",
        "indenter.coefficient=50",
        "indenter.exponent=1.5",
    ];
    for (sets, exact) in [
        (&cone[..], PowerLaw::cone(0.01f64.tan())),
        (&quartic, PowerLaw::quartic(4e7)),
        (
            &odd,
            PowerLaw {
                coefficient: 50.0,
                exponent: 1.5,
            },
        ),
    ] {
        let (setup, theory) = load("cone", sets);
        let e_star = setup.material.normal_modulus();
        let (depth, n) = (1e-6, exact.exponent);
        let a = exact.contact_radius(depth);
        let found = theory.unworn_pressure(depth, &radii(a));
        meets("p", found, a, |r| exact.pressure(e_star, a, r));
        // u_t = μE*/G* d, d ∝ F^(n/(n+1)).
        let load = exact.force(e_star, depth);
        let found = theory.gross_slip_amplitude(load).expect("a border");
        assert!(
            (found / (theory.slip_per_depth * depth) - 1.0).abs() < 1e-6,
            "{n}: {found:e}"
        );
    }
}

/// Loading, unloading and reloading at several places of the stroke.
#[test]
fn stresses_of_partial_slip_follow_masing_on_every_branch() {
    let branches = [
        (0.1, Branch::Loading),
        (1.5, Branch::Unloading),
        (1.9, Branch::Reloading),
    ];
    let (setup, theory) = load("mindlin", &[]);
    let swing = setup.drive.tangential().expect("a motion").oscillation();
    let exact = CattaneoMindlin {
        e_star: setup.material.normal_modulus(),
        g_star: setup.material.tangential_modulus(),
        mu: setup.material.friction(),
        radius: setup.indenter.ball_radius().expect("a ball"),
        depth: setup.drive.normal().oscillation().mean(),
        amplitude: swing.amplitude(),
    };
    let a = exact.contact_radius();
    for (cycle, branch) in branches {
        for at in [-0.4, 0.3, 1.0].map(|share| share * exact.amplitude) {
            let found = theory.unworn_shear(cycle, [at, f64::NAN], &radii(a));
            meets("round", found, a, |r| exact.loop_shear(branch, at, r));
        }
    }
    let (setup, theory) = load("cylinder-partial-slip", &[]);
    let (exact, length) = cylinder(&setup);
    let amplitude = setup
        .drive
        .tangential()
        .expect("a motion")
        .oscillation()
        .amplitude();
    let a = exact.half_width();
    for (cycle, branch) in branches.into_iter().skip(1) {
        for share in [-0.4, 0.3, 1.0] {
            let force = [share * amplitude / length, amplitude / length];
            let found = theory.unworn_shear(cycle, [f64::NAN, share * amplitude], &radii(a));
            meets("line", found, a, |x| exact.loop_shear(branch, force, x));
        }
    }
}
