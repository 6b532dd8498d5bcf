//! Worn gross slip against a code that shares nothing with the program: rings of even pressure on a half-space, without
//! the Method of Dimensionality Reduction, implicit in time.
//!
//! An even pressure p on a disc of radius a lowers the surface by 4pa/(πE*) E(r²/a²) inside and
//! 4pr/(πE*) [E(a²/r²) − (1 − a²/r²) K(a²/r²)] outside (K. L. Johnson, Contact mechanics, 3.4); a ring is the difference of
//! two discs. In contact f₀ + δ + w = d, elsewhere p = 0; under a held force each cycle wears 4kμp (U − μE*/G* w).

use std::f64::consts::{FRAC_PI_2, PI};

use mdr_tui::reading::Curves;
use mdr_tui::scenario::Scenario;
use nalgebra::{DMatrix, DVector};

use crate::common::{begin, largest, near};

const GROSS: &str = r#"
title = "Ball on flat, gross slip"
indenter = { shape = "paraboloid", radius = "6.35 mm" }
material = { effective_modulus = "115 GPa", poisson = 0.3 }
friction = { coefficient = 0.6 }
motion.normal = { control = "force", mean = "20 N" }
motion.tangential = { amplitude = "10 um", frequency = "20 Hz" }
wear = { coefficient = 5e-14 }
numerics = { points = 60, steps_per_cycle = 24, integrator = "cycle-jump" }
"#;

const FORCE: f64 = 20.0;
const RADIUS: f64 = 6.35e-3;
const MODULUS: f64 = 115e9;
const FRICTION: f64 = 0.6;
const AMPLITUDE: f64 = 10e-6;
const WEAR: f64 = 5e-14;

/// K(m) and E(m).
fn elliptic(m: f64) -> [f64; 2] {
    let (mut a, mut b, mut sum, mut weight) = (1.0, (1.0 - m).sqrt(), 0.5 * m, 1.0);
    while a - b > 1e-14 {
        let half = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        sum += weight * half * half;
        weight *= 2.0;
    }
    [FRAC_PI_2 / a, FRAC_PI_2 / a * (1.0 - sum)]
}

/// How far a unit pressure on a disc of radius `a` lowers the surface at `r`, m/Pa.
fn disc(r: f64, a: f64) -> f64 {
    let shape = if r < a {
        a * elliptic(r * r / (a * a))[1]
    } else {
        let m = a * a / (r * r);
        let [first, second] = elliptic(m);
        r * (second - (1.0 - m) * first)
    };
    4.0 / (PI * MODULUS) * shape
}

/// Radii, pressures and worn depths of the rings.
struct Rings {
    radii: Vec<f64>,
    pressure: Vec<f64>,
    depth: Vec<f64>,
    volume: f64,
}

