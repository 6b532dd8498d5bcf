//! One chart on the paper: axes with the same ticks and units as on the screen, curves, a map, a legend.

use super::canvas::{Anchor, BLACK, Canvas, Rgb};
use super::font;
use super::ink::{Ink, Look};
use crate::plot::Scale;
use crate::plot::axis::nice_bounds;
use crate::plot::colormap::ColorMap;
use crate::plot::ticks::{Labels, Tick, ticks};
use crate::plot::units::{AxisUnit, axis_unit};
use crate::plot::window::Window;

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

    /// The label with the unit of the data, as in `r [m]`.
    pub fn in_data_units(&self) -> String {
        titled(&self.label, self.unit)
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
    /// Whether its points are drawn, each with its error bar, and no line between them.
    pub is_scattered: bool,
    /// Standard errors of the ordinates; empty where they are not known.
    pub errors: Vec<f64>,
}

/// Values on a grid of places, as colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The quantity and its unit.
    pub quantity: Axis,
    /// The abscissae and the ordinates of the grid, both rising and at least two.
    pub places: [Vec<f64>; 2],
    /// The values, abscissa by abscissa for each ordinate.
    pub values: Vec<f64>,
    /// The colours.
    pub colors: ColorMap,
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
}

/// Width of curves and of axes, mm.
const CURVE: f64 = 0.35;
const FRAME: f64 = 0.15;

/// Width of error bars and of the outline of symbols, and half of the size of a symbol, mm.
const BAR: f64 = 0.2;
const SYMBOL: f64 = 0.45;

/// Length of a tick, mm.
const TICK: f64 = 1.0;

/// The inside of a chart, with its two scales.
struct Frame {
    left: f64,
    top: f64,
    size: [f64; 2],
    windows: [Window; 2],
    downwards: bool,
}

impl Frame {
    /// Where a point lies, mm; `None` where it has no place.
    fn place(&self, x: f64, y: f64) -> Option<[f64; 2]> {
        let share = |window: &Window, value: f64| {
            let last = (window.dots().max(2) - 1) as f64;
            window.position(value).map(|dots| dots / last)
        };
        let (across, up) = (share(&self.windows[0], x)?, share(&self.windows[1], y)?);
        let down = if self.downwards { up } else { 1.0 - up };
        Some([
            self.left + across * self.size[0],
            self.top + down * self.size[1],
        ])
    }

    /// Draws the points of a curve that lie inside, with their error bars, and returns them.
    fn points(&self, curve: &Curve, canvas: &mut Canvas, look: &Look) -> Vec<[f64; 2]> {
        let ink = look.color(curve.ink);
        let mut drawn = Vec::new();
        for (k, (&x, &y)) in curve.xs.iter().zip(&curve.ys).enumerate() {
            if let Some(error) = curve.errors.get(k) {
                let lowest = self.windows[1].bounds()[0];
                let low = self.place(x, y - error).or(self.place(x, lowest));
                if let (Some(low), Some(high)) = (low, self.place(x, y + error))
                    && let Some(bar) = self.inside(low, high)
                {
                    canvas.line(bar.to_vec(), ink, BAR, &[]);
                }
            }
            let place = self.place(x, y);
            if let Some(at) = place.filter(|at| self.inside(*at, *at).is_some()) {
                canvas.line(symbol(curve.ink, at), ink, BAR, &[]);
                drawn.push(at);
            }
        }
        drawn
    }

    /// The parts of a line that lie inside.
    fn clipped(&self, curve: &Curve) -> Vec<Vec<[f64; 2]>> {
        let mut parts: Vec<Vec<[f64; 2]>> = Vec::new();
        let mut before: Option<[f64; 2]> = None;
        for (&x, &y) in curve.xs.iter().zip(&curve.ys) {
            let here = self.place(x, y);
            if let (Some(from), Some(to)) = (before, here)
                && let Some([start, end]) = self.inside(from, to)
            {
                match parts.last_mut() {
                    Some(part) if part.last() == Some(&start) => part.push(end),
                    _ => parts.push(vec![start, end]),
                }
            }
            before = here;
        }
        parts
    }

