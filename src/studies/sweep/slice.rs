//! The table of a study along one or two of its axes, as shown in a map, on the screen and on paper.

use super::border::{Distance, crossing, to_gross_slip, to_lift_off};
use super::finder::Finder;
use super::record::Record;
use super::{Design, Study, StudyAxis, Success};
use crate::reading::{Column, Regime};
use crate::scenario::Refusal;

/// The field's criteria that can be laid over a map: column, value, and name with what it holds for.
const CRITERIA: [(Column, f64, &str); 5] = [
    (
        Column::EnergyRatio,
        0.2,
        "A = 0.2 (unworn sphere, stiff rig only)",
    ),
    (
        Column::SlidingRatio,
        0.26,
        "D = 0.26 (unworn sphere, stiff rig only)",
    ),
    (Column::EnergyRatioB, 0.77, "B = 0.77 (sphere, any rig)"),
    (Column::SwtRatio, 1.0, "SWT at the fatigue limit"),
    (
        Column::CrosslandRatio,
        1.0,
        "Crossland at the fatigue limit",
    ),
];

/// A line on a map, as places on its axes: 1.5 lies halfway between the second and the third value.
#[derive(Debug, Clone, PartialEq)]
pub struct Contour {
    /// Its name.
    pub name: &'static str,
    /// Places on the x and y axes where it crosses columns and rows of the map, from left to right.
    pub at: Vec<[f64; 2]>,
}

impl Contour {
    fn new(name: &'static str, mut at: Vec<[f64; 2]>) -> Option<Self> {
        at.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        (at.len() > 1).then_some(Self { name, at })
    }

    /// Returns the letter that marks it on a map: the first of its name.
    pub fn letter(&self) -> char {
        let first = self.name.chars().next().unwrap_or(' ');
        first.to_ascii_uppercase()
    }

    /// Returns its parts; a part ends at a column that the line does not cross.
    pub fn parts(&self) -> impl Iterator<Item = &[[f64; 2]]> {
        let parts = self.at.chunk_by(|from, to| to[0] - from[0] <= 1.0);
        parts.filter(|part| part.len() > 1)
    }
}

/// A study with its rows, and the axes shown.
#[derive(Debug)]
pub struct Slice {
    /// The study.
    pub study: Study,
    /// The fields of each point; `None` while it has no row.
    pub rows: Vec<Option<Vec<String>>>,
    /// The axis to the right.
    pub x: usize,
    /// The axis upwards; `None` if there is only one axis, or no grid.
    pub y: Option<usize>,
    /// A place on each axis, or without a grid the same point on all. On the axes shown, these are a cursor's places.
    pub at: Vec<usize>,
    held: Vec<usize>,
}

impl Slice {
    /// Shows the first and the last axis of a study without rows, with the other axes at their first places.
    ///
    /// # Errors
    ///
    /// If the study, called `name` in messages, has no axis.
    pub fn new(study: Study, name: &str) -> Result<Self, Refusal> {
        if study.axes.is_empty() {
            return Err(Refusal::new(name, "there is no axis to show"));
        }
        let is_grid = study.design == Design::Grid;
        Ok(Self {
            x: if is_grid { study.axes.len() - 1 } else { 0 },
            y: (is_grid && study.axes.len() > 1).then_some(0),
            at: vec![0; study.axes.len()],
            rows: vec![None; study.points()],
            held: Vec::new(),
            study,
        })
    }

    /// Reads the rows of a table of the same study, called `name` in messages.
    ///
    /// # Errors
    ///
    /// If rows do not belong to the study.
    pub fn renew(&mut self, record: Record, name: &str) -> Result<(), Refusal> {
        let finder = Finder::new(&self.study);
        let mut rows = vec![None; self.study.points()];
        for row in record.rows(&self.study)? {
            let row = row?;
            let mut points = finder.points_of(&self.study, &row).into_iter();
            let Some(free) = points.find(|&point| rows[point].is_none()) else {
                let rule = format!("row {} does not belong to the study", row.join(","));
                return Err(Refusal::new(name, rule));
            };
            rows[free] = Some(row);
        }
        self.rows = rows;
        Ok(())
    }

    /// Returns the number of rows, and how many of them failed.
    pub fn count(&self) -> (usize, usize) {
        let rows = || self.rows.iter().flatten();
        let failed = rows().filter(|row| !Success::from_row(row).has_result());
        (rows().count(), failed.count())
    }

