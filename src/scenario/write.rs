//! Writes a scenario as TOML: exact numbers, keys in the order of the schema.

use std::fmt::Write;

use toml::{Table, Value};

use super::schema::{Kind, Parameter, parameters};
use super::values::{at, literal};

/// Writes keys in the order of the schema under their section headings; `line` gives each key's line, if any.
pub(crate) fn sections(line: impl Fn(&Parameter) -> Option<String>) -> String {
    let (mut text, mut open) = (String::new(), "");
    for known in parameters() {
        let Some(line) = line(known) else { continue };
        if known.section() != open {
            open = known.section();
            text += &format!("\n[{open}]\n");
        }
        text += &(line + "\n");
    }
    text
}

/// Writes `table`, which has passed [`check::keys`](super::check::keys). What `follows` from it becomes a comment if the
/// table does not give it; the comment ends with its `source`.
pub(super) fn scenario(table: &Table, follows: &Table, source: &str) -> String {
    let mut text = sections(|known| {
        let Some(value) = at(table, known.path) else {
            let value = literal(at(follows, known.path)?);
            return Some(format!("# {} = {value}  # {source}", known.key()));
        };
        let comment = match (known.kind, known.unit) {
            (Kind::Number | Kind::Numbers, unit) if !unit.is_empty() => format!("  # {unit}"),
            _ => String::new(),
        };
        let is_empty = value.as_array().is_some_and(Vec::is_empty);
        (!is_empty).then(|| format!("{} = {}{comment}", known.key(), literal(value)))
    });
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
