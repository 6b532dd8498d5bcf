//! `mdr-tui guide [TOPIC]`: the long documentation, in a pager if stdout is a terminal.

use std::io::{self, IsTerminal, Write};
use std::process::{Command, Stdio};

use anyhow::Result;

use super::args::Guide;
use crate::guide::{TOPICS, Topic};
use crate::scenario::Refusal;
use crate::scenario::hint::hint;
use crate::tui::line::{cells, wrapped};

/// Shows a topic, or the list of topics if none is given.
pub fn guide(options: &Guide) -> Result<()> {
    let Some(name) = &options.topic else {
        return Ok(io::stdout().write_all(list().as_bytes())?);
    };
    let topic = Topic::find(name).ok_or_else(|| unknown(name))?;
    let shown = if io::stdout().is_terminal() {
        page(&fitted(topic.text, columns()))
    } else {
        io::stdout().write_all(topic.text.as_bytes())
    };
    Ok(shown?)
}

/// Returns the width of the terminal, in cells; 80 if it is unknown.
pub(super) fn columns() -> usize {
    let size = crossterm::terminal::size().ok();
    let columns = size.map(|(columns, _)| usize::from(columns));
    columns.filter(|columns| *columns > 0).unwrap_or(80)
}

fn list() -> String {
    let line = |topic: &Topic| format!("  {:<12} {}\n", topic.name, topic.about);
    let topics: String = TOPICS.iter().map(line).collect();
    format!("Topics:\n{topics}\nRead one with: mdr-tui guide TOPIC\n")
}

fn unknown(name: &str) -> Refusal {
    let hint = hint(name, TOPICS.iter().map(|topic| topic.name));
    Refusal::new(format_args!("guide {name}"), "no such topic").or(hint)
}

/// Breaks lines that are wider than the terminal at blanks; leaves code unchanged.
fn fitted(text: &str, columns: usize) -> String {
    let (mut is_code, mut fitted) = (false, String::new());
    for line in text.lines() {
        is_code ^= line.starts_with("```");
        let lines = if is_code || cells(line) <= columns {
            vec![line.to_owned()]
        } else {
            wrapped(line, columns)
        };
        fitted += &(lines.join("\n") + "\n");
    }
    fitted
}

/// Shows the text in `$PAGER` or `less`; prints it if neither works.
fn page(text: &str) -> io::Result<()> {
    let pager = std::env::var("PAGER").unwrap_or_default();
    let mut words = pager.split_whitespace();
    let mut command = Command::new(words.next().unwrap_or("less"));
    command.args(words).stdin(Stdio::piped());
    if std::env::var_os("LESS").is_none() {
        // As git does: quit at once if the text fits, keep colours, leave the text on the screen.
        command.env("LESS", "FRX");
    }
    let Ok(mut pager) = command.spawn() else {
        return io::stdout().write_all(text.as_bytes());
    };
    if let Some(mut input) = pager.stdin.take() {
        // Quitting the pager early closes the pipe.
        let _ = input.write_all(text.as_bytes());
    }
    pager.wait().map(|_| ())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_terminal_breaks_lines_at_blanks_and_leaves_code_and_words_whole() {
        let code = "```sh\na line of code, however long it may be\n```\n";
        let text = format!("# A\n{code}one two three\n| `a` | b |\n");
        let broken = "one two\nthree\n| `a` | b\n|\n";
        assert_eq!(fitted(&text, 9), format!("# A\n{code}{broken}"));
        for topic in TOPICS {
            // Rules of tables may be wider than the terminal.
            let is_word = |word: &&str| word.contains(char::is_alphanumeric);
            let shown = fitted(topic.text, 80);
            let shown = shown.split_whitespace().filter(is_word);
            let whole = topic.text.split_whitespace().filter(is_word);
            assert!(shown.eq(whole), "{}", topic.name);
        }
    }

    #[test]
    fn a_mistyped_topic_is_led_to_the_nearest() {
        assert!(
            unknown("method")
                .to_string()
                .ends_with("did you mean methods?")
        );
        assert!(
            unknown("zzzzzz")
                .to_string()
                .contains("known are physics, ")
        );
    }
}
