//! One key that changes during a run.

use serde::{Deserialize, Serialize};

/// Maximum number of changes of a run. Each is checked by assembling the scenario that results.
pub const MOST_CHANGES: usize = 1_000;

/// `[[changes]]`: one key that was changed during the run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Change {
    /// Cycles since the start.
    pub at_cycle: f64,
    /// The key and its new value, `KEY = VALUE` with the value as TOML.
    pub set: String,
}

impl Change {
    /// The change of `key` to `value` (as TOML, or a bare word) at `at_cycle` cycles.
    pub fn new(at_cycle: f64, key: &str, value: &str) -> Self {
        Self {
            at_cycle,
            set: format!("{key} = {value}"),
        }
    }

    /// Returns the dotted path of the changed key.
    pub fn key(&self) -> &str {
        self.set.split_once('=').map_or("", |(key, _)| key.trim())
    }

    /// Returns the new value, as TOML or as a bare word.
    pub fn value(&self) -> &str {
        self.set
            .split_once('=')
            .map_or("", |(_, value)| value.trim())
    }
}
