//! Closed forms to judge by; they share no code with what they test.
//!
//! Everything here imports `std` only (and its own neighbours in this folder). Pure functions and small structs, SI units,
//! `f64`. If a problem has no closed form, the defining integral is computed by adaptive quadrature, its singularity
//! removed by substitution. Equation numbers refer to Li, Forsbach & Benad (2019), doi 10.22190/FUME190103012L.
//! Arguments outside a function's domain give NaN, never a panic; each item says so where it can happen.
//!
//! | file | problem |
//! |---|---|
//! | [`power_law`] | f = A rⁿ: paraboloid (Hertz), cone, quartic |
//! | [`flat_punch`] | flat-ended cylinder |
//! | [`truncated`] | paraboloid with a flat tip |
//! | [`cattaneo_mindlin`] | partial slip of the paraboloid on first loading |
//! | [`fretting_loop`] | its loop, energy and wear per cycle; Masing's rule |
//! | [`partial_slip`] | the same for any one-dimensional profile, by quadrature |
//! | [`limiting_profile`] | what is left of a paraboloid after endless fretting |
//! | [`line_contact`] | a cylinder on a flat: Hertz, partial slip, limit, gross slip |
//! | [`dual_oscillation`] | permanent stick under normal and tangential oscillation |
//! | [`half_space`] | stresses inside: Hertz in closed form, any traction by its point forces |
//! | [`abel_pairs`], [`pair_catalogue`] | analytic pairs of the transforms (1), (2), (3) |
//! | [`elementary`], [`quadrature`] | gamma, κ, bisection; the adaptive integral |
//! | [`special`] | erf, Dawson, Bessel |

pub mod abel_pairs;
pub mod cattaneo_mindlin;
pub mod dual_oscillation;
pub mod elementary;
pub mod flat_punch;
pub mod fretting_loop;
pub mod half_space;
pub mod limiting_profile;
pub mod line_contact;
pub mod pair_catalogue;
pub mod partial_slip;
pub mod power_law;
mod quadrature;
mod special;
pub mod truncated;
