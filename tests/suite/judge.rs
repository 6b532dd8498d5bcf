//! The benchmark of the numerics: random scenarios, each refined to an accuracy and compared with a
//! much finer run.
//!
//! A change of a method, a special case or a tuned constant is judged by its effect on this table.

#![allow(dead_code, reason = "the bench and the tests need a part of it each")]

use mdr_tui::reading::{Check, Quantity};
use mdr_tui::scenario::Scenario;
use mdr_tui::scenario::session::Session;
use mdr_tui::studies::refinement::{self, Budget, Difference, Level, Outcome, Verdict};

use crate::random::Random;
use crate::random_scenarios;

/// Ratio of the cells and steps of the fine run to the ones of the rung that it judges: not whole, so that they share
/// no moments.
const FINER: f64 = 3.3;

/// Ratio of the tolerances of their jumps over cycles.
const FINER_JUMPS: f64 = 10.0;

/// How much longer a fine run may take than a search; if it does, the scenario is not judged.
const FINE_RUN: f64 = 3.0;

/// The numbers that a run states with their errors.
pub const QUANTITIES: &[Quantity] = Quantity::ALL;

/// An error is understated where the estimate is less than it by more than this factor.
pub const UNDERSTATED: f64 = 3.0;

/// What the judge saw of one scenario at one accuracy.
#[derive(Debug, Clone)]
pub struct Case {
    /// The seed of the scenario.
    pub seed: u64,
    /// How the ladder ended; a reason if it had no result at all.
    pub reached: Result<Found, String>,
}

/// A rung and the truth.
#[derive(Debug, Clone)]
pub struct Found {
    /// The last rung.
    pub level: Level,
    /// Why it was the last.
    pub verdict: Verdict,
    /// The time of the whole ladder, s.
    pub seconds: f64,
    /// The time of its last rung, s.
    pub last_rung: f64,
    /// What the ladder estimated.
    pub estimate: Difference,
    /// Whether all checks of the rung hold.
    pub passes: bool,
    /// How far the rung is from the fine run; a reason if there is none.
    pub truth: Result<Difference, String>,
}

impl Found {
    /// Whether the accuracy was promised and not kept.
    pub fn is_missed(&self, accuracy: f64) -> bool {
        let truth = self.truth.as_ref().map_or(0.0, Difference::promised);
        self.verdict == Verdict::Met && truth > accuracy
    }

    /// The estimated error over the true one: below 1 it was understated.
    pub fn reliability(&self) -> Option<f64> {
        let truth = self.truth.as_ref().ok()?.promised();
        (truth > 0.0).then(|| self.estimate.promised() / truth)
    }
}

/// Judges the scenario of a seed at one accuracy, as `run` reaches it; `clock` tells seconds of computing. A ladder that
/// takes longer than `longest` has no result.
pub fn judge(seed: u64, accuracy: f64, longest: f64, clock: &dyn Fn() -> f64) -> Case {
    let scenario = random_scenarios::scenario(seed);
    let cycles = scenario.run().cycles.unwrap_or(0.0);
    let end = clock() + longest;
    let go_on = || clock() < end;
    let climbed = refinement::climb(
        &scenario,
        cycles,
        accuracy,
        Budget::UNLIMITED,
        &go_on,
        clock,
    );
    let reached = climbed.map_err(|error| error.to_string()).map(|reached| {
        let level = reached.rung.level.clone();
        let fine = finer(&level);
        let difference = |fine: &Level| {
            let end = clock() + FINE_RUN * longest;
            let session = run_on(&scenario, fine, cycles, &|| clock() < end)?;
            let fine = Outcome::from_session(&session);
            Ok(reached.rung.outcome.difference_from(&fine))
        };
        // Cells of the same spacing, and, where they do not confirm the run, those of one that nothing is known of.
        let is_confirmed = |truth: &Difference| {
            truth.promised() <= accuracy.min(UNDERSTATED * reached.error.promised())
        };
        let truth = match difference(&fine) {
            Ok(truth) if is_confirmed(&truth) => Ok(truth),
            truth => {
                let apart = Level {
                    nodes: None,
                    ..fine
                };
                match (truth, difference(&apart)) {
                    (Ok(one), Ok(other)) if other.promised() < one.promised() => Ok(other),
                    (Err(_), other) => other,
                    (one, _) => one,
                }
            }
        };
        Found {
            level,
            verdict: reached.verdict,
            seconds: reached.seconds,
            last_rung: reached.rung.seconds,
            estimate: reached.error,
            passes: passes(&reached.rung.session),
            truth,
        }
    });
    Case { seed, reached }
}

