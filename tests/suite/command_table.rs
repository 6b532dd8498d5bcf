//! What commands say and write, held by tables such as `refusals.txt`, one promise a line.
//!
//! - `== heading` begins a section, in a new directory, and `- WORDS` is a remark. `> file` writes a file up to `<`, and
//!   `% file FROM => TO` replaces text that must be there.
//! - `$ LINE` runs the program, which must succeed and print nothing on stderr; `$1 LINE` runs it to that exit code, and
//!   `$* LINE` to any. `NAME=VALUE` before the words set the environment.
//! - `# LINE` is a line of bash, which must succeed; `$BIN` in it is the program.
//! - `= PRESET KEY=VALUE ..` loads a scenario, whose parts are `toml` and `=KEY`, which is `none` where there is no value.
//! - `LINE | TEXT` must be refused with that text in one line, and nothing written (`|+` if other faults are listed with it);
//!   `@ WORDS` stand before such lines.
//! - `? PART VERB TEXT` looks at what the last command has said or at files. Parts are `out`, `err`, `FILE`, `FILE#KEY` (the
//!   value of a header line), `FILE:COLUMN` (its fields, `-` where they are empty), `FILE:COLUMN@ROW` (one of them, from 0,
//!   or from the end by `-1`) and `DIRECTORY/` (the names in it).
//! - Verbs are the ones of `screen_table.rs` and `lists` (a line or a word is the text), `lines N`, `rows N`, `each` (every
//!   field is the text), `runs` (the fields are these, each any number of times), `grows`, `within LOW HIGH` (every number
//!   lies there, and is no NaN), `near NUMBER SHARE` (the last one is but for that share), `same PART`, `differs PART`, and
//!   for directories `alike DIRECTORY/`.
//! - Words with blanks stand in quotes, in which `\n` is a new line and `\e` the escape character.

use std::fs;

use mdr_tui::scenario::Scenario;

use crate::screen_table::{is_so, unquoted};
use crate::tables::{self, ensure};
use crate::test_dir::{Said, TestDir, has, names};

/// Fails unless every line of a table holds; `prepare` puts files into the directory of a section.
#[track_caller]
pub fn hold(table: &str, prepare: impl Fn(&TestDir) + Sync) {
    tables::hold(table, &failures(table, prepare));
}

fn failures(table: &str, prepare: impl Fn(&TestDir) + Sync) -> Vec<String> {
    tables::failures(table, |lines| {
        let mut section = Section::default();
        prepare(&section.dir);
        while let Some(line) = lines.next() {
            lines.check(line, |lines| {
                section.hold(line, || lines.until_end_of_file())
            });
        }
    })
}

#[test]
fn every_kind_of_line_can_fail() {
    let table = tables::read("falsehoods.txt");
    let (_, lines) = table.split_once("nothing is true.\n").expect("the remark");
    let failures = failures("falsehoods.txt", |_| {});
    assert_eq!(failures.len(), lines.lines().count(), "{failures:#?}");
}

/// A line of bash that fails, and a check of what a command has said, show what was printed.
#[test]
fn a_failed_line_shows_what_was_printed() {
    let failures = failures("falsehoods.txt", |_| {}).concat();
    for (line, shown) in [
        (
            "# echo printed; echo told >&2; false",
            "exit code 1\nout: printed\nerr: told",
        ),
        ("$ presets nope", "exit code 2\nout: \nerr: mdr-tui: "),
        ("? err lacks no such", "no such preset"),
    ] {
        let (_, rest) = failures.split_once(line).expect(line);
        let failure = rest.split("\n== ").next().unwrap_or_default();
        has(failure, shown);
    }
}

#[derive(Default)]
struct Section {
    dir: TestDir,
    /// What stands before lines that are refused.
    before: String,
    out: String,
    err: String,
    scenario: Option<Scenario>,
}

