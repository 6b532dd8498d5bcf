//! Special functions the closed forms need.
//!
//! Source: Lanczos (1964) with Godfrey's coefficients (g = 7, 9 terms) for Γ. Relative error below 2e-14 where not said
//! otherwise.

use std::f64::consts::{FRAC_PI_2, PI};

/// Godfrey's coefficients for g = 7.
const LANCZOS: [f64; 9] = [
    0.999_999_999_999_809_9,
    676.520_368_121_885_1,
    -1_259.139_216_722_402_8,
    771.323_428_777_653_1,
    -176.615_029_162_140_6,
    12.507_343_278_686_905,
    -0.138_571_095_265_720_12,
    9.984_369_578_019_572e-6,
    1.505_632_735_149_311_6e-7,
];

/// Γ(x), dimensionless, for real x; NaN at the poles x = 0, −1, −2, … (and for NaN).
pub fn gamma(x: f64) -> f64 {
    if x <= 0.0 && x == x.floor() {
        return f64::NAN;
    }
    if x < 0.5 {
        return PI / ((PI * x).sin() * gamma(1.0 - x));
    }
    let z = x - 1.0;
    let sum = (1..9u8).fold(LANCZOS[0], |sum, i| {
        sum + LANCZOS[usize::from(i)] / (z + f64::from(i))
    });
    let t = z + 7.5;
    // Half the power twice: no overflow before Γ itself overflows.
    let half_power = t.powf(0.5 * (z + 0.5));
    (2.0 * PI).sqrt() * sum * half_power * (-t).exp() * half_power
}

/// κₙ = √π Γ(n/2 + 1) / Γ(n/2 + ½), dimensionless, for n ≥ 0: the factor of f = A rⁿ → g = κₙ A xⁿ.
///
/// Source: Popov & Heß (2015), ch. 3. Table: κ₀ = 1, κ₁ = π/2, κ₂ = 2, κ₃ = 3π/4, κ₄ = 8/3. Exact to rounding at
/// integers by the recurrence κₙ = κₙ₋₂ n/(n − 1), which also reduces any other n to 0 < n ≤ 2. Equals n·B(n/2, ½)/2,
/// so m B(m, ½) = κ₂ₘ. NaN for n < 0 or n > 1e6.
pub fn kappa(n: f64) -> f64 {
    if !(0.0..=1e6).contains(&n) {
        return f64::NAN;
    }
    let (mut m, mut factor) = (n, 1.0);
    while m > 2.0 {
        factor *= m / (m - 1.0);
        m -= 2.0;
    }
    let base = if m == 0.0 {
        1.0
    } else if m == 1.0 {
        FRAC_PI_2
    } else if m == 2.0 {
        2.0
    } else {
        PI.sqrt() * gamma(0.5 * m + 1.0) / gamma(0.5 * m + 0.5)
    };
    factor * base
}

/// acosh(a/r) for 0 ≤ r ≤ a, dimensionless: +∞ at r = 0, 0 at r = a, no overflow, and no loss of
/// digits near r = a. NaN outside.
pub fn acosh_ratio(a: f64, r: f64) -> f64 {
    if !(r >= 0.0 && r <= a) {
        return f64::NAN;
    }
    let s = leg(a, r);
    if r < 0.5 * a {
        (a + s).ln() - r.ln()
    } else if r > 0.0 {
        (s / r).asinh()
    } else {
        f64::NAN
    }
}

/// max(x, 0), but NaN stays NaN, unlike in `f64::max`.
pub fn positive_part(x: f64) -> f64 {
    if x < 0.0 { 0.0 } else { x }
}

/// √(a² − r²) as √((a − r)(a + r)), in the unit of a; 0 for r > a.
pub fn leg(a: f64, r: f64) -> f64 {
    positive_part((a - r) * (a + r)).sqrt()
}

