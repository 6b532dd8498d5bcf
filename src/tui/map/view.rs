//! The view of a study: axes, column and cursor.

use std::cell::RefCell;
use std::collections::HashMap;

use super::ramp::Shade;
use crate::figure::study;
use crate::plot::{self, Scale};
use crate::scenario::Refusal;
use crate::studies::sweep::record::Record;
use crate::studies::sweep::slice::{Line, Slice};
use crate::studies::sweep::{Axis, Design, Study};
use crate::tui::keys::{Key, Named};

/// How the view is left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Leave {
    /// For good.
    Quit,
    /// To open this point in the explorer.
    Open(usize),
}

/// The column that is shown, with the scale of its colours.
#[derive(Debug)]
pub struct Scaled {
    /// Column and unit in words. Logarithmic where the values span decades, unless the user wants the other
    /// scale.
    pub quantity: plot::Axis,
    /// The smallest and the largest number, positive ones alone on a logarithmic scale; `None` without any.
    pub range: Option<[f64; 2]>,
}

/// A study, and what of it is shown.
#[derive(Debug)]
pub struct View {
    /// The study, and what of it is shown.
    pub slice: Slice,
    /// The title.
    pub name: String,
    /// Which of the columns.
    column: usize,
    /// Whether borders and criteria are drawn.
    pub with_overlays: bool,
    /// Whether the scale of the column is the other one than what its values ask for.
    is_flipped: bool,
    borders: RefCell<HashMap<Vec<usize>, Vec<Line>>>,
    /// A notice, shown until the next key.
    pub notice: Option<String>,
}

impl View {
    /// A view of a table.
    ///
    /// # Errors
    ///
    /// If the header of the table has no study, or rows do not belong to it.
    pub fn new(record: Record, name: &str) -> Result<Self, Refusal> {
        let mut view = Self::of(record.study()?, name)?;
        view.renew(record)?;
        Ok(view)
    }

    /// A view of a study that has no rows yet.
    ///
    /// # Errors
    ///
    /// If the study has no axis.
    pub fn of(study: Study, name: &str) -> Result<Self, Refusal> {
        Ok(Self {
            slice: Slice::new(study, name)?,
            name: name.to_owned(),
            column: 0,
            with_overlays: true,
            is_flipped: false,
            borders: RefCell::default(),
            notice: None,
        })
    }

    /// Takes the row of a point.
    pub fn put(&mut self, point: usize, fields: Vec<String>) {
        self.slice.rows[point] = Some(fields);
    }

    /// Takes the rows of a newer table of the same study.
    ///
    /// # Errors
    ///
    /// If rows do not belong to the study.
    pub fn renew(&mut self, record: Record) -> Result<(), Refusal> {
        self.slice.renew(record, &self.name)
    }

    /// Answers a key.
    pub fn press(&mut self, key: Key) -> Option<Leave> {
        self.notice = None;
        match key {
            Key::Char('q') | Key::Ctrl('c') | Key::Named(Named::Esc) => return Some(Leave::Quit),
            Key::Named(Named::Enter) => return Some(Leave::Open(self.point())),
            Key::Char('l') | Key::Named(Named::Right) => self.move_by(self.slice.x, 1),
            Key::Char('h') | Key::Named(Named::Left) => self.move_by(self.slice.x, -1),
            Key::Char('k') | Key::Named(Named::Up) => self.move_up(1),
            Key::Char('j') | Key::Named(Named::Down) => self.move_up(-1),
            Key::Named(Named::Home) => self.move_by(self.slice.x, isize::MIN / 2),
            Key::Named(Named::End) => self.move_by(self.slice.x, isize::MAX / 2),
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
        None
    }

    fn columns(&self) -> usize {
        self.slice.study.columns.len().max(1)
    }

    fn move_by(&mut self, axis: usize, by: isize) {
        let last = self.slice.study.axes[axis].count() - 1;
        let place = self.slice.at[axis].saturating_add_signed(by).min(last);
        if self.slice.study.design == Design::Grid {
            self.slice.at[axis] = place;
        } else {
            self.slice.at.fill(place);
        }
    }

    fn move_up(&mut self, by: isize) {
        if let Some(y) = self.slice.y {
            self.move_by(y, by);
        }
    }

    /// Shows the next axis horizontally; if it was the vertical one, the two are swapped.
    fn turn_x(&mut self) {
        let before = self.slice.x;
        self.slice.x = (self.slice.x + 1) % self.slice.study.axes.len();
        if self.slice.y == Some(self.slice.x) {
            self.slice.y = Some(before);
        }
    }

    fn turn_y(&mut self) {
        let axes = self.slice.study.axes.len();
        if let Some(y) = self.slice.y {
            let next = (1..axes)
                .map(|by| (y + by) % axes)
                .find(|next| *next != self.slice.x);
            self.slice.y = next.or(Some(y));
        }
    }

    /// Moves along the axes that are not shown, the last of them fastest.
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

    /// The cursor's places on the axes to the right and upwards.
    pub fn cursor(&self) -> (usize, usize) {
        (
            self.slice.at[self.slice.x],
            self.slice.y.map_or(0, |y| self.slice.at[y]),
        )
    }

    /// The name of the column; empty if the study has none.
    pub fn column(&self) -> &'static str {
        self.slice
            .study
            .columns
            .get(self.column)
            .map_or("", |column| column.name)
    }

