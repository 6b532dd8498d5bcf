//! Product integration: the data linear in r² in each cell, the kernels integrated exactly.
//!
//! # Formula
//!
//! Profiles and loads are even in r, so they are smooth in t = r², and there they are interpolated: u(x) = u_k +
//! σ_k (x² − x_k²) on cell k, σ_k = Δu/Δt. A cone alone is not: it is the [`cusp`](super::cusp) of a whole profile, and
//! with it 1, x and x² are held exactly. The integrals of Eqs. (1) to (3) over each cell are (Δ: right end minus left end)
//!
//! ```text
//! g_j = f_0 + x_j Σ_{k<j} 2σ_k S
//! w_j = (2/π) Σ_{k<j} { u_k α + σ_k (H − x_k² α) }
//! p_j = −(1/π) Σ_{k≥j} 2σ_k C
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | α | ∫dx/√(r²−x²) = Δ asin(x/r) |
//! | S | ∫x dx/√(r²−x²) = −Δ√(r²−x²) |
//! | H | ∫x² dx/√(r²−x²) = Δ[½r² asin(x/r) − ½x√(r²−x²)] |
//! | C | ∫x dx/√(x²−r²) = Δ√(x²−r²) |
//!
//! The product rule for weakly singular kernels is that of A. Young (1954), The application of
//! approximate product integration to the numerical solution of integral equations, Proc. R. Soc.
//! Lond. A 224, 561–573, doi 10.1098/rspa.1954.0180; the basis in r² and the cusp are ours.
//!
//! - **Order**: exact for paraboloid and cone, on any nodes. On smooth data second in g and w; p of
//!   order 3/2 where q is curved in t, and with [`curvature`](super::curvature) second but next to an edge.
//!   Order ½ at a kink between nodes, unless it is given to [`kink`](super::kink).
//! - **Cost**: O(N²) kernels to set up, O(N²/2) to apply, as for every method here.
//! - **At r = 0**: g = f(0), w = u(0).
//! - **At the contact edge**: q is linear in x² down to zero in the cell that holds the edge, until
//!   [`kink::polyline`](super::kink::polyline) puts the edge where it is, and [`cone`](super::cone) ends the cusp there.
//! - **Known failure**: none of its own. With the cusp causality kinks a little at the tip, because A needs nodes 0, 1 and
//!   2: in g and w row 1 looks at node 2, inside the second cell, and in p all rows look at these nodes, as far as the
//!   load has a cusp. Everything else is strictly triangular: what happens outside the stick zone cannot reach into it.
//!
//! Largest error over 0 … 1.5a, N = 100, a = 1 or 0.9937, E* = 1 (the tests below assert 1e-13):
//!
//! | | g | w | p |
//! |---|---|---|---|
//! | paraboloid, cone, their sum | 2e-14 | 2e-14 | 2e-14 |
//!
//! In the fretting run of the paper's Fig. 3 (k E* d₀/a₀ = 1, state at 199.24 cycles, 100 steps a
//! cycle), root mean square error of f in units of d₀, against N = 800 to 1600:
//!
//! | method | N = 50 | 100 | 200 | 400 |
//! |---|---|---|---|---|
//! | this one, graded cells, [`worn`](super::worn), [`kink`](super::kink), [`curvature`](super::curvature) | 1.0e-3 | 4.8e-4 | 2.1e-4 | 7.8e-5 |
//! | a, uniform cells | 1.3e-2 | 4.9e-3 | 1.1e-3 | 2.0e-3 |
//! | a+b, uniform cells | 1.2e-2 | 4.8e-3 | 1.4e-3 | 2.0e-3 |
//! | b, uniform cells | 4.5e-2 | 3.6e-2 | 2.9e-2 | 2.3e-2 |
//! | benad, uniform cells | 1.3e-1 | 1.1e-1 | 6.9e-1 | 1.9 |

use std::f64::consts::FRAC_2_PI;

use nalgebra::DMatrix;

use super::kernel::{add_jump_at_rim, asin_step, outer_root_step, root_step, square_step};

/// Eq. (1): weights of the 1D profile.
pub fn profile(nodes: &[f64]) -> DMatrix<f64> {
    let mut weights = DMatrix::zeros(nodes.len(), nodes.len());
    for (j, &x) in nodes.iter().enumerate() {
        weights[(j, 0)] = 1.0;
        for k in 0..j {
            let (a, b) = (nodes[k], nodes[k + 1]);
            let root = root_step(a, b, x);
            let weight = 2.0 * x * root / ((b - a) * (b + a));
            weights[(j, k)] -= weight;
            weights[(j, k + 1)] += weight;
        }
    }
    weights
}

