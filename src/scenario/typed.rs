//! Reads a TOML text into a struct or a table; errors of a struct say in one line what is wrong in which line.

use std::borrow::Cow;

use serde::de::DeserializeOwned;

use super::escape::printable;
use super::hint;

/// serde's words for the types it expected, and a user's words.
const WORDS: [(&str, &str); 6] = [
    ("a sequence", "a list"),
    ("a map", "a table"),
    ("i64", "a whole number"),
    ("u32", "a whole number from 0 to 4294967295"),
    ("usize", "a whole number, 0 or greater"),
    ("f64", "a number"),
];

/// Reads `text` as a `T`.
///
/// # Errors
///
/// In one line, without the file's name: invalid TOML, an unknown key with the nearest known one, or a value of the
/// wrong type.
pub fn read<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    parse(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start);
        let line = text.get(..at).unwrap_or(text).matches('\n').count() + 1;
        format!("line {line}: {}", in_words(error.message()))
    })
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

fn in_words(message: &str) -> String {
    let message = printable(&message.replace('\n', "; "));
    let named: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let what = match &message {
        message if message.starts_with("unknown field") => Some("key"),
        message if message.starts_with("unknown variant") => Some("value"),
        _ => None,
    };
    if let ([unknown, known @ ..], Some(what)) = (&named[..], what) {
        let hint = hint::hint(unknown, known.iter().copied());
        return format!("unknown {what} {unknown}; {hint}");
    }
    if let ([missing], true) = (&named[..], message.starts_with("missing field")) {
        return format!("{missing} is missing");
    }
    match message.rsplit_once(", expected ") {
        Some((seen, wanted)) => {
            let words = WORDS.iter().find(|(said, _)| *said == wanted);
            let wanted = words.map_or(wanted, |(_, words)| words);
            format!("{seen}, expected {wanted}")
        }
        None => message,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use toml::Table;

    #[derive(Debug, serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "read only to be refused")]
    struct Sample {
        count: Option<i64>,
        list: Option<Vec<String>>,
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
            assert_eq!(parsed["y"].as_float(), text.parse().ok());
            assert!(is_large_whole(text));
        }
        assert!(!is_large_whole("9223372036854775807") && !is_large_whole("1e400"));
        assert!(parse::<Table>("x = 99999999999999999999x").is_err());
    }

    #[test]
    fn what_is_wrong_is_said_in_a_users_words() {
        for (text, said) in [
            (
                "\ncuont = 1",
                "line 2: unknown key cuont; did you mean count?",
            ),
            ("x = 1", "line 1: unknown key x; known are count, list"),
            (
                "count = \"a\"",
                "line 1: invalid type: string \"a\", expected a whole number",
            ),
            (
                "list = 3",
                "line 1: invalid type: integer `3`, expected a list",
            ),
        ] {
            assert_eq!(read::<Sample>(text).expect_err(text), said);
        }
    }
}
