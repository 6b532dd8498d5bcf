//! Data for charts from a session: its present state, or everything that a run of it to the end yields.

use super::{Run, history_columns, on_paper};
use crate::export::{field, header, last_loop};
use crate::reading::{Curves, Recorder};
use crate::scenario::scalars::Reading;
use crate::scenario::session::{Session, SessionError};
use crate::traces::{Loop, Table};

impl Run {
    /// Adds the present state of `session`.
    pub fn add_state(&mut self, session: &Session) {
        let seen = session.simulation().observe(Curves::all());
        let table = Table::clone(&seen.columns).with_header(header::entries(session));
        self.states.push(table.into());
    }

    /// Runs `session` to the last of `cycles` (increasing). Records the state at each of them and the loop before it,
    /// the history at whole cycles, and the field at the end if `with_field`.
    ///
    /// # Errors
    /// If the run stops.
    pub fn simulate(
        session: &mut Session,
        cycles: &[f64],
        with_field: bool,
    ) -> Result<Self, SessionError> {
        let mut data = Self::default().with_scenario(session.scenario());
        let mut past = Recorder::of_moments(history_columns(on_paper()));
        let mut record = |session: &Session| {
            let reading = Reading::new(session);
            if past.last_cycle() < Some(session.simulation().cycle()) {
                past.record(|column| reading.number(column));
            }
        };
        for &end in cycles {
            while session.simulation().cycle() < end {
                let simulation = session.simulation();
                let next = if simulation.may_jump() {
                    end
                } else {
                    end.min(simulation.cycle().floor() + 1.0)
                };
                session.advance_while(next, |session| {
                    if session.simulation().cycle().fract() == 0.0 {
                        record(session);
                    }
                    true
                })?;
            }
            data.add_state(session);
            let last = last_loop::record(session.simulation());
            data.loops.extend(Loop::recorded(&last));
        }
        if session.simulation().cycle() < 1.0 {
            record(session);
        }
        let header = || header::entries(session);
        data.history = Some(past.table(past.columns()).with_header(header()).into());
        data.field = with_field.then(|| field::table(session).with_header(header()));
        Ok(data)
    }
}
