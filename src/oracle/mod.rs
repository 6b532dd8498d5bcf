//! Closed forms to test against; they share no code with what they test.
//!
//! Everything here imports `std` only (and its own neighbours in this folder). Pure functions and
//! small structs, SI units, `f64`. If a problem has no closed form, the defining integral is
//! computed by adaptive quadrature, its singularity removed by substitution. Equation numbers are
//! those of Li, Forsbach & Benad (2019), doi 10.22190/FUME190103012L.
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
//! | [`special`], [`quadrature`] | gamma, κ, bisection; the adaptive integral |
//!
//! Arguments outside a function's domain give NaN, never a panic; each item says so where it
//! can happen.

pub mod cattaneo_mindlin;
pub mod flat_punch;
pub mod fretting_loop;
pub mod limiting_profile;
pub mod line_contact;
pub mod partial_slip;
pub mod power_law;
pub mod quadrature;
pub mod special;
pub mod truncated;
