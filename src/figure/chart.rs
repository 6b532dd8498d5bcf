//! One chart: axes, curves, a map of values, an inset; owned, whatever it was made from.

use super::ink::{Ink, REGIME_INKS};
use crate::plot::Scale;
use crate::plot::axis::nice_bounds;
use crate::plot::colormap::ColorMap;

/// What an axis shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The quantity.
    pub label: String,
    /// The unit of the data, without prefix; empty for pure numbers.
    pub unit: &'static str,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// The values at the ends; `None` takes them from the data.
    pub bounds: Option<[f64; 2]>,
    /// Whether the ordinate grows downwards.
    pub downwards: bool,
}

impl Axis {
    /// A linear axis that takes its bounds from the data.
    pub fn new(label: &str, unit: &'static str) -> Self {
        Self {
            label: label.to_owned(),
            unit,
            scale: Scale::Linear,
            bounds: None,
            downwards: false,
        }
    }

    /// The same axis with this scale.
    #[must_use]
    pub fn scale(self, scale: Scale) -> Self {
        Self { scale, ..self }
    }

    /// The label with the unit of the data, as in `r (m)`.
    pub fn in_data_units(&self) -> String {
        titled(&self.label, self.unit)
    }

    /// A value as it is spread along the axis.
    fn spread(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => value,
            Scale::Log => value.log10(),
        }
    }

    /// The value that is spread to `spread`.
    fn unspread(&self, spread: f64) -> f64 {
        match self.scale {
            Scale::Linear => spread,
            Scale::Log => 10f64.powf(spread),
        }
    }

    /// Values halfway between neighbouring `places`, and as far beyond the first and the last one.
    pub fn edges(&self, places: &[f64]) -> Vec<f64> {
        let at: Vec<f64> = places.iter().map(|&place| self.spread(place)).collect();
        let last = at.len().saturating_sub(1);
        let half = |a: usize, b: usize| match at[b] - at[a] {
            0.0 => 0.5 * at[a].abs().max(1e-300),
            step => 0.5 * step,
        };
        let mut edges = vec![at[0] - half(0, last.min(1))];
        edges.extend(at.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
        edges.push(at[last] + half(last.saturating_sub(1), last));
        edges.into_iter().map(|edge| self.unspread(edge)).collect()
    }

    /// `bounds` with this share of their distance more on either side.
    fn with_margin(&self, [low, high]: [f64; 2], share: f64) -> [f64; 2] {
        let [low, high] = [low, high].map(|bound| self.spread(bound));
        let more = share * (high - low);
        [low - more, high + more].map(|bound| self.unspread(bound))
    }
}

/// A label with its unit.
pub fn titled(label: &str, unit: &str) -> String {
    match unit {
        "" => label.to_owned(),
        unit => format!("{label} ({unit})"),
    }
}

/// A line through points; where one is not finite, or not positive on a logarithmic axis, is a gap.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The name in the legend.
    pub name: String,
    /// Abscissae.
    pub xs: Vec<f64>,
    /// Ordinates.
    pub ys: Vec<f64>,
    /// What it stands for.
    pub ink: Ink,
    /// Whether it is dashed.
    pub dashed: bool,
    /// Whether its points have symbols, each with its error bar if that is known.
    pub has_symbols: bool,
    /// Whether a line joins its points.
    pub has_line: bool,
    /// Standard errors of the ordinates; empty where they are not known.
    pub errors: Vec<f64>,
}

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
    /// The words that the values are the numbers of, from 0 on, at most as many as there are inks for them;
    /// empty where the values are quantities.
    pub words: Vec<&'static str>,
}

impl Map {
    /// The values at the ends of the colours.
    pub fn range(&self) -> [f64; 2] {
        let is_log = self.quantity.scale == Scale::Log;
        let shown = self.values.iter().copied();
        let shown = shown.filter(|v| v.is_finite() && (!is_log || *v > 0.0));
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
            return (value + 0.5) / REGIME_INKS as f64;
        }
        let [low, high] = range.map(|end| self.quantity.spread(end));
        (self.quantity.spread(value) - low) / (high - low)
    }
}

