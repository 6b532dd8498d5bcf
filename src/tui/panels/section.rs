//! A cut through indenter and half-space: one body pressed into the other, with the stress under
//! the contact. Zoomed it is the contact itself, large: the indenter follows its motion, and captions
//! tell the phase of the cycle ([`super::caption`]).
//!
//! ```text
//!  ████████████████████████████████    indenter: heights exaggerated, shifted by its magnified motion
//!    ▀▀██████████████████████████▀▀    ╱ what it has lost, magnified
//!  ▄▄▄▄╱╱╱╱▀▀██████████████▀▀╱╱╱╱▄▄    contact: stick and slip in their colours
//!  ░░░░░░░░░░▄▄▄▄▄▄▄▄▄▄▄▄▄▄░░░░░░░░    half-space: the stress inside, in true lengths
//! ```
//!
//! Heights of the surfaces are exaggerated, each body's surface to an eighth of a cell. Below the surface
//! lengths are true: a half cell is about as high as a column is wide, and both stand for the same length,
//! so the stress lies under the contact as it does in the material. The motion is magnified too: short lines
//! on both bodies stay in one where the contact sticks, and part where it slips. The flanks of the indenter
//! move with it; between them the contact stays closed.

use ratatui::prelude::*;

use super::stress_map::Shades;
use super::{App, Canvas, Frame, Panel, Picture, Recipe, caption, edge};
use crate::charts::{U_X, magnification};
use crate::math::grid::interpolate;
use crate::math::scan::largest;
use crate::plot::shades::{self, has_blocks};
use crate::plot::units::format_number;
use crate::reading::{Curves, Zone};
use crate::tui::theme::{Depth, Look, Role, Theme};

/// The panel.
pub static PICTURE: Picture = Picture {
    recipe: Recipe {
        title: "cross-section",
        needs: Curves::PROFILE
            .union(Curves::DEPRESSION)
            .union(Curves::SPRINGS)
            .union(Curves::SURFACE),
        is_calm: true,
        text: "A cut through both bodies: the indenter above, the half-space it deforms below. \
             The title tells what is magnified. The contact surface is coloured by stick and slip; \
             the short lines across it (V) stay in one where it sticks, and part where it slips.",
        symbols: &[("F_z", "normal force"), U_X],
        ..Recipe::new(|_, _| Err(""))
    },
    draw,
    extent: heights,
};

/// The picture is this many times as wide as the domain: the sides of the bodies are seen.
const WIDER: f64 = 1.35;

/// Parts of a cell that a surface is drawn to.
const PARTS: usize = 8;

/// Lower blocks, by the eighths of a cell that they fill.
const LOWER: [char; PARTS + 1] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// The amplitude of the motion takes up to this share of the picture's width, the wear of its height.
const SWING: f64 = 0.025;
const WEAR: f64 = 0.4;

/// The least magnification of the wear: in true size what is lost has no room, where the bodies touch.
const LEAST_WEAR: f64 = 2.0;

/// And no more columns than this: each is redrawn in the flanks.
const FARTHEST: f64 = 4.0;

/// Rows from which on the contact surface is drawn two half cells thick, and lines show what sticks.
const LARGE: u16 = 14;

/// Rows from which on these lines are two cells long on each body.
const LONG_LINES: u16 = 22;

/// Greys of the indenter.
const SHADES_OF_BODY: f64 = 6.0;

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
    /// Its colour, and a whole cell of it, in Unicode and in ASCII.
    fn look(self) -> (Role, [char; 2]) {
        match self {
            Self::Air => (Role::Quiet, [' ', ' ']),
            Self::Indenter => (Role::Profile, ['█', '#']),
            Self::Worn => (Role::Notice, ['╱', '/']),
            Self::Stick => (Role::Stick, ['▀', 's']),
            Self::Slip => (Role::Slip, ['▀', '~']),
            Self::HalfSpace => (Role::Open, ['░', '.']),
        }
    }
}

