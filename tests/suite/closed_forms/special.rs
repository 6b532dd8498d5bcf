//! Special functions of the analytic pairs: erf, Dawson's integral, the Bessel function I₀.
//!
//! Abramowitz & Stegun (1964) 7.1.6, 7.1.25 ff. for erf and Dawson, 9.6.12 and 9.7.1 for I₀. Only series with positive
//! terms are summed, so nothing cancels. Relative error below 2e-14 where not said otherwise.

use std::f64::consts::{FRAC_2_SQRT_PI, PI};

/// erf(z) = (2/√π) ∫₀ᶻ e^(−t²) dt, dimensionless, odd.
pub fn erf(z: f64) -> f64 {
    if z.abs() > 6.5 {
        return z.signum();
    }
    // e^(−z²) Σ 2ᵏ z^(2k+1) / (2k+1)!!
    let (mut term, mut sum, mut k) = (z, z, 0.0);
    while term.abs() > 1e-18 * sum.abs() {
        k += 1.0;
        term *= 2.0 * z * z / (2.0 * k + 1.0);
        sum += term;
    }
    FRAC_2_SQRT_PI * (-z * z).exp() * sum
}

/// Dawson's integral D(z) = e^(−z²) ∫₀ᶻ e^(t²) dt, dimensionless, odd.
pub fn dawson(z: f64) -> f64 {
    let square = z * z;
    if z.abs() > 10.0 {
        // 1/(2z) Σ (2k−1)!! / (2z²)ᵏ, cut far before its smallest term (k ≈ z² > 100).
        let (mut term, mut sum) = (1.0, 1.0);
        for k in 1..20u8 {
            term *= (2.0 * f64::from(k) - 1.0) / (2.0 * square);
            sum += term;
        }
        return sum / (2.0 * z);
    }
    let (mut power, mut sum, mut k) = (z, z, 0.0);
    loop {
        k += 1.0;
        power *= square / k;
        let term = power / (2.0 * k + 1.0);
        sum += term;
        if term.abs() <= 1e-18 * sum.abs() || term.is_nan() {
            return (-square).exp() * sum;
        }
    }
}

/// e^(−y) I₀(y), dimensionless, for y ≥ 0: the scaled modified Bessel function. NaN for y < 0.
pub fn bessel_i0_scaled(y: f64) -> f64 {
    if y.is_nan() || y < 0.0 {
        return f64::NAN;
    }
    if y > 30.0 {
        // Σ ((2k−1)!!)² / (k! (8y)ᵏ) / √(2πy); its smallest term is at k ≈ 2y.
        let (mut term, mut sum) = (1.0, 1.0);
        for k in 1..30u8 {
            let k = f64::from(k);
            term *= (2.0 * k - 1.0) * (2.0 * k - 1.0) / (8.0 * y * k);
            sum += term;
        }
        return sum / (2.0 * PI * y).sqrt();
    }
    let (mut term, mut sum, mut k) = (1.0, 1.0, 0.0);
    while term > 1e-18 * sum {
        k += 1.0;
        term *= 0.25 * y * y / (k * k);
        sum += term;
    }
    (-y).exp() * sum
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
    fn erf_against_its_integral_and_table() {
        close(erf(0.5), 0.520_499_877_813_046_5, 1e-15);
        close(erf(1.0), 0.842_700_792_949_714_9, 1e-15);
        close(erf(3.0), 0.999_977_909_503_001_4, 1e-14);
        for z in [1e-9, 0.1, 1.7, 4.0, 6.0] {
            let numeric = FRAC_2_SQRT_PI * integrate(|t| (-t * t).exp(), 0.0, z);
            close(erf(z), numeric, 1e-13);
            assert_eq!(erf(-z), -erf(z));
        }
        assert_eq!((erf(0.0), erf(7.0)), (0.0, 1.0));
    }

    #[test]
    fn dawson_against_its_integral_on_both_branches() {
        close(dawson(1.0), 0.538_079_506_912_768_4, 1e-14);
        for z in [1e-6, 0.3, 2.0, 5.0, 9.999, 10.001, 20.0] {
            let numeric = integrate(|t| ((t - z) * (t + z)).exp(), 0.0, z);
            close(dawson(z), numeric, 1e-12);
        }
        assert_eq!(dawson(0.0), 0.0);
    }

    #[test]
    fn bessel_against_its_integral_on_both_branches() {
        close(
            bessel_i0_scaled(1.0),
            1.266_065_877_752_008_4 / 1f64.exp(),
            1e-14,
        );
        for y in [0.0, 1e-3, 4.0, 29.9, 30.1, 200.0] {
            let numeric = integrate(|t: f64| (y * (t.cos() - 1.0)).exp(), 0.0, PI) / PI;
            close(bessel_i0_scaled(y), numeric, 1e-13);
        }
        assert!(bessel_i0_scaled(-1.0).is_nan());
    }
}
