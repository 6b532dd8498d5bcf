//! Errors measured by refinement: the same scenario on other levels of cells and steps.
//!
//! This assumes nothing about a scenario: it [climbs](climb) a ladder of levels from coarse to fine until the measured
//! error is as small as `numerics.accuracy` requires.

mod budget;
mod estimate;
mod ladder;
mod level;
mod outcome;
mod resolve;
mod rung;

pub use budget::Budget;
pub use estimate::{estimate, twin};
pub use ladder::{Reached, SearchError, Verdict, climb, run_to_accuracy};
pub use level::Level;
pub use outcome::{Difference, Outcome, difference_per_error};
pub use resolve::{Resolved, resolve, resolve_soon};
pub use rung::{Rung, run};