/// Heights over the undeformed surface, m, at one place along the motion.
struct Cut {
    indenter: f64,
    unworn: f64,
    surface: f64,
    /// Where the half-space would end had it not worn.
    unworn_surface: f64,
    contact: Option<Matter>,
}

impl Cut {
    /// What is at height `z`, where the surface of contact is drawn `thick` (m).
    fn matter(&self, z: f64, thick: f64) -> Matter {
        match self.contact {
            _ if z >= self.indenter => Matter::Indenter,
            Some(_) if z >= self.surface && self.unworn.is_finite() => Matter::Worn,
            Some(contact) if z < self.surface && z >= self.surface - thick => contact,
            _ if z <= self.surface => Matter::HalfSpace,
            None if z >= self.unworn || z <= self.unworn_surface => Matter::Worn,
            _ => Matter::Air,
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
    let indenter = &frame.facts.scenario.setup().indenter;
    let flank = match indenter.rim() {
        Some(_) => depth.abs(),
        None => indenter.profile(WIDER * edge(frame)),
    };
    Some([-depth.max(0.0) - 1.2 * flank, flank - depth])
}

/// A frame as a cut in an area: its lengths, m, and how much is magnified.
pub(super) struct Section<'a> {
    pub frame: &'a Frame,
    pub app: &'a App,
    pub area: Rect,
    /// The width of a column, and the height of half a cell on the scale of the surfaces.
    width: f64,
    half: f64,
    /// The height of the upper edge.
    high: f64,
    /// How many times the wear is drawn, in heights of the picture; and the motion, in its widths.
    wear: f64,
    motion: f64,
    /// The shift of the indenter as it is drawn, and how much higher both bodies are drawn: the indenter moves by
    /// whole columns and rows, so that a small motion does not redraw everything with every frame.
    shift: f64,
    lift: f64,
    /// The height of the drawn surface of contact, and that from the lowest place of the indenter to the upper edge,
    /// m, on the scale of the surfaces.
    thick: f64,
    tall: f64,
    stress: Option<Shades>,
}

impl<'a> Section<'a> {
    /// The cut; `None` where there is nothing to draw.
    fn of(frame: &'a Frame, app: &'a App, area: Rect) -> Option<Self> {
        let seen = &frame.observation;
        let held = app.charts.bounds(Panel::Section);
        let ([low, high], &edge) = (held?, seen.radii.last()?);
        if seen.depression.is_empty() || area.is_empty() {
            return None;
        }
        let width = 2.0 * WIDER * edge / f64::from(area.width);
        let reach = (SWING * 2.0 * WIDER * edge).min(FARTHEST * width);
        let motion = match amplitude(frame) {
            amplitude if amplitude > 0.0 => magnification(amplitude, reach),
            _ => 0.0,
        };
        let half = (high - low) / (2.0 * f64::from(area.height));
        let deepest = largest(&seen.wear).max(frame.facts.expected_wear);
        let wear = magnification(deepest, WEAR * (high - low)).max(LEAST_WEAR);
        let [columns, rows] = [area.width, 2 * area.height].map(usize::from);
        let mut section = Self {
            frame,
            app,
            area,
            width,
            half,
            high,
            wear: if seen.law.is_some() { wear } else { 1.0 },
            motion,
            shift: whole(motion * seen.moment.shift, width),
            lift: seen.moment.depth - whole(seen.moment.depth, 2.0 * half),
            thick: half * if area.height >= LARGE { 2.0 } else { 1.0 },
            tall: 0.0,
            // The bodies move with every frame, the stress below changes more calmly.
            stress: (app.stress).samples(app.calm.of(frame), columns, rows, width),
        };
        section.tall = high - section.cut(0.0).surface;
        Some(section)
    }

