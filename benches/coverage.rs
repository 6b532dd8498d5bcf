//! How often fits find the truth within twice the error that they state, from starts a factor of 100 away.
//!
//! `cargo bench --bench coverage -- [--sets 40] [--first 0] [--kind Scar] [--all]`: random data sets of each kind and the
//! first seed; `--kind` for one kind alone, `--all` for a line per fit.

#![allow(clippy::print_stdout, reason = "a program whose output is its result")]

#[allow(dead_code, unused_imports, reason = "tests need the rest")]
#[path = "../tests/suite/closed_forms/mod.rs"]
mod closed_forms;
#[path = "../tests/suite/coverage.rs"]
mod coverage;
#[path = "../tests/suite/random.rs"]
mod random;

use std::collections::BTreeMap;
use std::time::Instant;

use coverage::Kind;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let value = |name: &str| {
        let at = arguments.iter().position(|argument| argument == name);
        at.and_then(|at| arguments.get(at + 1))
    };
    let number = |name: &str, default: u64| {
        value(name).map_or(default, |text| text.parse().expect("a number"))
    };
    let (sets, first) = (number("--sets", 40), number("--first", 0));
    let shows_all = arguments.iter().any(|argument| argument == "--all");
    println!("kind         key                              within  of  mean   rms  s/fit");
    let is_wanted = |kind: &Kind| value("--kind").is_none_or(|name| format!("{kind:?}") == *name);
    for kind in Kind::ALL.into_iter().filter(is_wanted) {
        let begin = Instant::now();
        let mut all: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
        for seed in first..first + sets {
            let found = kind.deviations(seed);
            if shows_all {
                println!("{kind:?} {seed}: {found:.2?}");
            }
            for (key, off) in found {
                all.entry(key).or_default().push(off);
            }
        }
        let seconds = begin.elapsed().as_secs_f64() / sets as f64;
        for (key, off) in all {
            let count = off.len() as f64;
            let within = off.iter().filter(|off| off.abs() < 2.0).count();
            let mean = off.iter().sum::<f64>() / count;
            let rms = (off.iter().map(|off| off * off).sum::<f64>() / count).sqrt();
            println!(
                "{:11}  {key:31}  {within:6} {count:3} {mean:5.2} {rms:5.2} {seconds:6.2}",
                format!("{kind:?}")
            );
        }
    }
}
