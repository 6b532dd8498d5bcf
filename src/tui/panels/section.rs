//! A cut through indenter and half-space: one body pressed into the other, with the stress under
//! the contact.
//!
//! Heights of the surfaces are exaggerated, each body's surface to an eighth of a cell. Below the surface
//! lengths are true: a half cell is about as high as a column is wide, and both stand for the same length,
//! so the stress lies under the contact as it does in the material. The contact is drawn on the first half
//! cell below the indenter in the colours of stick and slip.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::text::Line;

use super::stress_map::{self, SHADES, Samples};
use super::{App, Frame, Panel, Picture, Recipe, Words, edge};
use crate::math::grid::interpolate;
use crate::plot::units::format_value_in;
use crate::simulation::Curves;
use crate::tui::theme::{Depth, Look, Role, Theme};

/// The panel.
pub static PICTURE: Picture = Picture {
    recipe: Recipe {
        title: "cross-section",
        needs: Curves::PROFILE
            .union(Curves::DEPRESSION)
            .union(Curves::SPRINGS),
        is_calm: true,
        words: Words {
            text: "A cut through both bodies: the indenter above, the half-space it deforms below. \
                 Heights are exaggerated by the factor shown. The contact surface is coloured by \
                 stick and slip.",
            symbols: &[
                ("F_z", "normal force"),
                ("u_x", "tangential displacement of the indenter"),
            ],
        },
        ..Recipe::new(|_, _| Err(""))
    },
    draw,
    extent: heights,
};

/// The picture is this many times as wide as the domain: the sides of the bodies are seen.
const WIDER: f64 = 1.5;

/// Parts of a cell that a surface is drawn to.
const PARTS: usize = 8;

/// Lower blocks, by the eighths of a cell that they fill.
const LOWER: [char; PARTS + 1] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// What is at a place of the cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Matter {
    Air,
    Indenter,
    /// Worn off.
    Worn,
    /// The surface of contact, where it sticks and where it slips.
    Stick,
    Slip,
    HalfSpace,
}

impl Matter {
    fn role(self) -> Role {
        match self {
            Self::Air => Role::Quiet,
            Self::Indenter => Role::Profile,
            Self::Worn => Role::Notice,
            Self::Stick => Role::Stick,
            Self::Slip => Role::Slip,
            Self::HalfSpace => Role::Open,
        }
    }

    /// A whole cell of it, in ASCII or not.
    fn glyph(self, ascii: bool) -> char {
        let [fine, plain] = match self {
            Self::Air => [' ', ' '],
            Self::Indenter => ['█', '#'],
            Self::Worn => ['▒', '+'],
            Self::Stick => ['▀', 's'],
            Self::Slip => ['▀', '~'],
            Self::HalfSpace => ['░', '.'],
        };
        if ascii { plain } else { fine }
    }
}

/// Heights over the undeformed surface, m, at one radius.
struct Cut {
    indenter: f64,
    unworn: f64,
    surface: f64,
    /// Where the half-space would end had it not worn.
    unworn_surface: f64,
    contact: Option<Matter>,
}

impl Cut {
    /// The cut at radius `r`. Beyond the domain the indenter goes on unworn, and the surface comes
    /// back as under a point load, in proportion to 1/r.
    fn at(frame: &Frame, r: f64) -> Self {
        let (seen, moment) = (&frame.observation, &frame.observation.moment);
        let edge = seen.radii.last().copied().unwrap_or(0.0);
        let rim = frame.indenter.rim().unwrap_or(f64::INFINITY);
        let inside = r.min(edge);
        let sunk = interpolate(&seen.radii, &seen.depression, inside);
        let surface = -sunk * if r > edge { edge / r } else { 1.0 };
        // Nothing of the half-space is worn unless the scenario says so.
        let share = frame.wear_share.unwrap_or(1.0);
        let wear = match frame.wear_share {
            Some(_) if r <= edge => interpolate(&seen.radii, &seen.wear, r),
            _ => 0.0,
        };
        let of_half_space = wear - share * wear;
        let (worn, unworn) = if r > rim {
            (f64::INFINITY, f64::INFINITY)
        } else if r > edge {
            let f = frame.indenter.profile(r);
            (f, f)
        } else {
            (
                interpolate(&seen.radii, &seen.profile, r),
                frame.indenter.profile(r),
            )
        };
        let sticks = moment.stick_radius.is_none_or(|stick| r < stick);
        let contact = if sticks { Matter::Stick } else { Matter::Slip };
        Self {
            indenter: worn - of_half_space - moment.depth,
            unworn: unworn - moment.depth,
            surface: surface - of_half_space,
            unworn_surface: surface,
            contact: (r < moment.contact_radius).then_some(contact),
        }
    }

