//! Fatigue parameters against closed forms and against an independent quadrature of point forces.

use std::f64::consts::PI;

use crate::closed_forms::half_space::by_point_forces;
use crate::common::{Scene, holds, ours, run_setup};
use crate::test_dir::TestDir;
use mdr_tui::charts::study::Slice;
use mdr_tui::charts::study::lines::criteria;
use mdr_tui::reading::Curves;
use mdr_tui::reading::fatigue::{Fatigue, Limits, StressCycle};
use mdr_tui::reading::subsurface::Stress;
use mdr_tui::studies::sweep::record::StudyFile;
use mdr_tui::studies::sweep::{Results, Shard};

/// p₀ of the default scene: E* = R = d = 1 and a = 1.
const P0: f64 = 2.0 / PI;
const POISSON: f64 = 0.3;
const LIMITS: Limits = Limits {
    tension: 5e8,
    shear: 3.5e8,
};

/// `stress` times mean + amplitude sin of a cycle.
fn swung(stress: Stress, mean: f64, amplitude: f64) -> Vec<Stress> {
    let at = |k: i32| mean + amplitude * (f64::from(k) / 100.0 * 2.0 * PI).sin();
    let times = |f: f64| Stress {
        xx: f * stress.xx,
        yy: f * stress.yy,
        zz: f * stress.zz,
        xz: f * stress.xz,
    };
    (0..100).map(|k| times(at(k))).collect()
}

/// A unit uniaxial stress at an angle in the plane of motion.
fn uniaxial(angle: f64) -> Stress {
    let (sin, cos) = angle.sin_cos();
    Stress {
        xx: cos * cos,
        zz: sin * sin,
        xz: sin * cos,
        yy: 0.0,
    }
}

#[test]
fn uniaxial_stress_is_its_own_amplitude() {
    let across = Stress {
        yy: 1.0,
        ..Stress::default()
    };
    let along = [0.0, 0.4, 1.234, PI / 2.0].map(uniaxial);
    for stress in along.into_iter().chain([across]) {
        let reversed = Fatigue::from_stresses(&swung(stress, 0.0, LIMITS.tension), POISSON);
        holds("SWT", (reversed.swt / LIMITS.tension - 1.0).abs(), 1e-6);
        let shear = reversed.shear_amplitude * 3.0_f64.sqrt() / LIMITS.tension;
        holds("√J₂", (shear - 1.0).abs(), 1e-6);
        // At the fatigue limit in tension Crossland's sum reaches the limit in torsion.
        let crossland = reversed.crossland(LIMITS) / LIMITS.shear;
        holds("Crossland", (crossland - 1.0).abs(), 1e-6);
        // SWT: √(σ_max σ_a).
        let pulsating = Fatigue::from_stresses(&swung(stress, 3e8, 2e8), POISSON);
        holds("mean", (pulsating.swt / 1e17_f64.sqrt() - 1.0).abs(), 1e-6);
        let pressed = Fatigue::from_stresses(&swung(stress, -3e8, 2e8), POISSON);
        assert_eq!(pressed.swt, 0.0);
    }
}

#[test]
fn pure_shear_strains_its_diagonal() {
    let shear = Stress {
        xz: 1.0,
        ..Stress::default()
    };
    let seen = Fatigue::from_stresses(&swung(shear, 0.0, LIMITS.shear), POISSON);
    let exact = LIMITS.shear * (1.0 + POISSON).sqrt();
    holds("SWT", (seen.swt / exact - 1.0).abs(), 1e-6);
    let crossland = seen.crossland(LIMITS) / LIMITS.shear;
    holds("Crossland", (crossland - 1.0).abs(), 1e-6);
    assert_eq!(seen.hydrostatic, 0.0);
}

/// A stress whose deviator has these coordinates, measured by √(½ S:S).
fn with_deviator([a, b, c]: [f64; 3], pressure: f64) -> Stress {
    let part = b / 3.0_f64.sqrt();
    Stress {
        xx: a - part - pressure,
        yy: 2.0 * part - pressure,
        zz: -a - part - pressure,
        xz: c,
    }
}

