//! The transforms of a line contact in plane strain: other kernels in Eqs. (1) and (2), the same Eq. (3).
//!
//! # Formula
//!
//! A flat strip punch of half-width s under unit load has p = 1/(π√(s² − x²)) and, by Flamant, presses the surface
//! outside it to the slope −(2/πE*)/√(x² − s²). A pressure is a superposition of such punches, with P(s) the load when
//! the half-width was s. With g = P/E* and the slip e of the springs,
//!
//! ```text
//! g(x) = ∫₀ˣ r f′(r)/√(x² − r²) dr                                          (1L)
//! w(x) = e(0) + (2/π) x ∫₀ˣ [e(y) − e(0)]/(y √(x² − y²)) dy                 (2L)
//! p(x) = −(1/π) ∫ₓ^∞ q′(s)/√(s² − x²) ds                                    (3)
//! ```
//!
//! The first two are Eqs. (1) and (2) with an extra factor r/x in the integrand. A constant f has no image: the
//! approach of the bodies makes no difference to a half-plane. A constant e, the rigid slip, maps to itself. Both are
//! ours.
//!
//! The data are linear in t = r² in each cell, as in [`product`](super::product): f = f_k + σ_k (t − t_k),
//!
//! ```text
//! g_j = Σ_{k<j} 2σ_k H                                     H = ∫ r² dr/√(x² − r²)
//! w_j = e_0 + (2/π) Σ_{k<j} { (e_k − e_0 − σ_k t_k) K + σ_k x_j S }
//!                                                          K = ∫ x dy/(y√(x² − y²)) = Δ(−acosh(x/y)),  S = ∫ y dy/√(x² − y²)
//! w of a kink J (t − t_m)₊ of e: (2/π) J [x √(x² − t_m) − t_m acosh(x/x_m)]
//! ```
//!
//! - **Order**: exact for a cylinder, on any nodes; on other smooth data 3/2 in g, which needs f′, and second in w.
//! - **Cost, contact edge**: as in [`product`](super::product), but in the dense form only: up to
//!   [`MOST_DENSE_CELLS`](super::MOST_DENSE_CELLS).
//! - **At x = 0**: g = 0, w = e(0).
//! - **Known failure**: a wedge is curved in r² at the tip, as a cone is.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI, LN_2};

use nalgebra::DMatrix;

use super::dome::Dome;
use super::kernel::{asin_step, leg, root_step, square_step};
use super::kink::Kink;

/// Eq. (1L): weights of the 1D profile.
pub fn profile(nodes: &[f64]) -> DMatrix<f64> {
    let mut weights = DMatrix::zeros(nodes.len(), nodes.len());
    for (j, &x) in nodes.iter().enumerate() {
        for k in 0..j {
            let (a, b) = (nodes[k], nodes[k + 1]);
            let arc = asin_step(a, b, x);
            let square = square_step(a, b, x, arc) + a * a * arc;
            let weight = 2.0 * square / ((b - a) * (b + a));
            weights[(j, k)] -= weight;
            weights[(j, k + 1)] += weight;
        }
    }
    weights
}

/// Eq. (2L): weights of the surface slip, or of the surface displacement up to a constant.
pub fn displacement(nodes: &[f64]) -> DMatrix<f64> {
    let mut weights = DMatrix::zeros(nodes.len(), nodes.len());
    for (j, &x) in nodes.iter().enumerate() {
        let mut centre = 1.0;
        for k in 0..j {
            let (a, b) = (nodes[k], nodes[k + 1]);
            let arc = acosh_step(a, b, x);
            let right = (x * root_step(a, b, x) - a * a * arc) / ((b - a) * (b + a));
            weights[(j, k)] += FRAC_2_PI * (arc - right);
            weights[(j, k + 1)] += FRAC_2_PI * right;
            centre -= FRAC_2_PI * arc;
        }
        weights[(j, 0)] += centre;
    }
    weights
}

/// ∫ₐᵇ x dy/(y √(x² − y²)) = acosh(x/a) − acosh(x/b), for 0 < a ≤ b ≤ x; 0 in the cell at the centre, where the
/// integrand vanishes like y².
fn acosh_step(a: f64, b: f64, x: f64) -> f64 {
    if a == 0.0 {
        return 0.0;
    }
    let sine = x * (b - a) * (b + a) / (a * b * (leg(a, x) + leg(b, x)));
    sine.asinh()
}

/// Eq. (2L): adds the effect of kinks of e to the surface slip `w` on nodes with the given `squares`.
pub fn add_to_displacement(kinks: &[Kink], squares: &[f64], w: &mut [f64]) {
    for kink in kinks {
        let first = squares.partition_point(|&t| t <= kink.at);
        for (value, &t) in w[first..].iter_mut().zip(&squares[first..]) {
            let root = (t - kink.at).sqrt();
            let arc = if kink.at > 0.0 {
                (root / kink.at.sqrt()).asinh()
            } else {
                0.0
            };
            *value += FRAC_2_PI * kink.jump * (t.sqrt() * root - kink.at * arc);
        }
    }
}