    /// What is at height `z`, where a sample is `size` high (m).
    fn matter(&self, z: f64, size: f64) -> Matter {
        match self.contact {
            _ if z >= self.indenter => Matter::Indenter,
            Some(contact) if z >= self.indenter - size => contact,
            Some(_) => Matter::HalfSpace,
            None if z <= self.surface => Matter::HalfSpace,
            None if z >= self.unworn || z <= self.unworn_surface => Matter::Worn,
            None => Matter::Air,
        }
    }
}

/// The heights that the picture spans, m: all of the indenter's flank within the domain, and as much
/// of the half-space.
fn heights(frame: &Frame) -> Option<[f64; 2]> {
    let depth = frame.observation.moment.depth;
    if frame.observation.depression.is_empty() {
        return None;
    }
    let flank = match frame.indenter.rim() {
        Some(_) => depth.abs(),
        None => frame.indenter.profile(WIDER * edge(frame)),
    };
    Some([-depth.max(0.0) - 1.2 * flank, flank - depth])
}

fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    let seen = &frame.observation;
    let (Some([low, high]), Some(&edge)) = (app.bounds(Panel::Section), seen.radii.last()) else {
        return;
    };
    if seen.depression.is_empty() || area.is_empty() {
        return;
    }
    let half = (high - low) / (2.0 * f64::from(area.height));
    let width = 2.0 * WIDER * edge / f64::from(area.width);
    let rows = 2 * usize::from(area.height);
    let samples = Samples::new(app.stress, frame, usize::from(area.width), rows, width);
    let picture = Canvas {
        theme: &app.theme,
        half,
        map: samples.zip(app.stress_bounds()),
        colors: app.stress.quantity.colors(),
    };
    for column in 0..area.width {
        let x = (f64::from(column) + 0.5 - f64::from(area.width) / 2.0) * width;
        let cut = Cut::at(frame, x.abs());
        for row in 0..area.height {
            let top = high - 2.0 * f64::from(row) * half;
            let (glyph, style) = picture.cell(&cut, usize::from(column), top);
            if let Some(cell) = buffer.cell_mut((area.x + column, area.y + row)) {
                cell.set_char(glyph).set_style(style);
            }
        }
    }
    words(frame, app, area, half, width, buffer);
}

/// How the cut becomes cells.
struct Canvas<'a> {
    theme: &'a Theme,
    /// The height of half a cell, m, on the scale of the surfaces.
    half: f64,
    /// The stress and the range of its colours.
    map: Option<(Samples, [f64; 2])>,
    colors: crate::plot::colormap::ColorMap,
}

