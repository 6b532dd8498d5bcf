//! Panels: the charts on the screen, and pictures made of characters, one per file.

use ratatui::layout::Constraint::{Fill, Length};
use ratatui::prelude::*;

use super::canvas::Canvas;
use super::frame::Frame;
use crate::charts::{self, About, Recipe};
use crate::math::scan::{self};
use crate::plot::theme::{Role, Theme};
use crate::plot::{Chart, Curve, Plot, Scale};

mod caption;
mod cut;
pub(super) mod numbers;
mod scar;
mod section;
mod stress_map;

pub use caption::contact_state;
pub use stress_map::{Drawn, StressMap};

/// What a panel shows.
pub enum Content {
    /// A chart.
    Chart(&'static Recipe),
    /// What no chart can be.
    Picture(&'static Recipe<Picture>),
}

/// How a panel is made that no chart can be.
#[derive(Clone, Copy)]
pub struct Picture {
    /// Draws it below a rule with the title.
    pub draw: fn(&Shown, Canvas),
    /// The values that it must hold.
    pub extent: fn(&Frame) -> Option<[f64; 2]>,
}

/// What a picture shows.
pub struct Shown<'a> {
    /// The frame of the panel.
    pub frame: &'a Frame,
    /// The frame for what changes more calmly: stresses and text.
    pub calm: &'a Frame,
    /// The stress to show.
    pub stress: StressMap,
    /// Its samples on the screen.
    pub drawn: &'a Drawn,
    /// The values that its scale holds.
    pub bounds: Option<[f64; 2]>,
    /// The role of its title.
    pub role: Role,
}

/// The panels in reading order; the first four fill a small screen.
macro_rules! panels {
    ($($(#[$mark:meta])? $what:literal $name:ident: $content:ident $recipe:expr;)*) => {
        /// The panels of the explorer.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
        pub enum Panel {
            $(#[doc = $what] $(#[$mark])? $name,)*
        }

        impl Panel {
            /// All panels, in reading order.
            pub const ALL: [Self; [$($what),*].len()] = [$(Self::$name),*];

            /// What it shows.
            pub fn content(self) -> Content {
                match self {
                    $(Self::$name => Content::$content(&$recipe),)*
                }
            }
        }
    };
}

panels! {
    #[default] "The 3D profile." Profile: Chart charts::profile::RECIPE;
    "p and τ." Stresses: Chart charts::stresses::RECIPE;
    "F_x over u_x." Loop: Chart charts::fretting_loop::RECIPE;
    "Radii over cycles." Radii: Chart charts::radii::RECIPE;
    "A cut through indenter and half-space." Section: Picture section::RECIPE;
    "The numbers of the moment." Numbers: Picture numbers::RECIPE;
    "The 1D profile." Springs: Chart charts::springs::RECIPE;
    "Worn depth over the radius." Depth: Chart charts::depth::RECIPE;
    "Wear volume over cycles." Volume: Chart charts::volume::RECIPE;
    "Wear volume per cycle, over cycles." Rate: Chart charts::rate::RECIPE;
    "Wear volume against friction work, over cycles." Residual: Chart charts::residual::RECIPE;
    "Time per step over cycles." Cost: Chart charts::cost::RECIPE;
    "The scar from above." Scar: Picture scar::RECIPE;
    "The loops of earlier cycles." Log: Chart charts::fretting_log::RECIPE;
    "Normal load over displacement amplitude." Condition: Chart charts::condition::RECIPE;
    "Largest worn depth over cycles." ScarDepth: Chart charts::scar_depth::RECIPE;
    "The scar's radius and depth over friction work." ScarGrowth: Chart charts::scar_growth::RECIPE;
}

impl Panel {
    /// Its description.
    pub fn recipe(self) -> &'static About {
        match self.content() {
            Content::Chart(recipe) => recipe,
            Content::Picture(recipe) => recipe,
        }
    }

    /// Its chart, if it shows one.
    pub fn chart(self) -> Option<&'static Recipe> {
        match self.content() {
            Content::Chart(recipe) => Some(recipe),
            Content::Picture(_) => None,
        }
    }

    /// The one with a title.
    pub fn titled(title: &str) -> Option<Self> {
        let mut panels = Self::ALL.into_iter();
        panels.find(|panel| panel.recipe().title == title)
    }
}

/// The abscissa under a place of the screen, where the panel in `area` has its chart there.
pub fn abscissa_at(chart: &Chart, theme: &Theme, area: Rect, at: Position) -> Option<f64> {
    // The first row is the title's.
    let [_, inner] = Layout::vertical([Length(1), Fill(1)]).areas(area);
    Plot::new(chart, theme).abscissa_at(inner, at)
}

/// The smallest and largest ordinate of a live chart: given bounds, or the range of all curves except closed forms.
pub(super) fn extent(chart: &Chart, has_spikes: bool) -> Option<[f64; 2]> {
    if chart.y.bounds.is_some() {
        return chart.y.bounds;
    }
    let [_, range] = chart.extent(|curve| !curve.is_theory);
    let [low, high] = range?;
    match chart.y.scale {
        // Five decades show more than the last trace of stress at the contact edge.
        Scale::Log => Some([low.max(1e-5 * high), high]),
        Scale::Linear if has_spikes => {
            let curves = chart.curves.iter().filter(|curve| !curve.is_theory);
            let top = curves.map(spread_top).fold(0.0, f64::max);
            if chart.y.is_symmetric {
                Some([-top, top])
            } else {
                Some([low.max(-top), high.min(top)])
            }
        }
        Scale::Linear => Some([low, high]),
    }
}

/// Returns how far the axis must reach for a curve, judging by the width that its values take on the abscissa: a higher
/// value in a narrow place is clipped, and marked in the plot.
pub fn spread_top(curve: &Curve) -> f64 {
    let xs = &curve.xs;
    let x = |k: usize| xs[k.min(xs.len() - 1)];
    let sizes = curve.ys.iter().take(xs.len()).enumerate();
    let sizes = sizes.map(|(k, y)| [y.abs(), (x(k + 1) - x(k.saturating_sub(1))).abs()]);
    scan::robust_top(sizes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reading::Column;

    #[test]
    fn a_spike_does_not_flatten_the_rest_and_a_smooth_curve_is_whole() {
        let radii: Vec<f64> = (0..100).map(f64::from).collect();
        let mut values: Vec<f64> = radii.iter().map(|r| r.sqrt()).collect();
        let top = |radii: &[f64], values: &[f64]| {
            spread_top(&Curve::new("", radii, values, Role::Pressure))
        };
        assert_eq!(top(&radii, &values), values[99]);
        values[50] = 1e6;
        let high = top(&radii, &values);
        assert!((10.0..20.0).contains(&high), "{high}");
        // Nodes crowd where a stress is singular: 1/√(a² − r²) of a flat punch, with half of the nodes in the last
        // thousandth.
        let outer = (1..100).map(|k| 1.0 - 1e-3 * 0.9_f64.powi(k));
        let radii: Vec<f64> = (0..100)
            .map(|k| 0.00999 * f64::from(k))
            .chain(outer)
            .collect();
        let values: Vec<f64> = radii.iter().map(|r| (1.0 - r * r).powf(-0.5)).collect();
        let high = top(&radii, &values);
        assert!((4.0..8.0).contains(&high), "{high}");
    }

    /// A chart that is missing in the list has none of its columns recorded.
    #[test]
    fn the_list_of_charts_has_each_panel_of_one_and_each_chart_has_its_columns() {
        let is_listed = |chart: &&Recipe| charts::ALL.iter().any(|one| one.title == chart.title);
        let mut panels = Panel::ALL.into_iter().filter_map(Panel::chart);
        assert!(panels.all(|chart| is_listed(&chart)));
        for chart in charts::ALL {
            let shown = chart.overlays.iter().flat_map(|axes| [axes.x, axes.y]);
            let recorded = charts::history_columns([*chart]);
            let of_history = shown.filter(|column| Column::HISTORY.contains(column));
            for column in of_history {
                assert!(recorded.contains(&column), "{}: {column:?}", chart.title);
            }
        }
    }

    #[test]
    fn every_panel_is_explained_in_a_box_of_a_small_screen() {
        for panel in Panel::ALL {
            let (text, symbols) = (panel.recipe().text, panel.recipe().symbols);
            assert!((50..=330).contains(&text.chars().count()), "{panel:?}");
            assert!(!text.contains("  ") && text.ends_with('.'), "{panel:?}");
            assert!((1..=5).contains(&symbols.len()), "{panel:?}");
            for (symbol, meaning) in symbols {
                assert!(
                    symbol.chars().count() <= 11 && meaning.chars().count() <= 60,
                    "{panel:?}: at most 11 characters of {symbol:?}, at most 60 of {meaning:?}"
                );
            }
        }
    }
}
