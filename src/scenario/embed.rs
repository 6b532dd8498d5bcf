//! Tables that a scenario reads from files: read once, when the scenario is loaded, and stored in
//! it as lists of numbers. So the scenario of a run, or a checkpoint, needs no other file.

use std::path::{Path, PathBuf};

use toml::{Table, Value};

use super::columns::Columns;
use super::error::{Origin, ScenarioError};
use super::schema;

/// A list in a scenario, and the column that it is read from.
type List = (&'static str, &'static str, &'static str);

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
            &[("indenter.radii", "r", "m")],
            &[("indenter.heights", "f", "m")],
        ],
    },
    Embedded {
        file: "motion.normal.file",
        columns: [
            &[("motion.normal.times", "time", "s")],
            &[
                ("motion.normal.values", "u", "m"),
                ("motion.normal.values", "F", "N"),
                ("motion.normal.values", "value", ""),
            ],
        ],
    },
    Embedded {
        file: "motion.tangential.file",
        columns: [
            &[("motion.tangential.times", "time", "s")],
            &[
                ("motion.tangential.values", "u", "m"),
                ("motion.tangential.values", "F", "N"),
                ("motion.tangential.values", "value", ""),
            ],
        ],
    },
    Embedded {
        file: "friction.file",
        columns: [
            &[
                ("friction.at_cycle", "cycle", ""),
                ("friction.at_energy", "energy", "J"),
            ],
            &[("friction.values", "coefficient", "")],
        ],
    },
    Embedded {
        file: "wear.initial",
        columns: [
            &[("wear.initial_radii", "r", "m")],
            &[
                ("wear.initial_depths", "depth", "m"),
                ("wear.initial_depths", "wear", "m"),
            ],
        ],
    },
    Embedded {
        file: "wear.file",
        columns: [
            &[
                ("wear.at_cycle", "cycle", ""),
                ("wear.at_energy", "energy", "J"),
            ],
            &[("wear.values", "coefficient", "")],
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
        schema::remove(table, embedded.file);
        for lists in embedded.columns {
            let (path, name, unit) = *lists
                .iter()
                .find(|(_, name, unit)| columns.has(name, unit))
                .unwrap_or(&lists[0]);
            let values = columns.column(name, unit)?;
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
