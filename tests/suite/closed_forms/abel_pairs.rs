//! Analytic pairs of the three transforms: each an input and its image.
//!
//! Sources: Popov & Heß (2015), chs. 3 and 7; Bracewell (2000), table of Abel transforms; Li et al.
//! (2019) for the equations:
//! - (1) f → g(x) = |x| ∫₀^|x| f′(r)/√(x²−r²) dr,
//! - (2) u → w(r) = (2/π) ∫₀ʳ u(x)/√(r²−x²) dx, the inverse of (1),
//! - (3) q → p(r) = −(1/π) ∫ᵣ^∞ q′(x)/√(x²−r²) dx, with q(a⁻)/(π√(a²−r²)) for a jump at a.
//!
//! Functions are named `g_of_…`, `w_of_…`, `p_of_…` after the input. Lengths in m; inputs have the unit in parentheses,
//! which (1) and (2) keep and (3) divides by m. Radii are non-negative, parameters positive. [`super::pair_catalogue`]
//! lists the pairs, ready for a conformance suite.

use super::elementary::{angle_beyond, kappa, leg};
use super::power_law::{displacement_integral, pressure_integral};
use super::special::{bessel_i0_scaled, dawson, erf};
use std::f64::consts::PI;

// (1) ------------------------------------------------------------------------------------------

/// (1) of f = rⁿ (mⁿ), n > 0: g = κₙ xⁿ.
pub fn g_of_power(n: f64, x: f64) -> f64 {
    kappa(n) * x.abs().powf(n)
}

/// (1) of f = max(r − b, 0) (m): g = x acos(b/x) beyond b; f kinks at b.
pub fn g_of_ramp(b: f64, x: f64) -> f64 {
    x.abs() * angle_beyond(b, x.abs())
}

/// (1) of f = max(r² − b², 0) (m²): g = 2x√(x²−b²) beyond b; f kinks at b.
pub fn g_of_square_ramp(b: f64, x: f64) -> f64 {
    2.0 * x.abs() * leg(x.abs(), b)
}

/// (1) of f = 1 − e^(−r²/σ²) (1): g = 2(x/σ) D(x/σ), D Dawson's integral.
pub fn g_of_gauss(sigma: f64, x: f64) -> f64 {
    2.0 * (x / sigma) * dawson(x / sigma)
}

// (2) ------------------------------------------------------------------------------------------

/// (2) of u = xⁿ (mⁿ), n ≥ 0: w = rⁿ/κₙ.
pub fn w_of_power(n: f64, r: f64) -> f64 {
    r.powf(n) / kappa(n)
}

/// (2) of u = 1 for x < a, 0 beyond (1): w = 1 up to a, (2/π) asin(a/r) beyond.
pub fn w_of_box(a: f64, r: f64) -> f64 {
    if r <= a {
        1.0
    } else {
        2.0 / PI * displacement_integral(0.0, a, r)
    }
}

/// (2) of u = max(a − x, 0) (m): w = (2/π)[a asin(m/r) − (r − √(r²−m²))], m = min(a, r); u kinks at
/// a and in its even continuation at 0.
pub fn w_of_cut_line(a: f64, r: f64) -> f64 {
    let end = a.min(r);
    2.0 / PI * (a * displacement_integral(0.0, end, r) - displacement_integral(1.0, end, r))
}

/// (2) of u = max(a² − x², 0) (m²): w = a² − r²/2 up to a, beyond (1/π)[(2a²−r²) asin(a/r) + a√(r²−a²)]; the Hertzian
/// displacement without the factor 1/R.
pub fn w_of_cut_parabola(a: f64, r: f64) -> f64 {
    if r <= a {
        return a * a - 0.5 * r * r;
    }
    ((2.0 * a * a - r * r) * (a / r).asin() + a * leg(r, a)) / PI
}

/// (2) of u = max(x − b, 0) (m): w = (2/π)[√(r²−b²) − b acos(b/r)] beyond b.
pub fn w_of_ramp(b: f64, r: f64) -> f64 {
    2.0 / PI * (leg(r, b) - b * angle_beyond(b, r))
}

/// (2) of u = max(x² − b², 0) (m²): w = (1/π)[(r²−2b²) acos(b/r) + b√(r²−b²)] beyond b; the slip of the paraboloid
/// without the factor λ/R.
pub fn w_of_square_ramp(b: f64, r: f64) -> f64 {
    if r <= b {
        return 0.0;
    }
    ((r * r - 2.0 * b * b) * angle_beyond(b, r) + b * leg(r, b)) / PI
}

/// (2) of u = e^(−x²/σ²) (1): w = e^(−y) I₀(y), y = r²/(2σ²).
pub fn w_of_gauss(sigma: f64, r: f64) -> f64 {
    bessel_i0_scaled(0.5 * (r / sigma) * (r / sigma))
}

// (3) ------------------------------------------------------------------------------------------

