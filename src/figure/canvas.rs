//! Page primitives: lines, areas and text in millimetres, with y downwards, in drawing order.

use super::font;
pub use crate::plot::colormap::Rgb;

/// Black, for axes and text.
pub const BLACK: Rgb = [0, 0, 0];

/// White, for the paper.
pub const WHITE: Rgb = [255; 3];

/// How a text is aligned to its point; the names are SVG's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Anchor {
    /// The text begins at the point.
    Start,
    /// The text is centred at the point.
    Middle,
    /// The text ends at the point.
    End,
}

impl Anchor {
    /// Returns the fraction of a text's width that lies before its point.
    pub fn share_before(self) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Middle => 0.5,
            Self::End => 1.0,
        }
    }
}

/// A line through points.
#[derive(Debug, Clone, PartialEq)]
pub struct StyledLine {
    /// The points, mm.
    pub points: Vec<[f64; 2]>,
    /// Its colour.
    pub ink: Rgb,
    /// Its width, mm.
    pub width: f64,
    /// Lengths of dashes and gaps, mm; empty for a solid line.
    pub dashes: &'static [f64],
}

/// A line of text.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// A point on the baseline, mm.
    pub at: [f64; 2],
    /// The text.
    pub words: String,
    /// The font size, mm.
    pub size: f64,
    /// How the text is aligned to the point.
    pub anchor: Anchor,
    /// Whether the text runs upwards instead of to the right.
    pub upwards: bool,
}

/// One thing on the paper.
#[derive(Debug, Clone, PartialEq)]
pub enum Primitive {
    /// A line through points.
    Line(StyledLine),
    /// A filled rectangle.
    Area {
        /// Its upper left corner, mm.
        at: [f64; 2],
        /// Width and height, mm.
        size: [f64; 2],
        /// Its colour.
        ink: Rgb,
    },
    /// A line of text.
    Text(Text),
}

/// A sheet of paper and what is drawn on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// Width and height, mm.
    pub size: [f64; 2],
    /// The shapes, in drawing order.
    pub shapes: Vec<Primitive>,
    /// The title, for the file's metadata.
    pub title: String,
    /// Data for the caption: names and values.
    pub facts: Vec<(String, String)>,
}

impl Page {
    /// Draws a line.
    pub fn line(&mut self, points: Vec<[f64; 2]>, ink: Rgb, width: f64, dashes: &'static [f64]) {
        let line = StyledLine {
            points,
            ink,
            width,
            dashes,
        };
        self.shapes.push(Primitive::Line(line));
    }

    /// Fills a rectangle.
    pub fn area(&mut self, at: [f64; 2], size: [f64; 2], ink: Rgb) {
        self.shapes.push(Primitive::Area { at, size, ink });
    }

    /// Writes a line of text in a font of `size` mm, with the subscripts and superscripts found by [`font::runs`].
    pub fn text(&mut self, at: [f64; 2], words: &str, size: f64, anchor: Anchor) {
        self.set(at, words, size, anchor, false);
    }

    /// Writes a line of text upwards, centred at `at`.
    pub fn text_upwards(&mut self, at: [f64; 2], words: &str, size: f64) {
        self.set(at, words, size, Anchor::Middle, true);
    }

    fn set(&mut self, at: [f64; 2], words: &str, size: f64, anchor: Anchor, upwards: bool) {
        let runs = font::runs(words);
        let mut along = -anchor.share_before() * font::set_width(words) * size;
        let alone = runs.len() == 1;
        for run in runs {
            let lift = run.lift * size;
            let at = match (alone, upwards) {
                (true, _) => at,
                (false, true) => [at[0] - lift, at[1] - along],
                (false, false) => [at[0] + along, at[1] - lift],
            };
            along += run.width() * size;
            self.shapes.push(Primitive::Text(Text {
                at,
                words: run.words,
                size: run.size * size,
                anchor: if alone { anchor } else { Anchor::Start },
                upwards,
            }));
        }
    }

    /// Returns the facts as text, one per line.
    pub fn caption(&self) -> String {
        let lines = self.facts.iter();
        let lines = lines.map(|(key, value)| format!("{key}: {value}"));
        lines.collect::<Vec<_>>().join("\n")
    }
}
