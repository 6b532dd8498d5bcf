//! What a command has found, printed as text with its plots, or as JSON.

use std::io::{self, Write};

use anyhow::Result;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;
use serde::Serialize;

use super::args::TableOptions;
use super::stop;
use crate::export::file::WriteError;
use crate::export::target::Target;
use crate::math::scan::range;
use crate::plot::theme::{Look, Theme};
use crate::plot::{Axis, Chart, Marker, Plot, Scale};
use crate::scenario::escape;
use crate::studies::table::Rows;

/// Size of one plot, in cells.
const SIZE: (u16, u16) = (39, 11);

/// Gap between two plots, in cells.
const GAP: u16 = 2;

/// Plots per row.
const ACROSS: usize = 2;

/// The smallest value on a logarithmic axis; anything smaller is rounding error.
const FLOOR: f64 = 1e-17;

/// The text of a report, from top to bottom.
#[derive(Debug, Default)]
pub struct Report(String);

impl Report {
    /// Adds a line.
    pub fn line(&mut self, line: impl AsRef<str>) {
        self.0 += line.as_ref();
        self.0.push('\n');
    }

    /// Adds several lines.
    pub fn lines(&mut self, lines: impl IntoIterator<Item = impl AsRef<str>>) {
        lines.into_iter().for_each(|line| self.line(line));
    }

    /// Adds rows of a label and what there is to say of it, aligned.
    pub fn rows(&mut self, rows: &[(&str, String)]) {
        let widths = rows.iter().map(|(label, _)| label.chars().count());
        let width = widths.max().unwrap_or(0);
        self.lines(
            rows.iter()
                .map(|(label, text)| format!("{label:width$}  {text}")),
        );
    }

    /// Adds a table, its numbers with so many digits.
    pub fn table(&mut self, rows: &Rows, digits: usize) {
        self.0 += &rows.text(digits);
    }

    /// Adds plots in rows of two.
    pub fn charts(&mut self, charts: &[Chart], marker: Marker) {
        let theme = Theme::new(Look::Mono, marker);
        let (width, height) = SIZE;
        for charts in charts.chunks(ACROSS) {
            let mut buffer = Buffer::empty(Rect::new(0, 0, (width + GAP) * ACROSS as u16, height));
            for (at, chart) in charts.iter().enumerate() {
                let area = Rect::new(at as u16 * (width + GAP), 0, width, height);
                Plot::new(chart, &theme).render(area, &mut buffer);
            }
            self.line("");
            for row in buffer.area.rows() {
                let line: String = row.positions().map(|at| buffer[at].symbol()).collect();
                self.line(line.trim_end());
            }
        }
    }

    /// Adds plots with the same axes, which hold all of their curves, so that they can be compared without colour; none
    /// if a logarithmic axis has nothing to show.
    pub fn charts_alike(&mut self, mut charts: Vec<Chart>, marker: Marker) {
        let ends = charts.first().and_then(|first| {
            let curves = || charts.iter().flat_map(|chart| &chart.curves);
            let x = ends(&first.x, curves().flat_map(|curve| &curve.xs))?;
            Some((x, ends(&first.y, curves().flat_map(|curve| &curve.ys))?))
        });
        let Some((x, y)) = ends else { return };
        for chart in &mut charts {
            (chart.x.bounds, chart.y.bounds) = (Some(x), Some(y));
        }
        self.charts(&charts, marker);
    }

    /// Prints the JSON if given, otherwise the text.
    pub fn print(self, json: Option<&impl Serialize>) -> Result<()> {
        stop::nothing_is_left_to_save();
        let text = match json {
            Some(found) => escape::json(found, true)? + "\n",
            None => self.0,
        };
        Ok(io::stdout().lock().write_all(text.as_bytes())?)
    }
}

/// Returns the ends of an axis that holds all values it can show; `None` without any.
fn ends<'a>(axis: &Axis, values: impl Iterator<Item = &'a f64>) -> Option<[f64; 2]> {
    let floor = match axis.scale {
        Scale::Log => FLOOR,
        Scale::Linear => f64::NEG_INFINITY,
    };
    let seen = values.filter(|value| value.is_finite() && **value > floor);
    let range = range(seen.copied())?;
    Some(axis.resolve(Some(range), true))
}

impl TableOptions {
    /// Claims the output file, if there is one, before anything is computed.
    pub(super) fn claim(&self) -> Result<Option<Target>, WriteError> {
        Target::claim_given(self.csv.as_deref(), self.force)
    }
}

/// Writes the file of a study, if there is one: program, study, `notes` and rows. Call it before printing, so that a
/// closed pipe on stdout does not cost the file.
pub fn write(
    target: Option<&Target>,
    study: &str,
    notes: &[String],
    rows: &Rows,
) -> Result<(), WriteError> {
    let Some(target) = target else {
        return Ok(());
    };
    let version = env!("CARGO_PKG_VERSION");
    let notes = notes.iter().map(|note| format!("# {note}\n"));
    let head = format!("# mdr-tui: {version}\n# study: {study}\n");
    let text = head + &notes.collect::<String>() + &rows.csv();
    target.write(text.as_bytes())
}
