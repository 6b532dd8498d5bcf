//! Writes out the defaults that may change between versions, so that a saved scenario keeps its
//! meaning. Defaults that depend on the method stay open and keep following it.

use toml::{Table, Value};

use super::keys::{ACCURACY, CHOSEN_BY_ACCURACY, INTEGRATOR, PARAMETERS};
use super::schema::{self, Default, Kind, Parameter};

/// Tables that every scenario has, written or not.
const ALWAYS: [&str; 2] = ["motion.normal", "numerics"];

/// The keys of `written`, which has passed [`check::keys`](super::check::keys), without `[run]` and
/// `[[changes]]`: numbers as floats, defaults filled in.
pub(super) fn table(written: &Table) -> Table {
    let has_accuracy = ACCURACY.get(written).is_some();
    let mut complete = Table::new();
    for parameter in PARAMETERS
        .iter()
        .filter(|known| !["run", "changes"].contains(&known.section()))
    {
        // These are found before the run, and written then.
        let chosen = has_accuracy
            && (CHOSEN_BY_ACCURACY.contains(&parameter.path)
                || parameter.path == INTEGRATOR.path());
        let value = match schema::at(written, parameter.path) {
            Some(value) => Some(plain(value, parameter.kind)),
            None if chosen => None,
            None => default(written, parameter),
        };
        if let Some(value) = value {
            schema::insert(&mut complete, parameter.path, value);
        }
    }
    complete
}

/// The default that is written out where its table is used.
fn default(written: &Table, parameter: &Parameter) -> Option<Value> {
    let section = parameter.section();
    let used = ALWAYS.contains(&section) || schema::at(written, section).is_some();
    match parameter.default {
        Default::Written(text) if used => text.parse().ok(),
        _ => None,
    }
}

/// The value with numbers as floats.
fn plain(value: &Value, kind: Kind) -> Value {
    match (kind, value) {
        (Kind::Number | Kind::Numbers, Value::Integer(whole)) => Value::Float(*whole as f64),
        (Kind::Numbers, Value::Array(list)) => {
            Value::Array(list.iter().map(|value| plain(value, kind)).collect())
        }
        _ => value.clone(),
    }
}
