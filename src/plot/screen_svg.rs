//! A screen of characters as an SVG picture, with its colours.
//!
//! Letters are text, stretched to their cells so that they line up in any monospaced font. Braille
//! dots, blocks and rules are drawn as shapes, because fonts differ too much there.

use std::fmt::Write;

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{Color, Modifier};
use ratatui::text::Line;

/// Red, green, blue.
pub type Rgb = [u8; 3];

/// What the terminal's own colours look like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ground {
    /// The background.
    pub back: Rgb,
    /// The foreground.
    pub fore: Rgb,
}

impl Ground {
    /// A dark terminal.
    pub const DARK: Self = Self {
        back: [0x14, 0x18, 0x1f],
        fore: [0xd6, 0xdb, 0xe3],
    };
    /// A light one.
    pub const LIGHT: Self = Self {
        back: [0xff, 0xff, 0xff],
        fore: [0x24, 0x29, 0x2f],
    };
}

/// A cell's width and height, and the size of its letters, in pixels.
const CELL: (f64, f64) = (9.0, 18.0);
const LETTERS: f64 = 15.0;

/// Around the screen, pixels.
const MARGIN: f64 = 8.0;

/// The sixteen colours of a terminal, for what is not given as red, green and blue.
const SIXTEEN: [Rgb; 16] = [
    [0, 0, 0],
    [0xcd, 0x31, 0x31],
    [0x0d, 0xbc, 0x79],
    [0xe5, 0xe5, 0x10],
    [0x24, 0x72, 0xc8],
    [0xbc, 0x3f, 0xbc],
    [0x11, 0xa8, 0xcd],
    [0xe5, 0xe5, 0xe5],
    [0x66, 0x66, 0x66],
    [0xf1, 0x4c, 0x4c],
    [0x23, 0xd1, 0x8b],
    [0xf5, 0xf5, 0x43],
    [0x3b, 0x8e, 0xea],
    [0xd6, 0x70, 0xd6],
    [0x29, 0xb8, 0xdb],
    [0xff, 0xff, 0xff],
];

/// The colour that a terminal shows; `own` where it is the terminal's.
fn shown(color: Color, own: Rgb) -> Rgb {
    let index = match color {
        Color::Reset => return own,
        Color::Rgb(r, g, b) => return [r, g, b],
        Color::Indexed(index) => index,
        Color::Black => 0,
        Color::Red => 1,
        Color::Green => 2,
        Color::Yellow => 3,
        Color::Blue => 4,
        Color::Magenta => 5,
        Color::Cyan => 6,
        Color::Gray => 7,
        Color::DarkGray => 8,
        Color::LightRed => 9,
        Color::LightGreen => 10,
        Color::LightYellow => 11,
        Color::LightBlue => 12,
        Color::LightMagenta => 13,
        Color::LightCyan => 14,
        Color::White => 15,
    };
    match index {
        0..=15 => SIXTEEN[usize::from(index)],
        16..=231 => {
            let at = index - 16;
            [at / 36, at / 6 % 6, at % 6].map(|level| match level {
                0 => 0,
                level => 55 + 40 * level,
            })
        }
        grey => [8 + 10 * (grey - 232); 3],
    }
}

/// How a cell looks.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Look {
    fore: Rgb,
    back: Rgb,
    bold: bool,
    dim: bool,
}

impl Look {
    fn of(cell: &Cell, ground: Ground) -> Self {
        let (mut fore, mut back) = (shown(cell.fg, ground.fore), shown(cell.bg, ground.back));
        if cell.modifier.contains(Modifier::REVERSED) {
            std::mem::swap(&mut fore, &mut back);
        }
        Self {
            fore,
            back,
            bold: cell.modifier.contains(Modifier::BOLD),
            dim: cell.modifier.contains(Modifier::DIM),
        }
    }
}

/// Arms of a rule's sign from the middle of its cell: left, right, up, down.
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

/// Strokes and areas of one colour.
#[derive(Debug)]
struct Ink {
    color: Rgb,
    opacity: f64,
    dots: String,
    rules: String,
    areas: String,
}

/// What is drawn, by colour.
#[derive(Debug, Default)]
struct Drawing(Vec<Ink>);

impl Drawing {
    fn ink(&mut self, color: Rgb, opacity: f64) -> &mut Ink {
        let is = |ink: &Ink| ink.color == color && ink.opacity == opacity;
        let at = self.0.iter().position(is).unwrap_or_else(|| {
            self.0.push(Ink {
                color,
                opacity,
                dots: String::new(),
                rules: String::new(),
                areas: String::new(),
            });
            self.0.len() - 1
        });
        &mut self.0[at]
    }

