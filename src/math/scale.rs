//! Linear and logarithmic scales.

use serde::Deserialize;

/// How values spread along an axis of a plot or a study; scenarios name them `linear` and `log`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// Equal differences take equal distances.
    #[default]
    Linear,
    /// Equal ratios take equal distances; values that are not positive leave gaps.
    Log,
}

impl Scale {
    /// Whether an axis can show the value.
    pub fn has(self, value: f64) -> bool {
        value.is_finite() && (self == Self::Linear || value > 0.0)
    }

    /// Maps a value to its position along an axis.
    pub fn spread(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log => value.log10(),
        }
    }

    /// Maps a position along an axis back to its value.
    pub fn unspread(self, spread: f64) -> f64 {
        match self {
            Self::Linear => spread,
            Self::Log => 10f64.powf(spread),
        }
    }
}
