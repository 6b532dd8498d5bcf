//! The view of a study: axes, column and cursor.

use crate::charts::study::lines::borders;
use crate::charts::study::{Slice, chart};
use crate::plot::{Chart, Curve, Scale};
use crate::reading::Column;
use crate::studies::sweep::{Design, Results, StudyAxis};
use crate::tui::keys::{Keystroke, Named};

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
    with_lines: bool,
    /// Whether the user has switched the column's scale from the default.
    is_flipped: bool,
    /// The borders in closed form on the shown axes.
    borders: Vec<Curve>,
}

impl MapView {
    /// Makes a view of a study.
    pub fn new(results: Results, name: &str) -> Self {
        let slice = Slice::new(results, &[]).expect("no axis is held");
        Self {
            borders: borders(&slice),
            slice,
            name: name.to_owned(),
            column: 0,
            with_lines: true,
            is_flipped: false,
        }
    }

    /// Handles a key that changes the view.
    pub fn press(&mut self, key: Keystroke) {
        match key {
            Keystroke::Char('l') | Keystroke::Named(Named::Right) => {
                self.move_by(Some(self.slice.x), 1)
            }
            Keystroke::Char('h') | Keystroke::Named(Named::Left) => {
                self.move_by(Some(self.slice.x), -1)
            }
            Keystroke::Char('k') | Keystroke::Named(Named::Up) => self.move_by(self.slice.y, 1),
            Keystroke::Char('j') | Keystroke::Named(Named::Down) => self.move_by(self.slice.y, -1),
            Keystroke::Named(Named::Home) => self.move_by(Some(self.slice.x), isize::MIN / 2),
            Keystroke::Named(Named::End) => self.move_by(Some(self.slice.x), isize::MAX / 2),
            Keystroke::Named(Named::Tab) => self.turn_column(1),
            Keystroke::Named(Named::BackTab) => self.turn_column(self.columns() - 1),
            Keystroke::Char('t') => self.with_lines = !self.with_lines,
            Keystroke::Char('L') => self.is_flipped = !self.is_flipped,
            Keystroke::Char('x') => self.turn_x(),
            Keystroke::Char('y') => self.turn_y(),
            Keystroke::Char(']') => self.move_others(1),
            Keystroke::Char('[') => self.move_others(-1),
            _ => {}
        }
        if matches!(key, Keystroke::Char('x' | 'y' | '[' | ']')) {
            self.borders = borders(&self.slice);
        }
    }

    fn columns(&self) -> usize {
        self.slice.results.study.columns.len().max(1)
    }

    fn turn_column(&mut self, by: usize) {
        self.column = (self.column + by) % self.columns();
    }

    fn move_by(&mut self, axis: Option<usize>, by: isize) {
        let Some(axis) = axis else {
            return;
        };
        let last = self.slice.results.study.axes[axis].count() - 1;
        let place = self.slice.at[axis].saturating_add_signed(by).min(last);
        if self.slice.results.study.design == Design::Grid {
            self.slice.at[axis] = place;
        } else {
            self.slice.at.fill(place);
        }
    }

    /// Shows the next axis horizontally; if it was the vertical one, swaps the two.
    fn turn_x(&mut self) {
        let before = self.slice.x;
        self.slice.x = (self.slice.x + 1) % self.slice.at.len();
        if self.slice.y == Some(self.slice.x) {
            self.slice.y = Some(before);
        }
    }

    fn turn_y(&mut self) {
        let (x, axes) = (self.slice.x, self.slice.at.len());
        let next = |y: usize| (1..=axes).map(|by| (y + by) % axes).find(|y| *y != x);
        self.slice.y = self.slice.y.and_then(next);
    }

    /// Moves along the hidden axes, fastest along the last.
    fn move_others(&mut self, by: isize) {
        let hidden: Vec<usize> = self.slice.hidden().collect();
        for axis in hidden.into_iter().rev() {
            let length = self.slice.results.study.axes[axis].count() as isize;
            let place = self.slice.at[axis] as isize + by;
            self.slice.at[axis] = place.rem_euclid(length) as usize;
            if (0..length).contains(&place) {
                return;
            }
        }
    }

    /// The column that is shown; the cycle, which has no values, if the study has none.
    pub fn column(&self) -> Column {
        let column = self.slice.results.study.columns.get(self.column);
        column.copied().unwrap_or(Column::Cycle)
    }

    /// Returns the point under the cursor.
    pub fn point(&self) -> usize {
        self.slice.point_at(self.slice.cursor())
    }

    /// Returns the chart of the column, as on paper; its scale is switched if the user wants that.
    pub fn chart(&self) -> Chart {
        let borders = self.with_lines.then_some(&*self.borders);
        let mut chart = chart(&self.slice, self.column(), borders);
        let quantity = chart.map.as_mut().map(|map| &mut map.quantity);
        let quantity = quantity.unwrap_or(&mut chart.y);
        if self.is_flipped && self.column() != Column::Regime {
            quantity.scale = match quantity.scale {
                Scale::Linear => Scale::Log,
                Scale::Log => Scale::Linear,
            };
        }
        chart
    }

    /// Returns the values of the base scenario on the shown axes, if they are on the map.
    pub fn position(&self) -> Option<[f64; 2]> {
        let value = |axis: &StudyAxis| {
            let value = self.slice.results.study.base.number(axis.key.path)?;
            axis.place_of(value).map(|_| value)
        };
        let y = match self.slice.y() {
            Some(axis) => value(axis)?,
            None => 0.0,
        };
        Some([value(self.slice.x())?, y])
    }
}
