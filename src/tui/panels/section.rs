//! A cut through indenter and half-space: one body pressed into the other, with the stress below the contact. When
//! zoomed, it shows the contact large: the indenter follows its motion, and captions describe the phase of the cycle
//! ([`super::caption`]).
//!
//! ```text
//!  ████████████████████████████████    indenter: heights exaggerated, shifted by its magnified motion
//!    ▀▀██████████████████████████▀▀    ╱ what it has lost, magnified
//!  ▄▄▄▄╱╱╱╱▀▀██████████████▀▀╱╱╱╱▄▄    contact: stick and slip in their colours
//!  ░░░░░░░░░░▄▄▄▄▄▄▄▄▄▄▄▄▄▄░░░░░░░░    half-space: the stress inside, in true lengths
//! ```
//!
//! Heights of the surfaces are exaggerated; each body's surface is drawn to an eighth of a cell. Below the surface
//! lengths are true: half a cell is about as high as a column is wide, and both represent the same length, so the
//! stress lies under the contact as it does in the material. The motion is magnified, too: short lines on both bodies
//! stay aligned where the contact sticks, and separate where it slips. The flanks of the indenter move with it; between
//! them the contact stays closed.

use ratatui::style::{Color, Modifier, Style};

use super::cut::{ContactSection, Cut, LARGE, Matter, heights, round_to_step};
use super::{Picture, Shown, caption};
use crate::charts::{Recipe, U_X};
use crate::math::grid::interpolate;
use crate::plot::shades::{self, has_blocks};
use crate::plot::theme::{Role, look_of};
use crate::reading::{Curves, Zone};
use crate::tui::canvas::Canvas;

/// The panel.
pub static RECIPE: Recipe<Picture> = Recipe {
    title: "cross-section",
    needs: Curves::PROFILE
        .union(Curves::DEPRESSION)
        .union(Curves::SPRINGS)
        .union(Curves::SURFACE),
    is_calm: true,
    text: "A cut through both bodies: the indenter above, the half-space it deforms below. The title tells \
           what is magnified. The contact surface is coloured by stick and slip; the short lines across it \
           (V) stay in one where it sticks, and part where it slips.",
    symbols: &[("F_z", "normal force"), U_X],
    ..Recipe::new(Picture {
        draw,
        extent: heights,
    })
};

/// The number of parts of a cell to which a surface is drawn.
const PARTS: usize = 8;

/// Lower blocks, by the eighths of a cell that they fill.
const LOWER: [char; PARTS + 1] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// Minimum rows for lines that are two cells long on each body.
const LONG_LINES: u16 = 22;

/// The number of greys of the indenter.
const SHADES_OF_BODY: f64 = 6.0;

impl Matter {
    /// Returns its role, and a whole cell of it, in Unicode and in ASCII.
    fn look(self) -> (Role, [char; 2]) {
        match self {
            Self::Contact(zone) => (look_of(zone).0, [look_of(zone).1; 2]),
            Self::Air => (Role::Quiet, [' ', ' ']),
            Self::Indenter => (Role::Profile, ['█', '#']),
            Self::Worn => (Role::Notice, ['╱', '/']),
            Self::HalfSpace => (Role::Open, ['░', '.']),
        }
    }
}