/// (3) of q = (a² − x²)ⁿ for x < a, 0 beyond (m²ⁿ), n ≥ 0: p = (n B(n, ½)/π)(a²−r²)^(n−½), where
/// n B(n, ½) = κ₂ₙ; n = 0 is the punch (jump at a), n = 1 Hertz.
///
/// At r = a: +∞ for n < ½, 1/2 for n = ½, 0 above.
pub fn p_of_cut_power(a: f64, n: f64, r: f64) -> f64 {
    if r > a {
        return 0.0;
    }
    kappa(2.0 * n) / PI * leg(a, r).powf(2.0 * n - 1.0)
}

/// (3) of q = aᵐ − xᵐ for x < a, 0 beyond (mᵐ), m > 0: p = (m/π) ∫ᵣᵃ x^(m−1)/√(x²−r²) dx.
///
/// m = 1: acosh(a/r)/π, the cone, +∞ at r = 0; m = 2: Hertz; m = 4: the quartic.
pub fn p_of_cut_difference(a: f64, m: f64, r: f64) -> f64 {
    if r >= a {
        return 0.0;
    }
    m / PI * pressure_integral(m - 1.0, a, r)
}

/// (3) of q = e^(−x²/σ²) (1): p = e^(−r²/σ²)/(σ√π).
pub fn p_of_gauss(sigma: f64, r: f64) -> f64 {
    (-(r / sigma) * (r / sigma)).exp() / (sigma * PI.sqrt())
}

/// (3) of q = e^(−x²/σ²) − e^(−a²/σ²) for x < a, 0 beyond (1):
/// p = e^(−r²/σ²) erf(√(a²−r²)/σ)/(σ√π).
pub fn p_of_cut_gauss(a: f64, sigma: f64, r: f64) -> f64 {
    p_of_gauss(sigma, r) * erf(leg(a, r) / sigma)
}

#[cfg(test)]
mod tests {
    use super::super::quadrature::integrate;
    use super::*;
    use std::f64::consts::{FRAC_PI_2, SQRT_2};

    fn close(value: f64, exact: f64, relative: f64, what: &str) {
        let error = (value - exact).abs();
        assert!(
            error <= relative * exact.abs(),
            "{what}: {value:e} against {exact:e}"
        );
    }

    #[test]
    fn equation_1_by_its_integral() {
        // r = x sin t.
        let g = |slope: &dyn Fn(f64) -> f64, b: f64, x: f64| {
            let start = (b / x).min(1.0).asin();
            x * integrate(|t| slope(x * t.sin()), start, FRAC_PI_2)
        };
        for x in [0.3, 1.2, 2.9] {
            for n in [1.0, 2.0, 2.5, 3.0, 4.0, 7.0] {
                let slope = |r: f64| n * r.powf(n - 1.0);
                close(g_of_power(n, -x), g(&slope, 0.0, x), 1e-11, "power");
            }
            let slope = |r: f64| 2.0 * r / 0.49 * (-r * r / 0.49).exp();
            close(g_of_gauss(0.7, x), g(&slope, 0.0, x), 1e-12, "gauss");
            let (ramp, square) = (g_of_ramp(1.0, x), g_of_square_ramp(1.0, x));
            close(ramp, g(&|_| 1.0, 1.0, x), 1e-12, "ramp");
            close(square, g(&|r| 2.0 * r, 1.0, x), 1e-12, "square ramp");
        }
    }

    #[test]
    fn equation_2_by_its_integral() {
        // x = r sin t, broken at the kink.
        let w = |u: &dyn Fn(f64) -> f64, kink: f64, r: f64| {
            let middle = (kink / r).min(1.0).asin();
            let f = |t: f64| u(r * t.sin());
            2.0 / PI * (integrate(f, 0.0, middle) + integrate(f, middle, FRAC_PI_2))
        };
        for r in [0.3, 0.999, 1.001, 1.2, 2.9] {
            for n in [0.0, 1.0, 2.0, 2.5, 3.0, 4.0, 7.0] {
                close(w_of_power(n, r), w(&|x| x.powf(n), 0.0, r), 1e-11, "power");
            }
            let gauss = |x: f64| (-x * x / 0.49).exp();
            close(w_of_gauss(0.7, r), w(&gauss, 0.0, r), 1e-12, "gauss");
            let inside = |x: f64| if x < 1.0 { 1.0 } else { 0.0 };
            close(w_of_box(1.0, r), w(&inside, 1.0, r), 1e-12, "box");
            let line = |x: f64| (1.0 - x).max(0.0);
            close(w_of_cut_line(1.0, r), w(&line, 1.0, r), 1e-12, "line");
            let parabola = |x: f64| (1.0 - x * x).max(0.0);
            close(
                w_of_cut_parabola(1.0, r),
                w(&parabola, 1.0, r),
                1e-11,
                "parabola",
            );
            let ramp = |x: f64| (x - 1.0).max(0.0);
            close(w_of_ramp(1.0, r), w(&ramp, 1.0, r), 2e-9, "ramp");
            let square = |x: f64| (x * x - 1.0).max(0.0);
            close(
                w_of_square_ramp(1.0, r),
                w(&square, 1.0, r),
                2e-9,
                "square ramp",
            );
        }
    }