    /// The part of a segment inside the frame (Liang and Barsky).
    fn inside(&self, from: [f64; 2], to: [f64; 2]) -> Option<[[f64; 2]; 2]> {
        let low = [self.left, self.top];
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for k in 0..2 {
            let (step, high) = (to[k] - from[k], low[k] + self.size[k]);
            let bounds = [low[k] - from[k], high - from[k]];
            if step == 0.0 {
                if bounds[0] > 0.0 || bounds[1] < 0.0 {
                    return None;
                }
                continue;
            }
            let (a, b) = (bounds[0] / step, bounds[1] / step);
            first = first.max(a.min(b));
            last = last.min(a.max(b));
        }
        let at = |share: f64| [0, 1].map(|k| from[k] + share * (to[k] - from[k]));
        let start = if first == 0.0 { from } else { at(first) };
        let end = if last == 1.0 { to } else { at(last) };
        (first <= last).then_some([start, end])
    }
}

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
            is_scattered: false,
            errors: Vec::new(),
        });
    }

    /// Adds points that were measured, with their errors if these are known.
    pub fn scattered(&mut self, name: &str, xs: &[f64], ys: &[f64], errors: &[f64], ink: Ink) {
        self.curve(name, xs, ys, ink, false);
        if let Some(curve) = self.curves.last_mut() {
            curve.is_scattered = true;
            curve.errors = errors.to_vec();
        }
    }

    /// Draws the chart into the rectangle at `at` of `size` (mm).
    pub fn draw(&self, canvas: &mut Canvas, at: [f64; 2], size: [f64; 2], look: &Look) {
        let font = look.font;
        let bounds = [self.bounds(0), self.bounds(1)];
        let units = [unit_of(&self.x, bounds[0]), unit_of(&self.y, bounds[1])];
        let (top, bottom) = (1.8 * font, 3.4 * font);
        let height = (size[1] - top - bottom).max(1.0);
        let window = |k: usize, axis: &Axis, cells: f64| {
            Window::new(bounds[k], axis.scale, cells.clamp(2.0, 400.0) as u16, 16)
        };
        let vertical = window(1, &self.y, height / (1.2 * font));
        let y_ticks = ticks(&vertical, units[1].factor, Labels::Column);
        let widest = y_ticks.iter().map(|tick| font::width(&tick.label));
        let left = widest.fold(0.0, f64::max) * font + 2.6 * font;
        let right = if self.map.is_some() { 7.5 } else { 1.4 } * font;
        let width = (size[0] - left - right).max(1.0);
        // A digit is about 0.57 of the font's size wide.
        let horizontal = window(0, &self.x, width / (0.57 * font));
        let row = Labels::Row {
            before: 0,
            apart: 0,
        };
        let x_ticks = ticks(&horizontal, units[0].factor, row);
        let frame = Frame {
            left: at[0] + left,
            top: at[1] + top,
            size: [width, height],
            windows: [horizontal, vertical],
            downwards: self.y.downwards,
        };
        if let Some(map) = &self.map {
            draw_map(map, &frame, canvas, look);
        }
        for &(x, letter) in &self.marks {
            self.mark(x, letter, &frame, canvas, font);
        }
        let mut drawn = Vec::new();
        for curve in &self.curves {
            if curve.is_scattered {
                drawn.extend(frame.points(curve, canvas, look));
                continue;
            }
            let dashes = look.dashes(curve.ink, curve.dashed);
            for part in frame.clipped(curve) {
                drawn.extend(along(&part));
                canvas.line(part, look.color(curve.ink), CURVE, dashes);
            }
        }
        self.axes(&frame, &units, [&x_ticks, &y_ticks], at, canvas, font);
        canvas.text(
            [at[0] + 0.3 * font, at[1] + 1.1 * font],
            &self.title,
            font,
            Anchor::Start,
        );
        self.legend(&frame, &drawn, canvas, look);
    }

    /// The values at the ends of an axis: as given, else from the data, the ordinate's rounded.
    fn bounds(&self, k: usize) -> [f64; 2] {
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
            Scale::Log => {
                let ends = [low.log10().floor(), high.log10().ceil()];
                [10f64.powf(ends[0]), 10f64.powf(ends[1].max(ends[0] + 1.0))]
            }
            Scale::Linear if (k == 0 || self.map.is_some()) && high > low => [low, high],
            Scale::Linear => nice_bounds(low, high),
        }
    }

    fn mark(&self, x: f64, letter: &str, frame: &Frame, canvas: &mut Canvas, font: f64) {
        let bounds = frame.windows[1].bounds();
        let ends = [frame.place(x, bounds[0]), frame.place(x, bounds[1])];
        if let [Some(low), Some(high)] = ends
            && let Some(line) = frame.inside(low, high)
        {
            canvas.line(line.to_vec(), BLACK, FRAME, &[0.3, 0.7]);
            let above = [low[0], frame.top - 0.3 * font];
            canvas.text(above, letter, 0.9 * font, Anchor::Middle);
        }
    }

    fn axes(
        &self,
        frame: &Frame,
        units: &[AxisUnit; 2],
        [x_ticks, y_ticks]: [&[Tick]; 2],
        at: [f64; 2],
        canvas: &mut Canvas,
        font: f64,
    ) {
        let [left, top, width, height] = [frame.left, frame.top, frame.size[0], frame.size[1]];
        let (right, bottom) = (left + width, top + height);
        let corners = [
            [left, top],
            [right, top],
            [right, bottom],
            [left, bottom],
            [left, top],
        ];
        canvas.line(corners.to_vec(), BLACK, FRAME, &[]);
        for tick in x_ticks {
            let low = frame.windows[1].bounds()[0];
            if let Some([x, _]) = frame.place(tick.value, low) {
                canvas.line(vec![[x, bottom], [x, bottom - TICK]], BLACK, FRAME, &[]);
                canvas.text(
                    [x, bottom + 1.25 * font],
                    &signed(&tick.label),
                    font,
                    Anchor::Middle,
                );
            }
        }
        for tick in y_ticks {
            let first = frame.windows[0].bounds()[0];
            if let Some([_, y]) = frame.place(first, tick.value) {
                canvas.line(vec![[left, y], [left + TICK, y]], BLACK, FRAME, &[]);
                let place = [left - 0.4 * font, y + 0.36 * font];
                canvas.text(place, &signed(&tick.label), font, Anchor::End);
            }
        }
        let label = titled(&self.x.label, &units[0].text);
        let below = [left + 0.5 * width, bottom + 2.7 * font];
        canvas.text(below, &label, font, Anchor::Middle);
        let label = titled(&self.y.label, &units[1].text);
        canvas.text_upwards([at[0] + 1.2 * font, top + 0.5 * height], &label, font);
    }

    /// The names of the curves, in the corner where they cover the least of them.
    fn legend(&self, frame: &Frame, drawn: &[[f64; 2]], canvas: &mut Canvas, look: &Look) {
        let font = 0.9 * look.font;
        let named: Vec<&Curve> = self.curves.iter().filter(|c| !c.name.is_empty()).collect();
        if named.is_empty() {
            return;
        }
        let (swatch, line, gap) = (2.6 * font, 1.3 * font, 0.6 * font);
        let widest = named.iter().map(|curve| font::width(&curve.name));
        let width = swatch + 2.0 * gap + widest.fold(0.0, f64::max) * font;
        let height = line * named.len() as f64 + gap;
        let [left, top] = [frame.left + TICK, frame.top + TICK];
        let right = frame.left + frame.size[0] - TICK - width;
        let bottom = frame.top + frame.size[1] - TICK - height;
        let covered = |[x, y]: [f64; 2]| {
            let hit =
                |p: &&[f64; 2]| (x..x + width).contains(&p[0]) && (y..y + height).contains(&p[1]);
            drawn.iter().filter(hit).count()
        };
        let corners = [[right, top], [left, top], [right, bottom], [left, bottom]];
        let Some([x, y]) = corners.into_iter().min_by_key(|&corner| covered(corner)) else {
            return;
        };
        for (k, curve) in named.into_iter().enumerate() {
            let middle = y + gap / 2.0 + line * (k as f64 + 0.5);
            let stroke = vec![[x + gap / 2.0, middle], [x + gap / 2.0 + swatch, middle]];
            let dashes = look.dashes(curve.ink, curve.dashed);
            let ink = look.color(curve.ink);
            if curve.is_scattered {
                let place = [x + gap / 2.0 + swatch / 2.0, middle];
                canvas.line(symbol(curve.ink, place), ink, BAR, &[]);
            } else {
                canvas.line(stroke, ink, CURVE, dashes);
            }
            let place = [x + gap + swatch, middle + 0.36 * font];
            canvas.text(place, &curve.name, font, Anchor::Start);
        }
    }
}

