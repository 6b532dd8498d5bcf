//! `sweep --view`: the map, the points it opens, and the way back.

use std::env;
use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, SystemTime};

use anyhow::{Context, Result};
use clap::ValueEnum;
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use super::super::args::Sweep;
use super::super::stop;
use crate::scenario::Refusal;
use crate::scenario::limited::Unread;
use crate::studies::sweep::record::Record;
use crate::tui::map::{self, Leave, View};
use crate::tui::{self, keys};

/// How often is looked whether the explorer has ended, or is to end.
const GLANCE: Duration = Duration::from_millis(20);

/// Shows the table until the user quits.
pub fn view(file: &Path, options: &Sweep) -> Result<ExitCode> {
    let name = file.display().to_string();
    let keys = keys::parse_script(options.keys.as_deref().unwrap_or("")).map_err(Refusal::from)?;
    let mut view = View::new(read(file)?, &name)?;
    let theme = tui::theme_of(options.marker, options.color.is_colored(), options.theme);
    let mut seen = changed(file);
    // Set by a signal in the map or in the explorer: either ends both.
    let is_ending = stop::noted()?;
    loop {
        let leave = match options.print {
            Some(size) => map::play(&mut view, &theme, &keys, size)?,
            None => map::run(&mut view, &theme, |view| {
                let now = changed(file);
                if now != seen {
                    seen = now;
                    // A file that is being replaced is read again the next time.
                    let _ = read(file).map(|record| view.renew(record));
                }
            })?,
        };
        let Leave::Open(point) = leave else {
            return Ok(ExitCode::SUCCESS);
        };
        open(&view, point, options, &is_ending)?;
        if options.print.is_some() || is_ending.load(Ordering::Relaxed) {
            return Ok(ExitCode::SUCCESS);
        }
    }
}

/// Opens a point in the explorer, a separate process, and waits for its end.
fn open(view: &View, point: usize, options: &Sweep, is_ending: &AtomicBool) -> Result<()> {
    let scenario = view.slice.study.scenario(point)?;
    let directory = tempfile::tempdir().context("cannot make a temporary directory")?;
    let file = directory.path().join(format!("point-{point}.toml"));
    fs::write(&file, scenario.to_toml()).context("cannot write the point's scenario")?;
    let program = env::current_exe().context("cannot find this program")?;
    let mut explorer = Command::new(program);
    explorer.arg(&file);
    if let Some(size) = options.print {
        explorer.args(["--print", &format!("{}x{}", size.width, size.height)]);
    }
    let word = |choice: Option<clap::builder::PossibleValue>| {
        choice.map(|value| value.get_name().to_owned())
    };
    let marker = options
        .marker
        .and_then(|marker| word(marker.to_possible_value()));
    let theme = options
        .theme
        .and_then(|theme| word(theme.to_possible_value()));
    let color = word(options.color.to_possible_value());
    for (flag, value) in [("--marker", marker), ("--theme", theme), ("--color", color)] {
        explorer.args(value.iter().flat_map(|value| [flag, value.as_str()]));
    }
    if is_ending.load(Ordering::Relaxed) {
        return Ok(());
    }
    let mut explorer = explorer.spawn().context("cannot start the explorer")?;
    let mut is_told = false;
    while explorer
        .try_wait()
        .context("cannot wait for the explorer")?
        .is_none()
    {
        if is_ending.load(Ordering::Relaxed) && !is_told {
            is_told = true;
            let process = i32::try_from(explorer.id()).map(Pid::from_raw);
            // It saves its session; one that has ended by now needs no signal.
            let _ = process.map(|process| kill(process, Signal::SIGTERM));
        }
        thread::sleep(GLANCE);
    }
    Ok(())
}

fn read(file: &Path) -> Result<Record> {
    let name = file.display();
    let source = fs::File::open(file).map_err(|error| Refusal::new(&name, Unread::Io(error)))?;
    Ok(Record::open(source, &name.to_string())?)
}

/// When the file was changed last, and its length.
fn changed(file: &Path) -> Option<(SystemTime, u64)> {
    let about = fs::metadata(file).ok()?;
    Some((about.modified().ok()?, about.len()))
}
