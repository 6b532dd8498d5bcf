//! Finds the root of a monotone function: by [`newton`] if its slope is known (the depth that carries a load), by
//! values alone with [`bracketed`], or exactly with [`first`] where speed does not matter.

/// Maximum number of evaluations per solve; a smooth monotone function needs about ten.
const MAX_EVALUATIONS: usize = 200;

/// Finds x in [`low`, `high`] with `function(x)` = 0, given that the signs at the ends differ.
///
/// The Illinois form of regula falsi: superlinear, derivative-free, never leaves its bracket.
/// Reference: M. Dowell, P. Jarratt (1971), BIT 11, 168–174, doi 10.1007/BF01934364.
///
/// Stops when the bracket is no wider than `tolerance` or the function is exactly zero.
/// Returns `None` when the ends do not bracket a root or a value is not finite.
pub fn bracketed(
    mut function: impl FnMut(f64) -> f64,
    low: f64,
    high: f64,
    tolerance: f64,
) -> Option<f64> {
    let (mut a, mut b) = (low, high);
    let (mut at_a, mut at_b) = (function(a), function(b));
    if !(at_a.is_finite() && at_b.is_finite()) {
        return None;
    }
    if at_a == 0.0 {
        return Some(a);
    }
    if at_b == 0.0 {
        return Some(b);
    }
    if at_a.signum() == at_b.signum() {
        return None;
    }
    // The end kept in the last evaluation; its value is halved if it is kept twice.
    let mut kept_a = None;
    for _ in 0..MAX_EVALUATIONS {
        if (b - a).abs() <= tolerance {
            break;
        }
        let secant = (a * at_b - b * at_a) / (at_b - at_a);
        let inside = secant > a.min(b) && secant < a.max(b);
        let x = if inside { secant } else { 0.5 * (a + b) };
        if x == a || x == b {
            break;
        }
        let at_x = function(x);
        if !at_x.is_finite() {
            return None;
        }
        if at_x == 0.0 {
            return Some(x);
        }
        if at_x.signum() == at_b.signum() {
            (b, at_b) = (x, at_x);
            if kept_a == Some(true) {
                at_a *= 0.5;
            }
            kept_a = Some(true);
        } else {
            (a, at_a) = (x, at_x);
            if kept_a == Some(false) {
                at_b *= 0.5;
            }
            kept_a = Some(false);
        }
        if (at_x / (at_b - at_a)).abs() * (b - a).abs() <= 0.25 * tolerance {
            return Some(x);
        }
    }
    Some(if at_a.abs() < at_b.abs() { a } else { b })
}

/// Finds x between `low` and `high` with `function(x)` = 0 by Newton's method from `near`. The function rises and is
/// negative at `low`; it returns its value and its slope, which may be rough.
///
/// If a step leaves the bracket, bisects instead. Stops when a step is no longer than `tolerance` or the function is
/// exactly zero. Returns `None` when the function is negative at `high` or a value is not finite.
pub fn newton(
    mut function: impl FnMut(f64) -> [f64; 2],
    near: f64,
    [low, high]: [f64; 2],
    tolerance: f64,
) -> Option<f64> {
    let (mut below, mut above) = (low, f64::INFINITY);
    let mut x = if near > low && near < high {
        near
    } else {
        high
    };
    for _ in 0..MAX_EVALUATIONS {
        let [value, slope] = function(x);
        if !value.is_finite() || value < 0.0 && x >= high {
            return None;
        }
        if value < 0.0 {
            below = x;
        } else {
            above = x;
        }
        let next = (x - value / slope).min(high);
        if (next - x).abs() <= tolerance || above - below <= tolerance {
            return Some(x);
        }
        let is_inside = next > below && next < above;
        x = if is_inside {
            next
        } else {
            0.5 * (below + above.min(high))
        };
    }
    Some(x)
}

/// Returns the first number in an interval from which on `beyond` holds, by bisection; the upper end if there is none.
pub fn first([mut low, mut high]: [f64; 2], beyond: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if beyond(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_depth_of_a_hertzian_load() {
        // F = d^{3/2} is steep and has a kink at zero, like a contact.
        let mut evaluations = 0;
        let depth = bracketed(
            |d| {
                evaluations += 1;
                d.max(0.0).powf(1.5) - 0.3
            },
            -1.0,
            5.0,
            1e-14,
        )
        .expect("a root");
        assert!((depth - 0.3f64.powf(2.0 / 3.0)).abs() < 1e-13);
        assert!(evaluations < 40, "{evaluations} evaluations");
    }

    #[test]
    fn refuses_what_brackets_nothing() {
        assert_eq!(bracketed(|x| x * x + 1.0, -1.0, 1.0, 1e-12), None);
        assert_eq!(bracketed(|_| f64::NAN, -1.0, 1.0, 1e-12), None);
    }

    #[test]
    fn takes_a_root_at_an_end() {
        assert_eq!(bracketed(|x| x, 0.0, 1.0, 1e-12), Some(0.0));
        assert_eq!(bracketed(|x| x - 1.0, 0.0, 1.0, 1e-12), Some(1.0));
    }

    #[test]
    fn the_first_number_is_exact() {
        assert_eq!(first([0.0, 7.0], |x| x * x >= 2.0), 2f64.sqrt());
        assert_eq!(first([0.0, 7.0], |_| false), 7.0);
        assert!(first([0.0, 7.0], |_| true) <= f64::MIN_POSITIVE);
    }
}
