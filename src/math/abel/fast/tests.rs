//! Compares every operator of the fast form with the dense one, which is computed weight by weight.

use nalgebra::DMatrix;

use super::super::testing::apply;
use super::super::{AbelPlan, kernel, product, worn};
use std::f64::consts::FRAC_2_PI;

use super::*;

const LADDER: [usize; 8] = [4, 8, 15, 16, 33, 100, 257, 700];
const TOLERANCES: [f64; 3] = [1e-5, TOLERANCE, 1e-11];

fn grids(cells: usize) -> [RadialGrid; 4] {
    [
        RadialGrid::uniform(cells, 1.5),
        RadialGrid::graded(cells, 0.767, 1.5),
        RadialGrid::graded(cells, 0.05, 1.3),
        RadialGrid::graded(cells, 1.4e-6, 1.5e-6),
    ]
    .map(|grid| grid.expect("a grid"))
}

/// Smooth data, an edge, a root, a jump, and noise.
fn data(grid: &RadialGrid) -> Vec<Vec<f64>> {
    let along = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
        let radius = grid.radius();
        grid.nodes().iter().map(|r| f(r / radius)).collect()
    };
    let mut seed = 12345_u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed) / f64::from(u32::MAX) - 0.5
    };
    vec![
        along(&|r| r * r),
        along(&|r| 0.3 + r),
        along(&|r| (7.0 * r * r).cos()),
        along(&|r| (0.6 - r * r).max(0.0)),
        along(&|r| (r - 0.5).max(0.0).sqrt()),
        along(&|r| if r < 0.4 { 1.0 } else { 0.2 }),
        along(&|_| -2.0),
        (0..grid.len()).map(|_| noise()).collect(),
    ]
}

/// Returns Σ|Δ values| up to every node: the same sum with all terms positive.
fn variation(values: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let steps = values.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    std::iter::once(0.0)
        .chain(steps.map(|step| {
            sum += step;
            sum
        }))
        .collect()
}

/// Compares the two on dirty buffers; `scale` is what the tolerance refers to, row by row.
fn compare_forms(
    name: &str,
    dense: &DMatrix<f64>,
    values: &[f64],
    tolerance: f64,
    scale: &[f64],
    fast: &dyn Fn(&[f64], &mut [f64]),
) {
    let mut found = vec![f64::NAN; values.len()];
    fast(values, &mut found);
    let size = values.iter().fold(0.0_f64, |size, v| size.max(v.abs()));
    for (j, (found, exact)) in found.iter().zip(apply(dense, values)).enumerate() {
        let rounding = 2e-13 * (size + scale[j]);
        let error = (found - exact).abs();
        assert!(
            error <= tolerance * scale[j] + rounding,
            "{name}, N = {}, tolerance {tolerance:e}, row {j}: {error:e} > {:e}",
            values.len() - 1,
            tolerance * scale[j] + rounding,
        );
    }
}

#[test]
fn every_operator_is_the_dense_one_within_its_tolerance() {
    for grid in LADDER.into_iter().flat_map(grids) {
        let nodes = grid.nodes();
        let (g, w, p) = (
            product::profile(nodes),
            product::displacement(nodes),
            product::stress(nodes),
        );
        for tolerance in TOLERANCES {
            let fast = AbelPlan::fast(&grid, tolerance).expect("a plan");
            for values in data(&grid) {
                let all = variation(&values);
                let scale = apply(&g, &all);
                compare_forms("g", &g, &values, tolerance, &scale, &|f, g| {
                    fast.profile(f, g)
                });
                compare_forms("w", &w, &values, tolerance, &all, &|u, w| {
                    fast.displacement(u, w)
                });
                let last = all[grid.cells()];
                let falling: Vec<f64> = all.iter().map(|v| last - v).collect();
                let scale: Vec<f64> = apply(&p, &falling).iter().map(|p| 2.0 * p).collect();
                // Stress has the unit of the load per length; convert it to the unit of the data.
                let l = grid.radius();
                let scaled: Vec<f64> = scale.iter().map(|scale| scale * l).collect();
                compare_forms("p", &(&p * l), &values, tolerance, &scaled, &|q, p| {
                    fast.stress_from(0, q, p);
                    p.iter_mut().for_each(|p| *p *= l);
                });
            }
        }
    }
}

