//! The font of figures, Noto Sans (SIL Open Font License): text widths and glyph outlines.

use std::sync::LazyLock;

use ttf_parser::{Face, GlyphId};

/// The font's name in files.
pub const FAMILY: &str = "Noto Sans";

/// The font file (TrueType).
pub const FILE: &[u8] = ttf_noto_sans::REGULAR;

/// The font.
pub static FACE: LazyLock<Face<'static>> =
    LazyLock::new(|| Face::parse(FILE, 0).expect("the file is a font"));

/// Returns the size of one outline unit, in font sizes.
pub fn unit() -> f64 {
    1.0 / f64::from(FACE.units_per_em())
}

/// Returns the glyphs of a text, each with its distance from the text's beginning and its advance, in font sizes.
/// Characters that the font lacks become its empty box.
pub fn glyphs(text: &str) -> Vec<(char, GlyphId, f64, f64)> {
    let mut end = 0.0;
    let glyphs = text.chars().map(|sign| {
        let glyph = FACE.glyph_index(sign).unwrap_or_default();
        let advance = f64::from(FACE.glyph_hor_advance(glyph).unwrap_or(0)) * unit();
        end += advance;
        (sign, glyph, end - advance, advance)
    });
    glyphs.collect()
}

/// Returns the width of a text, in font sizes.
pub fn width(text: &str) -> f64 {
    glyphs(text).iter().map(|(.., advance)| advance).sum()
}

/// A part of a text set in one size and at one height.
#[derive(Debug, Clone, PartialEq)]
pub struct TextRun {
    /// The text.
    pub words: String,
    /// Its size, relative to the whole text's.
    pub size: f64,
    /// How far it is raised, in font sizes of the whole text.
    pub lift: f64,
}

impl TextRun {
    fn new(signs: &[char], size: f64, lift: f64) -> Self {
        let words = signs.iter().collect();
        Self { words, size, lift }
    }

    /// Returns the width, in font sizes of the whole text.
    pub fn width(&self) -> f64 {
        width(&self.words) * self.size
    }
}

/// Splits a text into plain parts, subscripts and superscripts. `F_x` and `E_d`, a letter with an index of up to three
/// characters, have a subscript, `10^−8` a superscript; other texts, such as file names, stay unchanged.
pub fn runs(text: &str) -> Vec<TextRun> {
    const SMALL: f64 = 0.7;
    let signs: Vec<char> = text.chars().collect();
    let mut runs = Vec::new();
    let (mut begin, mut at) = (0, 0);
    while at < signs.len() {
        let length = index_length(&signs, at);
        if length > 0 {
            let lift = if signs[at] == '^' { 0.35 } else { -0.2 };
            runs.push(TextRun::new(&signs[begin..at], 1.0, 0.0));
            begin = at + 1 + length;
            runs.push(TextRun::new(&signs[at + 1..begin], SMALL, lift));
        }
        at = begin.max(at + 1);
    }
    runs.push(TextRun::new(&signs[begin..], 1.0, 0.0));
    let is_split = runs.len() > 1;
    runs.retain(|run| !is_split || !run.words.is_empty());
    runs
}

/// Returns the number of characters after the one at `at` that are its index.
fn index_length(signs: &[char], at: usize) -> usize {
    let is_bound = |at: Option<&char>| at.is_none_or(|c| " ,;:/()*²=".contains(*c));
    let (before, rest) = (&signs[..at], &signs[at + 1..]);
    let length = |is_part: fn(char) -> bool| rest.iter().take_while(|c| is_part(**c)).count();
    match (signs[at], before) {
        ('^', _) => length(|c| c == '−' || c.is_numeric()),
        ('_', [others @ .., letter]) if letter.is_alphabetic() && is_bound(others.last()) => {
            let length = length(char::is_alphanumeric);
            let is_index = length <= 3 && is_bound(rest.get(length));
            if is_index { length } else { 0 }
        }
        _ => 0,
    }
}

/// Returns the width of a text with its indices, in font sizes.
pub fn set_width(text: &str) -> f64 {
    runs(text).iter().map(TextRun::width).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_are_set_small_and_file_names_as_they_are() {
        let split = |text: &str| -> Vec<String> {
            let lifted = |run: &TextRun| format!("{}{:+}", run.words, run.lift);
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
        for sign in "abcxyz0123456789 []()|/·−-–.,:;=+*%²³µμντσφ×±".chars() {
            assert!(FACE.glyph_index(sign).is_some(), "{sign}");
        }
        assert!(width("mm") > 1.5 * width("m") && width("") == 0.0);
    }
}
