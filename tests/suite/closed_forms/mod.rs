//! Closed forms that tests alone judge by, beside those of [`mdr_tui::oracle`], which they may use.
//!
//! | file | problem |
//! |---|---|
//! | [`dual_oscillation`] | permanent stick under normal and tangential oscillation |
//! | [`half_space`] | stresses inside: Hertz in closed form, any traction by its point forces |
//! | [`abel_pairs`], [`pair_catalogue`] | analytic pairs of the transforms (1), (2), (3) |
//! | [`special`] | erf, Dawson, Bessel |

pub mod abel_pairs;
pub mod dual_oscillation;
pub mod half_space;
pub mod pair_catalogue;
mod special;
