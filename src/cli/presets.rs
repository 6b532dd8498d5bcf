//! `mdr-tui presets`: the list of presets, or one of them as TOML.

use std::io::{self, Write};

use anyhow::{Result, bail};
use serde_json::{Value, json};

use super::args::Presets;
use super::report::Report;
use crate::scenario::Refusal;
use crate::scenario::preset::{self, Preset};

/// Lists the presets or prints one.
pub fn presets(options: &Presets) -> Result<()> {
    if let Some(name) = &options.name {
        let Some(found) = preset::find(name) else {
            let place = format!("presets {}", name.escape_debug());
            bail!(Refusal::new(place, "no such preset").or(preset::hint(name)));
        };
        return Ok(write!(io::stdout(), "{}", found.text)?);
    }
    let all = preset::ALL.iter();
    let about = |preset: &Preset| json!({ "name": preset.name, "title": preset.title() });
    let list: Vec<Value> = all.clone().map(about).collect();
    let mut report = Report::default();
    report.rows(
        &all.map(|preset| (preset.name, preset.title().to_owned()))
            .collect::<Vec<_>>(),
    );
    report.print(options.json.then_some(&list))
}
