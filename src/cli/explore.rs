//! The explorer, opened from the command line.

use std::ffi::OsString;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

use anyhow::{Result, ensure};
use serde::de::IgnoredAny;

use super::args::{ColorChoice, Explore};
use super::config::Config;
use super::{accuracy, complain, given, mistyped_command, without_waiting};
use crate::export::{autosave, own_directory};
use crate::scenario::session::Session;
use crate::scenario::{Refusal, checkpoint, printable};
use crate::studies::refinement;
use crate::tui::ghosts::{MOST, Source};
use crate::tui::map::live::LiveStudy;
use crate::tui::{self, Options, Script, ScriptStep, command, snapshot};

/// Default frame rate per second.
const DEFAULT_FPS: u16 = 10;

/// Opens the explorer, on a map if there is one.
pub fn explore(options: &Explore, map: Option<LiveStudy>) -> Result<()> {
    let screen = &options.screen;
    let strokes =
        ScriptStep::script(screen.keys.as_deref().unwrap_or("")).map_err(Refusal::from)?;
    let config = Config::load()?;
    let marker = screen.marker.or(config.marker);
    let look = screen.theme.or(config.theme);
    let colored = screen.color.or(config.color);
    let colored = colored.and_then(ColorChoice::is_colored);
    command::bind(config.keys);
    let directory = Path::new(&options.scenario);
    let name = printable(&options.scenario.to_string_lossy());
    let run = match &options.resume {
        Some(file) => {
            let kept = checkpoint::read::<IgnoredAny>(file)?;
            autosave::forget_crash(file);
            kept.session.into()
        }
        None if directory.is_dir() => {
            let rule = "continues as it was saved, so --set changes nothing; give its \
                scenario.toml to start a new run";
            let is_as_saved = options.changes.set.is_empty();
            ensure!(is_as_saved, Refusal::new(name, rule));
            snapshot::open(directory).map_err(Refusal::from)?
        }
        None => {
            let scenario = given::scenario(&options.scenario, &options.changes.set)
                // The error itself may already suggest an equally near preset.
                .map_err(|error| match mistyped_command(&name) {
                    Some(refusal) if !error.to_string().contains("did you mean") => refusal,
                    _ => error,
                })?;
            let found = accuracy::resolve(&scenario, false, refinement::resolve_soon)?;
            Session::start(found.scenario)?.into()
        }
    };
    let reach = run.simulation().setup().grid.radius();
    let naming = options.naming.of_columns();
    let load = |given: &OsString| {
        Source::load(given, &naming, reach).map_err(|error| Refusal::from(error.to_string()))
    };
    let ghosts: Vec<Source> = options.overlay.iter().map(load).collect::<Result<_, _>>()?;
    let rule = format!("takes {MOST} or fewer; there are {}", ghosts.len());
    ensure!(ghosts.len() <= MOST, Refusal::new("--overlay", rule));
    let farewell = tui::run(Options {
        running: options.resume.is_none() && !directory.is_dir() && map.is_none(),
        run,
        map,
        ghosts,
        keep_in: own_directory::state(),
        keep_every: options.checkpoint_every,
        fps: screen.fps.or(config.fps).unwrap_or(DEFAULT_FPS),
        theme: tui::theme_of(marker, colored, look),
        present: options.present,
        panels: config.panels,
        mouse: screen.mouse || config.mouse == Some(true),
        script: screen.print.map(|size| Script { strokes, size }),
    })?;
    if let Some(word) = farewell.saved {
        complain(&word);
    }
    if let Some(screen) = farewell.screen {
        without_waiting(io::stdout().is_terminal(), move || {
            let _ = io::stdout().write_all(screen.as_bytes());
        });
    }
    Ok(())
}