fn rings(count: usize, domain: f64, cycles: f64, steps: usize) -> Rings {
    let edges: Vec<f64> = (0..=count)
        .map(|i| domain * i as f64 / count as f64)
        .collect();
    let squares = |i: usize| edges[i + 1].powi(2) + edges[i].powi(2);
    let radii: Vec<f64> = (0..count).map(|i| (0.5 * squares(i)).sqrt()).collect();
    let areas: Vec<f64> = edges
        .windows(2)
        .map(|e| PI * (e[1] * e[1] - e[0] * e[0]))
        .collect();
    let lowered = DMatrix::from_fn(count, count, |i, j| {
        let inner = if j == 0 {
            0.0
        } else {
            disc(radii[i], edges[j])
        };
        disc(radii[i], edges[j + 1]) - inner
    });
    let softness = FRICTION * 0.5 * (2.0 - 0.3) / (1.0 - 0.3);
    let (mut depth, mut pressure) = (vec![0.0; count], vec![0.0; count]);
    let mut sunk = DVector::<f64>::zeros(count);
    let hertz = (0.75 * FORCE * RADIUS / MODULUS).cbrt();
    let mut touching: Vec<bool> = radii.iter().map(|&r| r < 1.2 * hertz).collect();
    let mut before = 0.0;
    for step in 0..steps {
        let now = cycles.powf(step as f64 / (steps - 1) as f64);
        let mut wears = vec![0.0; count];
        for _ in 0..40 {
            for (wears, sunk) in wears.iter_mut().zip(&sunk) {
                let slip = (AMPLITUDE - softness * sunk).max(0.0);
                *wears = 4.0 * WEAR * FRICTION * slip * (now - before);
            }
            let active: Vec<usize> = (0..count).filter(|&i| touching[i]).collect();
            let n = active.len();
            let system = DMatrix::from_fn(n + 1, n + 1, |i, j| match (i == n, j == n) {
                (true, true) => 0.0,
                (true, false) => areas[active[j]],
                (false, true) => -1.0,
                (false, false) if i == j => lowered[(active[i], active[j])] + wears[active[i]],
                (false, false) => lowered[(active[i], active[j])],
            });
            let gap = |i: usize| radii[i].powi(2) / (2.0 * RADIUS) + depth[i];
            let due = DVector::from_fn(n + 1, |i, _| if i == n { FORCE } else { -gap(active[i]) });
            let solved = system.lu().solve(&due).expect("a solution");
            pressure.fill(0.0);
            active
                .iter()
                .zip(&solved)
                .for_each(|(&i, &p)| pressure[i] = p);
            let next = &lowered * DVector::from_column_slice(&pressure);
            let change = (&next - &sunk).amax();
            sunk = next;
            let mut same = change < 1e-9 * solved[n];
            for i in 0..count {
                let touches = match touching[i] {
                    true => pressure[i] >= 0.0,
                    false => gap(i) + sunk[i] < solved[n],
                };
                same &= touches == touching[i];
                touching[i] = touches;
            }
            if same {
                break;
            }
        }
        for (depth, (wears, p)) in depth.iter_mut().zip(wears.iter().zip(&pressure)) {
            *depth += wears * p;
        }
        before = now;
    }
    let volume = depth
        .iter()
        .zip(&areas)
        .map(|(depth, area)| depth * area)
        .sum();
    Rings {
        radii,
        pressure,
        depth,
        volume,
    }
}

fn between(x: &[f64], y: &[f64], at: f64) -> f64 {
    let k = x.partition_point(|&x| x < at).clamp(1, x.len() - 1);
    let share = (at - x[k - 1]) / (x[k] - x[k - 1]);
    y[k - 1] + share * (y[k] - y[k - 1])
}

/// The true pressure falls all the way to the edge, where it ends with a step: max p is at the centre, 1.013 and 1.005
/// of N/(πa²) with a⁴ = 4RV/π.
#[test]
fn worn_gross_slip_is_that_of_rings() {
    let scenario = Scenario::from_toml(GROSS, "ring code", &[]).expect("a scenario");
    let mut session = begin(scenario);
    for (cycles, domain, highest) in [(2e4, 300e-6, 1.013), (2e5, 500e-6, 1.005)] {
        let truth = rings(100, domain, cycles, 120);
        session.advance_to(cycles).expect("cycles of gross slip");
        let simulation = session.simulation();
        let (moment, seen) = (simulation.moment(), simulation.observe(Curves::all()));
        let a = (4.0 * RADIUS * truth.volume / PI).powf(0.25);
        let mean = FORCE / (PI * a * a);
        near(
            format!("V after {cycles} cycles"),
            moment.wear_volume,
            truth.volume,
            5e-3,
        );
        for share in [0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95] {
            let case = format!("{share} of the radius after {cycles} cycles");
            let r = share * a;
            let [p, due] = [
                (&seen.radii[..], &seen.pressure),
                (&truth.radii[..], &truth.pressure),
            ]
            .map(|(radii, p)| between(radii, p, r) / mean);
            near(format!("p at {case}"), p, due, 1e-2);
            let [worn, due] = [
                (&seen.radii[..], &seen.wear),
                (&truth.radii[..], &truth.depth),
            ]
            .map(|(radii, depth)| between(radii, depth, r));
            near(format!("depth at {case}"), worn, due, 1e-2);
        }
        let top = largest(seen.pressure.iter().copied()) / mean;
        near(
            format!("largest p after {cycles} cycles"),
            top,
            highest,
            5e-3,
        );
        assert_eq!(top, seen.pressure[0] / mean, "it is at the centre");
        let force = simulation.force_residual(&seen.pressure).expect("a load");
        assert!(force.abs() < 1e-2, "∫p dA: {force:e}");
        let balance = moment.energy_residual.expect("wear");
        assert!(balance.abs() < 5e-3, "V = k E_d: {balance:e}");
    }
}