    #[test]
    fn equation_3_by_its_integral() {
        // x² = r² + s² sin² t, s = √(a²−r²): −q′ dx/√(x²−r²) = −(q′/x) s cos t dt.
        let a: f64 = 1.3;
        for r in [1e-3, 0.3, 0.9, 1.29] {
            let s = (a * a - r * r).sqrt();
            let p = |slope_by_x: &dyn Fn(f64) -> f64| {
                let f = |t: f64| -slope_by_x(r.hypot(s * t.sin())) * s * t.cos();
                integrate(f, 0.0, FRAC_PI_2) / PI
            };
            for n in [1.0, 1.5, 2.0, 3.0, 5.0] {
                // −q′/x = 2n (a²−x²)^(n−1); a² − x² = s² cos² t, so it is written in t.
                let f = |t: f64| 2.0 * n * (s * t.cos()).powf(2.0 * n - 2.0) * s * t.cos();
                let exact = integrate(f, 0.0, FRAC_PI_2) / PI;
                close(p_of_cut_power(a, n, r), exact, 1e-12, "cut power");
            }
            for m in [1.0, 2.0, 2.5, 3.0, 4.0, 6.0] {
                let exact = p(&|x| -m * x.powf(m - 2.0));
                close(p_of_cut_difference(a, m, r), exact, 1e-10, "difference");
            }
            let exact = p(&|x| -2.0 / 0.49 * (-x * x / 0.49).exp());
            close(p_of_cut_gauss(a, 0.7, r), exact, 1e-12, "cut gauss");
        }
        close(
            p_of_cut_gauss(9.0, 0.7, 0.4),
            p_of_gauss(0.7, 0.4),
            1e-15,
            "uncut",
        );
    }

    #[test]
    fn pairs_that_are_known_by_other_names() {
        close(
            p_of_cut_power(2.0, 0.0, 1.0),
            1.0 / (PI * 3f64.sqrt()),
            1e-15,
            "punch",
        );
        close(
            p_of_cut_power(2.0, 1.0, 1.0),
            2.0 / PI * 3f64.sqrt(),
            1e-15,
            "Hertz",
        );
        close(
            p_of_cut_power(2.0, 0.5, 1.0),
            0.5,
            1e-15,
            "n = ½ is constant",
        );
        close(
            p_of_cut_difference(2.0, 1.0, 1.0),
            2f64.acosh() / PI,
            1e-15,
            "cone",
        );
        close(
            p_of_cut_difference(2.0, 2.0, 0.7),
            p_of_cut_power(2.0, 1.0, 0.7),
            1e-15,
            "m = 2",
        );
        close(w_of_box(1.0, SQRT_2), 0.5, 1e-15, "punch outside");
        // (2) undoes (1).
        close(
            w_of_power(2.7, 1.3) * g_of_power(2.7, 1.0),
            1.3f64.powf(2.7),
            1e-14,
            "inverse",
        );
    }

    #[test]
    fn axis_and_edges() {
        assert_eq!((g_of_power(2.0, 0.0), w_of_power(0.0, 0.0)), (0.0, 1.0));
        assert_eq!((g_of_gauss(0.5, 0.0), w_of_gauss(0.5, 0.0)), (0.0, 1.0));
        assert_eq!(
            (g_of_ramp(1.0, 1.0), g_of_square_ramp(1.0, 0.5)),
            (0.0, 0.0)
        );
        assert_eq!(
            (w_of_ramp(1.0, 0.5), w_of_square_ramp(1.0, 1.0)),
            (0.0, 0.0)
        );
        assert_eq!(
            (w_of_box(1.0, 0.0), w_of_cut_parabola(1.0, 0.0)),
            (1.0, 1.0)
        );
        close(w_of_cut_line(1.0, 0.0), 1.0, 1e-15, "w(0) = u(0)");
        assert_eq!(p_of_cut_difference(1.0, 1.0, 0.0), f64::INFINITY);
        close(
            p_of_cut_difference(1.0, 4.0, 0.0),
            4.0 / (3.0 * PI),
            1e-15,
            "quartic axis",
        );
        assert_eq!(
            (p_of_cut_power(1.0, 0.0, 1.0), p_of_cut_power(1.0, 2.0, 1.0)),
            (f64::INFINITY, 0.0)
        );
        assert_eq!(
            (p_of_cut_power(1.0, 0.0, 2.0), p_of_cut_gauss(1.0, 0.5, 2.0)),
            (0.0, 0.0)
        );
    }
}
