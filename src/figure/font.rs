//! The font of figures, Noto Sans (SIL Open Font License): how wide a text is, and its outlines.

use std::sync::LazyLock;

use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// The font's name, as files give it.
pub const FAMILY: &str = "Noto Sans";

/// The font's file, TrueType.
pub const FILE: &[u8] = ttf_noto_sans::REGULAR;

static FACE: LazyLock<Option<Face<'static>>> = LazyLock::new(|| Face::parse(FILE, 0).ok());

/// The font, if its file can be read.
pub fn face() -> Option<&'static Face<'static>> {
    FACE.as_ref()
}

/// The glyphs of a text, each with its distance from the text's beginning and its own advance, in
/// units of the font's size. Signs that the font does not have become its empty box.
pub fn glyphs(text: &str) -> Vec<(char, GlyphId, f64, f64)> {
    let Some(face) = face() else {
        return Vec::new();
    };
    let unit = f64::from(face.units_per_em());
    let mut at = 0.0;
    let mut glyphs = Vec::new();
    for sign in text.chars() {
        let glyph = face.glyph_index(sign).unwrap_or(GlyphId(0));
        let advance = f64::from(face.glyph_hor_advance(glyph).unwrap_or(0)) / unit;
        glyphs.push((sign, glyph, at, advance));
        at += advance;
    }
    glyphs
}

/// The width of a text in units of the font's size.
pub fn width(text: &str) -> f64 {
    glyphs(text)
        .last()
        .map_or(0.0, |(_, _, at, advance)| at + advance)
}

/// A part of a text that is set in one size on one line.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The text.
    pub words: String,
    /// Its size, in that of the whole.
    pub size: f64,
    /// How far it is raised, in sizes of the whole.
    pub lift: f64,
}

impl Run {
    /// The width in units of the whole text's size.
    pub fn width(&self) -> f64 {
        width(&self.words) * self.size
    }
}

/// Splits a text where indices begin and end: `F_x` and `E_d`, a letter with up to three signs, have a subscript,
/// `10^−8` a superscript. Other texts, file names among them, stay as they are.
pub fn runs(text: &str) -> Vec<Run> {
    const SMALL: f64 = 0.7;
    let signs: Vec<char> = text.chars().collect();
    let mut runs = vec![Run {
        words: String::new(),
        size: 1.0,
        lift: 0.0,
    }];
    let is_bound = |at: Option<&char>| at.is_none_or(|c| " ,;:/()*²=".contains(*c));
    let mut at = 0;
    while at < signs.len() {
        let rest = &signs[at + 1..];
        let index = match signs[at] {
            '^' => rest
                .iter()
                .take_while(|c| **c == '−' || c.is_numeric())
                .count(),
            '_' if at > 0
                && signs[at - 1].is_alphabetic()
                && is_bound(at.checked_sub(2).map(|before| &signs[before])) =>
            {
                let letters = rest.iter().take_while(|c| c.is_alphanumeric()).count();
                let ends = is_bound(rest.get(letters));
                if ends && letters <= 3 { letters } else { 0 }
            }
            _ => 0,
        };
        if index == 0 {
            if let Some(run) = runs.last_mut() {
                run.words.push(signs[at]);
            }
            at += 1;
            continue;
        }
        let lift = if signs[at] == '^' { 0.35 } else { -0.2 };
        runs.push(Run {
            words: rest[..index].iter().collect(),
            size: SMALL,
            lift,
        });
        runs.push(Run {
            words: String::new(),
            size: 1.0,
            lift: 0.0,
        });
        at += 1 + index;
    }
    let several = runs.len() > 1;
    runs.retain(|run| !several || !run.words.is_empty());
    runs
}

/// The width of a text with its indices, in units of its size.
pub fn set_width(text: &str) -> f64 {
    runs(text).iter().map(Run::width).sum()
}

/// Draws the outlines of a text from its beginning on, in units of the font's size, y upwards.
pub fn outline(text: &str, pen: &mut dyn FnMut(Stroke)) {
    let Some(face) = face() else {
        return;
    };
    let unit = f64::from(face.units_per_em());
    for (_, glyph, at, _) in glyphs(text) {
        face.outline_glyph(glyph, &mut Pen { at, unit, pen });
    }
}

/// A piece of an outline, each point x and y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stroke {
    /// Begins a contour.
    Move([f64; 2]),
    /// A straight line.
    Line([f64; 2]),
    /// A parabola with its control point.
    Quad([f64; 2], [f64; 2]),
    /// A cubic with its control points.
    Cubic([f64; 2], [f64; 2], [f64; 2]),
    /// Ends a contour.
    Close,
}

struct Pen<'a> {
    at: f64,
    unit: f64,
    pen: &'a mut dyn FnMut(Stroke),
}

impl Pen<'_> {
    fn place(&self, x: f32, y: f32) -> [f64; 2] {
        [self.at + f64::from(x) / self.unit, f64::from(y) / self.unit]
    }
}

impl OutlineBuilder for Pen<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        let to = self.place(x, y);
        (self.pen)(Stroke::Move(to));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let to = self.place(x, y);
        (self.pen)(Stroke::Line(to));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let [by, to] = [self.place(x1, y1), self.place(x, y)];
        (self.pen)(Stroke::Quad(by, to));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let [first, second] = [self.place(x1, y1), self.place(x2, y2)];
        let to = self.place(x, y);
        (self.pen)(Stroke::Cubic(first, second, to));
    }

    fn close(&mut self) {
        (self.pen)(Stroke::Close);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_are_set_small_and_file_names_as_they_are() {
        let split = |text: &str| -> Vec<String> {
            let lifted = |run: &Run| format!("{}{:+}", run.words, run.lift);
            runs(text).iter().map(lifted).collect()
        };
        assert_eq!(split("F_x (N)"), ["F+0", "x-0.2", " (N)+0"]);
        assert_eq!(split("2·10^−8"), ["2·10+0", "−8+0.35"]);
        assert_eq!(split("V/(k E_d)"), ["V/(k E+0", "d-0.2", ")+0"]);
        for plain in ["a_b.csv", "my_scar", "τ", "", "x_worn_2"] {
            assert_eq!(split(plain), [format!("{plain}+0")]);
        }
    }

    #[test]
    fn the_font_has_every_sign_that_figures_use() {
        let face = face().expect("a font");
        for sign in "abcxyz0123456789 []()|/·−-–.,:;=+*%²³µμντσφ×±".chars() {
            assert!(face.glyph_index(sign).is_some(), "{sign}");
        }
        assert!(width("mm") > 1.5 * width("m") && width("") == 0.0);
        let mut strokes = 0;
        outline("o", &mut |_| strokes += 1);
        assert!(strokes > 8);
    }
}
