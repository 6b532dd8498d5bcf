//! The errors of a scenario, and what the user wrote where, so that messages show it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;

use super::error::{MOST_ERRORS, Refusal};
use super::escape::{echo, printable};
use super::key::{Key, Kind, join};
use super::spec::Spec;
use super::value::show;
use crate::math::invalid::{Invalid, Unmade};

/// The errors of a scenario.
#[derive(Debug, Default)]
pub(super) struct Faults {
    /// The name of the text, printable on one line.
    pub origin: String,
    /// Assignments as written, by their paths.
    written: BTreeMap<String, String>,
    /// Values as they were given, by their paths.
    given: BTreeMap<&'static str, toml::Value>,
    errors: Vec<Refusal>,
    /// Number of errors beyond the reported ones.
    more: usize,
    /// Paths that an error is about.
    covered: BTreeSet<String>,
}

impl Faults {
    /// Begins without errors.
    pub fn new(origin: &str) -> Self {
        Self {
            origin: printable(origin),
            ..Self::default()
        }
    }

    /// Remembers that `path` was assigned as `written`.
    pub fn assign(&mut self, path: &str, written: &str) {
        self.written.insert(path.to_owned(), written.to_owned());
    }

    /// Returns the assignment of `path` as written, if there was one.
    pub fn assigned(&self, path: &str) -> Option<&str> {
        self.written.get(path).map(String::as_str)
    }

    /// Remembers a value as it was given.
    pub fn give(&mut self, key: Key, raw: toml::Value) {
        self.given.insert(key.path, raw);
    }

    /// Returns the place of a value: the assignment that gave it, or the origin with the path, and the value if there is
    /// one.
    pub fn place(&self, path: &str, value: &str) -> String {
        let origin = &self.origin;
        match self.assigned(path) {
            Some(written) => written.to_owned(),
            None if value.is_empty() => format!("{origin}: {path}"),
            None => format!("{origin}: {path} = {value}"),
        }
    }

    /// Notes an error about `path`, if it is the first. Errors beyond the maximum are only counted.
    pub fn note(&mut self, path: &str, error: impl FnOnce(&Self) -> Refusal) {
        if !self.covered.insert(path.to_owned()) {
        } else if self.is_full() {
            self.more += 1;
        } else {
            let error = error(self);
            self.errors.push(error);
        }
    }

    /// Notes that `value`, given at `path`, breaks a rule.
    pub fn refuse_value(&mut self, path: &str, value: &str, rule: impl Display) {
        self.note(path, |of| Refusal::new(of.place(path, value), rule));
    }

    /// Refuses the value of a key, quoting it as given, or else as `spec` has it.
    pub fn refuse<T>(&mut self, spec: &Spec, path: &str, rule: impl Display) -> Option<T> {
        self.refuse_or(spec, path, None, rule)
    }

    /// The same for a key that may have no value, where `derived` takes its place.
    fn refuse_or<T>(
        &mut self,
        spec: &Spec,
        path: &str,
        derived: Option<String>,
        rule: impl Display,
    ) -> Option<T> {
        let given = self.given.get(path).map(show);
        let of = |spec: &Spec| Some(echo(&spec.get(Key::find(path)?)?.literal()));
        let shown = given.or_else(|| of(spec)).or(derived);
        let shown = shown.or_else(|| of(Spec::usual())).unwrap_or_default();
        self.refuse_value(path, &shown, rule);
        None
    }

    /// Passes what a constructor made of keys of a section, or notes which value it refuses.
    pub fn accept<T>(&mut self, spec: &Spec, section: &str, made: Result<T, Invalid>) -> Option<T> {
        match made {
            Ok(made) => Some(made),
            Err(Invalid { field, value, rule }) => {
                self.refuse_or(spec, &join(section, field), Some(value), rule)
            }
        }
    }

    /// Passes what was made of the keys of a section, or notes what is missing or refused. A list comes from the file
    /// that a key of the section names.
    pub fn make<T>(&mut self, spec: &Spec, section: &str, made: Result<T, Unmade>) -> Option<T> {
        let made = match made {
            Ok(made) => Ok(made),
            Err(Unmade::Invalid(invalid)) => Err(invalid),
            Err(Unmade::Missing(key)) => {
                let path = join(section, key);
                return match Key::known(&path).kind {
                    Kind::Numbers if self.covers(&path) => None,
                    Kind::Numbers => self.need(&join(section, "file"), None),
                    _ => self.need(&path, None),
                };
            }
        };
        self.accept(spec, section, made)
    }

    /// Passes the value of a key, or notes that it is missing.
    pub fn need<T>(&mut self, path: &str, value: Option<T>) -> Option<T> {
        let value = value.filter(|_| !self.covers(path));
        value.or_else(|| self.missing(path, Key::known(path).described()))
    }

    /// Notes that the key at `path`, which means `meaning`, is missing, unless an error is about it already.
    pub fn missing<T>(&mut self, path: &str, meaning: impl Display) -> Option<T> {
        if !self.covers(path) {
            self.note(path, |of| Refusal::missing(&of.origin, path, meaning));
        }
        None
    }

    /// Whether the maximum number of errors is reached.
    pub fn is_full(&self) -> bool {
        self.errors.len() >= MOST_ERRORS
    }

    /// Lets an error be about `path` as well.
    pub fn cover(&mut self, path: &str) {
        self.covered.insert(path.to_owned());
    }

    /// Whether an error is about the key at `path` or a table that contains it.
    pub fn covers(&self, path: &str) -> bool {
        let tables = path.match_indices('.').map(|(end, _)| &path[..end]);
        tables.chain([path]).any(|path| self.covered.contains(path))
    }

    /// Passes what was made if there are no errors, or returns all of them as one.
    pub fn result<T>(mut self, made: Option<T>) -> Result<T, Refusal> {
        if self.more > 0 {
            // The last line gives the number of errors left out.
            let more = self.more + self.errors.split_off(MOST_ERRORS - 1).len();
            self.errors.push(format!("and {more} more errors").into());
        }
        match Refusal::all(self.errors) {
            Some(errors) => Err(errors),
            None => Ok(made.expect("what cannot be made has noted why")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_assignment_hides_the_place_in_the_text() {
        let mut faults = Faults::new("a.toml");
        assert_eq!(faults.place("x.y", "1"), "a.toml: x.y = 1");
        assert_eq!(faults.place("x.y", ""), "a.toml: x.y");
        faults.assign("x.y", "--set x.y=2");
        assert_eq!(faults.place("x.y", "2"), "--set x.y=2");
    }
}
