//! Finds the table in a text: its separator, where its numbers begin, and the lines above that give names and units.

use csv::StringRecord;

use super::names::is_unit;

/// Separator of the fields of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Separator {
    /// `\t`
    Tab,
    /// `;`
    Semicolon,
    /// `,`
    Comma,
    /// One or more blanks.
    Blanks,
}

impl Separator {
    /// In the order of trial: if two read equally many numbers, the first wins.
    const ALL: [Self; 4] = [Self::Tab, Self::Semicolon, Self::Comma, Self::Blanks];

    /// Returns its name in the plural.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tab => "tabs",
            Self::Semicolon => "semicolons",
            Self::Comma => "commas",
            Self::Blanks => "blanks",
        }
    }

    /// Splits the lines of a text into records with line numbers, skipping comments and blank lines.
    fn records(self, text: &str) -> Result<Vec<NumberedLine>, csv::Error> {
        let (mut lines, mut kept) = (Vec::new(), String::with_capacity(text.len()));
        for (line, number) in text.lines().zip(1..) {
            let trimmed = line.trim();
            if !trimmed.is_empty() && !trimmed.starts_with('#') {
                lines.push(number);
                let line = if self == Self::Blanks {
                    with_tabs(line)
                } else {
                    line.to_owned()
                };
                kept += &line;
                kept.push('\n');
            }
        }
        let delimiter = match self {
            Self::Tab | Self::Blanks => b'\t',
            Self::Semicolon => b';',
            Self::Comma => b',',
        };
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .has_headers(false)
            .flexible(true)
            .delimiter(delimiter)
            .from_reader(kept.as_bytes());
        let number = |row: &StringRecord| lines.get(row.position()?.line() as usize - 1).copied();
        let rows = reader.records();
        rows.map(|row| row.map(|row| (number(&row).unwrap_or(0), row)))
            .collect()
    }
}

/// A line's number, from 1, and its fields.
pub(super) type NumberedLine = (u64, StringRecord);

/// Number of lines examined to choose the separator.
const SAMPLE: usize = 2000;

/// Words for a missing value, besides an empty field.
const MISSING: [&str; 14] = [
    "nan", "-nan", "na", "n/a", "bad", "null", "none", "missing", "invalid", "inf", "-inf", "-",
    "--", "---",
];

/// Whether a field stands for a missing value.
pub(super) fn is_missing(field: &str) -> bool {
    field.is_empty() || MISSING.iter().any(|word| field.eq_ignore_ascii_case(word))
}

/// Parses the finite number of a field, with a decimal point or a decimal comma.
pub(super) fn number(field: &str) -> Option<f64> {
    let plain = field
        .strip_prefix('\u{2212}')
        .map(|rest| format!("-{rest}"));
    let field = plain.as_deref().unwrap_or(field);
    let value = match field.split_once(',') {
        Some((whole, rest)) if !field.contains('.') => format!("{whole}.{rest}").parse(),
        _ => field.parse(),
    };
    value.ok().filter(|value: &f64| value.is_finite())
}

/// Replaces the blanks of a line by tabs, except before a unit in brackets: `r [um]  wear [nm]` has two fields.
fn with_tabs(line: &str) -> String {
    let words: Vec<&str> = line.split_whitespace().collect();
    let joined = words.join("\t");
    joined.replace("\t[", " [").replace("\t(", " (")
}

/// A table found in a text.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    pub separator: Separator,
    /// Whether numbers have decimal commas.
    pub has_decimal_commas: bool,
    /// The first row with a decimal comma, where other rows have decimal points.
    pub mixed: Option<NumberedLine>,
    /// Number of fields of the line above the first row; 0 without one.
    pub fields_above: usize,
    /// Names of the columns; `None` if no line gives them.
    pub names: Option<Vec<String>>,
    /// Units from a separate line, or empty.
    pub units: Vec<String>,
    /// Number of columns.
    pub fields: usize,
    /// The rows from the first one with numbers.
    pub rows: Vec<NumberedLine>,
    /// The first row with another number of fields.
    pub uneven: Option<NumberedLine>,
}

impl Layout {
    /// Finds the table in a text.
    ///
    /// # Errors
    /// If the reader of records refuses it.
    pub fn find(text: &str) -> Result<Self, csv::Error> {
        let end = text
            .match_indices('\n')
            .nth(SAMPLE)
            .map_or(text.len(), |(at, _)| at);
        let mut best = (Separator::Comma, 0);
        for separator in Separator::ALL {
            let score = separator
                .records(&text[..end])
                .map_or(0, |rows| score(&rows));
            if score > best.1 {
                best = (separator, score);
            }
        }
        let separator = best.0;
        let mut rows = separator.records(text)?;
        let fields = usual_length(&rows);
        let is_number = numeric_columns(&rows, fields);
        let is_data = |row: &StringRecord| {
            let fits = |(field, is_number): (&str, &bool)| {
                !is_number || number(field).is_some() || is_missing(field)
            };
            row.len() == fields
                && row.iter().any(|field| number(field).is_some())
                && row.iter().zip(&is_number).all(fits)
        };
        let first = rows.iter().position(|(_, row)| is_data(row));
        let begin = first.unwrap_or(rows.len().min(1));
        let above: Vec<NumberedLine> = rows.drain(..begin).collect();
        let fields_above = above.last().map_or(0, |(_, row)| row.len());
        let begin = rows.first().map_or(u64::MAX, |(line, _)| *line);
        let (names, units) = names_and_units(text, &above, begin, fields);
        let mut fields = fields;
        let last_is_empty = || {
            rows.iter()
                .all(|(_, row)| row.get(fields - 1).is_some_and(str::is_empty))
        };
        // Separators at the ends of lines.
        if names
            .as_ref()
            .is_some_and(|names| names.len() + 1 == fields)
            && last_is_empty()
        {
            fields -= 1;
            rows.iter_mut().for_each(|(_, row)| row.truncate(fields));
        }
        let with_comma = rows
            .iter()
            .find(|(_, row)| row.iter().any(is_decimal_comma));
        let is_point = |field: &str| field.contains('.') && number(field).is_some();
        let has_points = rows.iter().any(|(_, row)| row.iter().any(is_point));
        let uneven = rows.iter().find(|(_, row)| row.len() != fields).cloned();
        Ok(Self {
            separator,
            has_decimal_commas: with_comma.is_some(),
            mixed: with_comma.filter(|_| has_points).cloned(),
            fields_above,
            names,
            units,
            fields,
            rows,
            uneven,
        })
    }
}