impl Canvas<'_> {
    /// The cell whose upper edge is at height `top`.
    fn cell(&self, cut: &Cut, column: usize, top: f64) -> (char, Style) {
        if !self.theme.colored() || self.theme.ascii() {
            return self.plain(cut, column, top);
        }
        let part = |k: usize| top - (k as f64 + 0.5) * 2.0 * self.half / PARTS as f64;
        let matter: [Matter; PARTS] = std::array::from_fn(|k| cut.matter(part(k), self.half));
        if matter.iter().all(|&m| m == Matter::HalfSpace) {
            let halves =
                [0.5, 1.5].map(|at| self.ink(cut, column, top - at * self.half, matter[0]));
            return halves_of(halves);
        }
        // The two that have most of the cell, in their order.
        let share = |m: Matter| matter.iter().filter(|&&other| other == m).count();
        let mut found: Vec<Matter> = matter.to_vec();
        found.dedup();
        while found.len() > 2 {
            let least = (0..found.len())
                .min_by_key(|&k| share(found[k]))
                .unwrap_or(0);
            found.remove(least);
        }
        let [upper, lower] = match found[..] {
            [upper, lower] => [upper, lower],
            _ => [matter[0]; 2],
        };
        if upper == lower {
            return match self.ink(cut, column, part(0), upper) {
                None => (' ', Style::new()),
                color => (LOWER[PARTS], ink(color)),
            };
        }
        let count = share(lower) * PARTS / (share(lower) + share(upper)).max(1);
        let colors = [
            self.ink(cut, column, part(0), upper),
            self.ink(cut, column, part(PARTS - 1), lower),
        ];
        match colors {
            // Nothing is drawn in air: the solid part has the ink.
            [above, None] => ('▀', ink(above)),
            [above, below] => (LOWER[count.clamp(1, PARTS - 1)], ground(ink(below), above)),
        }
    }

    /// The colour of what is at height `z`; `None` for air.
    fn ink(&self, cut: &Cut, column: usize, z: f64, matter: Matter) -> Option<Color> {
        match matter {
            Matter::Air => None,
            Matter::Indenter => Some(body(self.theme)),
            Matter::HalfSpace => match self.shade(cut, column, z) {
                Some(shade) => stress_map::color(self.theme, self.colors, shade),
                None => self.theme.style(Role::Open).fg,
            },
            other => self.theme.style(other.role()).fg,
        }
    }

    /// The shade of the stress at height `z`.
    fn shade(&self, cut: &Cut, column: usize, z: f64) -> Option<usize> {
        let (samples, range) = self.map.as_ref()?;
        let surface = match cut.contact {
            Some(_) => cut.indenter,
            None => cut.surface,
        };
        let below = ((surface - z) / self.half).max(0.0) as usize;
        Some(stress_map::shade(samples.value(column, below), *range))
    }

    /// A cell without colour: the bodies as signs, one a cell in ASCII.
    fn plain(&self, cut: &Cut, column: usize, top: f64) -> (char, Style) {
        let ascii = self.theme.ascii();
        let [upper, lower] = [0.5, 1.5].map(|at| cut.matter(top - at * self.half, self.half));
        let is_contact = |matter| matches!(matter, Matter::Stick | Matter::Slip);
        let shown = match (is_contact(lower) && ascii, upper) {
            (true, _) => lower,
            (false, upper) => upper,
        };
        if let (Matter::HalfSpace, Some(shade)) = (shown, self.shade(cut, column, top - self.half))
        {
            return (stress_map::sign(shade), Style::new());
        }
        if ascii || upper == lower {
            return (shown.glyph(ascii), self.theme.style(shown.role()));
        }
        match (upper, lower) {
            (Matter::Air, below) => ('▄', self.theme.style(below.role())),
            (above, _) => ('▀', self.theme.style(above.role())),
        }
    }
}

/// The indenter: calm, so that the stress is seen.
fn body(theme: &Theme) -> Color {
    match (theme.depth, theme.look) {
        (Depth::Sixteen, _) => Color::Gray,
        (_, Look::Light) => Color::Indexed(146),
        // A grey: no colour of the map is one.
        _ => Color::Indexed(59),
    }
}

/// A cell of two halves. One of a single colour is a blank: a byte instead of three, and one colour to change.
fn halves_of([upper, lower]: [Option<Color>; 2]) -> (char, Style) {
    if upper == lower && upper.is_some() {
        (' ', ground(Style::new(), upper))
    } else {
        ('▀', ground(ink(upper), lower))
    }
}

fn ink(color: Option<Color>) -> Style {
    color.map_or(Style::new(), |color| Style::new().fg(color))
}

fn ground(style: Style, color: Option<Color>) -> Style {
    color.map_or(style, |color| style.bg(color))
}

