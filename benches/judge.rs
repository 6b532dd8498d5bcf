//! The judge: time to a verified accuracy over random scenarios, what was missed, and how far estimates are right.
//!
//! `cargo bench --bench judge -- [--scenarios 100] [--first 0] [--accuracy 1e-2,1e-3] [--limit SECONDS]
//! [--longest SECONDS] [--all] [--estimate | --checks | --toml]`
//!
//! Times are CPU times of this thread, so that other work on the machine hardly counts. `--limit` ends
//! the study after that many seconds, `--longest` a search that takes longer; `--all` prints a line per scenario.
//! `--estimate` judges the estimates of `run --estimate-error` on cells and steps drawn at random, and no accuracy;
//! `--checks` the checks of runs on the default cells and steps; `--toml` prints the scenarios. Seeds from 1000000 on are
//! long runs, those from 2000000 on have thresholds, courses, blocks, scars and other kinds in them, and those from
//! 3000000 on are line contacts.

#![allow(clippy::print_stdout, reason = "a program whose output is its result")]

#[path = "../tests/suite/judge.rs"]
mod judge;
#[path = "../tests/suite/random.rs"]
mod random;
#[path = "../tests/suite/random_kinds.rs"]
mod random_kinds;
#[path = "../tests/suite/random_scenarios.rs"]
mod random_scenarios;

use judge::{Case, Found, QUANTITIES, UNDERSTATED, judge, judge_estimate, quantile, tally_checks};
use mdr_tui::reading::Quantity;
use mdr_tui::studies::refinement::Verdict;
use nix::time::{ClockId, clock_gettime};

fn cpu_seconds() -> f64 {
    clock_gettime(ClockId::CLOCK_THREAD_CPUTIME_ID).map_or(0.0, |time| {
        time.tv_sec() as f64 + 1e-9 * time.tv_nsec() as f64
    })
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let option = |name: &str, default: &str| -> String {
        let at = arguments.iter().position(|argument| argument == name);
        at.and_then(|at| arguments.get(at + 1))
            .map_or_else(|| default.to_owned(), Clone::clone)
    };
    let number = |name: &str, default: &str| -> f64 {
        let text = option(name, default);
        text.parse()
            .unwrap_or_else(|_| panic!("{name} {text}: not a number"))
    };
    let (count, first) = (
        number("--scenarios", "100") as u64,
        number("--first", "0") as u64,
    );
    let (limit, longest) = (number("--limit", "300"), number("--longest", "20"));
    let asks = |name: &str| arguments.iter().any(|argument| argument == name);
    let (shows_all, seeds) = (asks("--all"), first..first + count);
    if asks("--toml") {
        return seeds.for_each(|seed| println!("{}", random_scenarios::text(seed)));
    }
    if asks("--checks") {
        return checks(seeds, limit);
    }
    if asks("--estimate") {
        return estimates(seeds, limit, shows_all);
    }
    let accuracies: Vec<f64> = option("--accuracy", "1e-2,1e-3")
        .split(',')
        .map(|text| text.parse().expect("an accuracy"))
        .collect();
    println!(
        "accuracy  scenarios  median_s  95%_s  worst_s  last_rung_median_s  met  missed  failed  unverified"
    );
    let share = limit / accuracies.len() as f64;
    for accuracy in accuracies {
        let begin = cpu_seconds();
        let mut cases = Vec::new();
        for seed in first..first + count {
            if cpu_seconds() - begin > share {
                break;
            }
            let case = judge(seed, accuracy, longest, &cpu_seconds);
            if shows_all {
                show(&case, accuracy);
            }
            cases.push(case);
        }
        summarize(&cases, accuracy);
    }
}

/// How many runs that are right to 1e-2 fail a check, and how many whose volume or work is wrong do.
fn checks(seeds: std::ops::Range<u64>, limit: f64) {
    let begin = cpu_seconds();
    let tally = tally_checks(seeds.take_while(|_| cpu_seconds() - begin <= limit));
    let [right, wrong] = tally.map(|[fail, pass]| format!("{fail} of {}", fail + pass));
    println!("flagged: {right} right, {wrong} wrong");
}

