//! A scenario being put together: what was given, as it was given, on top of a [`Spec`].

use std::path::Path;

use toml::{Table, Value as Raw};

use super::columns::Columns;
use super::embed::named_file;
use super::error::{Faults, Origin, Refusal};
use super::escape::echo;
use super::schema::{self, Kind, Parameter};
use super::spec::{Control, NORMAL, Spec, TANGENTIAL};
use super::value::Value;
use super::values::{self, show};
use super::{blocks, hints};

/// One value as given.
struct Given {
    key: &'static Parameter,
    raw: Raw,
}

/// A scenario being put together.
pub(super) struct Draft {
    spec: Spec,
    given: Vec<Given>,
    /// `[[changes]]` and `[[blocks]]`, as given.
    lists: Table,
    pub origin: Origin,
    faults: Faults,
}

/// What a draft has become.
pub(super) struct Read {
    pub spec: Spec,
    pub origin: Origin,
    pub faults: Faults,
    /// `[[changes]]`: the cycle and the text of each.
    pub changes: Vec<(f64, String)>,
    /// Rows left out of files.
    pub notes: Vec<String>,
}

impl Draft {
    /// Begins on top of a spec, whose values count as given.
    pub fn new(spec: Spec, origin: &str) -> Self {
        let (origin, faults) = (Origin::new(origin), Faults::default());
        let (given, lists) = (Vec::new(), Table::new());
        Self {
            spec,
            given,
            lists,
            origin,
            faults,
        }
    }

    /// Adds the values of a text.
    pub fn read(&mut self, mut table: Table) {
        for list in ["changes", "blocks"] {
            let found = table.remove(list).map(|raw| (list.to_owned(), raw));
            self.lists.extend(found);
        }
        self.walk(table, "", "");
    }

    /// Adds the values of the table at `path`, called `shown` in messages.
    fn walk(&mut self, table: Table, path: &str, shown: &str) {
        for (name, raw) in table {
            let path = values::join(path, &name);
            let shown = values::join(shown, &echo(&name));
            if let Some(key) = schema::find(&path) {
                self.given.retain(|given| given.key.path != key.path);
                self.given.push(Given { key, raw });
            } else if !schema::is_section(&path) {
                self.unknown(&path, &shown);
            } else if let Raw::Table(inner) = raw {
                self.spec.open(&path);
                self.walk(inner, &path, &shown);
            } else {
                let rule = format!("must be a table, [{path}]");
                self.faults
                    .note(&shown, || self.origin.refuse(&shown, &show(&raw), rule));
            }
        }
    }

    fn unknown(&mut self, path: &str, shown: &str) {
        // The key that was meant does not count as missing as well.
        let meant = if self.faults.is_full() {
            Vec::new()
        } else {
            hints::meant(path)
        };
        self.faults
            .note(shown, || unknown(self.origin.name(), path, shown));
        meant.iter().for_each(|(meant, _)| self.faults.blame(meant));
    }

    /// Adds an assignment, `written` as the user wrote it; it takes the place of what it excludes.
    pub fn assign(&mut self, key: &str, value: &str, written: &str) -> Result<(), Refusal> {
        let refuse = |rule: String| Refusal::new(written, rule);
        if key == "changes" || key.starts_with("changes.") {
            return Err(refuse("changes are recorded during a run, not set".into()));
        }
        match schema::find(key) {
            Some(key) => self.put(key, parsed(key, value), written),
            None if schema::is_section(key) => {
                let known = hints::known_in(key);
                return Err(refuse(format!("{key} is a table; {known}")));
            }
            None => return Err(unknown(written, key, key)),
        }
        Ok(())
    }

    /// Adds a value for a known key.
    pub fn put(&mut self, key: &'static Parameter, raw: Raw, written: &str) {
        match key.path {
            "indenter.shape" => self.drop_keys_of_other_shapes(&raw),
            "numerics.accuracy" if !self.origin.assigns("numerics.integrator") => {
                // An accuracy chooses how cycles are gone through, unless that is given with it.
                let numerics = &mut self.spec.numerics;
                let direct = Some(super::spec::Passage::Direct);
                numerics.integrator = numerics
                    .integrator
                    .filter(|_| numerics.accuracy.is_some() || numerics.integrator != direct);
            }
            _ => {}
        }
        for path in schema::replaced_by(key.path) {
            self.remove(path);
        }
        self.origin.assign(key.path, written);
        self.given.retain(|given| given.key.path != key.path);
        self.given.push(Given { key, raw });
    }

