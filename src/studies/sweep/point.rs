//! Runs one point of a study from beginning to end.

use std::panic::{AssertUnwindSafe, catch_unwind};

use super::{Stop, Study};
use crate::math::scan::largest;
use crate::scenario::scalars::{Reading, cell};
use crate::scenario::session::{Session, SessionError};
use crate::scenario::{Scenario, printable};
use crate::studies::refinement;

/// Status of a successful point.
pub const OK: &str = "ok";

/// Start of the status of a point that is not a valid scenario.
pub(super) const INVALID: &str = "invalid: ";

/// Start of the status of a point with a result that misses the requested accuracy.
const INACCURATE: &str = "accuracy ";

/// Start of the status of a point with a result that fails a check.
const UNCHECKED: &str = "check failed: ";

/// The success of a point, from the status of its row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Success {
    /// It has a result, to the requested accuracy if there is one.
    Full,
    /// It has a result, less accurate than requested.
    Inaccurate,
    /// It has a result, which fails a check.
    Unchecked,
    /// It failed.
    Failed,
    /// It is not a valid scenario.
    Invalid,
}

impl Success {
    /// Reads it from a row, whose last field is the status.
    pub fn from_row(row: &[String]) -> Self {
        match row.last().map(String::as_str) {
            Some(OK) => Self::Full,
            Some(status) if status.starts_with(INACCURATE) => Self::Inaccurate,
            Some(status) if status.starts_with(UNCHECKED) => Self::Unchecked,
            Some(status) if status.starts_with(INVALID) => Self::Invalid,
            _ => Self::Failed,
        }
    }

    /// Whether the row has a result.
    pub fn has_result(self) -> bool {
        matches!(self, Self::Full | Self::Inaccurate | Self::Unchecked)
    }
}

/// Runs `point` and returns its row: the values of the axes, the columns, and a status, which is [`OK`], the accuracy
/// reached instead of the requested one, or why the point failed. `None` if `go_on` returned false before the end. A
/// failure, even a bug of the program, becomes the status; the row then shows the last good state, if there is one.
pub(super) fn run(study: &Study, point: usize, go_on: &dyn Fn() -> bool) -> Option<Vec<String>> {
    let ended = match study.scenario(point) {
        Ok(scenario) => run_scenario(study, scenario, go_on)?,
        Err(error) => failed(study, &format!("{INVALID}{error}")),
    };
    Some([study.values(point), ended].concat())
}

fn failed(study: &Study, why: &str) -> Vec<String> {
    let mut row = vec![String::new(); study.columns.len()];
    row.push(printable(why));
    row
}

/// Runs `scenario` as a point of `study` until one of its ends, for its columns and its status.
pub(super) fn run_scenario(
    study: &Study,
    scenario: Scenario,
    go_on: &dyn Fn() -> bool,
) -> Option<Vec<String>> {
    let (mut session, status) = match begun(&scenario, &study.stop, go_on) {
        Ok(begun) => begun,
        Err(SessionError::Interrupted) => return None,
        Err(error) => return Some(failed(study, &error.to_string())),
    };
    let ended = catch_unwind(AssertUnwindSafe(|| {
        crate::failpoint::hit("point");
        let ended = advance(&mut session, &study.stop, go_on);
        let reading = Reading::new(&session);
        let columns = study.columns.iter().copied();
        let fields = columns.map(|column| cell(&reading.value(column)));
        (ended, fields.collect::<Vec<_>>(), failed_check(&session))
    }));
    let Ok((ended, mut row, failed_check)) = ended else {
        return Some(failed(study, "bug in mdr-tui"));
    };
    row.push(match ended {
        Ok(()) if status == OK => failed_check.unwrap_or(status),
        Ok(()) => status,
        Err(SessionError::Interrupted) => return None,
        Err(error) => printable(&error.to_string()),
    });
    Some(row)
}

