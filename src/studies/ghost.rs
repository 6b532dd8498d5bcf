//! Curves to draw over a simulation's: measurements, the files of a run, or a frozen state.

use std::path::Path;
use std::sync::Arc;

use super::measured::{DataKind, Measured, Strokes, check_radii};
use crate::math::scan::value_at;
use crate::reading::Column;
use crate::scenario::columns::{Columns, Naming};
use crate::scenario::{Refusal, printable};
use crate::traces::{Axes, Loop, Table};

/// One curve of a source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trace<'a> {
    /// Abscissae.
    pub xs: &'a [f64],
    /// Ordinates; NaN is a gap.
    pub ys: &'a [f64],
    /// Standard errors of the ordinates, if known.
    pub errors: Option<&'a [f64]>,
}

impl Trace<'_> {
    /// Returns the ordinate at `x`, interpolated between neighbouring points; `None` outside.
    pub fn value_at(&self, x: f64) -> Option<f64> {
        value_at(self.xs, self.ys, x)
    }

    /// Returns the force of a loop at a displacement on one of its strokes; `None` beyond its ends.
    pub fn force_at(&self, displacement: f64, rising: bool) -> Option<f64> {
        let points = self.xs.iter().copied().zip(self.ys.iter().copied());
        let points = points.filter(|(shift, force)| shift.is_finite() && force.is_finite());
        let strokes = Strokes::new(&points.collect::<Vec<_>>())?;
        let [least, most] = strokes.ends;
        let is_within = (least..=most).contains(&displacement);
        is_within.then(|| strokes.force(displacement, rising))
    }
}

/// Worn depth over the radius.
#[derive(Debug, Clone, PartialEq)]
pub struct WornProfile {
    /// r, m.
    pub radii: Vec<f64>,
    /// f₀ there, m.
    pub unworn: Vec<f64>,
    /// f − f₀, m.
    pub wear: Vec<f64>,
    /// Standard errors of f or f − f₀, m.
    pub errors: Option<Vec<f64>>,
}

/// Columns of one source.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ghost {
    /// Name in legends.
    pub name: String,
    /// Whether the values were measured, so that nothing is known between the points.
    pub is_measured: bool,
    /// The data it contains.
    pub tables: Vec<Arc<Table>>,
}

