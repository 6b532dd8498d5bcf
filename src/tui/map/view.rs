//! The view of a study: axes, column and cursor.

use std::cell::RefCell;
use std::collections::HashMap;

use crate::figure::study;
use crate::math::scan;
use crate::plot::{self, Chart, Scale};
use crate::reading::Column;
use crate::scenario::Refusal;
use crate::studies::sweep::slice::{Contour, Slice};
use crate::studies::sweep::{Design, Study, StudyAxis};
use crate::tui::keys::{Key, Named};

/// A study, and the state of its view.
#[derive(Debug)]
pub struct MapView {
    /// The study, and the shown axes.
    pub slice: Slice,
    /// The title.
    pub name: String,
    /// The index of the shown column.
    column: usize,
    /// Whether borders and criteria are drawn.
    pub with_overlays: bool,
    /// Whether the user has switched the column's scale from the default.
    is_flipped: bool,
    borders: RefCell<HashMap<Vec<usize>, Vec<Contour>>>,
}

impl MapView {
    /// Makes a view of a study without rows.
    ///
    /// # Errors
    ///
    /// If the study has no axis.
    pub fn new(study: Study, name: &str) -> Result<Self, Refusal> {
        Ok(Self {
            slice: Slice::new(study, name)?,
            name: name.to_owned(),
            column: 0,
            with_overlays: true,
            is_flipped: false,
            borders: RefCell::default(),
        })
    }

    /// Handles a key that changes the view.
    pub fn press(&mut self, key: Key) {
        match key {
            Key::Char('l') | Key::Named(Named::Right) => self.move_by(Some(self.slice.x), 1),
            Key::Char('h') | Key::Named(Named::Left) => self.move_by(Some(self.slice.x), -1),
            Key::Char('k') | Key::Named(Named::Up) => self.move_by(self.slice.y, 1),
            Key::Char('j') | Key::Named(Named::Down) => self.move_by(self.slice.y, -1),
            Key::Named(Named::Home) => self.move_by(Some(self.slice.x), isize::MIN / 2),
            Key::Named(Named::End) => self.move_by(Some(self.slice.x), isize::MAX / 2),
            Key::Named(Named::Tab) => self.column = (self.column + 1) % self.columns(),
            Key::Named(Named::BackTab) => {
                self.column = (self.column + self.columns() - 1) % self.columns();
            }
            Key::Char('t') => self.with_overlays = !self.with_overlays,
            Key::Char('L') => self.is_flipped = !self.is_flipped,
            Key::Char('x') => self.turn_x(),
            Key::Char('y') => self.turn_y(),
            Key::Char(']') => self.move_others(1),
            Key::Char('[') => self.move_others(-1),
            _ => {}
        }
    }

    fn columns(&self) -> usize {
        self.slice.study.columns.len().max(1)
    }

    fn move_by(&mut self, axis: Option<usize>, by: isize) {
        let Some(axis) = axis else {
            return;
        };
        let last = self.slice.study.axes[axis].count() - 1;
        let place = self.slice.at[axis].saturating_add_signed(by).min(last);
        if self.slice.study.design == Design::Grid {
            self.slice.at[axis] = place;
        } else {
            self.slice.at.fill(place);
        }
    }

    /// Shows the next axis horizontally; if it was the vertical one, swaps the two.
    fn turn_x(&mut self) {
        let before = self.slice.x;
        self.slice.x = (self.slice.x + 1) % self.slice.study.axes.len();
        if self.slice.y == Some(self.slice.x) {
            self.slice.y = Some(before);
        }
    }

    fn turn_y(&mut self) {
        let (x, axes) = (self.slice.x, self.slice.study.axes.len());
        let next = |y: usize| (1..=axes).map(|by| (y + by) % axes).find(|y| *y != x);
        self.slice.y = self.slice.y.and_then(next);
    }

    /// Moves along the hidden axes, fastest along the last.
    fn move_others(&mut self, by: isize) {
        let hidden: Vec<usize> = self.slice.hidden().collect();
        for axis in hidden.into_iter().rev() {
            let length = self.slice.study.axes[axis].count() as isize;
            let place = self.slice.at[axis] as isize + by;
            self.slice.at[axis] = place.rem_euclid(length) as usize;
            if (0..length).contains(&place) {
                return;
            }
        }
    }

    /// Returns the cursor's position on the horizontal and the vertical axis.
    pub fn cursor(&self) -> [usize; 2] {
        let y = self.slice.y.map_or(0, |y| self.slice.at[y]);
        [self.slice.at[self.slice.x], y]
    }

    /// The column that is shown; the cycle, which has no values, if the study has none.
    pub fn column(&self) -> Column {
        let column = self.slice.study.columns.get(self.column);
        column.copied().unwrap_or(Column::Cycle)
    }

    /// Returns the point under the cursor.
    pub fn point(&self) -> usize {
        let [x, y] = self.cursor();
        self.slice.point_at(x, y)
    }

    /// Whether the column holds words.
    pub fn is_regime(&self) -> bool {
        self.column() == Column::Regime
    }

    /// Returns the chart of the column, as on paper. Its colours end at the shown values, and its scale is switched if
    /// the user wants that.
    pub fn chart(&self) -> Chart {
        let lines = if self.with_overlays {
            [self.borders(), self.slice.criteria()]
        } else {
            Default::default()
        };
        let mut chart = study::chart(&self.slice, self.column(), lines);
        let quantity = chart.map.as_mut().map(|map| &mut map.quantity);
        let quantity = quantity.unwrap_or(&mut chart.y);
        if self.is_flipped && !self.is_regime() {
            quantity.scale = match quantity.scale {
                Scale::Linear => Scale::Log,
                Scale::Log => Scale::Linear,
            };
        }
        let (_, range) = shown(&chart);
        if let Some(map) = &mut chart.map {
            map.quantity.bounds = range;
        }
        chart
    }

    /// Returns the values of the base scenario on the shown axes, if they are on the map.
    pub fn position(&self) -> Option<[f64; 2]> {
        let value = |axis: &StudyAxis| {
            let value = self.slice.study.base.number(&axis.key)?;
            axis.place_of(value).map(|_| value)
        };
        let y = match self.slice.y() {
            Some(axis) => value(axis)?,
            None => 0.0,
        };
        Some([value(self.slice.x())?, y])
    }

    /// Returns the closed forms, computed once per position on the hidden axes.
    fn borders(&self) -> Vec<Contour> {
        let mut key = self.slice.at.clone();
        for axis in [Some(self.slice.x), self.slice.y].into_iter().flatten() {
            key[axis] = 0;
            key.push(axis);
        }
        let mut known = self.borders.borrow_mut();
        known
            .entry(key)
            .or_insert_with(|| self.slice.borders())
            .clone()
    }
}

/// Returns the quantity that a chart of a study shows, with its smallest and largest value; `None` without any.
pub fn shown(chart: &Chart) -> (&plot::Axis, Option<[f64; 2]>) {
    let (quantity, values) = match &chart.map {
        Some(map) => (&map.quantity, Some(&map.values)),
        None => (&chart.y, chart.curves.first().map(|curve| &curve.ys)),
    };
    let values = values.into_iter().flatten().copied();
    let range = scan::range(values.filter(|value| quantity.scale.has(*value)));
    (quantity, range)
}
