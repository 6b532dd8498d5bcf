//! The charts on the screen, made once per frame and key, on scales that follow their data calmly. In a live run the
//! bounds of an axis hold for a whole period of the motion, and calm panels show every third frame, which saves two
//! thirds of their bytes and stress computations.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::cursor::{Cursor, abscissa};
use super::frame::{Activity, Frame};
use super::held::Held;
use super::panels::{Content, Panel, extent};
use super::stage::Stage;
use super::tour;
use crate::charts::{Medium, Recipe, View};
use crate::math::scan::{range, value_at};
use crate::plot::{Chart, Scale};

/// A chart, or why there is none.
pub(super) type Made = Result<Chart, &'static str>;

/// The charts and their scales.
#[derive(Debug, Default)]
pub struct LiveCharts {
    /// The scenario of the charts.
    origin: String,
    charts: HashMap<Panel, Made>,
    /// The panels with a logarithmic ordinate.
    logarithmic: HashSet<Panel>,
    /// The bounds of ordinates by scale, and of abscissae.
    held: HashMap<(Panel, Option<Scale>), Held>,
    /// The range of each chart's curves along the abscissa.
    whole: HashMap<Panel, [f64; 2]>,
    /// The shown parts of zoomed abscissae, and the bounds of the ordinates there.
    parts: HashMap<Panel, ([f64; 2], Held)>,
    /// Whether the next frame belongs to another run: scales do not follow the old one.
    is_outdated: bool,
    /// Whether closed forms are drawn over the charts.
    pub with_theory: bool,
}

impl LiveCharts {
    /// Announces that the next frame is from the scenario `origin`.
    pub fn begin(&mut self, origin: &str) {
        if self.origin != origin {
            self.origin = origin.to_owned();
            self.logarithmic = tour::logarithmic(origin).collect();
        }
        self.is_outdated = false;
    }

    /// Announces another run.
    pub fn forget_scales(&mut self) {
        self.held.clear();
        self.is_outdated = true;
    }

    /// Returns the scale of a panel's ordinate.
    pub fn scale(&self, panel: Panel) -> Scale {
        if self.logarithmic.contains(&panel) {
            Scale::Log
        } else {
            Scale::Linear
        }
    }

    /// Toggles between a linear and a logarithmic ordinate.
    pub fn toggle_log(&mut self, panel: Panel) {
        if !self.logarithmic.remove(&panel) {
            self.logarithmic.insert(panel);
        }
    }

    /// Returns the bounds of a panel's ordinate.
    pub(super) fn bounds(&self, panel: Panel) -> Option<[f64; 2]> {
        let held = self.held.get(&(panel, Some(self.scale(panel))));
        held.map(|held| held.bounds)
    }

    /// Updates an axis with its range in a frame at `cycle`, and returns its bounds. While all values are zero, their
    /// size is unknown, and there are no bounds.
    fn update_bounds(
        &mut self,
        axis: (Panel, Option<Scale>),
        range: Option<[f64; 2]>,
        cycle: f64,
    ) -> Option<[f64; 2]> {
        let tells = |range: &[f64; 2]| !self.is_outdated && *range != [0.0, 0.0];
        if let Some([low, high]) = range.filter(tells) {
            // The first cycle has hardly begun, so its stresses will grow.
            let room = if axis.0.recipe().has_spikes {
                ROOM
            } else {
                1.0
            };
            let first = || Held::new([low, high].map(|end| room * end), cycle);
            let held = self.held.entry(axis).or_insert_with(first);
            held.include([low, high], cycle);
        }
        self.held.get(&axis).map(|held| held.bounds)
    }

