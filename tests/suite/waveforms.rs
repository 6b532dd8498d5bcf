//! Motions that are no sines: where only the turning points count, they wear as a sine does.

use mdr_tui::scenario::Scenario;

use crate::common::{load, near, ran};
use crate::test_dir::TestDir;

/// V and E_d after `cycles` of a paraboloid held at a depth and shaken sideways.
fn worn(sets: &[&str], cycles: f64) -> [f64; 2] {
    let held = ["motion.normal.amplitude=0", "motion.tangential.phase=0"];
    let session = ran(load("li2019-fig3", &[&held[..], sets].concat()), cycles);
    let moment = session.simulation().moment();
    [moment.wear_volume, moment.dissipated_energy]
}

#[test]
fn triangle_and_trapezoid_wear_as_a_sine_at_constant_depth() {
    // Gross slip and partial slip; in steps, and in jumps.
    for (amplitude, bound) in [("2e-7", 2e-3), ("0.8e-7", 2e-3)] {
        let amplitude = format!("motion.tangential.amplitude={amplitude}");
        for integrator in [
            "numerics.integrator=direct",
            "numerics.integrator=cycle-jump",
        ] {
            let with = |waveform: &[&str]| {
                let mut sets = vec![amplitude.as_str(), integrator];
                sets.extend(waveform);
                worn(&sets, 10.0)
            };
            let sine = with(&[]);
            for waveform in [
                &["motion.tangential.waveform=triangle"][..],
                &[
                    "motion.tangential.waveform=trapezoid",
                    "motion.tangential.hold=0.3",
                ][..],
            ] {
                for (found, expected) in with(waveform).into_iter().zip(sine) {
                    let error = (found / expected - 1.0).abs();
                    eprintln!("{amplitude} {integrator} {waveform:?}: {error:.2e}");
                    assert!(
                        error < bound,
                        "{waveform:?} {integrator}: {found} {expected}"
                    );
                }
            }
        }
    }
}

/// Where the depth swings as well, the path between the turning points does count.
#[test]
fn with_a_depth_that_swings_a_triangle_is_another_motion() {
    let with = |waveform: &str| {
        worn(
            &[
                "motion.normal.amplitude=1e-7",
                "motion.tangential.phase=0.785",
                waveform,
            ],
            3.0,
        )[0]
    };
    let (sine, triangle) = (
        with("motion.tangential.waveform=sine"),
        with("motion.tangential.waveform=triangle"),
    );
    assert!((triangle / sine - 1.0).abs() > 0.01, "{sine} {triangle}");
}

#[test]
fn a_table_of_a_triangle_is_the_triangle() {
    let dir = TestDir::new();
    dir.write("motion.csv", b"time_s,u_um\n0,0\n0.5,0.2\n1.5,-0.2\n2,0\n");
    // No amplitude: the table has one.
    dir.write(
        "mine.toml",
        b"[indenter]\nshape = \"paraboloid\"\nradius = 0.01\n\
          [material]\neffective_modulus = 2.3077e11\npoisson = 0.3\n[friction]\ncoefficient = 0.1\n\
          [motion.normal]\nmean = 1e-6\n[motion.tangential]\nfile = \"motion.csv\"\n\
          [wear]\ncoefficient = 1.3e-10\n[numerics]\npoints = 100\n",
    );
    let scenario = load(&dir.path("mine.toml").display().to_string(), &[]);
    let motion = scenario.setup().drive.tangential().expect("a motion");
    let motion = motion.oscillation();
    assert!((motion.amplitude() / 2e-7 - 1.0).abs() < 1e-12 && motion.mean().abs() < 1e-20);
    assert!((scenario.setup().drive.period() - 2.0).abs() < 1e-12);
    let again = Scenario::from_toml(&scenario.to_toml(), "again", &[]).expect("a scenario");
    assert_eq!(again.setup(), scenario.setup());
    let tabled = ran(scenario, 5.0).simulation().moment().wear_volume;
    let sets = [
        "motion.tangential.amplitude=2e-7",
        "motion.tangential.waveform=triangle",
    ];
    let [triangle, _] = worn(&sets, 5.0);
    near("tabled", tabled, triangle, 1e-9);
}