fn is_decimal_comma(field: &str) -> bool {
    field.contains(',') && number(field).is_some()
}

/// Counts the numbers in rows of several fields, minus the fields that only begin like a number.
fn score(rows: &[NumberedLine]) -> i64 {
    let worth = |field: &str| match number(field) {
        Some(_) => 1,
        None => -i64::from(
            field.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '"')
                && field.len() > 1,
        ),
    };
    let whole = rows.iter().filter(|(_, row)| row.len() > 1);
    whole.flat_map(|(_, row)| row.iter().map(worth)).sum()
}

/// Returns the most frequent number of fields among rows with numbers.
fn usual_length(rows: &[NumberedLine]) -> usize {
    let with_numbers = rows
        .iter()
        .filter(|(_, row)| row.len() > 1 && row.iter().any(|field| number(field).is_some()));
    let mut counts: Vec<(usize, usize)> = Vec::new();
    for (_, row) in with_numbers {
        match counts.iter_mut().find(|(length, _)| *length == row.len()) {
            Some((_, count)) => *count += 1,
            None => counts.push((row.len(), 1)),
        }
    }
    let most = counts.into_iter().rev().max_by_key(|(_, count)| *count);
    most.map_or_else(
        || rows.first().map_or(0, |(_, row)| row.len()),
        |(length, _)| length,
    )
}

/// Returns which columns contain numbers in half of the rows or more, ignoring the first half of the rows, where a
/// preamble may be.
fn numeric_columns(rows: &[NumberedLine], fields: usize) -> Vec<bool> {
    let alike = || rows.iter().filter(|(_, row)| row.len() == fields);
    let of_length = || alike().skip(alike().count() / 2);
    let numbers = |column: usize| {
        of_length()
            .filter(|(_, row)| row.get(column).is_some_and(|field| number(field).is_some()))
            .count()
    };
    let all = of_length().count();
    (0..fields)
        .map(|column| 2 * numbers(column) >= all)
        .collect()
}

/// Returns the lines above the first row that give names and units; a comment does so if no other line does.
fn names_and_units(
    text: &str,
    above: &[NumberedLine],
    begin: u64,
    fields: usize,
) -> (Option<Vec<String>>, Vec<String>) {
    let lines = || {
        text.lines()
            .zip(1u64..)
            .take_while(|(_, line)| *line < begin)
    };
    let words = |row: &StringRecord| -> Vec<String> { row.iter().map(str::to_owned).collect() };
    // A line of names may have other separators than the numbers.
    let split = |line: &str| {
        let found = Separator::ALL
            .into_iter()
            .filter_map(|separator| separator.records(line).ok()?.pop());
        let mut names = found.map(|(_, row)| words(&row));
        names.find(|names| names.len() == fields || fields > 2 && names.len() + 1 == fields)
    };
    let is_length =
        |row: &StringRecord| row.len() == fields || row.len() + 1 == fields && fields > 2;
    let mut found = above.iter().rev().filter_map(|(at, row)| {
        if is_length(row) {
            Some(words(row))
        } else {
            split(lines().find(|(_, line)| line == at)?.0)
        }
    });
    let nearest = found.next();
    let is_units = |row: &[String]| {
        row.iter().all(|unit| {
            is_unit(unit) || matches!(unit.as_str(), "" | "-" | "1" | "[-]" | "#" | "cycles")
        }) && row.iter().any(|unit| is_unit(unit))
    };
    match nearest {
        Some(units) if is_units(&units) => match found.next() {
            Some(names) => (Some(names), units),
            None => (Some(units), Vec::new()),
        },
        Some(names) => (Some(names), Vec::new()),
        None => {
            let is_comment = |line: &&str| line.starts_with('#') && !line.contains(':');
            let comments: Vec<&str> = lines()
                .map(|(line, _)| line.trim_start())
                .filter(is_comment)
                .collect();
            let named = comments
                .iter()
                .rev()
                .find_map(|line| split(line.trim_start_matches(['#', ' '])));
            (
                named.filter(|names| names.iter().all(|name| number(name).is_none())),
                Vec::new(),
            )
        }
    }
}