    /// Holds the axis `key` at one of its values, and shows the last and the first axis that are not held.
    ///
    /// # Errors
    ///
    /// In one line, if `key` is not an axis, the axis does not have that value, or no axis is left to show.
    pub fn fix_axis(&mut self, key: &str, value: &str) -> Result<(), String> {
        if self.study.design != Design::Grid {
            return Err("only a grid has axes to hold".into());
        }
        let axes = &self.study.axes;
        let Some(held) = axes.iter().position(|axis| axis.key == key) else {
            let keys: Vec<&str> = axes.iter().map(|axis| axis.key.as_str()).collect();
            return Err(format!("the axes are {}", keys.join(", ")));
        };
        let axis = &axes[held];
        let wanted = value.parse::<f64>().ok();
        let is_wanted = |place: &usize| match (axis.number(*place), wanted) {
            (Some(number), Some(wanted)) => (number - wanted).abs() <= 1e-9 * number.abs(),
            _ => axis.text(*place) == value,
        };
        let Some(place) = (0..axis.count()).find(is_wanted) else {
            let values: Vec<String> = (0..axis.count()).map(|place| axis.text(place)).collect();
            return Err(format!("must be one of {}", values.join(", ")));
        };
        self.at[held] = place;
        self.held.push(held);
        let mut free = (0..axes.len()).filter(|axis| !self.held.contains(axis));
        let first = free.next().ok_or("no axis is left to draw over")?;
        let last = free.next_back();
        (self.x, self.y) = (last.unwrap_or(first), last.map(|_| first));
        Ok(())
    }

    /// Returns the axis to the right.
    pub fn x(&self) -> &StudyAxis {
        &self.study.axes[self.x]
    }

    /// Returns the axis upwards.
    pub fn y(&self) -> Option<&StudyAxis> {
        self.y.map(|y| &self.study.axes[y])
    }

    /// Returns the axes that are not shown.
    pub fn hidden(&self) -> impl Iterator<Item = usize> {
        let grid = self.study.design == Design::Grid;
        (0..self.study.axes.len())
            .filter(move |axis| grid && *axis != self.x && Some(*axis) != self.y)
    }

    /// Returns the numbers of places to the right and upwards.
    pub fn size(&self) -> [usize; 2] {
        let high = self.y().map_or(1, |axis| axis.count());
        [self.x().count(), high]
    }

    /// Returns the point at a place to the right and upwards.
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
        axes.fold(0, |point, (axis, place)| point * axis.count() + place)
    }

    /// Returns the points shown, row by row.
    pub fn points(&self) -> impl Iterator<Item = usize> {
        let [wide, high] = self.size();
        (0..high).flat_map(move |y| (0..wide).map(move |x| self.point_at(x, y)))
    }

    /// Returns the row of a point.
    pub fn row(&self, point: usize) -> Option<&Vec<String>> {
        self.rows[point].as_ref()
    }

    /// The field of `column` of a point; `None` without a row, or where the point failed.
    pub fn field(&self, point: usize, column: Column) -> Option<&str> {
        let row = self.row(point)?;
        let mut columns = self.study.columns.iter();
        let at = columns.position(|known| *known == column)?;
        let field = row.get(self.study.axes.len() + at)?;
        (Success::from_row(row).has_result() && !field.is_empty()).then_some(field)
    }

    /// The number in `column` of a point.
    pub fn number(&self, point: usize, column: Column) -> Option<f64> {
        let number: f64 = self.field(point, column)?.parse().ok()?;
        number.is_finite().then_some(number)
    }

    /// Returns the regime of a point.
    pub fn regime(&self, point: usize) -> Option<Regime> {
        self.field(point, Column::Regime)?.parse().ok()
    }

    /// Draws the published criteria whose columns the study has, between neighbouring points of the map.
    pub fn criteria(&self) -> Vec<Contour> {
        let [wide, high] = self.size();
        let line = |(column, value, name): (Column, f64, &'static str)| {
            let off = |x: usize, y: usize| {
                let inside = x < wide && y < high;
                let number = inside.then(|| self.number(self.point_at(x, y), column));
                Some(number?? - value)
            };
            let share = |here: f64, there: f64| (here * there < 0.0).then(|| here / (here - there));
            let points = (0..wide).flat_map(|x| (0..high).map(move |y| (x, y)));
            let crossed = points.flat_map(|(x, y)| {
                let part = |there: Option<f64>| share(off(x, y)?, there?);
                let [column, row] = [x as f64, y as f64];
                let up = part(off(x, y + 1)).map(|part| [column, row + part]);
                let right = part(off(x + 1, y)).map(|part| [column + part, row]);
                [up, right].into_iter().flatten()
            });
            Contour::new(name, crossed.collect())
        };
        CRITERIA.into_iter().filter_map(line).collect()
    }

    /// Returns the borders in closed form.
    pub fn borders(&self) -> Vec<Contour> {
        let Some(y) = self.y else {
            return Vec::new();
        };
        let [wide, high] = self.size();
        let line = |to_border: Distance| {
            // Crosses the border along one axis, with the other one at a place.
            let crossed = |along: usize, other: usize, place: usize| {
                let mut places = self.at.clone();
                places[other] = place;
                let value = crossing(to_border, &self.study, &places, along)?;
                self.study.axes[along].place_of(value)
            };
            let columns = (0..wide).filter_map(|at| Some([at as f64, crossed(y, self.x, at)?]));
            let rows = (0..high).filter_map(|at| Some([crossed(self.x, y, at)?, at as f64]));
            columns.chain(rows).collect()
        };
        let gross = Contour::new("gross slip, closed form, unworn", line(to_gross_slip));
        let open = Contour::new("lift-off, closed form, unworn", line(to_lift_off));
        gross.into_iter().chain(open).collect()
    }
}
