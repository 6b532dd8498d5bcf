//! The error study: the paper's Fig. 2 and more, for every method over a ladder of N.
//!
//! A [`Study`] names what to try, [`Study::tasks`] splits it, [`Task::run`] compares one method on
//! one grid with theory, and [`report`] makes tables of the results.

use thiserror::Error;

use crate::math::abel::AbelMethod;
use crate::math::invalid::Invalid;
use crate::simulation::Breakdown;

pub mod errors;
mod normal;
pub mod problem;
pub mod report;
mod scene;
mod sliding;

use errors::Errors;
pub use problem::{Problem, Quantity};

/// N of the ladder that is tried if nothing else is asked for.
pub const LADDER: [usize; 5] = [50, 100, 200, 400, 800];

/// What is to be tried.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Study {
    /// The problems; each is tried once.
    pub problems: Vec<Problem>,
    /// N, in any order.
    pub points: Vec<usize>,
    /// Whether runs that take minutes are tried as well.
    pub long: bool,
}

/// One method on one grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Task {
    /// What is solved.
    pub problem: Problem,
    /// With which transforms.
    pub method: AbelMethod,
    /// N.
    pub points: usize,
}

/// What came out of a task.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// What was tried.
    pub task: Task,
    /// The errors of the problem's quantities, in their order; or why there are none.
    pub errors: Result<Vec<Errors>, Stop>,
}

/// Why there is no result.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Stop {
    /// The run broke down.
    #[error(transparent)]
    Breakdown(#[from] Breakdown),
    /// The parts cannot be put together.
    #[error(transparent)]
    Invalid(#[from] Invalid),
}

impl Stop {
    /// The cycle that was reached.
    pub fn cycle(&self) -> f64 {
        match self {
            Self::Breakdown(breakdown) => breakdown.cycle,
            Self::Invalid(_) => 0.0,
        }
    }
}

impl Study {
    /// The tasks, by problem, method and rising N.
    pub fn tasks(&self) -> Vec<Task> {
        let mut points = self.points.clone();
        points.sort_unstable();
        points.dedup();
        let mut tasks = Vec::new();
        for problem in Problem::ALL {
            if !self.problems.contains(&problem) {
                continue;
            }
            for method in AbelMethod::ALL {
                let points = points.iter().copied();
                let points = points.filter(|&points| self.long || !problem.is_long(points));
                tasks.extend(points.map(|points| Task {
                    problem,
                    method,
                    points,
                }));
            }
        }
        tasks
    }
}

impl Task {
    /// Computes and compares; from milliseconds to a minute.
    pub fn run(self) -> Outcome {
        Outcome {
            task: self,
            errors: (self.problem.facts().solve)(self.method, self.points),
        }
    }
}
