//! The refinement check: the same run on fewer cells and steps, to see what its numbers are worth.

use std::time::Instant;

use crate::scenario::session::{Session, SessionError};
use crate::studies::refinement::{Difference, Level, estimate};

/// What the refinement check found.
#[derive(Debug, Clone, PartialEq)]
pub struct RefinementCheck {
    /// The level of the run, whose error is estimated.
    pub level: Level,
    /// Up to which cycle both were run.
    pub cycle: f64,
    /// The estimated error of the run; `None` if nothing has worn.
    pub error: Option<Difference>,
    /// What it took, s.
    pub seconds: f64,
}

/// Estimates the error of a session at its present moment.
///
/// # Errors
/// If the coarser run breaks down.
pub fn run(session: &Session) -> Result<RefinementCheck, SessionError> {
    let start = Instant::now();
    let error = estimate(session, &|| true)?;
    let is_worn = session.simulation().moment().wear_volume > 0.0;
    Ok(RefinementCheck {
        level: Level::of(session.scenario()),
        cycle: session.simulation().cycle(),
        error: is_worn.then_some(error),
        seconds: start.elapsed().as_secs_f64(),
    })
}
