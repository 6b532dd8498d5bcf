//! The 1-2-5 grid, on which ticks and rounded bounds lie.

/// A step of the grid, 1, 2 or 5 times a power of ten, by its index: 0 is 1, 1 is 2, 2 is 5, 3 is 10.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Step(pub(crate) i32);

impl Step {
    /// Returns the largest step not above `size` (positive and finite).
    pub(crate) fn at_most(size: f64) -> Step {
        let decade = 3 * size.log10().floor().clamp(-306.0, 306.0) as i32;
        let bound = size * (1.0 + 1e-9);
        // The logarithm may be off by one unit in the last place, so the next decade is tried, too.
        let mut steps = (decade..=decade + 3).rev().map(Step);
        let found = steps.find(|step| step.value() <= bound);
        found.unwrap_or(Step(decade - 1))
    }

    /// Returns the smallest step above `size` (positive and finite).
    pub(crate) fn above(size: f64) -> Step {
        Step(Self::at_most(size).0 + 1)
    }

    /// Returns 1, 2 or 5.
    pub(super) fn mantissa(self) -> u8 {
        [1, 2, 5][self.0.rem_euclid(3) as usize]
    }

    /// Returns the power of ten.
    pub(super) fn exponent(self) -> i32 {
        self.0.div_euclid(3)
    }

    /// Returns the step's size.
    pub(crate) fn value(self) -> f64 {
        self.multiple(1.0)
    }

    /// Returns `count` times the step, rounded only once where a decimal fraction allows it.
    pub(super) fn multiple(self, count: f64) -> f64 {
        let digits = count * f64::from(self.mantissa());
        match self.exponent() {
            exponent @ ..0 => digits / 10f64.powi(-exponent),
            exponent => digits * 10f64.powi(exponent),
        }
    }

    /// Returns `count` steps as text, with exactly the decimals that the step needs; zero is `0`.
    pub(super) fn label(self, count: f64) -> String {
        if count == 0.0 {
            return "0".to_owned();
        }
        let decimals = self.exponent().min(0).unsigned_abs() as usize;
        format!("{:.*}", decimals, self.multiple(count))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps() {
        for step in (-90..90).map(Step) {
            assert_eq!(Step::at_most(step.value()), step);
            assert_eq!(Step::at_most(step.value() * 1.9), step);
            assert!([1, 2, 5].contains(&step.mantissa()));
            assert!(Step(step.0 + 1).value() >= 1.99 * step.value());
            assert_eq!(Step(step.0 + 3).exponent(), step.exponent() + 1);
            assert!(Step::at_most(step.value() * 0.99).value() < step.value());
        }
    }
}