/// Colours of the map, equal neighbours as one area, and its scale at the right. Each area also lies below the
/// ones that are drawn after it: where areas only touch, viewers show the paper between them.
fn draw_map(map: &Map, frame: &Frame, canvas: &mut Canvas, look: &Look) {
    let finite = map.values.iter().copied().filter(|v| v.is_finite());
    let range = finite.fold([0.0_f64, 0.0], |[low, high], v| [low.min(v), high.max(v)]);
    let range = map.colors.range(range);
    let color = |value: f64| -> Rgb {
        let share = (value - range[0]) / (range[1] - range[0]);
        look.mapped(map.colors, share)
    };
    let [xs, ys] = &map.places;
    // The borders between the grid's places.
    let borders = |places: &[f64]| -> Vec<f64> {
        let middles = places.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let (first, last) = (places.first().copied(), places.last().copied());
        first.into_iter().chain(middles).chain(last).collect()
    };
    let (across, down) = (borders(xs), borders(ys));
    let (end_across, end_down) = (across.len() - 1, down.len() - 1);
    for (row, values) in map.values.chunks(xs.len()).enumerate() {
        let mut start = 0;
        for end in 1..=values.len() {
            let ink = color(values[start]);
            if end < values.len() && color(values[end]) == ink {
                continue;
            }
            let corners = [
                frame.place(across[start], down[row]),
                frame.place(
                    across[(end + 1).min(end_across)],
                    down[(row + 2).min(end_down)],
                ),
            ];
            if let [Some(a), Some(b)] = corners {
                let at = [a[0].min(b[0]), a[1].min(b[1])];
                let size = [(b[0] - a[0]).abs(), (b[1] - a[1]).abs()];
                canvas.area(at, size, ink);
            }
            start = end;
        }
    }
    let font = look.font;
    let left = frame.left + frame.size[0] + 0.8 * font;
    let (top, height) = (frame.top, frame.size[1]);
    const STEPS: usize = 32;
    for k in 0..STEPS {
        let share = (k as f64 + 0.5) / STEPS as f64;
        let [low, high] = [k, (k + 2).min(STEPS)].map(|step| height * step as f64 / STEPS as f64);
        let ink = look.mapped(map.colors, share);
        canvas.area([left, top + height - high], [font, high - low], ink);
    }
    let unit = unit_of(&map.quantity, range);
    let window = Window::new(range, Scale::Linear, (height / (1.2 * font)) as u16, 16);
    let last = (window.dots().max(2) - 1) as f64;
    for tick in ticks(&window, unit.factor, Labels::Column) {
        if let Some(dots) = window.position(tick.value) {
            let y = top + height * (1.0 - dots / last) + 0.36 * font;
            canvas.text(
                [left + 1.3 * font, y],
                &signed(&tick.label),
                font,
                Anchor::Start,
            );
        }
    }
    let title = titled(&map.quantity.label, &unit.text);
    let above = [left + 6.4 * font, top - 0.5 * font];
    canvas.text(above, &title, font, Anchor::End);
}

