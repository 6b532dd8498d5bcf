//! Values over two axes as colours.

use super::axis::{Axis, Scale};
use super::colormap::ColorMap;

/// How many words a map can tell apart.
pub const WORDS: usize = 4;

/// Values on a grid of places, as colours; NaN stays blank.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The quantity and its unit.
    pub quantity: Axis,
    /// The abscissae and the ordinates of the grid, monotonic.
    pub places: [Vec<f64>; 2],
    /// The values, abscissa by abscissa for each ordinate.
    pub values: Vec<f64>,
    /// The colours.
    pub colors: ColorMap,
    /// The words that the values are the numbers of, from 0 on, at most [`WORDS`];
    /// empty where the values are quantities.
    pub words: Vec<&'static str>,
}

impl Map {
    /// The values at the ends of the colours.
    pub fn range(&self) -> [f64; 2] {
        let is_log = self.quantity.scale == Scale::Log;
        let shown = self.values.iter().copied();
        let shown = shown.filter(|value| self.quantity.scale.has(*value));
        let first = if is_log {
            [f64::INFINITY, 0.0]
        } else {
            [0.0; 2]
        };
        let [low, high] = shown.fold(first, |[low, high], v| [low.min(v), high.max(v)]);
        match is_log {
            true if low < high => [low, high],
            true => [0.1, 10.0],
            false => self.colors.range([low, high]),
        }
    }

    /// Where a value lies between the ends of the colours, 0 to 1.
    pub fn share(&self, value: f64, range: [f64; 2]) -> f64 {
        if !self.words.is_empty() {
            return (value + 0.5) / WORDS as f64;
        }
        let scale = self.quantity.scale;
        let [low, high] = range.map(|end| scale.spread(end));
        (scale.spread(value) - low) / (high - low)
    }
}
