//! Figures for a paper: charts on sheets, as SVG, PNG or PDF, and their data as CSV.
//!
//! One idea per file: `canvas` (lines, areas and text in millimetres), `svg`, `png` and `pdf` (one writer each),
//! `font`, `look` (colours and greys), `draw` (a chart on the canvas), `interior` and `map` (its parts), `study` (the
//! charts of a sweep), `paper` (the figures of the paper). Charts, ticks and units are the same as on the screen
//! (`plot`).

use std::fmt::Write;
use std::io;
use std::path::Path;

pub mod canvas;
mod draw;
pub mod font;
mod interior;
pub mod look;
mod map;
pub mod paper;
pub mod pdf;
pub mod png;
mod ruler;
pub mod study;
pub mod svg;

use canvas::Page;
use draw::Ordinate;
use look::FigureStyle;

use crate::export::file::WriteError;
use crate::export::header::line;
use crate::export::target::{Target, write_all};
use crate::math::number::exact;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve};
use crate::scenario::Refusal;
use crate::scenario::escape::csv_line;

/// The file formats, recognised by the extension.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::EnumString)]
#[strum(ascii_case_insensitive)]
pub enum Format {
    /// Vector graphics; text stays text.
    Svg,
    /// Pixels.
    Png,
    /// Vector graphics with an embedded font.
    Pdf,
}

impl Format {
    /// Returns the format for the extension of `path`.
    pub fn from_path(path: &Path) -> Option<Self> {
        path.extension()?.to_str()?.parse().ok()
    }

    /// Returns the whole file of a figure; only a PNG needs `dpi`.
    ///
    /// # Errors
    /// If a PNG would have no pixels or too many.
    pub fn write(self, canvas: &Page, dpi: f64) -> io::Result<Vec<u8>> {
        match self {
            Self::Svg => Ok(svg::write(canvas).into_bytes()),
            Self::Png => png::write(canvas, dpi),
            Self::Pdf => Ok(pdf::write(canvas)),
        }
    }
}

/// The columns of a figure's data.
pub const DATA_COLUMNS: &str = "panel,curve,x,y,value,error";

/// A sheet with one or more charts.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// The title, for the file's metadata.
    pub title: String,
    /// Data for the caption: names and values.
    pub facts: Vec<(String, String)>,
    /// The charts, in reading order.
    pub charts: Vec<Chart>,
}

impl Sheet {
    /// Draws the sheet into `pictures`, on paper of the given size in mm or the usual one, and writes its data into
    /// `tables`; writes all of them or none. Only a PNG needs `dpi`.
    ///
    /// # Errors
    /// The error of the first file that cannot be made or written.
    pub fn save(
        &self,
        look: &FigureStyle,
        size: Option<[f64; 2]>,
        dpi: f64,
        pictures: &[(Target, Format)],
        tables: &[Target],
    ) -> Result<(), WriteError> {
        let canvas = self.draw(size.unwrap_or_else(|| self.usual_size()), look);
        // Writes the data first, so that a kill in between leaves no new picture with old data.
        let data = self.csv().into_bytes();
        let mut files: Vec<(&Target, Vec<u8>)> = Vec::new();
        files.extend(tables.iter().map(|target| (target, data.clone())));
        for (target, format) in pictures {
            let refused = |error| Refusal::new(target.path().display(), error);
            files.push((target, format.write(&canvas, dpi).map_err(refused)?));
        }
        write_all(&files)
    }

    /// Returns the number of charts side by side.
    fn columns(&self) -> usize {
        match self.charts.len() {
            0 | 1 => 1,
            3 => 3,
            _ => 2,
        }
    }

    /// Returns the size that fits the columns of a journal, mm.
    pub fn usual_size(&self) -> [f64; 2] {
        let maps = self.charts.iter().filter(|chart| chart.map.is_some());
        let lines = maps.map(|map| map.curves.len()).max().unwrap_or(0);
        let legend = 3.3 * lines as f64;
        match self.columns() {
            1 => [85.0, 64.0 + legend],
            columns => [
                170.0,
                (62.0 + legend) * self.charts.len().div_ceil(columns) as f64,
            ],
        }
    }

