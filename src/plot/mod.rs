//! A plot for the terminal: a pure function of data and area.
//!
//! ```text
//! p [GPa]                   c      a           note    title, mark labels, note
//!   3 ┤⠉⠑⠢⣀                 ⡂      ⡂    ─ now          plot, legend in its emptiest corner
//!   2 ┤    ⠈⠢⣀              ⡂      ⡂    ╌ unworn
//!   1 ┤       ⠈⠢⡀           ⡂      ⡂
//!   0 ┤          ⠈⠒⠤⣀⣀⣀⣀⣀⣀⣀⣀⡂⣀⣀⣀⣀⣀⣀⡂
//!      ▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀     band (zones along x)
//!     └┬─────────────┬─────────────┬───────────────     axis line, from 8 rows up
//!      0            50    r [µm]  100                  tick labels, x title
//! ```
//!
//! One idea per file: `units` (SI prefixes), `axis` (what an axis shows, its bounds), `window` (the
//! map from values to dots), `step` (the 1-2-5 grid), `ticks`, `labels` (the row under the plot),
//! `marker`, `stroke`, `raster` and `segment` (dots finer than a cell), `legend`, `widget` (the layout
//! above), `screen_svg` (a screen as a picture).
//!
//! All data are in plain units (m, Pa); the plot chooses the prefixes. Points where x or y
//! is not finite, or not positive on a log axis, are gaps. Where a curve leaves bounds that were given
//! through the top, `▲` stands there. No area and no data make it
//! panic; below 12 by 4 cells only the curves are drawn.

use ratatui::style::Style;

pub mod axis;
pub mod colormap;
mod labels;
mod legend;
mod marker;
mod raster;
pub mod screen_svg;
mod segment;
mod step;
mod stroke;
pub mod ticks;
pub mod units;
mod widget;
pub mod window;

#[cfg(test)]
mod tests;

pub use axis::{Axis, Scale, nice_bounds, sticky_bounds};
pub use marker::Marker;
pub use stroke::Stroke;

/// A line through points.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Curve<'a> {
    /// The name in the legend; an empty name stays out of it.
    pub name: &'a str,
    /// Abscissae, in the x axis' unit.
    pub xs: &'a [f64],
    /// Ordinates, in the y axis' unit; the longer of the two slices is cut.
    pub ys: &'a [f64],
    /// Foreground colour and modifiers of the line; the background is not used.
    pub style: Style,
    /// Shades the area between the curve and this ordinate (y axis' unit).
    pub fill_to: Option<f64>,
    /// Shades the area between the curve and these ordinates, one for each point.
    pub fill_from: &'a [f64],
    /// How the line is interrupted.
    pub stroke: Stroke,
}

impl<'a> Curve<'a> {
    /// A solid curve without a fill.
    pub fn new(name: &'a str, xs: &'a [f64], ys: &'a [f64], style: Style) -> Self {
        Curve {
            name,
            xs,
            ys,
            style,
            ..Curve::default()
        }
    }

    /// The same curve, dashed.
    #[must_use]
    pub fn dashed(self) -> Self {
        self.stroked(Stroke::Dashed)
    }

    /// The same curve with this pattern of dashes.
    #[must_use]
    pub fn stroked(self, stroke: Stroke) -> Self {
        Self { stroke, ..self }
    }

    /// The same curve, dashed where `dashed` is true.
    #[must_use]
    pub fn dashed_if(self, dashed: bool) -> Self {
        if dashed { self.dashed() } else { self }
    }

    /// The same curve, the area between it and `base` (y axis' unit) shaded.
    #[must_use]
    pub fn fill_to(mut self, base: f64) -> Self {
        self.fill_to = Some(base);
        self
    }

    /// The same curve, the area between it and another with the same abscissae hatched.
    #[must_use]
    pub fn fill_from(mut self, ys: &'a [f64]) -> Self {
        self.fill_from = ys;
        self
    }

    /// The curve's value at `x`: at a point of it, or linearly interpolated between the first two
    /// neighbouring points that have `x` between them. `None` in gaps and outside.
    pub fn value_at(&self, x: f64) -> Option<f64> {
        let mut previous: Option<(f64, f64)> = None;
        for (x1, y1) in self.points() {
            let point = (x1.is_finite() && y1.is_finite()).then_some((x1, y1));
            if point.is_some() && x1 == x {
                return Some(y1);
            }
            if let (Some((x0, y0)), Some(_)) = (previous, point)
                && (x0.min(x1)..=x0.max(x1)).contains(&x)
            {
                let share = (x / 2.0 - x0 / 2.0) / (x1 / 2.0 - x0 / 2.0);
                return Some(y0 * (1.0 - share) + y1 * share);
            }
            previous = point;
        }
        None
    }

