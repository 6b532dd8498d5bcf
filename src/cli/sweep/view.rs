//! `sweep --view`: the explorer, opened on the map of a study.

use clap::Parser;

use super::super::args::Arguments;
use super::super::explore;
use super::*;
use crate::tui::map::live::Live;

/// Shows the table until the user quits.
pub fn view(file: &Path, options: &Sweep) -> Result<()> {
    let map = Live::of_file(file)?;
    let mut explorer = Arguments::try_parse_from(["mdr-tui"])?.explore;
    explorer.print = options.print;
    explorer.keys.clone_from(&options.keys);
    explorer.marker = options.marker;
    explorer.theme = options.theme;
    explorer.color = Some(options.color);
    explore::explore(&explorer, Some(map))
}
