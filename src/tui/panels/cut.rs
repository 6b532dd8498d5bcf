//! Places the bodies of the cross-section: the heights of indenter and half-space along the motion, what is magnified,
//! and where it is on the screen.

use ratatui::layout::Rect;

use super::Shown;
use super::stress_map::Shares;
use crate::charts::magnification;
use crate::math::grid::interpolate;
use crate::math::number::shown;
use crate::math::scan::largest;
use crate::plot::theme::Theme;
use crate::reading::Zone;
use crate::simulation::drive::Control;
use crate::tui::frame::Frame;

/// The picture is this many times as wide as the domain, so that the sides of the bodies are visible.
const WIDER: f64 = 1.35;

/// Maximum amplitude of the motion, as a fraction of the picture's width and in columns, and the steps of the flanks, in
/// columns.
const SWING: f64 = 0.025;
const FARTHEST: f64 = 4.0;
const STRIDE: f64 = 2.0;

/// Maximum height of the wear, as a fraction of the picture's height, and its minimum magnification: in true size the
/// lost material has no room where the bodies touch.
const WEAR: f64 = 0.4;
const LEAST_WEAR: f64 = 2.0;

/// Minimum rows for a contact surface two half cells thick, and for lines that show what sticks.
pub const LARGE: u16 = 14;

/// What is at a point of the cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Matter {
    Air,
    Indenter,
    /// Worn off.
    Worn,
    /// The surface of contact, which sticks or slips.
    Contact(Zone),
    HalfSpace,
}

/// Heights above the undeformed surface, m, at one place along the motion.
pub struct Cut {
    indenter: f64,
    unworn: f64,
    pub surface: f64,
    /// The surface of the half-space as if it had not worn.
    unworn_surface: f64,
    zone: Zone,
}

impl Cut {
    /// Returns what is at height `z`, if the contact surface is drawn `thick` (m).
    pub fn matter(&self, z: f64, thick: f64) -> Matter {
        let is_open = self.zone == Zone::Open;
        match z {
            _ if z >= self.indenter => Matter::Indenter,
            _ if z < self.surface - thick => Matter::HalfSpace,
            _ if z <= self.surface && is_open => Matter::HalfSpace,
            _ if z <= self.surface => Matter::Contact(self.zone),
            _ if is_open && (self.unworn_surface..self.unworn).contains(&z) => Matter::Air,
            _ if !is_open && self.unworn.is_infinite() => Matter::Air,
            _ => Matter::Worn,
        }
    }
}

/// Returns the heights that the picture spans, m: the whole indenter's flank within the domain, and as much of the
/// half-space.
pub fn heights(frame: &Frame) -> Option<[f64; 2]> {
    let depth = frame.live.observation.moment.depth;
    if frame.live.observation.depression.is_empty() {
        return None;
    }
    let indenter = &frame.live.scenario.setup().indenter;
    let flank = match indenter.rim() {
        Some(_) => depth.abs(),
        None => indenter.profile(WIDER * frame.run.edge()),
    };
    Some([-depth.max(0.0) - 1.2 * flank, flank - depth])
}

/// A frame as a cut in an area: its lengths, m, and the magnifications.
pub struct ContactSection<'a> {
    /// What to draw, and the look of the terminal.
    pub of: &'a Shown<'a>,
    pub theme: Theme,
    pub area: Rect,
    /// The width of a column, and the height of half a cell on the scale of the surfaces.
    pub width: f64,
    pub half: f64,
    /// The height of the upper edge.
    pub high: f64,
    /// The magnification of the wear, in heights of the picture, and of the motion, in its widths.
    wear: f64,
    pub motion: f64,
    /// The drawn shift of the indenter: whole columns, so that a small motion does not redraw everything in every frame.
    pub shift: f64,
    /// The shift of its flanks, which takes steps of [`STRIDE`] columns: each step redraws all of them.
    flanks: f64,
    /// The frame of the half-space outside the contact, and of the stress below. It is held while the indenter stays
    /// within a row of its height there, so that the half-space stands still.
    resting: &'a Frame,
    /// The depth that is drawn in the contact, in whole rows.
    level: f64,
    /// The drawn height of the contact surface, and the height from the lowest point of the indenter to the upper edge,
    /// m, on the scale of the surfaces.
    pub thick: f64,
    pub tall: f64,
    pub stress: Option<Shares>,
}

