//! The map from values to dots.

use super::axis::Scale;

/// The map from values to dots for one axis laid over a number of cells.
///
/// Dots are counted from the left or from the bottom; the centre of dot `i` is at position `i`. The bounds lie on the
/// centres of the first and the last dot, so a value falls on the dot with the nearest centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// The values at the two ends, in the data's unit.
    pub bounds: [f64; 2],
    /// Linear or logarithmic.
    pub scale: Scale,
    /// The number of cells.
    pub cells: u16,
    /// The number of dots per cell along the axis.
    pub dots_per_cell: u16,
}

/// Positions are clamped to this distance; a line to a clamped point is just as steep.
const FAR: f64 = 1e12;

impl Window {
    /// Maps `bounds` (increasing, and positive on a log scale) to `cells` cells of `dots_per_cell` dots.
    pub fn new(bounds: [f64; 2], scale: Scale, cells: u16, dots_per_cell: u16) -> Self {
        Window {
            bounds,
            scale,
            cells,
            dots_per_cell,
        }
    }

    /// Returns the number of dots.
    pub fn dots(&self) -> usize {
        usize::from(self.cells) * usize::from(self.dots_per_cell)
    }

    /// Returns the distance from the first dot to the last one, in cells.
    pub(super) fn height(&self) -> f64 {
        (self.dots() as f64 - 1.0) / f64::from(self.dots_per_cell)
    }

    /// Returns the position of `value` in dots, also outside the window; `None` for values that are not finite, or not
    /// positive on a log scale.
    pub fn position(&self, value: f64) -> Option<f64> {
        if !self.scale.has(value) {
            return None;
        }
        let [at, lo, hi] =
            [value, self.bounds[0], self.bounds[1]].map(|v| self.scale.spread(v) / 2.0);
        let share = (at - lo) / (hi - lo);
        let position = match self.dots() {
            0 => return None,
            // A single dot represents the whole window, but nothing outside it.
            1 => (share - 0.5) * 0.999,
            dots => share * (dots - 1) as f64,
        };
        (!position.is_nan()).then(|| position.clamp(-FAR, FAR))
    }

    /// Returns the relative position of `value` between the ends, 0 to 1 inside; `None` if it has no position.
    pub fn share(&self, value: f64) -> Option<f64> {
        let last = (self.dots().max(2) - 1) as f64;
        self.position(value).map(|dots| dots / last)
    }

    /// Returns the dot nearest to `value`; `None` outside the window.
    pub fn dot(&self, value: f64) -> Option<usize> {
        let dot = self.position(value)?.round();
        (dot >= 0.0 && dot < self.dots() as f64).then_some(dot as usize)
    }

    /// Returns the cell that holds the dot nearest to `value`; `None` outside the window.
    pub fn cell(&self, value: f64) -> Option<u16> {
        let dot = self.dot(value)?;
        Some((dot / usize::from(self.dots_per_cell)) as u16)
    }

    /// Returns the value at a position in dots: the inverse of [`position`](Self::position).
    pub fn value(&self, position: f64) -> f64 {
        let [lo, hi] = self.bounds.map(|v| self.scale.spread(v));
        let share = match self.dots() {
            0 | 1 => 0.5,
            dots => position / (dots - 1) as f64,
        };
        self.scale.unspread(lo * (1.0 - share) + hi * share)
    }

    /// Returns the value in the middle of one of the `parts` into which each cell is divided.
    pub fn middle(&self, part: u16, parts: u16) -> f64 {
        let dots = f64::from(self.dots_per_cell) / f64::from(parts);
        let middle = (f64::from(part) + 0.5) * dots - 0.5;
        self.value(middle.clamp(0.0, self.dots().max(1) as f64 - 1.0))
    }

    /// Returns the position in dots of the middle of cell `index`.
    pub fn cell_middle(&self, index: u16) -> f64 {
        let dots = f64::from(self.dots_per_cell);
        (f64::from(index) + 0.5) * dots - 0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_land_on_the_nearest_dot() {
        for (cells, per_cell) in [(1, 1), (1, 2), (7, 1), (40, 2), (200, 4)] {
            let window = Window::new([-3.0, 5.0], Scale::Linear, cells, per_cell);
            let last = (window.dots() - 1) as f64;
            assert_eq!(window.dot(-3.0), Some(0));
            assert_eq!(window.dot(5.0), Some(window.dots() - 1));
            for i in 0..=1000 {
                let value = -3.0 + 8.0 * f64::from(i) / 1000.0;
                let exact = (value + 3.0) / 8.0 * last;
                let dot = window.dot(value).expect("a dot") as f64;
                assert!((dot - exact).abs() <= 0.5 + 1e-9);
            }
            assert_eq!(window.dot(14.0), None);
            assert_eq!(window.dot(-12.0), None);
        }
    }

    #[test]
    fn values_and_positions_are_inverse() {
        for scale in [Scale::Linear, Scale::Log] {
            let window = Window::new([2e-3, 5e3], scale, 40, 2);
            for position in [0.0, 0.5, 17.25, 79.0] {
                let back = window.position(window.value(position)).expect("a place");
                assert!((back - position).abs() < 1e-9, "{scale:?}: {back}");
            }
        }
    }

    #[test]
    fn places_without_meaning() {
        let log = Window::new([1e-3, 1e3], Scale::Log, 10, 2);
        assert_eq!(log.position(0.0), None);
        assert_eq!(log.position(-1.0), None);
        assert_eq!(log.position(1.0), Some(9.5));
        let narrow = Window::new([0.0, 1e-300], Scale::Linear, 10, 2);
        assert_eq!(narrow.position(1e300), Some(FAR));
        assert_eq!(narrow.position(f64::INFINITY), None);
        assert_eq!(
            Window::new([0.0, 1.0], Scale::Linear, 0, 2).position(0.5),
            None
        );
    }
}
