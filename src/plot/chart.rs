//! One chart: axes, curves and what belongs to them. It owns its data. The terminal ([`super::Plot`]) and the paper
//! figures (`figure`) both draw it.

use super::axis::Axis;
use super::map::Map;
use super::stroke::DashPattern;
use super::theme::Role;
use crate::math::scan::{range, value_at};
use crate::reading::Zone;

/// Dash patterns of other sources' curves in a terminal, by index.
const GHOSTS: [DashPattern; 4] = [
    DashPattern::Dotted,
    DashPattern::DashDotted,
    DashPattern::LongDashed,
    DashPattern::Dashed,
];

/// A line through points, with gaps at points that are not finite, or not positive on a logarithmic axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Curve {
    /// The name in the legend; a curve without a name is not listed.
    pub name: String,
    /// Abscissae, in the x axis' unit.
    pub xs: Vec<f64>,
    /// Ordinates, in the y axis' unit; if `xs` and `ys` differ in length, the longer is cut.
    pub ys: Vec<f64>,
    /// What it represents, which decides its colour.
    pub role: Role,
    /// Whether it is dashed.
    pub dashed: bool,
    /// Ordinates of the other edge of the shaded area, in a terminal; empty without shading.
    pub fill: Vec<f64>,
    /// The true values of a curve that is drawn magnified; empty if these are the ordinates.
    pub true_values: Vec<f64>,
    /// Standard errors of the ordinates; empty if unknown.
    pub errors: Vec<f64>,
    /// Whether its points are measured; on paper each then has a symbol.
    pub has_symbols: bool,
    /// Whether a line joins its points on paper.
    pub has_line: bool,
    /// Whether it is a closed form drawn with the run's own curves, which alone decide the range of a live chart's axes.
    pub is_theory: bool,
}

impl Curve {
    /// A solid curve.
    pub fn new(
        name: impl Into<String>,
        xs: impl Into<Vec<f64>>,
        ys: impl Into<Vec<f64>>,
        role: Role,
    ) -> Self {
        Self {
            name: name.into(),
            xs: xs.into(),
            ys: ys.into(),
            role,
            has_line: true,
            ..Self::default()
        }
    }

    /// The same curve, dashed.
    #[must_use]
    pub fn dashed(self) -> Self {
        self.dashed_if(true)
    }

    /// The same curve, dashed or not.
    #[must_use]
    pub fn dashed_if(self, dashed: bool) -> Self {
        Self { dashed, ..self }
    }

    /// The same curve, with the area between it and these ordinates shaded.
    #[must_use]
    pub fn filled(self, fill: impl Into<Vec<f64>>) -> Self {
        let fill = fill.into();
        Self { fill, ..self }
    }

    /// The same curve as drawn magnified `times`: the name says so, and a cursor reads `values`.
    #[must_use]
    pub fn magnified(mut self, times: f64, values: impl Into<Vec<f64>>) -> Self {
        if times != 1.0 {
            self.name = format!("{} ×{times}", self.name);
            self.true_values = values.into();
        }
        self
    }

    /// Applies `scale` to its ordinates and their errors.
    pub fn scale(&mut self, scale: impl Fn(f64) -> f64) {
        let values = self.ys.iter_mut().chain(&mut self.errors);
        values.for_each(|value| *value = scale(*value));
    }

    /// The same curve as a closed form: dashed, and drawn below the run's own curves.
    #[must_use]
    pub fn theory(mut self) -> Self {
        (self.is_theory, self.dashed) = (true, true);
        self
    }

    /// The same curve as separate points, with standard errors if they are known.
    #[must_use]
    pub fn scattered(mut self, errors: impl Into<Vec<f64>>) -> Self {
        (self.has_symbols, self.has_line) = (true, false);
        self.errors = errors.into();
        self
    }

    /// Returns the value at `x`: at a point of the curve, or interpolated linearly between the first two neighbouring
    /// points with `x` between them. `None` in gaps and outside.
    pub fn value_at(&self, x: f64) -> Option<f64> {
        let values = if self.true_values.is_empty() {
            &self.ys
        } else {
            &self.true_values
        };
        value_at(&self.xs, values, x)
    }

    /// Returns all values at `x`, in the order of the points; a loop has two almost everywhere.
    pub fn values_at(&self, x: f64) -> impl Iterator<Item = f64> {
        let values = if self.true_values.is_empty() {
            &self.ys
        } else {
            &self.true_values
        };
        let pairs = self.xs.windows(2).zip(values.windows(2));
        pairs.filter_map(move |(xs, ys)| {
            let is_between = (xs[0] <= x && x < xs[1]) || (xs[1] < x && x <= xs[0]);
            is_between.then(|| value_at(xs, ys, x)).flatten()
        })
    }

