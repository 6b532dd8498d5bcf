//! Formats Markdown for a terminal: paragraphs, lists and tables fitted to its width, headings in bold, code unchanged.

use crate::tui::line::{cells, wrapped};

/// The widest text that is easy to read, in cells.
const WIDEST: usize = 100;

/// The gap between the columns of a table, and the width of the narrowest column, in cells.
const GAP: usize = 2;
const NARROWEST: usize = 8;

/// Returns the text in lines of at most `columns` cells; lines of code are never broken.
pub fn rendered(text: &str, columns: usize) -> String {
    let width = columns.clamp(20, WIDEST);
    let mut lines = text.lines().peekable();
    let mut out = String::new();
    let mut write = |line: &str| out.push_str(&format!("{}\n", line.trim_end()));
    while let Some(line) = lines.next() {
        let goes_on = |next: &&str| !next.trim().is_empty() && kind(next) == Kind::Text;
        match kind(line) {
            _ if line.trim().is_empty() => write(""),
            Kind::Fence => {
                let code = lines.by_ref().take_while(|line| kind(line) != Kind::Fence);
                code.for_each(|line| write(&format!("    {line}")));
            }
            Kind::Heading => write(&bold(line.trim_start_matches('#').trim())),
            Kind::Row => {
                let mut rows = vec![row(line)];
                while let Some(line) = lines.next_if(|line| kind(line) == Kind::Row) {
                    rows.push(row(line));
                }
                table(rows, width).iter().for_each(|line| write(line));
            }
            Kind::Item | Kind::Text => {
                let mut text = line.trim().to_owned();
                while let Some(line) = lines.next_if(goes_on) {
                    text.push(' ');
                    text.push_str(line.trim());
                }
                // The lines of an item are indented by its mark.
                let before = line.len() - line.trim_start().len();
                let hang = match kind(line) {
                    Kind::Item => text.find(' ').map_or(0, |at| at + 1),
                    _ => 0,
                };
                let room = width.saturating_sub(before + hang);
                for (k, line) in wrapped(&plain(&text[hang..]), room).iter().enumerate() {
                    let mark = if k == 0 { &text[..hang] } else { "" };
                    write(&format!("{:before$}{mark:hang$}{line}", ""));
                }
            }
        }
    }
    out
}

/// The kinds of lines.
#[derive(PartialEq)]
enum Kind {
    Fence,
    Heading,
    Row,
    Item,
    Text,
}

fn kind(line: &str) -> Kind {
    let text = line.trim_start();
    let digits = text.trim_start_matches(|c: char| c.is_ascii_digit());
    let is_numbered = digits.len() < text.len() && digits.starts_with(". ");
    match text {
        _ if text.starts_with("```") => Kind::Fence,
        _ if line.starts_with('#') => Kind::Heading,
        _ if text.starts_with('|') => Kind::Row,
        _ if text.starts_with("- ") || text.starts_with("* ") || is_numbered => Kind::Item,
        _ => Kind::Text,
    }
}

fn bold(text: &str) -> String {
    format!("\u{1b}[1m{}\u{1b}[0m", plain(text))
}

/// Returns a text without emphasis marks; a web link is followed by its address.
fn plain(text: &str) -> String {
    let mut rest = text.replace("**", "");
    let mut out = String::new();
    while let Some((before, label, address, after)) = link(&rest) {
        out.push_str(&if address.starts_with("http") {
            format!("{before}{label} ({address})")
        } else {
            format!("{before}{label}")
        });
        rest = after.to_owned();
    }
    out + &rest
}

/// Splits a text into what precedes a link, its label, its address, and what follows.
fn link(text: &str) -> Option<(&str, &str, &str, &str)> {
    let (head, tail) = text.split_once("](")?;
    let (before, label) = head.rsplit_once('[')?;
    let (address, after) = tail.split_once(')')?;
    Some((before, label, address, after))
}

/// Returns the cells of a table row; a bar in code or after a backslash is not a separator.
fn row(line: &str) -> Vec<String> {
    let line = line.trim().trim_start_matches('|');
    let line = line.strip_suffix('|').unwrap_or(line);
    let (mut cells, mut in_code, mut is_escaped) = (vec![String::new()], false, false);
    for sign in line.chars() {
        let last = cells.len() - 1;
        match sign {
            '|' if !in_code && !is_escaped => cells.push(String::new()),
            '\\' if !in_code => {}
            sign => {
                in_code ^= sign == '`';
                cells[last].push(sign);
            }
        }
        is_escaped = sign == '\\';
    }
    cells.iter().map(|cell| plain(cell.trim())).collect()
}

/// Returns a table in lines. The widest columns are narrowed until it fits, and their texts are wrapped.
fn table(mut rows: Vec<Vec<String>>, width: usize) -> Vec<String> {
    let is_rule = |row: &Vec<String>| {
        row.iter()
            .all(|cell| !cell.is_empty() && cell.chars().all(|sign| "-:".contains(sign)))
    };
    rows.retain(|row| !is_rule(row));
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    rows.iter_mut()
        .for_each(|row| row.resize(count, String::new()));
    let widest = |k: usize| rows.iter().map(|row| cells(&row[k])).max().unwrap_or(0);
    let mut widths: Vec<usize> = (0..count).map(widest).collect();
    let room = width.saturating_sub(GAP * count.saturating_sub(1));
    while widths.iter().sum::<usize>() > room {
        let Some(most) = widths.iter_mut().max().filter(|most| **most > NARROWEST) else {
            break;
        };
        *most -= 1;
    }
    let mut lines = Vec::new();
    for (at, row) in rows.iter().enumerate() {
        let broken = row.iter().zip(&widths);
        let broken: Vec<_> = broken.map(|(cell, width)| wrapped(cell, *width)).collect();
        for k in 0..broken.iter().map(Vec::len).max().unwrap_or(0) {
            let parts = broken.iter().zip(&widths).map(|(part, width)| {
                let text = part.get(k).map_or("", String::as_str);
                format!("{text}{:1$}", "", width.saturating_sub(cells(text)))
            });
            let line = parts.collect::<Vec<_>>().join(&" ".repeat(GAP));
            lines.push(if at == 0 { bold(line.trim_end()) } else { line });
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::guide::TOPICS;

    #[test]
    fn paragraphs_lists_and_tables_fit_the_width() {
        let text = "# A\n```sh\n# a comment\n```\none **two**\nthree [four](x) five\n\n- six seven\n  eight\n\n\
                    | a | b |\n|---|---|\n| `x|y` | many words in a cell |\n";
        let expected = "\u{1b}[1mA\u{1b}[0m\n    # a comment\none two three four\nfive\n\n- six seven eight\n\n\
                        \u{1b}[1ma      b\u{1b}[0m\n`x|y`  many words in\n       a cell\n";
        assert_eq!(rendered(text, 20), expected);
    }

    #[test]
    fn no_topic_is_wider_than_a_terminal_but_for_code() {
        for topic in TOPICS {
            for width in [60, 80, 120] {
                let text = rendered(topic.text, width);
                let is_wide = |line: &&str| cells(line) > width + 8 && !line.starts_with("    ");
                assert_eq!(text.lines().find(is_wide), None, "{}", topic.name);
                // Every word is there, unbroken.
                let words = |text: &str| {
                    let text = text.replace(['|', '*', '#', '\\'], " ");
                    text.split_whitespace()
                        .filter(|word| word.len() > 3)
                        .count()
                };
                assert!(words(&text) * 10 > words(topic.text) * 9, "{}", topic.name);
            }
        }
    }
}
