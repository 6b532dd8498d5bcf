//! The `[run]` table: length, snapshots, and what the files of the run state.

use serde::{Deserialize, Serialize};

/// The longest run, in cycles.
pub const MOST_CYCLES: f64 = 1e9;

/// Maximum number of snapshots of a run.
pub const MOST_SNAPSHOTS: usize = 10_000;

/// `[run]`: how far a run goes and where it is written out.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RunPlan {
    /// Length of the run in cycles, 0 or more; `None`: until the user stops it.
    pub cycles: Option<f64>,
    /// Cycles at which the state is written; those after the end of the run are never reached.
    pub snapshot_at: Vec<f64>,
    /// Cycles that a step or a jump was cut short for although the run went on, as the planned end is
    /// that the explorer went past. Without them, a replay would take other steps.
    pub shortened_at: Vec<f64>,
    /// A remark that is kept with the files.
    pub note: Option<String>,
    /// What the files of the recorded run state of its errors, sealed by
    /// [`Scenario::stating`](super::Scenario::stating).
    pub stated: Option<String>,
}

/// Between the parts of [`RunPlan::stated`], the last of which is the seal.
const BETWEEN: &str = " | ";

impl RunPlan {
    /// Sets the statements, keys and values, with the seal of the scenario that they are about.
    pub(super) fn state(&mut self, statements: &[(String, String)], seal: &str) {
        let entries = statements.iter().map(|(key, value)| {
            let value = value.replace(BETWEEN, ", ");
            format!("{key}: {value}{BETWEEN}")
        });
        self.stated = (!statements.is_empty()).then(|| entries.collect::<String>() + seal);
    }

    /// The statements, keys and values, and the seal of the scenario that they are about.
    pub(super) fn statements(&self) -> Option<(Vec<(String, String)>, &str)> {
        let (entries, seal) = self.stated.as_deref()?.rsplit_once(BETWEEN)?;
        let entries = entries.split(BETWEEN).map(|entry| {
            let (key, value) = entry.split_once(": ")?;
            Some((key.to_owned(), value.to_owned()))
        });
        Some((entries.collect::<Option<_>>()?, seal))
    }
}
