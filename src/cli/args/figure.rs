//! Options of `mdr-tui figure`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use clap_complete::engine::ArgValueCompleter;

use super::values::{CycleAsGiven, by_name, cycles, number_within};
use super::{Changes, NamingOptions};
use crate::charts::{Recipe, on_paper};
use crate::cli::complete;
use crate::figure::look::Style;

/// Error for a font size outside the limits.
const FONT: &str = "a font has from 3 to 72 points, e.g. 8";

/// Options of `figure`.
#[derive(Debug, Args)]
#[command(after_help = include_str!("examples/figure.txt").trim_end())]
pub struct Figure {
    /// A run's directory, a CSV file of one, the table of a sweep, a preset's name, or a path to a .toml file,
    /// which is run.
    #[arg(required_unless_present = "figure")]
    pub source: Option<OsString>,
    /// Output file; the ending .svg, .png or .pdf gives the format. Can be repeated.
    #[arg(short, long, value_name = "FILE", required = true)]
    pub out: Vec<PathBuf>,
    /// Reproduce a figure of the paper; without a source, with the paper's own scenario.
    #[arg(long, value_enum)]
    pub figure: Option<PaperFigure>,
    /// Chart to draw; can be repeated; default: profiles, stresses and loop, if the data are there.
    #[arg(long, value_name = "NAME", value_parser = by_name(on_paper().collect(), |chart| chart.name), conflicts_with = "figure")]
    pub panel: Vec<&'static Recipe>,
    /// Column of a sweep's table to draw; can be repeated; default: the first one and regime, or over one axis up to
    /// four. With more than two axes, --set KEY=VALUE holds some of them.
    #[arg(long, value_name = "NAME")]
    pub column: Vec<String>,
    /// Draw measured data with their error bars, another run's files or another scenario over the charts;
    /// can be repeated.
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with = "figure",
        add = ArgValueCompleter::new(complete::overlays)
    )]
    pub overlay: Vec<OsString>,
    /// How the columns of measured overlays are to be read.
    #[command(flatten)]
    pub naming: NamingOptions,
    /// Changes to the scenario.
    #[command(flatten)]
    pub changes: Changes,
    /// Number of cycles to run; default: run.cycles of the scenario.
    #[arg(long, value_name = "X", value_parser = cycles)]
    pub cycles: Option<f64>,
    /// Show the states at these cycles; default: all in a directory, or those planned by the
    /// scenario.
    #[arg(long, value_name = "C1,C2,...")]
    pub at: Option<Vec<CycleAsGiven>>,
    /// Width and height in mm; default: one or two columns of a journal.
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<[f64; 2]>,
    /// Colours, or greys with dashes for print.
    #[arg(long, value_enum, default_value_t = Style::Color)]
    pub style: Style,
    /// Font size in points.
    #[arg(long, value_name = "PT", default_value = "8", value_parser = number_within(3.0..=72.0, FONT))]
    pub font_size: f64,
    /// Resolution of a PNG in dots per inch.
    #[arg(long, value_name = "DPI", default_value_t = 300, value_parser = clap::value_parser!(u16).range(20..=2400))]
    pub dpi: u16,
    /// Overwrite existing files.
    #[arg(long)]
    pub force: bool,
    /// Print nothing but errors.
    #[arg(long)]
    pub quiet: bool,
}

/// A figure of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PaperFigure {
    /// Errors of methods A and B on a Hertzian contact.
    Fig2,
    /// Profiles and stresses of a fretting contact.
    Fig3,
}

fn size(text: &str) -> Result<[f64; 2], String> {
    let rule = "a size is WIDTHxHEIGHT in mm, each from 20 to 2000, e.g. 170x120";
    let (width, height) = text.split_once('x').ok_or(rule)?;
    let side = number_within(20.0..=2000.0, rule);
    Ok([side(width)?, side(height)?])
}
