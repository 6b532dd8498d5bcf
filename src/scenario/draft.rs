//! A scenario being put together: what was given, as it was given, on top of a [`Spec`].

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use toml::{Table, Value as Raw};

use super::blocks;
use super::change::{MOST_CHANGES, Planned, parsed};
use super::columns::Columns;
use super::embed::named_file;
use super::error::Refusal;
use super::escape::echo;
use super::fault::Faults;
use super::hint::{meant, unknown_key};
use super::key::{Embedded, Key, SCHEMA, is_section, join};
use super::spec::{ControlWord, Passage, Spec};
use super::value::{Value, show};

/// A scenario being put together.
pub(super) struct Draft {
    pub spec: Spec,
    pub faults: Faults,
    /// The name of the text.
    pub origin: String,
    /// Base directory of the files that are named.
    pub directory: PathBuf,
    /// Values as given, by the paths of their keys.
    given: BTreeMap<&'static str, Raw>,
    /// `[[changes]]` and `[[blocks]]`, as given.
    lists: Table,
}

impl Draft {
    /// Begins on top of a spec, whose values count as given.
    pub fn on(spec: Spec, origin: &str, directory: &Path) -> Self {
        Self {
            spec,
            faults: Faults::new(origin),
            origin: origin.to_owned(),
            directory: directory.to_owned(),
            given: BTreeMap::new(),
            lists: Table::new(),
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
            let (path, shown) = (join(path, &name), join(shown, &echo(&name)));
            if let Some(key) = Key::find(&path) {
                self.given.insert(key.path, raw);
            } else if !is_section(&path) {
                self.unknown(&path, &shown);
            } else if let Raw::Table(inner) = raw {
                self.spec.open(&path);
                self.walk(inner, &path, &shown);
            } else {
                let rule = format!("must be a table, [{path}]");
                self.faults.refuse_value(&shown, &show(&raw), rule);
            }
        }
    }

    /// Notes an unknown key. The key that was meant does not count as missing as well.
    fn unknown(&mut self, path: &str, shown: &str) {
        let is_reported = !self.faults.is_full();
        self.faults.note(shown, |of| {
            Refusal::new(&of.origin, unknown_key(path, shown))
        });
        let meant = is_reported.then(|| meant(path)).into_iter().flatten();
        meant.for_each(|(meant, _)| self.faults.cover(meant));
    }

    /// Adds an assignment, `written` as the user wrote it; `text` is TOML or a bare word.
    pub fn assign(&mut self, key: &str, text: &str, written: &str) -> Result<(), Refusal> {
        let key = Key::named(key, written)?;
        self.put(key, parsed(key, text), written);
        Ok(())
    }

    /// Adds a value, in place of what it excludes.
    pub fn put(&mut self, key: Key, raw: Raw, written: &str) {
        match key.path {
            "indenter.shape" => self.drop_keys_of_other_shapes(&raw),
            "numerics.accuracy" if self.faults.assigned("numerics.integrator").is_none() => {
                // An accuracy chooses how cycles are gone through, unless that is given with it.
                let numerics = &mut self.spec.numerics;
                let direct = Some(Passage::Direct);
                numerics.integrator = numerics
                    .integrator
                    .filter(|_| numerics.accuracy.is_some() || numerics.integrator != direct);
            }
            _ => {}
        }
        key.displaces().for_each(|other| self.remove(other));
        self.faults.assign(key.path, written);
        self.given.insert(key.path, raw);
    }

    fn remove(&mut self, key: Key) {
        self.given.remove(key.path);
        self.spec.clear(key);
    }

    /// Returns the word of a key given here or before.
    fn word(&self, path: &str) -> Option<&str> {
        match self.given.get(path) {
            Some(raw) => raw.as_str(),
            None => match self.spec.get(Key::known(path))? {
                Value::Word(word) => Some(word),
                _ => None,
            },
        }
    }

    /// Whether the motion of a key prescribes a force.
    pub fn is_force(&self, key: Key) -> bool {
        let control = join(key.section(), "control");
        let is_motion = Key::find(&control).is_some();
        is_motion && self.word(&control) == Some(ControlWord::Force.into())
    }

    /// Drops the keys of the shape before, which would be refused or misread. Keys of both shapes stay if they are
    /// assigned together with the shape.
    fn drop_keys_of_other_shapes(&mut self, shape: &Raw) {
        let words = Key::known("indenter.shape")
            .kind
            .words()
            .unwrap_or_default();
        let Some(shape) = shape.as_str().filter(|shape| words.contains(shape)) else {
            return;
        };
        let is_punch = |shape: &str| shape == "flat-punch";
        let was_punch = self.word("indenter.shape").is_some_and(is_punch);
        for key in
            Key::all().filter(|key| key.shapes().is_some_and(|shapes| !shapes.contains(&shape)))
        {
            self.remove(key);
        }
        for (path, is_stale) in [
            ("indenter.radius", was_punch != is_punch(shape)),
            ("numerics.domain_radius", is_punch(shape)),
        ] {
            if is_stale && self.faults.assigned(path).is_none() {
                self.remove(Key::known(path));
            }
        }
    }

    /// Reads all that was given, and notes what is wrong in it. Returns the changes, and what was left out of files, a
    /// line each.
    ///
    /// # Errors
    ///
    /// What cannot be read at all: `[[blocks]]`, or a file.
    pub fn finish(&mut self) -> Result<(Vec<Planned>, Vec<String>), Refusal> {
        let mut changes = self.expand_blocks()?;
        let notes = self.read_files()?;
        changes.extend(self.read_changes());
        let mut keys: Vec<Key> = Key::all().collect();
        keys.sort_by_key(|key| key.path);
        for key in keys {
            if let Some(raw) = self.given.remove(key.path) {
                self.read_value(key, raw);
            } else if let Some(Err(rule)) = self.spec.get(key).map(|value| value.check(key)) {
                self.refuse(key, rule);
            }
        }
        Ok((changes, notes))
    }

