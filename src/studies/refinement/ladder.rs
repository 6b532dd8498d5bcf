//! The ladder: levels from coarse to fine, until the measured error is small enough.
//!
//! The first rung comes with two twins, one on fewer cells and one of fewer steps, so that the errors of cells and of time
//! are known apart. Each further rung refines what dominates. A search whose time is limited begins with the coarsest
//! rung whatever the accuracy, so that more time never gives a worse result.

use std::time::Instant;

use thiserror::Error;

use super::level::{Level, MOST_TOLERANT, Ratio};
use super::outcome::{Difference, Outcome};
use super::rung::{Rung, Top, run};
use crate::contact::indenter::Indenter;
use crate::math::abel::AbelMethod;
use crate::math::grid::RadialGrid;
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::simulation::{Integrator, placing};

/// The order by which the next rung is chosen.
const EXPECTED_ORDER: f64 = 1.7;

/// The estimate must be below this part of the accuracy: it is itself a measurement with an error.
const MARGIN: f64 = 0.8;

/// The accuracy that the coarsest first rung is chosen for.
const COARSE: f64 = 1e-2;

/// A last rung that may cost less than this many times the one before it is not worth its time.
const LEAST_GAIN: f64 = 1.5;

/// The run that places the first nodes: this many times the cells and steps of the first rung's twin. Cells are
/// what it must see the scar with.
const PILOT: Ratio = [1.0, 0.5, 1.0];

/// What a rung that is run again takes of a budget, in units of its time: no two runs take the same.
const TWICE: f64 = 2.2;

/// Runs of this many periods of the motion jump over cycles.
const WORTH_JUMPING: f64 = 100.0;

/// How much finer the next rung is, at least and at most.
const STRIDE: (f64, f64) = (1.6, 3.0);

/// The twins of a rung are this much coarser. By a whole number, both would see the same moments and radii, and their
/// difference would not show what both miss.
pub(super) const TWIN: f64 = 1.7;

/// The finest level that is tried.
const MOST_POINTS: usize = 20_000;
const MOST_STEPS: u32 = 100_000;

/// The ladder ends after this many rungs in a row without progress.
const MOST_STALLS: u32 = 3;

/// Why a ladder ends.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// The accuracy is met.
    Met,
    /// The time is up.
    OutOfTime,
    /// The user ended the search; only one that [a run follows](Budget::for_run) ends so.
    Interrupted,
    /// The finest level is reached.
    Finest,
    /// Finer levels come no nearer.
    Stalled,
    /// Nothing has worn: there is no scar to be right about.
    Unworn,
    /// No level could be run to the end, for this reason.
    Failed(String),
}

/// The end of a ladder.
#[derive(Debug, Clone)]
pub struct Reached {
    /// The last rung.
    pub rung: Rung,
    /// Its estimated error.
    pub error: Difference,
    /// Whether the accuracy is met, or why the ladder ended before.
    pub verdict: Verdict,
    /// The time of the search, s.
    pub seconds: f64,
}

/// Why a search has no result.
#[derive(Debug, Error)]
pub enum SearchError {
    /// Its time was up before the coarsest level came to its end.
    #[error("no level of refinement ended in time")]
    Unended(Level),
    /// A level that is refused, or none that runs to its end, or an interrupt.
    #[error(transparent)]
    Session(#[from] SessionError),
}

/// How long a search may take.
#[derive(Debug, Clone, Copy)]
pub struct Budget {
    seconds: f64,
    /// Whether the last rung is run again afterwards, within the same time.
    runs_again: bool,
}

impl Budget {
    /// As long as it takes.
    pub const UNLIMITED: Self = Self::of_search(f64::INFINITY);

    /// At most so many seconds for the search alone.
    pub const fn of_search(seconds: f64) -> Self {
        Self {
            seconds,
            runs_again: false,
        }
    }

    /// At most so many seconds for the search and the run that follows on the level it finds. An interrupt ends such a
    /// search with the best level so far.
    pub const fn for_run(seconds: f64) -> Self {
        Self {
            seconds,
            runs_again: true,
        }
    }

    /// The seconds, which may be infinite.
    pub fn seconds(self) -> f64 {
        self.seconds
    }