/// acos(c/r) for 0 ≤ c ≤ r, rad, from the legs of its triangle: no loss of digits near c = r.
/// 0 for c ≥ r > 0; π/2 at c = 0 (also at r = 0, the limit r → 0 of a vanished c).
pub fn angle_beyond(c: f64, r: f64) -> f64 {
    if c == 0.0 {
        return FRAC_PI_2;
    }
    leg(r, c).atan2(c)
}

/// Finds where `is_below` turns from true to false between `low` and `high`, by bisection to machine precision.
pub fn bisect(mut low: f64, mut high: f64, is_below: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        match low < middle && middle < high {
            false => return high,
            true if is_below(middle) => low = middle,
            true => high = middle,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::quadrature::integrate;
    use super::*;

    fn close(value: f64, exact: f64, relative: f64) {
        assert!(
            (value - exact).abs() <= relative * exact.abs(),
            "{value:e} against {exact:e}"
        );
    }

    #[test]
    fn gamma_at_integers_half_integers_and_below_zero() {
        let mut factorial = 1.0;
        for n in 1..=20u8 {
            close(gamma(f64::from(n)), factorial, 5e-15);
            factorial *= f64::from(n);
        }
        close(gamma(0.5), PI.sqrt(), 2e-15);
        close(gamma(2.5), 0.75 * PI.sqrt(), 5e-15);
        close(gamma(-0.5), -2.0 * PI.sqrt(), 5e-15);
        close(gamma(1.0 / 3.0), 2.678_938_534_707_747_6, 5e-15);
        close(gamma(171.0), 7.257_415_615_307_999e306, 1e-12);
        assert!(gamma(0.0).is_nan() && gamma(-3.0).is_nan());
    }

    #[test]
    fn kappa_table_its_integral_and_its_range() {
        for (n, exact) in [
            (0.0, 1.0),
            (1.0, FRAC_PI_2),
            (2.0, 2.0),
            (3.0, 0.75 * PI),
            (4.0, 8.0 / 3.0),
            (6.0, 3.2),
        ] {
            close(kappa(n), exact, 4e-16);
        }
        for n in [1.0, 1.5, 2.0, 2.7, 3.3, 5.0, 9.25] {
            // g(1) of f = rⁿ by (1) with r = sin t.
            let g = integrate(|t: f64| n * t.sin().powf(n - 1.0), 0.0, FRAC_PI_2);
            close(kappa(n), g, 1e-11);
        }
        // Large n: κ ~ √(πn/2)(1 + 1/(4n)).
        close(kappa(1e4), (PI * 5e3).sqrt() * (1.0 + 2.5e-5), 1e-8);
        assert!(kappa(-1.0).is_nan() && kappa(f64::NAN).is_nan());
    }

    #[test]
    fn triangles_keep_their_digits_near_the_edge() {
        let step = 2f64.powi(-40);
        close(acosh_ratio(1.0 + step, 1.0), (2.0 * step).sqrt(), 1e-12);
        close(angle_beyond(1.0, 1.0 + step), (2.0 * step).sqrt(), 1e-12);
        for r in [1e-3, 0.3, 0.6, 0.9] {
            close(acosh_ratio(1.0, r), (1.0 / r).acosh(), 1e-14);
            close(angle_beyond(r, 1.0), r.acos(), 1e-14);
        }
        assert_eq!(acosh_ratio(1.0, 0.0), f64::INFINITY);
        assert_eq!((acosh_ratio(1.0, 1.0), leg(1.0, 2.0)), (0.0, 0.0));
        assert!(acosh_ratio(1.0, 1.1).is_nan() && acosh_ratio(0.0, 0.0).is_nan());
        assert!(leg(1.0, f64::NAN).is_nan() && positive_part(f64::NAN).is_nan());
        assert_eq!((positive_part(-2.0), positive_part(3.0)), (0.0, 3.0));
        assert_eq!(angle_beyond(0.0, 0.0), FRAC_PI_2);
    }
}
