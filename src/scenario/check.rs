//! Checks every key of a scenario against the schema: whether it is known, and whether its value has the right type and
//! range. `parts` checks how the values fit together.

use toml::{Table, Value};

use super::error::{Faults, Origin, Refusal};
use super::escape::echo;
use super::hints;
use super::schema::{self, Parameter};
use super::{units, values};

/// Finds every key that is unknown or has a value of the wrong kind, and converts every text with a unit to a number in
/// SI units.
pub(super) fn keys(table: &mut Table, origin: &Origin, faults: &mut Faults) {
    section(table, "", "", origin, faults);
}

/// Refuses keys that exclude each other.
pub(super) fn conflicts(table: &Table, origin: &Origin) -> Result<(), Refusal> {
    // Only the first given key of each group is reported.
    let given = |keys: &[&'static str]| {
        let given = |&key: &&'static str| Some((key, values::at(table, key)?));
        keys.iter().find_map(given)
    };
    for of in &schema::SCHEMA.exclusive {
        if let (Some((key, value)), Some((other, _))) = (given(&of.keys), given(&of.others)) {
            let rule = format!("conflicts with {}", of.rule.replace("{}", other));
            return Err(origin.refuse(key, &show(value), rule));
        }
    }
    Ok(())
}

/// Checks the keys of the table at `path`, called `shown` in messages.
fn section(table: &mut Table, path: &str, shown: &str, origin: &Origin, faults: &mut Faults) {
    let is_force = table.get("control").and_then(Value::as_str) == Some("force");
    for (name, value) in table.iter_mut() {
        let path = values::join(path, name);
        let shown = || values::join(shown, &echo(name));
        if path == "changes" {
            changes(value, origin, faults);
        } else if let Some(parameter) = schema::find(&path) {
            if let Some(rule) = broken(value, parameter, is_force) {
                faults.note(&shown(), || origin.refuse(&shown(), &show(value), rule));
            }
        } else if schema::is_section(&path) {
            match value {
                Value::Table(inner) => section(inner, &path, &shown(), origin, faults),
                other => {
                    let rule = format!("must be a table, [{path}]");
                    faults.note(&shown(), || origin.refuse(&shown(), &show(other), rule));
                }
            }
        } else {
            // The key that was meant does not count as missing as well.
            let meant = if faults.is_full() {
                Vec::new()
            } else {
                hints::meant(&path)
            };
            faults.note(&shown(), || unknown(origin.name(), &path, &shown()));
            meant.iter().for_each(|(meant, _)| faults.blame(meant));
        }
    }
}

/// Returns the rule that the value of a key breaks. A text with a unit becomes a number.
fn broken(value: &mut Value, parameter: &Parameter, is_force: bool) -> Option<String> {
    let text = value.as_str().unwrap_or_default();
    match units::quantity(text, parameter, is_force) {
        Some(Ok(number)) => *value = Value::Float(number),
        Some(Err(rule)) => {
            let hint = units::of_other_control(text, parameter);
            return Some(hint.map_or(rule, str::to_owned));
        }
        None => {}
    }
    if !parameter.kind.fits(value) {
        let wanted = format!("{}{}", parameter.kind.wanted(), parameter.allowed());
        let instead = hints::suggest(parameter, value);
        return Some(format!("must be {wanted}{instead}"));
    }
    let entries = value.as_array().map_or(0, Vec::len);
    if let Some(most) = parameter.most.filter(|most| entries > *most) {
        return Some(format!("must have at most {most} entries, not {entries}"));
    }
    let each = if value.is_array() { "each " } else { "" };
    let rule = || format!("{each}must be {}", parameter.range);
    (!parameter.allows(value)).then(rule)
}

/// Checks `[[changes]]`: an array of tables, each with both of its keys.
fn changes(value: &mut Value, origin: &Origin, faults: &mut Faults) {
    let refuse = |shown: &str, value: &Value| {
        let rule = "must be an array of tables, [[changes]] with at_cycle and set";
        origin.refuse(shown, &show(value), rule)
    };
    let Some(list) = value.as_array_mut() else {
        return faults.note("changes", || refuse("changes", value));
    };
    for (i, entry) in list.iter_mut().enumerate() {
        let shown = format!("changes[{i}]");
        let Some(table) = entry.as_table_mut() else {
            faults.note(&shown, || refuse(&shown, entry));
            continue;
        };
        section(table, "changes", &shown, origin, faults);
        for parameter in schema::parameters().filter(|known| known.section() == "changes") {
            if !table.contains_key(parameter.key()) && !faults.covers(parameter.path) {
                let shown = values::join(&shown, parameter.key());
                faults.note(&shown, || origin.missing(&shown, parameter.described()));
            }
        }
    }
}

/// Builds the error for an unknown key at `place`.
pub(super) fn unknown(place: &str, path: &str, shown: &str) -> Refusal {
    let rule = format!("unknown key {}; {}", echo(shown), hints::hint(path));
    Refusal::new(place, rule)
}

/// Formats a length of a measured profile for an error, with three digits.
pub(super) fn length(value: f64) -> String {
    let rounded = format!("{value:.2e}").parse().unwrap_or(value);
    show(&Value::Float(rounded))
}

/// Formats a value for an error.
pub(super) fn show(value: &Value) -> String {
    match value {
        Value::Table(_) => "{...}".to_owned(),
        Value::String(text) => format!("\"{}\"", echo(text)),
        other => echo(&values::literal(other)),
    }
}