impl Section {
    fn hold<'a>(&mut self, line: &str, file: impl FnOnce() -> Vec<&'a str>) -> Result<(), String> {
        let (mark, rest) = line.split_once(' ').unwrap_or((line, ""));
        match mark {
            ">" => {
                let place = self.dir.path(rest);
                fs::create_dir_all(place.parent().expect("a place")).expect("a directory");
                self.dir.write(rest, (file().join("\n") + "\n").as_bytes());
            }
            "%" => {
                let (name, edit) = rest.split_once(' ').expect("a file");
                let (from, to) = edit.split_once(" => ").expect("an edit");
                let text = self.dir.read(name);
                let edited = text.replace(&unquoted(from), &unquoted(to));
                assert!(text != edited, "no {from} in {text}");
                self.dir.write(name, edited.as_bytes());
            }
            "@" => self.before = rest.to_owned(),
            "$" => self.run(rest, Some(0))?,
            "$*" => self.run(rest, None)?,
            "$1" | "$2" | "$75" => self.run(rest, mark[1..].parse().ok())?,
            "#" => {
                let said = self.dir.shell(rest);
                ensure(said.code == 0, || shown(&said))?;
                (self.out, self.err) = (said.out, said.err);
            }
            "=" => {
                let words = words_of(rest);
                let (name, sets) = words.split_first().expect("a preset or a file");
                let found = Scenario::load(name, sets);
                self.scenario = Some(found.unwrap_or_else(|error| panic!("{error}")));
            }
            "?" => self.look(rest)?,
            "-" => {}
            _ if line.is_empty() => {}
            _ => {
                let (arguments, text) = line.split_once(" |").expect("ARGUMENTS | TEXT");
                let words = words_of(&format!("{} {arguments}", self.before));
                let words: Vec<&str> = words.iter().map(String::as_str).collect();
                let (more, text) = text.split_once(' ').expect("a text");
                let said = self.dir.refuse(&words, text);
                ensure(more == "+" || said.lines().count() == 1, || said)?;
            }
        }
        Ok(())
    }

    fn run(&mut self, line: &str, code: Option<i32>) -> Result<(), String> {
        let words = words_of(line);
        let is_variable = |word: &&String| word.contains('=') && !word.starts_with('-');
        let (set, words): (Vec<&str>, Vec<&str>) = {
            let count = words.iter().take_while(is_variable).count();
            let (set, words) = words.split_at(count);
            [set, words]
                .map(|of| of.iter().map(String::as_str).collect())
                .into()
        };
        let mut command = self.dir.command(&words);
        command.envs(set.iter().filter_map(|set| set.split_once('=')));
        let said = Said::from(command.output().expect("the program starts"));
        let is_due = code.is_none_or(|code| code == said.code);
        let is_quiet = code != Some(0) || said.err.is_empty();
        ensure(is_due && is_quiet, || shown(&said))?;
        (self.out, self.err) = (said.out, said.err);
        Ok(())
    }

    fn look(&self, what: &str) -> Result<(), String> {
        let mut pieces = what.splitn(3, ' ');
        let mut piece = || pieces.next().unwrap_or_default();
        let (part, verb, text) = (piece(), piece(), piece());
        let seen = self.part(part);
        let fields = || seen.split('\n').map(str::trim);
        let number = |field: &str| field.parse::<f64>().unwrap_or(f64::NAN);
        let pair = || {
            let (one, other) = text.split_once(' ').expect("two numbers");
            [one, other].map(number)
        };
        let words = || fields().collect::<Vec<_>>().join(" ");
        let holds = match verb {
            "is" | "starts" | "ends" if part.contains(':') => is_so(&words(), verb, text),
            "lists" => fields().any(|line| line == unquoted(text)),
            "lines" => seen.lines().count().to_string() == text,
            "rows" => fields().count().to_string() == text,
            "each" => fields().all(|field| field == unquoted(text)),
            "runs" => {
                let mut fields: Vec<&str> = fields().collect();
                fields.dedup();
                fields.join(" ") == text
            }
            "grows" => fields().map(number).is_sorted_by(|a, b| a < b),
            "within" => {
                let [low, high] = pair();
                fields()
                    .map(number)
                    .all(|value| (low..=high).contains(&value))
            }
            "near" => {
                let [due, share] = pair();
                let found = fields().next_back().map_or(f64::NAN, number);
                (found / due - 1.0).abs() <= share
            }
            "same" => seen == self.part(text),
            "differs" => seen != self.part(text),
            "alike" => {
                self.dir
                    .alike(part.trim_end_matches('/'), text.trim_end_matches('/'));
                true
            }
            _ => is_so(&seen, verb, text),
        };
        ensure(holds, || format!("{seen:.2000}"))
    }

    fn part(&self, part: &str) -> String {
        let fields = |file: &str, column: &str| {
            let table = self.dir.table(file);
            let at = table.columns.iter().position(|name| name == column);
            let at = at.unwrap_or_else(|| panic!("no column {column} in {file}"));
            let fields = table.rows.into_iter().map(|mut row| row.swap_remove(at));
            let named = fields.map(|field| {
                if field.is_empty() {
                    "-".to_owned()
                } else {
                    field
                }
            });
            named.collect::<Vec<_>>()
        };
        if let Some((file, key)) = part.split_once('#') {
            self.dir.table(file).header(key).to_owned()
        } else if let Some((file, column)) = part.split_once(':') {
            let (column, row) = column.split_once('@').unwrap_or((column, ""));
            let mut fields = fields(file, column);
            match row.parse::<isize>() {
                Ok(row @ 0..) => fields.swap_remove(row as usize),
                Ok(row) => fields.swap_remove(fields.len().wrapping_add_signed(row)),
                Err(_) => fields.join("\n"),
            }
        } else if let Some(key) = part.strip_prefix('=') {
            let scenario = self.scenario.as_ref().expect("a scenario");
            let value = scenario.value(key);
            value.map_or("none".to_owned(), |value| {
                value.trim_matches('"').to_owned()
            })
        } else if part.ends_with('/') {
            names(&self.dir.path(part)).join(" ")
        } else {
            match part {
                "toml" => self.scenario.as_ref().expect("a scenario").to_toml(),
                "out" => self.out.clone(),
                "err" => self.err.clone(),
                file => self.dir.read(file),
            }
        }
    }
}

/// What a program has said, in a message.
fn shown(said: &Said) -> String {
    let [out, err] = [&said.out, &said.err].map(|text| text.trim_end());
    format!(
        "exit code {}\nout: {out:.2000}\nerr: {err:.2000}",
        said.code
    )
}

/// The words of a line; those in quotes keep their blanks.
fn words_of(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (at, piece) in line.split('\'').enumerate() {
        match at % 2 {
            0 => words.extend(piece.split_whitespace().map(str::to_owned)),
            _ => words.push(unquoted(&format!("\"{piece}\""))),
        }
    }
    words
}