/// Eq. (1L): returns g of a kink of f at x² = `square`: J [x² acos(x_m/x) + x_m √(x² − t_m)].
pub fn image_of_kink(kink: &Kink, square: f64) -> f64 {
    let root = (square - kink.at).max(0.0).sqrt();
    let at = kink.at.sqrt();
    kink.jump * (square * root.atan2(at) + at * root)
}

/// Eq. (2L): returns the surface displacement of a dome h √(a² − y²) at x² = `square`,
/// h a − (h/π) [(a + x) ln(1 + x/a) + (a − x) ln|1 − x/a|].
pub fn of_dome(dome: &Dome, square: f64) -> f64 {
    let (edge, x) = (dome.edge.sqrt(), square.sqrt());
    let part = |x: f64| match x > -edge {
        true => (edge + x) * (x / edge).ln_1p(),
        false if x == -edge => 0.0,
        false => (edge + x) * (-1.0 - x / edge).ln(),
    };
    dome.height * (edge - FRAC_1_PI * (part(x) + part(-x)))
}

/// Returns ∫ dx/x of a dome from 0 to its edge minus the same of its polyline in t, which ends there, by
/// ∫ (√(a² − x²) − a) dx/x = a (ln 2 − 1).
pub fn beyond_polyline(dome: &Dome, squares: &[f64]) -> f64 {
    let tip = dome.at(0.0);
    let cell = |from: f64, to: f64| {
        let [a, b] = [dome.at(from) - tip, dome.at(to) - tip];
        let slope = (b - a) / (to - from);
        let log = if from > 0.0 {
            (a - slope * from) * (to / from).ln()
        } else {
            0.0
        };
        0.5 * (log + b - a)
    };
    let inside = squares[..=dome.last]
        .windows(2)
        .map(|pair| cell(pair[0], pair[1]));
    let last = squares[dome.last];
    let end = if dome.edge > last {
        cell(last, dome.edge)
    } else {
        0.0
    };
    tip * (LN_2 - 1.0) - inside.sum::<f64>() - end
}

