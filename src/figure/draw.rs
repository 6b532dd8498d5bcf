//! Draws a chart on paper: axes with the same ticks and units as on the screen, curves, a map, a legend.

use super::canvas::{Anchor, BLACK, Page, WHITE};
use super::font;
use super::interior::{BAR, Interior, symbol};
use super::look::FigureStyle;
use super::map::ColorKey;
use super::ruler::{column, numeral, ruler, title};
use crate::plot::segment::clip;
use crate::plot::ticks::{Labels, Ruler};
use crate::plot::{Chart, Curve, Scale};

/// Free space above and below the data, relative to their extent, so that no plateau lies on the frame. Zero may lie on
/// the frame, because it is an axis.
const HEADROOM: f64 = 0.04;

/// Widths of curves, of axes, and of the white margin along a line on a map, mm.
const CURVE: f64 = 0.35;
const FRAME: f64 = 0.15;
const HALO: f64 = 0.2;

/// Length of a tick, mm.
const TICK: f64 = 1.0;

/// Width and height of an inset, relative to the frame.
const INSET: [f64; 2] = [0.58, 0.5];

impl Chart {
    /// Returns the height of the legend below the frame, mm. Only a map has its legend there, where it hides no
    /// colours.
    pub(super) fn height_below(&self, look: &FigureStyle) -> f64 {
        match self.map {
            Some(_) => self.named_curves().count() as f64 * LEGEND_LINE * look.font,
            None => 0.0,
        }
    }

    /// Lays out the ordinate of a chart of `height` mm, with a legend of `below` mm under it.
    pub(super) fn ordinate(&self, height: f64, below: f64, look: &FigureStyle) -> Ordinate {
        let font = look.font;
        let top = if self.title.is_empty() { 0.6 } else { 1.8 } * font;
        let height = (height - top - 3.4 * font - below).max(1.0);
        let ruler = column(&self.y, self.bounds_on_paper()[1], height, font);
        let labels = ruler.ticks.iter().map(|tick| numeral(&tick.label));
        let widest = labels.map(|label| font::set_width(&label));
        Ordinate {
            left: widest.fold(0.0, f64::max) * font + 2.6 * font,
            top,
            height,
            ruler,
        }
    }

    /// Draws the chart into the rectangle at `at` of `size` (mm), with the given ordinate. An inset has no legend: its
    /// chart's applies.
    pub(super) fn draw(
        &self,
        is_inset: bool,
        canvas: &mut Page,
        [at, size]: [[f64; 2]; 2],
        ordinate: Ordinate,
        look: &FigureStyle,
    ) {
        let font = look.font;
        let (left, top, height) = (ordinate.left, ordinate.top, ordinate.height);
        let key = self
            .map
            .as_ref()
            .map(|map| ColorKey::new(map, height, font));
        let right = key
            .as_ref()
            .map_or(1.4 * font, |key| key.width(font) + 1.2 * font);
        let width = (size[0] - left - right).max(1.0);
        // A digit is about 0.57 times as wide as the font size.
        let across = width / (0.57 * font);
        let across = ruler(&self.x, self.bounds_on_paper()[0], across, Labels::Row(0));
        let frame = Interior {
            left: at[0] + left,
            top: at[1] + top,
            size: [width, height],
            rulers: [across, ordinate.ruler],
            downwards: self.y.downwards,
        };
        if let Some(key) = &key {
            key.fill([&self.x, &self.y], &frame, canvas, look);
            key.draw(&frame, canvas, look);
        }
        for mark in &self.marks {
            if let Some([low, high]) = frame.vertical(mark.x) {
                canvas.line(vec![low, high], BLACK, FRAME, &[0.3, 0.7]);
                let above = [low[0], frame.top - 0.3 * font];
                canvas.text(above, mark.label, 0.9 * font, Anchor::Middle);
            }
        }
        let mut drawn: Vec<[[f64; 2]; 2]> = Vec::new();
        if self.map.is_some() {
            let parts = self.curves.iter();
            let parts = parts.flat_map(|curve| frame.clipped(curve.points()));
            for part in parts {
                canvas.line(part, WHITE, CURVE + 2.0 * HALO, &[]);
            }
        }
        // Dashed curves lie on top, so that two curves at the same place are both visible.
        let mut curves: Vec<&Curve> = self.curves.iter().collect();
        curves.sort_by_key(|curve| curve.dashed);
        for curve in curves {
            let dashes = look.dashes(curve.role, curve.dashed);
            let parts = frame.clipped(curve.points());
            for part in parts.into_iter().filter(|_| curve.has_line) {
                drawn.extend(part.windows(2).map(|pair| [pair[0], pair[1]]));
                canvas.line(part, look.color(curve.role), CURVE, dashes);
            }
            if curve.has_symbols {
                let points = frame.points(curve, canvas, look).into_iter();
                drawn.extend(points.map(|at| [at; 2]));
            }
        }
        self.axes(&frame, at[0], canvas, font);
        let above = [at[0] + 0.3 * font, at[1] + 1.1 * font];
        canvas.text(above, &self.title, font, Anchor::Start);
        if let Some(inset) = &self.inset {
            let size = [INSET[0] * width, INSET[1] * height];
            let small = FigureStyle {
                font: 0.8 * font,
                ..*look
            };
            let corner = [frame.left + TICK, frame.top + TICK];
            let ordinate = inset.ordinate(size[1], 0.0, &small);
            inset.draw(true, canvas, [corner, size], ordinate, &small);
            let [wide, high] = size.map(|side| side + 2.0 * TICK);
            let rows = (0..20).map(|k| frame.top + high * f64::from(k) / 20.0);
            drawn.extend(rows.map(|y| [[frame.left, y], [frame.left + wide, y]]));
        }
        if !is_inset {
            self.legend(&frame, &drawn, canvas, look);
        }
    }

