//! Values over two axes, drawn as colours.

use ratatui::style::Color;
use ratatui::text::{Line, Span};

use super::axis::{Axis, Scale};
use super::colormap::{ColorMap, indexed};
use super::shades::{self, SHADES, has_blocks};
use super::theme::{Look, Role, Theme};
use super::units::range_ends;
use crate::math::scan::range;

/// Maximum number of words that a map can distinguish.
pub const WORDS: usize = 4;

/// Characters from low to high, in a terminal without colours; even the lowest value differs from a blank.
pub const SIGNS: [char; SHADES] = ['.', ':', '-', '=', '+', 'c', 'o', 'x', '*', '%', '#', '@'];

/// The characters and roles of words in a terminal. For running conditions, stick and slip have the same colours as in
/// all panels, and people with any kind of colour vision can tell the third colour from both.
pub const SWATCHES: [(char, Role); WORDS] = [
    ('s', Role::Stick),
    ('~', Role::Pressure),
    ('#', Role::Slip),
    (' ', Role::Limit),
];

/// Values on a grid of places, as colours; NaN stays blank.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The quantity and its unit; the colours end at its bounds, if given.
    pub quantity: Axis,
    /// The abscissae and the ordinates of the grid, monotonic.
    pub places: [Vec<f64>; 2],
    /// The values, row by row: all abscissae for the first ordinate, then for the next.
    pub values: Vec<f64>,
    /// The colours.
    pub colors: ColorMap,
    /// The words for the values 0, 1, …, at most [`WORDS`]; empty if the values are quantities.
    pub words: Vec<&'static str>,
}

impl Map {
    /// Returns the values at the ends of the colours.
    pub fn range(&self) -> [f64; 2] {
        if let Some([low, high]) = self.quantity.bounds.filter(|[low, high]| low < high) {
            return [low, high];
        }
        let shown = self.values.iter().copied();
        let shown = range(shown.filter(|value| self.quantity.scale.has(*value)));
        match (self.quantity.scale, shown) {
            (Scale::Log, Some([low, high])) if low < high => [low, high],
            (Scale::Log, _) => [0.1, 10.0],
            (Scale::Linear, Some([low, high])) => self.colors.range([low.min(0.0), high.max(0.0)]),
            (Scale::Linear, None) => self.colors.range([0.0; 2]),
        }
    }

    /// Returns where a quantity's value lies between the ends of the colours, 0 to 1.
    pub fn share(&self, value: f64, range: [f64; 2]) -> f64 {
        let scale = self.quantity.scale;
        let [low, high] = range.map(|end| scale.spread(end));
        (scale.spread(value) - low) / (high - low)
    }

    /// Returns the key to its colours: the quantity between the ends of the colours, or the words.
    pub(super) fn key(&self, theme: &Theme) -> Vec<Line<'static>> {
        let words = SWATCHES.into_iter().zip(&self.words);
        let words = words.map(|((sign, role), word)| {
            let swatch = if has_blocks(theme) { '█' } else { sign };
            let swatch = Span::styled(swatch.to_string(), theme.style(role));
            Line::from_iter([swatch, Span::raw(format!(" {word}"))])
        });
        if !self.words.is_empty() {
            return words.collect();
        }
        let name = theme.printable(&self.quantity.label);
        let mut line = Line::from(Span::styled(name, theme.style(Role::Focus)));
        let is_shown = |value: &f64| self.quantity.scale.has(*value);
        if self.values.iter().any(is_shown) {
            let [low, high] = range_ends(self.range(), self.quantity.unit, 3);
            let log = if self.quantity.scale == Scale::Log {
                "  log"
            } else {
                ""
            };
            let ends = [format!("  {low} "), format!(" {high}{log}")];
            let ends = ends.map(|end| theme.printable(&end));
            line.extend(shades::key(theme, self.colors, SIGNS, ends));
        }
        vec![line]
    }

    /// Returns the colour of a value in a terminal, and the character that replaces it without colours.
    pub(super) fn look(&self, value: f64, range: [f64; 2], theme: &Theme) -> (Option<Color>, char) {
        if !self.quantity.scale.has(value) {
            return (None, ' ');
        }
        if self.words.is_empty() {
            let share = self.share(value, range).clamp(0.0, 1.0);
            return (
                shades::color(theme, self.colors, share),
                shades::sign(SIGNS, share),
            );
        }
        let (sign, role) = SWATCHES[value as usize % WORDS];
        (theme.style(role).fg, sign)
    }
}

/// Puts parts side by side, in as many lines of this width as they need.
pub fn side_by_side(
    parts: impl IntoIterator<Item = Line<'static>>,
    width: u16,
) -> Vec<Line<'static>> {
    let mut lines: Vec<Line> = Vec::new();
    for part in parts {
        let fits = |line: &&mut Line| line.width() + 2 + part.width() <= usize::from(width);
        match lines.last_mut().filter(fits) {
            Some(line) => {
                line.push_span("  ");
                line.extend(part);
            }
            None => lines.push(part),
        }
    }
    lines
}

/// Returns the colour of text on a map: white on its dark blues, black on bright colours.
pub(super) fn ink_on(ground: Color) -> Color {
    let rgb = match ground {
        Color::Reset => return Color::Reset,
        Color::Blue => return Color::White,
        Color::Indexed(index) => indexed(index),
        Color::Rgb(red, green, blue) => [red, green, blue],
        _ => return Color::Black,
    };
    match Look::for_background(rgb) {
        Look::Light => Color::Black,
        _ => Color::Indexed(231),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Marker;
    use crate::plot::theme::Depth;

    /// What a deuteranope sees of linear red, green and blue (G. Machado et al. 2009).
    const DEUTERANOPE: [[f64; 3]; 3] = [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ];

    #[test]
    fn a_deuteranope_tells_the_words_apart() {
        for look in [Look::Dark, Look::Light] {
            let theme = Theme::new(look, Marker::Braille).with_depth(Depth::Indexed);
            let seen = |word: usize| {
                let Some(Color::Indexed(index)) = theme.style(SWATCHES[word].1).fg else {
                    panic!("{word} has no colour of the cube");
                };
                let digits = [36, 6, 1].map(|place| (index - 16) / place % 6);
                let linear = digits.map(|digit| match f64::from(digit) {
                    0.0 => 0.0,
                    digit => ((55.0 + 40.0 * digit) / 255.0).powf(2.2),
                });
                DEUTERANOPE.map(|row| (0..3).map(|k| row[k] * linear[k]).sum::<f64>())
            };
            // Lift-off has no character; each of the others has one.
            for (a, b, least) in [
                (0, 1, 0.3),
                (1, 2, 0.5),
                (0, 2, 0.2),
                (0, 3, 0.3),
                (1, 3, 0.1),
                (2, 3, 0.5),
            ] {
                let apart = seen(a).into_iter().zip(seen(b));
                let apart = apart.map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                assert!(apart > least, "{look:?} {a} {b}: {apart}");
            }
        }
    }

    #[test]
    fn signs_are_seen_on_both_ends_of_the_colours() {
        let theme = Theme::new(Look::Dark, Marker::Braille);
        for depth in [Depth::Indexed, Depth::True] {
            let theme = theme.with_depth(depth);
            let ground = |share| shades::color(&theme, ColorMap::Sequential, share);
            let inks = [0.0, 0.2, 0.6, 1.0].map(|share| ink_on(ground(share).expect("a colour")));
            let [white, black] = [Color::Indexed(231), Color::Black];
            assert_eq!(inks, [white, white, black, black], "{depth:?}");
        }
    }
}
