//! Suggestions for unknown keys and words: the one probably meant, or all that exist.

use std::collections::HashSet;

use toml::Value;

use super::nearest::nearest;
use super::schema::{Kind, Parameter, is_section, parameters};
use super::values::split;

/// Why there is no bulk stress, which users of fatigue rigs look for.
const NO_BULK_STRESS: &str = "a bulk stress moves the stick zone off the centre, and this model is symmetric: \
                              see mdr-tui guide lines";

/// The keys that the unknown `path` most likely stands for, each with a remark to show beside its name; none if there
/// is nothing near.
pub(super) fn meant(path: &str) -> Vec<(&'static str, &'static str)> {
    let (section, key) = split(path);
    let word = key.to_lowercase();
    let known = parameters().filter(|known| known.also.contains(&word.as_str()));
    let mut known: Vec<&Parameter> = known.collect();
    // A word for keys of several tables only stands for the key of the same table.
    let sections: HashSet<&str> = known.iter().map(|known| known.section()).collect();
    if sections.len() > 1 {
        known.retain(|known| known.section() == section);
    }
    if known.is_empty() {
        let near = nearest(path, places().into_iter());
        return near.map(|key| (key, "")).into_iter().collect();
    }
    let told = known.iter().map(|known| (known.path, known.remark));
    told.collect()
}

/// All keys and tables.
fn places() -> Vec<&'static str> {
    let all = parameters().flat_map(|Parameter { path, .. }| {
        let tables = path.match_indices('.').map(|(at, _)| &path[..at]);
        tables.chain([*path])
    });
    let mut seen = HashSet::new();
    all.filter(|place| seen.insert(*place)).collect()
}

/// Returns a hint for the unknown `path`.
pub fn hint(path: &str) -> String {
    if path.contains("bulk") && !path.contains("modulus") {
        return NO_BULK_STRESS.to_owned();
    }
    let meant = meant(path);
    if !meant.is_empty() {
        let told = meant.iter().map(|(key, more)| format!("{key}{more}"));
        return format!("did you mean {}?", told.collect::<Vec<_>>().join(" or "));
    }
    known_in(split(path).0)
}

/// Lists the keys and sub-tables of a table, or of the whole scenario if the table does not exist.
pub(super) fn known_in(section: &str) -> String {
    let section = if is_section(section) { section } else { "" };
    let keys = places().into_iter().filter(|key| split(key).0 == section);
    format!("known are {}", keys.collect::<Vec<_>>().join(", "))
}

/// Returns a remark for a `value` that is not among a key's words: the word probably meant, if there is one.
pub(super) fn suggest(parameter: &Parameter, value: &Value) -> String {
    let (Kind::Choice(words), Some(given)) = (parameter.kind, value.as_str()) else {
        return String::new();
    };
    let typed = given.to_lowercase();
    let known = words
        .iter()
        .find(|known| known.also.contains(&typed.as_str()));
    let near = || nearest(&typed, words.iter().map(|known| known.word));
    let meant = known.map(|known| known.word).or_else(near);
    meant.map_or_else(String::new, |meant| format!("; did you mean \"{meant}\"?"))
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
        for bulk in ["motion.bulk_stress", "material.half_space.bulk"] {
            assert_eq!(hint(bulk), NO_BULK_STRESS);
        }
        assert!(hint("wear.zzz").starts_with("known are wear.law, wear.coefficient"));
        assert!(hint("zzz").starts_with("known are title, description, indenter"));
    }
}
