//! Tables that a scenario reads from files: read once, when the scenario is loaded, and stored in
//! it as lists of numbers. So the scenario of a run, or a checkpoint, needs no other file.

use std::path::Path;

use toml::{Table, Value};

use super::check::show;
use super::columns::Columns;
use super::error::{Origin, ScenarioError};
use super::keys::{self, Motion, RunsIn};
use super::schema;

/// A list in a scenario, and the name and unit of the column that it is read from.
type List = (&'static str, &'static str, &'static str);

/// A key that names a file, and its two columns; of those that may stand for each, the first that the
/// file has.
type Embedded = (&'static str, [Vec<List>; 2]);

/// Every key that names a file.
fn embedded() -> Vec<Embedded> {
    let motion = |of: &Motion| {
        let values = [("u", "m"), ("F", "N"), ("value", "")];
        let values = values.map(|(name, unit)| (of.values.path(), name, unit));
        let times = vec![(of.times.path(), "time", "s")];
        (of.file.path(), [times, values.to_vec()])
    };
    let course = |of: &RunsIn| {
        let cycles = (of.at_cycle.path(), "cycle", "");
        let energies = (of.at_energy.path(), "energy", "J");
        let values = vec![(of.values.path(), "coefficient", "")];
        (of.file.path(), [vec![cycles, energies], values])
    };
    let shape = [
        vec![(keys::RADII.path(), "r", "m")],
        vec![(keys::HEIGHTS.path(), "f", "m")],
    ];
    let depths = ["depth", "wear"].map(|name| (keys::WEAR_INITIAL_DEPTHS.path(), name, "m"));
    let radii = vec![(keys::WEAR_INITIAL_RADII.path(), "r", "m")];
    vec![
        (keys::TABLE_FILE.path(), shape),
        motion(&keys::NORMAL),
        motion(&keys::TANGENTIAL),
        course(&keys::FRICTION_COURSE),
        (keys::WEAR_INITIAL.path(), [radii, depths.to_vec()]),
        course(&keys::WEAR_COURSE),
    ]
}

/// Reads the files that `table` names, relative to the directory of the scenario's file, and puts
/// their columns in their place. Values that are not paths stay, for the check of all keys to reject.
pub(super) fn files(
    table: &mut Table,
    scenario: &str,
    origin: &mut Origin,
) -> Result<(), ScenarioError> {
    for (key, lists) in embedded() {
        let Some(value @ Value::String(file)) = schema::at(table, key) else {
            continue;
        };
        let place = origin.place(key, &show(value));
        // A preset has no directory.
        let directory = Path::new(scenario).parent().unwrap_or(Path::new(""));
        let columns = Columns::read(&directory.join(file))?;
        schema::remove(table, key);
        for lists in lists {
            let there = lists.iter().find(|list| columns.has(list.1, list.2));
            let &(path, name, unit) = there.unwrap_or(&lists[0]);
            let values = columns.column(name, unit)?;
            schema::insert(table, path, values.into());
            origin.assign(path, &place);
        }
    }
    Ok(())
}
