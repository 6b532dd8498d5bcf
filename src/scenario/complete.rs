//! Writes out the defaults that may change between versions, so that a saved scenario keeps its
//! meaning. Defaults that depend on the method stay open and keep following it.

use toml::{Table, Value};

use super::schema::{self, Default, Kind, Parameter};
use super::values;

/// Tables that every scenario has, given or not.
const ALWAYS: [&str; 2] = ["motion.normal", "numerics"];

/// The key of the accuracy, and the keys that it chooses.
const ACCURACY: &str = "numerics.accuracy";
const CHOSEN_BY_ACCURACY: [&str; 4] = [
    "numerics.points",
    "numerics.steps_per_cycle",
    "numerics.tolerance",
    "numerics.nodes",
];

/// Default accuracy of a run with wear if no numerics are given.
pub const USUAL_ACCURACY: f64 = 1e-2;

/// Returns the keys of `written`, which has passed [`check::keys`](super::check::keys), without `[run]` and
/// `[[changes]]`: numbers as floats, defaults filled in.
pub(super) fn table(written: &Table) -> Table {
    let usual = has_usual_accuracy(written).then_some(Value::Float(USUAL_ACCURACY));
    let has_accuracy = values::at(written, ACCURACY).is_some() || usual.is_some();
    let mut complete = Table::new();
    let is_apart = |known: &Parameter| ["run", "changes"].contains(&known.section());
    for parameter in schema::parameters().filter(|known| !is_apart(known)) {
        // Before the run these are found, and written then.
        let chosen = has_accuracy
            && (CHOSEN_BY_ACCURACY.contains(&parameter.path)
                || parameter.path == "numerics.integrator");
        let section = parameter.section();
        let is_used = || ALWAYS.contains(&section) || values::at(written, section).is_some();
        let value = match (values::at(written, parameter.path), &parameter.default) {
            (Some(value), _) => Some(plain(value, parameter.kind)),
            _ if chosen => None,
            _ if parameter.path == ACCURACY => usual.clone(),
            (None, Default::Written(value)) if is_used() => Some(value.clone()),
            _ => None,
        };
        if let Some(value) = value {
            values::insert(&mut complete, parameter.path, value);
        }
    }
    complete
}

/// Whether the scenario computes wear and gives no accuracy or resolution.
fn has_usual_accuracy(written: &Table) -> bool {
    let is_written = |path: &str| values::at(written, path).is_some();
    let mut chosen = CHOSEN_BY_ACCURACY.into_iter().chain([ACCURACY]);
    let mut wear = ["wear.coefficient", "wear.coefficient_per_load"].into_iter();
    wear.any(is_written) && !chosen.any(is_written)
}

/// Returns the value with numbers as floats.
fn plain(value: &Value, kind: Kind) -> Value {
    match (kind, value) {
        (Kind::Number | Kind::Numbers, Value::Integer(whole)) => Value::Float(*whole as f64),
        (Kind::Numbers, Value::Array(list)) => {
            Value::Array(list.iter().map(|value| plain(value, kind)).collect())
        }
        _ => value.clone(),
    }
}
