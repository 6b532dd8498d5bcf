//! The analytic pairs as a table: one dimensionless instance each, for a conformance suite.
//!
//! Lengths are in units of the break point (a or b = 1) if there is one. A suite samples [`Pair::source`] on 0 …
//! `domain`, transforms it, and compares with [`Pair::image`]. `kinks` lists where the source or its even continuation
//! loses smoothness, which decides the observed order; a 0 stands for an odd power at the axis. The image is infinite
//! at `singular`, which must be left out.

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

/// A source as a function of x.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Source {
    /// xⁿ.
    Power(f64),
    /// e^(−x²/σ²), σ = [`SIGMA`].
    Gauss,
    /// 1 minus the Gaussian.
    Dimple,
    /// x − 1 beyond 1.
    Ramp,
    /// x² − 1 beyond 1.
    SquareRamp,
    /// (1 − x²)ⁿ up to 1.
    CutPower(f64),
    /// 1 − xᵐ up to 1.
    CutDifference(f64),
    /// e^(−x²/σ²) − e^(−1/σ²) up to 1.
    CutGauss,
}

use super::pair_catalogue::Source::{
    CutDifference, CutGauss, CutPower, Dimple, Gauss, Power, Ramp, SquareRamp,
};
use super::pair_catalogue::Transform::{LineToSurface, LoadToStress, ProfileToMdr};

/// σ of the Gaussians.
const SIGMA: f64 = 0.5;

/// One source and its exact image, dimensionless.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// Short name, unique per transform.
    pub name: &'static str,
    /// The transform.
    pub transform: Transform,
    source: Source,
    /// Where to sample: 0 … domain; a (3) source vanishes beyond (below 1e-16 for a Gaussian).
    pub domain: f64,
    /// Places where the source loses smoothness, ascending.
    pub kinks: &'static [f64],
    /// Where the image is infinite, if anywhere.
    pub singular: Option<f64>,
}

const fn pair(name: &'static str, transform: Transform, source: Source) -> Pair {
    let kinks: &[f64] = match source {
        Gauss | Dimple => &[],
        Power(n) if n % 2.0 == 0.0 => &[],
        Power(_) => &[0.0],
        CutDifference(m) if m % 2.0 != 0.0 => &[0.0, 1.0],
        _ => &[1.0],
    };
    Pair {
        name,
        transform,
        source,
        domain: match (transform, source) {
            (LoadToStress, Gauss) => 3.5,
            (LoadToStress, _) => 1.0,
            _ => 2.0,
        },
        kinks,
        singular: match (transform, source) {
            (LoadToStress, CutPower(0.0)) => Some(1.0),
            (LoadToStress, CutDifference(1.0)) => Some(0.0),
            _ => None,
        },
    }
}

/// All pairs.
pub const PAIRS: &[Pair] = &[
    pair("cone", ProfileToMdr, Power(1.0)),
    pair("paraboloid", ProfileToMdr, Power(2.0)),
    pair("cubic", ProfileToMdr, Power(3.0)),
    pair("quartic", ProfileToMdr, Power(4.0)),
    pair("power-2.5", ProfileToMdr, Power(2.5)),
    pair("dimple", ProfileToMdr, Dimple),
    pair("ramp", ProfileToMdr, Ramp),
    pair("square-ramp", ProfileToMdr, SquareRamp),
    pair("constant", LineToSurface, Power(0.0)),
    pair("line", LineToSurface, Power(1.0)),
    pair("square", LineToSurface, Power(2.0)),
    pair("fourth", LineToSurface, Power(4.0)),
    pair("bell", LineToSurface, Gauss),
    pair("box", LineToSurface, CutPower(0.0)),
    pair("cut-line", LineToSurface, CutDifference(1.0)),
    pair("cut-parabola", LineToSurface, CutPower(1.0)),
    pair("late-line", LineToSurface, Ramp),
    pair("slip", LineToSurface, SquareRamp),
    pair("punch", LoadToStress, CutPower(0.0)),
    pair("hertz", LoadToStress, CutPower(1.0)),
    pair("hertz-squared", LoadToStress, CutPower(2.0)),
    pair("hertz-cubed", LoadToStress, CutPower(3.0)),
    pair("love", LoadToStress, CutDifference(1.0)),
    pair("cut-cubic", LoadToStress, CutDifference(3.0)),
    pair("cut-quartic", LoadToStress, CutDifference(4.0)),
    pair("cut-gauss", LoadToStress, CutGauss),
    pair("gauss", LoadToStress, Gauss),
];

