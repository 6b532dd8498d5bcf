//! The ladder: levels from coarse to fine, until the measured error is small enough.
//!
//! The first rung comes with twins, one with fewer cells, one with fewer steps and one with longer jumps, so that their
//! errors are known separately. Each further rung refines the dominant source; the second, if more follow, comes with
//! another twin for jumps that it does not refine, since on few cells a jump has another error than on many. A search
//! with limited time begins with the coarsest rung whatever the accuracy, so that more time never gives a worse result.

use std::time::Instant;

use thiserror::Error;

use super::budget::Budget;
use super::level::{Level, MOST_TOLERANT, Ratio};
use super::outcome::{Difference, Outcome};
use super::rung::{Rung, Top, run_in_part};
use crate::contact::indenter::Indenter;
use crate::math::grid::RadialGrid;
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::scenario::spec::Passage;
use crate::simulation::placing;

/// The order of convergence expected in choosing the next rung.
const EXPECTED_ORDER: f64 = 1.7;

/// The estimate must be below this fraction of the accuracy, since it has an error itself.
const MARGIN: f64 = 0.8;

/// The accuracy for which the coarsest first rung is chosen.
const COARSE: f64 = 1e-2;

/// A last rung is not worth its time if it may cost less than this many times the previous one.
const LEAST_GAIN: f64 = 1.5;

/// Cells and steps of the run that places the first nodes, relative to the first rung: it needs enough cells to resolve
/// the scar.
const PILOT: Ratio = [1.0, 0.5, 1.0];

/// Maximum number of jumps of that run. On few cells and steps, jumps may never settle, since a node touches and leaves
/// in turn, a few cycles each (Fig. 3 at 10⁶ cycles: 73,763 jumps); by then the scar has the shape that cells need.
const PILOT_JUMPS: u64 = 500;

/// Runs of at least this many periods of the motion jump over cycles.
const WORTH_JUMPING: f64 = 100.0;

/// Minimum and maximum refinement of the next rung. With a whole number, both rungs would use the same moments and
/// radii, and their difference would not show what both miss.
const STRIDE: (f64, f64) = (1.6, 2.7);

/// How much coarser the twins of a rung are: no whole number either.
pub(super) const TWIN: f64 = 1.7;

/// The finest level tried.
const MOST_POINTS: usize = 20_000;
const MOST_STEPS: u32 = 100_000;

/// The ladder ends after this many consecutive rungs without progress.
const MOST_STALLS: u32 = 3;

/// Why a ladder ends.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// The accuracy has been met.
    Met,
    /// The time is up.
    OutOfTime,
    /// The user interrupted a search that [a run follows](Budget::for_run).
    Interrupted,
    /// The finest level has been reached.
    Finest,
    /// Finer levels no longer come nearer.
    Stalled,
    /// Nothing has worn, so there is no scar to resolve.
    Unworn,
    /// No level could be run to the end; the reason.
    Failed(String),
}

/// The end of a ladder.
#[derive(Debug, Clone)]
pub struct Reached {
    /// The last rung.
    pub rung: Rung,
    /// Its estimated error.
    pub error: Difference,
    /// Whether the accuracy was met, or why the ladder ended first.
    pub verdict: Verdict,
    /// The time of the search, s.
    pub seconds: f64,
}