/// Eq. (2): weights of the surface displacement.
pub fn displacement(nodes: &[f64]) -> DMatrix<f64> {
    let mut weights = DMatrix::zeros(nodes.len(), nodes.len());
    weights[(0, 0)] = 1.0;
    for (j, &r) in nodes.iter().enumerate().skip(1) {
        for k in 0..j {
            let (a, b) = (nodes[k], nodes[k + 1]);
            let arc = asin_step(a, b, r);
            let square = square_step(a, b, r, arc);
            let right = square / ((b - a) * (b + a));
            weights[(j, k)] += FRAC_2_PI * (arc - right);
            weights[(j, k + 1)] += FRAC_2_PI * right;
        }
    }
    weights
}

/// Eq. (3): weights of the stress. The line load ends at the last node; where it is not zero there,
/// it jumps, as at the rim of a punch. Where it ends before, see [`cone`](super::cone).
pub fn stress(nodes: &[f64]) -> DMatrix<f64> {
    let last = nodes.len() - 1;
    let mut weights = DMatrix::zeros(nodes.len(), nodes.len());
    for (j, &r) in nodes.iter().enumerate() {
        for k in j..last {
            let (a, b) = (nodes[k], nodes[k + 1]);
            let weight = FRAC_2_PI * outer_root_step(a, b, r) / ((b - a) * (b + a));
            weights[(j, k)] += weight;
            weights[(j, k + 1)] -= weight;
        }
    }
    add_jump_at_rim(&mut weights, nodes);
    weights
}

