//! Layers: a module imports only from the layers below its own.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use mdr_tui::reading::Column;
use mdr_tui::scenario::scalars;

use crate::tables;

/// Returns the height of a layer, or `None` if there is no such layer. `cli` is above `tui`.
fn height(layer: &str) -> Option<u8> {
    Some(match layer {
        "math" | "guide" => 0,
        "contact" => 1,
        "wear" => 2,
        "simulation" => 3,
        "reading" => 4,
        "scenario" => 5,
        "traces" => 6,
        "studies" | "export" | "plot" => 7,
        "charts" => 8,
        "figure" => 9,
        "tui" => 10,
        "cli" => 11,
        _ => return None,
    })
}

/// Returns what is wrong with the imports of one file of `layer`, one line each.
fn faults(layer: &str, text: &str) -> Vec<String> {
    let code = without_tests(text);
    let mut faults: Vec<String> = imports(&code)
        .into_iter()
        .filter(|target| !may_import(layer, target))
        .map(|target| format!("{layer} imports {target}"))
        .collect();
    if code.contains("use super::*") {
        faults.push(format!(
            "{layer} imports everything that its parent has, so that no line shows what it needs"
        ));
    }
    // Layers above the readers see observations of a simulation only.
    if height(layer) > height("reading")
        && [".state()", ".model()"]
            .iter()
            .any(|inside| code.contains(inside))
    {
        faults.push(format!("{layer} looks into the state of a simulation"));
    }
    faults
}

fn may_import(layer: &str, target: &str) -> bool {
    if layer == target {
        return true;
    }
    match (height(layer), height(target)) {
        (Some(from), Some(to)) => to < from,
        // What the process does when it fails: below every layer.
        (Some(_), None) => ["failpoint", "panics"].contains(&target),
        _ => false,
    }
}

/// The first names after every `crate::`.
fn imports(code: &str) -> Vec<String> {
    let of_ours = paths(code).into_iter().filter(|path| path[0] == "crate");
    of_ours.filter_map(|path| path.into_iter().nth(1)).collect()
}

/// Every path that is imported by `use`, or begins with `crate` or `super`, as its names; groups in braces are split
/// into their members.
pub fn paths(code: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let mut before = ' ';
    for (at, sign) in code.char_indices() {
        let begins = !(before.is_alphanumeric() || before == '_' || before == ':');
        before = sign;
        match head(&code[at..]).as_str() {
            "use" if begins => _ = members(&code[at + 3..], &[], &mut found),
            // A visibility is not an import.
            "crate" | "super" if begins && !code[..at].ends_with("(in ") => {
                members(&code[at..], &[], &mut found);
            }
            _ => {}
        }
    }
    found.retain(|path| path.len() > 1);
    found.sort();
    found.dedup();
    found
}

/// The paths in `text`, a name or a group after the names `before`; returns what follows them.
fn members<'t>(text: &'t str, before: &[String], found: &mut Vec<Vec<String>>) -> &'t str {
    let mut text = text.trim_start();
    if text.starts_with('{') {
        while !text.is_empty() && !text.starts_with('}') {
            text = members(&text[1..], before, found);
            text = text.trim_start_matches(|sign| sign != ',' && sign != '}');
        }
        return text.get(1..).unwrap_or_default();
    }
    let name = head(text);
    let rest = &text[name.len()..];
    let is_empty = name.is_empty() && !text.starts_with('*');
    let path = [before, &[name]].concat();
    match rest.strip_prefix("::") {
        Some(rest) => members(rest, &path, found),
        None => {
            // Nothing follows the last comma of a group.
            found.extend((!is_empty).then_some(path));
            rest
        }
    }
}

fn head(path: &str) -> String {
    path.chars()
        .take_while(|sign| sign.is_alphanumeric() || *sign == '_')
        .collect()
}

/// Returns the code without comments and without items under `#[cfg(test)]`. With `rustfmt`, such an item ends at a line
/// of the same indentation that closes it.
pub fn without_tests(text: &str) -> String {
    let mut kept = String::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let code = line.trim_start();
        let indent = line.len() - code.len();
        if code.starts_with("#[cfg(test)]") {
            let ends = |line: &str| {
                let code = line.trim_start();
                line.len() - code.len() == indent && code.ends_with(['}', ';'])
            };
            lines.by_ref().find(|line| ends(line));
        } else if !code.starts_with("//") {
            kept += line.split(" // ").next().unwrap_or_default();
            kept.push('\n');
        }
    }
    kept
}

