//! A chart on the paper: axes with the same ticks and units as on the screen, curves, a map, a legend.

use super::canvas::{Anchor, BLACK, Canvas, WHITE};
use super::font;
use super::frame::{BAR, Frame, symbol};
use super::look::Look;
use super::map::Key;
use crate::plot::axis::titled;
use crate::plot::ticks::{Labels, Tick, ticks};
use crate::plot::units::{AxisUnit, axis_unit};
use crate::plot::window::Window;
use crate::plot::{Axis, Chart, Curve, Scale};

/// The share of the data's extent between them and the frame, above and below, so that no plateau lies on it.
/// Zero may lie on the frame: it is an axis.
const HEADROOM: f64 = 0.04;

/// Width of curves, of axes, and of the white beside a line on a map, mm.
const CURVE: f64 = 0.35;
const FRAME: f64 = 0.15;
const HALO: f64 = 0.2;

/// Length of a tick, mm.
const TICK: f64 = 1.0;

/// The shares of a frame that an inset spans.
const INSET: [f64; 2] = [0.58, 0.5];

/// The ratio of the ends of a logarithmic axis up to which its labels have one prefix instead of powers of ten.
const ONE_PREFIX: f64 = 1.1e4;

impl Chart {
    /// What a legend below the frame takes, mm: that of a map stands there, and hides no colour.
    pub(super) fn below(&self, look: &Look) -> f64 {
        match self.map {
            Some(_) => self.named().count() as f64 * LEGEND_LINE * look.font,
            None => 0.0,
        }
    }

    /// The ordinate of a chart in `height` mm, with a legend of `below` mm under it.
    pub(super) fn ordinate(&self, height: f64, below: f64, look: &Look) -> Ordinate {
        let font = look.font;
        let bounds = self.bounds_on_paper()[1];
        let unit = unit_of(&self.y, bounds);
        let top = if self.title.is_empty() { 0.6 } else { 1.8 } * font;
        let height = (height - top - 3.4 * font - below).max(1.0);
        let window = window(bounds, &self.y, height / (1.2 * font));
        let ticks = ticks(&window, unit.factor, Labels::Column);
        let widest = ticks.iter().map(|tick| numeral(&tick.label));
        let widest = widest.map(|label| font::set_width(&label));
        Ordinate {
            left: widest.fold(0.0, f64::max) * font + 2.6 * font,
            top,
            height,
            unit,
            window,
            ticks,
        }
    }

