//! The view of a study: axes, column and cursor.

use std::cell::RefCell;
use std::collections::HashMap;

use super::ramp::{REGIMES, Shade};
use crate::studies::sweep::border::Border;
use crate::studies::sweep::record::{Record, Rows};
use crate::studies::sweep::{Axis, Design, OK, Study, StudyError};
use crate::tui::keys::{Key, Named};

/// How the view is left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Leave {
    /// For good.
    Quit,
    /// To open this point in the explorer.
    Open(usize),
}

/// The criteria of the field that can be laid over: column, value, letter, and what it holds for.
pub const CRITERIA: [(&str, f64, char, &str); 3] = [
    (
        "energy_ratio",
        0.2,
        'A',
        "A = 0.2 (unworn sphere, stiff rig only)",
    ),
    (
        "sliding_ratio",
        0.26,
        'D',
        "D = 0.26 (unworn sphere, stiff rig only)",
    ),
    ("energy_ratio_B", 0.77, 'B', "B = 0.77 (sphere, any rig)"),
];

/// A line over the map: for each position on the x axis that it crosses, its position on the y
/// axis, in units of the point spacing.
#[derive(Debug, Clone, PartialEq)]
pub struct Overlay {
    /// The letter that draws it.
    pub letter: char,
    /// What it is.
    pub name: String,
    /// Place on x, and on y.
    pub at: Vec<(usize, f64)>,
}

/// A study, and what of it is shown.
#[derive(Debug)]
pub struct View {
    study: Study,
    rows: Rows,
    /// The title.
    name: String,
    /// The axis that runs to the right.
    x: usize,
    /// The axis that runs upwards; `None` where there is one axis, or no grid.
    y: Option<usize>,
    /// Which of the columns.
    column: usize,
    /// The cursor: a place on each axis, or the same point on all without a grid.
    at: Vec<usize>,
    /// Whether borders and criteria are drawn.
    pub with_overlays: bool,
    /// Whether the range of the column is logarithmic.
    pub logarithmic: bool,
    borders: RefCell<HashMap<Vec<usize>, Vec<Overlay>>>,
}

impl View {
    /// A view of a table.
    ///
    /// # Errors
    ///
    /// If the header of the table has no study, or rows do not belong to it.
    pub fn new(record: Record, name: &str) -> Result<Self, StudyError> {
        let mut view = Self::of(record.study()?, name)?;
        view.renew(record)?;
        Ok(view)
    }

    /// A view of a study that has no rows yet.
    ///
    /// # Errors
    ///
    /// If the study has no axis.
    pub fn of(study: Study, name: &str) -> Result<Self, StudyError> {
        if study.axes.is_empty() {
            return Err(StudyError(format!("{name}: there is no axis to show")));
        }
        let is_grid = study.design == Design::Grid;
        let x = if is_grid { study.axes.len() - 1 } else { 0 };
        let y = (is_grid && study.axes.len() > 1).then_some(0);
        Ok(Self {
            at: vec![0; study.axes.len()],
            rows: Rows::new(&study),
            study,
            name: name.to_owned(),
            x,
            y,
            column: 0,
            with_overlays: true,
            logarithmic: false,
            borders: RefCell::default(),
        })
    }

    /// Takes the row of a point.
    pub fn put(&mut self, point: usize, fields: Vec<String>) {
        self.rows.put(point, fields);
    }

    /// Takes the rows of a newer table of the same study.
    ///
    /// # Errors
    ///
    /// If rows do not belong to the study.
    pub fn renew(&mut self, record: Record) -> Result<(), StudyError> {
        let mut rows = Rows::new(&self.study);
        for row in record.rows {
            let named = row.join(",");
            if let Err(why) = rows.take(row) {
                let name = &self.name;
                return Err(StudyError(format!(
                    "{name}: row {named} does not belong to the study ({why:?})"
                )));
            }
        }
        self.rows = rows;
        Ok(())
    }

