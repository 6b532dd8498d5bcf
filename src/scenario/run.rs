//! What a scenario says about its own run: how long, what to keep, what was changed on the way.

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use crate::math::invalid::{Invalid, non_negative};

/// The longest run, in cycles.
pub const MOST_CYCLES: f64 = 1e9;

/// The most snapshots of a run.
pub const MOST_SNAPSHOTS: usize = 10_000;

/// `[run]`: how far a run goes and where it is written out.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RunPlan {
    /// Length of the run in cycles, 0 or more; none: until the user stops it.
    pub cycles: Option<f64>,
    /// Cycles at which the state is written; those after the end of the run are never reached.
    pub snapshot_at: Vec<f64>,
    /// How long the run was to be, in cycles, where it was stopped before or went further: what an accuracy has
    /// chosen by.
    pub planned: Option<f64>,
    /// A remark that is kept with the files.
    pub note: Option<String>,
}

impl RunPlan {
    /// Refuses cycles that are negative, not finite or absurdly many; the field is that of `[run]`.
    pub fn check(&self) -> Result<(), Invalid> {
        for (field, cycles) in [("cycles", self.cycles), ("planned", self.planned)] {
            let Some(cycles) = cycles else { continue };
            non_negative(field, cycles)?;
            if cycles > MOST_CYCLES {
                let rule = format!("must be {MOST_CYCLES:e} or less");
                return Err(Invalid::new(field, cycles, rule));
            }
        }
        let snapshots = self.snapshot_at.len();
        if snapshots > MOST_SNAPSHOTS {
            let rule = format!("must be {MOST_SNAPSHOTS} of them or fewer");
            return Err(Invalid::new("snapshot_at", snapshots, rule));
        }
        for &cycle in &self.snapshot_at {
            non_negative("snapshot_at", cycle).map_err(|invalid| {
                Invalid::new("snapshot_at", invalid.value, "each must be 0 or greater")
            })?;
        }
        Ok(())
    }

    pub(super) fn to_table(&self) -> Table {
        let mut table = Table::new();
        if let Some(cycles) = self.cycles {
            table.insert("cycles".into(), Value::Float(cycles));
        }
        table.insert("snapshot_at".into(), self.snapshot_at.clone().into());
        if let Some(planned) = self.planned {
            table.insert("planned".into(), Value::Float(planned));
        }
        if let Some(note) = &self.note {
            table.insert("note".into(), Value::String(note.clone()));
        }
        table
    }
}

/// `[[changes]]`: one key that was changed during the run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Change {
    /// When, in cycles since the start.
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

    /// The dotted path of what changes.
    pub fn key(&self) -> &str {
        self.set.split_once('=').map_or("", |(key, _)| key.trim())
    }

    pub(super) fn to_table(&self) -> Table {
        let mut table = Table::new();
        table.insert("at_cycle".into(), Value::Float(self.at_cycle));
        table.insert("set".into(), Value::String(self.set.clone()));
        table
    }
}
