//! Linearly implicit steps: second order, and damped however stiff they are.
//!
//! # Formula
//!
//! The W-method ROS2 of J. G. Verwer, E. J. Spee, J. G. Blom, W. Hundsdorfer (1999), SIAM J. Sci. Comput. 20, 1456–1480,
//! doi 10.1137/S1064827597326651. For y′ = F(y) ≥ 0 on y ≥ 0 with A ≈ −∂F/∂y and γ = 1 − 1/√2
//!
//! ```text
//! (1 + γhA) k₁ = F(y)
//! (1 + γhA) k₂ = F(y + h k₁) − 2 k₁
//! y_{n+1} = y + h (3/2 k₁ + ½ k₂)
//! (1 + γhA) error ≈ y_n − y_{n+1} + ½ h (F_n + F_{n+1})
//! ```
//!
//! The order is two for any A; stiff parts are damped as far as A knows them. Where F(y + h k₁) is zero, the contact is
//! lost: the first stage has gone too far, and the second one takes it back by the slope that A expects there,
//! [k₁ − (1 − γ) F(y)]/γ < 0.
//!
//! - **Cost**: one evaluation for y_{n+1}, one more for F_{n+1}, which the next step begins with; three systems.

use std::f64::consts::FRAC_1_SQRT_2;

/// γ.
pub const GAMMA: f64 = 1.0 - FRAC_1_SQRT_2;

/// One step of length `h` from `y` with the slope `first` there: y_{n+1}. `solve` makes b into (1 + γhA)⁻¹ b; `slope`
/// writes F into its second argument, as long as `y`; if it fails, so does the step.
pub fn step<E>(
    h: f64,
    y: &[f64],
    first: &[f64],
    mut solve: impl FnMut(&[f64]) -> Vec<f64>,
    slope: impl FnOnce(&[f64], &mut [f64]) -> Result<(), E>,
) -> Result<Vec<f64>, E> {
    let one = solve(first);
    let stage = y.iter().zip(&one).map(|(y, one)| (y + h * one).max(0.0));
    let mut second = vec![0.0; y.len()];
    slope(&stage.collect::<Vec<_>>(), &mut second)?;
    for (second, (first, one)) in second.iter_mut().zip(first.iter().zip(&one)) {
        if *second == 0.0 {
            *second = ((one - (1.0 - GAMMA) * first) / GAMMA).min(0.0);
        }
        *second -= 2.0 * one;
    }
    let slopes = one.into_iter().zip(solve(&second));
    let end = y.iter().zip(slopes);
    Ok(end
        .map(|(y, (one, two))| (y + h * (1.5 * one + 0.5 * two)).max(0.0))
        .collect())
}

/// The error that a step from `y` to `next` has made, before it is filtered by (1 + γhA)⁻¹: component by component.
pub fn defect(h: f64, ends: [&[f64]; 2], slopes: [&[f64]; 2]) -> Vec<f64> {
    let [y, next] = ends;
    let slopes = slopes[0].iter().zip(slopes[1]);
    let pairs = y.iter().zip(next).zip(slopes);
    pairs
        .map(|((y, next), (first, last))| y - next + 0.5 * h * (first + last))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// Integrates y′ = F(y) up to x = 1, with `a` as the approximate derivative.
    fn run(steps: usize, start: f64, f: impl Fn(f64) -> f64, a: f64) -> f64 {
        let h = 1.0 / steps as f64;
        let mut y = vec![start];
        for _ in 0..steps {
            let solve = |b: &[f64]| vec![b[0] / (1.0 + GAMMA * h * a)];
            let slope = |y: &[f64], out: &mut [f64]| {
                out[0] = f(y[0]);
                Ok::<(), Infallible>(())
            };
            let Ok(next) = step(h, &y, &[f(y[0])], solve, slope);
            y = next;
        }
        y[0]
    }

    #[test]
    fn the_order_is_two_for_any_response() {
        for a in [0.0, 0.5, 3.0, 10.0] {
            // y′ = exp(−y), y(0) = 0: y(1) = ln 2.
            let error = |steps| (run(steps, 0.0, |y| (-y).exp(), a) - 2.0_f64.ln()).abs();
            let order = (error(40) / error(80)).log2();
            assert!((order - 2.0).abs() < 0.15, "{a}: {order}");
        }
    }

    /// y → 1, where F has vanished; beyond it nothing draws y back.
    #[test]
    fn a_stiff_step_ends_where_the_slope_does() {
        for rate in [1e2, 1e4, 1e8] {
            let end = run(1, 0.0, |y| rate * (1.0 - y).max(0.0), rate);
            assert!((end - 1.0).abs() < 5.0 / rate, "{rate}: {end}");
        }
    }

    #[test]
    fn the_error_is_that_of_the_step() {
        let (h, f) = (0.1_f64, |y: f64| 1.0 - y);
        let solve = |b: &[f64]| vec![b[0] / (1.0 + GAMMA * h)];
        let slope = |y: &[f64], out: &mut [f64]| {
            out[0] = f(y[0]);
            Ok::<(), Infallible>(())
        };
        let Ok(end) = step(h, &[0.0], &[1.0], solve, slope);
        let made = 1.0 - (-h).exp() - end[0];
        let estimated = solve(&defect(h, [&[0.0], &end], [&[1.0], &[f(end[0])]]))[0];
        assert!(
            (0.5..2.0).contains(&(estimated / made).abs()),
            "{estimated} {made}"
        );
    }
}
