//! Embeds tables from files: they are read once, when the scenario is loaded, and stored in it as lists of numbers, so
//! that the scenario of a run, or a checkpoint, needs no other file.

use std::path::Path;

use toml::{Table, Value};

use super::check::show;
use super::columns::{Columns, Naming};
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
        let Some(value @ (Value::String(_) | Value::Table(_))) = values::at(table, key) else {
            continue;
        };
        let place = origin.place(key, &show(value));
        let (file, naming) = named_file(key, value).ok_or_else(|| {
            let example = "{ file = \"tip.csv\", fields = \"r=2,f=3\", units = \"um,nm\" }";
            let rule = format!("must be the path of a file, or as in {example}");
            origin.refuse(key, &show(value), rule)
        })?;
        let columns = Columns::read_as(&directory.join(file), &naming)?;
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

/// Returns the path and the columns that `value` names; `None` if it is neither a path nor a table of them.
fn named_file<'a>(key: &'static str, value: &'a Value) -> Option<(&'a str, Naming)> {
    let mut naming = Naming {
        key: Some(key),
        ..Naming::default()
    };
    let Value::Table(given) = value else {
        return Some((value.as_str()?, naming));
    };
    for (name, value) in given {
        let parts = || value.as_str().map(|text| text.split(',').map(str::trim));
        match name.as_str() {
            "file" => {}
            "fields" => naming.fields = parts()?.map(str::parse).collect::<Result<_, _>>().ok()?,
            "units" => naming.units = parts()?.map(str::to_owned).collect(),
            _ => return None,
        }
    }
    Some((given.get("file")?.as_str()?, naming))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(indenter: &str) -> Result<Table, Refusal> {
        let text = format!("[indenter]\nshape = \"table\"\n{indenter}\n");
        let mut table: Table = text.parse().expect("TOML");
        let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
        files(&mut table, &directory, &mut Origin::new("tip.toml"))?;
        Ok(table)
    }

    #[test]
    fn columns_without_names_are_named_in_the_scenario() {
        let named = r#"file = { file = "bare_tip.txt", fields = "r=2, f=3", units = "um, nm" }"#;
        let table = table(named).expect("columns");
        let list = |key| {
            values::at(&table, key)
                .and_then(Value::as_array)
                .expect("a list")[1]
                .as_float()
        };
        let found = ["indenter.radii", "indenter.heights"].map(|key| list(key).expect("a number"));
        assert!(
            (found[0] / 10e-6 - 1.0).abs() < 1e-12 && (found[1] / 5e-9 - 1.0).abs() < 1e-12,
            "{found:?}"
        );
    }

    #[test]
    fn what_is_wrong_is_told_with_the_words_of_the_scenario() {
        let message = |indenter| table(indenter).expect_err("refused").to_string();
        let bare = message(r#"file = "bare_tip.txt""#);
        let remedy = r#"line 1: begins the numbers, and a line before must name the columns, as in r_m,f_m; or name them with indenter.file = { file = "...", fields = "r=1,wear=2", units = "um,nm" }"#;
        assert!(
            bare.contains("bare_tip.txt") && bare.contains(remedy),
            "{bare}"
        );
        let absent =
            message(r#"file = { file = "bare_tip.txt", fields = "r=2,f=9", units = "um,nm" }"#);
        assert!(
            absent.contains(r#"fields = "f=9" }: has 3 columns"#),
            "{absent}"
        );
        let unit = message(
            r#"file = { file = "bare_tip.txt", fields = "r=2,f=3", units = "um,furlong" }"#,
        );
        assert!(unit.contains("furlong: is not a unit"), "{unit}");
        for wrong in [
            "file = { path = \"x\" }",
            "file = { file = 3 }",
            r#"file = { file = "x", fields = "r" }"#,
        ] {
            let wrong = message(wrong);
            assert!(
                wrong.contains("must be the path of a file, or as in { file = "),
                "{wrong}"
            );
        }
    }
}
