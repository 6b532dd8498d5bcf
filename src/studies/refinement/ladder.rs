//! The ladder: levels from coarse to fine, until the measured error is small enough.
//!
//! The first rung comes with two twins, one on fewer cells and one of fewer steps, so that the errors of cells and of time
//! are known apart. Each further rung refines what dominates. A difference D of two levels, the one ρ times finer, tells
//! the error of the finer one:
//!
//! ```text
//! e = D/(ρᵖ − 1),   p = 1.1,   but at least e of the rung before/ρ²
//! ```
//!
//! Where cells and steps are both refined, D is shared out as the errors stood before. Errors of several sources add up
//! as independent ones do: as the root of the sum of squares.

use super::level::{Level, MOST_TOLERANT, Ratio};
use super::outcome::{Difference, Outcome};
use crate::contact::indenter::Indenter;
use crate::math::abel::AbelMethod;
use crate::math::grid::RadialGrid;
use crate::scenario::Scenario;
use crate::simulation::Integrator;

/// The order by which the next rung is chosen.
const EXPECTED_ORDER: f64 = 1.7;

/// The estimate must be below this part of the accuracy: it is itself a measurement with an error.
const MARGIN: f64 = 0.8;

/// The accuracy that the coarsest first rung is chosen for.
const COARSE: f64 = 1e-2;

/// The part of the budget after which a first rung that is not done gives way to the coarsest one.
const FIRST_TRY: f64 = 0.5;

/// The run that places the first nodes: this many times the cells and steps of the first rung's twin. Cells are
/// what it must see the scar with.
const PILOT: [f64; 2] = [1.0, 0.5];

/// Runs of this many periods of the motion jump over cycles.
const WORTH_JUMPING: f64 = 100.0;

/// How much finer the next rung is, at least and at most.
const STRIDE: (f64, f64) = (1.6, 3.0);

/// The twins of a rung are this much coarser.
const TWIN: f64 = 2.0;

/// The finest level that is tried.
const MOST_POINTS: usize = 20_000;
const MOST_STEPS: u32 = 100_000;

/// The ladder ends after this many rungs in a row without progress.
const MOST_STALLS: u32 = 3;

/// One run of the ladder.
#[derive(Debug, Clone)]
pub struct Rung {
    /// How finely it was computed.
    pub level: Level,
    /// How it ended.
    pub outcome: Outcome,
    /// What it cost, s.
    pub seconds: f64,
}

/// Why a ladder ends.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// The accuracy is met.
    Met,
    /// The time is up.
    OutOfTime,
    /// The finest level is reached.
    Finest,
    /// Finer levels come no nearer.
    Stalled,
    /// Nothing has worn: there is no scar to be right about.
    Unworn,
    /// No level could be run to the end, for this reason.
    Failed(String),
}

/// What is to be done next.
#[derive(Debug, Clone, PartialEq)]
pub enum Next {
    /// Run this level and report it: it may be the result.
    Run(Level),
    /// Run this level and report it: a coarser twin, which serves only to estimate an error.
    Twin(Level),
    /// The last rung that was run is the result.
    Done(Verdict),
}

/// A rung and its errors, by what they come from.
#[derive(Debug, Clone)]
struct Top {
    rung: Rung,
    /// Those of cells, of steps and of jumps.
    sources: Vec<Difference>,
}

impl Top {
    fn error(&self) -> Difference {
        let squares = self.sources.iter().fold(Difference::NONE, |sum, one| {
            sum.with(one, |sum, one| sum + one * one)
        });
        let sum = squares.with(&squares, |sum, _| sum.sqrt());
        sum.as_estimate()
    }

    /// The error that a promise is held against: V and k E_d must agree as well, since they are two computations of one
    /// number.
    fn promised(&self) -> f64 {
        self.error().promised().max(self.rung.outcome.imbalance)
    }
}

/// Chooses levels and judges them; whoever drives it does the running.
#[derive(Debug, Clone)]
pub struct Ladder {
    accuracy: f64,
    budget: f64,
    spent: f64,
    /// The accuracy that the first rung is chosen for.
    aim: f64,
    /// The coarsest first rung, where time runs short before another one is done.
    coarsest: Option<Level>,
    /// The shape that nodes are placed for; `None` if the scenario says where they lie.
    placing: Option<Indenter>,
    base: Level,
    /// Whether the run that places the first nodes is still to be made.
    wants_pilot: bool,
    /// The twins that have been run for the present base.
    twins: Vec<Rung>,
    top: Option<Top>,
    planned: Level,
    failures: u32,
    stalls: u32,
    last_failure: String,
    /// Whether the time was up in the middle of a level.
    is_cut: bool,
}

