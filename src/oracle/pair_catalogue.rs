//! The analytic pairs as a table: one dimensionless instance each, for a conformance suite.
//!
//! Lengths in units of the break point (a or b = 1) where there is one. A suite samples `source` on
//! 0 … `domain`, transforms, and compares with `image`. `kinks` are the places where the source or
//! its even continuation loses smoothness, the sort that decides the observed order; 0 in it means
//! an odd power at the axis. The image at `singular` is infinite and must be left out.

use super::abel_pairs::*;

/// The transform of a pair, by the paper's equation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transform {
    /// (1): f(r) → g(x).
    ProfileToMdr,
    /// (2): u(x) → w(r).
    LineToSurface,
    /// (3): q(x) → p(r).
    LoadToStress,
}

/// One source and its exact image, dimensionless.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// A short name, unique within the table.
    pub name: &'static str,
    /// Which transform.
    pub transform: Transform,
    /// Where to sample: 0 … domain; a (3) source vanishes beyond (below 1e-16 for a Gaussian).
    pub domain: f64,
    /// Places of lost smoothness of the source, ascending.
    pub kinks: &'static [f64],
    /// Where the image is infinite, if anywhere.
    pub singular: Option<f64>,
    /// What goes in.
    pub source: fn(f64) -> f64,
    /// What must come out.
    pub image: fn(f64) -> f64,
}

/// A (1) or (2) row on 0 … 2.
const fn row(
    name: &'static str,
    transform: Transform,
    kinks: &'static [f64],
    source: fn(f64) -> f64,
    image: fn(f64) -> f64,
) -> Pair {
    Pair {
        name,
        transform,
        domain: 2.0,
        kinks,
        singular: None,
        source,
        image,
    }
}

/// A (3) row on 0 … 1, cut at 1.
const fn cut(
    name: &'static str,
    kinks: &'static [f64],
    singular: Option<f64>,
    source: fn(f64) -> f64,
    image: fn(f64) -> f64,
) -> Pair {
    Pair {
        name,
        transform: Transform::LoadToStress,
        domain: 1.0,
        kinks,
        singular,
        source,
        image,
    }
}

use Transform::{LineToSurface, LoadToStress, ProfileToMdr};

fn below(x: f64) -> f64 {
    (1.0 - x * x).max(0.0)
}

fn gauss(x: f64) -> f64 {
    (-4.0 * x * x).exp()
}

/// Every pair.
pub const PAIRS: &[Pair] = &[
    row("cone", ProfileToMdr, &[0.0], |r| r, |x| g_of_power(1.0, x)),
    row(
        "paraboloid",
        ProfileToMdr,
        &[],
        |r| r * r,
        |x| g_of_power(2.0, x),
    ),
    row(
        "cubic",
        ProfileToMdr,
        &[0.0],
        |r| r.powi(3),
        |x| g_of_power(3.0, x),
    ),
    row(
        "quartic",
        ProfileToMdr,
        &[],
        |r| r.powi(4),
        |x| g_of_power(4.0, x),
    ),
    row(
        "power-2.5",
        ProfileToMdr,
        &[0.0],
        |r| r.powf(2.5),
        |x| g_of_power(2.5, x),
    ),
    row(
        "dimple",
        ProfileToMdr,
        &[],
        |r| 1.0 - gauss(r),
        |x| g_of_gauss(0.5, x),
    ),
    row(
        "ramp",
        ProfileToMdr,
        &[1.0],
        |r| (r - 1.0).max(0.0),
        |x| g_of_ramp(1.0, x),
    ),
    row(
        "square-ramp",
        ProfileToMdr,
        &[1.0],
        |r| (r * r - 1.0).max(0.0),
        |x| g_of_square_ramp(1.0, x),
    ),
    row(
        "constant",
        LineToSurface,
        &[],
        |_| 1.0,
        |r| w_of_power(0.0, r),
    ),
    row("line", LineToSurface, &[0.0], |x| x, |r| w_of_power(1.0, r)),
    row(
        "square",
        LineToSurface,
        &[],
        |x| x * x,
        |r| w_of_power(2.0, r),
    ),
    row(
        "fourth",
        LineToSurface,
        &[],
        |x| x.powi(4),
        |r| w_of_power(4.0, r),
    ),
    row("bell", LineToSurface, &[], gauss, |r| w_of_gauss(0.5, r)),
    row(
        "box",
        LineToSurface,
        &[1.0],
        |x| if x <= 1.0 { 1.0 } else { 0.0 },
        |r| w_of_box(1.0, r),
    ),
    row(
        "cut-line",
        LineToSurface,
        &[0.0, 1.0],
        |x| (1.0 - x).max(0.0),
        |r| w_of_cut_line(1.0, r),
    ),
    row("cut-parabola", LineToSurface, &[1.0], below, |r| {
        w_of_cut_parabola(1.0, r)
    }),
    row(
        "late-line",
        LineToSurface,
        &[1.0],
        |x| (x - 1.0).max(0.0),
        |r| w_of_ramp(1.0, r),
    ),
    row(
        "slip",
        LineToSurface,
        &[1.0],
        |x| (x * x - 1.0).max(0.0),
        |r| w_of_square_ramp(1.0, r),
    ),
    cut(
        "punch",
        &[1.0],
        Some(1.0),
        |x| if x <= 1.0 { 1.0 } else { 0.0 },
        |r| p_of_cut_power(1.0, 0.0, r),
    ),
    cut("hertz", &[1.0], None, below, |r| {
        p_of_cut_power(1.0, 1.0, r)
    }),
    cut(
        "hertz-squared",
        &[1.0],
        None,
        |x| below(x).powi(2),
        |r| p_of_cut_power(1.0, 2.0, r),
    ),
    cut(
        "hertz-cubed",
        &[1.0],
        None,
        |x| below(x).powi(3),
        |r| p_of_cut_power(1.0, 3.0, r),
    ),
    cut(
        "love",
        &[0.0, 1.0],
        Some(0.0),
        |x| (1.0 - x).max(0.0),
        |r| p_of_cut_difference(1.0, 1.0, r),
    ),
    cut(
        "cut-cubic",
        &[0.0, 1.0],
        None,
        |x| (1.0 - x.powi(3)).max(0.0),
        |r| p_of_cut_difference(1.0, 3.0, r),
    ),
    cut(
        "cut-quartic",
        &[1.0],
        None,
        |x| (1.0 - x.powi(4)).max(0.0),
        |r| p_of_cut_difference(1.0, 4.0, r),
    ),
    cut(
        "cut-gauss",
        &[1.0],
        None,
        |x| (gauss(x) - gauss(1.0)).max(0.0),
        |r| p_of_cut_gauss(1.0, 0.5, r),
    ),
    Pair {
        name: "gauss",
        transform: LoadToStress,
        domain: 3.5,
        kinks: &[],
        singular: None,
        source: gauss,
        image: |r| p_of_gauss(0.5, r),
    },
];

