//! `mdr-tui presets`: the list of presets, or one of them as TOML.

use std::io::{self, Write};
use std::process::ExitCode;

use anyhow::{Result, bail};

use super::args::Presets;
use crate::scenario::{Refusal, preset};

/// Lists the presets or prints one.
pub fn presets(options: &Presets) -> Result<ExitCode> {
    let mut out = io::stdout().lock();
    if let Some(name) = &options.name {
        let Some(found) = preset::find(name) else {
            let names: Vec<&str> = preset::ALL.iter().map(|preset| preset.name).collect();
            bail!(Refusal::new(
                format_args!("presets {}", name.escape_debug()),
                format_args!("no such preset; the presets are {}", names.join(", "))
            ));
        };
        write!(out, "{}", found.text)?;
        return Ok(ExitCode::SUCCESS);
    }
    if options.json {
        let list: Vec<_> = preset::ALL
            .iter()
            .map(|preset| serde_json::json!({ "name": preset.name, "title": preset.title() }))
            .collect();
        writeln!(out, "{}", serde_json::to_string_pretty(&list)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    let width = preset::ALL
        .iter()
        .map(|preset| preset.name.len())
        .max()
        .unwrap_or(0);
    for preset in preset::ALL {
        writeln!(out, "{:width$}  {}", preset.name, preset.title())?;
    }
    Ok(ExitCode::SUCCESS)
}