impl Ghost {
    /// Makes an empty ghost.
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            ..Self::default()
        }
    }

    /// Reads measured data, whose columns `naming` may name, or a table of a run from a CSV file, or all tables of a run's
    /// directory.
    ///
    /// # Errors
    /// One line: what cannot be read, holds nothing that could be drawn, or is refused as measured data.
    pub fn read(path: &Path, naming: &Naming) -> Result<Self, Refusal> {
        let name = path.file_name().unwrap_or(path.as_os_str());
        let name = printable(&name.to_string_lossy());
        if !path.is_dir() {
            return Self::of_columns(&name, &Columns::read_as(path, naming)?);
        }
        let mut ghost = Self::new(&name);
        // The loop of a snapshot is in its own file.
        for file in ["state.csv", "history.csv", "loop.csv"] {
            let file = path.join(file);
            if file.is_file() {
                let columns = Columns::read(&file)?;
                ghost.add_table(Table::of_file(&columns));
            }
        }
        if ghost.tables.is_empty() {
            let path = printable(&path.display().to_string());
            let rule = "holds no state.csv and no history.csv of a run";
            return Err(Refusal::new(path, rule));
        }
        Ok(ghost)
    }

    /// Makes a ghost from columns: a state or a history of this program, or else measured data.
    ///
    /// # Errors
    /// If the columns contain nothing to draw, or for gaps and other faults of measured data.
    pub fn of_columns(name: &str, columns: &Columns) -> Result<Self, Refusal> {
        let mut ghost = Self::new(name);
        let has = |column: Column| columns.has(column);
        if [Column::Unworn, Column::Indentation, Column::ScarDepth]
            .into_iter()
            .any(has)
        {
            ghost.add_table(Table::of_file(columns));
        } else {
            ghost.is_measured = true;
            match DataKind::detect(columns) {
                Some(DataKind::Scar | DataKind::Map) => {
                    ghost.add_measured(Measured::scar(columns)?)
                }
                Some(DataKind::Loop) => ghost.add_measured(Measured::fretting_loop(columns, None)?),
                Some(DataKind::History) => ghost.add_measured(Measured::history(columns, None)?),
                None => {}
            }
        }
        if ghost.tables.is_empty() {
            Err(columns.refuse(format!(
                "has nothing to draw: needs r_m with wear_m or f_m, u_m with F_N, or cycle with \
             wear_volume_m3 or depth_m; the first line names {}",
                columns.list_names()
            )))
        } else {
            Ok(ghost)
        }
    }

    /// Returns the curve of these columns, if it has a finite value.
    pub fn trace(&self, axes: Axes) -> Option<Trace<'_>> {
        let mut traces = self.tables.iter().filter_map(|table| {
            Some(Trace {
                xs: table.column(axes.x)?,
                ys: table.column(axes.y)?,
                errors: table.column(Column::StandardError),
            })
        });
        let is_there = |trace: &Trace| trace.ys.iter().any(|value| value.is_finite());
        traces.find(is_there)
    }

    /// Returns its worn depth: from its own curve, or as its profile minus `unworn`, m at r; `None` if it has neither.
    pub fn worn(&self, unworn: impl Fn(f64) -> f64) -> Option<WornProfile> {
        let (profile, wear) = (self.trace(Axes::PROFILE), self.trace(Axes::WEAR));
        let trace = wear.or(profile)?;
        let less = |f: &[f64], other: &[f64]| f.iter().zip(other).map(|(f, g)| f - g).collect();
        let unworn: Vec<f64> = match (profile, wear) {
            (Some(profile), Some(wear)) => less(profile.ys, wear.ys),
            _ => trace.xs.iter().map(|&r| unworn(r)).collect(),
        };
        let wear = match wear {
            Some(wear) => wear.ys.to_vec(),
            None => less(trace.ys, &unworn),
        };
        Some(WornProfile {
            radii: trace.xs.to_vec(),
            unworn,
            wear,
            errors: trace.errors.map(<[f64]>::to_vec),
        })
    }

    /// Returns the last cycle of its histories.
    pub fn end(&self) -> f64 {
        let tables = self.tables.iter();
        let histories = tables.filter(|table| table.column(Column::Radius).is_none());
        histories
            .filter_map(|table| table.last_cycle())
            .fold(0.0, f64::max)
    }

    /// Checks whether its radii and the `reach` of the contact, m,
    /// differ so much that one of them must be in another unit.
    ///
    /// # Errors
    /// A line that names both.
    pub fn check_radii(&self, reach: f64) -> Result<(), Refusal> {
        let over_r = [Axes::PROFILE, Axes::WEAR];
        let mut traces = over_r.into_iter().filter_map(|axes| self.trace(axes));
        traces.try_for_each(|trace| check_radii(&self.name, trace.xs, reach))
    }

    /// Adds a closed loop: u, m, and F, N.
    pub fn add_loop(&mut self, shifts: Vec<f64>, forces: Vec<f64>) {
        if shifts.len() >= Loop::SHORTEST {
            self.add(Axes::LOOP, shifts, forces, None);
        }
    }

    /// Adds one of this program's own tables, and the loop of its last cycle, if any.
    pub fn add_table(&mut self, table: Table) {
        if let Some(one) = Loop::from_table(&table, table.last_cycle()) {
            self.add_loop(one.shifts, one.forces);
        }
        self.tables.push(table.into());
    }

    fn add_measured(&mut self, mut measured: Measured) {
        if measured.axes.over_r() {
            measured.at.iter_mut().for_each(|r| *r = r.abs());
        }
        self.add(measured.axes, measured.at, measured.values, measured.errors);
    }

    fn add(&mut self, axes: Axes, xs: Vec<f64>, ys: Vec<f64>, errors: Option<Vec<f64>>) {
        let errors = errors.map(|errors| (Column::StandardError, errors));
        let columns = [(axes.x, xs), (axes.y, ys)].into_iter().chain(errors);
        let table = Table::of_columns(Vec::new(), columns);
        self.tables.push(table.into());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ghost(text: &str) -> Result<Ghost, Refusal> {
        Ghost::of_columns("data.csv", &Columns::parse(text, "data.csv")?)
    }

    #[test]
    fn columns_tell_what_a_table_is() {
        let all = [
            Axes::PROFILE,
            Axes::WEAR,
            Axes::PRESSURE,
            Axes::VOLUME,
            Axes::DEPTH,
            Axes::STICK,
        ];
        let axes = |text: &str| -> Vec<Axes> {
            let ghost = ghost(text).expect("a ghost");
            let is_there = |axes: &Axes| ghost.trace(*axes).is_some();
            all.into_iter().filter(is_there).collect()
        };
        assert_eq!(axes("r_um,wear_nm\n0,3\n1,2\n2,1\n"), [Axes::WEAR]);
        assert_eq!(axes("r_m,f_m\n0,0\n1,1\n2,4\n"), [Axes::PROFILE]);
        assert_eq!(axes("cycle,depth_um\n0,0\n1,1\n2,4\n"), [Axes::DEPTH]);
        assert_eq!(
            axes("r_m,f0_m,f_m,p_Pa,wear_m\n0,0,0,inf,0\n1,1,2,3,1\n"),
            [Axes::PROFILE, Axes::WEAR, Axes::PRESSURE]
        );
        assert_eq!(
            axes("cycle,u_z_m,wear_volume_m3,permanent_stick_radius_m\n0,0,0,\n1,1,2,\n"),
            [Axes::VOLUME]
        );
    }

    #[test]
    fn what_cannot_be_drawn_is_one_line() {
        for (text, part) in [
            ("a,b\n1,2\n", "has nothing to draw: needs r_m with wear_m"),
            ("r_m,q_m\n0,0\n1,1\n2,2\n", "has no column f_m"),
            (
                "r_m,wear_m\n0,0\n1,2x\n2,2\n",
                "line 3: wear_m = 2x: must be a finite number",
            ),
            ("r_m,wear_m\n0,0\n1,\n2,NaN\n", "fewer than 3 rows"),
        ] {
            let error = ghost(text).expect_err("a refusal").to_string();
            assert!(
                error.contains(part) && error.lines().count() == 1,
                "{error}"
            );
        }
        let scar = ghost("r_m,wear_m\n0,1\n0.05,0.5\n0.1,0\n").expect("a ghost");
        assert!(scar.check_radii(0.1).is_ok());
        let error = scar.check_radii(1e-4).expect_err("a refusal");
        assert!(error.to_string().ends_with("are they in m?"), "{error}");
    }

    #[test]
    fn values_are_read_between_points_and_not_beyond() {
        let mut ghost = Ghost::new("x");
        ghost.add(Axes::WEAR, vec![0.0, 1.0, 3.0], vec![2.0, 4.0, 0.0], None);
        let trace = ghost.trace(Axes::WEAR).expect("a trace");
        assert_eq!(trace.value_at(0.5), Some(3.0));
        assert_eq!(trace.value_at(2.0), Some(2.0));
        assert_eq!(trace.value_at(3.5), None);
        assert_eq!(ghost.trace(Axes::LOOP), None);
    }
}
