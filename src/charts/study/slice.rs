//! The axes of a study that a chart shows: one of a sequence of points, or one or two of a grid, cut through the others.

use crate::scenario::printable;
use crate::studies::sweep::{Design, Results, StudyAxis};

/// A study with its rows, and the axes shown.
#[derive(Debug)]
pub struct Slice {
    /// The study and its rows.
    pub results: Results,
    /// The axis to the right.
    pub x: usize,
    /// The axis upwards; `None` if there is only one axis, or no grid.
    pub y: Option<usize>,
    /// A place on each axis, or without a grid the same point on all. On the axes shown, these are a cursor's places.
    pub at: Vec<usize>,
}

impl Slice {
    /// Shows the last and the first axis of a study, with the others at their first places. Axes that are `held` at one
    /// of their values, as `KEY=VALUE`, are not shown.
    ///
    /// # Errors
    ///
    /// In one line, if a held key is not an axis, its axis does not have that value, or no axis is left to show.
    pub fn new(results: Results, held: &[String]) -> Result<Self, String> {
        let axes = results.study.axes.len();
        let is_grid = results.study.design == Design::Grid;
        let mut slice = Self {
            results,
            x: 0,
            y: None,
            at: vec![0; axes],
        };
        let mut shown = Vec::from_iter(0..if is_grid { axes } else { 1 });
        for set in held {
            let (key, value) = set.split_once('=').unwrap_or((set, ""));
            let refused = |why: String| format!("--set {}: {why}", printable(set));
            if !is_grid {
                return Err(refused("only a grid has axes to hold".into()));
            }
            let [axis, place] = slice.find(key.trim(), value.trim()).map_err(refused)?;
            slice.at[axis] = place;
            shown.retain(|other| *other != axis);
            if shown.is_empty() {
                return Err(refused("no axis is left to draw over".into()));
            }
        }
        slice.x = shown.pop().unwrap_or_default();
        slice.y = shown.first().copied();
        Ok(slice)
    }

    /// Finds an axis and one of its values.
    fn find(&self, key: &str, value: &str) -> Result<[usize; 2], String> {
        let axes = &self.results.study.axes;
        let Some(at) = axes.iter().position(|axis| axis.key.path == key) else {
            let keys: Vec<&str> = axes.iter().map(|axis| axis.key.path).collect();
            return Err(format!("the axes are {}", keys.join(", ")));
        };
        let (axis, wanted) = (&axes[at], value.parse::<f64>().ok());
        let is_wanted = |place: &usize| match (axis.number(*place), wanted) {
            (Some(number), Some(wanted)) => (number - wanted).abs() <= 1e-9 * number.abs(),
            _ => axis.text(*place) == value,
        };
        let place = (0..axis.count()).find(is_wanted).ok_or_else(|| {
            let values: Vec<String> = (0..axis.count()).map(|place| axis.text(place)).collect();
            format!("must be one of {}", values.join(", "))
        })?;
        Ok([at, place])
    }

    /// Returns the axis to the right.
    pub fn x(&self) -> &StudyAxis {
        &self.results.study.axes[self.x]
    }

    /// Returns the axis upwards.
    pub fn y(&self) -> Option<&StudyAxis> {
        self.y.map(|y| &self.results.study.axes[y])
    }

    /// Returns the axes that are not shown.
    pub fn hidden(&self) -> impl Iterator<Item = usize> {
        let is_grid = self.results.study.design == Design::Grid;
        let shown = [Some(self.x), self.y];
        (0..self.at.len()).filter(move |axis| is_grid && !shown.contains(&Some(*axis)))
    }

    /// Returns the numbers of places to the right and upwards.
    pub fn size(&self) -> [usize; 2] {
        let high = self.y().map_or(1, StudyAxis::count);
        [self.x().count(), high]
    }

    /// Returns the cursor's places to the right and upwards.
    pub fn cursor(&self) -> [usize; 2] {
        [self.at[self.x], self.y.map_or(0, |y| self.at[y])]
    }

    /// Returns the point at a place to the right and upwards.
    pub fn point_at(&self, [x, y]: [usize; 2]) -> usize {
        if self.results.study.design != Design::Grid {
            return x;
        }
        let mut at = self.at.clone();
        at[self.x] = x;
        if let Some(axis) = self.y {
            at[axis] = y;
        }
        let axes = self.results.study.axes.iter().zip(at);
        axes.fold(0, |point, (axis, place)| point * axis.count() + place)
    }

    /// Returns the places shown, row by row.
    pub fn places(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        let [wide, high] = self.size();
        (0..high).flat_map(move |y| (0..wide).map(move |x| [x, y]))
    }

    /// Returns the points shown, row by row.
    pub fn points(&self) -> impl Iterator<Item = usize> {
        self.places().map(|place| self.point_at(place))
    }
}
