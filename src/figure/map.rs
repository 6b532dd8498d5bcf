//! A map on paper, and the key to its colours.

use super::canvas::{Anchor, Page};
use super::font;
use super::interior::Interior;
use super::look::FigureStyle;
use super::ruler::{column, numeral, title};
use crate::plot::ticks::Ruler;
use crate::plot::{Axis, Map};

/// What is drawn to the right of a map: the ticks of its colours, or its words.
pub(super) struct ColorKey<'a> {
    map: &'a Map,
    ruler: Ruler,
}

impl<'a> ColorKey<'a> {
    pub fn new(map: &'a Map, height: f64, font: f64) -> Self {
        let mut ruler = column(&map.quantity, map.range(), height, font);
        if !map.words.is_empty() {
            ruler.ticks.clear();
        }
        Self { map, ruler }
    }

    /// Returns its whole width, mm.
    pub fn width(&self, font: f64) -> f64 {
        let labels = self.ruler.ticks.iter().map(|tick| numeral(&tick.label));
        let words = self.map.words.iter().map(|word| (*word).to_owned());
        let widest = labels.chain(words).map(|text| font::set_width(&text));
        let title = if self.map.words.is_empty() { 2.0 } else { 0.5 };
        (widest.fold(0.0, f64::max) + 2.3 + title) * font
    }

    pub fn draw(&self, frame: &Interior, canvas: &mut Page, look: &FigureStyle) {
        let font = look.font;
        let (left, top, height) = (frame.right() + 0.8 * font, frame.top, frame.size[1]);
        let label_x = left + 1.4 * font;
        let is_there = |k: usize| self.map.values.contains(&(k as f64));
        let words = self.map.words.iter().enumerate();
        for (line, (k, word)) in words.filter(|(k, _)| is_there(*k)).enumerate() {
            let y = top + 1.4 * font * line as f64;
            canvas.area([left, y], [font, font], look.regime(k));
            canvas.text([label_x, y + 0.86 * font], word, font, Anchor::Start);
        }
        if !self.map.words.is_empty() {
            return;
        }
        const STEPS: usize = 32;
        for k in 0..STEPS {
            let share = (k as f64 + 0.5) / STEPS as f64;
            let [low, high] =
                [k, (k + 2).min(STEPS)].map(|step| height * step as f64 / STEPS as f64);
            let ink = look.mapped(self.map.colors, share);
            canvas.area([left, top + height - high], [font, high - low], ink);
        }
        for tick in &self.ruler.ticks {
            if let Some(share) = self.ruler.window.share(tick.value) {
                let y = top + height * (1.0 - share) + 0.36 * font;
                canvas.text([label_x, y], &numeral(&tick.label), font, Anchor::Start);
            }
        }
        let title = title(&self.map.quantity, &self.ruler.unit);
        let edge = frame.right() + self.width(font);
        canvas.text_upwards([edge, top + 0.5 * height], &title, font);
    }

    /// Draws the map, equal neighbours as one area. Each area extends under the ones drawn after it, except where they
    /// are blank: between areas that only touch, viewers let the paper show through.
    pub fn fill(&self, axes: [&Axis; 2], frame: &Interior, canvas: &mut Page, look: &FigureStyle) {
        let map = self.map;
        let range = map.range();
        let is_there = |value: &f64| value.is_finite();
        let color = |value: f64| {
            is_there(&value).then(|| {
                if map.words.is_empty() {
                    look.mapped(map.colors, map.share(value, range))
                } else {
                    look.regime(value as usize)
                }
            })
        };
        let within = |k: usize| {
            let [low, high] = frame.rulers[k].window.bounds;
            let edges = axes[k].edges(&map.places[k]).into_iter();
            let edges = edges.map(|edge| edge.clamp(low, high));
            edges.collect::<Vec<f64>>()
        };
        let (across, down) = (within(0), within(1));
        let width = map.places[0].len();
        let rows: Vec<&[f64]> = map.values.chunks(width).collect();
        for (row, values) in rows.iter().enumerate() {
            let mut end = 0;
            for same in values.chunk_by(|a, b| color(*a) == color(*b)) {
                let (start, ink) = (end, color(same[0]));
                end += same.len();
                let right = end + usize::from(values.get(end).is_some_and(is_there));
                let below = rows.get(row + 1).map(|below| &below[start..right]);
                let is_whole = below.is_some_and(|below| below.iter().all(is_there));
                let bottom = row + 1 + usize::from(is_whole);
                let corners = [
                    frame.place(across[start], down[row]),
                    frame.place(across[right], down[bottom]),
                ];
                if let ([Some(a), Some(b)], Some(ink)) = (corners, ink) {
                    let at = [a[0].min(b[0]), a[1].min(b[1])];
                    let size = [(b[0] - a[0]).abs(), (b[1] - a[1]).abs()];
                    canvas.area(at, size, ink);
                }
            }
        }
    }
}