    /// Draws all charts on paper of a size in mm; several charts are lettered.
    pub fn draw(&self, size: [f64; 2], look: &FigureStyle) -> Page {
        let mut canvas = Page {
            size,
            shapes: Vec::new(),
            title: self.title.clone(),
            facts: self.facts.clone(),
        };
        let columns = self.columns();
        let rows = self.charts.len().div_ceil(columns).max(1);
        let place = [size[0] / columns as f64, size[1] / rows as f64];
        let mut charts = self.charts.clone();
        // A single unnamed curve gets a name if other sources are drawn with it.
        for chart in &mut charts {
            let is_ghost = |curve: &Curve| matches!(curve.role, Role::Ghost(_));
            let has_ghosts = chart.curves.iter().any(is_ghost);
            let mut alone = chart.curves.iter_mut();
            let alone = alone.find(|curve| curve.name.is_empty() && !is_ghost(curve));
            if let Some(curve) = alone.filter(|_| has_ghosts) {
                curve.name = "computed".into();
            }
        }
        if charts.len() > 1 {
            for (k, chart) in charts.iter_mut().enumerate() {
                chart.title = format!("({}) {}", letter(k), chart.title);
            }
        }
        // Aligns the bottoms of frames in a row and the left edges of frames in a column.
        let lowest = |row: &[Chart]| {
            row.iter()
                .map(|chart| chart.height_below(look))
                .fold(0.0, f64::max)
        };
        let below: Vec<f64> = charts.chunks(columns).map(lowest).collect();
        let ordinates = charts.iter().enumerate();
        let ordinates =
            ordinates.map(|(k, chart)| chart.ordinate(place[1], below[k / columns], look));
        let ordinates: Vec<Ordinate> = ordinates.collect();
        let in_column = |column| ordinates.iter().skip(column).step_by(columns);
        let widest = |column| in_column(column).map(|each| each.left).fold(0.0, f64::max);
        let left: Vec<f64> = (0..columns).map(widest).collect();
        for (k, (chart, mut ordinate)) in charts.iter().zip(ordinates).enumerate() {
            let (column, row) = (k % columns, k / columns);
            let at = [place[0] * column as f64, place[1] * row as f64];
            ordinate.left = left[column];
            chart.draw(false, &mut canvas, [at, place], ordinate, look);
        }
        canvas
    }

    /// Returns the drawn data: one row per point of each curve and of each map.
    pub fn csv(&self) -> String {
        let mut text = line("mdr-tui", env!("CARGO_PKG_VERSION"));
        text.extend(self.facts.iter().map(|(key, value)| line(key, value)));
        for (k, chart) in self.charts.iter().enumerate() {
            let (panel, title) = (letter(k), &chart.title);
            let [x, y] = [&chart.x, &chart.y].map(Axis::in_data_units);
            let value = chart.map.as_ref().map(|map| map.quantity.in_data_units());
            let value = value.map_or(String::new(), |value| format!(", value = {value}"));
            let about = format!("{title}, x = {x}, y = {y}{value}");
            text += &line(&format!("panel {panel}"), &about);
        }
        text.extend([DATA_COLUMNS, "\n"]);
        for (k, chart) in self.charts.iter().enumerate() {
            let panel = letter(k);
            let inset = chart.inset.iter().flat_map(|inset| &inset.curves);
            let inset = inset.map(|curve| ("-inset", curve));
            let curves = chart.curves.iter().map(|curve| ("", curve));
            for (part, curve) in curves.chain(inset) {
                let (place, name) = (format!("{panel}{part}"), &curve.name);
                for (i, (x, y)) in curve.points().enumerate() {
                    let error = exact(curve.errors.get(i).copied().unwrap_or(f64::NAN));
                    let [x, y] = [x, y].map(exact);
                    text += &csv_line([place.as_str(), name, &x, &y, "", &error]);
                }
            }
            let Some(map) = &chart.map else { continue };
            let [xs, ys] = &map.places;
            for (&y, values) in ys.iter().zip(map.values.chunks(xs.len())) {
                for (&x, &value) in xs.iter().zip(values) {
                    let [x, y, value] = [x, y, value].map(exact);
                    let _ = writeln!(text, "{panel},map,{x},{y},{value},");
                }
            }
        }
        text
    }
}

/// Returns the letter of a chart.
fn letter(k: usize) -> char {
    char::from(b'a' + (k % 26) as u8)
}
