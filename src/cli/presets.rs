//! `mdr-tui presets`: the list of presets, or one of them as TOML.

use std::io::{self, Write};

use anyhow::{Result, bail};
use serde_json::{Value, json};

use super::args::Presets;
use super::results;
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
    results::print(options.json.then_some(&list), || {
        let width = all.clone().map(|preset| preset.name.len()).max();
        let width = width.unwrap_or(0);
        let line = |preset: &Preset| format!("{:width$}  {}\n", preset.name, preset.title());
        all.map(line).collect()
    })
}
