//! Measured results to compare with simulated ones: scars, fretting loops, histories.
//!
//! Instruments choose their zeros, signs and directions at will. What can be corrected without a model is corrected
//! here and noted; what needs one (zeros, centre, tilt) is fitted besides the keys.

use crate::math::scan::range;
use crate::reading::Column;
use crate::scenario::Refusal;
use crate::scenario::columns::Columns;
use crate::traces::Axes;
use record::{Cycle, Record};

mod map;
pub mod record;
mod strokes;
mod trace;

pub use record::Pick;
pub use strokes::{Strokes, rises};

/// Minimum rows of a data set.
const FEWEST: usize = 3;

/// Minimum rows of a loop.
const FEWEST_OF_LOOP: usize = 8;

/// A loop that leans this far to the left, by its correlation, has its force or its displacement with the other sign.
const LEANS_LEFT: f64 = -0.3;

/// What the rows of a file are, by its columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DataKind {
    /// Heights or depths over x and y.
    Map,
    /// A force over a displacement.
    Loop,
    /// A volume, a depth, an approach or a mass over cycles, time, distance or energy.
    History,
    /// A profile or what has worn of it, over the radius.
    Scar,
}

/// Abscissae of histories, in the order in which they are looked for.
pub const OVER: [Column; 4] = [
    Column::Cycle,
    Column::Energy,
    Column::Distance,
    Column::Time,
];

/// Ordinates of histories, with what they are called in [`Axes`].
const WORN: [(Column, Column); 4] = [
    (Column::Depth, Column::ScarDepth),
    (Column::WearVolume, Column::WearVolume),
    (Column::Approach, Column::Approach),
    (Column::Mass, Column::WearVolume),
];

impl DataKind {
    /// Determines the kind from the columns of a file; `None` if they are not measured data.
    pub fn detect(columns: &Columns) -> Option<Self> {
        let has = |column: Column| columns.has(column);
        let is_own_loop =
            has(Column::Shift) && has(Column::TangentialForce) && !has(Axes::VOLUME.y);
        if has(Column::X) && has(Column::Y) && (has(Column::Profile) || has(Column::Wear)) {
            Some(Self::Map)
        } else if is_own_loop || has(Axes::LOOP.x) && has(Axes::LOOP.y) {
            Some(Self::Loop)
        } else if OVER.into_iter().any(has) && WORN.iter().any(|(name, _)| has(*name)) {
            Some(Self::History)
        } else {
            has(Column::Radius).then_some(Self::Scar)
        }
    }
}

/// A data set.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Name of the file.
    pub name: String,
    /// What it contains: a profile, its worn part, a loop, or wear over the course of a test.
    pub axes: Axes,
    /// The radius in m, of either sign where a trace runs through the axis; u_x in m; cycles, s, m or J.
    pub at: Vec<f64>,
    /// Measured values, in the unit of the axes.
    pub values: Vec<f64>,
    /// Standard errors of the values, if the file gives them.
    pub errors: Option<Vec<f64>>,
    /// End of the cycle in which a loop was measured, if known.
    pub cycle: Option<f64>,
    /// For a loop, which points belong to rising strokes; otherwise empty.
    pub rising: Vec<bool>,
    /// The cycles of a loop.
    pub cycles: Vec<Cycle>,
    /// Whether its values are means around the axis, which leave nothing to centre.
    pub is_averaged: bool,
    /// What was left out or corrected, one line each.
    pub notes: Vec<String>,
}

impl Measured {
    /// A scar: columns `r_m` and `wear_m`, or `f_m` for the worn profile; standard errors in `error_m`. A map has columns
    /// `x_m` and `y_m`, and is averaged around its axis or along its line.
    ///
    /// # Errors
    /// A file that is not such a table; fewer than 3 rows.
    pub fn scar(columns: &Columns) -> Result<Self, Refusal> {
        let axes = if columns.has(Axes::WEAR.y) {
            Axes::WEAR
        } else {
            Axes::PROFILE
        };
        let mut scar = match DataKind::detect(columns) {
            Some(DataKind::Map) => map::read(columns, axes)?,
            _ => read(columns, axes, [axes.x, axes.y])?,
        };
        scar.sort();
        if axes == Axes::WEAR && trace::is_downwards(&scar.at, &scar.values) {
            scar.negate("its wear is negative: taken with the other sign");
        }
        Ok(scar)
    }