/// Why a search has no result.
#[derive(Debug, Error)]
pub enum SearchError {
    /// Time ran out before the coarsest level finished.
    #[error("no level of refinement ended in time")]
    Unended(Level),
    /// A level was refused, no level finished, or an interrupt.
    #[error(transparent)]
    Session(#[from] SessionError),
}

/// Runs `scenario` over `cycles` on finer and finer levels until the worn depth and the volume have an estimated error
/// of at most `accuracy`, or the `budget` is spent: the result is then the last level that finished. `go_on` is called
/// at every step; if it returns false, there is no result, unless a run follows.
///
/// # Errors
/// [`SearchError::Unended`] if the budget ends before the coarsest level does; an error if a level is refused, if no
/// level finishes, or on an interrupt.
pub fn run_to_accuracy(
    scenario: &Scenario,
    cycles: f64,
    accuracy: f64,
    budget: Budget,
    go_on: &dyn Fn() -> bool,
) -> Result<Reached, SearchError> {
    let begin = Instant::now();
    let clock = || begin.elapsed().as_secs_f64();
    climb(scenario, cycles, accuracy, budget, go_on, &clock)
}

/// As [`run_to_accuracy`], with the seconds of another clock.
///
/// # Errors
/// As for [`run_to_accuracy`].
pub fn climb(
    scenario: &Scenario,
    cycles: f64,
    accuracy: f64,
    budget: Budget,
    go_on: &dyn Fn() -> bool,
    clock: &dyn Fn() -> f64,
) -> Result<Reached, SearchError> {
    let begin = clock();
    let ladder = Ladder {
        scenario,
        cycles,
        accuracy,
        budget,
        run: &run_in_part,
        go_on,
        spent: &|| clock() - begin,
        failures: 0,
    };
    ladder.climb()
}

/// Why a level has no result.
#[derive(Debug)]
enum Failure {
    /// Time ran out during the level.
    Late,
    /// It could not be run to the end; the reason.
    Broken(String),
    /// The whole search ends.
    Over(SessionError),
}

/// Runs a scenario to a cycle, or to a number of jumps before it, while its callback returns true.
type RunLevel<'a> =
    dyn Fn(&Scenario, f64, u64, &dyn Fn() -> bool) -> Result<Session, SessionError> + 'a;

/// Chooses levels, runs and judges them.
struct Ladder<'a> {
    scenario: &'a Scenario,
    cycles: f64,
    accuracy: f64,
    budget: Budget,
    run: &'a RunLevel<'a>,
    go_on: &'a dyn Fn() -> bool,
    /// Time since the search began, s.
    spent: &'a dyn Fn() -> f64,
    /// Number of consecutive levels that could not be run to the end.
    failures: u32,
}

