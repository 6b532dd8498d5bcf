//! Writes `:figure FILE`: profiles, stresses and the last loop of the state on the screen.

use std::path::Path;

use super::recorded::Recorded;
use crate::charts;
use crate::export::target::Target;
use crate::figure::look::{FigureStyle, Style};
use crate::figure::{Format, Sheet};

/// The font size, mm: 8 points.
const FONT: f64 = 8.0 * 25.4 / 72.0;

/// Resolution of a PNG in dots per inch.
const DPI: f64 = 300.0;

/// Draws the present state of `of` into the file, and writes its data to a file of the same name with `.csv`.
///
/// # Errors
/// In one line: an unknown format, a file that already exists or cannot be written.
pub(super) fn write(of: &Recorded, path: &Path) -> Result<(), String> {
    let shown = path.display();
    let format =
        Format::from_path(path).ok_or(format!("{shown}: must end in .svg, .png or .pdf"))?;
    let data_path = path.with_extension("csv");
    let claim = |path: &Path| Target::claim(path, false).map_err(|error| error.to_string());
    let (target, data_target) = (claim(path)?, claim(&data_path)?);
    let scenario = of.session.scenario();
    let mut run = charts::Run::default().with_scenario(scenario);
    run.add_state(&of.session);
    run.loops.extend(of.loops.last());
    let charts = charts::USUAL.iter();
    let charts = charts.filter_map(|recipe| recipe.on_paper(&run).ok());
    let sheet = Sheet {
        title: scenario.title().to_owned(),
        facts: run.facts(),
        charts: charts.collect(),
    };
    let look = FigureStyle {
        font: FONT,
        style: Style::Color,
    };
    let saved = sheet.save(&look, None, DPI, &[(target, format)], &[data_target]);
    saved.map_err(|error| error.to_string())
}