    /// The cut at `x`, where the wear is drawn magnified and the indenter shifted. Beyond the domain the
    /// indenter goes on unworn, and the surface comes back as under a point load, in proportion to 1/r.
    fn cut(&self, x: f64) -> Cut {
        let (seen, scenario) = (&self.frame.observation, &self.frame.facts.scenario);
        let indenter = &scenario.setup().indenter;
        let (moment, edge, r) = (&seen.moment, edge(self.frame), x.abs());
        let sunk = |r: f64| interpolate(&seen.radii, &seen.depression, r.min(edge));
        let back = if r > edge { edge / r } else { 1.0 };
        // Far from the contact nothing is lifted.
        let lifted = match r - moment.contact_radius {
            beyond if beyond > 0.0 => sunk(r) * back / sunk(moment.contact_radius).max(sunk(r)),
            _ => 1.0,
        };
        let surface = self.lift * lifted - sunk(r) * back;
        // Nothing of the half-space is worn unless the scenario says so.
        let share = scenario.wear_share().unwrap_or(1.0);
        let wear = |r: f64| match r <= edge {
            true => self.wear * interpolate(&seen.radii, &seen.wear, r),
            false => 0.0,
        };
        let ground = surface - (1.0 - share) * wear(r);
        let rim = indenter.rim().unwrap_or(f64::INFINITY);
        // Where it touches, the indenter stays on the surface; its flanks are shifted as a whole.
        let along = (x - self.given_way(moment.contact_radius, r)).abs();
        let unworn = match (x - self.shift).abs() > rim {
            true => f64::INFINITY,
            false => indenter.profile(along.min(rim)) - moment.depth + self.lift,
        };
        let contact = match moment.zone_at(r) {
            Zone::Open => None,
            Zone::Stick => Some(Matter::Stick),
            Zone::Slip => Some(Matter::Slip),
        };
        Cut {
            indenter: (unworn + share * wear(along)).max(ground),
            unworn,
            surface: ground,
            unworn_surface: surface,
            contact,
        }
    }

    /// How far the indenter is shifted at `r`: not where it touches, and as a whole some way from there.
    fn given_way(&self, contact: f64, r: f64) -> f64 {
        let way = 4.0 * self.shift.abs();
        match r - contact {
            _ if contact == 0.0 => self.shift,
            beyond if beyond > 0.0 && way > 0.0 => self.shift * (beyond / way).min(1.0),
            _ => 0.0,
        }
    }

    /// The title with what is magnified, the wear first, as far as `room` cells suffice.
    fn title(&self, room: usize) -> String {
        let heights = self.width / self.half;
        let factors = [
            ("wear", heights * self.wear, self.wear > 1.0),
            ("heights", heights, heights >= 1.5),
            ("motion", self.motion, self.motion > 1.0),
        ];
        let mut title = PICTURE.recipe.title.to_owned();
        for (name, factor, _) in factors.into_iter().filter(|factor| factor.2) {
            let more = format!(", {name} ×{}", format_number(factor, 2));
            if title.chars().count() + more.chars().count() <= room {
                title.push_str(&more);
            }
        }
        title
    }

    /// The column at `x`, m, where the picture has one.
    pub fn column(&self, x: f64) -> Option<u16> {
        let at = (x / self.width + f64::from(self.area.width) / 2.0).floor();
        (at >= 0.0 && at < f64::from(self.area.width)).then(|| self.area.x + at as u16)
    }

    /// The rows of the lower end of the indenter and of the surface of the half-space at `x`, m: the last whole
    /// ones of what is above.
    pub fn rows_above(&self, x: f64) -> Option<[u16; 2]> {
        let cut = self.cut(x);
        let row = |z: f64| {
            let row = ((self.high - z) / (2.0 * self.half)).floor() - 1.0;
            (row >= 1.0 && row < f64::from(self.area.height)).then(|| self.area.y + row as u16)
        };
        Some([row(cut.indenter)?, row(cut.surface)?])
    }

