//! Load blocks: `[[blocks]]`, each a number of cycles with its own motion and load.
//!
//! The first block gives the start of the scenario, and every later one changes keys where it begins. Blocks therefore
//! become `[[changes]]`: the profile is carried over, and the `scenario.toml` of a run holds the changes.

use toml::{Table, Value};

use super::error::Refusal;
use super::escape::echo;
use super::fault::Faults;
use super::value::{number, show};

/// The tables whose keys a block may change.
const CHANGEABLE: [&str; 3] = ["motion", "friction", "wear"];

/// What blocks stand for.
#[derive(Default)]
pub(super) struct Blocks {
    /// The table of the first block.
    pub first: Table,
    /// Changes at the beginnings of the others: cycle, path, value and place.
    pub changes: Vec<(f64, String, Value, String)>,
    /// Their total length.
    pub cycles: f64,
}

/// Reads blocks.
///
/// # Errors
///
/// What is no block, `[[changes]]`, and an assignment to a key that a block sets.
pub(super) fn expand(
    blocks: &Value,
    changes: Option<&Value>,
    faults: &Faults,
) -> Result<Blocks, Refusal> {
    let refuse =
        |path: &str, value: &str, rule: &str| Err(Refusal::new(faults.place(path, value), rule));
    let rule = "must be an array of tables, [[blocks]] with cycles and the keys that change";
    let list = blocks.as_array().filter(|list| !list.is_empty());
    let list = list.map(|list| list.iter().map(Value::as_table).collect::<Option<Vec<_>>>());
    let Some(list) = list.flatten() else {
        return refuse("blocks", &show(blocks), rule);
    };
    if let Some(changes) = changes {
        let rule = "conflicts with [[blocks]]; give one of them";
        return refuse("changes", &show(changes), rule);
    }
    let mut expanded = Blocks::default();
    for (i, block) in list.into_iter().enumerate() {
        let at = format!("blocks[{i}]");
        let given = block.get("cycles");
        let Some(cycles) = given.and_then(number).filter(|cycles| *cycles > 0.0) else {
            let value = given.map_or_else(|| "nothing".into(), show);
            let rule = "must be a number of cycles greater than 0";
            return refuse(&format!("{at}.cycles"), &value, rule);
        };
        for (section, value) in block.iter().filter(|(key, _)| *key != "cycles") {
            if !CHANGEABLE.contains(&section.as_str()) {
                let rule = format!("a block takes cycles and keys of {}", CHANGEABLE.join(", "));
                return refuse(&format!("{at}.{}", echo(section)), &show(value), &rule);
            }
            let mut keys = Vec::new();
            flatten(section, value, &mut keys);
            if let Some(set) = keys.iter().find_map(|(path, _)| faults.assigned(path)) {
                let rule = format!("{at} sets this key; change it there");
                return Err(Refusal::new(set, rule));
            }
            if i == 0 {
                expanded.first.insert(section.clone(), value.clone());
                continue;
            }
            expanded
                .changes
                .extend(keys.into_iter().map(|(path, value)| {
                    let place = faults.place(&format!("{at}.{}", echo(&path)), &show(&value));
                    (expanded.cycles, path, value, place)
                }));
        }
        expanded.cycles += cycles;
    }
    Ok(expanded)
}

/// Collects the values of a table with their dotted paths.
pub(crate) fn flatten(path: &str, value: &Value, found: &mut Vec<(String, Value)>) {
    match value {
        Value::Table(table) => {
            for (key, value) in table {
                flatten(&format!("{path}.{key}"), value, found);
            }
        }
        value => found.push((path.to_owned(), value.clone())),
    }
}

#[cfg(test)]
mod tests {
    use crate::scenario::Scenario;
    use crate::scenario::preset;

    fn with_blocks(blocks: &str) -> Result<Scenario, String> {
        let text = preset::find("gross-slip").expect("a preset").text;
        let text: String = text
            .lines()
            .filter(|line| !line.starts_with("cycles"))
            .map(|l| format!("{l}\n"))
            .collect();
        Scenario::from_toml(&format!("{text}\n{blocks}"), "mine.toml", &[])
            .map_err(|error| error.to_string())
    }

    #[test]
    fn blocks_are_the_beginning_and_changes_of_it() {
        let scenario = with_blocks(
            "[[blocks]]\ncycles = 3\nmotion.tangential.amplitude = 3e-7\n\
             [[blocks]]\ncycles = 4.5\nmotion.normal.mean = 2e-6\nmotion.tangential.amplitude = 1e-7\n\
             [[blocks]]\ncycles = 2\nfriction.coefficient = 0.2\n",
        )
        .expect("a scenario");
        assert_eq!(
            scenario.value("motion.tangential.amplitude").as_deref(),
            Some("3e-7")
        );
        assert_eq!(scenario.run().cycles, Some(9.5));
        let changes: Vec<(f64, String)> = scenario
            .changes()
            .iter()
            .map(|change| (change.at_cycle, change.to_string()))
            .collect();
        assert_eq!(
            changes,
            [
                (3.0, "motion.normal.mean = 2e-6"),
                (3.0, "motion.tangential.amplitude = 1e-7"),
                (7.5, "friction.coefficient = 0.2"),
            ]
            .map(|(cycle, set)| (cycle, set.to_owned()))
        );
        let again = Scenario::from_toml(&scenario.to_toml(), "again", &[]).expect("a scenario");
        assert!(again == scenario);
    }

    #[test]
    fn bad_blocks_are_one_line() {
        for (blocks, expected) in [
            (
                "[[blocks]]\n",
                "blocks[0].cycles = nothing: must be a number of cycles",
            ),
            (
                "[[blocks]]\ncycles = -1\n",
                "blocks[0].cycles = -1: must be a number",
            ),
            ("[blocks]\ncycles = 1\n", "must be an array of tables"),
            (
                "[[blocks]]\ncycles = 1\nnumerics.points = 50\n",
                "blocks[0].numerics = {...}: a block takes",
            ),
            (
                "[[blocks]]\ncycles = 1\n[[blocks]]\ncycles = 1\nmotion.normal.meen = 1\n",
                "did you mean motion.normal.mean?",
            ),
            (
                "[[changes]]\nat_cycle = 1\nset = \"friction.coefficient = 0.3\"\n[[blocks]]\ncycles = 1\n",
                "conflicts with [[blocks]]",
            ),
        ] {
            let refused = with_blocks(blocks).expect_err("refused");
            assert!(refused.contains(expected), "{refused}");
        }
    }
}
