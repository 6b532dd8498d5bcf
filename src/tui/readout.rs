//! The values of all curves at the cursor, in a line.

use super::frame::Frame;
use crate::plot::Curve;
use crate::plot::units::{format_value_in, to_ascii};
use crate::simulation::Zone;

/// Significant digits.
const DIGITS: usize = 4;

/// `r 52.0 µm  slip  f ...`: as many values at the radius `r` (m) as fit `width` cells. Curves that
/// no panel shows are not computed, and so not here.
pub(super) fn line(frame: &Frame, r: f64, width: usize, ascii: bool) -> String {
    let seen = &frame.observation;
    let at = |values: &[f64]| Curve::new("", &seen.radii, values, Default::default()).value_at(r);
    let mut parts = vec![("r", Some(r), "m"), (zone(frame, r).name(), None, "")];
    let shear: &[f64] = match seen.moment.stick_radius {
        Some(_) => &seen.shear,
        None => &[],
    };
    let curves: [(&str, &[f64], &str); 5] = [
        ("f", &seen.profile, "m"),
        ("p", &seen.pressure, "Pa"),
        ("τ", shear, "Pa"),
        ("worn", &seen.wear, "m"),
        ("g", &seen.profile_1d, "m"),
    ];
    for (name, values, unit) in curves {
        parts.extend(at(values).map(|value| (name, Some(value), unit)));
    }
    let mut line = String::new();
    for (name, value, unit) in parts {
        let name = if ascii { to_ascii(name) } else { name.into() };
        let value = value.map(|value| format!(" {}", format_value_in(value, unit, DIGITS, ascii)));
        let part = format!(" {name}{} ", value.unwrap_or_default());
        if line.chars().count() + part.chars().count() > width {
            break;
        }
        line.push_str(&part);
    }
    line
}

/// What the surface does at a radius.
fn zone(frame: &Frame, r: f64) -> Zone {
    let moment = &frame.observation.moment;
    let contact = moment.contact_radius;
    if r >= contact {
        Zone::Open
    } else if r < moment.stick_radius.unwrap_or(contact) {
        Zone::Stick
    } else {
        Zone::Slip
    }
}