#[test]
fn the_worn_depth_is_the_dense_one_within_its_tolerance() {
    for grid in LADDER.into_iter().flat_map(grids) {
        let Some(border) = grid.border() else {
            // Without a border the worn depth is transformed like any profile.
            let fast = AbelPlan::fast(&grid, TOLERANCE).expect("a plan");
            for values in data(&grid) {
                let mut images = [vec![f64::NAN; grid.len()], vec![f64::NAN; grid.len()]];
                fast.profile(&values, &mut images[0]);
                fast.image(&values, &mut images[1]);
                assert_eq!(images[0], images[1]);
            }
            continue;
        };
        let (nodes, dense) = (grid.nodes(), worn::profile(&grid));
        for tolerance in TOLERANCES {
            let fast = AbelPlan::fast(&grid, tolerance).expect("a plan");
            for values in data(&grid) {
                // The scale is the variation inside the border, and the variation of F beyond it.
                let mut all = variation(&values[..=border]);
                let z: Vec<f64> = nodes[border..]
                    .iter()
                    .map(|&r| leg(nodes[border], r))
                    .collect();
                let share: Vec<f64> = (1..z.len())
                    .map(|i| (values[border + i] - values[border]) / z[i])
                    .collect();
                let first = share[0].abs();
                let shares = variation(&share);
                let inside = all[border];
                all.extend((1..z.len()).map(|i| inside + z[i] * (first + shares[i - 1])));
                let scale = apply(&dense, &all);
                compare_forms("worn", &dense, &values, tolerance, &scale, &|f, g| {
                    fast.image(f, g)
                });
            }
        }
    }
}

/// Data outside a node leave results inside it exactly unchanged.
#[test]
fn causality_is_strict() {
    let zeros_before = |first: usize, nodes: usize| -> Vec<f64> {
        (0..nodes)
            .map(|k| if k < first { 0.0 } else { 1.0 + k as f64 })
            .collect()
    };
    for grid in grids(200) {
        let fast = AbelPlan::fast(&grid, TOLERANCE).expect("a plan");
        let mut out = vec![f64::NAN; grid.len()];
        for first in [3, 31, 32, 33, 100] {
            let values = zeros_before(first, grid.len());
            fast.profile(&values, &mut out);
            assert!(out[..first].iter().all(|&g| g == 0.0));
            fast.displacement(&values, &mut out);
            assert!(out[..first].iter().all(|&w| w == 0.0));
            let mut load = zeros_before(first, grid.len());
            load.reverse();
            load[..3].fill(0.0);
            fast.stress_from(0, &load, &mut out);
            assert!(out[grid.len() - first..].iter().all(|&p| p == 0.0));
        }
        if let Some(border) = grid.border() {
            let values = zeros_before(border + 9, grid.len());
            fast.image(&values, &mut out);
            assert!(out[..border + 9].iter().all(|&g| g == 0.0));
        }
    }
}

/// From the requested node on, part of the stress equals the whole, bit for bit; nodes further in stay untouched.
#[test]
fn a_part_of_the_stress_is_that_of_the_whole() {
    for grid in grids(200) {
        let fast = AbelPlan::fast(&grid, TOLERANCE).expect("a plan");
        // Once with a jump at the end, once with zeros on the outer nodes.
        for ends in [200, 120] {
            let load: Vec<f64> = (0..grid.len())
                .map(|k| {
                    if k <= ends {
                        1.0 + (k as f64).sin()
                    } else {
                        0.0
                    }
                })
                .collect();
            let mut whole = vec![f64::NAN; grid.len()];
            assert_eq!(fast.stress_from(0, &load, &mut whole), 0);
            for first in [0, 1, 64, 100, 137, 199, 200, 201] {
                let mut part = vec![f64::NAN; grid.len()];
                let from = fast.stress_from(first, &load, &mut part);
                assert!(from <= first);
                assert_eq!(part[from..], whole[from..], "{first}");
                assert!(part[..from].iter().all(|p| p.is_nan()));
            }
        }
    }
}

#[test]
fn a_constant_and_not_a_number_are_passed_on() {
    let grid = RadialGrid::uniform(100, 1.0).expect("a grid");
    let fast = AbelPlan::fast(&grid, TOLERANCE).expect("a plan");
    let mut out = vec![f64::NAN; 101];
    fast.profile(&[0.7; 101], &mut out);
    assert!(out.iter().all(|&g| g == 0.7));
    let mut values = [0.0; 101];
    values[50] = f64::NAN;
    fast.profile(&values, &mut out);
    assert!(out[..50].iter().all(|&g| g == 0.0) && out[50..].iter().all(|g| g.is_nan()));
}

