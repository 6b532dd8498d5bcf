//! The cursor: a position on each abscissa, and the part of the abscissa that is shown around it.

use std::collections::HashMap;

use super::panels::Panel;
use crate::reading::Column;

/// An abscissa, named by its column. Charts over the same one share the cursor's position.
pub type Abscissa = &'static str;

/// The one of charts over r.
pub const RADIUS: Abscissa = Column::Radius.name();

/// Returns the abscissa of a panel; the cursor of pictures moves along the radius.
pub fn abscissa(panel: Panel) -> Abscissa {
    panel.chart().map_or(RADIUS, |recipe| {
        let first = recipe.overlays.first();
        first.map_or(recipe.title, |axes| axes.x.name())
    })
}

/// Cursor steps across the shown part, and the step at which the cursor begins.
const STEPS: f64 = 100.0;
const START: f64 = 33.0;

/// The factor of one zoom step, and the smallest part of an axis that can be shown.
const ZOOM: f64 = 2.0;
const SMALLEST: f64 = 1e-6;

/// The cursor.
#[derive(Debug, Default)]
pub struct Cursor {
    is_shown: bool,
    sights: HashMap<Abscissa, Sight>,
}

/// A position on an abscissa, and the ends of the shown part; `None` shows all of it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sight {
    place: f64,
    window: Option<[f64; 2]>,
}

impl Cursor {
    /// Shows or hides the cursor, and undoes its zooms.
    pub fn toggle(&mut self) {
        self.is_shown = !self.is_shown;
        self.sights.clear();
    }

    /// Whether the cursor is shown.
    pub fn is_shown(&self) -> bool {
        self.is_shown
    }

    /// Shows all of every axis; returns whether any was zoomed.
    pub fn show_all(&mut self) -> bool {
        let windows = self.sights.values_mut().map(|sight| sight.window.take());
        windows.filter(Option::is_some).count() > 0
    }

    /// Returns the shown part of an abscissa, unless that is all of it.
    pub fn window(&self, of: Abscissa) -> Option<[f64; 2]> {
        self.sights.get(of)?.window
    }

    /// Returns its position on an abscissa with the ends `whole`.
    pub fn place(&self, of: Abscissa, whole: [f64; 2]) -> Option<f64> {
        self.is_shown.then(|| self.sight(of, whole).place)
    }

    fn sight(&self, of: Abscissa, [low, high]: [f64; 2]) -> Sight {
        let start = Sight {
            place: low + START / STEPS * (high - low),
            window: None,
        };
        let mut sight = self.sights.get(of).copied().unwrap_or(start);
        sight.place = sight.place.clamp(low, high.max(low));
        sight
    }

    /// Moves it to a position.
    pub fn put(&mut self, of: Abscissa, whole: [f64; 2], place: f64) {
        let sight = Sight {
            place,
            ..self.sight(of, whole)
        };
        self.sights.insert(of, sight);
    }

    /// Moves it by hundredths of the shown part, which moves along at its ends.
    pub fn shift(&mut self, of: Abscissa, whole: [f64; 2], steps: i16) {
        let mut sight = self.sight(of, whole);
        let [low, high] = sight.window.unwrap_or(whole);
        let place = sight.place + f64::from(steps) * (high - low) / STEPS;
        sight.place = place.clamp(whole[0], whole[1]);
        let beyond = (sight.place - high).max(0.0) + (sight.place - low).min(0.0);
        sight.window = sight.window.map(|ends| ends.map(|end| end + beyond));
        self.sights.insert(of, sight);
    }

    /// Zooms in or out around it by a factor of two, at most to the whole axis.
    pub fn zoom(&mut self, of: Abscissa, whole: [f64; 2], is_nearer: bool) {
        let mut sight = self.sight(of, whole);
        let ends = sight.window.unwrap_or(whole);
        let factor = if is_nearer { 1.0 / ZOOM } else { ZOOM };
        let all = whole[1] - whole[0];
        let width = factor * (ends[1] - ends[0]);
        let share = (sight.place - ends[0]) / (ends[1] - ends[0]);
        // The shown part stays within the axis.
        let low = (sight.place - share * width).clamp(whole[0], (whole[1] - width).max(whole[0]));
        sight.window = match width {
            width if width >= all * (1.0 - 1e-9) => None,
            width if width < SMALLEST * all => sight.window,
            width => Some([low, low + width]),
        };
        self.sights.insert(of, sight);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_zooms_about_its_place_and_pans_at_the_edge() {
        let (mut cursor, whole) = (Cursor::default(), [0.0, 100.0]);
        assert_eq!(cursor.place("r_m", whole), None);
        cursor.toggle();
        assert_eq!(cursor.place("r_m", whole), Some(33.0));
        cursor.zoom("r_m", whole, true);
        assert_eq!(cursor.window("r_m"), Some([16.5, 66.5]));
        // Another axis is not zoomed.
        assert_eq!(cursor.window("cycle"), None);
        cursor.shift("r_m", whole, 80);
        assert_eq!(cursor.place("r_m", whole), Some(73.0));
        assert_eq!(cursor.window("r_m"), Some([23.0, 73.0]));
        cursor.shift("r_m", whole, 200);
        assert_eq!(cursor.window("r_m"), Some([50.0, 100.0]));
        cursor.zoom("r_m", whole, false);
        assert_eq!(cursor.window("r_m"), None);
        for _ in 0..60 {
            cursor.zoom("r_m", whole, true);
        }
        let [low, high] = cursor.window("r_m").expect("a window");
        assert!(high - low >= 1e-4 && low <= 100.0 && 100.0 <= high + 1e-9);
        assert!(cursor.show_all() && !cursor.show_all());
    }
}
