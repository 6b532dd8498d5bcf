//! Builds the wear law from the keys of a scenario.

use super::{Faults, Spec, bodies};
use crate::math::invalid::Unmade;
use crate::scenario::key::{Key, join};
use crate::scenario::spec::Wear;
use crate::simulation::Unworn;
use crate::wear::{LawParameters, WearLaw};

const WEAR: &str = "wear";

/// Builds the wear law. Keys that are not given follow from the contact, if the law needs them.
pub(super) fn law(
    spec: &Spec,
    faults: &mut Faults,
    wear: &Wear,
    k: f64,
    contact: &Unworn,
) -> Option<WearLaw> {
    let law = faults.need("wear.law", wear.law)?;
    let usual = Spec::usual().wear.as_ref();
    let usual = usual.map_or_else(LawParameters::default, |usual| usual.parameters);
    let given = wear.parameters.or(usual);
    let mut made = WearLaw::new(law, k, &given);
    if let Err(Unmade::Missing(_)) = made
        && let Some(contact) = contact.references()
    {
        made = WearLaw::new(law, k, &given.or(LawParameters::usual_for(contact)));
    }
    let made = match made {
        Ok(law) => Ok(law),
        Err(Unmade::Invalid(invalid)) => Err(invalid),
        Err(Unmade::Missing(key)) => {
            let path = join(WEAR, key);
            let unit = Key::known(&path).unit;
            return faults.missing(
                &path,
                format!("{unit}; none could be found from the contact"),
            );
        }
    };
    faults.accept(spec, WEAR, made)
}

/// Returns k per friction work, 1/Pa: as given, or the coefficient per load and distance divided by the initial
/// friction; 0 where nothing wears.
pub(super) fn coefficient(spec: &Spec, faults: &mut Faults) -> Option<f64> {
    let Some(wear) = &spec.wear else {
        return Some(0.0);
    };
    let (path, per_load) = ("wear.coefficient", "wear.coefficient_per_load");
    let Some(value) = wear.coefficient_per_load else {
        let described = Key::known(path).described();
        let meaning = described + "; or coefficient_per_load, of a pin test";
        return match wear.per_work.first() {
            None if faults.covers(per_load) => None,
            None => faults.missing(path, meaning),
            first => first,
        };
    };
    let friction = bodies::friction(spec, faults)?;
    if friction > 0.0 {
        return Some(value / friction);
    }
    let rule = "needs friction greater than 0: per friction work it is \
                k = coefficient_per_load / friction";
    faults.refuse(spec, per_load, rule)
}
