//! A scenario as TOML: all numbers to the last bit, keys in the order of the schema.

use std::fmt::Write;

use toml::{Table, Value};

use super::schema::{Kind, parameters};
use super::values::{at, literal};

/// Writes `table`, which has passed [`check::keys`](super::check::keys). Each of `follows`, a path
/// and a value, becomes a comment where the table does not give it, which ends with its `source`.
pub(super) fn scenario(table: &Table, follows: &[(&str, String)], source: &str) -> String {
    let mut text = String::new();
    let mut open = "";
    for parameter in parameters()
        .iter()
        .filter(|known| known.section() != "changes")
    {
        let Some(value) = at(table, parameter.path) else {
            let value = follows.iter().find(|(path, _)| *path == parameter.path);
            if let (Some((_, value)), true) = (value, parameter.section() == open) {
                let _ = writeln!(text, "# {} = {value}  # {source}", parameter.key());
            }
            continue;
        };
        if value.as_array().is_some_and(Vec::is_empty) {
            continue;
        }
        if parameter.section() != open {
            open = parameter.section();
            let _ = writeln!(text, "\n[{open}]");
        }
        let comment = match (parameter.kind, parameter.unit) {
            (Kind::Number | Kind::Numbers, unit) if !unit.is_empty() => format!("  # {unit}"),
            _ => String::new(),
        };
        let (key, value) = (parameter.key(), literal(value));
        let _ = writeln!(text, "{key} = {value}{comment}");
    }
    let changes = table.get("changes").and_then(Value::as_array);
    for change in changes.into_iter().flatten() {
        text.push_str("\n[[changes]]\n");
        for key in ["at_cycle", "set"] {
            if let Some(value) = change.get(key) {
                let _ = writeln!(text, "{key} = {}", literal(value));
            }
        }
    }
    text.trim_start().to_owned()
}
