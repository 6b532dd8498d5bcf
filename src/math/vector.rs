//! Runs loops with the widest SIMD that the CPU supports.

use multiversion::{multiversion, target::target_cfg_f};

/// Runs `pass`, compiled for the common instruction sets, with the widest that this CPU supports.
///
/// Only inlined code gains: the closure and its callees should be `#[inline(always)]`. Results are the same bit for bit
/// on all CPUs, since the compiler never fuses a multiplication with an addition.
#[inline(always)]
pub fn vectorized<R>(pass: impl FnOnce() -> R) -> R {
    with_widest(
        #[inline(always)]
        |_| pass(),
    )
}

/// As [`vectorized`], for a `pass` that fuses multiplications with additions itself; passes whether FMA is available.
#[multiversion(targets("x86_64+avx2+fma+bmi1+bmi2"))]
pub fn with_widest<R>(pass: impl FnOnce(Fusing) -> R) -> R {
    pass(Fusing(target_cfg_f!(any(
        target_feature = "fma",
        target_arch = "aarch64"
    ))))
}

/// Whether the CPU has fused multiply-add. Emulating it would take a hundred times as long.
#[derive(Debug, Clone, Copy)]
pub struct Fusing(bool);

impl Fusing {
    /// Returns a b + c in every lane.
    ///
    /// Loops by index: tests are not optimised across codegen units, where each iterator would be a call.
    #[inline(always)]
    pub fn multiply_add<const LANES: usize>(
        self,
        a: &[f64; LANES],
        b: &[f64; LANES],
        c: &[f64; LANES],
    ) -> [f64; LANES] {
        let mut sums = *c;
        for lane in 0..LANES {
            sums[lane] = if self.0 {
                a[lane].mul_add(b[lane], sums[lane])
            } else {
                a[lane] * b[lane] + sums[lane]
            };
        }
        sums
    }
}

/// Writes `of(a, b)` of each pair into `out`; all slices have equal lengths.
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

/// Adds `more` to `values`, slices of equal length.
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