impl Ladder {
    /// A ladder for `scenario` over `cycles` to a worn depth and a volume with errors of at most `accuracy`, that begins no
    /// rung that would end after `budget` seconds.
    pub fn new(scenario: &Scenario, cycles: f64, accuracy: f64, budget: f64) -> Self {
        let base = first(scenario, cycles, accuracy);
        let coarsest = first(scenario, cycles, COARSE);
        let places = scenario.setup().method == AbelMethod::Product
            && scenario.value("numerics.grid").is_none();
        let mut ladder = Self {
            accuracy,
            budget,
            spent: 0.0,
            aim: accuracy,
            coarsest: (coarsest.points < base.points).then_some(coarsest),
            placing: places.then(|| scenario.setup().indenter.clone()),
            wants_pilot: false,
            twins: Vec::new(),
            top: None,
            planned: base.clone(),
            base,
            failures: 0,
            stalls: 0,
            last_failure: String::new(),
            is_cut: false,
        };
        ladder.begin();
        ladder
    }

    /// Begins with the present base: with the run that places its nodes, if it is to have its own.
    fn begin(&mut self) {
        self.wants_pilot = self.placing.is_some();
        self.base.nodes = None;
        self.planned = match self.wants_pilot {
            true => self.base.refined([PILOT[0], PILOT[1], 1.0]),
            false => self.twin_of_base(),
        };
    }

    /// The next twin of the base, or the base itself after the last one.
    fn twin_of_base(&self) -> Level {
        match self.twins.len() {
            known if known == self.base.sources() => self.base.clone(),
            source => self.base.refined(coarser(source)),
        }
    }

    /// The level to run now, or that the last rung is the result.
    pub fn next(&self) -> Next {
        let failed = || Next::Done(Verdict::Failed(self.last_failure.clone()));
        let Some(top) = &self.top else {
            return match self.failures > MOST_STALLS {
                true => failed(),
                false if self.twins.len() == self.base.sources() => Next::Run(self.planned.clone()),
                false => Next::Twin(self.planned.clone()),
            };
        };
        let is_unworn = top.rung.outcome.volume <= 0.0;
        if top.promised() <= MARGIN * self.accuracy && !is_unworn {
            return Next::Done(Verdict::Met);
        }
        if self.failures > MOST_STALLS {
            return failed();
        }
        Next::Done(
            if self.planned.points > MOST_POINTS || self.planned.steps > MOST_STEPS {
                Verdict::Finest
            } else if self.stalls >= MOST_STALLS && is_unworn {
                Verdict::Unworn
            } else if self.stalls >= MOST_STALLS {
                Verdict::Stalled
            } else if !self.is_cut && self.affords(&self.planned) {
                return Next::Run(self.planned.clone());
            } else {
                Verdict::OutOfTime
            },
        )
    }

    /// Takes the outcome of a run at the requested level, and the seconds that it took.
    pub fn report(&mut self, outcome: Outcome, seconds: f64) {
        let next = self.next();
        self.spent += seconds;
        self.failures = 0;
        let (Next::Run(level) | Next::Twin(level)) = next else {
            return;
        };
        let rung = Rung {
            level,
            outcome,
            seconds,
        };
        match self.top.take() {
            Some(top) => self.climb(&top, rung),
            None if self.wants_pilot => {
                self.settle_tolerance(&rung.outcome);
                self.base.nodes = self.placed(&rung.outcome, self.base.points);
                self.wants_pilot = false;
                self.planned = self.twin_of_base();
            }
            None if self.twins.len() < self.base.sources() => {
                if self.twins.is_empty() && self.placing.is_none() {
                    self.settle_tolerance(&rung.outcome);
                }
                self.twins.push(rung);
                self.planned = self.twin_of_base();
            }
            None => self.stand(rung),
        }
    }

    /// The nodes of a level with `cells` cells after a run that ended so; `None` if it shows no scar.
    fn placed(&self, outcome: &Outcome, cells: usize) -> Option<RadialGrid> {
        outcome.place(cells, self.placing.as_ref()?)
    }

    /// Takes word that the level could not be run to its end: the next one is finer.
    pub fn fail(&mut self, why: String, seconds: f64) {
        self.spent += seconds;
        self.failures += 1;
        self.last_failure = why;
        match self.top.take() {
            None => {
                self.base = self.base.refined([2.0, 2.0, 1.0]);
                self.twins.clear();
                self.begin();
            }
            Some(top) => {
                self.planned = self.planned.refined([1.0, TWIN, 1.0]);
                self.top = Some(top);
            }
        }
    }

    /// How long the search may take before the level that runs now is [cut](Self::cut), s.
    pub fn deadline(&self) -> f64 {
        match (&self.top, &self.coarsest) {
            (Some(_), _) => self.budget,
            (None, Some(_)) => FIRST_TRY * self.budget,
            // Without this one there is no result.
            (None, None) => f64::INFINITY,
        }
    }

