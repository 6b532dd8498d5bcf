//! The explorer, opened from the command line.

use std::process::ExitCode;

use anyhow::Result;

use super::Misuse;
use super::args::{ColorChoice, Explore, MarkerChoice, ThemeChoice};
use crate::scenario::Scenario;
use crate::tui::plot::Marker;
use crate::tui::theme::Look;
use crate::tui::{self, Options, keys};

/// Opens the explorer.
pub fn explore(options: &Explore) -> Result<ExitCode> {
    let keys = keys::parse_script(options.keys.as_deref().unwrap_or("")).map_err(Misuse)?;
    let marker = options.marker.map(|choice| match choice {
        MarkerChoice::Braille => Marker::Braille,
        MarkerChoice::Halfblock => Marker::HalfBlock,
        MarkerChoice::Dot => Marker::Dot,
        MarkerChoice::Ascii => Marker::Ascii,
    });
    let colored = match options.color {
        ColorChoice::Always => Some(true),
        ColorChoice::Never => Some(false),
        ColorChoice::Auto => None,
    };
    tui::run(Options {
        scenario: Scenario::load(&options.scenario, &options.changes.set)?,
        fps: options.fps,
        marker,
        colored,
        look: options.theme.map(|choice| match choice {
            ThemeChoice::Dark => Look::Dark,
            ThemeChoice::Light => Look::Light,
            ThemeChoice::Mono => Look::Mono,
        }),
        script: options.print.map(|size| (keys, size)),
    })?;
    Ok(ExitCode::SUCCESS)
}
