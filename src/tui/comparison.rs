//! A second run in lockstep with the first: another method, or the same on half the cells.

use super::beside::Beside;
use super::frame::Comparison;
use crate::math::abel::AbelMethod;
use crate::math::grid::MIN_CELLS;
use crate::reading::Curves;
use crate::scenario::session::{Session, SessionError};

/// Where a comparison begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum From {
    /// At the present state of the run.
    Now,
    /// At the start of the scenario.
    Start,
}

/// The worker's side of a comparison.
#[derive(Debug)]
pub(super) struct ComparisonRun {
    pub beside: Beside,
    /// Which of [`choices`] it is.
    choice: usize,
    /// Where it has begun.
    pub from: From,
}

impl ComparisonRun {
    /// Makes the comparison `places` after that of `before`, or the first one if there was none. It
    /// begins at the present state of `session`, or at the start, with the changes made since.
    pub fn beside(
        session: &Session,
        before: Option<&Self>,
        places: isize,
        from: From,
    ) -> Result<Self, SessionError> {
        let choices = choices(session);
        let now = before.map_or(0, |comparison| comparison.choice) as isize;
        let choice = (now + places).rem_euclid(choices.len() as isize) as usize;
        let (key, value) = &choices[choice];
        let session = match from {
            From::Now => {
                let mut session = session.clone();
                session.change(key, value)?;
                session
            }
            From::Start => {
                let run = session.as_run(Vec::new());
                let changes = run.changes().iter();
                let others = changes.filter(|change| change.key() != *key).cloned();
                let others = others.collect();
                let scenario = run.with_changes(Vec::new()).with(key, value)?;
                Session::start(scenario.with_changes(others))?
            }
        };
        Ok(Self {
            beside: Beside::new(session.into()),
            choice,
            from,
        })
    }

    /// Method and cells.
    pub fn name(&self) -> String {
        let setup = self.beside.run.simulation().setup();
        format!("{}, N = {}", setup.method.spoken(), setup.grid.cells())
    }

    /// The part that the screen shows.
    pub fn seen(&self) -> Comparison {
        let simulation = self.beside.run.simulation();
        Comparison {
            name: self.name(),
            observation: simulation.observe(Curves::PROFILE | Curves::PRESSURE),
            step_cost: self.beside.step_cost(),
            stopped: self.beside.stopped.clone(),
        }
    }
}

/// What a run can be compared with: every other method, and itself on half the cells.
fn choices(session: &Session) -> Vec<(&'static str, String)> {
    let setup = session.simulation().setup();
    let others = AbelMethod::ALL
        .into_iter()
        .filter(|method| *method != setup.method);
    let mut list: Vec<_> = others
        .map(|method| ("numerics.method", format!("\"{method}\"")))
        .collect();
    // Method b comes first, because the paper's conclusion is about it.
    list.sort_by_key(|(_, value)| value != "\"b\"");
    let half = (setup.grid.cells() / 2).max(MIN_CELLS);
    list.push(("numerics.points", half.to_string()));
    list
}
