//! Escapes text for output: one function for each kind of output makes any text harmless there.
//!
//! | output | function |
//! |---|---|
//! | a terminal, a line of a header | [`printable`] |
//! | a line of a CSV file | [`csv_line`] |
//! | JSON | [`json`] |
//! | SVG | [`xml`] |

use serde::Serialize;

/// Maximum number of characters of user text in an error.
const LONGEST_ECHO: usize = 60;

/// Puts `text` on one line: control and invisible characters become escapes.
pub fn printable(text: &str) -> String {
    if text.bytes().all(|byte| matches!(byte, b' '..=b'~')) {
        return text.to_owned();
    }
    let mut line = String::new();
    let mut joined = text.split_inclusive(is_joiner).peekable();
    while let Some(part) = joined.next() {
        let (part, joiner) = match part
            .char_indices()
            .next_back()
            .filter(|(_, c)| is_joiner(*c))
        {
            // Between characters a joiner shapes a script or an emoji.
            Some((end, joiner)) if end > 0 && joined.peek().is_some() => {
                (&part[..end], Some(joiner))
            }
            _ => (part, None),
        };
        // Quotes and backslashes are harmless, and only harder to read if escaped.
        let plain = ["\"", "'", "\\"];
        let escaped = part.escape_debug().to_string();
        line += &plain.iter().fold(escaped, |line, plain| {
            line.replace(&format!("\\{plain}"), plain)
        });
        line.extend(joiner);
    }
    line
}

/// Whether a character is the zero-width non-joiner or joiner.
fn is_joiner(c: char) -> bool {
    matches!(c, '\u{200c}' | '\u{200d}')
}

/// As [`printable`], but cut if too long for a line.
pub(super) fn echo(text: &str) -> String {
    let mut start: String = text.chars().take(LONGEST_ECHO).collect();
    let cut = start.len() < text.len();
    start = printable(&start);
    if cut {
        start.push_str("...");
    }
    start
}

/// Makes a text safe as a cell of a table: printable, and not a spreadsheet formula.
pub fn cell(text: &str) -> String {
    let text = printable(text);
    if text.starts_with(['=', '+', '-', '@']) && text.parse::<f64>().is_err() {
        return format!("'{text}");
    }
    text
}

/// Formats one line of a CSV file, including its end, from [cells](cell).
pub fn csv_line<T: AsRef<str>>(fields: impl IntoIterator<Item = T>) -> String {
    let mut writer = csv::WriterBuilder::new();
    let mut writer = writer.comment(Some(b'#')).from_writer(Vec::new());
    // Writing to memory cannot fail.
    let _ = writer.write_record(fields.into_iter().map(|field| cell(field.as_ref())));
    let bytes = writer.into_inner().unwrap_or_default();
    String::from_utf8(bytes).unwrap_or_default()
}

/// Formats a value as JSON on one line, or on several if `indented`. Escapes characters that affect a terminal or the
/// direction of text.
///
/// # Errors
///
/// As [`serde_json::to_string`].
pub fn json<T: Serialize>(value: &T, indented: bool) -> serde_json::Result<String> {
    let text = if indented {
        serde_json::to_string_pretty(value)?
    } else {
        serde_json::to_string(value)?
    };
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        if c == '\n' || !is_hidden(c) {
            escaped.push(c);
            continue;
        }
        for unit in c.encode_utf16(&mut [0; 2]) {
            escaped += &format!("\\u{unit:04x}");
        }
    }
    Ok(escaped)
}

/// Escapes a text for an XML element; characters that XML forbids, or that change the direction of text, become blanks.
pub fn xml(text: &str) -> String {
    let hidden = |c: char| c != '\n' && is_hidden(c);
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
        .replace(hidden, " ")
}

/// Whether a character is invisible and affects the text around it or a terminal.
fn is_hidden(c: char) -> bool {
    let is_direction = matches!(
        c,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    let is_break = matches!(c, '\u{2028}' | '\u{2029}');
    let is_none = u32::from(c) & 0xfffe == 0xfffe || matches!(c, '\u{fdd0}'..='\u{fdef}');
    c.is_control() || is_direction || is_break || is_none || matches!(c, '\u{fff9}'..='\u{fffb}')
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Characters that affect a terminal, a table or a browser.
    const RUDE: &str =
        "a\u{9b}2J\u{202e}\u{1b}]0;x\u{7}\r\n\u{7f}\u{2066}\u{ffff}\u{1fffe}\u{2028}";

    #[test]
    fn a_line_stays_a_line() {
        assert_eq!(printable("a\nb\u{1b}[31m"), "a\\nb\\u{1b}[31m");
        assert_eq!(printable("\u{202e}x\u{0}"), "\\u{202e}x\\0");
        assert_eq!(printable(r#"it's "C:\x""#), r#"it's "C:\x""#);
        assert_eq!(printable("caf\u{e9} cafe\u{301}"), "caf\u{e9} cafe\u{301}");
        assert_eq!(echo(&"x".repeat(100)).len(), LONGEST_ECHO + 3);
        assert!(!printable(RUDE).chars().any(is_hidden));
    }

    #[test]
    fn joiners_stay_between_what_they_join() {
        for text in [
            "\u{1f469}\u{200d}\u{1f52c}",
            "\u{645}\u{6cc}\u{200c}\u{62e}",
        ] {
            assert_eq!(printable(text), text);
        }
        assert_eq!(printable("\u{200d}a\u{200d}"), "\\u{200d}a\\u{200d}");
    }

    #[test]
    fn a_cell_is_no_formula_and_a_number_stays_one() {
        for (text, shown) in [
            ("=cmd|x!A1", "'=cmd|x!A1"),
            ("-1+cmd", "'-1+cmd"),
            ("@x", "'@x"),
            ("-1.5e-7", "-1.5e-7"),
            ("+5", "+5"),
            ("-inf", "-inf"),
        ] {
            assert_eq!(cell(text), shown);
            assert_eq!(cell(shown), shown);
        }
        assert_eq!(csv_line(["a\nb", "c,d", ""]), "a\\nb,\"c,d\",\n");
    }

    #[test]
    fn json_reads_back_and_harms_no_terminal() {
        let text = json(&RUDE, false).expect("JSON");
        assert!(!text.chars().any(is_hidden), "{text:?}");
        let read: String = serde_json::from_str(&text).expect("JSON");
        assert_eq!(read, RUDE);
    }

    #[test]
    fn xml_holds_only_what_xml_may() {
        let text = xml(&format!("<&\">{RUDE}"));
        assert!(text.starts_with("&lt;&amp;&quot;&gt;a 2J"), "{text}");
        assert!(!text.chars().any(|c| c != '\n' && is_hidden(c)), "{text:?}");
    }
}
