//! Reads a file as text, and a text as a TOML table.

use std::io::Read;
use std::path::Path;

use toml::Table;

use super::bounded_read::{self, Unread};
use super::error::Refusal;
use super::escape::printable;
use super::typed::parse;
use super::units::with_decimal_point;

/// Maximum size of a scenario's file, in bytes.
const LARGEST_FILE: u64 = 1 << 20;

/// Reads a scenario's file: text, up to the maximum size.
pub(super) fn file(path: &Path) -> Result<String, Refusal> {
    let text = bounded_read::text(path, LARGEST_FILE);
    text.map_err(|why| refusal(&path.to_string_lossy(), why))
}

/// Reads the text of a scenario from an open source, called `origin` in messages.
pub(super) fn text(from: impl Read, origin: &str) -> Result<String, Refusal> {
    let text = bounded_read::text_from(from, LARGEST_FILE);
    text.map_err(|why| refusal(origin, why))
}

fn refusal(origin: &str, why: Unread) -> Refusal {
    let hint = match why {
        Unread::Missing => "mdr-tui presets lists what ships",
        Unread::TooLarge(_) => "a scenario is a short TOML file",
        Unread::Io(_) => return Refusal::unread(printable(origin), &why),
        _ => "a scenario is a TOML file",
    };
    Refusal::unread(printable(origin), &why).or(hint)
}

/// Parses the text as a TOML table, and reports numbers with a decimal comma. These are read as meant, so that the rest
/// can be checked as well.
pub(super) fn table(text: &str, origin: &str) -> Result<(Table, Vec<Refusal>), Refusal> {
    let mut text = text.to_owned();
    let mut commas = Vec::new();
    loop {
        let error = match parse(&text) {
            Ok(table) => return Ok((table, commas)),
            Err(error) => error,
        };
        let at = error.span().map_or(0, |span| span.start);
        let before = text.get(..at).unwrap_or(&text);
        let start = before.rfind('\n').map_or(0, |end| end + 1);
        let syntax = |end: usize, message: String| {
            let line = before.matches('\n').count() + 1;
            let column = text[start..end].chars().count() + 1;
            let rule = format_args!("line {line}, column {column}: {message}");
            Refusal::new(printable(origin), rule)
        };
        let Some((comma, number)) = decimal_comma(&text[start..]) else {
            let message = printable(&error.message().replace('\n', "; "));
            commas.push(syntax(before.len(), message));
            return Err(Refusal::all(commas).expect("one at least"));
        };
        let comma = start + comma;
        let message = format!("a number has a decimal point: {number}");
        commas.push(syntax(comma, message));
        text.replace_range(comma..comma + 1, ".");
    }
}

/// Finds a decimal comma in the first line of `text`, and returns its position and the number with a point instead.
fn decimal_comma(text: &str) -> Option<(usize, String)> {
    let line = text.lines().next()?;
    let value = line.split('#').next()?.split_once('=')?.1.trim();
    let number = with_decimal_point(value)?;
    let start = line.find('=')? + 1;
    Some((start + line[start..].find(',')?, number))
}
