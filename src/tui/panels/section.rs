//! A cut through indenter and half-space: two bodies, one pressed into the other, as one sees them.
//!
//! Heights are exaggerated; the picture is true in r and in z, each on its own scale. A sample is half
//! a cell high: what stands there is decided by the heights of the surfaces, and the contact is drawn
//! on the first sample below the indenter in the colours of stick and slip.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Line;

use super::{App, Frame, Panel};
use crate::math::grid::interpolate;
use crate::tui::plot::units::format_value_in;
use crate::tui::theme::{Role, Theme};

/// The picture is this many times as wide as the domain: the sides of the bodies are seen.
const WIDER: f64 = 1.5;

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
            indenter: worn - moment.depth,
            unworn: unworn - moment.depth,
            surface,
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
            None if z >= self.unworn => Matter::Worn,
            None => Matter::Air,
        }
    }
}

/// The heights that the picture spans, m: all of the indenter's flank within the domain, and as much
/// of the half-space.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    let (seen, depth) = (&frame.observation, frame.observation.moment.depth);
    if seen.depression.is_empty() {
        return Vec::new();
    }
    let edge = seen.radii.last().copied().unwrap_or(0.0);
    let flank = match frame.indenter.rim() {
        Some(_) => depth.abs(),
        None => frame.indenter.profile(WIDER * edge),
    };
    vec![-depth.max(0.0) - 0.6 * flank, flank - depth]
}

/// Draws the panel.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    let seen = &frame.observation;
    let (Some([low, high]), Some(&edge)) = (app.bounds(Panel::Section), seen.radii.last()) else {
        return;
    };
    if seen.depression.is_empty() || area.is_empty() {
        return;
    }
    let ascii = app.theme.ascii();
    let size = (high - low) / (2.0 * f64::from(area.height));
    for column in 0..area.width {
        let middle = f64::from(area.width) / 2.0;
        let x = (f64::from(column) + 0.5 - middle) / middle * WIDER * edge;
        let cut = Cut::at(frame, x.abs());
        for row in 0..area.height {
            let z = |half: f64| high - (2.0 * f64::from(row) + half) * size;
            let halves = [0.5, 1.5].map(|half| cut.matter(z(half), size));
            let (glyph, style) = cell(halves, &app.theme, ascii);
            if let Some(cell) = buffer.cell_mut((area.x + column, area.y + row)) {
                cell.set_char(glyph).set_style(style);
            }
        }
    }
    words(frame, app, area, (low, high), buffer);
}

/// One cell of two samples, the upper one first.
fn cell([upper, lower]: [Matter; 2], theme: &Theme, ascii: bool) -> (char, Style) {
    let style = |matter: Matter| theme.style(matter.role());
    let is_contact = |matter| matches!(matter, Matter::Stick | Matter::Slip);
    if ascii {
        // One sample a cell: the contact, where there is one.
        let shown = if is_contact(lower) { lower } else { upper };
        return (shown.glyph(ascii), style(shown));
    }
    if upper == lower {
        return (upper.glyph(ascii), style(upper));
    }
    match (upper, lower) {
        (Matter::Air, below) => ('▄', style(below)),
        (above, Matter::Air) => ('▀', style(above)),
        (above, below) if theme.colored() => {
            let ground = style(below).fg.unwrap_or_default();
            ('▀', style(above).bg(ground))
        }
        // Without colour the contact is the edge of the solid body.
        (above, _) => ('▀', style(above)),
    }
}

/// Names of the bodies, load and shift, where there is room for them.
fn words(frame: &Frame, app: &App, area: Rect, (low, high): (f64, f64), buffer: &mut Buffer) {
    if area.height < 5 || area.width < 36 {
        return;
    }
    let moment = &frame.observation.moment;
    let ascii = app.theme.ascii();
    let value = |value, unit| format_value_in(value, unit, 3, ascii);
    let mut line = |text: String, y: u16, style: Style| {
        let text = format!(" {text} ");
        let width = Line::raw(text.as_str()).width() as u16;
        if width <= area.width {
            let place = Rect::new(area.x + (area.width - width) / 2, y, width, 1);
            buffer.set_stringn(
                place.x,
                place.y,
                &text,
                usize::from(width),
                Style::reset().patch(style),
            );
        }
    };
    let plain = Style::new();
    let load = format!("indenter, F_z {}", value(moment.normal_force, "N"));
    line(load, area.y, plain);
    if moment.stick_radius.is_some() && area.height >= 8 {
        let arrows = if ascii { "<->" } else { "↔" };
        line(
            format!("{arrows} u_x {}", value(moment.shift, "m")),
            area.y + 1,
            plain,
        );
    }
    let edge = frame.observation.radii.last().copied().unwrap_or(0.0);
    // Cells are about twice as high as wide.
    let across = 2.0 * WIDER * edge / f64::from(area.width);
    let down = (high - low) / (2.0 * f64::from(area.height));
    let times = if ascii { "x" } else { "×" };
    let scale = across / down;
    let exaggerated = match scale {
        scale if scale >= 1.5 => format!("half-space, heights {times}{scale:.0}"),
        _ => "half-space".to_owned(),
    };
    line(exaggerated, area.bottom() - 1, plain);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::power_law::PowerLaw;
    use crate::scenario::Scenario;
    use crate::simulation::{Curves, Simulation};

    #[test]
    fn bodies_lie_where_their_surfaces_say() {
        let size = 0.1;
        let open = Cut {
            indenter: 1.0,
            unworn: 0.5,
            surface: -0.2,
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
            other => panic!("{other:?}"),
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
