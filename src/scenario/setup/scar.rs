//! Builds the initial scar from the keys of a scenario.

use super::{Faults, HARDLY_SAME, Spec};
use crate::contact::indenter::Indenter;
use crate::contact::scar::Scar;
use crate::scenario::value::length;

/// Keys of the scar.
const RADII: &str = "wear.initial_radii";
const DEPTHS: &str = "wear.initial_depths";

/// Maximum depth at the end of a scar's table inside the domain, relative to its greatest depth.
const CUT_OFF: f64 = 0.05;

/// Builds the initial scar, if there is one.
pub(super) fn scar(spec: &Spec, faults: &mut Faults) -> Option<Option<Scar>> {
    let given = spec.wear.as_ref();
    let radii = given.and_then(|wear| wear.initial_radii.as_deref());
    let depths = given.and_then(|wear| wear.initial_depths.as_deref());
    if radii.is_none() && depths.is_none() {
        return Some(None);
    }
    let (radii, depths) = (faults.need(RADII, radii), faults.need(DEPTHS, depths));
    let scar = Scar::new(radii?, depths?);
    faults.accept(spec, "wear", scar).map(Some)
}

/// Refuses a scar that does not fit a domain ending at `domain` (m), most often because of its unit.
pub(super) fn check(
    spec: &Spec,
    faults: &mut Faults,
    scar: &Scar,
    indenter: &Indenter,
    domain: f64,
) -> Option<()> {
    let (edge, (last, depth_there)) = (scar.edge(), scar.end());
    // A punch has no flank; its wear may be as deep as its slopes stay small.
    let flank = match indenter.rim() {
        Some(rim) => rim / HARDLY_SAME,
        None => indenter.profile(domain),
    };
    let shown = [
        last.min(edge),
        edge,
        scar.deepest(),
        domain,
        flank,
        last,
        depth_there,
    ];
    let [ends, reaches, deepest, limit, depths, end, still] = shown.map(length);
    let (key, rule) = if edge > HARDLY_SAME * domain || HARDLY_SAME * last < domain {
        let rule = format!(
            "the scar ends at r = {ends} m, where contact may reach {limit} m: is r in m? a column r_mm is converted"
        );
        (RADII, rule)
    } else if scar.deepest() > HARDLY_SAME * flank {
        let rule = format!(
            "the scar is {deepest} m deep, where a contact has depths of {depths} m: is the depth in m? a column \
             depth_um is converted"
        );
        (DEPTHS, rule)
    } else if edge > domain * (1.0 + 1e-9) {
        let rule = format!(
            "the scar reaches r = {reaches} m, beyond the domain's edge, {limit} m; a greater \
             numerics.domain_radius would hold it"
        );
        (RADII, rule)
    } else if last < domain * (1.0 - 1e-9) && depth_there > CUT_OFF * scar.deepest() {
        let rule = format!(
            "the table ends at r = {end} m, where the scar is still {still} m deep; a longer trace"
        );
        (DEPTHS, rule)
    } else {
        return Some(());
    };
    faults.refuse(spec, key, rule)
}
