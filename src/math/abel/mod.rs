//! The three Abel transforms between the 3D contact and its 1D image, and the ways to compute them.
//!
//! # Formula
//!
//! Eqs. (1) to (3) of Q. Li, F. Forsbach, J. Benad (2019), Facta Univ. Mech. Eng. 17(1), 87–93,
//! doi 10.22190/FUME190103012L, called *the paper* throughout this crate:
//!
//! ```text
//! g(x) = f(0) + x ∫₀ˣ f′(r) / √(x² − r²) dr        profile, 3D → 1D              (1)
//! w(r) = (2/π) ∫₀ʳ u(x) / √(r² − x²) dx             displacement, 1D → 3D         (2)
//! p(r) = −(1/π) ∫ᵣ^∞ q′(x) / √(x² − r²) dx          stress, 1D → 3D               (3)
//! ```
//!
//! The term f(0) in (1) is ours: a worn tip recedes, and a constant must map to itself.
//!
//! A line contact has other kernels in Eqs. (1) and (2): see [`line`].
//!
//! [`kink`] adds the effect of a kink between two nodes, [`dome`] a load that ends like a root, and [`worn`]
//! transforms the worn part of a profile with a permanent stick zone. A [`field`] holds nodal values with their kinks
//! and dome, and provides all transforms.
//!
//! All methods here are linear in the nodal values. An [`AbelPlan`] holds three operators, and with a border a fourth
//! for Eq. (1) of the worn depth; they are made once per grid and write into the caller's buffers. The dense form of
//! each is a matrix: O(N²) kernel evaluations to set up, at most N²/2 multiply-adds to apply, N²/2 numbers. The product
//! method also has a form in O(N): see [`fast`].
//!
//! | method | Eq. (1) | Eq. (2) | Eq. (3) | causal |
//! |---|---|---|---|---|
//! | `product` | [`product::profile`] | [`product::displacement`] | [`product::stress`] | yes |
//! | `benad` | [`benad::profile`] | [`benad::displacement`] | [`benad::stress`] | no: Eq. (2) looks one node ahead |
//! | `a` | [`benad::profile`] | [`a::displacement`] | [`benad::stress`] | yes |
//! | `b` | [`b::profile`] | [`b::displacement`] | [`b::stress`] | no: Eqs. (1) and (3) look one node across |
//! | `a+b` | [`benad::profile`] | [`b::displacement`] | [`benad::stress`] | yes |
//!
//! The guide's page on methods measures the effect of each part, left out alone and in groups.
//!
//! ```
//! use mdr_tui::math::abel::{AbelMethod, AbelPlan};
//! use mdr_tui::math::grid::RadialGrid;
//!
//! # fn main() -> Result<(), mdr_tui::math::invalid::Invalid> {
//! // The 1D image of a sphere r²/2 is twice as steep: g = x², Eq. (1).
//! let grid = RadialGrid::uniform(50, 1.5)?;
//! let plan = AbelPlan::new(AbelMethod::Product, &grid);
//! let profile: Vec<f64> = grid.nodes().iter().map(|r| 0.5 * r * r).collect();
//! let mut image = vec![0.0; grid.len()];
//! plan.profile(&profile, &mut image);
//! for (x, g) in grid.nodes().iter().zip(&image) {
//!     assert!((g - x * x).abs() < 1e-13);
//! }
//! # Ok(())
//! # }
//! ```

use std::cell::Cell;
use std::fmt::Debug;

use super::geometry::Geometry;
use super::grid::RadialGrid;
use super::skyline::Skyline;
use fast::{Inwards, Outwards, WornTransform};
pub use method::{AbelMethod, MOST_DENSE_CELLS, MethodTraits, Sawtooth};

pub mod a;
pub mod b;
pub mod benad;
pub mod dome;
pub mod edge_curve;
pub mod fast;
pub mod field;
mod kernel;
pub mod kink;
pub mod line;
mod method;
pub mod product;
#[cfg(test)]
mod testing;
pub mod worn;

