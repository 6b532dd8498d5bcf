//! Builds a line contact from the keys of a scenario: its length,
//! its motion, and checks of what a line does not support.

use super::{Faults, Spec};
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::math::geometry::Geometry;
use crate::scenario::spec;
use crate::scenario::value::length;
use crate::simulation::Unworn;
use crate::simulation::drive::{Control, Drive};

/// Default length of a line contact, m: every force and volume is then per metre.
const PER_METRE: f64 = 1.0;

/// Default depth of the reference point for displacements, in unworn half-widths.
const USUAL_GAUGE: f64 = 10.0;

/// The depth of the reference point for displacements.
const GAUGE: &str = "motion.tangential.gauge_length";

/// Returns the depth of the reference point for displacements, m, if given.
fn gauge(spec: &Spec) -> Option<f64> {
    spec.motion.tangential.as_ref()?.gauge_length
}

/// Builds the geometry: round, or a line of some length. Refuses a key of the other geometry, a method without a line
/// kernel, and a measured section whose contact would be more than one strip.
pub(super) fn geometry(spec: &Spec, faults: &mut Faults, indenter: &Indenter) -> Option<Geometry> {
    let given = &spec.indenter;
    if given.geometry != Some(spec::GeometryWord::Line) {
        let rule = "needs geometry = \"line\" in [indenter]";
        return match (given.length, gauge(spec)) {
            (Some(_), _) => faults.refuse(spec, "indenter.length", rule),
            (None, Some(_)) => faults.refuse(spec, GAUGE, rule),
            (None, None) => Some(Geometry::Round),
        };
    }
    let method = spec.numerics.method;
    if !method.is_some_and(|method| method.traits().serves_lines) {
        let rule =
            "must be \"product\" with geometry = \"line\": the other methods are of round contacts";
        return faults.refuse(spec, "numerics.method", rule);
    }
    if let Indenter::Table(measured) = indenter {
        faults.accept(spec, "indenter", measured.check_strip())?;
    }
    let length = given.length.unwrap_or(PER_METRE);
    Some(Geometry::Line { length })
}

/// Adapts motion and material to a line contact in plane strain, where a displacement is infinite unless it has a
/// reference point.
pub(super) fn in_plane(
    spec: &Spec,
    faults: &mut Faults,
    geometry: Geometry,
    indenter: &Indenter,
    (drive, material): (Drive, Material),
) -> Option<(Drive, Material)> {
    if !geometry.is_line() {
        return Some((drive, material));
    }
    if drive.normal().displacement().is_some() {
        let rule = "a line contact has no depth of indentation, which is infinite in the plane; \
                    give motion.normal.control = \"force\", with mean and amplitude in N";
        return faults.refuse(spec, "motion.normal.control", rule);
    }
    let gauge = gauge(spec);
    if gauge.is_none() && matches!(drive.tangential(), Some(Control::Displacement(_))) {
        let meaning = "depth of the point that the displacement of a line contact is measured relative to, m; \
                       or give motion.tangential.control = \"force\"";
        return faults.missing(GAUGE, meaning);
    }
    let material = material.in_plane_strain();
    let unworn = Unworn {
        geometry,
        indenter,
        material: &material,
        drive: &drive,
    };
    let usual = || USUAL_GAUGE * unworn.radius(unworn.deepest());
    let gauge = gauge.unwrap_or_else(usual);
    Some((drive.in_geometry(geometry, &material, gauge), material))
}

/// Refuses a gauge length inside the domain, which ends at `domain` (m).
pub(super) fn check_gauge(
    spec: &Spec,
    faults: &mut Faults,
    drive: &Drive,
    domain: f64,
) -> Option<()> {
    let is_inside = drive.gauge_length().is_some_and(|gauge| gauge <= domain);
    if !is_inside || gauge(spec).is_none() {
        return Some(());
    }
    let least = length(domain);
    let rule = format!("must be greater than the contact can become wide, {least} m");
    faults.refuse(spec, GAUGE, rule)
}