/// The outline of the sign of a point: a square, a diamond or a triangle.
fn symbol(ink: Ink, [x, y]: [f64; 2]) -> Vec<[f64; 2]> {
    let corners: &[[f64; 2]] = match ink {
        Ink::Ghost(k) if k % 3 == 1 => &[[0.0, -1.2], [1.2, 0.0], [0.0, 1.2], [-1.2, 0.0]],
        Ink::Ghost(k) if k % 3 == 2 => &[[0.0, -1.1], [1.1, 0.8], [-1.1, 0.8]],
        _ => &[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
    };
    let closed = corners.iter().chain(corners.first());
    closed
        .map(|[dx, dy]| [x + SYMBOL * dx, y + SYMBOL * dy])
        .collect()
}

/// Points along a drawn line, half a millimetre apart.
fn along(part: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for pair in part.windows(2) {
        let [dx, dy] = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let count = (2.0 * dx.hypot(dy)).ceil().max(1.0) as usize;
        points.extend((0..count).map(|k| {
            let share = k as f64 / count as f64;
            [pair[0][0] + share * dx, pair[0][1] + share * dy]
        }));
    }
    points
}

/// The unit that an axis is labelled in; logarithmic ones keep that of the data.
fn unit_of(axis: &Axis, bounds: [f64; 2]) -> AxisUnit {
    match axis.scale {
        Scale::Linear => axis_unit(bounds[0].abs().max(bounds[1].abs()), axis.unit, false),
        Scale::Log => AxisUnit {
            factor: 1.0,
            text: axis.unit.to_owned(),
        },
    }
}

fn titled(label: &str, unit: &str) -> String {
    match unit {
        "" => label.to_owned(),
        unit => format!("{label} [{unit}]"),
    }
}

/// A number with the minus sign of print.
fn signed(label: &str) -> String {
    match label.strip_prefix('-') {
        Some(size) => format!("−{size}"),
        None => label.to_owned(),
    }
}