/// How far the estimates of single runs are right, for each number that a run states.
fn estimates(seeds: std::ops::Range<u64>, limit: f64, shows_all: bool) {
    let begin = cpu_seconds();
    let mut found = Vec::new();
    for seed in seeds {
        if cpu_seconds() - begin > limit {
            break;
        }
        match judge_estimate(seed) {
            Ok((estimate, truth)) => {
                if shows_all {
                    println!("  {seed:4}  estimate {estimate:?}\n        truth    {truth:?}");
                }
                found.push((estimate, truth));
            }
            Err(why) => println!("  {seed:4}  failed: {why}"),
        }
    }
    println!("{} runs estimated", found.len());
    for &of in QUANTITIES {
        println!("{}", of.name());
        let ratios = found
            .iter()
            .map(|(estimate, truth)| (estimate[of], truth[of]));
        // What round-off makes is no error of cells and steps.
        let ratios = ratios.filter(|(_, truth)| *truth > 1e-9);
        histogram(
            &ratios
                .map(|(estimate, truth)| estimate / truth)
                .collect::<Vec<f64>>(),
        );
    }
}

fn show(case: &Case, accuracy: f64) {
    match &case.reached {
        Err(why) => println!("  {:4}  failed: {why}", case.seed),
        Ok(found) => {
            let truth = match &found.truth {
                Ok(truth) => {
                    let one = |of: &Quantity| {
                        let (error, estimate) = (truth[*of], found.estimate[*of]);
                        format!("{} {error:.1e} (est {estimate:.1e})", of.name())
                    };
                    QUANTITIES.iter().map(one).collect::<Vec<_>>().join("  ")
                }
                Err(why) => why.clone(),
            };
            println!(
                "  {:4}  {:?}  N={} steps={} tol={:?}  {:.3}s ({:.3}s)  {truth}{}{}",
                case.seed,
                found.verdict,
                found.level.points,
                found.level.steps,
                found.level.tolerance,
                found.seconds,
                found.last_rung,
                if found.is_missed(accuracy) {
                    "  MISSED"
                } else {
                    ""
                },
                if found.passes { "" } else { "  FLAGGED" }
            );
        }
    }
}

fn summarize(cases: &[Case], accuracy: f64) {
    let found: Vec<_> = cases
        .iter()
        .filter_map(|case| case.reached.as_ref().ok())
        .collect();
    let of = |pick: &dyn Fn(&&&Found) -> bool| found.iter().filter(|one| pick(one)).count();
    let times: Vec<f64> = found.iter().map(|one| one.seconds).collect();
    let last: Vec<f64> = found.iter().map(|one| one.last_rung).collect();
    println!(
        "{accuracy:8.0e}  {:9}  {:8.4}  {:5.3}  {:7.2}  {:18.4}  {:3}  {:6}  {:6}  {:10}",
        cases.len(),
        quantile(&times, 0.5),
        quantile(&times, 0.95),
        quantile(&times, 1.0),
        quantile(&last, 0.5),
        of(&|one| one.verdict == Verdict::Met),
        of(&|one| one.is_missed(accuracy)),
        cases.len() - found.len(),
        of(&|one| one.truth.is_err()),
    );
    let is_right = |one: &&&Found| {
        one.verdict == Verdict::Met && one.truth.is_ok() && !one.is_missed(accuracy)
    };
    println!(
        "          {} of {} kept promises fail a check",
        of(&|one| is_right(one) && !one.passes),
        of(&is_right),
    );
    for &number in QUANTITIES {
        let met = found.iter().filter(|one| one.verdict == Verdict::Met);
        let pairs: Vec<_> = met
            .filter_map(|one| Some((one.estimate[number], one.truth.as_ref().ok()?[number])))
            .collect();
        let count =
            |is: &dyn Fn(f64, f64) -> bool| pairs.iter().filter(|one| is(one.0, one.1)).count();
        println!(
            "          {}: {} of {} beyond the accuracy, {} understated {UNDERSTATED} times",
            number.name(),
            count(&|_, truth| truth > accuracy),
            pairs.len(),
            count(&|estimate, truth| truth > (UNDERSTATED * estimate).max(1e-9)),
        );
    }
    histogram(
        &found
            .iter()
            .filter_map(|one| one.reliability())
            .collect::<Vec<f64>>(),
    );
}

/// A histogram of the ratio of the estimated to the true error.
fn histogram(ratios: &[f64]) {
    const EDGES: [f64; 9] = [
        0.1,
        1.0 / 3.0,
        0.5,
        1.0,
        2.0,
        3.0,
        10.0,
        30.0,
        f64::INFINITY,
    ];
    println!("          estimate over true error:");
    let mut low = 0.0;
    for high in EDGES {
        let count = ratios
            .iter()
            .filter(|ratio| **ratio >= low && **ratio < high)
            .count();
        println!(
            "          {low:6.2} to {high:6.2}  {count:4}  {}",
            "#".repeat(count.min(100))
        );
        low = high;
    }
}
