//! A scenario as TOML: all numbers to the last bit, keys in the order of the schema.

use std::fmt::Write;

use toml::{Table, Value};

use super::error::printable;
use super::schema::{Kind, parameters};
use super::values::at;

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
        let (key, value) = (parameter.key(), self::value(value));
        let _ = writeln!(text, "{key} = {value}{comment}");
    }
    let changes = table.get("changes").and_then(Value::as_array);
    for change in changes.into_iter().flatten() {
        text.push_str("\n[[changes]]\n");
        for key in ["at_cycle", "set"] {
            if let Some(value) = change.get(key) {
                let _ = writeln!(text, "{key} = {}", self::value(value));
            }
        }
    }
    text.trim_start().to_owned()
}

/// One value, as it may stand after `=`.
pub(crate) fn value(value: &Value) -> String {
    match value {
        Value::Float(number) => self::number(*number),
        Value::Array(list) => {
            let list: Vec<String> = list.iter().map(self::value).collect();
            format!("[{}]", list.join(", "))
        }
        Value::String(text) if text.chars().any(is_rude) => escaped(text),
        other => other.to_string(),
    }
}

/// Whether a terminal or a line of a header would not show a character as it is: controls, spaces and
/// marks that cannot be seen, what turns the direction of text.
fn is_rude(c: char) -> bool {
    !matches!(c, '"' | '\'' | '\\') && printable(&String::from_iter(['a', c])).chars().count() > 2
}

/// A basic string on one line, all that is not plain escaped.
fn escaped(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if is_rude(c) => {
                let _ = write!(quoted, "\\U{:08X}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

/// The shortest form that reads back to the same bits, and as a float.
pub(super) fn number(number: f64) -> String {
    let size = number.abs();
    if number != 0.0 && number.is_finite() && !(1e-3..1e6).contains(&size) {
        format!("{number:e}")
    } else if number.is_nan() {
        "nan".to_owned()
    } else {
        format!("{number:?}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rude_text_reads_back_and_harms_no_terminal() {
        let text = "a\u{9b}2J\u{202e}\u{1b}\n\"\\\u{2066}\u{7f}b";
        let shown = value(&Value::String(text.into()));
        assert!(!shown.chars().any(is_rude), "{shown:?}");
        let read = shown.parse::<Value>().expect("a TOML value");
        assert_eq!(read.as_str(), Some(text));
    }

    #[test]
    fn numbers_read_back_as_the_same_floats() {
        for (given, shown) in [
            (0.0, "0.0"),
            (-0.0, "-0.0"),
            (1.0, "1.0"),
            (1e-7, "1e-7"),
            (2.3077e11, "2.3077e11"),
            (0.1 + 0.2, "0.30000000000000004"),
            (5e-324, "5e-324"),
            (f64::MAX, "1.7976931348623157e308"),
            (123_456.789, "123456.789"),
        ] {
            assert_eq!(number(given), shown);
            let read = shown.parse::<Value>().expect("a TOML value");
            assert_eq!(
                read.as_float().map(f64::to_bits),
                Some(given.to_bits()),
                "{shown}"
            );
        }
    }
}
