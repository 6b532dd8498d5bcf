//! Pictures of the explorer's screen, in colour: the README shows one of them.
//!
//! `UPDATE_PICTURES=1 cargo test pictures::` writes them again.
//!
//! Letters become text, stretched to their cells so that they line up in any monospaced font. Braille dots, blocks and
//! rules become shapes, because fonts differ too much there.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use mdr_tui::figure::svg::hex;
use mdr_tui::plot::Marker;
use mdr_tui::plot::colormap::{NAMED, Rgb, indexed, mixed};
use mdr_tui::plot::theme::{Depth, Look, Theme};
use mdr_tui::scenario::escape;
use mdr_tui::tui::{ScriptStep, press, screen};
use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Rect, Size};
use ratatui::style::{Color, Modifier, Style};
use ratatui::symbols::braille::BRAILLE;
use ratatui::text::Line;

use crate::common::Explorer;

/// The terminal's own foreground and background colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Ground {
    /// The background.
    back: Rgb,
    /// The foreground.
    fore: Rgb,
}

impl Ground {
    /// A dark terminal.
    const DARK: Self = Self {
        back: [0x14, 0x18, 0x1f],
        fore: [0xd6, 0xdb, 0xe3],
    };
}

/// The width and height of a cell, and the font size, in pixels.
const CELL: (f64, f64) = (9.0, 18.0);
const LETTERS: f64 = 15.0;

/// Margin around the screen, pixels.
const MARGIN: f64 = 8.0;

/// The share of the text's colour in dim text; the rest is background.
const DIM: f64 = 0.55;

/// Returns the RGB value of a terminal colour; `own` for the terminal's default.
fn rgb(color: Color, own: Rgb) -> Rgb {
    let named = || NAMED.iter().find(|(name, _)| *name == color);
    match color {
        Color::Rgb(r, g, b) => [r, g, b],
        Color::Indexed(index) => indexed(index),
        _ => named().map_or(own, |(_, rgb)| *rgb),
    }
}

/// How a cell looks.
#[derive(Debug, Clone, Copy, PartialEq)]
struct CellStyle {
    fore: Rgb,
    back: Rgb,
    bold: bool,
}

impl CellStyle {
    fn from_cell(cell: &Cell, ground: Ground) -> Self {
        let (mut fore, mut back) = (rgb(cell.fg, ground.fore), rgb(cell.bg, ground.back));
        if cell.modifier.contains(Modifier::REVERSED) {
            std::mem::swap(&mut fore, &mut back);
        }
        if cell.modifier.contains(Modifier::DIM) {
            fore = mixed(back, fore, DIM);
        }
        let bold = cell.modifier.contains(Modifier::BOLD);
        Self { fore, back, bold }
    }
}

/// Returns which arms a box-drawing character has: left, right, up, down.
fn arms(sign: char) -> Option<[bool; 4]> {
    let arms = match sign {
        '─' => "lr",
        '│' => "ud",
        '┌' => "rd",
        '┐' => "ld",
        '└' => "ru",
        '┘' => "lu",
        '├' => "rud",
        '┤' => "lud",
        '┬' => "lrd",
        '┴' => "lru",
        _ => return None,
    };
    Some(['l', 'r', 'u', 'd'].map(|arm| arms.contains(arm)))
}

/// Paths grouped by style: the SVG attributes and the path data.
#[derive(Debug, Default)]
struct Drawing(Vec<(String, String)>);

impl Drawing {
    /// Returns the path data for this style.
    fn path(&mut self, how: String) -> &mut String {
        let at = self.0.iter().position(|(known, _)| *known == how);
        let at = at.unwrap_or_else(|| {
            self.0.push((how, String::new()));
            self.0.len() - 1
        });
        &mut self.0[at].1
    }

    fn area(&mut self, color: Rgb, (x, y): (f64, f64), height: f64) {
        let data = self.path(format!("fill=\"{}\"", hex(color)));
        let _ = write!(data, "M{x} {y}h{0}v{height}h-{0}z", CELL.0);
    }