    /// Answers a key.
    pub fn press(&mut self, key: Key) -> Option<Leave> {
        match key {
            Key::Char('q') | Key::Ctrl('c') | Key::Named(Named::Esc) => return Some(Leave::Quit),
            Key::Named(Named::Enter) => return Some(Leave::Open(self.point())),
            Key::Char('l') | Key::Named(Named::Right) => self.move_by(self.x, 1),
            Key::Char('h') | Key::Named(Named::Left) => self.move_by(self.x, -1),
            Key::Char('k') | Key::Named(Named::Up) => self.move_up(1),
            Key::Char('j') | Key::Named(Named::Down) => self.move_up(-1),
            Key::Named(Named::Home) => self.move_by(self.x, isize::MIN / 2),
            Key::Named(Named::End) => self.move_by(self.x, isize::MAX / 2),
            Key::Named(Named::Tab) => self.column = (self.column + 1) % self.columns(),
            Key::Named(Named::BackTab) => {
                self.column = (self.column + self.columns() - 1) % self.columns();
            }
            Key::Char('t') => self.with_overlays = !self.with_overlays,
            Key::Char('L') => self.logarithmic = !self.logarithmic,
            Key::Char('x') => self.turn_x(),
            Key::Char('y') => self.turn_y(),
            Key::Char(']') => self.move_others(1),
            Key::Char('[') => self.move_others(-1),
            _ => {}
        }
        None
    }

    fn columns(&self) -> usize {
        self.study.columns.len().max(1)
    }

    fn move_by(&mut self, axis: usize, by: isize) {
        let last = self.study.axes[axis].values.len() - 1;
        let place = self.at[axis].saturating_add_signed(by).min(last);
        if self.study.design == Design::Grid {
            self.at[axis] = place;
        } else {
            self.at.fill(place);
        }
    }

    fn move_up(&mut self, by: isize) {
        if let Some(y) = self.y {
            self.move_by(y, by);
        }
    }

    /// Shows the next axis horizontally; if it was the vertical one, the two are swapped.
    fn turn_x(&mut self) {
        let before = self.x;
        self.x = (self.x + 1) % self.study.axes.len();
        if self.y == Some(self.x) {
            self.y = Some(before);
        }
    }

    fn turn_y(&mut self) {
        let axes = self.study.axes.len();
        if let Some(y) = self.y {
            let next = (1..axes)
                .map(|by| (y + by) % axes)
                .find(|next| *next != self.x);
            self.y = next.or(Some(y));
        }
    }

    /// Moves along the axes that are not shown, the last of them fastest.
    fn move_others(&mut self, by: isize) {
        let hidden: Vec<usize> = self.hidden().collect();
        for axis in hidden.into_iter().rev() {
            let length = self.study.axes[axis].values.len() as isize;
            let place = self.at[axis] as isize + by;
            self.at[axis] = place.rem_euclid(length) as usize;
            if (0..length).contains(&place) {
                return;
            }
        }
    }

    /// The axes that are not shown.
    pub fn hidden(&self) -> impl Iterator<Item = usize> {
        let grid = self.study.design == Design::Grid;
        (0..self.study.axes.len())
            .filter(move |axis| grid && *axis != self.x && Some(*axis) != self.y)
    }

    /// The study.
    pub fn study(&self) -> &Study {
        &self.study
    }

    /// The title.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The axis to the right.
    pub fn x(&self) -> &Axis {
        &self.study.axes[self.x]
    }

    /// The axis upwards.
    pub fn y(&self) -> Option<&Axis> {
        self.y.map(|y| &self.study.axes[y])
    }

    /// The cursor's places on the axes to the right and upwards.
    pub fn cursor(&self) -> (usize, usize) {
        (self.at[self.x], self.y.map_or(0, |y| self.at[y]))
    }

    /// The place of the cursor on an axis.
    pub fn place(&self, axis: usize) -> usize {
        self.at[axis]
    }