/// Returns ∫ dx/x of the kinks from x = 0 to `radius`.
pub fn log_integral(kinks: &[Kink], radius: f64) -> f64 {
    let integral = |kink: &Kink| {
        let end = (radius * radius).max(kink.at);
        let log = if kink.at > 0.0 {
            0.5 * kink.at * (end / kink.at).ln()
        } else {
            0.0
        };
        kink.jump * (0.5 * (end - kink.at) - log)
    };
    kinks.iter().map(integral).sum()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_4, PI};

    use super::super::kink::polyline;
    use super::super::testing::apply;
    use super::*;
    use crate::math::grid::RadialGrid;

    fn grids() -> [RadialGrid; 3] {
        [
            RadialGrid::uniform(100, 1.5),
            RadialGrid::graded(100, 0.767, 1.5),
            RadialGrid::graded(37, 0.31, 1.3),
        ]
        .map(|grid| grid.expect("a grid"))
    }

    fn worst(found: &[f64], exact: impl Iterator<Item = f64>) -> f64 {
        let errors = found.iter().zip(exact).map(|(f, e)| (f - e).abs());
        errors.fold(0.0, f64::max)
    }

    /// f = r²/2 has g = πx²/4, e = 0.3 + y² has w = 0.3 + (2/π)x².
    #[test]
    fn a_cylinder_is_exact() {
        for grid in grids() {
            let t = grid.squares();
            let f: Vec<f64> = t.iter().map(|t| 7.0 + 0.5 * t).collect();
            let g = apply(&profile(grid.nodes()), &f);
            let e: Vec<f64> = t.iter().map(|t| 0.3 + t).collect();
            let w = apply(&displacement(grid.nodes()), &e);
            let in_g = worst(&g, t.iter().map(|t| FRAC_PI_4 * t));
            let in_w = worst(&w, t.iter().map(|t| 0.3 + FRAC_2_PI * t));
            assert!(in_g < 1e-13 && in_w < 1e-13, "{in_g:e} {in_w:e}");
        }
    }

    /// rⁿ has g = ½ n B((n+1)/2, ½) xⁿ: 3π/4 for r⁴, 15π/16 for r⁶; (2L) takes y⁴ to (4/3π)x⁴.
    #[test]
    fn powers_converge() {
        let error = |cells: usize| {
            let grid = RadialGrid::uniform(cells, 1.0).expect("a grid");
            let power = |n: i32| grid.nodes().iter().map(move |x| x.powi(n));
            let image = |n| apply(&profile(grid.nodes()), &power(n).collect::<Vec<_>>());
            let slip = apply(&displacement(grid.nodes()), &power(4).collect::<Vec<_>>());
            let exact = |n, factor: f64| power(n).map(move |p| factor * p);
            let images = [(4, 0.75 * PI), (6, 0.9375 * PI)];
            let images = images.map(|(n, factor)| worst(&image(n), exact(n, factor)));
            [
                images[0].max(images[1]),
                worst(&slip, exact(4, 4.0 / (3.0 * PI))),
            ]
        };
        let (coarse, fine) = (error(50), error(800));
        let order = [0, 1].map(|i| (coarse[i] / fine[i]).log(16.0));
        assert!(fine[0] < 4e-4 && fine[1] < 1e-6, "{fine:?}");
        assert!(order[0] > 1.45 && order[1] > 1.9, "{order:?}");
    }

    /// Cattaneo's slip outside c, with its hat in one coarse cell.
    #[test]
    fn a_stick_border_between_nodes_is_exact() {
        for grid in grids() {
            let (t, c) = (grid.squares(), 0.5371_f64);
            let e: Vec<f64> = t.iter().map(|t| (t - c * c).max(0.0)).collect();
            let k = grid.nodes().partition_point(|&x| x < c);
            let mut kinks = Vec::new();
            polyline([t[k - 1], t[k]], [0.0, e[k]], &[(c * c, 0.0)], &mut kinks);
            let mut w = apply(&displacement(grid.nodes()), &e);
            add_to_displacement(&kinks, t, &mut w);
            let exact = grid.nodes().iter().map(|&x| {
                let x = x.max(c);
                FRAC_2_PI * (x * leg(c, x) - c * c * (x / c).acosh())
            });
            let error = worst(&w, exact);
            assert!(error < 1e-13, "{error:e}");
            assert!(w[..k].iter().all(|&slip| slip == 0.0));
            let end = grid.radius();
            let whole = 0.5 * leg(c, end).powi(2) - c * c * (end / c).ln();
            let chords: f64 = (k - 1..grid.cells())
                .map(|k| {
                    let (a, b) = (t[k], t[k + 1]);
                    let slope = (e[k + 1] - e[k]) / (b - a);
                    0.5 * (e[k + 1] - e[k] + (e[k] - slope * a) * (b / a).ln())
                })
                .sum();
            let missing = whole - chords;
            let hat = log_integral(&kinks, end);
            assert!((hat - missing).abs() < 1e-13, "{hat:e} {missing:e}");
        }
    }

    /// Checks by quadrature: (2L) with y = x sin φ, and the integral over dx/x.
    #[test]
    fn a_dome_and_a_kink_have_their_images() {
        let dome = Dome {
            height: 0.7,
            edge: 0.81,
            last: 45,
            beyond: 0.0,
        };
        let parts = 40_000;
        let turns = |i: i32| 0.5 * PI * (f64::from(i) + 0.5) / f64::from(parts);
        let mean = |of: &dyn Fn(f64) -> f64| {
            let sum: f64 = (0..parts).map(|i| of(turns(i).sin())).sum();
            0.5 * PI * sum / f64::from(parts)
        };
        let kink = Kink {
            at: 0.25,
            jump: 3.0,
        };
        for x in [0.3_f64, 0.7, 0.95, 1.3] {
            let slip = |s: f64| (dome.at(x * x * s * s) - dome.at(0.0)) / s;
            let exact = dome.at(0.0) + FRAC_2_PI * mean(&slip);
            let found = of_dome(&dome, x * x);
            assert!((found - exact).abs() < 1e-5, "{x}: {found} {exact}");
            let slope = |s: f64| {
                if x * s > 0.5 {
                    x * s * 2.0 * x * s * 3.0
                } else {
                    0.0
                }
            };
            let (found, exact) = (image_of_kink(&kink, x * x), mean(&slope));
            assert!((found - exact).abs() < 1e-3, "{x}: {found} {exact}");
        }
        let grid = RadialGrid::uniform(75, 1.5).expect("a grid");
        let beyond = beyond_polyline(&dome, grid.squares());
        let fine = RadialGrid::uniform(7500, 1.5).expect("a grid");
        let finer = beyond_polyline(&Dome { last: 4499, ..dome }, fine.squares());
        assert!(
            beyond > 0.0 && finer < 2e-3 * beyond,
            "{beyond:e} {finer:e}"
        );
    }

    #[test]
    fn it_is_causal_and_a_constant_has_no_image() {
        for grid in grids() {
            let (g, w) = (profile(grid.nodes()), displacement(grid.nodes()));
            assert_eq!(g, g.lower_triangle());
            assert_eq!(w, w.lower_triangle());
            let ones = vec![0.7; grid.len()];
            assert!(worst(&apply(&g, &ones), ones.iter().map(|_| 0.0)) < 1e-13);
            assert!(worst(&apply(&w, &ones), ones.iter().copied()) < 1e-13);
        }
    }
}
