//! No import circles: what a file imports never leads back to it.
//!
//! A file may import from the `mod.rs` of its folder, whose parts they both are; and a name that a `mod.rs` hands on is
//! followed to the file that has it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::layers::{is_test_file, paths, sources, without_tests};

type Module = Vec<String>;

/// The modules that are files, each with the paths in its code.
struct Imports(BTreeMap<Module, Vec<Vec<String>>>);

impl Imports {
    fn of<'a>(files: impl IntoIterator<Item = (&'a Path, String)>) -> Self {
        let files = files.into_iter().map(|(path, text)| {
            let names = path.with_extension("");
            let names = names.iter().filter_map(|name| name.to_str());
            let module = names.filter(|name| *name != "mod").map(str::to_owned);
            (module.collect(), paths(&without_tests(&text)))
        });
        Self(files.collect())
    }

    /// The file that a path in the code of `module` leads to; `None` if it leads outside `src`.
    fn resolve(&self, module: &[String], path: &[String]) -> Option<Module> {
        let ups = path.iter().take_while(|name| *name == "super").count();
        let (mut at, rest) = match path[0].as_str() {
            "crate" => (Module::new(), &path[1..]),
            "self" => (module.to_vec(), &path[1..]),
            _ => (
                module[..module.len().checked_sub(ups)?].to_vec(),
                &path[ups..],
            ),
        };
        let begin = at.len();
        let mut rest = rest.iter();
        let mut name = rest.next();
        while let Some(next) = name {
            at.push(next.clone());
            if !self.0.contains_key(&at) {
                at.pop();
                break;
            }
            name = rest.next();
        }
        let is_foreign = ups == 0 && at.len() == begin && path[0] != "crate" && path[0] != "self";
        let own = self.0.get(&at).filter(|_| !is_foreign)?;
        let handed_on = own
            .iter()
            .find(|path| path.len() > 1 && path.last() == name);
        let handed_on = handed_on.and_then(|path| self.resolve(&at, path));
        Some(handed_on.unwrap_or(at))
    }

    /// The files on circles, and those between two circles, each with what it imports of them.
    fn circles(&self) -> BTreeMap<Module, BTreeSet<Module>> {
        let arrows = self.0.iter().map(|(module, paths)| {
            let to = paths.iter().filter_map(|path| self.resolve(module, path));
            let is_arrow = |to: &Module| to != module && to[..] != module[..module.len() - 1];
            (module.clone(), to.filter(is_arrow).collect())
        });
        let mut left: BTreeMap<Module, BTreeSet<Module>> = arrows.collect();
        loop {
            let kept: BTreeSet<Module> = left.keys().cloned().collect();
            left.values_mut()
                .for_each(|to| to.retain(|to| kept.contains(to)));
            let used: BTreeSet<Module> = left.values().flatten().cloned().collect();
            left.retain(|module, to| !to.is_empty() && used.contains(module));
            if left.len() == kept.len() {
                return left;
            }
        }
    }
}

#[test]
fn no_file_imports_what_leads_back_to_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let files = sources(&root);
    let files = files
        .iter()
        .map(|file| (file, file.strip_prefix(&root).expect("a path below src")));
    let files = files.filter(|(_, path)| !is_test_file(path) && !path.ends_with("main.rs"));
    let imports = Imports::of(
        files.map(|(file, path)| (path, std::fs::read_to_string(file).expect("a source"))),
    );
    assert!(
        imports.0.len() > 200,
        "only {} files were read",
        imports.0.len()
    );
    let circles = imports.circles();
    assert!(circles.is_empty(), "{circles:#?}");
}

#[test]
fn a_circle_is_found_through_groups_and_through_names_that_are_handed_on() {
    let count = |code: &[(&str, &str)]| {
        let files = code
            .iter()
            .map(|(path, text)| (Path::new(*path), text.to_string()));
        Imports::of(files).circles().len()
    };
    let parent = (
        "a/mod.rs",
        "mod b;\nmod c;\npub use b::B;\npub use c::C;\nstruct A;",
    );
    for (b, c, left) in [
        ("use super::A;", "use super::{A, B};", 0),
        ("use super::C;", "use crate::{\n    a::B,\n};", 2),
        ("fn f() { super::c::C }", "fn f(b: crate::a::b::B) {}", 2),
        (
            "use super::C;\n#[cfg(test)]\nuse a::b::B;",
            "// use super::B;\nuse std::c::B;",
            0,
        ),
        ("use super::c;", "pub(in super::b) struct C;", 0),
    ] {
        assert_eq!(
            count(&[parent, ("a/b.rs", b), ("a/c.rs", c)]),
            left,
            "{b} {c}"
        );
    }
    assert_eq!(
        count(&[
            ("a.rs", "use crate::d::D;"),
            ("d.rs", "use crate::a::A;"),
            ("e.rs", "use crate::a::A;")
        ]),
        2
    );
}
