//! Charts, and how a terminal draws one: a pure function of the chart, the look and the area.
//!
//! ```text
//! p [GPa]                   c      a    note r [µm] →   titles, mark labels, note
//!   3 ┤⠉⠑⠢⣀                 ⡂      ⡂    ─ now          plot, legend in its emptiest corner
//!   2 ┤    ⠈⠢⣀              ⡂      ⡂    ╌ unworn
//!   1 ┤       ⠈⠢⡀           ⡂      ⡂
//!   0 ┤          ⠈⠒⠤⣀⣀⣀⣀⣀⣀⣀⣀⡂⣀⣀⣀⣀⣀⣀⡂
//!      ▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀     band (zones along x)
//!     └┬─────────────┬─────────────┬───────────────     axis line, from 8 rows up
//!      0            50            100                  tick labels
//! ```
//!
//! One idea per file: `chart` (what is drawn, on a screen or on paper), `map` (values as colours in it), `shades` (the
//! colours and signs of a terminal), `theme` (what roles look like), `units` (SI prefixes), `axis` (what an axis shows,
//! its bounds), `window` (the map from values to dots), `step` (the 1-2-5 grid), `ticks` (an axis laid over cells, on a
//! screen or on paper), `marker`, `stroke`, `raster` and `segment` (dots finer than a cell), `legend`, `words` (titles
//! and labels), `widget` (the layout above).
//!
//! All data are in plain units (m, Pa); the plot chooses the prefixes. Points where x or y is not finite, or not
//! positive on a log axis, are gaps. Where a curve leaves given bounds through the top, `▲` marks the place. No area
//! and no data make it panic; below 12 by 4 cells only the curves are drawn.

pub mod axis;
pub mod chart;
pub mod colormap;
mod legend;
pub mod map;
mod marker;
mod raster;
pub mod segment;
pub mod shades;
pub(crate) mod step;
mod stroke;
pub mod theme;
pub mod ticks;
pub mod units;
mod widget;
pub mod window;
mod words;

#[cfg(test)]
mod dot_tests;
#[cfg(test)]
mod tests;

pub use axis::{Axis, Scale, nice_bounds, sticky_bounds};
pub use chart::{Chart, Curve, Mark, Point};
pub use map::Map;
pub use marker::Marker;

use ratatui::layout::Rect;
use theme::Theme;

/// The widget: a chart, the look of the terminal, and optionally a cursor. See the [module](self) for its parts.
#[derive(Debug, Clone, Copy)]
pub struct Plot<'a> {
    chart: &'a Chart,
    theme: &'a Theme,
    cursor: Option<f64>,
    rule: Option<Rect>,
}

impl<'a> Plot<'a> {
    /// A chart in this look.
    pub fn new(chart: &'a Chart, theme: &'a Theme) -> Self {
        Plot {
            chart,
            theme,
            cursor: None,
            rule: None,
        }
    }

    /// Sets the free part of the rule above the plot, in which the abscissa's title goes.
    #[must_use]
    pub fn rule(mut self, rule: Rect) -> Self {
        self.rule = Some(rule);
        self
    }

    /// Adds a vertical line at this x (in the x axis' unit), and each curve's value there to the legend, interpolated
    /// linearly between neighbouring points.
    #[must_use]
    pub fn cursor(self, cursor: Option<f64>) -> Self {
        Plot { cursor, ..self }
    }
}