/// Returns the status of a point that fails a check: the worst check with its error.
fn failed_check(session: &Session) -> Option<String> {
    let failing = session.checks().into_iter().filter(|check| !check.holds());
    let worst = failing.max_by(|a, b| a.error.abs().total_cmp(&b.error.abs()))?;
    let (name, size) = (worst.subject.name(), worst.error.abs());
    Some(format!("{UNCHECKED}{name} {size:.1e}"))
}

/// Returns a session with points and steps for the accuracy of the scenario, if it has one, and the status of its row.
/// If the point only ends with the scenario's last cycle, the session is the finished run that met the accuracy;
/// otherwise it is at its start.
fn begun(
    scenario: &Scenario,
    stop: &Stop,
    go_on: &dyn Fn() -> bool,
) -> Result<(Session, String), SessionError> {
    let found = refinement::resolve(scenario, None, refinement::Budget::UNLIMITED, go_on)?;
    let mut session = match found.ended {
        Some(ended) if *stop == Stop::default() => ended,
        _ => Session::start(found.scenario)?,
    };
    session.state(found.errors);
    let status = match (found.missed_by, scenario.accuracy()) {
        (Some(reached), Some(asked)) => format!("{INACCURATE}{reached:.1e} instead of {asked:e}"),
        _ => OK.to_owned(),
    };
    Ok((session, status))
}

/// Runs to the end of the scenario, or until `stop` is reached, with the steps that `mdr-tui run` takes.
fn advance(
    session: &mut Session,
    stop: &Stop,
    go_on: &dyn Fn() -> bool,
) -> Result<(), SessionError> {
    let end = session.loaded().run().cycles.unwrap_or_default();
    let drive = &session.simulation().setup().drive;
    let period = f64::from(drive.repeats_after().unwrap_or(1));
    let (mut worn, mut is_reached) = (Worn(vec![[0.0; 2]]), false);
    let ended = session.advance_while(end, |session| {
        let simulation = session.simulation();
        let may_end = simulation.cycle() % period == 0.0 || simulation.may_jump();
        is_reached = may_end && worn.reaches(session, stop);
        !is_reached && go_on()
    });
    match ended {
        Err(SessionError::Interrupted) if is_reached => Ok(()),
        ended => ended,
    }
}

/// Worn volume over the cycles, for [`Stop::settled`].
struct Worn(Vec<[f64; 2]>);

impl Worn {
    /// Whether one of the conditions in `stop` holds at the present moment.
    fn reaches(&mut self, session: &Session, stop: &Stop) -> bool {
        if *stop == Stop::default() {
            return false;
        }
        let simulation = session.simulation();
        let (cycle, volume) = (simulation.cycle(), simulation.wear_volume());
        self.0.push([cycle, volume]);
        let deepest = || largest(simulation.worn_depth());
        let settled = |share: f64| cycle >= 2.0 && volume - self.at(0.5 * cycle) <= share * volume;
        stop.worn_depth.is_some_and(|depth| deepest() >= depth)
            || stop.volume.is_some_and(|most| volume >= most)
            || stop.settled.is_some_and(settled)
    }

    /// Returns the worn volume at an earlier cycle, m³, by linear interpolation.
    fn at(&self, cycle: f64) -> f64 {
        let after = self.0.partition_point(|[at, _]| *at < cycle);
        let after = after.clamp(1, self.0.len() - 1);
        let [[start, low], [end, high]] = [self.0[after - 1], self.0[after]];
        let share = (cycle - start) / (end - start).max(f64::MIN_POSITIVE);
        low + (high - low) * share.min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volumes_in_between_lie_on_lines() {
        let worn = Worn(vec![[0.0; 2], [2.0, 4.0], [10.0, 12.0]]);
        assert_eq!(worn.at(1.0), 2.0);
        assert_eq!(worn.at(2.0), 4.0);
        assert_eq!(worn.at(6.0), 8.0);
        assert_eq!(worn.at(11.0), 12.0);
    }
}
