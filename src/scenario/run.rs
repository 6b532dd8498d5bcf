//! The `[run]` table: length, snapshots, and the statements in the files of the run.

use super::value::{Field, Section, fields, section};

/// Maximum length of a run, in cycles.
pub const MOST_CYCLES: f64 = 1e9;

/// Maximum number of snapshots of a run.
pub const MOST_SNAPSHOTS: usize = 10_000;

section! {
    /// `[run]`: the length of a run and its output.
    RunPlan {
        /// Length of the run in cycles, 0 or more; `None` runs until the user stops it.
        cycles: Option<f64>,
        /// Cycles at which the state is written; those after the end of the run are ignored.
        snapshot_at: Vec<f64>,
        /// Cycles at which a step or jump was cut short although the run continued, such as a planned end that the explorer
        /// went past. Without them, a replay would take other steps.
        shortened_at: Vec<f64>,
        /// A remark to store in the files.
        note: Option<String>,
        /// Statements of the recorded run's files on its errors, sealed by [`Scenario::stating`](super::Scenario::stating).
        stated: Option<String>,    }
}

/// Separates the parts of [`RunPlan::stated`], the last of which is the seal.
const BETWEEN: &str = " | ";

impl RunPlan {
    /// Sets the statements, keys and values, with the seal of their scenario.
    pub(super) fn state(&mut self, statements: &[(String, String)], seal: &str) {
        let entries = statements.iter().map(|(key, value)| {
            let value = value.replace(BETWEEN, ", ");
            format!("{key}: {value}{BETWEEN}")
        });
        self.stated = (!statements.is_empty()).then(|| entries.collect::<String>() + seal);
    }

    /// Returns the statements, keys and values, and the seal of their scenario.
    pub(super) fn statements(&self) -> Option<(Vec<(String, String)>, &str)> {
        let (entries, seal) = self.stated.as_deref()?.rsplit_once(BETWEEN)?;
        let entries = entries.split(BETWEEN).map(|entry| {
            let (key, value) = entry.split_once(": ")?;
            Some((key.to_owned(), value.to_owned()))
        });
        Some((entries.collect::<Option<_>>()?, seal))
    }
}
