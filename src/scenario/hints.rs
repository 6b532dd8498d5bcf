//! What is said to a key that no scenario has: the one that was meant, or those that there are.

use super::keys::PARAMETERS;
use super::nearest::nearest;
use super::schema::{is_section, split};

/// The keys that people mean by the letters of textbooks and by words of other programs, at their own
/// place or at any other.
const MEANT: &[(&[&str], &[&str])] = &[
    (
        &["k", "wear_coefficient", "wear_rate", "specific_wear_rate"],
        &["wear.coefficient", "wear.coefficient_per_load"],
    ),
    (
        &[
            "mu",
            "cof",
            "friction_coefficient",
            "coefficient_of_friction",
        ],
        &["friction.coefficient"],
    ),
    (
        &[
            "e_star",
            "estar",
            "e*",
            "modulus",
            "reduced_modulus",
            "equivalent_modulus",
        ],
        &["material.effective_modulus"],
    ),
    (
        &["nu", "poissons_ratio", "poisson_ratio"],
        &["material.poisson"],
    ),
    (
        &["r", "ball_radius", "radius_of_curvature"],
        &["indenter.radius"],
    ),
    (
        &["load", "normal_load", "normal_force"],
        &["motion.normal.mean"],
    ),
    (&["n"], &["numerics.points"]),
];

/// What is said of a key beside its name where it was meant by another.
const MORE: &[(&str, &str)] = &[
    ("wear.coefficient", " (per friction work)"),
    (
        "wear.coefficient_per_load",
        " (per load and distance, of a pin test)",
    ),
    ("motion.normal.mean", " with control = \"force\""),
];

/// The keys that the unknown `path` most likely stands for, none if there is nothing near.
pub(super) fn meant(path: &str) -> Vec<String> {
    let (section, key) = split(path);
    let word = key.to_lowercase();
    let in_motion = section.starts_with("motion.") && is_section(section);
    match word.as_str() {
        "omega" | "w" if in_motion => return vec![format!("{section}.angular_frequency")],
        "f" | "freq" | "hz" if in_motion => return vec![format!("{section}.frequency")],
        _ => {}
    }
    let known = MEANT
        .iter()
        .find(|(words, _)| words.contains(&word.as_str()));
    match known {
        Some((_, keys)) => keys.iter().map(|key| (*key).to_owned()).collect(),
        None => nearest(path, places().into_iter())
            .into_iter()
            .map(str::to_owned)
            .collect(),
    }
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
    let meant = meant(path);
    if !meant.is_empty() {
        // A slip of the pen needs no remark.
        let word = split(path).1.to_lowercase();
        let is_other_word = MEANT
            .iter()
            .any(|(words, _)| words.contains(&word.as_str()));
        let more = |key: &str| {
            MORE.iter()
                .find(|(known, _)| *known == key && is_other_word)
        };
        let told = meant.iter().map(|key| match more(key) {
            Some((_, more)) => format!("{key}{more}"),
            None => key.clone(),
        });
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
