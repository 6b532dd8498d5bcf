//! Data for charts from a session: its present state, or everything that a run of it to the end yields.

use super::Run;
use crate::export::{field, header, last_loop};
use crate::reading::{Column, Curves};
use crate::scenario::scalars::Reading;
use crate::scenario::session::{Session, SessionError};
use crate::traces::{Loop, Table};

/// What the charts over cycles show.
const OVER_CYCLES: [Column; 7] = [
    Column::Cycle,
    Column::ContactRadius,
    Column::PermanentStickRadius,
    Column::WearVolume,
    Column::ScarDepth,
    Column::ScarRadius,
    Column::DissipatedEnergy,
];

impl Run {
    /// Adds the present state of `session`.
    pub fn add_state(&mut self, session: &Session) {
        let seen = session.simulation().observe(Curves::all());
        let table = seen.columns.with_header(header::entries(session));
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
        let mut seen: Vec<[f64; OVER_CYCLES.len()]> = Vec::new();
        let mut record = |session: &Session| {
            let reading = Reading::new(session);
            let row = OVER_CYCLES.map(|column| reading.number(column));
            if seen.last().is_none_or(|last| last[0] < row[0]) {
                seen.push(row);
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
            let rows = last_loop::rows(session.simulation());
            data.loops.push(Loop::of_rows(end, rows.iter()));
        }
        if session.simulation().cycle() < 1.0 {
            record(session);
        }
        let header = || header::entries(session);
        data.history = Some(Table::of_rows(header(), OVER_CYCLES, &seen).into());
        data.field =
            with_field.then(|| Table::of_rows(header(), field::COLUMNS, &field::rows(session)));
        Ok(data)
    }
}