    /// Draws the sign of a cell at a place; false if it is a letter.
    fn sign(&mut self, sign: char, look: Look, (x, y): (f64, f64)) -> bool {
        let (w, h) = CELL;
        let opacity = if look.dim { 0.55 } else { 1.0 };
        let share = match sign {
            '█' => Some((0.0, 1.0, 1.0)),
            '▀' => Some((0.0, 0.5, 1.0)),
            '▄' => Some((0.5, 0.5, 1.0)),
            '░' => Some((0.0, 1.0, 0.25)),
            '▒' => Some((0.0, 1.0, 0.5)),
            '▓' => Some((0.0, 1.0, 0.75)),
            _ => None,
        };
        if let Some((top, height, shade)) = share {
            let areas = &mut self.ink(look.fore, opacity * shade).areas;
            let _ = write!(areas, "M{x} {}h{w}v{}h-{w}z", y + top * h, height * h);
        } else if let Some([left, right, up, down]) = arms(sign) {
            let rules = &mut self.ink(look.fore, opacity).rules;
            let (mx, my) = (x + w / 2.0, y + h / 2.0);
            let [from, to] =
                [(left, x), (right, x + w)].map(|(arm, end)| if arm { end } else { mx });
            let [top, end] = [(up, y), (down, y + h)].map(|(arm, end)| if arm { end } else { my });
            if from < to {
                let _ = write!(rules, "M{from} {my}H{to}");
            }
            if top < end {
                let _ = write!(rules, "M{mx} {top}V{end}");
            }
        } else if ('\u{2800}'..='\u{28ff}').contains(&sign) {
            let bits = sign as u32 - 0x2800;
            let places = [
                (0, 0),
                (0, 1),
                (0, 2),
                (1, 0),
                (1, 1),
                (1, 2),
                (0, 3),
                (1, 3),
            ];
            let dots = &mut self.ink(look.fore, opacity).dots;
            for (bit, (column, row)) in places.into_iter().enumerate() {
                if bits >> bit & 1 == 1 {
                    let x = x + w * (f64::from(column) * 0.5 + 0.25);
                    let y = y + h * (f64::from(row) * 0.25 + 0.125);
                    let _ = write!(dots, "M{x} {y}h0");
                }
            }
        } else {
            return false;
        }
        true
    }

    fn write(&self, svg: &mut String) {
        for ink in &self.0 {
            let (color, opacity) = (hex(ink.color), ink.opacity);
            let seen = match opacity {
                1.0 => String::new(),
                opacity => format!(" opacity=\"{opacity}\""),
            };
            for (path, how) in [
                (&ink.areas, format!("fill=\"{color}\"")),
                (&ink.rules, format!("stroke=\"{color}\" stroke-width=\"1\"")),
                (
                    &ink.dots,
                    format!("stroke=\"{color}\" stroke-width=\"3\" stroke-linecap=\"round\""),
                ),
            ] {
                if !path.is_empty() {
                    let _ = writeln!(svg, "<path {how}{seen} d=\"{path}\"/>");
                }
            }
        }
    }
}

fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A run of letters of one look, from a column on.
struct Run {
    look: Look,
    column: u16,
    text: String,
}

impl Run {
    fn write(&self, y: f64, svg: &mut String) {
        let trimmed = self.text.trim_end();
        if trimmed.is_empty() {
            return;
        }
        let x = MARGIN + f64::from(self.column) * CELL.0;
        let width = Line::raw(trimmed).width() as f64 * CELL.0;
        let bold = if self.look.bold {
            " font-weight=\"bold\""
        } else {
            ""
        };
        let dim = if self.look.dim {
            " opacity=\"0.55\""
        } else {
            ""
        };
        let escaped = trimmed
            .replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;");
        let _ = writeln!(
            svg,
            "<text x=\"{x}\" y=\"{y}\" textLength=\"{width}\" fill=\"{}\"{bold}{dim}>{escaped}</text>",
            hex(self.look.fore)
        );
    }
}

/// The whole picture of a screen on a terminal of such colours.
pub fn picture(buffer: &Buffer, ground: Ground) -> String {
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
    let (mut backs, mut letters) = (Drawing::default(), String::new());
    let mut drawing = Drawing::default();
    for (row, cells) in buffer.area.rows().enumerate() {
        let y = MARGIN + row as f64 * h;
        let mut run: Option<Run> = None;
        let mut covered = 0;
        for (column, at) in cells.positions().enumerate() {
            let (cell, column) = (&buffer[at], column as u16);
            let look = Look::of(cell, ground);
            let x = MARGIN + f64::from(column) * w;
            if look.back != ground.back {
                let areas = &mut backs.ink(look.back, 1.0).areas;
                let _ = write!(areas, "M{x} {y}h{w}v{h}h-{w}z");
            }
            // A wide character covers the cell behind it.
            if covered > 0 {
                covered -= 1;
                continue;
            }
            let symbol = cell.symbol();
            covered = Line::raw(symbol).width().saturating_sub(1);
            let sign = symbol.chars().next().unwrap_or(' ');
            let is_drawn = drawing.sign(sign, look, (x, y));
            let symbol = if is_drawn { " " } else { symbol };
            // One blank goes on with the run before it; two, and signs that are drawn, end it.
            match &mut run {
                Some(run)
                    if !is_drawn
                        && (run.look == look || symbol == " ")
                        && !(symbol == " " && run.text.ends_with(' ')) =>
                {
                    run.text.push_str(symbol);
                }
                _ => {
                    if let Some(run) = run.take() {
                        run.write(y + 0.72 * h, &mut letters);
                    }
                    run = (!is_drawn && symbol != " ").then(|| Run {
                        look,
                        column,
                        text: symbol.to_owned(),
                    });
                }
            }
        }
        if let Some(run) = run {
            run.write(y + 0.72 * h, &mut letters);
        }
    }
    backs.write(&mut svg);
    drawing.write(&mut svg);
    svg.push_str(&letters);
    svg.push_str("</g>\n</svg>\n");
    svg
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::layout::Rect;
    use ratatui::style::Style;

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
            assert_eq!(shown(color, [9, 9, 9]), rgb, "{color:?}");
        }
    }
}
