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
            let most = problem.most_points().filter(|_| !self.long);
            for method in AbelMethod::ALL {
                let points = points.iter().copied();
                let points = points.filter(|&n| most.is_none_or(|most| n <= most));
                tasks.extend(points.map(|points| Task {
                    problem,
                    method,
                    points,
                }));
            }
        }
        tasks
    }

    /// The problems and N that only a long study tries.
    pub fn left_for_long(&self) -> Vec<(Problem, usize)> {
        let mut left = Vec::new();
        for &problem in &self.problems {
            let most = problem.most_points().filter(|_| !self.long);
            let points = self.points.iter().copied();
            left.extend(
                points
                    .filter(|&n| most.is_some_and(|most| n > most))
                    .map(|n| (problem, n)),
            );
        }
        left
    }
}

impl Task {
    /// Computes and compares; from milliseconds to a minute.
    pub fn run(self) -> Outcome {
        let solve = match self.problem {
            Problem::Hertz => normal::hertz,
            Problem::Cone => normal::cone,
            Problem::Quartic => normal::quartic,
            Problem::TruncatedParaboloid => normal::truncated_paraboloid,
            Problem::FlatPunch => normal::flat_punch,
            Problem::Cattaneo => sliding::cattaneo,
            Problem::Limit => sliding::limit,
        };
        Outcome {
            task: self,
            errors: solve(self.method, self.points),
        }
    }
}