    /// Draws the bodies.
    fn bodies(&self, canvas: &mut Canvas) {
        let area = self.area;
        for column in 0..area.width {
            let middle = f64::from(column) + 0.5 - f64::from(area.width) / 2.0;
            let cut = self.cut(middle * self.width);
            for row in 0..area.height {
                let top = self.high - 2.0 * f64::from(row) * self.half;
                let (glyph, style) = self.cell(&cut, usize::from(column), top);
                if let Some(cell) = canvas.cell(column, row) {
                    cell.set_char(glyph).set_style(style);
                }
            }
        }
    }

    /// Lines on both bodies: those of the indenter move with it, those of the half-space with its surface.
    fn lines(&self, canvas: &mut Canvas) {
        let (seen, area) = (&self.frame.observation, self.area);
        if self.motion == 0.0 || seen.surface.is_empty() || !has_blocks(&self.app.theme) {
            return;
        }
        let apart = (f64::from(area.width) / 14.0).max(5.0).floor() * self.width;
        let places = (-7..=7).map(|k| f64::from(k) * apart);
        for x in places.filter(|x| x.abs() < seen.moment.contact_radius) {
            let surface = interpolate(&seen.radii, &seen.surface, x.abs());
            let moved = whole(self.motion * surface, self.width);
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
                    caption::take_ground(cell);
                    cell.set_char('┃').set_style(caption::ink(&self.app.theme));
                }
            }
        }
    }

    /// The cell whose upper edge is at height `top`.
    fn cell(&self, cut: &Cut, column: usize, top: f64) -> (char, Style) {
        if !has_blocks(&self.app.theme) {
            return self.plain(cut, column, top);
        }
        let half = self.half;
        let part = |k: usize| top - (k as f64 + 0.5) * 2.0 * half / PARTS as f64;
        let matter: [Matter; PARTS] = std::array::from_fn(|k| cut.matter(part(k), self.thick));
        // The two that have most of the cell, in their order.
        let mut runs: Vec<&[Matter]> = matter.chunk_by(PartialEq::eq).collect();
        while runs.len() > 2 {
            let least = (0..runs.len()).min_by_key(|&k| runs[k].len());
            runs.remove(least.unwrap_or(0));
        }
        let (upper, lower) = (runs[0], runs[runs.len() - 1]);
        if upper[0] != lower[0] {
            let count = lower.len() * PARTS / (lower.len() + upper.len());
            let block = LOWER[count.clamp(1, PARTS - 1)];
            let above = self.ink(cut, column, part(0), upper[0]);
            return match self.ink(cut, column, part(PARTS - 1), lower[0]) {
                // Air has the colour of the screen, which nobody knows: the block is cut out of the other.
                None => (block, ink(above).add_modifier(Modifier::REVERSED)),
                below => (block, ground(ink(below), above)),
            };
        }
        let color = self.ink(cut, column, part(0), upper[0]);
        match upper[0] {
            Matter::HalfSpace => {
                let at =
                    |halves: f64| self.ink(cut, column, top - halves * half, Matter::HalfSpace);
                match [at(0.5), at(1.5)] {
                    // A blank: a byte instead of three, and one colour to change.
                    [upper, lower] if upper == lower && upper.is_some() => {
                        (' ', ground(Style::new(), upper))
                    }
                    [upper, lower] => ('▀', ground(ink(upper), lower)),
                }
            }
            Matter::Worn => {
                let style = ground(ink(color), color);
                ('╱', style.patch(self.app.theme.style(Role::Profile)))
            }
            Matter::Indenter => ('█', ink(color)),
            _ => (' ', ground(Style::new(), color)),
        }
    }

    /// The colour of what is at height `z`; `None` for air.
    fn ink(&self, cut: &Cut, column: usize, z: f64, matter: Matter) -> Option<Color> {
        let theme = &self.app.theme;
        match matter {
            Matter::Air => None,
            // Greys, which no colour of the map is, brighter towards the contact.
            Matter::Indenter => {
                let depth = (self.high - z) / self.tall * SHADES_OF_BODY;
                let depth = depth.clamp(0.0, SHADES_OF_BODY - 1.0) as u8;
                Some(color(theme, Color::Gray, [236 + depth, 254 - depth]))
            }
            // Where the indenter was, under the hatching.
            Matter::Worn => Some(color(theme, Color::Black, [58, 229])),
            Matter::HalfSpace => match self.shade(cut, column, z) {
                Some(shade) => shades::color(theme, self.app.stress.colors(), shade),
                None => theme.style(Role::Open).fg,
            },
            // What slips glows.
            Matter::Slip => {
                let plain = theme.style(Role::Slip).fg?;
                Some(color(theme, plain, [208, 202]))
            }
            Matter::Stick => theme.style(Role::Stick).fg,
        }
    }

    /// The shade of the stress at height `z`.
    fn shade(&self, cut: &Cut, column: usize, z: f64) -> Option<usize> {
        let below = ((cut.surface - z) / self.half).max(0.0) as usize;
        Some(self.stress.as_ref()?(column, below))
    }

    /// A cell without colour: the bodies as signs, one a cell in ASCII.
    fn plain(&self, cut: &Cut, column: usize, top: f64) -> (char, Style) {
        let (theme, half) = (&self.app.theme, self.half);
        let [upper, lower] = [0.5, 1.5].map(|at| cut.matter(top - at * half, self.thick));
        let is_contact = matches!(lower, Matter::Stick | Matter::Slip);
        let shown = match is_contact && theme.ascii() {
            true => lower,
            false => upper,
        };
        if let (Matter::HalfSpace, Some(shade)) = (shown, self.shade(cut, column, top - half)) {
            return (shades::sign(shade), Style::new());
        }
        if theme.ascii() || upper == lower {
            let (role, signs) = shown.look();
            return (signs[usize::from(theme.ascii())], theme.style(role));
        }
        match upper {
            Matter::Air => ('▄', theme.style(lower.look().0)),
            above => ('▀', theme.style(above.look().0)),
        }
    }
}

