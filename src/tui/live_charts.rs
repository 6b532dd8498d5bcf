//! The charts on the screen: made once for each frame and key, on scales that follow their data calmly.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use super::frame::Frame;
use super::held::Held;
use super::panels::Panel;
use super::tour;
use crate::charts::View;
use crate::plot::{Chart, Scale};

/// A chart, or why there is none.
pub(super) type Made = Result<Chart, &'static str>;

/// The charts and their scales.
#[derive(Debug, Default)]
pub struct LiveCharts {
    charts: HashMap<Panel, Made>,
    /// The panels with a logarithmic ordinate.
    logarithmic: HashSet<Panel>,
    ordinates: HashMap<(Panel, Scale), Held>,
    abscissas: HashMap<Panel, Held>,
    /// Whether the frame is one of another run than the next: scales do not follow it.
    is_outdated: bool,
    /// Whether closed forms are drawn over the charts.
    pub with_theory: bool,
}

impl LiveCharts {
    /// The next frame is one of the scenario `origin`, another one than before if it `differs`.
    pub fn begin(&mut self, origin: &str, differs: bool) {
        if differs {
            self.logarithmic = tour::logarithmic(origin).collect();
        }
        self.is_outdated = false;
    }

    /// Another run is to come.
    pub fn forget_scales(&mut self) {
        self.ordinates.clear();
        self.abscissas.clear();
        self.is_outdated = true;
    }

    /// Whether a panel's ordinate is logarithmic.
    pub fn scale(&self, panel: Panel) -> Scale {
        match self.logarithmic.contains(&panel) {
            true => Scale::Log,
            false => Scale::Linear,
        }
    }

    /// Changes between a linear and a logarithmic ordinate.
    pub fn toggle_log(&mut self, panel: Panel) {
        if !self.logarithmic.remove(&panel) {
            self.logarithmic.insert(panel);
        }
    }

    /// The bounds of a panel's ordinate.
    pub(super) fn bounds(&self, panel: Panel) -> Option<[f64; 2]> {
        let held = self.ordinates.get(&(panel, self.scale(panel)));
        held.map(|held| held.bounds)
    }

    /// The chart of a panel: as it was made when the frame came, else of `frame`.
    pub(super) fn get(&self, panel: Panel, frame: &Frame) -> Cow<'_, Made> {
        match self.charts.get(&panel) {
            Some(chart) => Cow::Borrowed(chart),
            None => Cow::Owned(panel.recipe().chart(&frame.run, &self.view(panel))),
        }
    }

    fn view(&self, panel: Panel) -> View {
        View {
            scale: self.scale(panel),
            with_theory: self.with_theory,
        }
    }

    /// Makes those of the `visible` panels, each of the frame that it shows; a comparison has charts of its own.
    pub fn make<'a>(
        &mut self,
        visible: &[Panel],
        newest: &'a Frame,
        shown: impl Fn(Panel) -> &'a Frame,
    ) {
        self.charts.clear();
        if newest.comparison.is_some() {
            return;
        }
        let cycle = newest.observation.moment.cycle;
        for &panel in visible {
            let (recipe, view, frame) = (panel.recipe(), self.view(panel), shown(panel));
            let mut chart = recipe.chart(&frame.run, &view);
            let made = chart.as_ref().ok();
            let extent = panel.extent(frame, made);
            if let Some(extent) = extent.filter(|_| !self.is_outdated) {
                Held::hold(self.ordinates.entry((panel, view.scale)), extent, cycle);
            }
            let across = made.filter(|_| recipe.keeps_abscissa && !self.is_outdated);
            if let Some(across) = across.and_then(|chart| chart.x.bounds) {
                Held::hold(self.abscissas.entry(panel), across, cycle);
            }
            if let Ok(chart) = &mut chart {
                chart.y.bounds = self.bounds(panel);
                let across = self.abscissas.get(&panel).map(|held| held.bounds);
                chart.x.bounds = across.or(chart.x.bounds);
            }
            self.charts.insert(panel, chart);
        }
    }
}
