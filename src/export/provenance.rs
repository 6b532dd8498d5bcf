//! How the files of a run were made: facts on which their contents do not depend, but which a reader may want.
//!
//! These are in a separate file, because the tables of a run are byte for byte the same whenever and wherever it is
//! repeated with the same arithmetic (named in their headers); a date in them would break that.

use std::env::consts::{ARCH, OS};
use std::fs;
use std::path::Path;
use std::time::UNIX_EPOCH;

use serde::Deserialize;
use toml::Value;

use super::file::shell_word;
use super::header;
use crate::scenario::bounded_read;
use crate::scenario::value::literal;

/// The name of the file.
pub const FILE: &str = "provenance.toml";

/// The largest such file to be read, in bytes: the names of ten thousand snapshots.
const LARGEST: u64 = 1 << 20;

/// The version, with the commit if known.
pub const VERSION: &str = env!("MDR_TUI_VERSION");

/// What the file says of the run whose folder it lies in.
#[derive(Debug, Deserialize)]
pub struct Provenance {
    /// The identity of the run.
    pub run: String,
    /// The names of the files that the run writes.
    #[serde(default)]
    pub files: Vec<String>,
}

impl Provenance {
    /// Reads the file in a directory, if there is one.
    pub fn read(directory: &Path) -> Option<Self> {
        let text = bounded_read::text(&directory.join(FILE), LARGEST).ok()?;
        toml::from_str(&text).ok()
    }

    /// Returns the contents of the file: the run, this process and its machine.
    pub fn text(&self) -> String {
        let about =
            "# mdr-tui: how the files beside this one were made; they do not depend on it\n";
        let files: Vec<Value> = self.files.iter().cloned().map(Value::from).collect();
        let known: [(&str, Value); 8] = [
            ("version", VERSION.into()),
            ("command", command().into()),
            ("run", self.run.as_str().into()),
            ("files", files.into()),
            ("date", date(now()).into()),
            ("system", format!("{OS} {ARCH}").into()),
            (
                "processor",
                processor().unwrap_or_else(|| "unknown".into()).into(),
            ),
            ("arithmetic", header::arithmetic().into()),
        ];
        let lines = known.map(|(key, known)| format!("{key} = {}\n", literal(&known)));
        about.to_owned() + &lines.concat()
    }
}

/// Returns the command line, quoted for a shell.
fn command() -> String {
    let words = std::env::args_os().skip(1);
    let words = words.map(|word| shell_word(&word));
    words.fold("mdr-tui".to_owned(), |line, word| line + " " + &word)
}

/// Returns the seconds since 1970, from `SOURCE_DATE_EPOCH`, as in reproducible builds, or from the clock.
fn now() -> u64 {
    let given = std::env::var("SOURCE_DATE_EPOCH").ok();
    let since = || UNIX_EPOCH.elapsed().map_or(0, |since| since.as_secs());
    let given = given.and_then(|given| given.parse().ok());
    given.unwrap_or_else(since)
}

/// Formats a moment in ISO 8601, in UTC. Days are counted from 1 March of the year 0, so that a leap day is the last of
/// its year (H. Hinnant, "chrono-compatible low-level date algorithms").
fn date(seconds: u64) -> String {
    let (days, second) = (seconds / 86_400 + 719_468, seconds % 86_400);
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (year, month) = match month {
        0..=9 => (year + 400 * era, month + 3),
        _ => (year + 400 * era + 1, month - 9),
    };
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

/// Returns the name of the processor, if the system provides it.
fn processor() -> Option<String> {
    let about = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = about.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        for (seconds, shown) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_709_251_199, "2024-02-29T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
            (1_795_391_999, "2026-11-22T23:59:59Z"),
        ] {
            assert_eq!(date(seconds), shown);
        }
    }
}