impl Pair {
    /// Returns the source at x.
    pub fn source(&self, x: f64) -> f64 {
        let bell = |x: f64| (-(x / SIGMA).powi(2)).exp();
        match self.source {
            CutPower(_) | CutDifference(_) | CutGauss if x > 1.0 => 0.0,
            Power(n) => x.powf(n),
            Gauss => bell(x),
            Dimple => 1.0 - bell(x),
            Ramp => (x - 1.0).max(0.0),
            SquareRamp => (x * x - 1.0).max(0.0),
            CutPower(n) => (1.0 - x * x).powf(n),
            CutDifference(m) => 1.0 - x.powf(m),
            CutGauss => bell(x) - bell(1.0),
        }
    }

    /// Returns the exact image at x; NaN for a source without a closed form here.
    pub fn image(&self, x: f64) -> f64 {
        match (self.transform, self.source) {
            (ProfileToMdr, Power(n)) => g_of_power(n, x),
            (ProfileToMdr, Dimple) => g_of_gauss(SIGMA, x),
            (ProfileToMdr, Ramp) => g_of_ramp(1.0, x),
            (ProfileToMdr, SquareRamp) => g_of_square_ramp(1.0, x),
            (LineToSurface, Power(n)) => w_of_power(n, x),
            (LineToSurface, Gauss) => w_of_gauss(SIGMA, x),
            (LineToSurface, CutPower(0.0)) => w_of_box(1.0, x),
            (LineToSurface, CutPower(1.0)) => w_of_cut_parabola(1.0, x),
            (LineToSurface, CutDifference(1.0)) => w_of_cut_line(1.0, x),
            (LineToSurface, Ramp) => w_of_ramp(1.0, x),
            (LineToSurface, SquareRamp) => w_of_square_ramp(1.0, x),
            (LoadToStress, CutPower(n)) => p_of_cut_power(1.0, n, x),
            (LoadToStress, CutDifference(m)) => p_of_cut_difference(1.0, m, x),
            (LoadToStress, CutGauss) => p_of_cut_gauss(1.0, SIGMA, x),
            (LoadToStress, Gauss) => p_of_gauss(SIGMA, x),
            _ => f64::NAN,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::quadrature::integrate;
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// Applies (2) to any function, with x = r sin t, split at the kinks.
    fn surface(u: impl Fn(f64) -> f64, kinks: &[f64], r: f64) -> f64 {
        let mut edges = vec![0.0];
        edges.extend(kinks.iter().map(|k| (k / r).min(1.0).asin()));
        edges.push(FRAC_PI_2);
        // t = edge + s² removes a root just past a kink.
        let part = |e: &[f64]| {
            let f = |s: f64| 2.0 * s * u(r * (e[0] + s * s).sin());
            integrate(f, 0.0, (e[1] - e[0]).max(0.0).sqrt())
        };
        2.0 / PI * edges.windows(2).map(part).sum::<f64>()
    }

    /// Inverts p to q: q(x) = 2∫ₓᵃ r p(r)/√(r²−x²) dr, with r² = x² + s² sin² t, s² = a² − x².
    fn load(p: impl Fn(f64) -> f64, a: f64, x: f64) -> f64 {
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
                let source = |x: f64| pair.source(x);
                let image = |x: f64| pair.image(x);
                let (value, exact) = match pair.transform {
                    // (2) undoes (1).
                    Transform::ProfileToMdr => (surface(image, pair.kinks, at), pair.source(at)),
                    Transform::LineToSurface => (surface(source, pair.kinks, at), pair.image(at)),
                    Transform::LoadToStress => (load(image, pair.domain, at), pair.source(at)),
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
                assert!(pair.source(at).is_finite(), "{} source at {at}", pair.name);
                let finite = pair.image(at).is_finite();
                assert_eq!(finite, pair.singular != Some(at), "{} at {at}", pair.name);
            }
            if pair.transform == Transform::LoadToStress {
                let past = pair.domain + 1e-9;
                assert!(pair.source(past).abs() < 1e-16, "{}", pair.name);
                assert!(pair.image(past).abs() < 1e-15, "{}", pair.name);
            }
        }
    }
}