impl<'a> ContactSection<'a> {
    /// Makes the cut; `None` if there is nothing to draw.
    pub fn new(of: &'a Shown<'a>, theme: &Theme, area: Rect) -> Option<Self> {
        let frame = of.frame;
        let seen = &frame.live.observation;
        let ([low, high], &edge) = (of.bounds?, seen.radii().last()?);
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
        let depths = [frame, of.calm].map(|frame| frame.live.observation.moment.depth);
        let may_rest = (depths[0] - depths[1]).abs() < 2.0 * half
            && !of.calm.live.observation.depression.is_empty();
        let resting = if may_rest { of.calm } else { frame };
        let deepest = largest(seen.wear()).max(frame.live.expected_wear);
        let wear = magnification(deepest, WEAR * (high - low)).max(LEAST_WEAR);
        let room = [area.width, 2 * area.height].map(usize::from);
        let mut section = Self {
            of,
            theme: *theme,
            area,
            width,
            half,
            high,
            wear: if seen.law.is_some() { wear } else { 1.0 },
            motion,
            shift: round_to_step(motion * seen.moment.shift, width),
            flanks: round_to_step(motion * seen.moment.shift, STRIDE * width),
            resting,
            level: round_to_step(resting.live.observation.moment.depth, 2.0 * half),
            thick: half * if area.height >= LARGE { 2.0 } else { 1.0 },
            tall: 0.0,
            // The bodies move with every frame, the stress below changes more calmly.
            stress: of.drawn.shares(of.stress, of.calm, room, width),
        };
        section.tall = round_to_step(high - section.cut(0.0).surface, 2.0 * half).max(half);
        Some(section)
    }

    /// Returns the cut at `x`, with magnified wear and a shifted indenter. Beyond the domain the indenter continues
    /// unworn, and the surface recovers in proportion to 1/r, as under a point load.
    pub fn cut(&self, x: f64) -> Cut {
        let (seen, scenario) = (
            &self.of.frame.live.observation,
            &self.of.frame.live.scenario,
        );
        let indenter = &scenario.setup().indenter;
        let (moment, edge, r) = (&seen.moment, self.of.frame.run.edge(), x.abs());
        // In the contact the surface is the indenter's. Around it, it is of the frame at rest.
        let is_in_contact = r <= moment.contact_radius;
        let of = if is_in_contact {
            seen
        } else {
            &self.resting.live.observation
        };
        let (touching, lift) = (of.moment.contact_radius, of.moment.depth - self.level);
        let sunk = |r: f64| interpolate(of.radii(), &of.depression, r.min(edge));
        let back = if r > edge { edge / r } else { 1.0 };
        // Far from the contact nothing is lifted, and nothing at all while the bodies are apart.
        let deepest = sunk(touching).max(sunk(r));
        let lifted = match r > touching {
            true if deepest > 0.0 => sunk(r) * back / deepest,
            true => 0.0,
            false => 1.0,
        };
        let surface = lift * lifted - sunk(r) * back;
        // The half-space wears only if the scenario says so.
        let share = scenario.wear_share().unwrap_or(1.0);
        let wear = |r: f64| {
            if r <= edge {
                self.wear * interpolate(seen.radii(), seen.wear(), r)
            } else {
                0.0
            }
        };
        let ground = surface - (1.0 - share) * wear(r);
        let rim = indenter.rim().unwrap_or(f64::INFINITY);
        // In the contact the indenter stays on the surface; its flanks are shifted as a whole.
        let along = (x - self.shift_at(r)).abs();
        let unworn = if (x - self.flanks).abs() > rim {
            f64::INFINITY
        } else {
            indenter.profile(along.min(rim)) - self.level
        };
        Cut {
            indenter: (unworn + share * wear(along)).max(ground),
            unworn,
            surface: ground,
            unworn_surface: surface,
            zone: moment.zone_at(r),
        }
    }