/// Where `values`, of the given sign on both sides, pass through zero within `cell`: the square t of
/// the radius. `cusp` is that of the values, 0 for an interpolant linear in t.
///
/// The smallest positive root y = x − x_m of q_m + y (2x_m σ + A h/X) + y² (σ − A/X), in the form in
/// which nothing cancels. The values must change sign in the cell.
pub fn edge_square(nodes: &[f64], values: &[f64], cell: usize, cusp: f64) -> f64 {
    let (a, b) = (nodes[cell], nodes[cell + 1]);
    let (left, right) = (values[cell], values[cell + 1]);
    let bubble = cusp / (a + b);
    let slope = (right - left) / ((b - a) * (b + a));
    // The sign is chosen so that the values fall.
    let sign = if left < right { -1.0 } else { 1.0 };
    let (c0, c1, c2) = (
        sign * left,
        sign * (2.0 * a * slope + (b - a) * bubble),
        sign * (slope - bubble),
    );
    let root = (c1 * c1 - 4.0 * c0 * c2).max(0.0).sqrt();
    let y = if c1 <= 0.0 {
        2.0 * c0 / (root - c1)
    } else {
        -0.5 * (c1 + root) / c2
    };
    let x = a + y.clamp(0.0, b - a);
    x * x
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

    use super::super::cusp::Tip;
    use super::super::testing::{apply, image, matrix};
    use super::super::{AbelMethod, AbelPlan};

    use super::super::cone::{Cone, Rest};
    use super::super::kink::{add_to_stress, polyline};
    use super::*;
    use crate::math::grid::RadialGrid;

    fn grids(scale: f64) -> Vec<RadialGrid> {
        vec![
            RadialGrid::uniform(100, 1.5 * scale).expect("a grid"),
            RadialGrid::graded(100, 0.767 * scale, 1.5 * scale).expect("a grid"),
            RadialGrid::graded(37, 0.31 * scale, 1.3 * scale).expect("a grid"),
        ]
    }

    fn worst(found: &[f64], exact: impl Iterator<Item = f64>) -> f64 {
        found
            .iter()
            .zip(exact)
            .map(|(found, exact)| (found - exact).abs())
            .fold(0.0, f64::max)
    }

    /// u = αx + βx², and its images in closed form (g: π/2 and 2; w: 2/π and ½).
    const SUMS: [(f64, f64); 3] = [(1.0, 0.0), (0.0, 1.0), (0.7, 0.4)];

    #[test]
    fn cone_paraboloid_and_their_sum_are_exact_in_g_and_w() {
        for grid in grids(1.0) {
            let nodes = grid.nodes();
            let plan = AbelPlan::dense(AbelMethod::Product, &grid);
            for (cone, square) in SUMS {
                let u: Vec<f64> = nodes
                    .iter()
                    .map(|x| 0.3 + x * (cone + square * x))
                    .collect();
                let g = nodes
                    .iter()
                    .map(|x| 0.3 + x * (FRAC_PI_2 * cone + 2.0 * square * x));
                let w = nodes
                    .iter()
                    .map(|x| 0.3 + x * (FRAC_2_PI * cone + 0.5 * square * x));
                let forth = image(&u, |u, g| plan.profile(u, g));
                let back = image(&u, |u, w| plan.displacement(u, w));
                let (in_g, in_w) = (worst(&forth, g), worst(&back, w));
                assert!(
                    in_g < 1e-13 && in_w < 1e-13,
                    "{cone} {square}: {in_g:e} {in_w:e}"
                );
            }
        }
    }

    /// The load of springs pressed by d, the stress, and the place of the edge, as a caller does it.
    fn pressed(grid: &RadialGrid, depth: f64, g: impl Fn(f64) -> f64) -> (Vec<f64>, f64) {
        let (nodes, squares) = (grid.nodes(), grid.squares());
        let signed: Vec<f64> = nodes.iter().map(|&x| depth - g(x)).collect();
        let q: Vec<f64> = signed.iter().map(|q| q.max(0.0)).collect();
        let cell = signed.partition_point(|&q| q > 0.0) - 1;
        let slope = Tip::new(nodes).slope(&q);
        let at = edge_square(nodes, &signed, cell, slope);
        let edge = at.sqrt();
        let mut kinks = Vec::new();
        let ends = [squares[cell], squares[cell + 1]];
        polyline(ends, [q[cell], 0.0], &[(at, 0.0)], &mut kinks);
        let (cone, mut rest) = (Cone { slope, edge }, Rest::default());
        cone.take_off(grid, &q, &mut rest);
        let mut p = apply(&stress(nodes), &rest.load);
        add_to_stress(&kinks, squares, &mut p);
        add_to_stress(&rest.kinks, squares, &mut p);
        cone.add_to_stress(grid, &mut p);
        (p, edge)
    }

    #[test]
    fn the_stress_is_exact_with_the_edge_on_a_node_and_between_nodes() {
        for scale in [1e-12, 1.0] {
            for grid in grids(scale) {
                let on_a_node = grid.nodes()[grid.cells() * 2 / 3];
                for a in [on_a_node, scale, 0.9937 * scale, 0.613 * scale] {
                    for (cone, square) in SUMS {
                        let load = |x: f64| x / scale * (cone + square * x / scale);
                        let (p, edge) = pressed(&grid, load(a), load);
                        assert!((edge / a - 1.0).abs() < 1e-13, "{edge} {a}");
                        let exact = grid.nodes().iter().map(|&r| {
                            let root = ((a - r) * (a + r)).max(0.0).sqrt();
                            let logarithm = if r > 0.0 && r < a {
                                (root / r).asinh()
                            } else {
                                0.0
                            };
                            FRAC_1_PI * (cone * logarithm + 2.0 * square * root / scale)
                        });
                        // A cone's p(0) is infinite: leave it out there.
                        let skip = usize::from(cone > 0.0);
                        let found: Vec<f64> = p.iter().map(|p| p * scale).collect();
                        let error = worst(&found[skip..], exact.skip(skip));
                        assert!(error < 1e-13, "a = {a}, {cone} {square}: {error:e}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_cusp_ends_at_the_edge_of_the_grid_by_itself() {
        let grid = RadialGrid::uniform(60, 1.0).expect("a grid");
        let q: Vec<f64> = grid.nodes().iter().map(|x| 1.0 - x).collect();
        let plan = AbelPlan::dense(AbelMethod::Product, &grid);
        let p = image(&q, |q, p| plan.stress(q, p));
        let exact = grid.nodes().iter().map(|r| FRAC_1_PI * (1.0 / r).acosh());
        assert!(worst(&p[1..], exact.skip(1)) < 1e-13);
    }

    #[test]
    fn causal_but_for_the_cusp_at_the_tip() {
        for grid in grids(1.0) {
            let nodes = grid.nodes();
            let (g, w, p) = (profile(nodes), displacement(nodes), stress(nodes));
            assert_eq!(g, g.lower_triangle());
            assert_eq!(w, w.lower_triangle());
            assert_eq!(p, p.upper_triangle());
            let plan = AbelPlan::dense(AbelMethod::Product, &grid);
            let size = nodes.len();
            let g = matrix(size, |f, g| plan.profile(f, g));
            let w = matrix(size, |u, w| plan.displacement(u, w));
            let p = matrix(size, |q, p| plan.stress(q, p));
            for j in 0..size {
                for k in 0..size {
                    if k > j && (j, k) != (1, 2) {
                        assert_eq!((g[(j, k)], w[(j, k)]), (0.0, 0.0), "{j} {k}");
                    }
                    if k < j && k > 2 {
                        assert_eq!(p[(j, k)], 0.0, "{j} {k}");
                    }
                }
            }
        }
    }

    /// W G is block triangular, so its eigenvalues stand on the diagonal, but for one 2 × 2 block.
    #[test]
    fn there_and_back_does_not_grow() {
        for grid in grids(1.0) {
            let nodes = grid.nodes();
            let plan = AbelPlan::dense(AbelMethod::Product, &grid);
            let size = nodes.len();
            let back = matrix(size, |u, w| plan.displacement(u, w));
            let both = back * matrix(size, |f, g| plan.profile(f, g));
            let tip = both.view((1, 1), (2, 2)).into_owned();
            let tip = tip.complex_eigenvalues();
            let tip = tip.iter().map(|value| value.norm());
            let rest = (3..nodes.len()).map(|j| both[(j, j)].abs());
            let radius = tip.chain(rest).fold(0.0, f64::max);
            assert!(radius < 1.0 + 1e-12, "{radius}");
        }
    }
}