/// Names of the bodies, load and shift, where there is room for them.
fn words(frame: &Frame, app: &App, area: Rect, half: f64, width: f64, buffer: &mut Buffer) {
    if area.height < 5 || area.width < 36 {
        return;
    }
    let moment = &frame.observation.moment;
    let ascii = app.theme.ascii();
    let value = |value, unit| format_value_in(value, unit, 3, ascii);
    let mut line = |text: &str, y: u16| -> Option<u16> {
        let text = format!(" {text} ");
        let cells = Line::raw(text.as_str()).width() as u16;
        let x = area.x + area.width.checked_sub(cells)? / 2;
        buffer.set_stringn(x, y, &text, usize::from(cells), Style::reset());
        Some(x)
    };
    let load = format!("indenter, F_z {}", value(moment.normal_force, "N"));
    line(&load, area.y);
    if moment.stick_radius.is_some() && area.height >= 8 {
        let arrows = if ascii { "<->" } else { "↔" };
        line(
            &format!("{arrows} u_x {}", value(moment.shift, "m")),
            area.y + 1,
        );
    }
    if let Some(share) = frame.wear_share.filter(|_| area.height >= 10) {
        let seen = &frame.observation;
        let deepest = seen.wear.iter().copied().fold(0.0, f64::max);
        let [indenter, half_space] = [share, 1.0 - share].map(|part| value(part * deepest, "m"));
        line(
            &format!("worn: indenter {indenter}, half-space {half_space}"),
            area.y + 2,
        );
    }
    let times = if ascii { "x" } else { "×" };
    let exaggerated = match width / half {
        scale if scale >= 1.5 => format!("half-space, heights {times}{scale:.0}"),
        _ => "half-space".to_owned(),
    };
    let bottom = area.bottom() - 1;
    let Some([low, high]) = app.stress_bounds().filter(|_| frame.load.is_some()) else {
        line(&exaggerated, bottom);
        return;
    };
    // The scale of the colours, between its two ends.
    let ends = [low, high].map(|end| value(end, "Pa"));
    let name = if app.stress.is_largest_of_cycle() {
        format!("{}, cycle", app.stress.quantity.short())
    } else {
        app.stress.quantity.short().to_owned()
    };
    let before = format!("{name} {} ", ends[0]);
    let scale = format!("{before}{} {}", " ".repeat(SHADES), ends[1]);
    if let Some(x) = line(&scale, bottom) {
        let first = x + 1 + before.chars().count() as u16;
        for shade in 0..SHADES {
            let color = stress_map::color(&app.theme, app.stress.quantity.colors(), shade);
            if let Some(cell) = buffer.cell_mut((first + shade as u16, bottom)) {
                match color.filter(|_| !ascii) {
                    Some(color) => cell.set_char(' ').set_bg(color),
                    None => cell.set_char(stress_map::sign(shade)),
                };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::power_law::PowerLaw;
    use crate::scenario::Scenario;
    use crate::simulation::Simulation;

    #[test]
    fn bodies_lie_where_their_surfaces_say() {
        let size = 0.1;
        let open = Cut {
            indenter: 1.0,
            unworn: 0.5,
            surface: -0.2,
            unworn_surface: -0.2,
            contact: None,
        };
        let seen = [1.2, 0.7, 0.0, -0.5].map(|z| open.matter(z, size));
        let expected = [
            Matter::Indenter,
            Matter::Worn,
            Matter::Air,
            Matter::HalfSpace,
        ];
        assert_eq!(seen, expected);
        let closed = Cut {
            indenter: -1.0,
            unworn: -1.2,
            surface: -1.0,
            unworn_surface: -1.0,
            contact: Some(Matter::Slip),
        };
        let seen = [-0.9, -1.05, -1.15].map(|z| closed.matter(z, size));
        assert_eq!(seen, [Matter::Indenter, Matter::Slip, Matter::HalfSpace]);
    }

    /// d − f inside, (1/πR)[(2a² − r²) asin(a/r) + a√(r² − a²)] outside.
    #[test]
    fn the_surface_around_a_paraboloid_is_that_of_hertz() {
        let sets = [
            "motion.normal.amplitude=0".into(),
            "motion.normal.mean=1e-6".into(),
        ];
        let scenario = Scenario::load("hertz", &sets).expect("a scenario");
        let radius = match scenario.setup().indenter {
            crate::contact::indenter::Indenter::Paraboloid { radius } => radius,
            ref other => panic!("{other:?}"),
        };
        let mut setup = scenario.setup().clone();
        setup.grid = crate::math::grid::RadialGrid::uniform(200, 3e-4).expect("a grid");
        let simulation = Simulation::new(setup).expect("a contact");
        let seen = simulation.observe(Curves::DEPRESSION);
        let a = PowerLaw::paraboloid(radius).contact_radius(1e-6);
        for (&r, &sunk) in seen.radii.iter().zip(&seen.depression) {
            let exact = if r <= a {
                1e-6 - r * r / (2.0 * radius)
            } else {
                ((2.0 * a * a - r * r) * (a / r).asin() + a * (r * r - a * a).sqrt())
                    / (std::f64::consts::PI * radius)
            };
            assert!((sunk - exact).abs() < 1e-9, "{r}: {sunk} {exact}");
        }
    }
}
