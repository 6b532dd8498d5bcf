//! The 1-2-5 grid, on which ticks and rounded bounds lie.

/// A step of the 1-2-5 grid: 1, 2 or 5 times a power of ten.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Step {
    /// 1, 2 or 5.
    pub(super) mantissa: u8,
    /// The power of ten.
    pub(super) exponent: i32,
}

impl Step {
    /// The largest step that is not above `size` (positive and finite).
    pub(super) fn at_most(size: f64) -> Step {
        let exponent = size.log10().floor().clamp(-306.0, 306.0) as i32;
        let step = |mantissa| Step { mantissa, exponent };
        let bound = size * (1.0 + 1e-9);
        // The logarithm may be off by one unit in the last place: allow the next decade.
        let (finer, coarser) = (step(5).finer().finer().finer(), step(5).coarser());
        [coarser, step(5), step(2), step(1)]
            .into_iter()
            .find(|step| step.value() <= bound)
            .unwrap_or(finer)
    }

    /// The step's size.
    pub(super) fn value(self) -> f64 {
        self.multiple(1.0)
    }

    /// `count` times the step, rounded once where a decimal fraction allows it.
    pub(super) fn multiple(self, count: f64) -> f64 {
        let digits = count * f64::from(self.mantissa);
        if self.exponent < 0 {
            digits / 10f64.powi(-self.exponent)
        } else {
            digits * 10f64.powi(self.exponent)
        }
    }

    /// The next step up.
    pub(super) fn coarser(self) -> Step {
        let (mantissa, carry) = match self.mantissa {
            1 => (2, 0),
            2 => (5, 0),
            _ => (1, 1),
        };
        let exponent = self.exponent + carry;
        Step { mantissa, exponent }
    }

    /// The next step down.
    pub(super) fn finer(self) -> Step {
        let (mantissa, carry) = match self.mantissa {
            5 => (2, 0),
            2 => (1, 0),
            _ => (5, 1),
        };
        let exponent = self.exponent - carry;
        Step { mantissa, exponent }
    }

    /// `count` steps as text, with just the decimals the step needs; zero is `0`.
    pub(super) fn label(self, count: f64) -> String {
        if count == 0.0 {
            return "0".to_owned();
        }
        let decimals = self.exponent.min(0).unsigned_abs() as usize;
        format!("{:.*}", decimals, self.multiple(count))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps() {
        for exponent in -30..30 {
            for mantissa in [1, 2, 5] {
                let step = Step { mantissa, exponent };
                assert_eq!(Step::at_most(step.value()), step);
                assert_eq!(Step::at_most(step.value() * 1.9), step);
                assert_eq!(step.coarser().finer(), step);
                assert!(Step::at_most(step.value() * 0.99).value() < step.value());
            }
        }
    }
}