    /// The points of the curve, gaps included.
    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.xs.iter().copied().zip(self.ys.iter().copied())
    }
}

/// A range of x that a [`Band`] marks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Zone<'a> {
    /// Where the zone begins, in the x axis' unit.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Its foreground colour; without one the letter is shown instead.
    pub style: Style,
    /// The letter that stands for it in mono and ASCII, as in `s`, `~`, `.`.
    pub glyph: char,
    /// Its name, written into it where it is wide enough; may be empty.
    pub name: &'a str,
}

/// A strip one row high, directly under the plot area: stick, slip and open zones.
///
/// Cells take the zone at their middle; a zone narrower than a cell still gets one. Of
/// overlapping zones the last is seen.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Band<'a> {
    /// The zones, in any order.
    pub zones: &'a [Zone<'a>],
}

/// A thin dotted vertical line with a short label above it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct VerticalMark<'a> {
    /// Where, in the x axis' unit.
    pub x: f64,
    /// A letter or two, as in `a`.
    pub label: &'a str,
    /// The style of line and label.
    pub style: Style,
}

/// One place with a sign of its own, over the curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// x and y, in the units of the axes.
    pub at: [f64; 2],
    /// The sign, as in `▶`.
    pub sign: char,
    /// Its style.
    pub style: Style,
}

/// The widget: axes, curves and what belongs to them. See the [module](self) for its parts.
#[derive(Debug, Clone, Default)]
pub struct Plot<'a> {
    x_axis: Axis<'a>,
    y_axis: Axis<'a>,
    curves: Vec<Curve<'a>>,
    points: Vec<Point>,
    band: Option<Band<'a>>,
    marks: Vec<VerticalMark<'a>>,
    cursor: Option<f64>,
    marker: Marker,
    axis_style: Style,
    rule_style: Style,
    hide_legend: bool,
    note: &'a str,
}

impl<'a> Plot<'a> {
    /// An empty plot.
    pub fn new(x_axis: Axis<'a>, y_axis: Axis<'a>) -> Self {
        Plot {
            x_axis,
            y_axis,
            ..Plot::default()
        }
    }

    /// Adds a curve; later curves win the colour of a shared cell.
    #[must_use]
    pub fn curve(mut self, curve: Curve<'a>) -> Self {
        self.curves.push(curve);
        self
    }

    /// Adds curves in order.
    #[must_use]
    pub fn curves(mut self, curves: impl IntoIterator<Item = Curve<'a>>) -> Self {
        self.curves.extend(curves);
        self
    }

    /// Adds a point with a sign of its own.
    #[must_use]
    pub fn point(mut self, point: Point) -> Self {
        self.points.push(point);
        self
    }

    /// Puts a band under the plot area.
    #[must_use]
    pub fn band(mut self, band: Band<'a>) -> Self {
        self.band = Some(band);
        self
    }

    /// Adds a vertical mark.
    #[must_use]
    pub fn mark(mut self, mark: VerticalMark<'a>) -> Self {
        self.marks.push(mark);
        self
    }

    /// A vertical line at this x (in the x axis' unit), and in the legend each curve's
    /// value there, linearly interpolated between its neighbouring points.
    #[must_use]
    pub fn cursor(mut self, x: Option<f64>) -> Self {
        self.cursor = x;
        self
    }

    /// What dots are made of; [`Marker::Ascii`] turns everything into ASCII.
    #[must_use]
    pub fn marker(mut self, marker: Marker) -> Self {
        self.marker = marker;
        self
    }

    /// The style of tick labels, titles and the note.
    #[must_use]
    pub fn axis_style(mut self, style: Style) -> Self {
        self.axis_style = style;
        self
    }

    /// The style of what only guides the eye: axis lines and the lines of zero.
    #[must_use]
    pub fn rule_style(mut self, style: Style) -> Self {
        self.rule_style = style;
        self
    }

    /// Shows the legend (the default) or not.
    #[must_use]
    pub fn legend(mut self, shown: bool) -> Self {
        self.hide_legend = !shown;
        self
    }

    /// A remark at the right end of the title row.
    #[must_use]
    pub fn note(mut self, note: &'a str) -> Self {
        self.note = note;
        self
    }
}
