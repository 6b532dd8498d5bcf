//! What there is to know about a key of a scenario, and how keys are looked up. The keys themselves
//! stand in one table, [`PARAMETERS`], which feeds the checks, the edit form and the docs.

use super::nearest::nearest;
pub use super::table::PARAMETERS;
pub(super) use super::table::SHAPES;

/// What a value looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A finite number.
    Number,
    /// A whole number.
    Whole,
    /// `true` or `false`.
    Flag,
    /// Any text.
    Text,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// A list of finite numbers.
    Numbers,
}

impl Kind {
    /// What must stand there, after "must be".
    pub fn wanted(self) -> String {
        match self {
            Self::Number => "a finite number".into(),
            Self::Whole => "a whole number".into(),
            Self::Flag => "true or false".into(),
            Self::Text => "a text".into(),
            Self::Choice([only]) => format!("\"{only}\""),
            Self::Choice(words) => {
                let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
                format!("one of {}", words.join(", "))
            }
            Self::Numbers => "a list of finite numbers".into(),
        }
    }
}

/// One key of a scenario.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parameter {
    /// The dotted path, as `--set` takes it.
    pub path: &'static str,
    /// The unit, or nothing for a pure number or a word.
    pub unit: &'static str,
    /// What it means, in one line.
    pub meaning: &'static str,
    /// What its value looks like.
    pub kind: Kind,
    /// The values that are allowed, after "must be"; empty where the kind says it all.
    pub range: &'static str,
    /// The indenter shapes that take the key; empty where the shape does not matter.
    pub shapes: &'static [&'static str],
}

impl Parameter {
    /// The table the key stands in: everything before the last dot.
    pub fn section(&self) -> &'static str {
        split(self.path).0
    }

    /// The key within its table: everything after the last dot.
    pub fn key(&self) -> &'static str {
        split(self.path).1
    }

    /// What it means, with the unit.
    pub fn described(&self) -> String {
        let range = match self.kind {
            Kind::Choice(_) => format!(", {}", self.kind.wanted()),
            _ => String::new(),
        };
        match self.unit {
            "" => format!("{}{range}", self.meaning),
            unit => format!("{}, {unit}", self.meaning),
        }
    }

    /// The rule that a value of the wrong kind breaks.
    pub(super) fn rule(&self) -> String {
        let range = match (self.kind, self.range) {
            (_, "") => String::new(),
            (Kind::Number | Kind::Whole, range) => format!(" {range}"),
            (_, range) => format!(", {range}"),
        };
        format!("must be {}{range}", self.kind.wanted())
    }
}

/// Splits a dotted path into its table and its key.
pub(super) fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('.').unwrap_or(("", path))
}

/// The parameter with this dotted path.
pub fn find(path: &str) -> Option<&'static Parameter> {
    PARAMETERS.iter().find(|parameter| parameter.path == path)
}

/// Whether `path` is a table that holds parameters, directly or in tables of its own.
pub(super) fn is_section(path: &str) -> bool {
    PARAMETERS.iter().any(|parameter| {
        let rest = parameter.path.strip_prefix(path);
        rest.is_some_and(|rest| rest.starts_with('.'))
    })
}

/// What to write instead of the unknown `path`.
pub(super) fn hint(path: &str) -> String {
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
    if let Some(near) = nearest(path, known.iter().copied()) {
        return format!("did you mean {near}?");
    }
    let section = split(path).0;
    let section = if is_section(section) { section } else { "" };
    let keys: Vec<&str> = known
        .into_iter()
        .filter(|key| split(key).0 == section)
        .collect();
    format!("known are {}", keys.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::abel::AbelMethod;
    use crate::math::grid::{MAX_CELLS, MIN_CELLS};
    use crate::scenario::table::{METHODS, SCHEMES, SPACINGS, STABILITIES};
    use crate::simulation::{Scheme, Spacing, Stability};

    #[test]
    fn every_key_says_what_it_means_and_stands_once() {
        for (i, parameter) in PARAMETERS.iter().enumerate() {
            assert!(!parameter.meaning.is_empty(), "{}", parameter.path);
            assert!(
                PARAMETERS[..i]
                    .iter()
                    .all(|other| other.path != parameter.path),
                "{} stands twice",
                parameter.path
            );
            assert!(parameter.shapes.iter().all(|shape| SHAPES.contains(shape)));
        }
    }

    #[test]
    fn the_table_says_what_the_floors_below_hold() {
        assert_eq!(AbelMethod::ALL.map(AbelMethod::name), METHODS);
        assert_eq!(Spacing::ALL.map(Spacing::name), SPACINGS);
        assert_eq!(Scheme::ALL.map(Scheme::name), SCHEMES);
        assert_eq!(Stability::ALL.map(Stability::name), STABILITIES);
        let points = find("numerics.points").expect("a parameter");
        assert_eq!(points.range, format!("from {MIN_CELLS} to {MAX_CELLS}"));
    }

    #[test]
    fn unknown_keys_are_led_to_the_nearest() {
        for (typed, near) in [
            ("numerics.pointz", "numerics.points"),
            ("points", "numerics.points"),
            ("numerics.steps", "numerics.steps_per_cycle"),
            ("motion.normal.frequency", "motion.normal.angular_frequency"),
            ("frictoin", "friction"),
            ("material.friction", "friction"),
            ("motion.tangental", "motion.tangential"),
            ("indenter.raduis", "indenter.radius"),
            ("youngs_modulus", "material.indenter.youngs_modulus"),
        ] {
            assert_eq!(hint(typed), format!("did you mean {near}?"), "{typed}");
        }
        assert!(hint("wear.k").starts_with("known are wear.law, wear.coefficient"));
        assert!(hint("zzz").starts_with("known are title, description, indenter"));
    }
}