#[test]
fn the_amplitude_of_shear_is_the_radius_of_the_path() {
    let amplitude = |path: &[[f64; 3]]| {
        // Neither a constant stress nor a hydrostatic one matters.
        let stresses = path.iter().enumerate().map(|(k, [a, b, c])| {
            let shifted = [1e8 * a + 3e8, 1e8 * b - 1e8, 1e8 * c + 2e8];
            with_deviator(shifted, 1e7 * k as f64)
        });
        let stresses: Vec<Stress> = stresses.collect();
        Fatigue::from_stresses(&stresses, POISSON).shear_amplitude / 1e8
    };
    let circle = |k: usize| {
        let (sin, cos) = (2.0 * PI * k as f64 / 360.0).sin_cos();
        [0.6 * cos, sin, 0.8 * cos]
    };
    let circle: Vec<[f64; 3]> = (0..360).map(circle).collect();
    let [high, edge] = [0.75_f64.sqrt(), 1.0 / 8.0_f64.sqrt()];
    for (path, radius) in [
        (&circle[..], 1.0),
        // Straight to and fro.
        (&[[0.0; 3], [0.6, 0.0, 0.8], [0.3, 0.0, 0.4]], 0.5),
        // Equal sides: half the longest chord would be 0.5.
        (
            &[[0.0; 3], [0.0, 1.0, 0.0], [high, 0.5, 0.0]],
            3.0_f64.sqrt().recip(),
        ),
        // Blunt: the third corner lies inside the ball of the long side.
        (&[[0.0; 3], [0.0, 0.0, 1.0], [0.1, 0.0, 0.5]], 0.5),
        // Sharp, with sides 5, 5 and 6: R = abc/(4 area).
        (
            &[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]],
            150.0 / 48.0,
        ),
        // All corners of a tetrahedron, and a point inside.
        (
            &[
                [edge, edge, edge],
                [edge, -edge, -edge],
                [-edge, edge, -edge],
                [-edge, -edge, edge],
                [0.1, 0.1, 0.0],
            ],
            0.375_f64.sqrt(),
        ),
        (&[[0.0; 3]], 0.0),
    ] {
        holds("radius", (amplitude(path) - radius).abs(), 1e-9);
    }
}

/// √(E σ_n,max ε_n,a) by trying all planes, half a degree apart, and √J₂,a by an iteration.
fn by_trial(stresses: &[[f64; 4]], poisson: f64) -> [f64; 3] {
    let mut most: f64 = 0.0;
    for i in 0..360 {
        for k in 0..=90 {
            let [angle, tilt] = [i, 2 * k].map(|n| f64::from(n) * PI / 360.0);
            let (sin, cos) = angle.sin_cos();
            let [x, y, z] = [cos * tilt.cos(), tilt.sin(), sin * tilt.cos()];
            let (mut top, mut strains) = (0.0_f64, [f64::INFINITY, f64::NEG_INFINITY]);
            for [xx, yy, zz, xz] in stresses {
                let normal = x * x * xx + y * y * yy + z * z * zz + 2.0 * x * z * xz;
                let strain = (1.0 + poisson) * normal - poisson * (xx + yy + zz);
                top = top.max(normal);
                strains = [strains[0].min(strain), strains[1].max(strain)];
            }
            most = most.max(top * 0.5 * (strains[1] - strains[0]));
        }
    }
    let deviator = |[xx, yy, zz, xz]: [f64; 4]| {
        let mean = (xx + yy + zz) / 3.0;
        [xx - mean, yy - mean, zz - mean, xz, xz]
    };
    // M. Bădoiu, K. L. Clarkson (2003): ever shorter ways towards the farthest point.
    let (mut centre, mut radius) = ([0.0; 5], f64::INFINITY);
    for k in 1..20_000 {
        let away = |point: [f64; 5]| {
            let pairs = point.into_iter().zip(centre);
            let sum: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum();
            ((0.5 * sum).sqrt(), point)
        };
        let points = stresses.iter().map(|stress| away(deviator(*stress)));
        let farthest = points.max_by(|a, b| a.0.total_cmp(&b.0));
        let (distance, farthest) = farthest.expect("a path");
        radius = radius.min(distance);
        for (at, goal) in centre.iter_mut().zip(farthest) {
            *at += (goal - *at) / f64::from(k);
        }
    }
    let means = stresses.iter().map(|[xx, yy, zz, _]| (xx + yy + zz) / 3.0);
    let hydrostatic = means.fold(f64::NEG_INFINITY, f64::max);
    [most.sqrt(), radius, hydrostatic]
}

fn agree(seen: Fatigue, exact: [f64; 3]) {
    let seen = [seen.swt, seen.shear_amplitude, seen.hydrostatic];
    for (seen, exact) in seen.into_iter().zip(exact) {
        holds("parameter", (seen - exact).abs() / P0, 1e-3);
    }
}

