//! `sweep --view`: the map, the points it opens, and the way back.

use std::time::SystemTime;

use clap::Parser;

use super::super::args::Arguments;
use super::super::explore;
use super::*;
use crate::tui::map::{self, Leave, View};
use crate::tui::{self, keys};

/// Shows the table until the user quits.
pub fn view(file: &Path, options: &Sweep) -> Result<()> {
    let name = file.display().to_string();
    let keys = keys::parse_script(options.keys.as_deref().unwrap_or("")).map_err(Refusal::from)?;
    let mut view = View::new(Record::of_file(file)?, &name)?;
    let theme = tui::theme_of(options.marker, options.color.is_colored(), options.theme);
    let mut seen = changed(file);
    // Set by a signal in the map or in the explorer: it ends both.
    let is_ending = stop::noted()?;
    loop {
        let leave = match options.print {
            Some(size) => map::play(&mut view, &theme, &keys, size)?,
            None => map::run(&mut view, &theme, |view| {
                let now = changed(file);
                if now != seen {
                    seen = now;
                    // A file that is being replaced is read again the next time.
                    let _ = Record::of_file(file).map(|record| view.renew(record));
                }
            })?,
        };
        let Leave::Open(point) = leave else {
            return Ok(());
        };
        let opened = open(&view, point, options);
        if options.print.is_some() || is_ending.load(Ordering::Relaxed) {
            return opened;
        }
        view.notice = opened.err().map(|error| format!("{error:#}"));
    }
}

/// Opens a point in the explorer until the user leaves it.
fn open(view: &View, point: usize, options: &Sweep) -> Result<()> {
    let scenario = view.slice.study.scenario(point)?;
    let directory = tempfile::tempdir().context("cannot make a temporary directory")?;
    let file = directory.path().join(format!("point-{point}.toml"));
    fs::write(&file, scenario.to_toml()).context("cannot write the point's scenario")?;
    let mut explorer = Arguments::try_parse_from(["mdr-tui".as_ref(), file.as_os_str()])?.explore;
    explorer.print = options.print;
    explorer.marker = options.marker;
    explorer.theme = options.theme;
    explorer.color = Some(options.color);
    explore::explore(&explorer)
}

/// When the file was changed last, and its length.
fn changed(file: &Path) -> Option<(SystemTime, u64)> {
    let about = fs::metadata(file).ok()?;
    Some((about.modified().ok()?, about.len()))
}