/// Runs the scenario of a seed on cells and steps drawn at random and estimates its error with
/// `refinement::estimate`: the estimate and the difference from a much finer run.
///
/// # Errors
/// A reason, if one of the runs does not come to its end.
pub fn judge_estimate(seed: u64) -> Result<(Difference, Difference), String> {
    let scenario = random_scenarios::scenario(seed);
    let cycles = scenario.run().cycles.unwrap_or(0.0);
    let mut draw = Random::new(!seed);
    let turns = scenario.setup().drive.frequency_ratio().max(1.0);
    let level = Level {
        points: draw.log_between(24.0, 160.0).round() as usize,
        steps: (draw.log_between(12.0, 120.0) * turns).round() as u32,
        ..Level::from_scenario(&scenario)
    };
    let run = |level: &Level| run_on(&scenario, level, cycles, &|| true);
    let session = run(&level)?;
    let estimate = refinement::estimate(&session, &|| true);
    let estimate = estimate.map_err(|error| error.to_string())?;
    let fine = Outcome::from_session(&run(&finer(&level))?);
    Ok((
        estimate,
        Outcome::from_session(&session).difference_from(&fine),
    ))
}

/// Runs the scenario of a seed unchanged: how far it is from a much finer run, and whether all its checks hold.
///
/// # Errors
/// A reason, if one of the runs does not come to its end.
fn judge_checks(seed: u64) -> Result<(Difference, bool), String> {
    let scenario = random_scenarios::scenario(seed);
    let cycles = scenario.run().cycles.unwrap_or(0.0);
    let level = Level::from_scenario(&scenario);
    let session = run_on(&scenario, &level, cycles, &|| true)?;
    let fine = run_on(&scenario, &finer(&level), cycles, &|| true)?;
    let truth = Outcome::from_session(&session).difference_from(&Outcome::from_session(&fine));
    Ok((truth, passes(&session)))
}

/// Whether all checks of a run hold.
fn passes(session: &Session) -> bool {
    session.checks().iter().all(Check::holds)
}

/// How many runs fail and pass the checks, of those that are right to 1e-2, and of those whose volume or work is wrong.
pub fn tally_checks(seeds: impl Iterator<Item = u64>) -> [[usize; 2]; 2] {
    let (mut right, mut wrong) = ([0; 2], [0; 2]);
    for (truth, passes) in seeds.filter_map(|seed| judge_checks(seed).ok()) {
        if truth.promised() == 0.0 {
            continue;
        }
        if truth.promised() <= 1e-2 {
            right[usize::from(passes)] += 1;
        } else if truth[Quantity::Volume].max(truth[Quantity::Energy]) > 1e-2 {
            wrong[usize::from(passes)] += 1;
        }
    }
    [right, wrong]
}

/// The level that judges another one.
fn finer(level: &Level) -> Level {
    Level {
        tolerance: level.tolerance.map(|tolerance| tolerance / FINER_JUMPS),
        ..level.scaled(FINER, FINER)
    }
}

/// A scenario on a level, at its end.
fn run_on(
    scenario: &Scenario,
    level: &Level,
    cycles: f64,
    go_on: &dyn Fn() -> bool,
) -> Result<Session, String> {
    let scenario = level.of_scenario(scenario);
    let scenario = scenario.map_err(|error| error.to_string())?;
    let ended = refinement::run(&scenario, cycles, go_on);
    ended.map_err(|error| error.to_string())
}

/// The value at a share (0 to 1) of sorted numbers; NaN without any.
pub fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted: Vec<f64> = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = (share * (sorted.len().max(1) - 1) as f64).round() as usize;
    sorted.get(at).copied().unwrap_or(f64::NAN)
}
