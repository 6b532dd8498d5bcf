//! The error study: the paper's Fig. 2, and a problem of slip and one of wear, for every method over a ladder of N.
//!
//! [`tasks`] lists what to try, [`Task::run`] compares one method on one grid with theory, and [`report`] makes tables
//! of the results.

use std::collections::BTreeSet;

use crate::math::abel::AbelMethod;
use crate::simulation::Breakdown;

pub mod errors;
mod exact;
mod hertz;
pub mod problem;
pub mod report;
mod sliding;

use errors::NodalErrors;
pub use problem::{Problem, STICK_RADIUS};

/// Default values of N.
pub const LADDER: [usize; 5] = [50, 100, 200, 400, 800];

/// One method on one grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Task {
    /// The problem to solve.
    pub problem: Problem,
    /// The transforms to use.
    pub method: AbelMethod,
    /// N.
    pub points: usize,
}

/// The result of a task.
#[derive(Debug, Clone, PartialEq)]
pub struct Solved {
    /// The task.
    pub task: Task,
    /// The errors of the problem's quantities, in their order; or why there are none.
    pub errors: Result<Vec<NodalErrors>, Breakdown>,
}

/// Returns the tasks of some problems, by problem, method and
/// rising N; `long` ones, which take minutes, only on request.
pub fn tasks(problems: &[Problem], points: &[usize], long: bool) -> Vec<Task> {
    let rising: BTreeSet<usize> = points.iter().copied().collect();
    let wanted = |problem: &&Problem| problems.contains(problem);
    let mut tasks = Vec::new();
    for &problem in Problem::ALL.iter().filter(wanted) {
        for method in AbelMethod::ALL {
            let short = |points: &usize| long || !problem.is_long(*points);
            let chosen = rising.iter().copied().filter(short);
            tasks.extend(chosen.map(|points| Task {
                problem,
                method,
                points,
            }));
        }
    }
    tasks
}

impl Task {
    /// Computes and compares; takes from milliseconds to a minute.
    pub fn run(self) -> Solved {
        Solved {
            task: self,
            errors: self.problem.solve(self.method, self.points),
        }
    }
}
