//! Screens after keys, held by tables such as `screens.txt`: a check a line, `KEYS | WHAT`.
//!
//! - `== heading` begins a section, in a new directory, on `li2019-fig3` in 80 by 24.
//! - `@ WORDS 80x24 ..` sets the arguments of the program and the sizes of the screen for what follows.
//! - `$ LINE` runs the program on a line, which must succeed.
//! - Without keys a line is about the screen of the line above; `.{30}` is a key pressed 30 times. Behind `KEYS & KEYS`
//!   stands what holds after each of them.
//! - `pin NAME` pins the screen in `snapshots/`; `replays N` takes the one snapshot that the keys have written, which
//!   must tell of N changes and run again without a screen to the last bit. The others are `PART VERB TEXT`, where a text with blanks at
//!   its ends stands in quotes: `has`, `lacks`, `counts N`, `is`, `starts` and `ends` look at the part, `says` at its words
//!   whatever lines they are broken into, `same` and `differs` compare it with the same part after other keys.
//! - Parts are the `status` line, the `timeline` below it, the `foot`, the `scale` above that, the `body` above
//!   the foot, the `panels`, which are the body without those two lines, `/TEXT/`, which are all lines that have that text, and
//!   the `screen`, which need not be named.

use std::collections::HashMap;

use crate::tables::{self, ensure};
use crate::test_dir::{TestDir, names};

/// Fails unless every check of a table, `NAME.txt`, holds; `prepare` puts files into the directory of a section.
#[track_caller]
pub fn hold(name: &str, prepare: impl Fn(&TestDir) + Sync) {
    let table = format!("{name}.txt");
    let failures = tables::failures(&table, |lines| {
        let mut section = Section::new();
        prepare(&section.dir);
        while let Some(line) = lines.next() {
            lines.check(line, |_| section.hold(name, line));
        }
    });
    tables::hold(&table, &failures);
}

struct Section {
    dir: TestDir,
    arguments: Vec<String>,
    sizes: Vec<String>,
    keys: Vec<String>,
    seen: HashMap<[String; 2], String>,
}

impl Section {
    fn new() -> Self {
        let mut section = Self {
            dir: TestDir::new(),
            arguments: Vec::new(),
            sizes: Vec::new(),
            keys: Vec::new(),
            seen: HashMap::new(),
        };
        section.set("li2019-fig3 80x24");
        section
    }

    fn set(&mut self, words: &str) {
        let words = words.split(' ').map(str::to_owned);
        let is_size = |word: &String| word.starts_with(|sign: char| sign.is_ascii_digit());
        (self.sizes, self.arguments) = words.partition(is_size);
        self.seen.clear();
    }

    /// The screen after keys, which are played once in a section.
    fn screen(&mut self, keys: &str, size: &str) -> String {
        let place = [keys, size].map(str::to_owned);
        if let Some(seen) = self.seen.get(&place) {
            return seen.clone();
        }
        let arguments: Vec<&str> = self.arguments.iter().map(String::as_str).collect();
        let (columns, rows) = size.split_once('x').expect("a size");
        let size = [columns, rows].map(|side| side.parse().expect("a number"));
        let screen = self.dir.screen(&arguments, keys, size.into());
        self.seen.insert(place, screen.clone());
        screen
    }

    fn hold(&mut self, module: &str, line: &str) -> Result<(), String> {
        if let Some(words) = line.strip_prefix("@ ") {
            self.set(words);
        } else if let Some(line) = line.strip_prefix("$ ") {
            self.dir.done(line);
        } else if !line.is_empty() {
            return self.check(module, line);
        }
        Ok(())
    }

    fn check(&mut self, module: &str, line: &str) -> Result<(), String> {
        let (keys, what) = line.split_once("| ").expect("KEYS | WHAT");
        if !keys.is_empty() || self.keys.is_empty() {
            self.keys = keys.trim_end().split(" & ").map(unfold).collect();
        }
        let (each, sizes) = (self.keys.clone(), self.sizes.clone());
        if let Some(changes) = what.strip_prefix("replays ") {
            replays(&self.arguments, &each[0], changes);
            return Ok(());
        }
        for (keys, size) in each
            .iter()
            .flat_map(|keys| sizes.iter().map(move |size| (keys, size)))
        {
            let screen = self.screen(keys, size);
            let (first, rest) = what.split_once(' ').expect("a check");
            if first == "pin" {
                pin(&format!("suite__{module}__{rest}-{size}"), &screen);
                continue;
            }
            let (part, rest) = match what.rsplit_once("/ ") {
                Some((part, rest)) if part.starts_with('/') => (part, rest),
                _ if PARTS.contains(&first) => (first, rest),
                _ => ("screen", what),
            };
            let (verb, text) = rest.split_once(' ').expect("a text");
            let seen = part_of(&screen, part);
            let holds = match verb {
                "same" => seen == part_of(&self.screen(&unfold(text), size), part),
                "differs" => seen != part_of(&self.screen(&unfold(text), size), part),
                _ => is_so(&seen, verb, text),
            };
            ensure(holds, || format!("after {keys} on {size}:\n{screen}"))?;
        }
        Ok(())
    }
}