    /// Draws the chart into the rectangle at `at` of `size` (mm), with this ordinate of its own.
    /// An inset has the legend of its chart.
    pub(super) fn draw(
        &self,
        is_inset: bool,
        canvas: &mut Canvas,
        [at, size]: [[f64; 2]; 2],
        ordinate: Ordinate,
        look: &Look,
    ) {
        let font = look.font;
        let bounds = self.bounds_on_paper()[0];
        let (left, top, height) = (ordinate.left, ordinate.top, ordinate.height);
        let units = [unit_of(&self.x, bounds), ordinate.unit];
        let (vertical, y_ticks) = (ordinate.window, ordinate.ticks);
        let key = self.map.as_ref().map(|map| Key::new(map, height, font));
        let right = key
            .as_ref()
            .map_or(1.4 * font, |key| key.width(font) + 1.2 * font);
        let width = (size[0] - left - right).max(1.0);
        // A digit is about 0.57 of the font's size wide.
        let horizontal = window(bounds, &self.x, width / (0.57 * font));
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
        if let Some(key) = &key {
            key.fill([&self.x, &self.y], &frame, canvas, look);
            key.draw(&frame, canvas, look);
        }
        for mark in &self.marks {
            self.mark(mark.x, mark.label, &frame, canvas, font);
        }
        let mut drawn = Vec::new();
        if self.map.is_some() {
            let parts = self.curves.iter().flat_map(|curve| frame.clipped(curve));
            for part in parts {
                canvas.line(part, WHITE, CURVE + 2.0 * HALO, &[]);
            }
        }
        // Dashes lie on top: of two curves in one place both are seen.
        let [dashed, whole] = [true, false].map(|is| move |curve: &&Curve| curve.dashed == is);
        let curves = self.curves.iter();
        for curve in curves.clone().filter(whole).chain(curves.filter(dashed)) {
            let dashes = look.dashes(curve.role, curve.dashed);
            let parts = frame.clipped(curve);
            for part in parts.into_iter().filter(|_| curve.has_line) {
                drawn.extend(along(&part));
                canvas.line(part, look.color(curve.role), CURVE, dashes);
            }
            if curve.has_symbols {
                drawn.extend(frame.points(curve, canvas, look));
            }
        }
        self.axes(&frame, &units, [&x_ticks, &y_ticks], at, canvas, font);
        let above = [at[0] + 0.3 * font, at[1] + 1.1 * font];
        canvas.text(above, &self.title, font, Anchor::Start);
        if let Some(inset) = &self.inset {
            let size = [INSET[0] * width, INSET[1] * height];
            let small = Look {
                font: 0.8 * font,
                ..*look
            };
            let corner = [frame.left + TICK, frame.top + TICK];
            let ordinate = inset.ordinate(size[1], 0.0, &small);
            inset.draw(true, canvas, [corner, size], ordinate, &small);
            let [wide, high] = size.map(|side| side + 2.0 * TICK);
            let rows = (0..20).map(|k| frame.top + high * f64::from(k) / 20.0);
            drawn.extend(rows.flat_map(|y| {
                (0..200).map(move |k| [frame.left + wide * f64::from(k) / 200.0, y])
            }));
        }
        if !is_inset {
            self.legend(&frame, &drawn, canvas, look);
        }
    }

    /// The values at the ends of both axes: as given, else from the data, the ordinate's rounded.
    pub fn bounds_on_paper(&self) -> [[f64; 2]; 2] {
        let (extent, axes) = (self.extent(|_| true), [&self.x, &self.y]);
        [0, 1].map(|k| {
            let (axis, is_x) = (axes[k], k == 0);
            let has_margin = is_x && self.margin > 0.0;
            let is_full = is_x || self.map.is_some();
            let apart = |end: f64, by: f64| if end == 0.0 { 0.0 } else { end + by };
            let data = extent[k].map(|[low, high]| match axis.scale {
                _ if has_margin && high > low => axis.with_margin([low, high], self.margin),
                Scale::Linear if !is_full => {
                    let more = HEADROOM * (high - low);
                    [apart(low, -more), apart(high, more)]
                }
                _ => [low, high],
            });
            let is_rounded = match axis.scale {
                Scale::Linear => !is_full,
                Scale::Log => !has_margin,
            };
            axis.resolve(data, is_rounded)
        })
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
        all_ticks: [&[Tick]; 2],
        at: [f64; 2],
        canvas: &mut Canvas,
        font: f64,
    ) {
        let [left, top, width, height] = [frame.left, frame.top, frame.size[0], frame.size[1]];
        let (right, bottom) = (frame.right(), frame.bottom());
        let corners = [
            [left, top],
            [right, top],
            [right, bottom],
            [left, bottom],
            [left, top],
        ];
        canvas.line(corners.to_vec(), BLACK, FRAME, &[]);
        let firsts = [0, 1].map(|k| frame.windows[k].bounds()[0]);
        for (k, ticks) in all_ticks.into_iter().enumerate() {
            let place = |value: f64| match k {
                0 => frame.place(value, firsts[1]).map(|[x, _]| [x, bottom]),
                _ => frame.place(firsts[0], value).map(|[_, y]| [left, y]),
            };
            let inwards = |[x, y]: [f64; 2], length: f64| match k {
                0 => [x, y - length],
                _ => [x + length, y],
            };
            for from in minor(&frame.windows[k], ticks)
                .into_iter()
                .filter_map(place)
            {
                let to = inwards(from, 0.55 * TICK);
                canvas.line(vec![from, to], BLACK, FRAME, &[]);
            }
            for tick in ticks {
                let Some(from) = place(tick.value) else {
                    continue;
                };
                canvas.line(vec![from, inwards(from, TICK)], BLACK, FRAME, &[]);
                let (at, anchor) = match k {
                    0 => ([from[0], bottom + 1.25 * font], Anchor::Middle),
                    _ => ([left - 0.4 * font, from[1] + 0.36 * font], Anchor::End),
                };
                canvas.text(at, &numeral(&tick.label), font, anchor);
            }
        }
        let label =
            |axis: &Axis, unit: &AxisUnit| titled(&axis.label, &numeral(&unit.text), ['(', ')']);
        let below = [left + 0.5 * width, bottom + 2.7 * font];
        canvas.text(below, &label(&self.x, &units[0]), font, Anchor::Middle);
        let beside = [at[0] + 1.2 * font, top + 0.5 * height];
        canvas.text_upwards(beside, &label(&self.y, &units[1]), font);
    }

