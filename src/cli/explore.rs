//! The explorer, opened from the command line.

use std::io::{self, Write};
use std::process::ExitCode;

use anyhow::Result;
use serde::de::IgnoredAny;

use super::args::{ColorChoice, Explore, ThemeChoice};
use super::{Misuse, complain};
use crate::export::keep;
use crate::scenario::session::Session;
use crate::scenario::{Scenario, checkpoint};
use crate::tui::plot::Marker;
use crate::tui::theme::Look;
use crate::tui::{self, Capture, Options, keys};

/// Opens the explorer.
pub fn explore(options: &Explore) -> Result<ExitCode> {
    let keys = keys::parse_script(options.keys.as_deref().unwrap_or("")).map_err(Misuse)?;
    let colored = match options.color {
        ColorChoice::Always => Some(true),
        ColorChoice::Never => Some(false),
        ColorChoice::Auto => None,
    };
    let session = match &options.resume {
        Some(file) => checkpoint::read::<IgnoredAny>(file)?.session,
        None => Session::start(Scenario::load(&options.scenario, &options.changes.set)?)?,
    };
    let keep_in = keep::state_directory();
    let farewell = tui::run(Options {
        session,
        running: options.resume.is_none(),
        keep_in,
        keep_every: options.checkpoint_every.0,
        fps: options.fps,
        marker: options.marker.map(Marker::from),
        colored,
        look: options.theme.map(|choice| match choice {
            ThemeChoice::Dark => Look::Dark,
            ThemeChoice::Light => Look::Light,
            ThemeChoice::Mono => Look::Mono,
        }),
        mouse: if options.mouse {
            Capture::Clicks
        } else {
            Capture::None
        },
        script: options.print.map(|size| (keys, size)),
    })?;
    if let Some(word) = farewell.word {
        complain(&word);
    }
    if let Some(screen) = farewell.screen {
        io::stdout().write_all(screen.as_bytes())?;
    }
    Ok(ExitCode::SUCCESS)
}