impl Ladder<'_> {
    fn climb(mut self) -> Result<Reached, SearchError> {
        let mut top = self.first()?;
        let mut planned = self.plan(&top);
        let enough = MARGIN * self.accuracy;
        let mut is_second = true;
        let mut stalls = u32::from(top.is_unworn());
        let verdict = loop {
            if top.promised() <= enough && !top.is_unworn() {
                break Verdict::Met;
            } else if planned.points > MOST_POINTS || planned.steps > MOST_STEPS {
                break Verdict::Finest;
            } else if stalls >= MOST_STALLS {
                break if top.is_unworn() {
                    Verdict::Unworn
                } else {
                    Verdict::Stalled
                };
            }
            if !self.affordable(&mut planned, &top) {
                break self.out_of_time();
            }
            match self.run(&planned) {
                Ok(rung) => {
                    let sources = top.errors_of(&rung);
                    let mut next = Top { rung, sources };
                    if std::mem::take(&mut is_second) && next.promised() > enough {
                        self.measure_jumps(&mut next, &top.rung.level);
                    }
                    // If nothing wears, work and forces keep converging; stop once they are near enough.
                    let is_nearer = next.promised() < 0.9 * top.promised()
                        && !(next.is_unworn() && next.promised() <= enough)
                        && !self.is_out_of_reach([&top, &next]);
                    stalls = if is_nearer { 0 } else { stalls + 1 };
                    stalls += u32::from(next.is_unworn());
                    planned = self.plan(&next);
                    top = next;
                }
                Err(Failure::Broken(why)) if self.failures > MOST_STALLS => {
                    break Verdict::Failed(why);
                }
                Err(Failure::Broken(_)) => planned = planned.refined([1.0, 2.0, 1.0]),
                Err(Failure::Late) => break self.out_of_time(),
                Err(Failure::Over(error)) => return Err(error.into()),
            }
        };
        Ok(Reached {
            error: top.error(),
            rung: top.rung,
            verdict,
            seconds: (self.spent)(),
        })
    }

    /// Whether no level is fine enough at the pace from one rung to the next. If time is limited, any progress is
    /// worth it.
    fn is_out_of_reach(&self, [before, after]: [&Top; 2]) -> bool {
        let level = &after.rung.level;
        let [cells, steps, _] = level.ratio(&before.rung.level);
        let left = [
            MOST_POINTS as f64 / level.points as f64,
            f64::from(MOST_STEPS) / f64::from(level.steps),
        ];
        let pace = (after.promised() / before.promised()).ln() / cells.max(steps).ln();
        let finest = after.promised() * left[0].min(left[1]).powf(pace);
        !self.budget.is_limited() && finest > self.accuracy
    }

    /// Runs the first rung, refining it until it does not break down.
    fn first(&mut self) -> Result<Top, SearchError> {
        let aim = if self.budget.is_limited() {
            self.accuracy.max(COARSE)
        } else {
            self.accuracy
        };
        let mut base = first(self.scenario, self.cycles, aim);
        loop {
            match self.run_first(&mut base, aim) {
                Ok(top) => return Ok(top),
                Err(Failure::Broken(why)) if self.failures > MOST_STALLS => {
                    return Err(SessionError::Unfinished(why).into());
                }
                Err(Failure::Broken(_)) => base = base.refined([2.0, 2.0, 1.0]),
                Err(Failure::Late) => return Err(SearchError::Unended(base)),
                Err(Failure::Over(error)) => return Err(error.into()),
            }
        }
    }

    /// Runs a first rung and its twins, with the jumps and nodes that suit its scar.
    fn run_first(&mut self, base: &mut Level, aim: f64) -> Result<Top, Failure> {
        base.nodes = None;
        let placing = self.placing().is_some();
        if placing {
            let pilot = self.run_in_part(&base.refined(PILOT), PILOT_JUMPS)?;
            base.choose_tolerance(aim, &pilot.outcome);
            base.nodes = self.placed(&pilot.outcome, base.points);
        }
        let mut twins = Vec::new();
        for source in 0..base.sources() {
            let twin = self.run(&base.refined(coarser(source)))?;
            if twins.is_empty() && !placing {
                base.choose_tolerance(aim, &twin.outcome);
            }
            twins.push(twin);
        }
        let rung = self.run(base)?;
        let twins = twins.iter().enumerate();
        let sources = twins.map(|(source, twin)| rung.error_by(twin, source));
        let sources = sources.collect();
        Ok(Top { rung, sources })
    }

    /// Measures the error of jumps by a twin, if the rung after `before` has the same. A twin that does not end leaves the
    /// error that `before` had.
    fn measure_jumps(&mut self, top: &mut Top, before: &Level) {
        if let Some(error) = top.sources.get_mut(JUMPS)
            && top.rung.level.tolerance == before.tolerance
            && let Ok(twin) = self.run(&top.rung.level.refined(coarser(JUMPS)))
        {
            *error = top.rung.error_by(&twin, JUMPS);
        }
    }

    /// Runs a level, and abandons it when it exceeds the remaining budget.
    fn run(&mut self, level: &Level) -> Result<Rung, Failure> {
        self.run_in_part(level, u64::MAX)
    }

    fn run_in_part(&mut self, level: &Level, most_jumps: u64) -> Result<Rung, Failure> {
        let (go_on, spent) = (self.go_on, self.spent);
        let start = spent();
        let deadline = start + self.budget.left(start);
        let keeps = self.budget.runs_again;
        let is_late = || spent() > deadline || keeps && !go_on();
        let scenario = level.of_scenario(self.scenario);
        let scenario = scenario.map_err(|refused| Failure::Over(refused.into()))?;
        let ended = (self.run)(&scenario, self.cycles, most_jumps, &|| {
            go_on() && !is_late()
        });
        let seconds = spent() - start;
        match ended {
            Ok(session) => {
                self.failures = 0;
                Ok(Rung {
                    level: level.clone(),
                    outcome: Outcome::from_session(&session),
                    session,
                    seconds,
                })
            }
            Err(SessionError::Interrupted) if is_late() && (keeps || go_on()) => Err(Failure::Late),
            Err(SessionError::Interrupted) => Err(Failure::Over(SessionError::Interrupted)),
            Err(error) => {
                self.failures += 1;
                Err(Failure::Broken(error.to_string()))
            }
        }
    }

    /// Whether there is time for the level `planned` after `top`, judging by the time of `top`. A level that would take
    /// too long is made coarser, if the remaining refinement is worth its time.
    fn affordable(&self, planned: &mut Level, top: &Top) -> bool {
        let left = self.budget.left((self.spent)()) / top.rung.seconds;
        let ratio = planned.ratio(&top.rung.level);
        let work: f64 = ratio.iter().product();
        if work > left && left >= LEAST_GAIN {
            let share = left.ln() / work.ln();
            *planned = self.finer(top, ratio.map(|ratio| ratio.powf(share)));
        }
        work.min(LEAST_GAIN) <= left
    }

    fn out_of_time(&self) -> Verdict {
        if (self.go_on)() {
            Verdict::OutOfTime
        } else {
            Verdict::Interrupted
        }
    }

    /// Returns the shape to place nodes for; `None` if the scenario determines the nodes.
    fn placing(&self) -> Option<&Indenter> {
        let setup = self.scenario.setup();
        let is_open = self.scenario.spec().numerics.grid.is_none();
        (setup.method.traits().follows_kinks && is_open).then_some(&setup.indenter)
    }

    /// Places nodes for a level with `cells` cells after a run with this outcome; `None` if there is no scar, or the
    /// nodes would not resolve it.
    fn placed(&self, outcome: &Outcome, cells: usize) -> Option<RadialGrid> {
        let grid = placing::place(&outcome.grid, &outcome.profile, cells, self.placing()?)?;
        outcome.is_resolved_by(&grid).then_some(grid)
    }

    /// Plans the level after a rung: finer in each source whose error exceeds its equal share.
    fn plan(&self, top: &Top) -> Level {
        let allowed = MARGIN * self.accuracy / (top.sources.len() as f64).sqrt();
        let mut finer = [1.0; 3];
        for (finer, source) in finer.iter_mut().zip(&top.sources) {
            let excess = source.promised() / allowed;
            if excess > 1.0 {
                let wanted = (1.1 * excess).powf(1.0 / EXPECTED_ORDER);
                *finer = wanted.clamp(STRIDE.0, STRIDE.1);
            }
        }
        let outcome = &top.rung.outcome;
        let known = top.error().promised().max(MARGIN * self.accuracy);
        if top.is_unworn() {
            finer = [STRIDE.1, STRIDE.0, 1.0];
        } else if outcome.imbalance > known {
            // V and k E_d differ if an edge lies between two nodes, or if a step or a jump is too long: of what the
            // levels do not tell apart, shorter jumps cost the least.
            if finer == [1.0; 3] {
                finer = [STRIDE.0; 3];
            }
            finer[2] = finer[2].max(STRIDE.0);
        }
        self.finer(top, finer)
    }

    /// Refines the level of a rung by `ratio`, and places its cells by the rung's scar.
    fn finer(&self, top: &Top, ratio: Ratio) -> Level {
        let Rung { level, outcome, .. } = &top.rung;
        let mut finer = level.refined(ratio);
        if finer.points != level.points {
            finer.nodes = self.placed(outcome, finer.points);
        }
        finer
    }
}

