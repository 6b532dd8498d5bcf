//! Reads a TOML text into a struct; its errors say in one line what is wrong in which line.

use serde::de::DeserializeOwned;

use super::escape::printable;
use super::{nearest, values};

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
    values::parse(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start);
        let line = text.get(..at).unwrap_or(text).matches('\n').count() + 1;
        format!("line {line}: {}", in_words(error.message()))
    })
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
        let hint = nearest::hint(unknown, known.iter().copied());
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

    #[derive(Debug, serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "read only to be refused")]
    struct Sample {
        count: Option<i64>,
        list: Option<Vec<String>>,
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
