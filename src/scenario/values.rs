//! Values in the table of a scenario, by the dotted paths of their keys, and as TOML.

use std::borrow::Cow;

use serde::de::DeserializeOwned;
use toml::Value;

use super::escape::{echo, printable};

/// Returns a finite number, whole or not.
pub(crate) fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Integer(whole) => Some(*whole as f64),
        Value::Float(number) => Some(*number).filter(|number| number.is_finite()),
        _ => None,
    }
}

/// Whether a text is a whole number that 64 bits cannot hold, but a float may.
pub(super) fn is_large_whole(text: &str) -> bool {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    digits.len() > 18
        && digits.bytes().all(|byte| byte.is_ascii_digit())
        && text.parse::<i64>().is_err()
}

/// Maximum number of whole numbers that [`parse`] turns into floats.
const MOST_WIDENED: usize = 100;

/// Parses a TOML text; whole numbers beyond 64 bits become floats.
pub(super) fn parse<T: DeserializeOwned>(text: &str) -> Result<T, toml::de::Error> {
    let mut text = Cow::Borrowed(text);
    for _ in 0..MOST_WIDENED {
        let error = match toml::from_str(&text) {
            Ok(parsed) => return Ok(parsed),
            Err(error) => error,
        };
        let at = error.span().map_or(0, |span| span.start);
        let from = text.get(at..).unwrap_or_default();
        let end = from.find(|c: char| !(c.is_ascii_digit() || "+-".contains(c)));
        let end = end.unwrap_or(from.len());
        if !is_large_whole(&from[..end]) || from[end..].starts_with(['.', 'e', 'E', '_']) {
            return Err(error);
        }
        text.to_mut().insert_str(at + end, ".0");
    }
    toml::from_str(&text)
}

/// Returns the dotted path of a key in the table at `path`.
pub(crate) fn join(path: &str, key: &str) -> String {
    match path {
        "" => key.to_owned(),
        path => format!("{path}.{key}"),
    }
}

/// Splits a dotted path into its table and its key.
pub(crate) fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('.').unwrap_or(("", path))
}

/// Formats one value as it may follow `=`.
pub(crate) fn literal(value: &Value) -> String {
    match value {
        Value::Float(number) => float(*number),
        Value::Array(list) => {
            let list: Vec<String> = list.iter().map(literal).collect();
            format!("[{}]", list.join(", "))
        }
        Value::String(text) if text.chars().any(is_unprintable) => escaped(text),
        other => other.to_string(),
    }
}

/// Whether a terminal or a header line would not show a character unchanged: controls, invisible spaces and marks, and
/// characters that change the direction of text.
fn is_unprintable(c: char) -> bool {
    !matches!(c, '"' | '\'' | '\\') && printable(&String::from_iter(['a', c])).chars().count() > 2
}

/// Formats a basic string on one line, escaping special characters: TOML has the escapes of JSON.
fn escaped(text: &str) -> String {
    let escaped = |c| {
        if is_unprintable(c) {
            format!("\\U{:08X}", u32::from(c))
        } else {
            c.to_string()
        }
    };
    let quoted = serde_json::Value::from(text).to_string();
    quoted.chars().map(escaped).collect()
}

/// Returns the shortest form that reads back to the same bits, and as a float.
fn float(number: f64) -> String {
    let size = number.abs();
    if number != 0.0 && number.is_finite() && !(1e-3..1e6).contains(&size) {
        format!("{number:e}")
    } else if number.is_nan() {
        "nan".to_owned()
    } else {
        format!("{number:?}")
    }
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
        other => echo(&literal(other)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use toml::Table;

    #[test]
    fn rude_text_reads_back_and_harms_no_terminal() {
        let text = "a\u{9b}2J\u{202e}\u{1b}\n\"\\\u{2066}\u{7f}b";
        let shown = literal(&Value::String(text.into()));
        assert!(!shown.chars().any(is_unprintable), "{shown:?}");
        let read = shown.parse::<Value>().expect("a TOML value");
        assert_eq!(read.as_str(), Some(text));
    }

    #[test]
    fn whole_numbers_of_any_size_are_numbers() {
        for text in [
            "9223372036854775808",
            "99999999999999999999",
            "-9223372036854775809",
        ] {
            let parsed: Table =
                parse(&format!("x = [1, {text}]\ny = {text} # {text}")).expect(text);
            assert_eq!(number(&parsed["y"]), text.parse().ok());
            assert!(is_large_whole(text));
        }
        assert!(!is_large_whole("9223372036854775807") && !is_large_whole("1e400"));
        assert!(parse::<Table>("x = 99999999999999999999x").is_err());
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
            assert_eq!(float(given), shown);
            let read = shown.parse::<Value>().expect("a TOML value");
            assert_eq!(
                read.as_float().map(f64::to_bits),
                Some(given.to_bits()),
                "{shown}"
            );
        }
    }
}