    /// Refuses the value of a key, which counts as given, not as missing; its table was meant, too.
    fn refuse(&mut self, key: Key, rule: String) {
        self.faults.refuse::<()>(&self.spec, key.path, rule);
        self.spec.put(key, None);
    }

    /// Reads the value of a key.
    fn read_value(&mut self, key: Key, mut raw: Raw) {
        let read = Value::read(&mut raw, key, self.is_force(key));
        self.faults.give(key, raw);
        match read {
            Ok(value) => self.spec.put(key, Some(value)),
            Err(rule) => self.refuse(key, rule),
        }
    }

    /// Puts the first of `[[blocks]]` in its place, and returns the changes of the others.
    fn expand_blocks(&mut self) -> Result<Vec<Planned>, Refusal> {
        let Some(raw) = self.lists.remove("blocks") else {
            return Ok(Vec::new());
        };
        let blocks = blocks::expand(&raw, self.lists.get("changes"), &self.faults)?;
        self.walk(blocks.first, "", "");
        let (key, cycles) = (Key::known("run.cycles"), blocks.cycles);
        if self.spec.get(key).is_none() {
            self.given.entry(key.path).or_insert(cycles.into());
        }
        let mut changes = Vec::new();
        for (at_cycle, path, raw, place) in blocks.changes {
            match Planned::new(at_cycle, &path, |_| raw, place.clone()) {
                Ok(planned) => changes.push(planned),
                Err(error) => self.faults.note(&place, |_| error),
            }
        }
        Ok(changes)
    }

    /// Puts the columns of the files that are named in their place.
    fn read_files(&mut self) -> Result<Vec<String>, Refusal> {
        let mut notes = Vec::new();
        for Embedded { key, lists } in &SCHEMA.files {
            let is_name = |raw: &Raw| raw.is_str() || raw.is_table();
            let given = self.given.get(key).filter(|raw| is_name(raw)).cloned();
            let Some(value) = given else {
                continue;
            };
            self.given.remove(key);
            let place = self.faults.place(key, &show(&value));
            let (file, naming) = named_file(key, &value).ok_or_else(|| {
                let example = "{ file = \"tip.csv\", fields = \"r=2,f=3\", units = \"um,nm\" }";
                let rule = format!("must be the path of a file, or as in {example}");
                Refusal::new(&place, rule)
            })?;
            let columns = Columns::read_as(&self.directory.join(file), &naming)?;
            let found = lists.each_ref().map(|lists| {
                let there = lists.iter().find(|(_, name)| columns.has(name));
                there.unwrap_or(&lists[0])
            });
            let (numbers, rows) = columns.whole_rows(found.map(|(_, name)| *name))?;
            let left_out = columns.left_out(&rows);
            notes.extend(left_out.map(|note| format!("{}: {note}", columns.path)));
            for ((path, _), numbers) in found.into_iter().zip(numbers) {
                self.faults.assign(path, &place);
                self.given.insert(path, numbers.into());
            }
        }
        Ok(notes)
    }

    /// Reads `[[changes]]`: an array of tables, each with both of its keys.
    fn read_changes(&mut self) -> Vec<Planned> {
        let raw = self.lists.remove("changes");
        let raw = raw.unwrap_or(Raw::Array(Vec::new()));
        let rule = "must be an array of tables, [[changes]] with at_cycle and set";
        let Raw::Array(list) = raw else {
            self.faults.refuse_value("changes", &show(&raw), rule);
            return Vec::new();
        };
        if list.len() > MOST_CHANGES {
            let rule = format!("must have at most {MOST_CHANGES} entries");
            self.faults
                .refuse_value("changes", &list.len().to_string(), rule);
            return Vec::new();
        }
        let mut changes = Vec::new();
        for (i, entry) in list.into_iter().enumerate() {
            let at = format!("changes[{i}]");
            match entry {
                Raw::Table(table) => changes.extend(self.read_change(&at, table)),
                other => self.faults.refuse_value(&at, &show(&other), rule),
            }
        }
        changes
    }

    fn read_change(&mut self, at: &str, mut table: Table) -> Option<Planned> {
        let given = ["at_cycle", "set"].map(|name| (name, table.remove(name)));
        for name in table.keys() {
            self.unknown(&join("changes", name), &join(at, &echo(name)));
        }
        let [cycle, set] = given.map(|(name, raw)| {
            let (key, shown) = (Key::known(&join("changes", name)), join(at, name));
            let Some(mut raw) = raw else {
                if !self.faults.covers(key.path) {
                    self.faults.missing::<()>(&shown, key.described());
                }
                return None;
            };
            let value = Value::read(&mut raw, key, false);
            let refused = |rule| self.faults.refuse_value(&shown, &show(&raw), rule);
            value.map_err(refused).ok()
        });
        let (Value::Number(at_cycle), Value::Text(set)) = (cycle?, set?) else {
            return None;
        };
        let shown = format!("\"{}\"", echo(&set));
        let place = self.faults.place(&join(at, "set"), &shown);
        let planned = Planned::read(at_cycle, &set, place.clone());
        let refused = |error| self.faults.note(&place, |_| error);
        planned.map_err(refused).ok()
    }
}
