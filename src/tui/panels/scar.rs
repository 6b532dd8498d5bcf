//! The scar from above: a disc in half blocks; its left half shows stick and slip, its right half
//! the worn depth in colours. Of a line contact it shows a piece of the strip.
//!
//! ```text
//!         ▄▄▄▄▄▄▄▄▄          left: stick in the middle, slip around it, open outside
//!      ▄██████▓▓▓▓▓▓▄        right: worn depth
//!      ▀██████▓▓▓▓▓▓▀
//!         ▀▀▀▀▀▀▀▀▀
//!  |----| 50 µm   slip →   depth 0 [colours] 0.3 µm
//! ```

use ratatui::layout::Rect;
use ratatui::style::Color;
use ratatui::text::Line;

use super::{Picture, Shown};
use crate::charts::Recipe;
use crate::math::geometry::Geometry;
use crate::math::grid::interpolate;
use crate::math::scan::largest;
use crate::plot::colormap::ColorMap;
use crate::plot::shades::{self, has_blocks, paint_halves};
use crate::plot::step::Step;
use crate::plot::theme::{Role, Theme, look_of};
use crate::plot::units::format_value;
use crate::reading::Curves;
use crate::tui::canvas::Canvas;
use crate::tui::frame::Frame;

/// The panel.
pub static RECIPE: Recipe<Picture> = Recipe {
    title: "scar from above",
    needs: Curves::PROFILE.union(Curves::SPRINGS),
    text: "The contact from above. The left half shows where it sticks, slips and is open at this moment, \
           the right half the worn depth in colours. The arrow shows which way the indenter slips.",
    symbols: &[("s ~ .", "stick, slip, open (without colours)")],
    ..Recipe::new(Picture {
        draw,
        extent: depths,
    })
};

/// Minimum width, in cells, for a legend on one line, and minimum height for two lines below that width.
const ONE_LINE: u16 = 64;
const TWO_LINES: u16 = 10;

/// Returns the colour of the disc at `x` and `y` from its centre (m), and the character that replaces it without
/// colours. The colours of depths range from 0 to `deepest`.
fn look_at(frame: &Frame, theme: &Theme, deepest: f64, [x, y]: [f64; 2]) -> (Option<Color>, char) {
    let seen = &frame.live.observation;
    let r = if seen.geometry.is_line() {
        x.abs()
    } else {
        x.hypot(y)
    };
    if r > frame.run.edge() {
        return (None, ' ');
    }
    if x < 0.0 {
        let (role, sign) = look_of(seen.moment.zone_at(r));
        return (theme.style(role).fg, sign);
    }
    let depth = interpolate(seen.radii(), seen.wear(), r);
    let share = shades::share(depth, [0.0, deepest]);
    let color = shades::color(theme, ColorMap::Sequential, share);
    (color, shades::sign(shades::SIGNS, share))
}

/// Returns the range of depths that the colours cover, m.
fn depths(frame: &Frame) -> Option<[f64; 2]> {
    let deepest = largest(frame.live.observation.wear());
    (deepest > 0.0).then_some([0.0, deepest])
}

fn draw(of: &Shown, mut canvas: Canvas) {
    let frame = of.frame;
    let mut canvas = canvas.titled(RECIPE.title, of.role);
    let (theme, area, seen) = (canvas.theme, canvas.area, &frame.live.observation);
    let Some(&edge) = seen.radii().last().filter(|_| !seen.wear().is_empty()) else {
        return;
    };
    if area.height < 4 || area.width < 12 {
        return canvas.write_text("too small for the scar", Role::Quiet);
    }
    let lines = legend_lines(area);
    let disc = Rect::new(area.x, area.y, area.width, area.height - lines);
    // Without bounds, nothing has worn yet.
    let deepest = of
        .bounds
        .map_or(frame.live.expected_wear, |bounds| bounds[1]);
    // Half a cell is about as high as a cell is wide.
    let across = match seen.geometry {
        Geometry::Round => disc.width.min(2 * disc.height),
        Geometry::Line { .. } => disc.width,
    };
    let size = 2.0 * edge / f64::from(across);
    for at in disc.positions() {
        let (column, row) = (f64::from(at.x - disc.x), f64::from(at.y - disc.y));
        let x = (column + 0.5 - f64::from(disc.width) / 2.0) * size;
        let halves = [0.5, 1.5].map(|half| {
            let y = (2.0 * row + half - f64::from(disc.height)) * size;
            look_at(frame, &theme, deepest, [x, y])
        });
        let cell = &mut canvas.buffer[at];
        if has_blocks(&theme) {
            paint_halves(cell, halves.map(|(color, _)| color))
        } else {
            cell.set_char(halves[0].1);
        }
    }
    legend(frame, [size, deepest], canvas);
}

/// Returns the direction in which the sliding parts of the indenter move, which is the direction of the traction that
/// they exert.
fn slip_direction(frame: &Frame) -> Option<f64> {
    let seen = &frame.live.observation;
    let (a, stick) = (seen.moment.contact_radius, seen.moment.stick_radius?);
    let mut outermost_first = seen.radii().iter().zip(seen.tangential_load()).rev();
    let (_, load) = outermost_first.find(|(r, load)| **r < a && **load != 0.0)?;
    (stick < a).then(|| load.signum())
}

/// Returns the number of lines of the legend.
fn legend_lines(area: Rect) -> u16 {
    1 + u16::from(area.width < ONE_LINE && area.height >= TWO_LINES)
}

/// Draws as much of the scale bar, the direction of slip and the scale of the depth as has room.
fn legend(frame: &Frame, [size, deepest]: [f64; 2], mut canvas: Canvas) {
    let (theme, area) = (canvas.theme, canvas.area);
    let value = |value| format_value(value, "m", 3);
    // A round length near a fifth of the disc.
    let reach = Step::above(8.0 * size).value();
    let middle = (reach / size).round().max(2.0) as usize - 2;
    let bar = format!("├{:─<middle$}┤", "");
    let slip = match slip_direction(frame) {
        None => "no slip",
        Some(sign) if sign > 0.0 => "slip →",
        Some(_) => "slip ←",
    };
    let deepest = theme.printable(&format!(" {}", value(deepest)));
    let ends = [" worn 0 ".to_owned(), deepest];
    let depths = shades::key(&theme, ColorMap::Sequential, shades::SIGNS, ends);
    let mut row = Rect::new(area.x, area.bottom() - 1, area.width, 1);
    for part in [format!(" {bar} {} ", value(reach)), format!(" {slip} ")] {
        let part = Line::raw(theme.printable(&part));
        let width = part.width() as u16;
        if width > row.width {
            return;
        }
        canvas.at(row).show(part);
        (row.x, row.width) = (row.x + width, row.width - width);
    }
    if legend_lines(area) == 2 {
        row = Rect::new(area.x, area.bottom() - 2, area.width, 1);
    }
    if depths.width() <= usize::from(row.width) {
        canvas.at(row).show(depths);
    }
}