    /// Takes word that the time was up in the middle of a level: the last rung is the result. Without one, the ladder
    /// begins anew from the coarsest.
    pub fn cut(&mut self, seconds: f64) {
        self.spent += seconds;
        match self.coarsest.take() {
            Some(coarsest) if self.top.is_none() => {
                (self.base, self.aim) = (coarsest, COARSE);
                self.twins.clear();
                self.begin();
            }
            _ => self.is_cut = true,
        }
    }

    /// The rung reached and its estimated error, once there is one.
    pub fn reached(&self) -> Option<(&Rung, Difference)> {
        let top = self.top.as_ref()?;
        Some((&top.rung, top.error()))
    }

    /// The time that all runs took, s.
    pub fn spent(&self) -> f64 {
        self.spent
    }

    /// Whether there is time for a level, as far as the last rung tells.
    fn affords(&self, level: &Level) -> bool {
        self.top.as_ref().is_none_or(|top| {
            let work: f64 = level.ratio(&top.rung.level).iter().product();
            self.spent + top.rung.seconds * work <= self.budget
        })
    }

    /// The tolerance of jumps is measured in depths, the accuracy in the depth of the scar.
    fn settle_tolerance(&mut self, outcome: &Outcome) {
        let scar = outcome.scar_depth() / outcome.depth;
        if let Some(tolerance) = &mut self.base.tolerance
            && scar > 0.0
        {
            *tolerance = (self.aim * scar).clamp(1e-9, MOST_TOLERANT / 2.0);
        }
    }

    /// The first rung, all of whose twins are there.
    fn stand(&mut self, rung: Rung) {
        let twins = self.twins.iter().enumerate();
        let sources = twins.map(|(source, twin)| {
            let ratio = rung.level.ratio(&twin.level)[source];
            twin.outcome.against(&rung.outcome).error_of_finer(ratio)
        });
        let sources = sources.collect();
        self.settle(Top { rung, sources });
    }

    /// A rung above another one.
    fn climb(&mut self, before: &Top, rung: Rung) {
        let ratios = rung.level.ratio(&before.rung.level);
        let difference = before.rung.outcome.against(&rung.outcome);
        let known = || before.sources.iter().zip(ratios);
        let refined = || known().filter(|(_, ratio)| *ratio > 1.0);
        let total = refined().fold(Difference::NONE, |sum, (error, _)| {
            sum.with(error, |sum, error| sum + error)
        });
        let alone = refined().count() == 1;
        let after = |(before, ratio): (&Difference, f64)| {
            if ratio <= 1.0 {
                return *before;
            }
            let share = before.with(&total, |error, total| match total {
                _ if alone => 1.0,
                0.0 => 1.0,
                total => error / total,
            });
            let own = share.with(&difference, |share, d| share * d);
            own.error_above(before, ratio)
        };
        let top = Top {
            sources: known().map(after).collect(),
            rung,
        };
        let nearer = top.promised() < 0.9 * before.promised();
        self.stalls = if nearer { 0 } else { self.stalls + 1 };
        self.settle(top);
    }

    /// Takes a rung and plans the next one: finer in what uses up more than its share, where all have equal ones.
    fn settle(&mut self, top: Top) {
        let allowed = MARGIN * self.accuracy / (top.sources.len() as f64).sqrt();
        let mut finer = [1.0; 3];
        for (finer, source) in finer.iter_mut().zip(&top.sources) {
            let excess = source.promised() / allowed;
            if excess > 1.0 {
                let wanted = (1.1 * excess).powf(1.0 / EXPECTED_ORDER);
                *finer = wanted.clamp(STRIDE.0, STRIDE.1);
            }
        }
        if top.rung.outcome.volume <= 0.0 {
            finer = [STRIDE.1, 1.0, 1.0];
            self.stalls += 1;
        } else if finer == [1.0; 3] && top.rung.outcome.imbalance > MARGIN * self.accuracy {
            // V and k E_d part where an edge lies between two nodes, or where a jump is too long.
            finer = [STRIDE.0, 1.0, STRIDE.0];
        }
        let mut planned = top.rung.level.refined(finer);
        if planned.points != top.rung.level.points {
            planned.nodes = self.placed(&top.rung.outcome, planned.points);
        }
        self.planned = planned;
        self.top = Some(top);
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
    Level {
        points: (20.0 * finer.powf(0.4)).round() as usize,
        steps: (12.0 * finer.powf(0.3) * turns).round() as u32,
        tolerance: jumps.then(|| (0.1 * accuracy).min(0.05)),
        nodes: None,
    }
}