/// A Hertz contact that rolls and slides over a point of the half-space.
#[test]
fn a_hertz_load_that_moves_over_a_point_is_that_of_the_point_forces() {
    let scene = Scene::default().friction(0.6).shaken(10.0);
    let simulation = run_setup(ours(scene), 0.25);
    let load = simulation.observe(Curves::SPRINGS).spring_load(POISSON);
    let hertz = |r: f64| P0 * (1.0 - r * r).sqrt();
    for z in [0.25, 0.5] {
        let places = (-30..=30).map(|k| f64::from(k) / 10.0);
        let seen: Vec<Stress> = places.clone().map(|x| load.stress(x, z)).collect();
        let exact = places.map(|x| by_point_forces([x, z], POISSON, hertz, |r| 0.6 * hertz(r), 40));
        let exact: Vec<[f64; 4]> = exact.collect();
        let exact = by_trial(&exact, POISSON);
        assert!(exact[0] > 0.1 * P0, "{exact:?}");
        agree(Fatigue::from_stresses(&seen, POISSON), exact);
    }
}

/// Cattaneo and Mindlin under a depth that is held: g(c) = d − κU where it turns, and half of that way back.
#[test]
fn a_cycle_of_partial_slip_is_that_of_its_closed_tractions() {
    let amplitude = 0.4;
    let scene = Scene::default().friction(0.6).shaken(amplitude);
    let cycle = StressCycle::simulate(&run_setup(ours(scene), 0.25)).expect("a cycle");
    let hertz = |b: f64, r: f64| P0 * (b * b - r * r).max(0.0).sqrt();
    let ratio = 2.0 * (1.0 - POISSON) / (2.0 - POISSON) / 0.6;
    let slip = |way: f64, r: f64| 0.6 * (hertz(1.0, r) - hertz((1.0 - ratio * way).sqrt(), r));
    for [x, z] in [[-1.05, 0.25], [-0.8, 0.4], [0.6, 0.25], [0.0, 0.5]] {
        let mut stresses = Vec::new();
        for k in 0..=12 {
            let back = f64::from(k) / 12.0 * amplitude;
            for sign in [1.0, -1.0] {
                let shear = |r: f64| sign * (slip(amplitude, r) - 2.0 * slip(back, r));
                let pressure = |r: f64| hertz(1.0, r);
                stresses.push(by_point_forces([x, z], POISSON, pressure, shear, 40));
            }
        }
        let [right, left] = cycle.mirrored(x.abs(), z);
        let seen = if x < 0.0 { left } else { right };
        agree(seen, by_trial(&stresses, POISSON));
    }
    // Cracks begin at the edge, on the surface.
    let largest = cycle.largest(|at| at.swt);
    assert!(
        (largest.x.abs() - 1.0).abs() < 0.02 && largest.z < 0.02,
        "{largest:?}"
    );
}

/// SWT hardly depends on the depth in partial slip, so its line is steep: it crosses rows, and few columns.
#[test]
fn the_fatigue_limit_is_a_line_on_the_map() {
    let dir = TestDir::new();
    let study = "base = 'mindlin'\ncolumns = ['swt_ratio']\n[set]\n'run.cycles' = 1\n\
         'friction.coefficient' = 0.7\nmaterial.fatigue_limit = '800 MPa'\n\
         [[axis]]\nkey = 'motion.normal.mean'\nlinspace = ['0.5 um', '1 um', 4]\n\
         [[axis]]\nkey = 'motion.tangential.amplitude'\nlogspace = ['0.05 um', '0.3 um', 4]\n";
    dir.write("study.toml", study.as_bytes());
    dir.line("sweep study.toml --out map.csv --quiet")
        .ends(0, "");
    let record = StudyFile::of_file(&dir.path("map.csv")).expect("a table");
    let study = record.study().expect("a study");
    let results = Results::read(study, Shard::WHOLE, &[record]);
    let (results, _) = results.expect("its rows");
    let slice = Slice::new(results, &[]).expect("two axes");
    let lines = criteria(&slice);
    let [line] = &lines[..] else {
        panic!("{lines:?}")
    };
    // Every row is crossed once, and the line has no gap.
    let depths = slice.y().expect("two axes");
    let depths: Vec<f64> = (0..4).filter_map(|place| depths.number(place)).collect();
    let rows = line.ys.iter().filter(|y| depths.contains(y));
    assert_eq!(rows.count(), 4, "{line:?}");
    assert!(line.ys.iter().all(|y| y.is_finite()), "{line:?}");
}
