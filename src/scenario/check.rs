//! Every key of a scenario held against the table of parameters: is it known, is its value of the
//! right kind. What the values mean together is the business of `validate`.

use toml::{Table, Value};

use super::error::{Origin, ScenarioError, echo};
use super::parameters::{self, Kind, PARAMETERS, Parameter};
use super::write;

/// Refuses the first key that is not in the table of parameters or has a value of the wrong kind.
pub(super) fn keys(table: &Table, origin: &Origin) -> Result<(), ScenarioError> {
    section(table, "", "", origin)
}

/// Checks the keys of the table at `path`, which messages call `shown`.
fn section(table: &Table, path: &str, shown: &str, origin: &Origin) -> Result<(), ScenarioError> {
    for (name, value) in table {
        let (path, shown) = (join(path, name), join(shown, name));
        if path == "changes" {
            changes(value, origin)?;
        } else if let Some(parameter) = parameters::find(&path) {
            if !fits(parameter, value) {
                return Err(origin.refuse(&shown, &show(value), parameter.rule()));
            }
        } else if parameters::is_section(&path) {
            match value {
                Value::Table(inner) => section(inner, &path, &shown, origin)?,
                other => {
                    let rule = format!("must be a table, [{path}]");
                    return Err(origin.refuse(&shown, &show(other), rule));
                }
            }
        } else {
            return Err(unknown(origin.name(), &path, &shown));
        }
    }
    Ok(())
}

/// Checks `[[changes]]`: an array of tables, each with both of its keys.
fn changes(value: &Value, origin: &Origin) -> Result<(), ScenarioError> {
    let refuse = |shown: &str, value: &Value| {
        let rule = "must be an array of tables, [[changes]] with at_cycle and set";
        Err(origin.refuse(shown, &show(value), rule))
    };
    let Some(list) = value.as_array() else {
        return refuse("changes", value);
    };
    for (i, entry) in list.iter().enumerate() {
        let shown = format!("changes[{i}]");
        let Some(table) = entry.as_table() else {
            return refuse(&shown, entry);
        };
        section(table, "changes", &shown, origin)?;
        for parameter in PARAMETERS
            .iter()
            .filter(|known| known.section() == "changes")
        {
            if !table.contains_key(parameter.key()) {
                return Err(missing(origin, &join(&shown, parameter.key()), parameter));
            }
        }
    }
    Ok(())
}

/// Whether the value is of the parameter's kind. Numbers must be finite, words known.
fn fits(parameter: &Parameter, value: &Value) -> bool {
    match parameter.kind {
        Kind::Number => is_number(value),
        Kind::Whole => value.is_integer(),
        Kind::Flag => value.is_bool(),
        Kind::Text => value.is_str(),
        Kind::Choice(words) => value.as_str().is_some_and(|word| words.contains(&word)),
        Kind::Numbers => value
            .as_array()
            .is_some_and(|list| list.iter().all(is_number)),
    }
}

fn is_number(value: &Value) -> bool {
    match value {
        Value::Integer(_) => true,
        Value::Float(number) => number.is_finite(),
        _ => false,
    }
}

/// The error for a key that nobody knows, named at `place`.
pub(super) fn unknown(place: &str, path: &str, shown: &str) -> ScenarioError {
    ScenarioError::UnknownKey {
        place: place.to_owned(),
        key: echo(shown),
        hint: parameters::hint(path),
    }
}

/// The error for a key that must be there.
pub(super) fn missing(origin: &Origin, shown: &str, parameter: &Parameter) -> ScenarioError {
    ScenarioError::Missing {
        origin: origin.name().to_owned(),
        path: shown.to_owned(),
        meaning: parameter.described(),
    }
}

/// A value as an error repeats it.
pub(super) fn show(value: &Value) -> String {
    match value {
        Value::Table(_) => "{...}".to_owned(),
        Value::String(text) => format!("\"{}\"", echo(text)),
        other => echo(&write::value(other)),
    }
}

fn join(path: &str, key: &str) -> String {
    let key = echo(key);
    if path.is_empty() {
        key
    } else {
        format!("{path}.{key}")
    }
}