/// Plans and applies 1e5 nodes; a paraboloid is exact.
#[test]
fn large_grids_are_no_trouble() {
    let grid = RadialGrid::uniform(100_000, 1.0).expect("a grid");
    let fast = AbelPlan::fast(&grid, TOLERANCE).expect("a plan");
    let mut out = vec![0.0; grid.len()];
    fast.profile(grid.squares(), &mut out);
    let is = |out: &[f64], exact: &dyn Fn(f64) -> f64| -> bool {
        let mut pairs = out.iter().zip(grid.squares());
        pairs.all(|(out, &t)| (out - exact(t)).abs() < TOLERANCE)
    };
    assert!(is(&out, &|t| 2.0 * t));
    fast.displacement(grid.squares(), &mut out);
    assert!(is(&out, &|t| 0.5 * t));
    let load: Vec<f64> = grid.squares().iter().map(|t| 1.0 - t).collect();
    fast.stress_from(0, &load, &mut out);
    assert!(is(&out, &|t| 2.0 * FRAC_1_PI * (1.0 - t).sqrt()));
}

/// Transforms noise, and compares some nodes with sums of closed forms.
#[test]
fn large_grids_keep_the_tolerance_node_by_node() {
    let cells = 40_000;
    let uniform = RadialGrid::uniform(cells, 1.0);
    for grid in [uniform, RadialGrid::graded(cells, 0.3, 1.0)] {
        let grid = grid.expect("a grid");
        let (x, t) = (grid.nodes(), grid.squares());
        let fast = AbelPlan::fast(&grid, TOLERANCE).expect("a plan");
        let noise = data(&grid).pop().expect("data");
        // Avoids a cusp at the tip and a jump at the end.
        let values: Vec<f64> = (0..=cells)
            .map(|j| if j < 3 || j == cells { 0.0 } else { noise[j] })
            .collect();
        let (mut g, mut w, mut p) = (vec![0.0; t.len()], vec![0.0; t.len()], vec![0.0; t.len()]);
        fast.profile(&values, &mut g);
        fast.displacement(&values, &mut w);
        fast.stress_from(0, &values, &mut p);
        for j in [700, 4321, 14_000, 20_011, 30_002, 35_555, cells - 1] {
            let r = x[j];
            let sums = |from: usize, to: usize, image: &dyn Fn(f64, f64) -> f64| {
                let mut sums = [0.0; 2];
                for k in from..to {
                    let slope = (values[k + 1] - values[k]) / (t[k + 1] - t[k]);
                    let part = slope * image(x[k], x[k + 1]);
                    sums = [sums[0] + part, sums[1] + part.abs()];
                }
                sums
            };
            let profile = sums(0, j, &|a, b| 2.0 * r * kernel::root_step(a, b, r));
            let stress = sums(j, cells, &|a, b| {
                -2.0 * FRAC_1_PI * kernel::outer_root_step(a, b, r)
            });
            let surface = sums(0, j, &|a, b| {
                // The ramp of the cell, and its rise beyond.
                let rise = (b - a) * (b + a);
                let beyond = FRAC_PI_2 - (b / r).min(1.0).asin();
                let square = kernel::square_step(a, b, r, kernel::asin_step(a, b, r));
                FRAC_2_PI * (square + rise * beyond)
            });
            for (found, [exact, all]) in [(g[j], profile), (w[j], surface), (p[j], stress)] {
                assert!(
                    (found - exact).abs() < TOLERANCE * all,
                    "{j}: {found} {exact}"
                );
            }
        }
    }
}

/// Hertz and Cattaneo with the edge and the stick border between nodes, corrected by [`kink`](super::super::kink).
#[test]
fn kinks_between_nodes_are_as_exact_as_the_tolerance() {
    use super::super::kink::{add_to_stress, polyline};
    let places = [0.2345, 0.6131];
    let load = |t: f64| -> f64 { places.iter().map(|at| (at - t).max(0.0)).sum() };
    for cells in [200, 1000, 20_000] {
        let uniform = RadialGrid::uniform(cells, 1.0);
        for grid in [uniform, RadialGrid::graded(cells, 0.3, 1.0)] {
            let grid = grid.expect("a grid");
            let t = grid.squares();
            let fast = AbelPlan::fast(&grid, TOLERANCE).expect("a plan");
            let q: Vec<f64> = t.iter().map(|&t| load(t)).collect();
            let mut p = vec![f64::NAN; grid.len()];
            fast.stress_from(0, &q, &mut p);
            let mut kinks = Vec::new();
            for k in 0..cells {
                let inner = places.map(|at| (at, load(at)));
                polyline([t[k], t[k + 1]], [q[k], q[k + 1]], &inner, &mut kinks);
            }
            add_to_stress(&kinks, t, &mut p);
            let worst = p.iter().zip(t).map(|(p, &t)| {
                let roots = places.iter().map(|at| (at - t).max(0.0).sqrt());
                (p - 2.0 * FRAC_1_PI * roots.sum::<f64>()).abs()
            });
            let worst = worst.fold(0.0, f64::max);
            assert!(p.iter().all(|p| p.is_finite()));
            assert!(worst < 1e-9, "{cells}: {worst:e}");
        }
    }
}