    /// Returns the values at the ends of both axes: the given bounds, or else the data's extent, rounded for the
    /// ordinate.
    pub fn bounds_on_paper(&self) -> [[f64; 2]; 2] {
        let (extent, axes) = (self.extent(|_| true), [&self.x, &self.y]);
        [0, 1].map(|k| {
            let (axis, is_log) = (axes[k], axes[k].scale == Scale::Log);
            let has_margin = k == 0 && self.margin > 0.0;
            let has_headroom = k == 1 && self.map.is_none() && !is_log;
            let apart = |end: f64, by: f64| if end == 0.0 { 0.0 } else { end + by };
            let data = extent[k].map(|[low, high]| {
                let more = HEADROOM * (high - low);
                match high > low {
                    true if has_margin => axis.with_margin([low, high], self.margin),
                    _ if has_headroom => [apart(low, -more), apart(high, more)],
                    _ => [low, high],
                }
            });
            axis.resolve(data, has_headroom || is_log && !has_margin)
        })
    }

    /// Draws the frame with its ticks and labels; the paper begins at `edge`.
    fn axes(&self, frame: &Interior, edge: f64, canvas: &mut Page, font: f64) {
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
        for (k, ruler) in frame.rulers.iter().enumerate() {
            // The outer end of a tick, and the inner one.
            let place = |value: f64| {
                let share = ruler.window.share(value)?;
                Some(match k {
                    0 => [left + share * width, bottom],
                    _ => [left, frame.height_of(share)],
                })
            };
            let inwards = |[x, y]: [f64; 2], length: f64| match k {
                0 => [x, y - length],
                _ => [x + length, y],
            };
            for from in ruler.minor().into_iter().filter_map(place) {
                let to = inwards(from, 0.55 * TICK);
                canvas.line(vec![from, to], BLACK, FRAME, &[]);
            }
            for tick in &ruler.ticks {
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
        let [x, y] = &frame.rulers;
        let below = [left + 0.5 * width, bottom + 2.7 * font];
        canvas.text(below, &title(&self.x, &x.unit), font, Anchor::Middle);
        let title_at = [edge + 1.2 * font, top + 0.5 * height];
        canvas.text_upwards(title_at, &title(&self.y, &y.unit), font);
    }

    /// Draws the names of the curves in the corner where they cover the least of them, or below a map.
    fn legend(
        &self,
        frame: &Interior,
        drawn: &[[[f64; 2]; 2]],
        canvas: &mut Page,
        look: &FigureStyle,
    ) {
        let font = 0.9 * look.font;
        if self.named_curves().next().is_none() {
            return;
        }
        let (swatch, line, gap) = (2.6 * font, LEGEND_LINE * look.font, 0.6 * font);
        let widest = self
            .named_curves()
            .map(|curve| font::set_width(&curve.name));
        let width = swatch + 2.0 * gap + widest.fold(0.0, f64::max) * font;
        let height = line * self.named_curves().count() as f64 + gap;
        let [left, top] = [frame.left + TICK, frame.top + TICK];
        let (right, bottom) = (frame.right() - TICK - width, frame.bottom() - TICK - height);
        // Counts the drawn length inside in half millimetres; a point or a short piece counts as one.
        let covered = |[x, y]: [f64; 2]| -> usize {
            let inside = |&[a, b]: &[[f64; 2]; 2]| clip(a, b, [x, y], [x + width, y + height]);
            let lengths = drawn.iter().filter_map(inside);
            let lengths = lengths.map(|[a, b]| (b[0] - a[0]).hypot(b[1] - a[1]));
            lengths
                .map(|length| (2.0 * length).ceil().max(1.0) as usize)
                .sum()
        };
        let corners = [[right, top], [left, top], [right, bottom], [left, bottom]];
        let best = corners.into_iter().min_by_key(|&corner| covered(corner));
        let [x, y] = match self.map {
            Some(_) => [frame.left, frame.bottom() + 3.0 * look.font],
            None => best.unwrap_or([right, top]),
        };
        for (k, curve) in self.named_curves().enumerate() {
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

/// The layout of a chart's ordinate on paper, mm: the space that its title and numbers take to the left of the frame,
/// the top of the frame below the upper edge, and its height.
pub(super) struct Ordinate {
    pub left: f64,
    top: f64,
    height: f64,
    ruler: Ruler,
}

/// Line height of the legend, in font sizes.
const LEGEND_LINE: f64 = 1.17;
