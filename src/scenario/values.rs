//! The values in the table of a scenario, by the dotted paths of their keys.

use std::str::FromStr;

use serde::de::DeserializeOwned;
use toml::{Table, Value};

use super::schema;

/// A finite number, whole or not.
pub(crate) fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Integer(whole) => Some(*whole as f64),
        Value::Float(number) => Some(*number).filter(|number| number.is_finite()),
        _ => None,
    }
}

/// A list of such numbers.
pub(super) fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(number).collect()
}

/// The value of a key in `table` as a `T`, where one of that type is given.
pub(super) fn read<T: DeserializeOwned>(table: &Table, path: &str) -> Option<T> {
    debug_assert!(schema::find(path).is_some(), "{path} is a key of the table");
    at(table, path)?.clone().try_into().ok()
}

/// What the word of a key in `table` names, where one is given.
pub(super) fn named<T: FromStr>(table: &Table, path: &str) -> Option<T> {
    read::<String>(table, path)?.parse().ok()
}

/// The value at a dotted path.
pub(super) fn at<'a>(table: &'a Table, path: &str) -> Option<&'a Value> {
    match path.split_once('.') {
        None => table.get(path),
        Some((first, rest)) => at(table.get(first)?.as_table()?, rest),
    }
}

/// Writes the value, making the tables on the way. Where something else stands in the way of a
/// table, it stays, and the check of all keys will find it.
pub(super) fn insert(table: &mut Table, path: &str, value: Value) {
    match path.split_once('.') {
        None => {
            table.insert(path.to_owned(), value);
        }
        Some((first, rest)) => {
            let entry = table
                .entry(first)
                .or_insert_with(|| Value::Table(Table::new()));
            if let Value::Table(inner) = entry {
                insert(inner, rest, value);
            }
        }
    }
}

/// Takes the value at a dotted path away.
pub(super) fn remove(table: &mut Table, path: &str) -> Option<Value> {
    match path.split_once('.') {
        None => table.remove(path),
        Some((first, rest)) => remove(table.get_mut(first)?.as_table_mut()?, rest),
    }
}

/// The dotted path of a key in the table at `path`.
pub(crate) fn join(path: &str, key: &str) -> String {
    match path {
        "" => key.to_owned(),
        path => format!("{path}.{key}"),
    }
}

/// Splits a dotted path into its table and its key.
pub(super) fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('.').unwrap_or(("", path))
}
