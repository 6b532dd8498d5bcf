//! `mdr-tui presets`: the list of presets, or one of them as TOML.

use std::io::{self, Write};

use anyhow::{Result, bail};

use super::args::Presets;
use super::results;
use crate::scenario::nearest::hint;
use crate::scenario::{Refusal, preset};

/// Lists the presets or prints one.
pub fn presets(options: &Presets) -> Result<()> {
    let mut out = io::stdout().lock();
    if let Some(name) = &options.name {
        let Some(found) = preset::find(name) else {
            let hint = hint(name, preset::ALL.iter().map(|preset| preset.name));
            let place = format!("presets {}", name.escape_debug());
            bail!(Refusal::new(place, "no such preset").or(hint));
        };
        write!(out, "{}", found.text)?;
        return Ok(());
    }
    if options.json {
        let list = preset::ALL
            .iter()
            .map(|preset| serde_json::json!({ "name": preset.name, "title": preset.title() }));
        results::print_json(&list.collect::<Vec<_>>(), &mut out)?;
        return Ok(());
    }
    let widths = preset::ALL.iter().map(|preset| preset.name.len());
    let width = widths.max().unwrap_or(0);
    for preset in preset::ALL {
        writeln!(out, "{:width$}  {}", preset.name, preset.title())?;
    }
    Ok(())
}