    fn is_limited(self) -> bool {
        self.seconds.is_finite()
    }

    /// What a level may take if `spent` seconds are over.
    fn left(self, spent: f64) -> f64 {
        (self.seconds - spent) / if self.runs_again { TWICE } else { 1.0 }
    }
}

/// Runs `scenario` over `cycles` on finer and finer levels until the worn depth and the volume have an
/// estimated error of at most `accuracy`, or the `budget` is spent: then the last level that came
/// to its end is the result. `go_on` is asked at every step; if it says no, there is no result, unless a run follows.
///
/// # Errors
/// [`SearchError::Unended`] if the budget ends before the coarsest level does; if a level is refused, if no level runs to
/// its end, or on an interrupt.
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

/// [`run_to_accuracy`] with the seconds of another clock.
///
/// # Errors
/// As there.
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
        run: &run,
        go_on,
        spent: &|| clock() - begin,
        failures: 0,
    };
    ladder.climb()
}

/// Why a level has no result.
#[derive(Debug)]
enum Failure {
    /// The time was up in the middle of it.
    Late,
    /// It could not be run to its end, for this reason.
    Broken(String),
    /// The whole search ends.
    Over(SessionError),
}

/// Runs a scenario to a cycle, as long as it is told to go on.
type Run<'a> = dyn Fn(&Scenario, f64, &dyn Fn() -> bool) -> Result<Session, SessionError> + 'a;

/// Chooses levels, runs and judges them.
struct Ladder<'a> {
    scenario: &'a Scenario,
    cycles: f64,
    accuracy: f64,
    budget: Budget,
    run: &'a Run<'a>,
    go_on: &'a dyn Fn() -> bool,
    /// The time since the search began, s.
    spent: &'a dyn Fn() -> f64,
    /// How many levels in a row could not be run to their end.
    failures: u32,
}

