//! Runs loops with the widest SIMD that the CPU supports.

use fearless_simd::{Level, dispatch};

/// Runs `pass`, compiled once for every instruction set, for that of this processor.
///
/// Only what is inlined gains by it: the closure, and what it calls, should be `#[inline(always)]`. The results
/// are the same to the last bit on all of them: the compiler fuses no multiplication with an addition.
#[inline(always)]
pub fn vectorized<R>(pass: impl FnOnce() -> R) -> R {
    dispatch!(Level::new(), _simd => pass())
}

/// Writes what `of` makes of each pair of values into `out`, as many of the one as of the others.
#[inline(always)]
pub fn write_each(out: &mut [f64], a: &[f64], b: &[f64], of: impl Fn(f64, f64) -> f64) {
    vectorized(
        #[inline(always)]
        || {
            for (out, (a, b)) in out.iter_mut().zip(a.iter().zip(b)) {
                *out = of(*a, *b);
            }
        },
    );
}

/// Adds `more` to `values`, as many of the one as of the other.
pub fn add_to(values: &mut [f64], more: &[f64]) {
    vectorized(
        #[inline(always)]
        || {
            for (value, more) in values.iter_mut().zip(more) {
                *value += more;
            }
        },
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pass_is_run_once_and_gives_what_it_gives() {
        let mut runs = 0;
        let values = [1.0, 2.0, 4.0];
        let sum: f64 = vectorized(
            #[inline(always)]
            || {
                runs += 1;
                values.iter().sum()
            },
        );
        assert_eq!((sum, runs), (7.0, 1));
    }
}