    /// Returns how far the indenter is shifted at `r`: zero in the contact, fully some distance away from it.
    fn shift_at(&self, r: f64) -> f64 {
        let contact = self.resting.live.observation.moment.contact_radius;
        let way = 4.0 * self.flanks.abs();
        match r - contact {
            _ if contact == 0.0 => self.flanks,
            beyond if beyond > 0.0 && way > 0.0 => self.flanks * (beyond / way).min(1.0),
            _ => 0.0,
        }
    }

    /// Returns a title with the magnifications, the wear's first, as far as `room` cells allow.
    pub fn title(&self, title: &str, room: usize) -> String {
        let heights = self.width / self.half;
        let factors = [
            ("wear", heights * self.wear, self.wear > 1.0),
            ("heights", heights, heights >= 1.5),
            ("motion", self.motion, self.motion > 1.0),
        ];
        let mut title = title.to_owned();
        for (name, factor, _) in factors.into_iter().filter(|factor| factor.2) {
            let more = format!(", {name} ×{}", shown(factor, 2));
            if title.chars().count() + more.chars().count() <= room {
                title.push_str(&more);
            }
        }
        title
    }

    /// Returns the column at `x`, m, if it is in the picture.
    pub fn column(&self, x: f64) -> Option<u16> {
        let at = (x / self.width + f64::from(self.area.width) / 2.0).floor();
        (at >= 0.0 && at < f64::from(self.area.width)).then(|| self.area.x + at as u16)
    }

    /// Returns the rows of the indenter's lower end and of the half-space's surface at `x`, m: the last whole rows
    /// above them.
    pub fn rows_above(&self, x: f64) -> Option<[u16; 2]> {
        let cut = self.cut(x);
        let row = |z: f64| {
            let row = ((self.high - z) / (2.0 * self.half)).floor() - 1.0;
            (row >= 1.0 && row < f64::from(self.area.height)).then(|| self.area.y + row as u16)
        };
        Some([row(cut.indenter)?, row(cut.surface)?])
    }
}

/// Returns the nearest multiple of a step.
pub fn round_to_step(value: f64, step: f64) -> f64 {
    (value / step).round() * step
}

/// Returns the amplitude of u_x, m: the prescribed one, or else the amplitude of the last cycle.
fn amplitude(frame: &Frame) -> f64 {
    if let Some(Control::Displacement(shift)) = frame.live.scenario.setup().drive.tangential() {
        return shift.amplitude();
    }
    let shifts = frame.run.loops.iter().flat_map(|one| &one.shifts);
    shifts.fold(0.0, |most, shift| shift.abs().max(most))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reading::Curves;
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
            zone: Zone::Open,
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
            zone: Zone::Slip,
        };
        let seen = [-0.9, -1.05, -1.15].map(|z| closed.matter(z, size));
        let slip = Matter::Contact(Zone::Slip);
        assert_eq!(seen, [Matter::Indenter, slip, Matter::HalfSpace]);
    }

    /// d − f inside, (1/πR)[(2a² − r²) asin(a/r) + a√(r² − a²)] outside.
    #[test]
    fn the_surface_around_a_paraboloid_is_that_of_hertz() {
        let sets = [
            "motion.normal.amplitude=0".into(),
            "motion.normal.mean=1e-6".into(),
        ];
        let scenario = Scenario::load("hertz", &sets).expect("a scenario");
        let radius = scenario.setup().indenter.ball_radius().expect("a ball");
        let mut setup = scenario.setup().clone();
        setup.grid = crate::math::grid::RadialGrid::uniform(200, 3e-4).expect("a grid");
        let simulation = Simulation::new(setup).expect("a contact");
        let seen = simulation.observe(Curves::DEPRESSION);
        let a = (radius * 1e-6).sqrt();
        for (&r, &sunk) in seen.radii().iter().zip(&seen.depression) {
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
