//! Bounds of an axis or of colours in a live run, held for a whole period of the motion.

use crate::plot::sticky_bounds;

/// Bounds, and the range of the data since they were last checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Held {
    /// The bounds to draw with.
    pub bounds: [f64; 2],
    seen: [f64; 2],
    /// The cycle at which this range begins.
    pub since: f64,
}

impl Held {
    /// Makes bounds for the range of a first frame, at `cycle`.
    pub fn new([low, high]: [f64; 2], cycle: f64) -> Self {
        Self {
            bounds: sticky_bounds(None, low, high),
            seen: [low, high],
            since: cycle,
        }
    }

    /// Adds the range of a frame at `cycle`. The bounds grow at once, but shrink only if a whole period leaves half of
    /// them empty.
    pub fn include(&mut self, [low, high]: [f64; 2], cycle: f64) {
        if cycle < self.since {
            (self.seen, self.since) = ([low, high], cycle);
        }
        let [lowest, highest] = self.seen;
        self.seen = [lowest.min(low), highest.max(high)];
        // A range symmetric about zero gets symmetric bounds, even if it was one-sided at first.
        if low == -high && high > 0.0 {
            let most = self.bounds[1].max(-self.bounds[0]);
            self.bounds = [-most, most];
        }
        let grows = low < self.bounds[0] || high > self.bounds[1];
        let is_over = cycle - self.since >= 1.0;
        if grows || is_over {
            let [a, b] = if is_over {
                self.seen
            } else {
                // Data already within the bounds stay within them.
                [low.min(self.bounds[0]), high.max(self.bounds[1])]
            };
            self.bounds = sticky_bounds(Some(self.bounds), a, b);
        }
        if is_over {
            (self.seen, self.since) = ([low, high], cycle);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A motion that begins to one side, and then swings to both.
    #[test]
    fn bounds_of_a_swing_are_symmetric() {
        let mut held = Held::new([0.0, 7.0], 0.0);
        for step in 0..300 {
            let most = 7.0 + 0.01 * f64::from(step);
            held.include([-most, most], f64::from(step) / 100.0);
            let [low, high] = held.bounds;
            assert!(low == -high && high >= most && high < 16.0, "{held:?}");
        }
    }

    #[test]
    fn bounds_hold_for_a_period_and_follow_a_trend() {
        let start = Held::new([0.0, 0.1], 0.0);
        // A stress that comes and goes within each cycle, and decreases from cycle to cycle.
        let (mut held, mut changes) = (start, Vec::new());
        for step in 0..=2000 {
            let cycle = f64::from(step) / 100.0;
            let swing = (std::f64::consts::TAU * cycle).sin().abs();
            let before = held.bounds;
            held.include([0.0, swing * (-cycle / 5.0).exp()], cycle);
            if held.bounds != before {
                changes.push(cycle);
            }
        }
        let early = changes.iter().filter(|&&cycle| cycle < 1.0).count();
        assert!(early <= 6, "{changes:?}");
        let late: Vec<f64> = changes
            .iter()
            .copied()
            .filter(|&cycle| cycle > 1.0)
            .collect();
        assert!(
            late.windows(2).all(|pair| pair[1] - pair[0] > 1.0),
            "{late:?}"
        );
        assert!((2..=6).contains(&late.len()), "{late:?}");
        assert!(held.bounds[1] < 0.1);
    }
}
