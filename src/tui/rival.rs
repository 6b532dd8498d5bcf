//! A second run in lockstep with the first: another method, or the same on half the cells.

use std::time::{Duration, Instant};

use super::frame::Rival;
use crate::math::abel::AbelMethod;
use crate::math::grid::MIN_CELLS;
use crate::scenario::session::{Session, SessionError};
use crate::simulation::Curves;

/// The worker's side of a rival.
#[derive(Debug)]
pub(super) struct RivalRun {
    session: Session,
    /// Which of [`choices`] it is.
    choice: usize,
    busy: Duration,
    steps: u64,
    stopped: Option<String>,
}

impl RivalRun {
    /// The choice so many places after `from`, from the state of `session`; the first one where
    /// there was none before.
    pub fn beside(
        session: &Session,
        from: Option<&Self>,
        places: isize,
    ) -> Result<Self, SessionError> {
        let choices = choices(session);
        let now = from.map_or(0, |rival| rival.choice) as isize;
        let choice = (now + places).rem_euclid(choices.len() as isize) as usize;
        let (key, value) = &choices[choice];
        let mut session = session.clone();
        session.change(key, value)?;
        Ok(Self {
            session,
            choice,
            busy: Duration::ZERO,
            steps: 0,
            stopped: None,
        })
    }

    /// Steps to where the first run is.
    pub fn follow(&mut self, cycle: f64) {
        if self.stopped.is_some() {
            return;
        }
        let (start, before) = (Instant::now(), self.session.simulation().state().steps);
        if let Err(error) = self.session.advance_to(cycle) {
            self.stopped = Some(error.to_string());
        }
        self.busy += start.elapsed();
        self.steps += self.session.simulation().state().steps - before;
    }

    /// What a screen shows of it.
    pub fn seen(&self) -> Rival {
        let simulation = self.session.simulation();
        let setup = simulation.setup();
        Rival {
            name: format!("{} {}", setup.method, setup.grid.cells()),
            observation: simulation.observe(Curves::PROFILE | Curves::PRESSURE),
            step_cost: (self.steps > 0).then(|| self.busy.as_secs_f64() / self.steps as f64),
            stopped: self.stopped.clone(),
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
    // The paper's verdict is about B: it comes first.
    list.sort_by_key(|(_, value)| value != "\"b\"");
    let half = (setup.grid.cells() / 2).max(MIN_CELLS);
    list.push(("numerics.points", half.to_string()));
    list
}
