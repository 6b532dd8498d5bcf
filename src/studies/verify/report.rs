//! Tables of a study: one per problem to read, one of all rows for JSON, one of all nodes for CSV.

use super::errors::NodalErrors;
use super::{Problem, STICK_RADIUS, Solved};
use crate::scenario::scalars::Value;
use crate::studies::table::Rows;

/// Smaller errors are rounding, and their order means nothing.
pub const ROUNDING: f64 = 1e-12;

/// Up to this many quantities there is room for the order of the rms as well.
const ROOMY: usize = 2;

/// Makes the table of one problem, with a row for each method and N.
pub fn problem_table(problem: Problem, outcomes: &[Solved]) -> Rows {
    let quantities = problem.facts().quantities;
    let roomy = quantities.len() <= ROOMY;
    let names = |quantity: &str| match (quantity == STICK_RADIUS, roomy) {
        (true, _) => "error order",
        (false, true) => "max order rms order",
        (false, false) => "max order rms",
    };
    let mut table = Rows::with_columns(&[("", "method N")]);
    for quantity in quantities {
        let columns = names(quantity).split(' ');
        columns.for_each(|name| table.column(quantity, name));
    }
    for outcome in outcomes.iter().filter(|o| o.task.problem == problem) {
        let task = outcome.task;
        let mut row = vec![task.method.name().into(), task.points.into()];
        for (at, quantity) in quantities.iter().enumerate() {
            let columns = names(quantity).split(' ').count();
            row.extend(group(outcome, at, outcomes).into_iter().take(columns));
        }
        table.push(row);
    }
    table
}

/// Returns the maximum, its order, the rms and its order; or where the run stopped.
fn group(outcome: &Solved, at: usize, outcomes: &[Solved]) -> Vec<Value> {
    match &outcome.errors {
        Ok(errors) => vec![
            errors[at].max().into(),
            order(outcome, at, outcomes, NodalErrors::max).into(),
            errors[at].rms().into(),
            order(outcome, at, outcomes, NodalErrors::rms).into(),
        ],
        Err(stop) => {
            let stopped = format!("stopped at cycle {:.2}", stop.cycle);
            vec![stopped.into(), Value::Null, Value::Null, Value::Null]
        }
    }
}

/// Returns log(error of the next coarser grid / error)/log(ratio
/// of N): `None` on the coarsest grid and if an error is rounding.
fn order(
    outcome: &Solved,
    at: usize,
    outcomes: &[Solved],
    size: fn(&NodalErrors) -> f64,
) -> Option<f64> {
    let task = outcome.task;
    let is_alike = |o: &&Solved| (o.task.problem, o.task.method) == (task.problem, task.method);
    let alike = outcomes.iter().filter(is_alike);
    let coarser = alike.filter(|o| o.task.points < task.points);
    let coarser = coarser.max_by_key(|o| o.task.points)?;
    let size = |outcome: &Solved| Some(size(outcome.errors.as_ref().ok()?.get(at)?));
    let (before, now) = (size(coarser)?, size(outcome)?);
    let ratio = task.points as f64 / coarser.task.points as f64;
    let order = (before / now).log2() / ratio.log2();
    (order.is_finite() && before.min(now) >= ROUNDING).then_some(order)
}

/// Makes a table of all problems, with one row per quantity.
pub fn all_rows(outcomes: &[Solved]) -> Rows {
    let errors = "problem quantity method points max max_order rms rms_order";
    let rest = "nodes nodes_left_out stopped_at_cycle stopped_because";
    let mut table = Rows::with_columns(&[("", errors), ("", rest)]);
    for outcome in outcomes {
        for (at, quantity) in outcome.task.problem.facts().quantities.iter().enumerate() {
            let mut row = key(outcome, quantity);
            match &outcome.errors {
                Ok(errors) => {
                    row.extend(group(outcome, at, outcomes));
                    row.push(errors[at].radii.len().into());
                    row.push(errors[at].left_out.len().into());
                }
                Err(stop) => {
                    row.resize(row.len() + 6, Value::Null);
                    row.push(stop.cycle.into());
                    row.push(stop.to_string().into());
                }
            }
            table.push(row);
        }
    }
    table
}

/// Makes a table of the errors at all nodes.
pub fn all_nodes(outcomes: &[Solved]) -> Rows {
    let mut table = Rows::with_columns(&[("", "problem quantity method points r_over_a error")]);
    for outcome in outcomes {
        let Ok(all) = &outcome.errors else { continue };
        for (quantity, errors) in outcome.task.problem.facts().quantities.iter().zip(all) {
            for (&r, &error) in errors.radii.iter().zip(&errors.errors) {
                let mut row = key(outcome, quantity);
                row.extend([r.into(), error.into()]);
                table.push(row);
            }
        }
    }
    table
}

fn key(outcome: &Solved, quantity: &'static str) -> Vec<Value> {
    vec![
        outcome.task.problem.name().into(),
        quantity.into(),
        outcome.task.method.name().into(),
        outcome.task.points.into(),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::Task;
    use super::*;
    use crate::math::abel::AbelMethod;
    use crate::simulation::{Breakdown, Cause};

    #[test]
    fn a_run_that_stopped_says_where_instead_of_a_number() {
        let outcome = Solved {
            task: Task {
                problem: Problem::Limit,
                method: AbelMethod::Benad,
                points: 400,
            },
            errors: Err(Breakdown {
                cycle: 12.5,
                cause: Cause::EdgeReached { domain_radius: 1.5 },
            }),
        };
        let outcomes = [outcome];
        let text = problem_table(Problem::Limit, &outcomes).text(2);
        let row = text.lines().nth(2).expect("a row");
        assert_eq!(row.matches("stopped at cycle 12.50").count(), 2, "{row}");
        assert!(row.chars().count() <= 80, "{row}");
        let json = serde_json::to_value(all_rows(&outcomes)).expect("JSON");
        assert_eq!(json[1]["stopped_at_cycle"], 12.5);
        assert!(json[1]["max"].is_null());
        assert_eq!(all_nodes(&outcomes).rows.len(), 0);
    }
}
