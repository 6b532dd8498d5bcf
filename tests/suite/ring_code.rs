//! Worn gross slip against a code that shares nothing with the program: rings of even pressure on a half-space, without
//! the Method of Dimensionality Reduction, implicit in time.
//!
//! An even pressure p on a disc of radius a lowers the surface by 4pa/(πE*) E(r²/a²) inside and
//! 4pr/(πE*) [E(a²/r²) − (1 − a²/r²) K(a²/r²)] outside (K. L. Johnson, Contact mechanics, 3.4); a ring is the difference of
//! two discs. In contact f₀ + δ + w = d, elsewhere p = 0; under a held force each cycle wears 4kμp (U − μE*/G* w).

use std::f64::consts::{FRAC_PI_2, PI};

use mdr_tui::reading::Curves;
use mdr_tui::scenario::Scenario;

use crate::common::{begin, largest, near};

const GROSS: &str = r#"
title = "Ball on flat, gross slip"
indenter = { shape = "paraboloid", radius = "6.35 mm" }
material = { effective_modulus = "115 GPa", poisson = 0.3 }
friction = { coefficient = 0.6 }
motion.normal = { control = "force", mean = "20 N" }
motion.tangential = { amplitude = "10 um", frequency = "20 Hz" }
wear = { coefficient = 5e-14 }
numerics = { points = 100, steps_per_cycle = 24, integrator = "cycle-jump" }
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

/// Solves linear equations, the right side in the last column, by Gauss with the largest pivots.
fn solution(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for k in 0..n {
        let size = |i: &usize| rows[*i][k].abs();
        let pivot = (k..n).max_by(|a, b| size(a).total_cmp(&size(b)));
        rows.swap(k, pivot.unwrap_or(k));
        let (above, below) = rows.split_at_mut(k + 1);
        for row in below {
            let factor = row[k] / above[k][k];
            let pairs = row[k..].iter_mut().zip(&above[k][k..]);
            pairs.for_each(|(value, above)| *value -= factor * above);
        }
    }
    let mut found = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| rows[k][j] * found[j]).sum();
        found[k] = (rows[k][n] - known) / rows[k][k];
    }
    found
}

/// Radii, pressures and worn depths of the rings, and the worn volume.
struct Rings {
    radii: Vec<f64>,
    pressure: Vec<f64>,
    depth: Vec<f64>,
    volume: f64,
}

fn rings(count: usize, domain: f64, cycles: f64, steps: i32) -> Rings {
    let edges: Vec<f64> = (0..=count)
        .map(|i| domain * i as f64 / count as f64)
        .collect();
    let pairs = || edges.windows(2).map(|e| [e[0], e[1]]);
    let radii: Vec<f64> = pairs()
        .map(|[a, b]| (0.5 * (a * a + b * b)).sqrt())
        .collect();
    let areas: Vec<f64> = pairs().map(|[a, b]| PI * (b * b - a * a)).collect();
    let lowers = |r: f64, [a, b]: [f64; 2]| disc(r, b) - if a > 0.0 { disc(r, a) } else { 0.0 };
    let lowered: Vec<Vec<f64>> = radii
        .iter()
        .map(|&r| pairs().map(|e| lowers(r, e)).collect())
        .collect();
    let softness = FRICTION * 0.5 * (2.0 - 0.3) / (1.0 - 0.3);
    let (mut depth, mut pressure) = (vec![0.0; count], vec![0.0; count]);
    let mut sunk = vec![0.0; count];
    let hertz = (0.75 * FORCE * RADIUS / MODULUS).cbrt();
    let mut touching: Vec<bool> = radii.iter().map(|&r| r < 1.2 * hertz).collect();
    let mut before = 0.0;
    for step in 0..steps {
        let now = cycles.powf(f64::from(step) / f64::from(steps - 1));
        let gap = |i: usize| radii[i].powi(2) / (2.0 * RADIUS) + depth[i];
        let mut wears = vec![0.0; count];
        for _ in 0..40 {
            for (wears, sunk) in wears.iter_mut().zip(&sunk) {
                let slip: f64 = AMPLITUDE - softness * sunk;
                *wears = 4.0 * WEAR * FRICTION * slip.max(0.0) * (now - before);
            }
            // Unknown are the pressures and the depth; the last row is the force.
            let active: Vec<usize> = (0..count).filter(|&i| touching[i]).collect();
            let mut rows: Vec<Vec<f64>> = Vec::new();
            for &i in &active {
                let mut row: Vec<f64> = active.iter().map(|&j| lowered[i][j]).collect();
                row[rows.len()] += wears[i];
                row.extend([-1.0, -gap(i)]);
                rows.push(row);
            }
            let force = active.iter().map(|&j| areas[j]);
            rows.push(force.chain([0.0, FORCE]).collect());
            let solved = solution(rows);
            let depth_of_indenter = solved[active.len()];
            pressure.fill(0.0);
            active
                .iter()
                .zip(&solved)
                .for_each(|(&i, &p)| pressure[i] = p);
            let sum =
                |row: &Vec<f64>| -> f64 { row.iter().zip(&pressure).map(|(a, p)| a * p).sum() };
            let next: Vec<f64> = lowered.iter().map(sum).collect();
            let change = largest(
                next.iter()
                    .zip(&sunk)
                    .map(|(a, b): (&f64, &f64)| (a - b).abs()),
            );
            sunk = next;
            let touches = |i: usize| match touching[i] {
                true => pressure[i] >= 0.0,
                false => gap(i) + sunk[i] < depth_of_indenter,
            };
            let found: Vec<bool> = (0..count).map(touches).collect();
            let is_settled = found == touching && change < 1e-9 * depth_of_indenter;
            touching = found;
            if is_settled {
                break;
            }
        }
        let worn = wears.iter().zip(&pressure).map(|(wears, p)| wears * p);
        depth
            .iter_mut()
            .zip(worn)
            .for_each(|(depth, worn)| *depth += worn);
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
        let truth = rings(60, domain, cycles, 800);
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
        for share in [0.0, 0.2, 0.4, 0.6, 0.8, 0.9] {
            let case = format!("{share} of the radius after {cycles} cycles");
            let r = share * a;
            let [p, due] = [
                (seen.radii(), seen.pressure()),
                (&truth.radii[..], &truth.pressure),
            ]
            .map(|(radii, p)| between(radii, p, r) / mean);
            // Towards the edge it counts where the last ring of the code ends.
            let bound = if share < 0.7 { 1e-2 } else { 2e-2 };
            near(format!("p at {case}"), p, due, bound);
            let [worn, due] = [
                (seen.radii(), seen.wear()),
                (&truth.radii[..], &truth.depth),
            ]
            .map(|(radii, depth)| between(radii, depth, r));
            near(format!("depth at {case}"), worn, due, 1e-2);
        }
        let top = largest(seen.pressure().iter().copied()) / mean;
        near(
            format!("largest p after {cycles} cycles"),
            top,
            highest,
            5e-3,
        );
        assert_eq!(top, seen.pressure()[0] / mean, "it is at the centre");
        let force = simulation.force_residual(seen.pressure()).expect("a load");
        assert!(force.abs() < 1e-2, "∫p dA: {force:e}");
        let balance = moment.energy_residual.expect("wear");
        assert!(balance.abs() < 5e-3, "V = k E_d: {balance:e}");
    }
}
