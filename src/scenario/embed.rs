//! Names of files in a scenario.

use toml::Value;

use super::columns::Naming;

/// Returns the path and the columns that `value` names; `None` if it is neither a path nor a table of them.
pub(super) fn named_file<'a>(key: &'static str, value: &'a Value) -> Option<(&'a str, Naming)> {
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