    fn remove(&mut self, path: &str) {
        self.given.retain(|given| given.key.path != path);
        schema::find(path)
            .into_iter()
            .for_each(|key| self.spec.clear(key));
    }

    /// The text of a key given here or before.
    fn word(&self, path: &str) -> Option<String> {
        let given = self.given.iter().find(|given| given.key.path == path);
        let before = || match self.spec.get(schema::known(path))? {
            Value::Word(word) => Some(word.to_owned()),
            _ => None,
        };
        given.map_or_else(before, |given| given.raw.as_str().map(str::to_owned))
    }

    /// Drops the keys of the shape before, which would be refused or misread. Keys of both shapes stay if they are
    /// assigned together with the shape.
    fn drop_keys_of_other_shapes(&mut self, shape: &Raw) {
        let known = schema::known("indenter.shape").kind;
        let Some(shape) = shape.as_str().filter(|_| known.fits(shape)) else {
            return;
        };
        let is_punch = |shape: &str| shape == "flat-punch";
        let was_punch = self
            .word("indenter.shape")
            .is_some_and(|word| is_punch(&word));
        for key in schema::parameters().filter(|key| !key.belongs_to(shape)) {
            self.remove(key.path);
        }
        for (key, is_stale) in [
            ("indenter.radius", was_punch != is_punch(shape)),
            ("numerics.domain_radius", is_punch(shape)),
        ] {
            if is_stale && !self.origin.assigns(key) {
                self.remove(key);
            }
        }
    }

    /// Reads all that was given, and finds what is wrong in it.
    pub fn finish(mut self, directory: &Path) -> Result<Read, Refusal> {
        let blocks = self.lists.remove("blocks");
        if let Some(blocks) = blocks {
            let has_cycles = self
                .given
                .iter()
                .any(|given| given.key.path == "run.cycles")
                || self.spec.run.cycles.is_some();
            let (first, changes, cycles) =
                blocks::expand(&blocks, self.lists.get("changes"), &self.origin)?;
            self.lists.insert("changes".into(), changes);
            self.walk(first, "", "");
            if !has_cycles {
                let (key, raw) = (schema::known("run.cycles"), Raw::Float(cycles));
                self.given.push(Given { key, raw });
            }
        }
        let notes = self.read_files(directory)?;
        self.given.sort_by_key(|given| given.key.path);
        let force = [NORMAL, TANGENTIAL].map(|section| {
            let word = self.word(&values::join(section, "control"));
            word.as_deref() == Some(Control::Force.into())
        });
        let changes = self.read_changes();
        for Given { key, mut raw } in std::mem::take(&mut self.given) {
            let is_force = force[usize::from(key.section() == TANGENTIAL)];
            // A wrong value says, too, that its table was meant.
            self.spec.open(key.section());
            match Value::read(&mut raw, key, is_force) {
                Ok(value) => self.spec.put(key, value),
                Err(rule) => {
                    // A value that is wrong counts as given, not as missing.
                    self.spec.clear(key);
                    self.faults
                        .note(key.path, || self.origin.refuse(key.path, &show(&raw), rule));
                }
            }
            self.origin.show(key.path, raw);
        }
        for key in schema::parameters() {
            if let Some(Err(rule)) = self.spec.get(key).map(|value| value.check(key)) {
                let value = self
                    .spec
                    .get(key)
                    .map(|value| value.literal())
                    .unwrap_or_default();
                self.faults.note(key.path, || {
                    self.origin.refuse(key.path, &echo(&value), rule)
                });
            }
        }
        let Self {
            spec,
            origin,
            faults,
            ..
        } = self;
        Ok(Read {
            spec,
            origin,
            faults,
            changes,
            notes,
        })
    }

