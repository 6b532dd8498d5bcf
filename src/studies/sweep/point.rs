//! Runs one point of a study from beginning to end.

use std::panic::{AssertUnwindSafe, catch_unwind};

use super::{Row, Status, Study};
use crate::scenario::scalars::{Reading, Value};
use crate::scenario::session::{Session, SessionError};
use crate::scenario::{Scenario, printable};
use crate::studies::refinement;

/// Runs `point` and returns its row. `None` if `go_on` returned false before the end. A failure, even a bug of the
/// program, becomes the status; the row then shows the last good state, if there is one.
pub(super) fn run(study: &Study, point: usize, go_on: &dyn Fn() -> bool) -> Option<Row> {
    let row = |values, status| {
        Some(Row {
            point,
            values,
            status,
        })
    };
    let failed = |status| row(vec![Value::Null; study.columns.len()], status);
    let scenario = match study.scenario(point) {
        Ok(scenario) => scenario,
        Err(error) => return failed(Status::Invalid(printable(&error.to_string()))),
    };
    let (mut session, status) = match begun(&scenario, go_on) {
        Ok(begun) => begun,
        Err(SessionError::Interrupted) => return None,
        Err(error) => return failed(failure(&error)),
    };
    let ended = catch_unwind(AssertUnwindSafe(|| {
        crate::failpoint::hit("point");
        let end = scenario.run().cycles.unwrap_or_default();
        let ended = session.advance_while(end, |_| go_on());
        (ended, values(study, &session), failed_check(&session))
    }));
    match ended {
        Err(_) => failed(Status::Failed("bug in mdr-tui".to_owned())),
        Ok((Err(SessionError::Interrupted), ..)) => None,
        Ok((Err(error), values, _)) => row(values, failure(&error)),
        Ok((Ok(()), values, Some(check))) if status == Status::Ok => row(values, check),
        Ok((Ok(()), values, _)) => row(values, status),
    }
}

fn failure(error: &SessionError) -> Status {
    Status::Failed(printable(&error.to_string()))
}

/// Reads the columns of the study at the present moment.
fn values(study: &Study, session: &Session) -> Vec<Value> {
    let reading = Reading::new(session);
    let columns = study.columns.iter();
    let values = columns.map(|&column| match reading.value(column) {
        // Counts are numbers like all others, as they are when read back.
        Value::Number(number) => number.as_f64().into(),
        other => other,
    });
    values.collect()
}

/// Returns the status of a point that fails a check: the worst check with its error.
fn failed_check(session: &Session) -> Option<Status> {
    let failing = session.checks().into_iter().filter(|check| !check.holds());
    let worst = failing.max_by(|a, b| a.error.abs().total_cmp(&b.error.abs()))?;
    let (name, size) = (worst.subject.name(), worst.error.abs());
    Some(Status::Unchecked(format!("{name} {size:.1e}")))
}

/// Returns a session with points and steps for the accuracy of the scenario, if it has one, and the status of its row.
/// The session is the finished run that met the accuracy, or else at its start.
fn begun(scenario: &Scenario, go_on: &dyn Fn() -> bool) -> Result<(Session, Status), SessionError> {
    let found = refinement::resolve(scenario, None, refinement::Budget::UNLIMITED, go_on)?;
    let mut session = match found.ended {
        Some(ended) => ended,
        None => Session::start(found.scenario)?,
    };
    session.state(found.errors);
    let status = match (found.missed_by, scenario.accuracy()) {
        (Some(reached), Some(asked)) => {
            Status::Inaccurate(format!("{reached:.1e} instead of {asked:e}"))
        }
        _ => Status::Ok,
    };
    Ok((session, status))
}
