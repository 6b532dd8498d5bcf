//! Points per second of a study, and how well two threads share it.
//!
//! `cargo bench --bench studies` (a quarter of the study below), `-- --whole` for all of it.
//!
//! The study: 40 × 40 points, depth over amplitude, the material of `li2019-fig3`, 1,000 cycles at an
//! accuracy of 1e-2, by jumps over cycles where they pay.

#![allow(clippy::print_stdout, reason = "a bench prints what it measures")]

use std::path::Path;
use std::time::Instant;

use mdr_tui::studies::sweep::{Status, Study, engine};

fn study(side: usize) -> Study {
    let text = format!(
        "base = \"li2019-fig3\"\ncolumns = [\"wear_volume_m3\", \"regime\"]\n\
         [set]\n\"run.cycles\" = 1000.0\n\"numerics.accuracy\" = 1e-2\n\
         [[axis]]\nkey = \"motion.normal.mean\"\nlinspace = [5e-7, 2e-6, {side}]\n\
         tied = {{ \"motion.normal.amplitude\" = 0.1 }}\n\
         [[axis]]\nkey = \"motion.tangential.amplitude\"\nlogspace = [1e-8, 1e-6, {side}]\n"
    );
    Study::read(&text, "the study of the bench", Path::new("")).expect("a study")
}

/// The study's time on `threads` threads, s, and the number of failed points.
fn seconds(study: &Study, threads: usize) -> (f64, usize) {
    let todo = Vec::from_iter(0..study.points());
    let mut failed = 0;
    let start = Instant::now();
    let ran = engine::run(study, &todo, threads, &|| true, |row| {
        failed += usize::from(row.status != Status::Ok);
        true
    });
    ran.expect("threads");
    (start.elapsed().as_secs_f64(), failed)
}

fn main() {
    let whole = std::env::args().any(|argument| argument == "--whole");
    let study = study(if whole { 40 } else { 20 });
    let points = study.points() as f64;
    let (alone, failed) = seconds(&study, 1);
    let (shared, _) = seconds(&study, 2);
    println!("points      {points} ({failed} failed)");
    println!("1 thread    {alone:.2} s, {:.1} points/s", points / alone);
    println!("2 threads   {shared:.2} s, {:.1} points/s", points / shared);
    println!("efficiency  {:.2} on 2", alone / shared);
}
