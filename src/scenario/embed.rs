//! Embeds tables from files: they are read once, when the scenario is loaded, and stored in it as lists of numbers, so
//! that the scenario of a run, or a checkpoint, needs no other file.

use std::path::Path;

use toml::{Table, Value};

use super::check::show;
use super::columns::Columns;
use super::error::{Origin, Refusal};
use super::{schema, values};

/// Reads the files that `table` names, relative to the `directory` of the scenario's file, and puts
/// their columns in their place. Values that are not paths stay, for the check of all keys to reject. Returns a line for
/// each file with rows that have missing values, which are left out.
pub(super) fn files(
    table: &mut Table,
    directory: &Path,
    origin: &mut Origin,
) -> Result<Vec<String>, Refusal> {
    let mut notes = Vec::new();
    for schema::Embedded { key, lists } in &schema::SCHEMA.files {
        let Some(value @ Value::String(file)) = values::at(table, key) else {
            continue;
        };
        let place = origin.place(key, &show(value));
        let columns = Columns::read(&directory.join(file))?;
        values::remove(table, key);
        let found = lists.each_ref().map(|lists| {
            let there = lists.iter().find(|(_, name)| columns.has(name));
            there.unwrap_or(&lists[0])
        });
        let (values, rows) = columns.whole_rows(found.map(|(_, name)| *name))?;
        let left_out = columns.left_out(&rows);
        notes.extend(left_out.map(|note| format!("{}: {note}", columns.path)));
        for ((path, _), values) in found.into_iter().zip(values) {
            values::insert(table, path, values.into());
            origin.assign(path, &place);
        }
    }
    Ok(notes)
}