    /// The name of the column; empty if the study has none.
    pub fn column(&self) -> &'static str {
        self.study
            .columns
            .get(self.column)
            .map_or("", |column| column.name)
    }

    /// The point under the cursor.
    pub fn point(&self) -> usize {
        let (x, y) = self.cursor();
        self.point_at(x, y)
    }

    /// The point at a place to the right and upwards.
    pub fn point_at(&self, x: usize, y: usize) -> usize {
        if self.study.design != Design::Grid {
            return x;
        }
        let mut at = self.at.clone();
        at[self.x] = x;
        if let Some(axis) = self.y {
            at[axis] = y;
        }
        let axes = self.study.axes.iter().zip(at);
        axes.fold(0, |point, (axis, place)| point * axis.values.len() + place)
    }

    /// The row of a point.
    pub fn row(&self, point: usize) -> Option<&Vec<String>> {
        self.rows.rows[point].as_ref()
    }

    /// The number of rows, of those that failed, and of points.
    pub fn count(&self) -> (usize, usize, usize) {
        let (there, failed) = self.rows.count();
        (there, failed, self.study.points())
    }

    /// The field of `column` of a point; `None` without a row, or where the point failed.
    pub fn field(&self, point: usize, column: &str) -> Option<&str> {
        let row = self.row(point)?;
        let at = self
            .study
            .columns
            .iter()
            .position(|known| known.name == column)?;
        let is_ok = row.last().is_some_and(|status| status == OK);
        let field = row.get(self.study.axes.len() + at)?;
        (is_ok && !field.is_empty()).then_some(field)
    }

    /// The number in `column` of a point.
    pub fn number(&self, point: usize, column: &str) -> Option<f64> {
        let number: f64 = self.field(point, column)?.parse().ok()?;
        number.is_finite().then_some(number)
    }

    /// Whether the column holds words.
    pub fn is_regime(&self) -> bool {
        self.column() == "regime"
    }

    /// The smallest and the largest number of the column over the points that are shown; positive
    /// ones alone where the range is logarithmic.
    pub fn range(&self) -> Option<[f64; 2]> {
        let (wide, high) = (
            self.x().values.len(),
            self.y().map_or(1, |y| y.values.len()),
        );
        let points = (0..wide).flat_map(|x| (0..high).map(move |y| (x, y)));
        points
            .filter_map(|(x, y)| self.number(self.point_at(x, y), self.column()))
            .filter(|number| !self.logarithmic || *number > 0.0)
            .fold(None, |range: Option<[f64; 2]>, number| {
                let [low, high] = range.unwrap_or([number; 2]);
                Some([low.min(number), high.max(number)])
            })
    }

    /// What a point shows of the column, whose `range` is known.
    pub fn shade(&self, point: usize, range: Option<[f64; 2]>) -> Shade {
        if self.row(point).is_none() {
            return Shade::Waiting;
        }
        if self.is_regime() {
            let word = self.field(point, "regime");
            let at = word.and_then(|word| REGIMES.iter().position(|known| known.0 == word));
            return at.map_or(Shade::Failed, Shade::Word);
        }
        let (Some(number), Some([low, high])) = (self.number(point, self.column()), range) else {
            return Shade::Failed;
        };
        let of = |value: f64| if self.logarithmic { value.ln() } else { value };
        match (of(number) - of(low)) / (of(high) - of(low)) {
            share if share.is_finite() => Shade::Share(share.clamp(0.0, 1.0)),
            _ if number == low => Shade::Share(0.5),
            _ => Shade::Failed,
        }
    }

    /// Borders in closed form and criteria of the field, where the study has their columns.
    pub fn overlays(&self) -> Vec<Overlay> {
        let Some(y) = self.y.filter(|_| self.with_overlays) else {
            return Vec::new();
        };
        let mut overlays = Vec::new();
        for (column, value, letter, name) in CRITERIA {
            let at: Vec<_> = (0..self.x().values.len())
                .flat_map(|x| self.crossings(x, column, value).map(move |y| (x, y)))
                .collect();
            if !at.is_empty() {
                overlays.push(Overlay {
                    letter,
                    name: name.to_owned(),
                    at,
                });
            }
        }
        // What holds for any shape is drawn last, and seen.
        overlays.extend(self.borders(y));
        overlays
    }

    /// The closed forms: computed once for the places of the axes that are not shown.
    fn borders(&self, y: usize) -> Vec<Overlay> {
        let mut key = self.at.clone();
        (key[self.x], key[y]) = (0, 0);
        key.extend([self.x, y]);
        if let Some(known) = self.borders.borrow().get(&key) {
            return known.clone();
        }
        let axis = &self.study.axes[y];
        let mut found = Vec::new();
        for border in Border::ALL {
            let at: Vec<_> = (0..self.x().values.len())
                .filter_map(|place| {
                    let mut places = self.at.clone();
                    places[self.x] = place;
                    let value = border.crossing(&self.study, &places, y)?;
                    Some((place, axis.place_of(value)?))
                })
                .collect();
            if !at.is_empty() {
                let letter = if border == Border::GrossSlip {
                    'G'
                } else {
                    'L'
                };
                let name = format!("{}, closed form, unworn", border.name());
                found.push(Overlay { letter, name, at });
            }
        }
        self.borders.borrow_mut().insert(key, found.clone());
        found
    }

    /// Where `column` passes through `value` above place `x`, between neighbouring points.
    fn crossings(&self, x: usize, column: &str, value: f64) -> impl Iterator<Item = f64> {
        let high = self.y().map_or(1, |y| y.values.len());
        let numbers: Vec<Option<f64>> = (0..high)
            .map(|y| self.number(self.point_at(x, y), column))
            .collect();
        (1..high).filter_map(move |y| {
            let (below, above) = (numbers[y - 1]? - value, numbers[y]? - value);
            (below * above < 0.0).then(|| (y - 1) as f64 + below / (below - above))
        })
    }
}