/// A text in quotes keeps the blanks at its ends, and `\n` in it is a new line, `\e` the escape character.
pub fn unquoted(text: &str) -> String {
    let quoted = text
        .strip_prefix('"')
        .and_then(|text| text.strip_suffix('"'));
    quoted.map_or_else(
        || text.to_owned(),
        |text| {
            text.replace("\\\"", "\"")
                .replace("\\n", "\n")
                .replace("\\e", "\u{1b}")
        },
    )
}

/// Whether a part is what its check says.
pub fn is_so(seen: &str, verb: &str, text: &str) -> bool {
    let text = &*unquoted(text);
    match verb {
        "has" => seen.contains(text),
        "lacks" => !seen.contains(text),
        "is" => seen == text,
        "starts" => seen.starts_with(text),
        "ends" => seen.ends_with(text),
        "says" => words_of(seen).contains(text),
        "counts" => {
            let (count, text) = text.split_once(' ').expect("a number and a text");
            seen.matches(&*unquoted(text)).count().to_string() == count
        }
        _ => panic!("there is no verb {verb}"),
    }
}

const PARTS: [&str; 7] = [
    "status", "timeline", "foot", "scale", "body", "panels", "screen",
];

/// A part of a screen, by its name.
pub fn part_of(screen: &str, part: &str) -> String {
    let lines: Vec<&str> = screen.lines().collect();
    match part {
        "status" => lines[0].to_owned(),
        "timeline" => lines[1].to_owned(),
        "foot" => lines[lines.len() - 1].trim().to_owned(),
        "body" => lines[..lines.len() - 1].join("\n"),
        "scale" => lines[lines.len() - 2].to_owned(),
        "panels" => lines[2..lines.len() - 1].join("\n"),
        _ => match part.strip_prefix('/') {
            Some(text) => lines
                .into_iter()
                .filter(|line| line.contains(text))
                .collect::<Vec<_>>()
                .join("\n"),
            None => screen.to_owned(),
        },
    }
}

/// A screen as running text: a box that breaks its lines does not break a sentence.
pub fn words_of(text: &str) -> String {
    let words = text.split(|sign: char| sign.is_whitespace() || sign == '│');
    words
        .filter(|word| !word.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

/// Keys with those that are pressed many times written out.
fn unfold(keys: &str) -> String {
    let mut pieces = keys.split('{');
    let mut unfolded = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (count, rest) = piece.split_once('}').expect("a number of times");
        let last = match unfolded.ends_with('>') {
            true => unfolded.rfind('<'),
            false => unfolded.char_indices().next_back().map(|(at, _)| at),
        };
        let key = unfolded.split_off(last.expect("a key"));
        unfolded += &key.repeat(count.parse().expect("a number"));
        unfolded += rest;
    }
    unfolded
}

fn replays(arguments: &[String], keys: &str, changes: &str) {
    let dir = TestDir::new();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    dir.screen(&arguments, keys, (80, 24));
    let [name] = &names(&dir.path(""))[..] else {
        panic!("not one snapshot");
    };
    let [state, scenario] =
        ["state.csv", "scenario.toml"].map(|file| dir.read(&format!("{name}/{file}")));
    let told = [
        state.matches("# at cycle ").count(),
        scenario.matches("[[changes]]").count(),
    ];
    assert_eq!(
        told.map(|count| count.to_string()),
        [changes; 2],
        "changes in the snapshot"
    );
    dir.done(&format!("run {name}/scenario.toml --out again --quiet"));
    assert!(dir.read("again/state.csv") == state, "the states differ");
}

/// Pins a screen under a separate name.
pub fn pin(name: &str, screen: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.bind(|| insta::assert_snapshot!(name, screen));
}