    /// The curves that the legend names.
    fn named(&self) -> impl Iterator<Item = &Curve> {
        self.curves.iter().filter(|curve| !curve.name.is_empty())
    }

    /// The names of the curves, in the corner where they cover the least of them; those of a map below it.
    fn legend(&self, frame: &Frame, drawn: &[[f64; 2]], canvas: &mut Canvas, look: &Look) {
        let font = 0.9 * look.font;
        if self.named().next().is_none() {
            return;
        }
        let (swatch, line, gap) = (2.6 * font, LEGEND_LINE * look.font, 0.6 * font);
        let widest = self.named().map(|curve| font::set_width(&curve.name));
        let width = swatch + 2.0 * gap + widest.fold(0.0, f64::max) * font;
        let height = line * self.named().count() as f64 + gap;
        let [left, top] = [frame.left + TICK, frame.top + TICK];
        let (right, bottom) = (frame.right() - TICK - width, frame.bottom() - TICK - height);
        let covered = |[x, y]: [f64; 2]| {
            let hit =
                |p: &&[f64; 2]| (x..x + width).contains(&p[0]) && (y..y + height).contains(&p[1]);
            drawn.iter().filter(hit).count()
        };
        let corners = [[right, top], [left, top], [right, bottom], [left, bottom]];
        let best = corners.into_iter().min_by_key(|&corner| covered(corner));
        let [x, y] = match self.map {
            Some(_) => [frame.left, frame.bottom() + 3.0 * look.font],
            None => best.unwrap_or([right, top]),
        };
        for (k, curve) in self.named().enumerate() {
            let middle = y + gap / 2.0 + line * (k as f64 + 0.5);
            let [from, to] = [x + gap / 2.0, x + gap / 2.0 + swatch];
            let ink = look.color(curve.role);
            if curve.has_line {
                let dashes = look.dashes(curve.role, curve.dashed);
                canvas.line(vec![[from, middle], [to, middle]], ink, CURVE, dashes);
            }
            if curve.has_symbols {
                let place = [0.5 * (from + to), middle];
                canvas.line(symbol(curve.role, place), ink, BAR, &[]);
            }
            let place = [x + gap + swatch, middle + 0.36 * font];
            canvas.text(place, &curve.name, font, Anchor::Start);
        }
    }
}

/// The ordinate of a chart on paper: its ticks, where its frame begins below the upper edge and how high it is, and
/// how much its words and numbers take to the left of it, mm.
pub(super) struct Ordinate {
    pub left: f64,
    top: f64,
    height: f64,
    unit: AxisUnit,
    window: Window,
    ticks: Vec<Tick>,
}

/// The scale of an axis with room for this many labels.
fn window(bounds: [f64; 2], axis: &Axis, cells: f64) -> Window {
    Window::new(bounds, axis.scale, cells.clamp(2.0, 400.0) as u16, 16)
}