impl ContactSection<'_> {
    /// Draws the bodies.
    fn bodies(&self, canvas: &mut Canvas) {
        let area = self.area;
        for column in 0..area.width {
            let middle = f64::from(column) + 0.5 - f64::from(area.width) / 2.0;
            let cut = self.cut(middle * self.width);
            for row in 0..area.height {
                let top = self.high - 2.0 * f64::from(row) * self.half;
                let (glyph, style) = self.cell(&cut, usize::from(column), top);
                let cell = &mut canvas.buffer[(area.x + column, area.y + row)];
                cell.set_char(glyph).set_style(style);
            }
        }
    }

    /// Draws short lines on both bodies: on the indenter they move with it, on the half-space with its surface.
    fn lines(&self, canvas: &mut Canvas) {
        let (seen, area) = (&self.of.frame.live.observation, self.area);
        if self.motion == 0.0 || seen.surface().is_empty() || !has_blocks(&self.theme) {
            return;
        }
        let apart = (f64::from(area.width) / 14.0).max(5.0).floor() * self.width;
        let places = (-7..=7).map(|k| f64::from(k) * apart);
        for x in places.filter(|x| x.abs() < seen.moment.contact_radius) {
            let surface = interpolate(seen.radii(), seen.surface(), x.abs());
            let moved = round_to_step(self.motion * surface, self.width);
            let Some([above, below]) = self.rows_above(x) else {
                continue;
            };
            // Upwards on the indenter, downwards on the half-space.
            let long = u16::from(area.height >= LONG_LINES);
            let of_indenter = (x + self.shift, above - long..=above);
            for (x, rows) in [of_indenter, (x + moved, below + 1..=below + 1 + long)] {
                let Some(column) = self.column(x) else {
                    continue;
                };
                for row in rows.filter(|&row| row < area.bottom()) {
                    let cell = &mut canvas.buffer[(column, row)];
                    caption::fill_background(cell);
                    cell.set_char('┃').set_style(caption::ink(&self.theme));
                }
            }
        }
    }

    /// Returns the cell whose upper edge is at height `top`.
    fn cell(&self, cut: &Cut, column: usize, top: f64) -> (char, Style) {
        if !has_blocks(&self.theme) {
            return self.plain(cut, column, top);
        }
        let part = |k: usize| top - (k as f64 + 0.5) * 2.0 * self.half / PARTS as f64;
        let matter: [Matter; PARTS] = std::array::from_fn(|k| cut.matter(part(k), self.thick));
        // Keeps the two kinds of matter that fill most of the cell, in their order.
        let mut runs: Vec<&[Matter]> = matter.chunk_by(PartialEq::eq).collect();
        while runs.len() > 2 {
            let least = (0..runs.len()).min_by_key(|&k| runs[k].len());
            runs.remove(least.unwrap_or(0));
        }
        let (upper, lower) = (runs[0], runs[runs.len() - 1]);
        let ink = |place, matter| self.ink(cut, column, place, matter);
        let above = ink(part(0), upper[0]);
        if upper[0] != lower[0] {
            let count = lower.len() * PARTS / (lower.len() + upper.len());
            let block = LOWER[count.clamp(1, PARTS - 1)];
            return match ink(part(PARTS - 1), lower[0]) {
                // Air has the screen's unknown background colour, so the block is drawn in reverse video.
                None => (block, colors(above, None).add_modifier(Modifier::REVERSED)),
                below => (block, colors(below, above)),
            };
        }
        match upper[0] {
            Matter::HalfSpace => {
                let [upper, lower] = [0.5, 1.5].map(|at| ink(top - at * self.half, upper[0]));
                // A blank takes one byte instead of three, and changes only one colour.
                if upper == lower && upper.is_some() {
                    (' ', colors(None, upper))
                } else {
                    ('▀', colors(upper, lower))
                }
            }
            Matter::Worn => {
                let hatching = self.theme.style(Role::Profile);
                ('╱', colors(above, above).patch(hatching))
            }
            Matter::Indenter => ('█', colors(above, None)),
            _ => (' ', colors(None, above)),
        }
    }

    /// Returns the colour of what is at height `z`; `None` for air.
    fn ink(&self, cut: &Cut, column: usize, z: f64, matter: Matter) -> Option<Color> {
        let theme = &self.theme;
        match matter {
            Matter::Air => None,
            // Greys, which no colour map contains, brighter towards the contact.
            Matter::Indenter => {
                let depth = (self.high - z) / self.tall * SHADES_OF_BODY;
                let depth = depth.clamp(0.0, SHADES_OF_BODY - 1.0) as u8;
                theme
                    .indexed([236 + depth, 254 - depth])
                    .or(Some(Color::Gray))
            }
            // The colour under the hatching, where the indenter was.
            Matter::Worn => theme.indexed([58, 229]).or(Some(Color::Black)),
            Matter::HalfSpace => match self.share(cut, column, z) {
                Some(share) => shades::color(theme, self.of.stress.colors(), share),
                None => theme.style(Role::Open).fg,
            },
            // The slip zone glows.
            Matter::Contact(Zone::Slip) => {
                let plain = theme.style(Role::Slip).fg?;
                theme.indexed([208, 202]).or(Some(plain))
            }
            Matter::Contact(zone) => theme.style(look_of(zone).0).fg,
        }
    }

    /// The share of its range that the stress has at height `z`.
    fn share(&self, cut: &Cut, column: usize, z: f64) -> Option<f64> {
        let below = ((cut.surface - z) / self.half).max(0.0) as usize;
        Some(self.stress.as_ref()?(column, below))
    }

    /// Returns a cell without colour: the bodies as characters, one per cell in ASCII.
    fn plain(&self, cut: &Cut, column: usize, top: f64) -> (char, Style) {
        let (theme, half) = (&self.theme, self.half);
        let [upper, lower] = [0.5, 1.5].map(|at| cut.matter(top - at * half, self.thick));
        let [is_contact, is_above] =
            [lower, upper].map(|matter| matches!(matter, Matter::Contact(_)));
        let shown = if is_contact { lower } else { upper };
        if let (Matter::HalfSpace, Some(share)) = (shown, self.share(cut, column, top - half)) {
            return (shades::sign(shades::SIGNS, share), Style::new());
        }
        // Letters distinguish stick from slip; half blocks of one colour would not.
        if theme.ascii() || is_contact || is_above || upper == lower {
            let (role, signs) = shown.look();
            return (signs[usize::from(theme.ascii())], theme.style(role));
        }
        match upper {
            Matter::Air => ('▄', theme.style(lower.look().0)),
            above => ('▀', theme.style(above.look().0)),
        }
    }
}

fn draw(shown: &Shown, mut canvas: Canvas) {
    let room = usize::from(canvas.area.width.saturating_sub(2));
    let inner = canvas.titled(RECIPE.title, shown.role).area;
    let [picture, below] = caption::split(inner);
    let Some(section) = ContactSection::new(shown, &canvas.theme, picture) else {
        return;
    };
    canvas.titled(&section.title(RECIPE.title, room), shown.role);
    let mut canvas = canvas.at(picture);
    section.bodies(&mut canvas);
    if picture.height >= LARGE {
        section.lines(&mut canvas);
    }
    caption::draw(&section, canvas, below);
}

/// Returns a style with these colours, if any.
fn colors(fg: Option<Color>, bg: Option<Color>) -> Style {
    Style {
        fg,
        bg,
        ..Style::new()
    }
}
