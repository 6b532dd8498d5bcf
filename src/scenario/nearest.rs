//! Finds the known name nearest to a mistyped one.

use strsim::normalized_damerau_levenshtein as likeness;

use super::values::split;

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_near_is_nothing() {
        let known = ["hertz", "mindlin", "li2019-fig3"];
        assert_eq!(nearest("hert", known.into_iter()), Some("hertz"));
        assert_eq!(nearest("fig3", known.into_iter()), Some("li2019-fig3"));
        assert_eq!(nearest("qwop", known.into_iter()), None);
    }
}