    fn line(&mut self, color: Rgb, width: &str) -> &mut String {
        self.path(format!("stroke=\"{}\" stroke-width={width}", hex(color)))
    }

    /// Draws a cell's character as a shape; returns false if it is text.
    fn sign(&mut self, sign: char, look: CellStyle, (x, y): (f64, f64)) -> bool {
        let ((w, h), color) = (CELL, look.fore);
        if let Some(bits) = BRAILLE.iter().position(|&dots| dots == sign) {
            let dots = self.line(color, "\"3\" stroke-linecap=\"round\"");
            for bit in (0..8).filter(|bit| bits >> bit & 1 == 1) {
                let [column, row] = [bit % 2, bit / 2].map(f64::from);
                let (x, y) = (x + w * (0.5 * column + 0.25), y + h * (0.25 * row + 0.125));
                let _ = write!(dots, "M{x} {y}h0");
            }
            return true;
        }
        match sign {
            '█' => self.area(color, (x, y), h),
            '▀' => self.area(color, (x, y), 0.5 * h),
            '▄' => self.area(color, (x, y + 0.5 * h), 0.5 * h),
            '░' => self.area(mixed(look.back, look.fore, 0.25), (x, y), h),
            _ => {
                let Some([left, right, up, down]) = arms(sign) else {
                    return false;
                };
                let rules = self.line(color, "\"1\"");
                let (mx, my) = (x + w / 2.0, y + h / 2.0);
                let end = |arm: bool, end: f64, middle: f64| if arm { end } else { middle };
                if left || right {
                    let (from, to) = (end(left, x, mx), end(right, x + w, mx));
                    let _ = write!(rules, "M{from} {my}H{to}");
                }
                if up || down {
                    let (from, to) = (end(up, y, my), end(down, y + h, my));
                    let _ = write!(rules, "M{mx} {from}V{to}");
                }
            }
        }
        true
    }

    fn write(&self, svg: &mut String) {
        for (how, data) in &self.0 {
            let _ = writeln!(svg, "<path {how} d=\"{data}\"/>");
        }
    }
}

/// A run of letters in one style, starting at a point on its baseline.
struct Run {
    look: CellStyle,
    at: (f64, f64),
    text: String,
}

impl Run {
    fn write(&self, svg: &mut String) {
        let (text, (x, y)) = (self.text.trim_end(), self.at);
        let width = Line::raw(text).width() as f64 * CELL.0;
        let bold = if self.look.bold {
            " font-weight=\"bold\""
        } else {
            ""
        };
        let _ = writeln!(
            svg,
            "<text x=\"{x}\" y=\"{y}\" textLength=\"{width}\" fill=\"{}\"{bold}>{}</text>",
            hex(self.look.fore),
            escape::xml(text),
        );
    }
}

/// Returns the picture of a screen on a terminal with the given colours.
fn picture(buffer: &Buffer, ground: Ground) -> String {
    let (w, h) = CELL;
    let width = f64::from(buffer.area.width) * w + 2.0 * MARGIN;
    let height = f64::from(buffer.area.height) * h + 2.0 * MARGIN;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">\n\
         <rect width=\"{width}\" height=\"{height}\" rx=\"6\" fill=\"{}\"/>\n\
         <g font-family=\"'DejaVu Sans Mono', Menlo, Consolas, monospace\" \
         font-size=\"{LETTERS}\" xml:space=\"preserve\" fill=\"none\">\n",
        hex(ground.back)
    );
    let (mut backs, mut drawing) = (Drawing::default(), Drawing::default());
    let mut runs: Vec<Run> = Vec::new();
    for row in buffer.area.rows() {
        let (mut is_open, mut covered) = (false, 0);
        for at in row.positions() {
            let (cell, column) = (&buffer[at], f64::from(at.x - buffer.area.x));
            let look = CellStyle::from_cell(cell, ground);
            let x = MARGIN + column * w;
            let y = MARGIN + f64::from(at.y - buffer.area.y) * h;
            if look.back != ground.back {
                backs.area(look.back, (x, y), h);
            }
            // A wide character also covers the next cell.
            if covered > 0 {
                covered -= 1;
                continue;
            }
            let symbol = cell.symbol();
            covered = Line::raw(symbol).width().saturating_sub(1);
            let sign = symbol.chars().next().unwrap_or(' ');
            if drawing.sign(sign, look, (x, y)) {
                is_open = false;
                continue;
            }
            // A single blank continues a run; two blanks or a shape end it.
            let is_blank = symbol == " ";
            match runs.last_mut().filter(|_| is_open) {
                Some(run) if is_blank && !run.text.ends_with(' ') => run.text.push(' '),
                Some(run) if !is_blank && run.look == look => run.text.push_str(symbol),
                _ => {
                    is_open = !is_blank;
                    runs.extend(is_open.then(|| Run {
                        look,
                        at: (x, y + 0.72 * h),
                        text: symbol.to_owned(),
                    }));
                }
            }
        }
    }
    backs.write(&mut svg);
    drawing.write(&mut svg);
    runs.iter().for_each(|run| run.write(&mut svg));
    svg.push_str("</g>\n</svg>\n");
    svg
}