/// A transform on a grid, dense or fast.
trait Transform: Debug + Send + Sync {
    /// Writes the `image` of nodal `values` from the node `first` on, or from slightly before it, and returns the node
    /// where it began. If the image looks inwards, it may cover the first nodes only.
    fn apply_from(&self, first: usize, values: &[f64], image: &mut [f64]) -> usize;
}

impl Transform for Skyline {
    fn apply_from(&self, first: usize, values: &[f64], image: &mut [f64]) -> usize {
        Self::apply_from(self, first, values, image)
    }
}

/// The transforms of one method on one grid, ready to apply.
#[derive(Debug)]
pub struct AbelPlan {
    method: AbelMethod,
    geometry: Geometry,
    profile: Box<dyn Transform>,
    displacement: Box<dyn Transform>,
    stress: Box<dyn Transform>,
    /// Eq. (1) of the worn depth, see [`worn`], if its form differs.
    worn: Option<Box<dyn Transform>>,
}

impl AbelPlan {
    /// Makes the plan of a contact of this `geometry`; a [`line`] uses the product method in the dense form.
    pub fn for_geometry(geometry: Geometry, method: AbelMethod, grid: &RadialGrid) -> Self {
        if !geometry.is_line() {
            return Self::new(method, grid);
        }
        let nodes = grid.nodes();
        Self {
            method: AbelMethod::Product,
            geometry,
            profile: Box::new(Skyline::pack(&line::profile(nodes))),
            displacement: Box::new(Skyline::pack(&line::displacement(nodes))),
            stress: Box::new(Skyline::pack(&product::stress(nodes))),
            worn: None,
        }
    }

    /// Computes the weights of `method` on `grid`, in the faster form; the [`fast`] one uses the tightest tolerance
    /// within reach.
    pub fn new(method: AbelMethod, grid: &RadialGrid) -> Self {
        let tolerances = method
            .prefers_fast(grid.cells())
            .then_some(fast::TOLERANCES);
        let mut tolerances = tolerances.into_iter().flatten();
        let fast = tolerances.find_map(|tolerance| Self::fast(grid, tolerance));
        fast.unwrap_or_else(|| Self::dense(method, grid))
    }

    /// Makes the product method on `grid` in the fast form, to a tolerance defined in [`fast`]; `None` if that is out
    /// of reach.
    pub fn fast(grid: &RadialGrid, tolerance: f64) -> Option<Self> {
        let [roots, arcs] =
            [fast::ROOT, fast::ARC].map(|kernel| fast::powers(grid.nodes(), kernel, tolerance));
        let (roots, arcs) = (roots?, arcs?);
        Some(Self {
            method: AbelMethod::Product,
            geometry: Geometry::Round,
            profile: Box::new(Outwards::new(grid, grid.cells(), &roots)),
            displacement: Box::new(Outwards::new(grid, grid.cells(), &arcs)),
            stress: Box::new(Inwards::new(grid, &roots)),
            worn: match grid.border() {
                Some(border) => Some(Box::new(WornTransform::new(
                    grid, border, &roots, tolerance,
                )?)),
                None => None,
            },
        })
    }

    /// Makes `method` on `grid` in the dense form.
    pub fn dense(method: AbelMethod, grid: &RadialGrid) -> Self {
        let pack = |weights| -> Box<dyn Transform> { Box::new(Skyline::pack(&weights)) };
        let nodes = grid.nodes();
        let traits = method.traits();
        let [profile, displacement, stress] = traits.weights.map(|weights| pack(weights(nodes)));
        let has_form = traits.follows_kinks && grid.border().is_some();
        Self {
            method,
            geometry: Geometry::Round,
            profile,
            displacement,
            stress,
            worn: has_form.then(|| pack(worn::profile(grid))),
        }
    }

    /// The geometry of the contact.
    pub fn geometry(&self) -> Geometry {
        self.geometry
    }

    /// The method that this plan computes.
    pub fn method(&self) -> AbelMethod {
        self.method
    }

