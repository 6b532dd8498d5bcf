//! Tables of checks such as `commands.txt` and `screens.txt`, read when the tests run: a check a line, in sections that
//! begin with `== heading`.

use std::any::Any;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Returns the text of a file in the directory of the tests.
pub fn read(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite");
    fs::read_to_string(folder.join(name)).expect(name)
}

/// The lines of a section that are still to be checked, and what has failed.
pub struct Lines<'a> {
    heading: &'a str,
    rest: std::str::Lines<'a>,
    failures: Vec<String>,
}

impl<'a> Lines<'a> {
    /// Returns the next line.
    pub fn next(&mut self) -> Option<&'a str> {
        self.rest.next()
    }

    /// Returns the lines up to one that is `<`.
    pub fn until_end_of_file(&mut self) -> Vec<&'a str> {
        self.rest.by_ref().take_while(|line| *line != "<").collect()
    }

    /// Runs the check of a line; an error or a panic is noted with the line, and the next line can be checked.
    pub fn check(&mut self, line: &str, check: impl FnOnce(&mut Self) -> Result<(), String>) {
        let checked = catch_unwind(AssertUnwindSafe(|| check(self)));
        if let Err(why) = checked.unwrap_or_else(|panic| Err(message(&*panic))) {
            let heading = self.heading;
            self.failures
                .push(format!("== {heading}\n{line}\n{}\n", why.trim_end()));
        }
    }
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().cloned();
    let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
    text.unwrap_or_default()
}

/// Fails with what there is to show, unless a check holds.
pub fn ensure(holds: bool, shown: impl FnOnce() -> String) -> Result<(), String> {
    holds.then_some(()).ok_or_else(shown)
}

/// Checks all sections of a table, on as many threads as there are processors, and returns what has failed.
pub fn failures(table: &str, section: impl Fn(&mut Lines) + Sync) -> Vec<String> {
    let text = read(table);
    let sections: Vec<&str> = text.split("\n== ").skip(1).collect();
    let next = AtomicUsize::new(0);
    let work = || {
        let mut failed = Vec::new();
        while let Some(text) = sections.get(next.fetch_add(1, Ordering::Relaxed)) {
            let (heading, rest) = text.split_once('\n').unwrap_or((text, ""));
            let (rest, failures) = (rest.lines(), Vec::new());
            let mut lines = Lines {
                heading,
                rest,
                failures,
            };
            section(&mut lines);
            failed.append(&mut lines.failures);
        }
        failed
    };
    let threads = thread::available_parallelism().map_or(2, usize::from);
    thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let failed = workers
            .into_iter()
            .map(|worker| worker.join().expect("checks"));
        failed.flatten().collect()
    })
}

/// Fails with everything that has failed in a table.
#[track_caller]
pub fn hold(table: &str, failures: &[String]) {
    assert!(failures.is_empty(), "{table}\n{}", failures.join("\n"));
}