    /// The point under the cursor.
    pub fn point(&self) -> usize {
        let (x, y) = self.cursor();
        self.slice.point_at(x, y)
    }

    /// The number of rows, of those that failed, and of points.
    pub fn count(&self) -> (usize, usize, usize) {
        let (there, failed) = self.slice.count();
        (there, failed, self.slice.study.points())
    }

    /// Whether the column holds words.
    pub fn is_regime(&self) -> bool {
        self.column() == "regime"
    }

    /// Returns the column in words with its range, from one pass over the points that are shown.
    pub fn scaled(&self) -> Scaled {
        let numbers = self.slice.points();
        let numbers: Vec<f64> = numbers
            .filter_map(|point| self.slice.number(point, self.column()))
            .collect();
        let mut quantity = study::quantity(self.column(), &numbers);
        if self.is_flipped {
            quantity.scale = match quantity.scale {
                Scale::Linear => Scale::Log,
                Scale::Log => Scale::Linear,
            };
        }
        let shown = numbers.into_iter();
        let shown = shown.filter(|number| quantity.scale == Scale::Linear || *number > 0.0);
        let range = shown.fold(None, |range: Option<[f64; 2]>, number| {
            let [low, high] = range.unwrap_or([number; 2]);
            Some([low.min(number), high.max(number)])
        });
        Scaled { quantity, range }
    }

    /// An axis in words, with its unit.
    pub fn in_words(&self, axis: &Axis) -> plot::Axis {
        study::paper_axis(&self.slice, axis)
    }

    /// The places of the base scenario on the axes that are shown, where they are on the map.
    pub fn here(&self) -> Option<(f64, f64)> {
        let place = |axis: &Axis| {
            let value = self.slice.study.base.value(&axis.key)?;
            axis.place_of(value.parse().ok()?)
        };
        let y = match self.slice.y() {
            Some(axis) => place(axis)?,
            None => 0.0,
        };
        Some((place(self.slice.x())?, y))
    }

    /// What a point shows of the column.
    pub fn shade(&self, point: usize, scaled: &Scaled) -> Shade {
        if self.slice.row(point).is_none() {
            return Shade::Waiting;
        }
        if self.is_regime() {
            return self.slice.regime(point).map_or(Shade::Failed, Shade::Word);
        }
        let (Some(number), Some([low, high])) =
            (self.slice.number(point, self.column()), scaled.range)
        else {
            return Shade::Failed;
        };
        let of = |value: f64| scaled.quantity.scale.spread(value);
        match (of(number) - of(low)) / (of(high) - of(low)) {
            share if share.is_finite() => Shade::Share(share.clamp(0.0, 1.0)),
            _ if number == low => Shade::Share(0.5),
            _ => Shade::Failed,
        }
    }

    /// Borders in closed form and criteria of the field, where the study has their columns.
    pub fn overlays(&self) -> Vec<Line> {
        if self.slice.y.is_none() || !self.with_overlays {
            return Vec::new();
        }
        let mut overlays = self.slice.criteria();
        // What holds for any shape is drawn last, and seen.
        overlays.extend(self.borders());
        overlays
    }

    /// The closed forms: computed once for the places of the axes that are not shown.
    fn borders(&self) -> Vec<Line> {
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
