//! Ghosts in the panels: dashes in the colour of text, each its own pattern, error bars where there are any.

use super::{App, Frame};
use crate::plot::{Curve, Stroke};
use crate::studies::ghost::{Axes, Ghost};
use crate::tui::theme::{Role, Theme};

/// A pattern for each ghost.
const STROKES: [Stroke; crate::tui::ghosts::MOST] = [
    Stroke::Dotted,
    Stroke::DashDotted,
    Stroke::LongDashed,
    Stroke::Dashed,
];

/// One curve of a ghost, as it is drawn.
pub(super) struct Line {
    name: String,
    xs: Vec<f64>,
    ys: Vec<f64>,
    /// The error bars, a gap after each.
    bars: [Vec<f64>; 2],
    stroke: Stroke,
}

impl Line {
    /// The curve, and its error bars.
    pub fn curves(&self, theme: &Theme) -> [Curve<'_>; 2] {
        let style = theme.style(Role::Ghost);
        let [xs, ys] = &self.bars;
        [
            Curve::new(&self.name, &self.xs, &self.ys, style).stroked(self.stroke),
            Curve::new("", xs, ys, style),
        ]
    }

    /// The same line, which the legend does not name.
    pub fn nameless(self) -> Self {
        let name = String::new();
        Self { name, ..self }
    }

    /// The same line, of absolute values.
    pub fn sizes(self) -> Self {
        let sizes = |values: Vec<f64>| values.into_iter().map(f64::abs).collect();
        let [xs, ys] = self.bars;
        Self {
            ys: sizes(self.ys),
            bars: [xs, sizes(ys)],
            ..self
        }
    }

    /// What the ordinate must hold.
    pub fn ordinates(&self) -> impl Iterator<Item = f64> + '_ {
        self.ys.iter().chain(&self.bars[1]).copied()
    }
}

/// What one ghost gives for a panel: abscissae, ordinates, and errors if there are any.
type Points = (Vec<f64>, Vec<f64>, Option<Vec<f64>>);

/// The lines of all ghosts that `of` finds points in.
fn lines(frame: &Frame, of: impl Fn(&Ghost) -> Option<Points>) -> Vec<Line> {
    let ghosts = frame.ghosts.iter().zip(STROKES.into_iter().cycle());
    let lines = ghosts.filter_map(|(ghost, stroke)| {
        let (xs, ys, errors) = of(ghost)?;
        let points = xs.iter().zip(&ys).zip(errors.iter().flatten());
        let bars = points
            .flat_map(|((&x, &y), &error)| [(x, y - error), (x, y + error), (f64::NAN, f64::NAN)]);
        let (bar_xs, bar_ys) = bars.unzip();
        Some(Line {
            name: ghost.name.clone(),
            bars: [bar_xs, bar_ys],
            xs,
            ys,
            stroke,
        })
    });
    lines.collect()
}

/// The abscissae of lines.
pub(super) fn abscissae(lines: &[Line]) -> Vec<f64> {
    lines
        .iter()
        .flat_map(|line| line.xs.iter().copied())
        .collect()
}

/// The lines of the traces on `axes`, each ordinate times `factor`.
pub(super) fn on(frame: &Frame, axes: Axes, factor: f64) -> Vec<Line> {
    lines(frame, |ghost| {
        let trace = ghost.trace(axes)?;
        let scaled = |values: &[f64]| values.iter().map(|value| factor * value).collect();
        let errors = trace.errors.as_ref();
        let errors = errors.map(|errors| errors.iter().map(|e| factor.abs() * e).collect());
        Some((trace.xs.clone(), scaled(&trace.ys), errors))
    })
}

/// The lines of the wear, magnified by `times` on top of the unworn profile; `None` draws the wear alone.
pub(super) fn worn(frame: &Frame, times: Option<f64>) -> Vec<Line> {
    lines(frame, |ghost| {
        let worn = ghost.worn(|r| frame.indenter.profile(r))?;
        let drawn = worn.unworn.iter().zip(&worn.wear);
        let ys = drawn.map(|(f0, wear)| match times {
            Some(times) => f0 + times * wear,
            None => *wear,
        });
        let times = times.unwrap_or(1.0);
        let errors = worn
            .errors
            .map(|errors| errors.iter().map(|e| times * e).collect());
        Some((worn.radii, ys.collect(), errors))
    })
}

/// The lines of how much more or less the ghosts are worn than this run, m, in absolute values.
pub(super) fn differences(frame: &Frame) -> Vec<Line> {
    lines(frame, |ghost| {
        let worn = ghost.worn(|r| frame.indenter.profile(r))?;
        let points = worn.radii.iter().zip(&worn.wear);
        let ys = points.map(|(&r, wear)| (wear - frame.observation.worn_depth_at(r)).abs());
        let ys = ys.collect();
        Some((worn.radii, ys, None))
    })
}

/// What lines need of an ordinate.
pub(super) fn ordinates(lines: &[Line]) -> Vec<f64> {
    lines.iter().flat_map(Line::ordinates).collect()
}

/// The curves of lines, names fit for the terminal.
pub(super) fn curves<'a>(lines: &'a mut [Line], app: &App) -> Vec<Curve<'a>> {
    for line in lines.iter_mut() {
        line.name = app.theme.printable(&line.name);
    }
    lines
        .iter()
        .flat_map(|line| line.curves(&app.theme))
        .collect()
}

/// The last abscissa of the traces on one of `axes`.
pub(super) fn end(frame: &Frame) -> f64 {
    let over_cycles = [Axes::Volume, Axes::Depth, Axes::Contact, Axes::Stick];
    let traces = frame.ghosts.iter().flat_map(|ghost| ghost.traces());
    let traces = traces.filter(|trace| over_cycles.contains(&trace.axes));
    traces
        .filter_map(|trace| trace.xs.last().copied())
        .fold(0.0, f64::max)
}