/// Returns the layer that a path below `src` belongs to; `None` for the entry points and the module map.
fn layer_of(path: &Path) -> Option<String> {
    let first = path.components().next()?.as_os_str().to_str()?;
    let name = first.strip_suffix(".rs").unwrap_or(first);
    (!["lib", "main", "failpoint", "panics"].contains(&name)).then(|| name.to_owned())
}

/// Files that hold nothing but tests, by their name.
pub fn is_test_file(path: &Path) -> bool {
    let stem = path.file_stem().and_then(|stem| stem.to_str());
    stem.is_some_and(|stem| stem == "tests" || stem.ends_with("_tests"))
}

pub fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            files.push(path);
        }
    }
    files
}

#[test]
fn every_import_points_downwards() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (mut seen, mut wrong) = (0, Vec::new());
    for file in sources(&root) {
        let path = file.strip_prefix(&root).expect("a path below src");
        let Some(layer) = layer_of(path) else {
            continue;
        };
        if is_test_file(path) {
            continue;
        }
        assert!(
            height(&layer).is_some(),
            "{} is in no known layer",
            path.display()
        );
        let text = fs::read_to_string(&file).expect("a source");
        let found = faults(&layer, &text);
        wrong.extend(
            found
                .into_iter()
                .map(|f| format!("{}: {f}", path.display())),
        );
        seen += 1;
    }
    assert!(seen > 30, "only {seen} files were read");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A column's name stands in its table alone; elsewhere code asks by [`Column`].
#[test]
fn names_of_columns_stand_in_one_table() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    // Names of one word are words of other things, too.
    let names = Column::ALL.iter().map(|column| column.name());
    let quoted = names.filter(|name| name.contains('_'));
    let quoted: Vec<String> = quoted.map(|name| format!("\"{name}\"")).collect();
    for file in sources(&root).iter().filter(|file| !is_test_file(file)) {
        let text = without_tests(&fs::read_to_string(file).expect("a source"));
        let found = quoted.iter().filter(|name| text.contains(*name)).count();
        let is_table = file.ends_with("reading/column.rs");
        assert_eq!(
            found,
            if is_table { quoted.len() } else { 0 },
            "{}",
            file.display()
        );
    }
}

/// A column that is no scalar of a run is read by code that names it.
#[test]
fn every_column_is_read_by_something() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let files = sources(&root).into_iter();
    let code = files.filter(|file| !is_test_file(file) && !file.ends_with("reading/column.rs"));
    let code = code.map(|file| without_tests(&fs::read_to_string(file).expect("a source")));
    let code = code.collect::<String>();
    let words = code.split(|sign: char| !sign.is_alphanumeric() && sign != ':');
    let named: HashSet<&str> = words.collect();
    let mut others = Column::ALL.to_vec();
    others.retain(|column| scalars::all().all(|scalar| scalar != *column));
    assert!(others.len() > 30);
    others.retain(|column| !named.contains(format!("Column::{column:?}").as_str()));
    assert!(others.is_empty(), "nothing reads {others:?}");
}

/// `layers.txt` has code of layers, and whether it is wrong.
#[test]
fn the_checker_catches_what_it_must_and_lets_pass_what_is_right() {
    for row in tables::read("layers.txt").lines().skip(2) {
        let (judged, code) = row.split_once(" | ").expect("LAYER is VERDICT | CODE");
        let (layer, verdict) = judged.split_once(" is ").expect("LAYER is VERDICT");
        let found = faults(layer, &code.replace("\\n", "\n"));
        assert_eq!(
            found.len(),
            usize::from(verdict == "wrong"),
            "{row}: {found:?}"
        );
    }
}

/// The judge shares no code with the judged: closed forms import the standard library and one another.
#[test]
fn closed_forms_import_nothing_that_they_judge() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let files = sources(&root.join("tests/suite/closed_forms"));
    assert!(files.len() > 10, "{files:?}");
    for file in files
        .into_iter()
        .chain([root.join("src/studies/verify/exact.rs")])
    {
        let text = fs::read_to_string(&file).expect("a source");
        let paths = paths(&without_tests(&text)).into_iter();
        // A capital is a type of the file itself.
        let is_own =
            |name: &str| ["std", "super"].contains(&name) || name.starts_with(char::is_uppercase);
        let foreign: Vec<_> = paths.filter(|path| !is_own(&path[0])).collect();
        assert!(foreign.is_empty(), "{}: {foreign:?}", file.display());
        assert!(!text.contains("super::super::super"), "{}", file.display());
    }
}