/// `explorer.svg` is the picture in the README.
#[test]
fn the_picture_is_of_the_screen_as_it_is() {
    let theme = Theme::new(Look::Dark, Marker::Braille).with_depth(Depth::Indexed);
    let mut explorer = Explorer::on("li2019-fig3", theme);
    let strokes = ScriptStep::script(&",".repeat(30)).expect("a script");
    let (size, events) = (Size::new(120, 40), &explorer.worker.events);
    press(&mut explorer.app, &strokes, size, events).expect("a screen");
    let mut buffer = Buffer::empty(size.into());
    screen::draw(&explorer.app, buffer.area, &mut buffer);
    let svg = picture(&buffer, Ground::DARK);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/pictures/explorer.svg");
    if std::env::var_os("UPDATE_PICTURES").is_some() {
        fs::write(&path, &svg).expect("a picture");
    }
    let kept = fs::read_to_string(&path).expect("the picture");
    assert!(kept == svg, "tests/pictures/explorer.svg is out of date");
}

#[test]
fn letters_are_text_and_what_draws_is_drawn() {
    let mut buffer = Buffer::empty(Rect::new(0, 0, 12, 2));
    buffer.set_string(0, 0, "a<&>b ⣿─▀", Style::new().fg(Color::Rgb(1, 2, 3)));
    buffer.set_string(0, 1, "漢 x", Style::new().add_modifier(Modifier::REVERSED));
    let svg = picture(&buffer, Ground::DARK);
    assert!(svg.contains(">a&lt;&amp;&gt;b</text>"), "{svg}");
    assert!(
        svg.contains("stroke=\"#010203\" stroke-width=\"3\""),
        "{svg}"
    );
    assert_eq!(svg.matches("h0").count(), 8, "{svg}");
    for sign in ['⣿', '─', '▀'] {
        assert!(!svg.contains(sign), "{sign} {svg}");
    }
    // A wide character takes two cells, and reversed text has a background.
    assert!(svg.contains("textLength=\"36\""), "{svg}");
    assert!(
        svg.contains(&format!("fill=\"{}\" d=\"M8 26", hex(Ground::DARK.fore))),
        "{svg}"
    );
    assert_eq!(svg.matches("<text").count(), svg.matches("</text>").count());
}

#[test]
fn colours_are_those_of_a_terminal() {
    for (color, rgb) in [
        (Color::Reset, [9, 9, 9]),
        (Color::Indexed(16), [0, 0, 0]),
        (Color::Indexed(231), [255, 255, 255]),
        (Color::Indexed(178), [215, 175, 0]),
        (Color::Indexed(232), [8, 8, 8]),
        (Color::Indexed(255), [238, 238, 238]),
        (Color::White, [255, 255, 255]),
    ] {
        assert_eq!(self::rgb(color, [9, 9, 9]), rgb, "{color:?}");
    }
}
