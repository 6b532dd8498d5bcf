//! The methods to compute the transforms, and what holds for each.
//!
//! To add a method: a variant of [`AbelMethod`], which does not compile until [`traits`](AbelMethod::traits) has its
//! answers; its word in `keys.toml`; its row in the table of the [module](super) and in the guide.

use nalgebra::DMatrix;
use strum::{
    Display, EnumCount, EnumString, IntoStaticStr, VariantArray as Variants, VariantNames,
};

use super::{a, b, benad, product};
use crate::math::geometry::Geometry;
use crate::math::grid::MAX_CELLS;

/// Maximum number of cells of a method that only has the dense
/// form; its three triangular matrices then take about 0.8 GB.
pub const MOST_DENSE_CELLS: usize = 8192;

/// Number of cells from which every operator is faster in the [`fast`](super::fast) form than in the dense one, by
/// `cargo bench --bench transforms`: the three transforms are from about 100 on, the worn depth from 200 on.
const CROSSOVER: usize = 200;

/// A way to compute the three transforms, by its word in scenarios. Keys step through them in this order.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Hash,
    Default,
    Display,
    EnumCount,
    EnumString,
    IntoStaticStr,
    strum::VariantArray,
    VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum AbelMethod {
    /// Product integration, linear in r²: ours.
    #[default]
    Product,
    /// The paper's Method A: splits off the singularity of (2), Eq. (7).
    A,
    /// The paper's suggestion (b): Method A for (1) and (3), Method B for (2).
    #[strum(serialize = "a+b")]
    APlusB,
    /// The paper's Method B: trapezoids in asin and acosh, Eqs. (11) to (13).
    B,
    /// Integration by parts, J. Benad (2018): the paper's reference 9.
    Benad,
}

/// Computes the dense weights of a transform at nodes.
pub type Weights = fn(&[f64]) -> DMatrix<f64>;

/// What the rest of the program may assume of a method.
#[derive(Debug, Clone, Copy)]
pub struct MethodTraits {
    /// Its name in a sentence, with the paper's capital letters.
    pub title: &'static str,
    /// What it is, in one line.
    pub description: &'static str,
    /// The weights of Eqs. (1), (2) and (3).
    pub weights: [Weights; 3],
    /// Whether it is one of the paper or its reference 9, and runs as published: on equal cells, by Euler's steps, with
    /// the 1D image of the unworn profile by Eq. (1).
    pub is_published: bool,
    /// Whether it also has the kernels of a line contact.
    pub serves_lines: bool,
    /// Whether it has the [`fast`](super::fast) form.
    pub has_fast_form: bool,
    /// Whether kinks, domes and the ends of scars between nodes are added to its transforms.
    pub follows_kinks: bool,
    /// Whether g depends on f inside x only, and p on q outside r only, so that a permanent stick zone stays.
    pub is_causal: bool,
    /// ρ: the largest eigenvalue of the response of p to wear, times the cell width.
    pub response: f64,
    /// The wear that it cannot follow whatever the step, if there is such.
    pub sawtooth: Option<Sawtooth>,
}

/// A sawtooth that no shorter step prevents.
#[derive(Debug, Clone, Copy)]
pub struct Sawtooth {
    /// The wear at which it shows, at the rate of a cycle of the unworn contact and relative to the largest depth.
    ///
    /// Measured, not derived: on the motion of Fig. 3 with 20 cycles, at N from 25 to 200 and 50 to 400 steps per cycle,
    /// 0.38 to 0.44 with b and 0.038 to 0.055 with benad. The eigenvalues of the map from a profile to its wear per cycle
    /// do not predict this: with b they equal the other methods', with benad they change fourfold with N. On other
    /// motions the constants may be off by more than 1.5.
    pub from: f64,
    /// Its cause.
    pub why: &'static str,
    /// What to do about it.
    pub advice: &'static str,
}

impl AbelMethod {
    /// All methods.
    pub const ALL: [Self; Self::COUNT] = {
        let mut all = [Self::Product; Self::COUNT];
        all.copy_from_slice(<Self as Variants>::VARIANTS);
        all
    };

    /// Returns what may be assumed of it.
    pub const fn traits(self) -> MethodTraits {
        match self {
            Self::Product => MethodTraits {
                title: "product",
                description: "product integration linear in r²; exact for a paraboloid",
                weights: [product::profile, product::displacement, product::stress],
                is_published: false,
                serves_lines: true,
                has_fast_form: true,
                follows_kinks: true,
                is_causal: true,
                response: 1.51,
                sawtooth: None,
            },
            Self::A => MethodTraits {
                title: "A",
                description: "Method A of the paper: singularity split off; causal",
                weights: [benad::profile, a::displacement, benad::stress],
                is_causal: true,
                ..MethodTraits::PUBLISHED
            },
            Self::APlusB => MethodTraits {
                title: "A+B",
                description: "Method A for Eqs. (1) and (3), B for Eq. (2); causal",
                weights: [benad::profile, b::displacement, benad::stress],
                is_causal: true,
                ..MethodTraits::PUBLISHED
            },
            Self::B => MethodTraits {
                title: "B",
                description: "Method B of the paper: trapezoids; leaks at the stick border",
                weights: [b::profile, b::displacement, b::stress],
                response: 0.34,
                sawtooth: Some(Sawtooth {
                    from: 0.4,
                    why: "its differences reach across the stick border and wear the permanent stick zone",
                    advice: "method b develops a sawtooth at large wear coefficients; try numerics.method = \
                             \"product\" or more numerics.steps_per_cycle",
                }),
                ..MethodTraits::PUBLISHED
            },
            Self::Benad => MethodTraits {
                title: "Benad",
                description: "integration by parts (Benad 2018); unstable in fretting",
                weights: [benad::profile, benad::displacement, benad::stress],
                sawtooth: Some(Sawtooth {
                    from: 0.045,
                    why: "its Eq. (2) adds the unevenness of the springs in every cycle",
                    advice: "method benad amplifies errors in every round trip f -> g -> f; \
                             numerics.method = \"product\" is stable",
                }),
                ..MethodTraits::PUBLISHED
            },
        }
    }

    /// Returns the methods available for this `geometry`.
    pub fn for_geometry(geometry: Geometry) -> Vec<Self> {
        let serves = |method: &Self| !geometry.is_line() || method.traits().serves_lines;
        Self::ALL.into_iter().filter(serves).collect()
    }

    /// Returns the name used in scenarios, on the screen and in files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Whether it uses the [`fast`](super::fast) form instead of the dense one on this many cells.
    pub fn prefers_fast(self, cells: usize) -> bool {
        self.traits().has_fast_form && cells >= CROSSOVER
    }

    /// Returns the maximum number of cells.
    pub fn most_cells(self) -> usize {
        if self.traits().has_fast_form {
            MAX_CELLS
        } else {
            MOST_DENSE_CELLS
        }
    }
}

impl MethodTraits {
    /// Those of a published method, where it does not say otherwise.
    const PUBLISHED: Self = Self {
        title: "",
        description: "",
        weights: [benad::profile, benad::displacement, benad::stress],
        is_published: true,
        serves_lines: false,
        has_fast_form: false,
        follows_kinks: false,
        is_causal: false,
        response: 1.51,
        sawtooth: None,
    };
}