    /// A loop: columns `u_m` and `F_N`, in the order of time through one closed cycle or more; `error_N`. In this
    /// program's own `loop.csv` they are the displacement that the rig senses, else `u_x_m`, and `F_x_N`. All whole
    /// cycles count, or those that `pick` names.
    ///
    /// # Errors
    /// A file that is not such a table; fewer than 8 rows; a loop that does not close; cycles that are not there.
    pub fn fretting_loop(columns: &Columns, pick: Option<Pick>) -> Result<Self, Refusal> {
        let mut measured = read(columns, Axes::LOOP, loop_columns(columns))?;
        if measured.at.len() < FEWEST_OF_LOOP {
            let reason = format!("a loop needs {FEWEST_OF_LOOP} rows or more");
            return Err(columns.refuse(reason));
        }
        let spans = [&measured.at, &measured.values].map(|values| span(values));
        if spans.contains(&0.0) {
            return Err(columns.refuse("is not a loop: displacement or force never changes"));
        }
        if correlation(&measured.at, &measured.values) < LEANS_LEFT {
            measured.negate("force and displacement have opposite signs: the force is turned");
        }
        let mut record =
            Record::new(&measured.at, &measured.values).map_err(|why| columns.refuse(why))?;
        let whole = record.cycles.len();
        let left = measured.at.len() - record.points();
        if whole > 1 || left > 0 {
            let rest = if left > 0 {
                format!("; {left} points belong to no whole one")
            } else {
                String::new()
            };
            let plural = if whole == 1 { "" } else { "s" };
            let note = format!("{whole} whole cycle{plural}{rest}");
            measured.notes.push(note);
        }
        if let Some(pick) = pick {
            record.pick(pick).map_err(|why| columns.refuse(why))?;
            measured
                .notes
                .push(format!("cycles {} to {} are picked", pick.first, pick.last));
        }
        if record.area() < 0.0 {
            record.turn();
            measured
                .notes
                .push("it runs backwards (its area is negative): turned".to_owned());
        }
        let mut kept = Vec::new();
        for cycle in &mut record.cycles {
            let first = kept.len();
            kept.extend(cycle.points.clone());
            cycle.points = first..kept.len();
        }
        let choose = |values: &[f64]| kept.iter().map(|&i| values[i]).collect::<Vec<f64>>();
        measured.rising = record
            .cycles
            .iter()
            .flat_map(|cycle| cycle.rising.iter().copied())
            .collect();
        measured.at = choose(&measured.at);
        measured.values = choose(&measured.values);
        measured.errors = measured.errors.as_deref().map(choose);
        measured.cycles = record.cycles;
        Ok(measured)
    }

    /// A history: columns `cycle`, `energy_J`, `distance_m` or `time_s`, and `wear_volume_m3`, `depth_m`, `approach_m`, or
    /// `mass_kg` with a `density` in kg/m³; errors in `error_m3`, `error_m` or `error_kg`.
    ///
    /// # Errors
    /// A file that is not such a table; fewer than 3 rows; negative cycles; a mass without a density.
    pub fn history(columns: &Columns, density: Option<f64>) -> Result<Self, Refusal> {
        let x = OVER
            .into_iter()
            .find(|name| columns.has(name))
            .unwrap_or(OVER[0]);
        let found = WORN
            .into_iter()
            .find(|(name, _)| columns.has(name))
            .unwrap_or(WORN[1]);
        let (name, y) = found;
        let mut measured = read(columns, Axes::new(x, y), [x, name])?;
        if name == Column::Mass {
            let rule = "a mass needs the density of what has worn: --density 7800 (kg/m^3)";
            let density = density.ok_or_else(|| columns.refuse(rule))?;
            let errors = measured.errors.iter_mut().flatten();
            measured
                .values
                .iter_mut()
                .chain(errors)
                .for_each(|value| *value /= density);
        }
        if let Some(row) = measured.at.iter().position(|at| *at < 0.0) {
            let line = columns.line(row);
            return Err(columns.refuse(format!("line {line}: {} must be 0 or greater", x.name())));
        }
        Ok(measured)
    }

    /// Whether a scar's trace runs through its axis, by the signs of its radii.
    pub fn is_two_sided(&self) -> bool {
        let ends = range(self.at.iter().copied()).unwrap_or_default();
        self.axes.over_r() && ends[0] < -0.2 * ends[1] && ends[1] > -0.2 * ends[0]
    }

    /// Returns the centre of a trace, m, as far as it shows without a model.
    pub fn centre(&self) -> f64 {
        trace::centre(&self.at, &self.values, self.axes == Axes::WEAR)
    }

    /// Negates all values, and notes why.
    pub fn negate(&mut self, why: &str) {
        self.values.iter_mut().for_each(|value| *value = -*value);
        self.notes.push(why.to_owned());
    }

    /// Sorts the points by their abscissae.
    fn sort(&mut self) {
        let mut order: Vec<usize> = (0..self.at.len()).collect();
        order.sort_by(|&i, &j| self.at[i].total_cmp(&self.at[j]));
        let sorted = |values: &[f64]| order.iter().map(|&i| values[i]).collect::<Vec<f64>>();
        self.at = sorted(&self.at);
        self.values = sorted(&self.values);
        self.errors = self.errors.as_deref().map(sorted);
    }
}

/// The columns of displacement and force in a file of loops.
fn loop_columns(columns: &Columns) -> [Column; 2] {
    let is_own = columns.has(Column::Shift) && columns.has(Column::TangentialForce);
    let is_sensed = columns.column(Column::RigDisplacement.name()).is_ok();
    match (is_own, is_sensed) {
        (true, true) => [Column::RigDisplacement, Column::TangentialForce],
        (true, false) => [Column::Shift, Column::TangentialForce],
        (false, _) => [Axes::LOOP.x, Axes::LOOP.y],
    }
}