    /// The chart of a panel: as it was made when the frame came, else of `frame`.
    pub(super) fn get(&self, panel: Panel, recipe: &Recipe, frame: &Frame) -> Cow<'_, Made> {
        match self.charts.get(&panel) {
            Some(chart) => Cow::Borrowed(chart),
            None => Cow::Owned(recipe.chart(&frame.run, &self.view(panel, frame))),
        }
    }

    fn view<'f>(&self, panel: Panel, frame: &'f Frame) -> View<'f> {
        View {
            medium: Medium::Screen(&frame.live),
            scale: self.scale(panel),
            with_theory: self.with_theory,
        }
    }

    /// Makes the charts of the `visible` panels, each for the frame that it shows.
    pub fn make<'a>(
        &mut self,
        visible: &[Panel],
        newest: &'a Frame,
        shown: impl Fn(Panel) -> &'a Frame,
        cursor: &Cursor,
    ) {
        self.charts.clear();
        let cycle = newest.live.observation.moment.cycle;
        for &panel in visible {
            let frame = shown(panel);
            let view = self.view(panel, frame);
            let ordinate = (panel, Some(view.scale));
            let recipe = match panel.content() {
                Content::Chart(recipe) => recipe,
                Content::Picture(picture) => {
                    self.update_bounds(ordinate, (picture.make.extent)(frame), cycle);
                    continue;
                }
            };
            let mut chart = recipe.chart(&frame.run, &view);
            let made = chart.as_ref().ok();
            let keeps = made.filter(|_| recipe.keeps_abscissa);
            let range = keeps.and_then(|chart| chart.x.bounds);
            let extent = made.and_then(|chart| extent(chart, recipe.has_spikes));
            let along = self.update_bounds(ordinate, extent, cycle);
            let across = self.update_bounds((panel, None), range, cycle);
            if let Ok(chart) = &mut chart {
                chart.y.bounds = along;
                chart.x.bounds = across.or(chart.x.bounds);
                let [data, _] = chart.extent(|curve| !curve.is_theory);
                self.whole
                    .insert(panel, chart.x.clone().unbounded().resolve(data, false));
                match cursor.window(abscissa(panel)) {
                    Some(window) => self.show_part(panel, chart, window, cycle),
                    None => _ = self.parts.remove(&panel),
                }
            }
            self.charts.insert(panel, chart);
        }
    }

    /// Returns the upper end of a panel's ordinate; 0 before it has one.
    pub fn top_of(&self, panel: Panel) -> f64 {
        self.bounds(panel).map_or(0.0, |[_, high]| high)
    }

    /// Returns the range of a panel's curves along the abscissa, if it has a chart.
    pub(super) fn whole_range(&self, panel: Panel) -> Option<[f64; 2]> {
        self.whole.get(&panel).copied()
    }

    /// Restricts a chart to a part of its abscissa, and its ordinate to the curves there, spikes included.
    fn show_part(&mut self, panel: Panel, chart: &mut Chart, [low, high]: [f64; 2], cycle: f64) {
        let scale = chart.y.scale;
        let within = chart.curves.iter().filter(|curve| !curve.is_theory);
        let values = within.flat_map(|curve| {
            let drawn = |x| value_at(&curve.xs, &curve.ys, x);
            let inner = curve.points().filter(|(x, _)| (low..=high).contains(x));
            let inner = inner.map(|(_, y)| y);
            inner.chain([low, high].into_iter().filter_map(drawn))
        });
        chart.x.bounds = Some([low, high]);
        let Some(range) = range(values.filter(|value| scale.has(*value))) else {
            return;
        };
        let part = (range, Held::new(range, cycle));
        let (ends, held) = self.parts.entry(panel).or_insert(part);
        if *ends != [low, high] {
            (*ends, *held) = ([low, high], Held::new(range, cycle));
        }
        held.include(range, cycle);
        chart.y.bounds = Some(held.bounds);
    }
}

/// An axis with spikes reaches this factor beyond its first values.
const ROOM: f64 = 1.2;

/// Number of frames for which a frame is held.
const LASTS: u32 = 3;

/// The held frame, and for how many frames it has been held; `None` while the newest one is shown.
#[derive(Debug, Default)]
pub struct Calm(Option<(Arc<Frame>, u32)>);

impl Calm {
    /// Holds its frame for a few frames, then takes `newest`; returns whether it has. In a `slow` view it is held for a
    /// whole cycle, so that a contact shown large has the stress of one phase of the motion.
    pub fn update(&mut self, newest: &Arc<Frame>, slow: bool) -> bool {
        let begins = |frame: &Frame| frame.live.observation.moment.cycle.floor();
        let may_stay = |calm: &Frame, lasted| {
            if slow {
                begins(calm) == begins(newest)
            } else {
                lasted < LASTS
            }
        };
        let kept = self.0.take();
        let kept = kept.filter(|(calm, lasted)| may_stay(calm, *lasted) && may_last(calm, newest));
        let (calm, lasted) = kept.unwrap_or_else(|| (Arc::clone(newest), 0));
        self.0 = Some((calm, lasted + 1));
        lasted == 0
    }

    /// Returns the frame for a calm panel when the others show `frame`.
    pub fn frame_or<'a>(&'a self, frame: &'a Frame) -> &'a Frame {
        self.0.as_ref().map_or(frame, |(calm, _)| calm)
    }

    /// Returns the frame for a panel when the screen shows `frame`. The large contact is not calm: its indenter moves
    /// in every frame.
    pub fn shown<'a>(&'a self, panel: Panel, stage: &Stage, frame: &'a Frame) -> &'a Frame {
        let is_large = panel == Panel::Section && stage.shows_contact();
        if panel.recipe().is_calm && !is_large {
            self.frame_or(frame)
        } else {
            frame
        }
    }
}

/// Whether `calm` may stay while the others show `frame`: the run continues, and both hold the same kinds of data.
fn may_last(calm: &Frame, frame: &Frame) -> bool {
    frame.activity == Activity::Running
        && frame.live.observation.moment.cycle >= calm.live.observation.moment.cycle
        && frame.load.is_some() == calm.load.is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A run begins with a displacement of zero, which must not lead to an axis of one metre.
    #[test]
    fn zeros_are_not_held() {
        let mut charts = LiveCharts::default();
        let axis = (Panel::Loop, None);
        assert_eq!(charts.update_bounds(axis, Some([0.0, 0.0]), 0.0), None);
        assert_eq!(
            charts.update_bounds(axis, Some([0.0, 2e-7]), 0.1),
            Some([0.0, 2e-7])
        );
        assert_eq!(
            charts.update_bounds(axis, Some([0.0, 0.0]), 0.2),
            Some([0.0, 2e-7])
        );
    }
}