impl Ladder<'_> {
    fn climb(mut self) -> Result<Reached, SearchError> {
        let mut top = self.first()?;
        let mut planned = self.plan(&top);
        let mut stalls = u32::from(top.is_unworn());
        let verdict = loop {
            if top.promised() <= MARGIN * self.accuracy && !top.is_unworn() {
                break Verdict::Met;
            } else if planned.points > MOST_POINTS || planned.steps > MOST_STEPS {
                break Verdict::Finest;
            } else if stalls >= MOST_STALLS {
                break match top.is_unworn() {
                    true => Verdict::Unworn,
                    false => Verdict::Stalled,
                };
            }
            match self.affordable(&mut planned, &top) {
                true => {}
                false => break self.out_of_time(),
            }
            match self.run(&planned) {
                Ok(rung) => {
                    let sources = top.errors_of(&rung);
                    let next = Top { rung, sources };
                    // Where nothing wears, work and forces come nearer for ever; what is near enough ends that.
                    let is_enough = next.promised() <= MARGIN * self.accuracy;
                    let is_nearer = next.promised() < 0.9 * top.promised()
                        && !(next.is_unworn() && is_enough)
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

    /// Whether no level is fine enough at the pace from one rung to the next. Where time is limited, whatever comes nearer
    /// is worth it.
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

    /// The first rung: finer after one that breaks down.
    fn first(&mut self) -> Result<Top, SearchError> {
        let aim = match self.budget.is_limited() {
            true => self.accuracy.max(COARSE),
            false => self.accuracy,
        };
        let mut base = first(self.scenario, self.cycles, aim);
        loop {
            match self.stand(&mut base, aim) {
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
    fn stand(&mut self, base: &mut Level, aim: f64) -> Result<Top, Failure> {
        base.nodes = None;
        let placing = self.placing().is_some();
        if placing {
            let pilot = self.run(&base.refined(PILOT))?;
            base.settle_tolerance(aim, &pilot.outcome);
            base.nodes = self.placed(&pilot.outcome, base.points);
        }
        let mut twins = Vec::new();
        for source in 0..base.sources() {
            let twin = self.run(&base.refined(coarser(source)))?;
            if twins.is_empty() && !placing {
                base.settle_tolerance(aim, &twin.outcome);
            }
            twins.push(twin);
        }
        let rung = self.run(base)?;
        let sources = twins.iter().enumerate().map(|(source, twin)| {
            let ratio = rung.level.ratio(&twin.level)[source];
            twin.outcome.against(&rung.outcome).error_of_finer(ratio)
        });
        let sources = sources.collect();
        Ok(Top { rung, sources })
    }

    /// Runs a level, and leaves it where it takes more than is left of the budget.
    fn run(&mut self, level: &Level) -> Result<Rung, Failure> {
        let (go_on, spent) = (self.go_on, self.spent);
        let start = spent();
        let deadline = start + self.budget.left(start);
        let keeps = self.budget.runs_again;
        let is_late = || spent() > deadline || keeps && !go_on();
        let scenario = level.of_scenario(self.scenario);
        let scenario = scenario.map_err(|refused| Failure::Over(refused.into()))?;
        let ended = (self.run)(&scenario, self.cycles, &|| go_on() && !is_late());
        let seconds = spent() - start;
        match ended {
            Ok(session) => {
                self.failures = 0;
                Ok(Rung {
                    level: level.clone(),
                    outcome: Outcome::of(&session),
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

    /// Whether there is time for the level `planned` after `top`, as far as that tells; a level that would take too
    /// long is made coarser, if what is left of it is worth its time.
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
        match (self.go_on)() {
            true => Verdict::OutOfTime,
            false => Verdict::Interrupted,
        }
    }

    /// The shape that nodes are placed for; `None` if the scenario says where they lie.
    fn placing(&self) -> Option<&Indenter> {
        let setup = self.scenario.setup();
        let is_open = self.scenario.value("numerics.grid").is_none();
        (setup.method == AbelMethod::Product && is_open).then_some(&setup.indenter)
    }

    /// The nodes of a level with `cells` cells after a run that ended so; `None` if it shows no scar, or one that they
    /// would not see.
    fn placed(&self, outcome: &Outcome, cells: usize) -> Option<RadialGrid> {
        let grid = placing::place(&outcome.grid, &outcome.profile, cells, self.placing()?)?;
        outcome.is_seen_by(&grid).then_some(grid)
    }

    /// The level after a rung: finer in what uses up more than its share, where all have equal ones.
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
        if top.is_unworn() {
            finer = [STRIDE.1, STRIDE.0, 1.0];
        } else if finer == [1.0; 3] && outcome.imbalance > MARGIN * self.accuracy {
            // V and k E_d differ where an edge lies between two nodes, or where a step or a jump is too long.
            finer = [STRIDE.0; 3];
        }
        self.finer(top, finer)
    }

    /// The level of a rung refined by `ratio`, its cells placed by the rung's scar.
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
    /// The tolerance of jumps is measured in depths, the accuracy in the depth of the scar.
    fn settle_tolerance(&mut self, aim: f64, outcome: &Outcome) {
        let scar = outcome.scar_depth() / outcome.depth;
        if let Some(tolerance) = &mut self.tolerance
            && scar > 0.0
        {
            *tolerance = (aim * scar).clamp(1e-9, MOST_TOLERANT / 2.0);
        }
    }
}

/// A level coarser in one source than the one beside it.
fn coarser(source: usize) -> Ratio {
    let mut ratio = [1.0; 3];
    ratio[source] = 1.0 / TWIN;
    ratio
}

/// The first rung that is any good for a scene.
fn first(scenario: &Scenario, cycles: f64, accuracy: f64) -> Level {
    let setup = scenario.setup();
    let finer = (COARSE / accuracy).max(1.0);
    let turns = setup.drive.frequency_ratio().max(1.0);
    let period = setup.drive.repeats_after().map(f64::from);
    let is_long = period.is_some_and(|period| cycles >= WORTH_JUMPING * period);
    let jumps = match scenario.value("numerics.integrator") {
        Some(_) => matches!(setup.integrator, Integrator::CycleJump { .. }),
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

    /// A level that breaks down is followed by a finer one, and a scenario that always does has no result.
    #[test]
    fn failures_climb_too_and_end() {
        let tried = RefCell::new(Vec::new());
        let run = |scenario: &Scenario, _: f64, _: &dyn Fn() -> bool| {
            tried.borrow_mut().push(Level::of(scenario));
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
