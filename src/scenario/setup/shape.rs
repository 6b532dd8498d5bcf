//! Builds the indenter from the keys of a scenario, and checks a measured one against the domain.

use super::{Faults, HARDLY_SAME, Spec};
use crate::contact::indenter::{Dimensions, Indenter};
use crate::contact::measured::MeasuredProfile;
use crate::scenario::key::{Default, Key, Kind};
use crate::scenario::value::length;

/// Allowed slopes a/R of a table at the contact's edge: beyond the steepest and the shallowest, one of its columns is
/// in another unit.
const STEEPEST: f64 = 1.0;
const SHALLOWEST: f64 = 1e-5;

/// Minimum number of points of a table within the domain.
const FEWEST_IN_CONTACT: usize = 4;

/// Builds the unworn shape.
pub(super) fn indenter(spec: &Spec, faults: &mut Faults) -> Option<Indenter> {
    let given = &spec.indenter;
    let shape = faults.need("indenter.shape", given.shape)?;
    check_keys(spec, faults, shape.into())?;
    let smoothing = spec.or_usual(|of| of.indenter.dimensions.smoothing);
    let given = Dimensions {
        smoothing,
        ..given.dimensions.clone()
    };
    faults.make(spec, "indenter", Indenter::new(shape, &given))
}

/// Refuses keys of other shapes, and notes the numbers of this one that are missing.
fn check_keys(spec: &Spec, faults: &mut Faults, shape: &str) -> Option<()> {
    let keys = Key::all().filter_map(|key| Some((key, key.shapes()?.contains(&shape))));
    let (takes, others): (Vec<_>, Vec<_>) = keys.partition(|(_, takes)| *takes);
    let mut others = others.into_iter();
    if let Some((foreign, _)) = others.find(|(key, _)| spec.get(*key).is_some()) {
        let takes: Vec<&str> = takes.iter().map(|(key, _)| key.key()).collect();
        let takes = takes.join(", ");
        let rule = format!("shape = \"{shape}\" has no such key; it takes {takes}");
        return faults.refuse(spec, foreign.path, rule);
    }
    for (key, _) in takes {
        if key.kind == Kind::Number && key.default == Default::None {
            faults.need(key.path, spec.get(key));
        }
    }
    Some(())
}

/// Refuses a table that ends inside the domain, has hardly a point in the contact, or has slopes too steep for a
/// half-space: most often because its lengths are in another unit.
pub(super) fn check_measured(
    spec: &Spec,
    faults: &mut Faults,
    measured: &MeasuredProfile,
    domain: f64,
) -> Option<()> {
    let last = measured.last_radius();
    let points = measured.points_within(domain);
    let slope = 2.0 * measured.profile(domain.min(last)) / domain.min(last);
    let unit = "are r and f in m? columns r_mm and f_um are converted";
    let [edge, end] = [domain, last].map(length);
    let rule = if slope > STEEPEST {
        format!("a/R = {slope:.1e} at the contact's edge, where slopes must be small: {unit}")
    } else if domain > last {
        let hint = if domain > HARDLY_SAME * last || slope < SHALLOWEST {
            format!(": {unit}")
        } else {
            "; a longer trace, or a smaller depth".into()
        };
        format!("the table ends at r = {end} m, but the contact can reach {edge} m{hint}")
    } else if points < FEWEST_IN_CONTACT || slope < SHALLOWEST {
        format!(
            "only {points} points lie within {edge} m, where contact is possible, \
             and a/R is {slope:.1e}: {unit}"
        )
    } else {
        return Some(());
    };
    faults.refuse(spec, "indenter.radii", rule)
}
