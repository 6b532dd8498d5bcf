//! Motions that are no sines: where only the turning points count, they wear as a sine does.

use crate::common::{again, load, near, ran, volume};
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
        for integrator in ["direct", "cycle-jump"] {
            let integrator = format!("numerics.integrator={integrator}");
            let with =
                |waveform: &[&str]| worn(&[&[&*amplitude, &integrator], waveform].concat(), 10.0);
            let sine = with(&[]);
            let held = [
                "motion.tangential.waveform=trapezoid",
                "motion.tangential.hold=0.3",
            ];
            for waveform in [&["motion.tangential.waveform=triangle"][..], &held] {
                for (found, expected) in with(waveform).into_iter().zip(sine) {
                    let case = format!("{amplitude} {integrator} {waveform:?}");
                    near(case, found, expected, bound);
                }
            }
        }
    }
}

/// Where the depth swings as well, the path between the turning points does count.
#[test]
fn with_a_depth_that_swings_a_triangle_is_another_motion() {
    let [sine, triangle] = ["sine", "triangle"].map(|waveform| {
        let waveform = format!("motion.tangential.waveform={waveform}");
        let swings = [
            "motion.normal.amplitude=1e-7",
            "motion.tangential.phase=0.785",
        ];
        worn(&[swings[0], swings[1], &waveform], 3.0)[0]
    });
    assert!((triangle / sine - 1.0).abs() > 0.01, "{sine} {triangle}");
}

#[test]
fn a_table_of_a_triangle_is_the_triangle() {
    let dir = TestDir::new();
    dir.write(
        "motion.csv",
        b"time_s,u_um\n0,0\n0.5,0.08\n1.5,-0.08\n2,0\n",
    );
    // No amplitude: the table has one, in partial slip, where rounding is not amplified at the edge of the scar.
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
    assert!((motion.amplitude() / 8e-8 - 1.0).abs() < 1e-12 && motion.mean().abs() < 1e-20);
    assert!((scenario.setup().drive.period() - 2.0).abs() < 1e-12);
    assert_eq!(again(&scenario).setup(), scenario.setup());
    let tabled = volume(&ran(scenario, 5.0));
    let amplitude = "motion.tangential.amplitude=8e-8";
    let sets = [amplitude, "motion.tangential.waveform=triangle"];
    let [triangle, _] = worn(&sets, 5.0);
    near("tabled", tabled, triangle, 1e-9);
}