    /// Eq. (1): computes the 1D profile `g` of the 3D profile `f`, both nodal, in the same unit.
    pub fn profile(&self, f: &[f64], g: &mut [f64]) {
        apply(&*self.profile, 0, f, g);
    }

    /// Eq. (1): computes the 1D image `g` of the worn depth, both nodal, m.
    pub fn image(&self, depth: &[f64], g: &mut [f64]) {
        let transform = self.worn.as_ref().unwrap_or(&self.profile);
        apply(&**transform, 0, depth, g);
    }

    /// Eq. (2): computes the surface displacement `w` of the spring displacement `u`, both nodal. `w` may cover the
    /// first nodes only.
    pub fn displacement(&self, u: &[f64], w: &mut [f64]) {
        apply(&*self.displacement, 0, u, w);
    }

    /// Eq. (3): computes the stress `p` (N/m²) of the line load `q` (N/m), both nodal. `q` ends at the grid's edge.
    pub fn stress(&self, q: &[f64], p: &mut [f64]) {
        self.stress_from(0, q, p);
    }

    /// As [`stress`](Self::stress), but from the node `first` on, or from slightly before it; returns where it began.
    pub fn stress_from(&self, first: usize, q: &[f64], p: &mut [f64]) -> usize {
        apply(&*self.stress, first, q, p)
    }
}

thread_local! {
    /// The number of transforms computed by this thread.
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

/// Applies a transform, and counts it.
fn apply(transform: &dyn Transform, first: usize, values: &[f64], image: &mut [f64]) -> usize {
    COUNT.set(COUNT.get() + 1);
    transform.apply_from(first, values, image)
}

/// Returns the number of transforms in `compute`, with its result. They do not count in a count around it.
pub(crate) fn counted<T>(compute: impl FnOnce() -> T) -> (T, u64) {
    let before = COUNT.replace(0);
    let result = compute();
    (result, COUNT.replace(before))
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;
    use strum::VariantNames;

    use super::*;

    #[test]
    fn names_read_back() {
        assert_eq!(AbelMethod::ALL.map(AbelMethod::name), AbelMethod::VARIANTS);
        for method in AbelMethod::ALL {
            assert_eq!(method.name().parse(), Ok(method));
        }
        assert!("c".parse::<AbelMethod>().is_err());
    }

    #[test]
    fn a_shorter_displacement_is_that_of_the_first_nodes() {
        let grid = RadialGrid::uniform(150, 1.0).expect("a grid");
        let fast = AbelPlan::fast(&grid, fast::TOLERANCE).expect("a plan");
        let dense = AbelMethod::ALL.map(|method| AbelPlan::dense(method, &grid));
        let u: Vec<f64> = (0..151).map(|j| (f64::from(j) * 1.7).sin()).collect();
        for plan in dense.iter().chain([&fast]) {
            let mut all = vec![f64::NAN; 151];
            plan.displacement(&u, &mut all);
            for nodes in [1, 2, 15, 16, 17, 64, 65, 128, 150] {
                let mut first = vec![f64::NAN; nodes];
                plan.displacement(&u, &mut first);
                assert_eq!(first, all[..nodes], "{} {nodes}", plan.method());
            }
        }
    }

    #[test]
    fn operators_are_as_causal_as_their_traits_say() {
        let grid = RadialGrid::uniform(20, 1.0).expect("a grid");
        for method in AbelMethod::ALL {
            let plan = AbelPlan::new(method, &grid);
            let [profile, displacement, stress]: [DMatrix<f64>; 3] = [
                testing::matrix(21, |f, g| plan.profile(f, g)),
                testing::matrix(21, |u, w| plan.displacement(u, w)),
                testing::matrix(21, |q, p| plan.stress(q, p)),
            ];
            let causal = profile == profile.lower_triangle()
                && displacement == displacement.lower_triangle()
                && stress == stress.upper_triangle();
            assert_eq!(causal, method.traits().is_causal, "{method}");
        }
    }
}