#[cfg(test)]
mod tests {
    use super::super::quadrature::integrate;
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// (2) of any function, x = r sin t, broken at the kinks.
    fn surface(u: fn(f64) -> f64, kinks: &[f64], r: f64) -> f64 {
        let mut edges = vec![0.0];
        edges.extend(kinks.iter().map(|k| (k / r).min(1.0).asin()));
        edges.push(FRAC_PI_2);
        // t = edge + s² takes a root just past a kink away.
        let part = |e: &[f64]| {
            let f = |s: f64| 2.0 * s * u(r * (e[0] + s * s).sin());
            integrate(f, 0.0, (e[1] - e[0]).max(0.0).sqrt())
        };
        2.0 / PI * edges.windows(2).map(part).sum::<f64>()
    }

    /// q back from p: q(x) = 2∫ₓᵃ r p(r)/√(r²−x²) dr, with r² = x² + s² sin² t, s² = a² − x².
    fn load(p: fn(f64) -> f64, a: f64, x: f64) -> f64 {
        let s = ((a - x) * (a + x)).sqrt();
        let f = |t: f64| p(x.hypot(s * t.sin())) * s * t.cos();
        // The punch's edge: finite in t, but r rounds to a in the last sliver.
        let end = FRAC_PI_2 - 1e-4;
        2.0 * (integrate(f, 0.0, end) + 1e-4 * f(end))
    }

    #[test]
    fn every_row_holds_by_an_integral_without_derivatives() {
        for pair in PAIRS {
            for at in [0.11, 0.5, 0.83, 0.97].map(|t| t * pair.domain) {
                let (value, exact) = match pair.transform {
                    // (2) undoes (1).
                    Transform::ProfileToMdr => {
                        (surface(pair.image, pair.kinks, at), (pair.source)(at))
                    }
                    Transform::LineToSurface => {
                        (surface(pair.source, pair.kinks, at), (pair.image)(at))
                    }
                    Transform::LoadToStress => {
                        (load(pair.image, pair.domain, at), (pair.source)(at))
                    }
                };
                let error = (value - exact).abs();
                assert!(
                    error < 2e-9,
                    "{} at {at}: {value} against {exact}",
                    pair.name
                );
            }
        }
    }

    #[test]
    fn rows_are_finite_named_once_and_vanish_where_said() {
        for (i, pair) in PAIRS.iter().enumerate() {
            assert!(
                PAIRS[..i]
                    .iter()
                    .all(|other| { (other.name, other.transform) != (pair.name, pair.transform) })
            );
            for k in 0..=64u8 {
                let at = pair.domain * f64::from(k) / 64.0;
                assert!(
                    (pair.source)(at).is_finite(),
                    "{} source at {at}",
                    pair.name
                );
                let finite = (pair.image)(at).is_finite();
                assert_eq!(finite, pair.singular != Some(at), "{} at {at}", pair.name);
            }
            if pair.transform == Transform::LoadToStress {
                let past = pair.domain + 1e-9;
                assert!((pair.source)(past).abs() < 1e-16, "{}", pair.name);
                assert!((pair.image)(past).abs() < 1e-15, "{}", pair.name);
            }
        }
    }
}
