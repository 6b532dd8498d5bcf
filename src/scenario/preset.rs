//! Presets: ordinary TOML files embedded in the program, without special powers.

use std::collections::HashMap;
use std::sync::LazyLock;

use super::escape::printable;
use super::hint::hint as name_hint;

/// A preset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Preset {
    /// Name on the command line: the file's name without its extension.
    pub name: &'static str,
    /// The TOML text, including its comments.
    pub text: &'static str,
}

macro_rules! presets {
    ($($name:literal),+ $(,)?) => {
        &[$(Preset {
            name: $name,
            text: include_str!(concat!("../../presets/", $name, ".toml")),
        }),+]
    };
}

/// All presets, in the order of lists.
pub const ALL: &[Preset] = presets![
    "li2019-fig3",
    "hertz",
    "mindlin",
    "limit-shape",
    "gross-slip",
    "separation",
    "two-frequencies",
    "power-law",
    "cone",
    "flat-punch",
    "truncated-paraboloid",
    "truncated-cone",
    "strong-wear",
    "harsh-wear",
    "mild-million",
    "cattaneo-kalker",
    "julia2022-gross-slip",
    "julia2022-partial-slip",
    "cylinder-partial-slip",
    "cylinder-gross-slip",
];

/// Finds a preset by name.
pub fn find(name: &str) -> Option<&'static Preset> {
    ALL.iter().find(|preset| preset.name == name)
}

/// Whether a text names a file rather than a preset.
pub fn is_path(text: &str) -> bool {
    text.contains(['/', std::path::MAIN_SEPARATOR]) || text.to_lowercase().ends_with(".toml")
}

/// Returns a hint for the unknown `name`.
pub fn hint(name: &str) -> String {
    name_hint(name, ALL.iter().map(|preset| preset.name))
}

impl Preset {
    /// Returns the scenario's title.
    pub fn title(&self) -> &'static str {
        &ABOUT[self.name][0]
    }

    /// Describes on one line what it shows.
    pub fn summary(&self) -> &'static str {
        &ABOUT[self.name][1]
    }
}

/// Title and summary by name, parsed once: a list of presets is drawn in every frame.
static ABOUT: LazyLock<HashMap<&'static str, [String; 2]>> = LazyLock::new(|| {
    let about = |preset: &Preset| {
        let table: toml::Table = preset.text.parse().unwrap_or_default();
        let texts = ["title", "description"].map(|key| {
            let text = table
                .get(key)
                .and_then(toml::Value::as_str)
                .unwrap_or_default();
            let words: Vec<&str> = text.split_whitespace().collect();
            printable(&words.join(" "))
        });
        (preset.name, texts)
    };
    ALL.iter().map(about).collect()
});

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;
    use crate::simulation::Simulation;

    #[test]
    fn every_file_is_embedded_and_every_preset_has_its_file() {
        let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/presets");
        let mut files: Vec<String> = std::fs::read_dir(directory)
            .expect("the directory of presets")
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        let mut embedded: Vec<String> = ALL
            .iter()
            .map(|preset| format!("{}.toml", preset.name))
            .collect();
        files.sort();
        embedded.sort();
        assert_eq!(files, embedded);
    }

    #[test]
    fn every_preset_has_a_line_for_the_list_and_says_how_long_it_runs() {
        for preset in ALL {
            assert!((5..=60).contains(&preset.title().len()), "{}", preset.name);
            assert!(
                (20..=110).contains(&preset.summary().len()),
                "{}",
                preset.name
            );
            let scenario = Scenario::load(preset.name, &[]).expect("a scenario");
            assert!(scenario.run().cycles.is_some(), "{}", preset.name);
            let comments = preset
                .text
                .lines()
                .take_while(|line| line.starts_with('#'))
                .count();
            assert!(
                (5..=12).contains(&comments),
                "{}: {comments} lines",
                preset.name
            );
        }
    }

    #[test]
    fn every_preset_runs_for_a_cycle() {
        for preset in ALL {
            let scenario = Scenario::load(preset.name, &[]).expect("a scenario");
            let mut simulation = Simulation::new(scenario.setup().clone()).expect("a contact");
            let outcome = simulation.advance_to(1.0);
            assert_eq!(outcome, Ok(()), "{}", preset.name);
        }
    }

    #[test]
    fn a_mistyped_name_is_led_to_the_nearest() {
        let error = Scenario::load("mindlyn", &[]).expect_err("no such preset");
        assert!(
            error
                .to_string()
                .starts_with("mindlyn: no such preset; did you mean mindlin?")
        );
        let error = Scenario::load("q", &[]).expect_err("no such preset");
        assert!(error.to_string().contains("known are li2019-fig3, hertz"));
    }
}
