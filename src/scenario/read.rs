//! From a file to a text, to a TOML table.

use std::path::Path;

use toml::Table;

use super::error::{Origin, ScenarioError, printable};
use super::limited::{self, Unread};
use super::units::with_decimal_point;

/// The largest file that is read as a scenario, in bytes.
const LARGEST_FILE: u64 = 1 << 20;

/// Reads a file that can be a scenario: text, and not too long.
pub(super) fn file(path: &str) -> Result<String, ScenarioError> {
    let unreadable = |reason: String| ScenarioError::Unreadable {
        origin: printable(path),
        reason,
    };
    limited::text(Path::new(path), LARGEST_FILE).map_err(|why| {
        let hint = match why {
            Unread::Missing => "; mdr-tui presets lists what ships",
            Unread::TooLarge(_) => "; a scenario is a short TOML file",
            Unread::Io(_) => "",
            _ => "; a scenario is a TOML file",
        };
        unreadable(format!("{why}{hint}"))
    })
}

/// The text as a TOML table, and the numbers in it that have a decimal comma: they are read as meant, so
/// that the rest can be judged as well.
pub(super) fn table(
    text: &str,
    origin: &Origin,
) -> Result<(Table, Vec<ScenarioError>), ScenarioError> {
    let mut text = text.to_owned();
    let mut commas = Vec::new();
    loop {
        let error = match toml::from_str(&text) {
            Ok(table) => return Ok((table, commas)),
            Err(error) => error,
        };
        let at = error.span().map_or(0, |span| span.start);
        let before = text.get(..at).unwrap_or(&text);
        let start = before.rfind('\n').map_or(0, |end| end + 1);
        let syntax = |column: usize, message: String| ScenarioError::Syntax {
            origin: origin.name().to_owned(),
            line: before.matches('\n').count() + 1,
            column,
            message,
        };
        let Some((comma, number)) = decimal_comma(&text[start..]) else {
            let column = before[start..].chars().count() + 1;
            let message = printable(&error.message().replace('\n', "; "));
            return Err(ScenarioError::several(
                commas
                    .into_iter()
                    .chain([syntax(column, message)])
                    .collect(),
            ));
        };
        let column = text[start..start + comma].chars().count() + 1;
        commas.push(syntax(
            column,
            format!("a number has a decimal point: {number}"),
        ));
        text.replace_range(start + comma..start + comma + 1, ".");
    }
}

/// Where the first line of `text` has a decimal comma, and the number with a point in its place.
fn decimal_comma(text: &str) -> Option<(usize, String)> {
    let line = text.lines().next()?;
    let value = line.split('#').next()?.split_once('=')?.1.trim();
    let number = with_decimal_point(value)?;
    let start = line.find('=')? + 1;
    Some((start + line[start..].find(',')?, number))
}
