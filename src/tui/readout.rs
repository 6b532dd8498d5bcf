//! The values of the curves at the cursor, in a line; what the focused panel shows comes first where there
//! are ghosts, with the value of each and its difference.

use super::frame::Frame;
use super::panels::Panel;
use crate::plot::chart::value_at;
use crate::plot::units::{format_value_in, to_ascii};
use crate::simulation::Zone;
use crate::studies::ghost::{Axes, Ghost};

/// Significant digits.
const DIGITS: usize = 4;

/// The most characters of a ghost's name.
const LONGEST_NAME: usize = 16;

/// `r 52.0 µm  slip  f ...`: as many values at the radius `r` (m) as fit `width` cells. Curves that
/// no panel shows are not computed, and so not here.
pub(super) fn line(frame: &Frame, focus: Panel, r: f64, width: usize, ascii: bool) -> String {
    let value = |name: &str, value: f64, unit: &str| {
        let name = if ascii { to_ascii(name) } else { name.into() };
        format!(" {name} {} ", format_value_in(value, unit, DIGITS, ascii))
    };
    let mut parts = compared(frame, focus, r, ascii);
    let at_radius = parts.is_empty() || quantity(frame, focus, r).is_some_and(|seen| seen.over_r);
    if at_radius {
        let place = [value("r", r, "m"), format!(" {} ", zone(frame, r).name())];
        parts.splice(0..0, place);
        for (name, values, unit) in curves(frame) {
            let at = at(frame, values, r).map(|seen| value(name, seen, unit));
            parts.extend(at.filter(|part| !parts.contains(part)));
        }
    }
    let mut line = String::new();
    for part in parts {
        if line.chars().count() + part.chars().count() > width {
            break;
        }
        line.push_str(&part);
    }
    line
}

/// The curves over the radius: name, values, unit.
fn curves(frame: &Frame) -> [(&'static str, &[f64], &'static str); 5] {
    let seen = &frame.observation;
    let shear: &[f64] = match seen.moment.stick_radius {
        Some(_) => &seen.shear,
        None => &[],
    };
    [
        ("f", &seen.profile, "m"),
        ("p", &seen.pressure, "Pa"),
        ("τ", shear, "Pa"),
        ("worn", &seen.wear, "m"),
        ("g", &seen.profile_1d, "m"),
    ]
}

fn at(frame: &Frame, values: &[f64], r: f64) -> Option<f64> {
    value_at(&frame.observation.radii, values, r)
}

/// What a panel compares at one place.
struct Quantity {
    name: &'static str,
    unit: &'static str,
    /// The run's own value.
    value: f64,
    /// Whether the place is a radius, and not the present moment.
    over_r: bool,
    /// The value of each ghost there, where it has one.
    ghosts: Vec<Option<f64>>,
}

/// What the focused panel compares: at the radius, or at the present cycle and displacement.
fn quantity(frame: &Frame, focus: Panel, r: f64) -> Option<Quantity> {
    let (seen, moment) = (&frame.observation, &frame.observation.moment);
    let axes = focus
        .recipe()
        .overlays
        .first()
        .copied()
        .unwrap_or(Axes::Wear);
    let (name, unit) = axes.quantity();
    let value = match axes {
        Axes::Profile => at(frame, &seen.profile, r),
        Axes::Wear => at(frame, &seen.wear, r),
        Axes::Springs => at(frame, &seen.profile_1d, r),
        Axes::Pressure => at(frame, &seen.pressure, r),
        Axes::Shear => at(frame, &seen.shear, r),
        Axes::Loop => Some(moment.tangential_force),
        Axes::Volume => Some(moment.wear_volume),
        Axes::Depth => frame.trend.cycles().last().map(|entry| entry.scar_depth),
        Axes::Contact => Some(moment.contact_radius),
        Axes::Stick => moment.permanent_stick_radius,
    };
    let of_ghost = |ghost: &Ghost| match axes {
        Axes::Loop => {
            let rises = frame.last_loop().rises();
            ghost.trace(axes)?.force_at(moment.shift, rises)
        }
        Axes::Wear => {
            let worn = ghost.worn(|r| frame.indenter.profile(r))?;
            value_at(&worn.radii, &worn.wear, r)
        }
        _ if axes.over_r() => ghost.trace(axes)?.value_at(r),
        _ => ghost.trace(axes)?.value_at(moment.cycle),
    };
    Some(Quantity {
        name,
        unit,
        value: value?,
        over_r: axes.over_r(),
        ghosts: frame.ghosts.iter().map(|ghost| of_ghost(ghost)).collect(),
    })
}

/// The run's value of what the focused panel shows, and for each ghost that has it its value and how far
/// it is above that of the run; nothing where no ghost has it.
fn compared(frame: &Frame, focus: Panel, r: f64, ascii: bool) -> Vec<String> {
    let Some(seen) = quantity(frame, focus, r) else {
        return Vec::new();
    };
    let shown = |value: f64| format_value_in(value, seen.unit, DIGITS, ascii);
    let mut parts = vec![format!(" {} {} ", seen.name, shown(seen.value))];
    for (ghost, value) in frame.ghosts.iter().zip(&seen.ghosts) {
        let Some(value) = *value else {
            continue;
        };
        let difference = value - seen.value;
        let sign = if difference < 0.0 { "" } else { "+" };
        let name: String = ghost.name.chars().take(LONGEST_NAME).collect();
        let name = if ascii {
            to_ascii(&name).into_owned()
        } else {
            name
        };
        parts.push(format!(
            " {name} {} ({sign}{}) ",
            shown(value),
            shown(difference)
        ));
    }
    if parts.len() == 1 {
        parts.clear();
    }
    parts
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
