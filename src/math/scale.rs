//! Linear and logarithmic scales.

use serde::Deserialize;

/// How values spread along an axis, of a plot or of a study, where `linear` and `log` name them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// Equal differences, equal distances.
    #[default]
    Linear,
    /// Equal ratios, equal distances; values that are not positive are gaps.
    Log,
}

impl Scale {
    /// Whether a value lies anywhere along an axis.
    pub fn has(self, value: f64) -> bool {
        value.is_finite() && (self == Self::Linear || value > 0.0)
    }

    /// A value as it is spread along an axis.
    pub fn spread(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log => value.log10(),
        }
    }

    /// The value that is spread to `spread`.
    pub fn unspread(self, spread: f64) -> f64 {
        match self {
            Self::Linear => spread,
            Self::Log => 10f64.powf(spread),
        }
    }
}