/// One chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// What it shows.
    pub title: String,
    /// The abscissa.
    pub x: Axis,
    /// The ordinate.
    pub y: Axis,
    /// The curves, in drawing order.
    pub curves: Vec<Curve>,
    /// Vertical dotted lines with a letter.
    pub marks: Vec<(f64, &'static str)>,
    /// The map below the curves.
    pub map: Option<Map>,
    /// The share of the data's extent that stays free at both ends of the abscissa.
    pub margin: f64,
    /// A smaller chart in the upper left corner.
    pub inset: Option<Box<Chart>>,
}

/// The share of the data's extent between them and the frame, above and below, so that no plateau lies on it.
/// Zero may lie on the frame: it is an axis.
const HEADROOM: f64 = 0.04;

impl Chart {
    /// An empty chart.
    pub fn new(title: &str, x: Axis, y: Axis) -> Self {
        Self {
            title: title.to_owned(),
            x,
            y,
            curves: Vec::new(),
            marks: Vec::new(),
            map: None,
            margin: 0.0,
            inset: None,
        }
    }

    /// Adds a curve.
    pub fn curve(&mut self, name: &str, xs: &[f64], ys: &[f64], ink: Ink, dashed: bool) {
        self.curves.push(Curve {
            name: name.to_owned(),
            xs: xs.to_vec(),
            ys: ys.to_vec(),
            ink,
            dashed,
            has_symbols: false,
            has_line: true,
            errors: Vec::new(),
        });
    }

    /// Adds points, with their errors if these are known.
    pub fn scattered(&mut self, name: &str, xs: &[f64], ys: &[f64], errors: &[f64], ink: Ink) {
        self.curve(name, xs, ys, ink, false);
        if let Some(curve) = self.curves.last_mut() {
            (curve.has_symbols, curve.has_line) = (true, false);
            curve.errors = errors.to_vec();
        }
    }

    /// The values at the ends of an axis, 0 the abscissa: as given, else from the data, the ordinate's rounded.
    pub fn bounds(&self, k: usize) -> [f64; 2] {
        let axis = if k == 0 { &self.x } else { &self.y };
        if let Some(bounds) = axis.bounds {
            return bounds;
        }
        let shown = |v: &f64| v.is_finite() && (axis.scale == Scale::Linear || *v > 0.0);
        let values = self.curves.iter();
        let values = values.flat_map(|curve| if k == 0 { &curve.xs } else { &curve.ys });
        let bars = self.curves.iter().filter(|_| k == 1);
        let bars = bars.flat_map(|curve| curve.ys.iter().zip(&curve.errors));
        let bars = bars.flat_map(|(y, error)| [y - error, y + error]);
        let places = self.map.iter().flat_map(|map| &map.places[k]);
        let (low, high) = values
            .chain(places)
            .copied()
            .chain(bars)
            .filter(|v| shown(v))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                (low.min(v), high.max(v))
            });
        match axis.scale {
            _ if low > high => [0.0, 1.0],
            _ if k == 0 && self.margin > 0.0 && high > low => {
                axis.with_margin([low, high], self.margin)
            }
            Scale::Log => {
                let ends = [low.log10().floor(), high.log10().ceil()];
                [10f64.powf(ends[0]), 10f64.powf(ends[1].max(ends[0] + 1.0))]
            }
            Scale::Linear if (k == 0 || self.map.is_some()) && high > low => [low, high],
            Scale::Linear => {
                let more = HEADROOM * (high - low);
                let apart = |end: f64, by: f64| if end == 0.0 { 0.0 } else { end + by };
                nice_bounds(apart(low, -more), apart(high, more))
            }
        }
    }
}
