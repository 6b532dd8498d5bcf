//! Suggestions for unknown names, keys and words: the one probably meant, or all that exist.

use std::collections::HashSet;

use strsim::normalized_damerau_levenshtein as likeness;

use super::error::Refusal;
use super::escape::echo;
use super::key::{Key, Kind, is_section, split};

/// Why there is no bulk stress, which users of fatigue rigs look for.
const NO_BULK_STRESS: &str = "a bulk stress moves the stick zone off the centre, and this model is symmetric: \
                              see mdr-tui guide lines";

/// Names less alike than this are considered unrelated.
const LIKELY: f64 = 0.5;

/// Maximum length of a mistyped name, in bytes.
const LONGEST: usize = 200;

/// Returns the name among `known` that `typed` most likely stands for; the tables of dotted paths count too.
pub fn nearest<'a>(typed: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    // The time of a comparison grows with both lengths.
    let known = known.filter(|_| typed.len() <= LONGEST);
    let scored = known.map(|known| (score(typed, known), known));
    let likely = scored.filter(|(score, _)| *score > LIKELY);
    let best = likely.reduce(|best, next| if next.0 > best.0 { next } else { best });
    best.map(|(_, known)| known)
}

/// Returns a hint for a mistyped name: the known name most likely meant, or all of them.
pub fn hint<'a>(typed: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    match nearest(typed, known.clone()) {
        Some(near) => format!("did you mean {near}?"),
        None => format!("known are {}", known.collect::<Vec<_>>().join(", ")),
    }
}

fn score(typed: &str, known: &str) -> f64 {
    let ((table, key), (known_table, known_key)) = (split(typed), split(known));
    if table == known_table {
        let begins = key.len() > 2 && (known_key.starts_with(key) || known_key.ends_with(key));
        likeness(key, known_key).max(if begins { 0.8 } else { 0.0 })
    } else if key == known_key {
        0.8 + 0.1 * likeness(table, known_table)
    } else {
        // Another table is another subject, so the whole path must be close.
        let whole = likeness(typed, known);
        if whole > 0.75 { whole - 0.05 } else { 0.0 }
    }
}

/// Returns the keys that the unknown `path` most likely stands for, each with a remark to show next to its name; empty
/// if no key is similar.
pub(super) fn meant(path: &str) -> Vec<(&'static str, &'static str)> {
    let (section, key) = split(path);
    let word = key.to_lowercase();
    let known = Key::all().filter(|known| known.also.contains(&word.as_str()));
    let mut known: Vec<Key> = known.collect();
    // A word for keys of several tables only stands for the key of the same table.
    let sections: HashSet<&str> = known.iter().map(|known| known.section()).collect();
    if sections.len() > 1 {
        known.retain(|known| known.section() == section);
    }
    if known.is_empty() {
        let near = nearest(path, places().into_iter());
        return near.map(|key| (key, "")).into_iter().collect();
    }
    let suggestions = known.iter().map(|known| (known.path, known.remark));
    suggestions.collect()
}

/// All keys and tables.
fn places() -> Vec<&'static str> {
    let all = Key::all().flat_map(|key| {
        let path = key.path;
        let tables = path.match_indices('.').map(|(at, _)| &path[..at]);
        tables.chain([path])
    });
    let mut seen = HashSet::new();
    all.filter(|place| seen.insert(*place)).collect()
}

/// Returns a hint for the unknown key at `path`.
fn key_hint(path: &str) -> String {
    if path.contains("bulk") && !path.contains("modulus") {
        return NO_BULK_STRESS.to_owned();
    }
    let meant = meant(path);
    if !meant.is_empty() {
        let suggestions = meant.iter().map(|(key, more)| format!("{key}{more}"));
        return format!(
            "did you mean {}?",
            suggestions.collect::<Vec<_>>().join(" or ")
        );
    }
    known_in(split(path).0)
}

/// Lists the keys and sub-tables of a table, or of the whole scenario if the table does not exist.
fn known_in(section: &str) -> String {
    let section = if is_section(section) { section } else { "" };
    let keys = places().into_iter().filter(|key| split(key).0 == section);
    format!("known are {}", keys.collect::<Vec<_>>().join(", "))
}

impl Key {
    /// Finds the key that a user gave at `place`.
    ///
    /// # Errors
    ///
    /// An unknown key, with the one probably meant; a table; or `[[changes]]`.
    pub fn named(path: &str, place: &str) -> Result<Self, Refusal> {
        let rule = match Self::find(path) {
            _ if split(path).0 == "changes" || path == "changes" => {
                "changes are recorded during a run, not set".to_owned()
            }
            Some(key) => return Ok(key),
            None if is_section(path) => format!("{path} is a table; {}", known_in(path)),
            None => unknown_key(path, path),
        };
        Err(Refusal::new(place, rule))
    }
}

/// Returns the rule for the unknown key at `path`, called `shown`.
pub(super) fn unknown_key(path: &str, shown: &str) -> String {
    format!("unknown key {}; {}", echo(shown), key_hint(path))
}

/// Returns a remark for a value that is not among a key's words: the word probably meant, if there is one.
pub(super) fn suggest(kind: Kind, given: Option<&str>) -> String {
    let (Kind::Choice(words), Some(given)) = (kind, given) else {
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
            assert_eq!(key_hint(typed), format!("did you mean {near}?"), "{typed}");
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
            assert_eq!(key_hint(typed), format!("did you mean {near}?"), "{typed}");
        }
        for bulk in ["motion.bulk_stress", "material.half_space.bulk"] {
            assert_eq!(key_hint(bulk), NO_BULK_STRESS);
        }
        assert!(key_hint("wear.zzz").starts_with("known are wear.law, wear.coefficient"));
        assert!(key_hint("zzz").starts_with("known are title, description, indenter"));
    }

    #[test]
    fn nothing_near_is_nothing() {
        let known = ["hertz", "mindlin", "li2019-fig3"];
        assert_eq!(nearest("hert", known.into_iter()), Some("hertz"));
        assert_eq!(nearest("fig3", known.into_iter()), Some("li2019-fig3"));
        assert_eq!(nearest("qwop", known.into_iter()), None);
    }
}