/// Height of a line of the legend, in sizes of the font.
const LEGEND_LINE: f64 = 1.17;

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

/// The unit that an axis is labelled in; logarithmic ones over many decades keep that of the data.
pub(super) fn unit_of(axis: &Axis, bounds: [f64; 2]) -> AxisUnit {
    let largest = bounds[0].abs().max(bounds[1].abs());
    let is_narrow = !axis.unit.is_empty() && bounds[1] / bounds[0] < ONE_PREFIX;
    match axis.scale {
        Scale::Log if !is_narrow => AxisUnit {
            factor: 1.0,
            text: axis.unit.to_owned(),
        },
        _ => axis_unit(largest, axis.unit, false),
    }
}

/// Ticks between those with labels: five, four or two to a step; 2 to 9 in a decade.
fn minor(window: &Window, labelled: &[Tick]) -> Vec<f64> {
    let [low, high] = window.bounds();
    let within = |value: &f64| (low..=high).contains(value);
    if window.scale() == Scale::Log {
        let decades = low.log10().floor() as i32..=high.log10().floor() as i32;
        let few = decades.clone().count() <= 8;
        let mantissas = if few { 1..10 } else { 1..2 };
        return decades
            .flat_map(|decade| {
                let sizes = mantissas.clone();
                sizes.map(move |mantissa| f64::from(mantissa) * 10f64.powi(decade))
            })
            .filter(within)
            .collect();
    }
    let [first, second, ..] = labelled else {
        return Vec::new();
    };
    let step = second.value - first.value;
    let mantissa = step / 10f64.powf((step * 1.000_001).log10().floor());
    let parts = if (1.5..3.5).contains(&mantissa) { 4 } else { 5 };
    let last = ((high - low) / step) as i32 + 2;
    let all = (-parts..=last * parts).map(|k| first.value + step * f64::from(k) / f64::from(parts));
    all.filter(within).collect()
}

/// A number, alone or before a unit, as print has it: a true minus sign, and 2e-8 as 2·10^−8.
pub(super) fn numeral(text: &str) -> String {
    let (number, unit) = text.split_once(' ').unwrap_or((text, ""));
    let is_number = number.parse::<f64>().is_ok();
    let (mantissa, exponent) = match number.split_once('e') {
        Some((mantissa, exponent)) if is_number => (mantissa, Some(exponent)),
        _ => (number, None),
    };
    let signed = |text: &str| text.replace('-', "−");
    let number = match (mantissa, exponent) {
        (_, None) if !is_number => mantissa.to_owned(),
        (_, None) => signed(mantissa),
        ("1", Some(exponent)) => format!("10^{}", signed(exponent)),
        (mantissa, Some(exponent)) => format!("{}·10^{}", signed(mantissa), signed(exponent)),
    };
    match unit {
        "" => number,
        unit => format!("{number} {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_set_as_print_has_them() {
        for (text, set) in [
            ("0.5", "0.5"),
            ("-20", "−20"),
            ("1e-4", "10^−4"),
            ("2e8", "2·10^8"),
            ("1e-9 m", "10^−9 m"),
            ("µm", "µm"),
            ("cycles", "cycles"),
            ("1/Pa", "1/Pa"),
        ] {
            assert_eq!(numeral(text), set);
        }
    }

    #[test]
    fn minor_ticks_lie_between_the_labelled_ones() {
        let axis = |bounds, scale| {
            let window = Window::new(bounds, scale, 40, 16);
            let row = Labels::Row {
                before: 0,
                apart: 0,
            };
            minor(&window, &ticks(&window, 1.0, row))
        };
        let linear = axis([0.0, 1.0], Scale::Linear);
        assert!(linear.len() > 12 && linear.iter().all(|v| (0.0..=1.0).contains(v)));
        let log = axis([1e-3, 1.0], Scale::Log);
        assert_eq!(log.len(), 28);
        assert!((log[1] - 2e-3).abs() < 1e-12);
    }
}