    /// Puts the columns of the files that are named in their place.
    fn read_files(&mut self, directory: &Path) -> Result<Vec<String>, Refusal> {
        let mut notes = Vec::new();
        for schema::Embedded { key, lists } in &schema::SCHEMA.files {
            let is_named = |given: &Given| {
                given.key.path == *key && matches!(given.raw, Raw::String(_) | Raw::Table(_))
            };
            let Some(at) = self.given.iter().position(is_named) else {
                continue;
            };
            let value = self.given.swap_remove(at).raw;
            let place = self.origin.place(key, &show(&value));
            let (file, naming) = named_file(key, &value).ok_or_else(|| {
                let example = "{ file = \"tip.csv\", fields = \"r=2,f=3\", units = \"um,nm\" }";
                let rule = format!("must be the path of a file, or as in {example}");
                self.origin.refuse(key, &show(&value), rule)
            })?;
            let columns = Columns::read_as(&directory.join(file), &naming)?;
            let found = lists.each_ref().map(|lists| {
                let there = lists.iter().find(|(_, name)| columns.has(name));
                there.unwrap_or(&lists[0])
            });
            let (numbers, rows) = columns.whole_rows(found.map(|(_, name)| *name))?;
            let left_out = columns.left_out(&rows);
            notes.extend(left_out.map(|note| format!("{}: {note}", columns.path)));
            for ((path, _), numbers) in found.into_iter().zip(numbers) {
                self.remove(path);
                self.origin.assign(path, &place);
                self.given.push(Given {
                    key: schema::known(path),
                    raw: numbers.into(),
                });
            }
        }
        Ok(notes)
    }

    /// Reads `[[changes]]`: an array of tables, each with both of its keys.
    fn read_changes(&mut self) -> Vec<(f64, String)> {
        let Some(raw) = self.lists.remove("changes") else {
            return Vec::new();
        };
        let refuse = |origin: &Origin, shown: &str, raw: &Raw| {
            let rule = "must be an array of tables, [[changes]] with at_cycle and set";
            origin.refuse(shown, &show(raw), rule)
        };
        let Raw::Array(list) = raw else {
            self.faults
                .note("changes", || refuse(&self.origin, "changes", &raw));
            return Vec::new();
        };
        let mut changes = Vec::new();
        for (i, entry) in list.into_iter().enumerate() {
            let at = format!("changes[{i}]");
            let Raw::Table(mut table) = entry else {
                self.faults.note(&at, || refuse(&self.origin, &at, &entry));
                continue;
            };
            let found = ["at_cycle", "set"].map(|name| {
                let key = schema::known(&values::join("changes", name));
                let (shown, raw) = (values::join(&at, name), table.remove(name));
                Some((key, shown, raw))
            });
            for name in table.keys() {
                self.unknown(
                    &values::join("changes", name),
                    &values::join(&at, &echo(name)),
                );
            }
            let mut of = |found: Option<(&'static Parameter, String, Option<Raw>)>| {
                let (key, shown, raw) = found?;
                let Some(mut raw) = raw else {
                    if !self.faults.covers(key.path) {
                        self.faults
                            .note(&shown, || self.origin.missing(&shown, key.described()));
                    }
                    return None;
                };
                let value = Value::read(&mut raw, key, false);
                value
                    .map_err(|rule| {
                        self.faults
                            .note(&shown, || self.origin.refuse(&shown, &show(&raw), rule))
                    })
                    .ok()
            };
            let [cycle, set] = found.map(&mut of);
            if let (Some(Value::Number(cycle)), Some(Value::Text(set))) = (cycle, set) {
                changes.push((cycle, set));
            }
        }
        changes
    }
}

/// Parses the value of an assignment as TOML, or takes the bare text.
fn parsed(key: &Parameter, text: &str) -> Raw {
    if key.kind == Kind::Number && values::is_large_whole(text) {
        let number = text.parse();
        return number.map_or_else(|_| Raw::String(text.to_owned()), Raw::Float);
    }
    match (key.kind, text.parse::<Raw>()) {
        (Kind::Text | Kind::Choice(_), Ok(Raw::String(text))) => Raw::String(text),
        (Kind::Text | Kind::Choice(_), _) | (_, Err(_)) => Raw::String(text.to_owned()),
        (_, Ok(raw)) => raw,
    }
}

/// Splits `KEY=VALUE`, found at `place`.
pub(crate) fn split<'a>(text: &'a str, place: &str) -> Result<(&'a str, &'a str), Refusal> {
    let (key, value) = text.split_once('=').unwrap_or_default();
    let (key, value) = (key.trim(), value.trim());
    let rule = "must be KEY=VALUE, as in numerics.points=400";
    let whole = (!key.is_empty() && !value.is_empty()).then_some((key, value));
    whole.ok_or_else(|| Refusal::new(place, rule))
}

/// Builds the error for an unknown key at `place`.
fn unknown(place: &str, path: &str, shown: &str) -> Refusal {
    let rule = format!("unknown key {}; {}", echo(shown), hints::hint(path));
    Refusal::new(place, rule)
}

/// Formats an assignment for an error message.
pub(super) fn written(key: &str, value: &str) -> String {
    format!("{} = {}", echo(key), echo(value))
}