/// The nearest multiple of a step.
fn whole(value: f64, step: f64) -> f64 {
    (value / step).round() * step
}

/// The amplitude of u_x, m: the one that is prescribed, or that of the last cycle.
fn amplitude(frame: &Frame) -> f64 {
    let key = "motion.tangential.amplitude";
    let mut settings = frame.facts.settings.iter();
    let given = settings.find(|setting| setting.parameter.path == key && setting.unit == "m");
    let given = given.and_then(|setting| setting.value.as_deref()?.parse::<f64>().ok());
    let shifts = frame.run.loops.iter().flat_map(|one| &one.shifts);
    given.unwrap_or_else(|| shifts.fold(0.0, |most, shift| shift.abs().max(most)))
}

fn draw(frame: &Frame, app: &App, role: Role, mut canvas: Canvas) {
    let room = usize::from(canvas.area.width.saturating_sub(2));
    let inner = canvas.titled(PICTURE.recipe.title, role).area;
    let [picture, below] = caption::beside(inner);
    let Some(section) = Section::of(frame, app, picture) else {
        return;
    };
    canvas.titled(&section.title(room), role);
    let mut canvas = canvas.at(picture);
    section.bodies(&mut canvas);
    if picture.height >= LARGE {
        section.lines(&mut canvas);
    }
    caption::draw(&section, canvas, below);
}

/// A colour of the cube of 256 for a dark and for a light background, or the one of sixteen.
fn color(theme: &Theme, sixteen: Color, [dark, light]: [u8; 2]) -> Color {
    match (theme.depth, theme.look) {
        (Depth::Sixteen, _) => sixteen,
        (_, Look::Light) => Color::Indexed(light),
        _ => Color::Indexed(dark),
    }
}

fn ink(color: Option<Color>) -> Style {
    color.map_or(Style::new(), |color| Style::new().fg(color))
}

fn ground(style: Style, color: Option<Color>) -> Style {
    color.map_or(style, |color| style.bg(color))
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
