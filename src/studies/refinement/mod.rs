//! Errors measured by refinement: the same scenario on other levels of cells and steps.
//!
//! Nothing is assumed about a scenario. A ladder of levels is [climbed](climb) from coarse to fine until the measured
//! error is as small as `numerics.accuracy` asks for.

mod estimate;
mod ladder;
mod level;
mod outcome;
mod resolve;
mod rung;

pub use estimate::{by_twin, estimate, twin};
pub use ladder::{Budget, Reached, SearchError, Verdict, climb, run_to_accuracy};
pub use level::Level;
pub use outcome::{Difference, Outcome};
pub use resolve::{Resolved, resolve, resolve_soon, statements_of};
pub use rung::{Rung, run};