    /// Returns the largest finite ordinate, error bars included; 0 if none is positive.
    pub fn highest(&self) -> f64 {
        let values = self.points().chain(self.bars()).map(|(_, y)| y);
        values.filter(|y| y.is_finite()).fold(0.0, f64::max)
    }

    /// Returns the points of the curve, including gaps.
    pub fn points(&self) -> impl DoubleEndedIterator<Item = (f64, f64)> {
        self.xs.iter().copied().zip(self.ys.iter().copied())
    }

    /// Returns the ends of the error bars, with a gap after each bar.
    pub fn bars(&self) -> impl Iterator<Item = (f64, f64)> {
        let points = self.points().zip(&self.errors);
        points.flat_map(|((x, y), error)| [(x, y - error), (x, y + error), (f64::NAN, f64::NAN)])
    }

    /// Returns its dash pattern in a terminal.
    pub(super) fn stroke(&self) -> DashPattern {
        match self.role {
            Role::Ghost(k) => GHOSTS[k % GHOSTS.len()],
            _ if self.dashed => DashPattern::Dashed,
            _ => DashPattern::Solid,
        }
    }
}

/// A thin dotted vertical line with a short label above it.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Its place, in the x axis' unit.
    pub x: f64,
    /// A letter or two, as in `a`.
    pub label: &'static str,
    /// What it represents.
    pub role: Role,
}

/// A single marked point, drawn over the curves.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// x and y, in the units of the axes.
    pub at: [f64; 2],
    /// The sign, as in `▶`.
    pub sign: char,
    /// What it represents.
    pub role: Role,
}

/// One chart. All data are in plain units (m, Pa); the renderer chooses the prefixes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chart {
    /// What it shows.
    pub title: String,
    /// The abscissa.
    pub x: Axis,
    /// The ordinate.
    pub y: Axis,
    /// The curves, in drawing order; where two share a cell, the later one sets its colour.
    pub curves: Vec<Curve>,
    /// Single marked points, in a terminal.
    pub points: Vec<Point>,
    /// The zones of the band below the plot area, each from one x to another, in a terminal; empty without a band.
    ///
    /// Cells show the zone at their middle; a zone narrower than a cell still gets one. Where zones overlap, the last
    /// one is visible.
    pub band: Vec<([f64; 2], Zone)>,
    /// Vertical dotted lines.
    pub marks: Vec<Mark>,
    /// A remark at the right end of the title row, in a terminal.
    pub note: String,
    /// The map below the curves.
    pub map: Option<Map>,
    /// Free space at both ends of the abscissa on paper, relative to the data's extent.
    pub margin: f64,
    /// A smaller chart in the upper left corner, on paper.
    pub inset: Option<Box<Chart>>,
}

impl Chart {
    /// An empty chart.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            ..Self::default()
        }
    }

    /// Adds a curve.
    #[must_use]
    pub fn curve(mut self, curve: Curve) -> Self {
        self.curves.push(curve);
        self
    }

    /// Adds curves in order.
    #[must_use]
    pub fn curves(mut self, curves: impl IntoIterator<Item = Curve>) -> Self {
        self.curves.extend(curves);
        self
    }

    /// Returns the curves that the legend lists.
    pub fn named_curves(&self) -> impl Iterator<Item = &Curve> {
        self.curves.iter().filter(|curve| !curve.name.is_empty())
    }

    /// Returns the visible ranges of abscissae and ordinates. They cover points and error bars with a position on both
    /// axes and within the given x bounds, the places of a map, and the values that the axes always include. Curves for
    /// which `counted` is false are left out.
    pub fn extent(&self, counted: impl Fn(&Curve) -> bool) -> [Option<[f64; 2]>; 2] {
        let limits = self.x.bounds.map(|[a, b]| [a.min(b), a.max(b)]);
        let seen = |x: f64| limits.is_none_or(|[lo, hi]| x >= lo && x <= hi);
        let (across, up) = (self.x.scale, self.y.scale);
        let curves = || self.curves.iter().filter(|curve| counted(curve));
        [0, 1].map(|k| {
            let axis = [&self.x, &self.y][k];
            let points = curves().flat_map(|curve| curve.points().chain(curve.bars()));
            let points = points.filter(|at| across.has(at.0) && up.has(at.1) && seen(at.0));
            let of_map = self.map.iter().flat_map(|map| &map.places[k]);
            let places = of_map.chain(&axis.holds).copied();
            let places = places.filter(|place| axis.scale.has(*place));
            range(points.map(|at| [at.0, at.1][k]).chain(places))
        })
    }
}