fn read(columns: &Columns, axes: Axes, [at, values]: [Column; 2]) -> Result<Measured, Refusal> {
    let (_, unit) = values.name().rsplit_once('_').unwrap_or_default();
    let error = format!("{}_{unit}", Column::StandardError.name());
    let cycle = columns
        .header
        .iter()
        .find(|(key, _)| key == Column::Cycle.name());
    let has_errors = columns.has(&error);
    // Without errors, the values take their place.
    let error = if has_errors { &error } else { values.name() };
    let ([at, values, errors], rows) = columns.whole_rows([at.name(), values.name(), error])?;
    if at.len() < FEWEST {
        return Err(columns.refuse(format!("has fewer than {FEWEST} rows of data")));
    }
    let wrong = errors.iter().position(|error| has_errors && *error <= 0.0);
    if let Some(row) = wrong {
        let line = columns.line(rows[row]);
        return Err(columns.refuse(format!("line {line}: an error must be greater than 0")));
    }
    Ok(Measured {
        name: columns.path.clone(),
        axes,
        at,
        values,
        errors: has_errors.then_some(errors),
        cycle: cycle.and_then(|(_, cycle)| cycle.parse().ok()),
        rising: Vec::new(),
        cycles: Vec::new(),
        is_averaged: false,
        notes: columns.left_out(&rows).into_iter().collect(),
    })
}

/// Ratio of two lengths beyond which one is probably in another unit.
const OTHER_UNIT: f64 = 100.0;

/// Says so where the largest of `radii` and the `reach` of the contact, m, differ by so much that one of
/// them is in another unit.
pub(super) fn check_radii(name: &str, radii: &[f64], reach: f64) -> Result<(), Refusal> {
    let widest = radii.iter().map(|r| r.abs()).fold(0.0, f64::max);
    if (reach / OTHER_UNIT..=OTHER_UNIT * reach).contains(&widest) {
        return Ok(());
    }
    let rule = format!(
        "radii up to {widest:.1e} m, but the contact reaches only {reach:.1e} m: are they in m?"
    );
    Err(Refusal::new(name, rule))
}

fn span(values: &[f64]) -> f64 {
    range(values.iter().copied()).map_or(0.0, |[least, most]| most - least)
}

fn correlation(x: &[f64], y: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (mx, my) = (mean(x), mean(y));
    let pairs = x.iter().zip(y).map(|(x, y)| (x - mx, y - my));
    let [xx, xy, yy] = pairs.fold([0.0; 3], |[xx, xy, yy], (x, y)| {
        [xx + x * x, xy + x * y, yy + y * y]
    });
    xy / (xx * yy).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(text: &str) -> Columns {
        Columns::parse(text, "data.csv").expect("columns")
    }

    #[test]
    fn scars_loops_and_histories_are_read_with_their_errors() {
        let scar = Measured::scar(&columns("r_um,wear_nm,error_nm\n-1,5,1\n0,7,1\n1,5,2\n"));
        let scar = scar.expect("a scar");
        assert_eq!((scar.axes, scar.at[0]), (Axes::WEAR, -1e-6));
        assert!((scar.errors.expect("errors")[2] / 2e-9 - 1.0).abs() < 1e-12);
        let profile = Measured::scar(&columns("r_m,f_m\n0,0\n1,1\n2,4\n")).expect("a scar");
        assert_eq!((profile.axes, profile.errors), (Axes::PROFILE, None));
        let history = Measured::history(&columns("cycle,wear_volume_m3\n0,0\n1,1\n2,4\n"), None);
        assert_eq!(history.expect("a history").axes, Axes::VOLUME);
        let history = Measured::history(&columns("cycle,depth_um\n0,0\n1,1\n2,4\n"), None);
        assert_eq!(history.expect("a history").values[2], 4e-6);
    }

    #[test]
    fn bad_data_are_one_line() {
        let scar = |text: &str| {
            Measured::scar(&columns(text))
                .expect_err("refused")
                .to_string()
        };
        assert!(scar("r_m,f_m\n0,0\n1,1\n").contains("fewer than 3 rows"));
        assert!(scar("r_m,f_m,error_m\n0,0,1\n1,1,0\n2,4,1\n").contains("line 3: an error must"));
        let history = Measured::history(&columns("cycle,depth_m\n0,0\n-1,1\n2,4\n"), None);
        assert!(
            history
                .expect_err("refused")
                .to_string()
                .contains("line 3: cycle must")
        );
        let mut open = "u_m,F_N\n".to_owned();
        for i in 0..20 {
            open.push_str(&format!("{},{}\n", i, 2 * i));
        }
        let refused = Measured::fretting_loop(&columns(&open), None).expect_err("refused");
        let half = (0..100).map(|i| f64::from(i) * std::f64::consts::PI / 100.0);
        let half = half.map(|t| format!("{},{}\n", t.sin(), (t + 0.4).sin()));
        let half = half.fold("u_m,F_N\n".to_owned(), |text, row| text + &row);
        let half = Measured::fretting_loop(&columns(&half), None).expect_err("refused");
        for refused in [refused, half] {
            let said = refused.to_string();
            assert!(said.contains("the loop does not close"), "{said}");
        }
    }
}
