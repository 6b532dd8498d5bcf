//! Tables that a scenario reads from files: read once, when the scenario is loaded, and stored in
//! it as lists of numbers. So the scenario of a run, or a checkpoint, needs no other file.

use std::path::{Path, PathBuf};

use toml::{Table, Value};

use super::columns::{Columns, Quantity};
use super::error::{Origin, ScenarioError};
use super::schema;

/// A list in a scenario, and the column that it is read from.
type List = (&'static str, &'static str, Quantity);

/// A key that names a file, and its two columns; of those that may stand for each, the first that the
/// file has.
struct Embedded {
    file: &'static str,
    columns: [&'static [List]; 2],
}

/// Every key that names a file.
const FILES: &[Embedded] = &[
    Embedded {
        file: "indenter.file",
        columns: [
            &[("indenter.radii", "r", Quantity::Length)],
            &[("indenter.heights", "f", Quantity::Length)],
        ],
    },
    Embedded {
        file: "motion.normal.file",
        columns: [
            &[("motion.normal.times", "time", Quantity::Time)],
            &[
                ("motion.normal.values", "u", Quantity::Length),
                ("motion.normal.values", "F", Quantity::Force),
                ("motion.normal.values", "value", Quantity::Number),
            ],
        ],
    },
    Embedded {
        file: "motion.tangential.file",
        columns: [
            &[("motion.tangential.times", "time", Quantity::Time)],
            &[
                ("motion.tangential.values", "u", Quantity::Length),
                ("motion.tangential.values", "F", Quantity::Force),
                ("motion.tangential.values", "value", Quantity::Number),
            ],
        ],
    },
    Embedded {
        file: "friction.file",
        columns: [
            &[
                ("friction.at_cycle", "cycle", Quantity::Number),
                ("friction.at_energy", "energy", Quantity::Energy),
            ],
            &[("friction.values", "coefficient", Quantity::Number)],
        ],
    },
    Embedded {
        file: "wear.initial",
        columns: [
            &[("wear.initial_radii", "r", Quantity::Length)],
            &[
                ("wear.initial_depths", "depth", Quantity::Length),
                ("wear.initial_depths", "wear", Quantity::Length),
            ],
        ],
    },
    Embedded {
        file: "wear.file",
        columns: [
            &[
                ("wear.at_cycle", "cycle", Quantity::Number),
                ("wear.at_energy", "energy", Quantity::Energy),
            ],
            &[("wear.values", "coefficient", Quantity::Number)],
        ],
    },
];

/// Reads the files that `table` names, relative to the directory of the scenario's file, and puts
/// their columns in their place. Values that are not paths stay, for the check of all keys to reject.
pub(super) fn files(
    table: &mut Table,
    scenario: &str,
    origin: &mut Origin,
) -> Result<(), ScenarioError> {
    for embedded in FILES {
        let Some(Value::String(file)) = schema::at(table, embedded.file) else {
            continue;
        };
        let file = file.clone();
        let shown = super::check::show(&Value::String(file.clone()));
        let place = origin.place(embedded.file, &shown);
        let columns = Columns::read(&beside(scenario, &file))?;
        remove(table, embedded.file);
        for lists in embedded.columns {
            let (path, name, quantity) = *lists
                .iter()
                .find(|(_, name, quantity)| columns.has(name, *quantity))
                .unwrap_or(&lists[0]);
            let values = columns.column(name, quantity)?;
            schema::insert(table, path, values.into());
            origin.assign(path, &place);
        }
    }
    Ok(())
}

/// `file` as seen from the directory of `scenario`; a preset has none.
fn beside(scenario: &str, file: &str) -> PathBuf {
    match Path::new(scenario).parent() {
        Some(directory) => directory.join(file),
        None => PathBuf::from(file),
    }
}

fn remove(table: &mut Table, path: &str) {
    match path.split_once('.') {
        None => {
            table.remove(path);
        }
        Some((first, rest)) => {
            if let Some(Value::Table(inner)) = table.get_mut(first) {
                remove(inner, rest);
            }
        }
    }
}