impl Level {
    /// Converts the accuracy, relative to the scar's depth, to a tolerance of jumps, relative to the contact's depth.
    fn choose_tolerance(&mut self, aim: f64, outcome: &Outcome) {
        let scar = outcome.scar_depth() / outcome.depth;
        if let Some(tolerance) = &mut self.tolerance
            && scar > 0.0
        {
            *tolerance = (aim * scar).clamp(1e-9, MOST_TOLERANT / 2.0);
        }
    }
}

/// The place of jumps in a [`Ratio`].
const JUMPS: usize = 2;

/// The refinement of a twin, which is coarser in one source.
fn coarser(source: usize) -> Ratio {
    let mut ratio = [1.0; 3];
    ratio[source] = 1.0 / TWIN;
    ratio
}

/// Returns the first level that is useful for a scene.
fn first(scenario: &Scenario, cycles: f64, accuracy: f64) -> Level {
    let setup = scenario.setup();
    let finer = (COARSE / accuracy).max(1.0);
    let turns = setup.drive.frequency_ratio().max(1.0);
    let period = setup.drive.repeats_after().map(f64::from);
    let is_long = period.is_some_and(|period| cycles >= WORTH_JUMPING * period);
    let jumps = match scenario.spec().numerics.integrator {
        Some(passage) => passage == Passage::CycleJump,
        None => is_long && setup.wear.is_some() && setup.drive.tangential().is_some(),
    };
    let points = (20.0 * finer.powf(0.4)).round() as usize;
    let steps = (12.0 * finer.powf(0.3) * turns).round() as u32;
    Level::new(points, steps, jumps.then(|| (0.1 * accuracy).min(0.05)))
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;
    use crate::scenario::Refusal;

    /// After a level that breaks down, a finer one follows; a scenario that always breaks down has no result.
    #[test]
    fn failures_climb_too_and_end() {
        let tried = RefCell::new(Vec::new());
        let run = |scenario: &Scenario, _: f64, _: u64, _: &dyn Fn() -> bool| {
            tried.borrow_mut().push(Level::from_scenario(scenario));
            Err(SessionError::Scenario(Refusal::from("broke".to_owned())))
        };
        let ladder = Ladder {
            scenario: &Scenario::load("li2019-fig3", &[]).expect("a scenario"),
            cycles: 10.0,
            accuracy: 1e-2,
            budget: Budget::UNLIMITED,
            run: &run,
            go_on: &|| true,
            spent: &|| 0.0,
            failures: 0,
        };
        let error = ladder.climb().expect_err("no result");
        assert!(
            matches!(error, SearchError::Session(SessionError::Unfinished(why)) if why == "broke")
        );
        let tried = tried.into_inner();
        assert_eq!(tried.len() as u32, MOST_STALLS + 1);
        let finer =
            |pair: &[Level]| pair[1].points > pair[0].points && pair[1].steps > pair[0].steps;
        assert!(tried.windows(2).all(finer), "{tried:?}");
    }
}
