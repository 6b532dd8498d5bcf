//! What is said to a key that no scenario has: the one that was meant, or those that there are.

use super::keys::PARAMETERS;
use super::nearest::nearest;
use super::schema::{is_section, split};

/// Returns the keys meant by a textbook's letter or another program's word, each with a remark to show beside its name.
fn by_word(word: &str) -> &'static [(&'static str, &'static str)] {
    match word {
        "k" | "wear_coefficient" | "wear_rate" | "specific_wear_rate" => &[
            ("wear.coefficient", " (per friction work)"),
            (
                "wear.coefficient_per_load",
                " (per load and distance, of a pin test)",
            ),
        ],
        "mu" | "cof" | "friction_coefficient" | "coefficient_of_friction" => {
            &[("friction.coefficient", "")]
        }
        "e_star" | "estar" | "e*" | "modulus" | "reduced_modulus" | "equivalent_modulus" => {
            &[("material.effective_modulus", "")]
        }
        "nu" | "poissons_ratio" | "poisson_ratio" => &[("material.poisson", "")],
        "r" | "ball_radius" | "radius_of_curvature" => &[("indenter.radius", "")],
        "load" | "normal_load" | "normal_force" => {
            &[("motion.normal.mean", " with control = \"force\"")]
        }
        "n" => &[("numerics.points", "")],
        _ => &[],
    }
}

/// The keys that the unknown `path` most likely stands for, each with a remark; none if there is nothing near.
fn meant_with_remarks(path: &str) -> Vec<(String, &'static str)> {
    let (section, key) = split(path);
    let word = key.to_lowercase();
    let in_motion = section.starts_with("motion.") && is_section(section);
    match word.as_str() {
        "omega" | "w" if in_motion => vec![(format!("{section}.angular_frequency"), "")],
        "f" | "freq" | "hz" if in_motion => vec![(format!("{section}.frequency"), "")],
        word => match by_word(word) {
            [] => Vec::from_iter(nearest(path, places().into_iter()).map(|key| (key.into(), ""))),
            known => Vec::from_iter(known.iter().map(|(key, more)| ((*key).to_owned(), *more))),
        },
    }
}

/// The keys that the unknown `path` most likely stands for; none if there is nothing near.
pub(super) fn meant(path: &str) -> impl Iterator<Item = String> {
    meant_with_remarks(path).into_iter().map(|(key, _)| key)
}

/// All keys and tables.
fn places() -> Vec<&'static str> {
    let mut known: Vec<&str> = Vec::new();
    for parameter in PARAMETERS {
        let dots = parameter
            .path
            .match_indices('.')
            .map(|(at, _)| &parameter.path[..at]);
        for candidate in dots.chain([parameter.path]) {
            if !known.contains(&candidate) {
                known.push(candidate);
            }
        }
    }
    known
}

/// A hint for the unknown `path`.
pub fn hint(path: &str) -> String {
    let meant = meant_with_remarks(path);
    if !meant.is_empty() {
        let told = meant.iter().map(|(key, more)| format!("{key}{more}"));
        return format!("did you mean {}?", told.collect::<Vec<_>>().join(" or "));
    }
    let section = split(path).0;
    let section = if is_section(section) { section } else { "" };
    let keys: Vec<&str> = places()
        .into_iter()
        .filter(|key| split(key).0 == section)
        .collect();
    format!("known are {}", keys.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_keys_are_led_to_the_nearest() {
        for (typed, near) in [
            ("numerics.pointz", "numerics.points"),
            ("points", "numerics.points"),
            ("numerics.steps", "numerics.steps_per_cycle"),
            ("frictoin", "friction"),
            ("material.friction", "friction"),
            ("motion.tangental", "motion.tangential"),
            ("indenter.raduis", "indenter.radius"),
            ("youngs_modulus", "material.indenter.youngs_modulus"),
        ] {
            assert_eq!(hint(typed), format!("did you mean {near}?"), "{typed}");
        }
        for (typed, near) in [
            (
                "wear.k",
                "wear.coefficient (per friction work) or wear.coefficient_per_load (per load and \
                 distance, of a pin test)",
            ),
            ("friction.mu", "friction.coefficient"),
            ("material.E_star", "material.effective_modulus"),
            (
                "motion.tangential.omega",
                "motion.tangential.angular_frequency",
            ),
            ("motion.tangential.freq", "motion.tangential.frequency"),
            ("load", "motion.normal.mean with control = \"force\""),
        ] {
            assert_eq!(hint(typed), format!("did you mean {near}?"), "{typed}");
        }
        assert!(hint("wear.zzz").starts_with("known are wear.law, wear.coefficient"));
        assert!(hint("zzz").starts_with("known are title, description, indenter"));
    }
}
