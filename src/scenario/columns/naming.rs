//! Column names and units that the user gives because the file has none: `--fields r=2,wear=3 --units um,nm`, or in a
//! scenario `file = { file = "tip.csv", fields = "r=2,f=3", units = "um,nm" }`.

use std::str::FromStr;

use super::{Columns, Refusal, echo, names};

/// User-supplied column names and units.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Naming {
    /// Quantities and where they stand.
    pub fields: Vec<NamedField>,
    /// The units of these fields in their order, or else of the columns of the file.
    pub units: Vec<String>,
    /// The key of the scenario that names the file, if one does.
    pub key: Option<&'static str>,
}

impl Naming {
    /// Returns what the user would write to name `fields` and their `units`; either may be empty.
    pub(super) fn example(&self, fields: &str, units: &str) -> String {
        let both = [("fields", fields), ("units", units)];
        let given = both.iter().filter(|(_, value)| !value.is_empty());
        match self.key {
            Some(key) => {
                let entries = given.map(|(name, value)| format!(", {name} = \"{value}\""));
                format!(
                    "{key} = {{ file = \"...\"{} }}",
                    entries.collect::<String>()
                )
            }
            None => {
                let options = given.map(|(name, value)| format!("--{name} {value}"));
                options.collect::<Vec<_>>().join(" ")
            }
        }
    }
}

/// A quantity and its column, as in `r=2`.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedField {
    /// The quantity, as `r`.
    quantity: String,
    /// The column's number, from 1, or its name in the file.
    column: String,
}

impl FromStr for NamedField {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parts = text
            .split_once('=')
            .map(|(quantity, column)| (quantity.trim(), column.trim()));
        let (quantity, column) = parts
            .filter(|(quantity, column)| !quantity.is_empty() && !column.is_empty())
            .ok_or("a field is a quantity and the number of its column, e.g. r=2,wear=3")?;
        Ok(Self {
            quantity: quantity.to_owned(),
            column: column.to_owned(),
        })
    }
}

impl Columns {
    /// Names columns as the user does.
    pub(super) fn rename(&mut self, naming: &Naming) -> Result<(), Refusal> {
        let is_known = |unit: &str| names::is_unit(unit) || ["-", "1", "cycles"].contains(&unit);
        if let Some(unit) = naming.units.iter().find(|unit| !is_known(unit)) {
            let rule = "is not a unit such as um, nm, N, mm^3";
            return Err(self.refuse(format!(
                "{}: {}: {rule}",
                naming.example("", "..."),
                echo(unit)
            )));
        }
        if naming.fields.is_empty() {
            let named = self.own.iter_mut().zip(&self.names);
            for ((own, name), unit) in named.zip(&naming.units) {
                *own = names::in_own_unit(name, unit);
            }
        }
        for (k, NamedField { quantity, column }) in naming.fields.iter().enumerate() {
            let by_number = column
                .parse()
                .ok()
                .filter(|number| (1..=self.own.len()).contains(number));
            let by_name = || self.names.iter().position(|name| name == column);
            let Some(at) = by_number.map(|number: usize| number - 1).or_else(by_name) else {
                let (count, named) = (self.own.len(), self.list_names());
                return Err(self.refuse(format!(
                    "{}: has {count} columns, {named}",
                    naming.example(&format!("{quantity}={column}"), "")
                )));
            };
            // A unit that stands in the file holds unless another is given.
            let (in_file, ratio) = &self.own[at];
            let in_file = in_file.rsplit_once('_').map_or("", |(_, unit)| unit);
            let named = match naming.units.get(k) {
                Some(unit) => names::in_own_unit(quantity, unit),
                None if names::is_unit(in_file) => (format!("{quantity}_{in_file}"), *ratio),
                None => names::in_own_unit(quantity, ""),
            };
            // Another column of this name gives way.
            for (own, _) in self.own.iter_mut().filter(|(own, _)| *own == named.0) {
                own.insert(0, '_');
            }
            self.own[at] = named;
        }
        Ok(())
    }
}
