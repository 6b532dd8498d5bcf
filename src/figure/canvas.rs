//! Primitives of a figure: lines, areas and text in millimetres, y downwards, in drawing order.

use super::font;
pub use crate::plot::colormap::Rgb;

/// Black, for axes and words.
pub const BLACK: Rgb = [0, 0, 0];

/// White, as paper is.
pub const WHITE: Rgb = [255; 3];

/// Where a text stands about its point, with the name that SVG has for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Anchor {
    /// It begins there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

impl Anchor {
    /// The share of a text's width that stands before its point.
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
pub struct Line {
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
    /// A point of its baseline, mm.
    pub at: [f64; 2],
    /// The text.
    pub words: String,
    /// The size of the font, mm.
    pub size: f64,
    /// Where it stands about the point.
    pub anchor: Anchor,
    /// Whether it reads upwards instead of to the right.
    pub upwards: bool,
}

/// One thing on the paper.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A line through points.
    Line(Line),
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

/// A sheet of paper with what is on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Canvas {
    /// Width and height, mm.
    pub size: [f64; 2],
    /// What is drawn, in order.
    pub shapes: Vec<Shape>,
    /// The title, for the file's metadata.
    pub title: String,
    /// Data for the caption: names and values.
    pub facts: Vec<(String, String)>,
}

impl Canvas {
    /// Draws a line.
    pub fn line(&mut self, points: Vec<[f64; 2]>, ink: Rgb, width: f64, dashes: &'static [f64]) {
        let line = Line {
            points,
            ink,
            width,
            dashes,
        };
        self.shapes.push(Shape::Line(line));
    }

    /// Fills a rectangle.
    pub fn area(&mut self, at: [f64; 2], size: [f64; 2], ink: Rgb) {
        self.shapes.push(Shape::Area { at, size, ink });
    }

    /// Writes a line of text in a font of `size` mm, with the indices that [`font::runs`] finds in it.
    pub fn text(&mut self, at: [f64; 2], words: &str, size: f64, anchor: Anchor) {
        self.set(at, words, size, anchor, false);
    }

    /// Writes a line of text upwards, its middle at `at`.
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
            self.shapes.push(Shape::Text(Text {
                at,
                words: run.words,
                size: run.size * size,
                anchor: if alone { anchor } else { Anchor::Start },
                upwards,
            }));
        }
    }

    /// The facts as one text, a line each.
    pub fn caption(&self) -> String {
        let lines = self.facts.iter();
        let lines = lines.map(|(key, value)| format!("{key}: {value}"));
        lines.collect::<Vec<_>>().join("\n")
    }
}
