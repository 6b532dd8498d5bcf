//! Measured results to compare with simulated ones: scars, fretting loops, histories.

use crate::math::scan::{range, value_at};
use crate::scenario::Refusal;
use crate::scenario::columns::Columns;
use crate::traces::Axes;

/// The fewest rows of a data set.
const FEWEST: usize = 3;

/// The fewest rows of a loop.
const FEWEST_OF_LOOP: usize = 8;

/// By how many times the distance between its rows a loop may miss its beginning.
const OPEN: f64 = 3.0;

/// A data set.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// The file.
    pub name: String,
    /// What it holds: a profile, what has worn of it, a loop, or the volume or the largest depth over cycles.
    pub axes: Axes,
    /// r in m (0 or greater), u_x in m, or cycles.
    pub at: Vec<f64>,
    /// What was measured there, in the unit of the axes.
    pub values: Vec<f64>,
    /// Standard errors of the values, where the file gives them.
    pub errors: Option<Vec<f64>>,
    /// The end of the cycle that a loop was measured in, where it is known.
    pub cycle: Option<f64>,
}

impl Measured {
    /// A scar: columns `r_m` and `wear_m`, or `f_m` for the worn profile; standard errors in `error_m`.
    ///
    /// # Errors
    /// A file that is not such a table; fewer than 3 rows.
    pub fn scar(columns: &Columns) -> Result<Self, Refusal> {
        let axes = match columns.has(Axes::WEAR.y) {
            true => Axes::WEAR,
            false => Axes::PROFILE,
        };
        let mut scar = read(columns, axes, axes.x, axes.y)?;
        for r in &mut scar.at {
            *r = r.abs();
        }
        Ok(scar)
    }

    /// A loop: columns `u_m` and `F_N`, through one closed cycle in the order of time; `error_N`. In this program's
    /// own `loop.csv` they are the displacement that the rig senses, else `u_x_m`, and `F_x_N`.
    ///
    /// # Errors
    /// A file that is not such a table; fewer than 8 rows; a loop that does not close.
    pub fn fretting_loop(columns: &Columns) -> Result<Self, Refusal> {
        let is_own = columns.has("u_x_m") && columns.has("F_x_N");
        let is_sensed = columns.column("rig_displacement_m").is_ok();
        let (shift, force) = match (is_own, is_sensed) {
            (true, true) => ("rig_displacement_m", "F_x_N"),
            (true, false) => ("u_x_m", "F_x_N"),
            (false, _) => (Axes::LOOP.x, Axes::LOOP.y),
        };
        let measured = read(columns, Axes::LOOP, shift, force)?;
        let rows = measured.at.len();
        if rows < FEWEST_OF_LOOP {
            let reason = format!("a loop needs {FEWEST_OF_LOOP} rows or more");
            return Err(columns.refuse(reason));
        }
        let spans = [&measured.at, &measured.values].map(|values| span(values));
        if spans.contains(&0.0) {
            return Err(columns.refuse("is not a loop: displacement or force never changes"));
        }
        let distance = |i: usize, j: usize| {
            let du = (measured.at[i] - measured.at[j]) / spans[0];
            let df = (measured.values[i] - measured.values[j]) / spans[1];
            du.hypot(df)
        };
        let mut steps: Vec<f64> = (1..rows).map(|i| distance(i, i - 1)).collect();
        steps.sort_by(f64::total_cmp);
        let gap = distance(rows - 1, 0);
        if gap > OPEN * steps[(rows - 1) / 2].max(1e-3) && gap > steps[rows - 2] {
            return Err(columns.refuse(format!(
                "the loop does not close: it begins at u = {:e} m, F = {:e} N and ends at {:e} m, {:e} N; \
                 give one whole cycle",
                measured.at[0], measured.values[0], measured.at[rows - 1], measured.values[rows - 1]
            )));
        }
        Ok(measured)
    }

    /// A history: columns `cycle` and `wear_volume_m3`, or `depth_m`; `error_m3` or `error_m`.
    ///
    /// # Errors
    /// A file that is not such a table; fewer than 3 rows; negative cycles.
    pub fn history(columns: &Columns) -> Result<Self, Refusal> {
        let (axes, values) = match columns.has("depth_m") {
            true => (Axes::DEPTH, "depth_m"),
            false => (Axes::VOLUME, Axes::VOLUME.y),
        };
        let measured = read(columns, axes, axes.x, values)?;
        if let Some(row) = measured.at.iter().position(|cycle| *cycle < 0.0) {
            let line = columns.line(row);
            return Err(columns.refuse(format!("line {line}: cycle must be 0 or greater")));
        }
        Ok(measured)
    }
}

fn read(columns: &Columns, axes: Axes, at: &str, values: &str) -> Result<Measured, Refusal> {
    let (_, unit) = values.rsplit_once('_').unwrap_or_default();
    let error = format!("error_{unit}");
    let cycle = columns.header.iter().find(|(key, _)| key == "cycle");
    let measured = Measured {
        name: columns.path.clone(),
        axes,
        at: columns.column(at)?,
        values: columns.column(values)?,
        errors: match columns.has(&error) {
            true => Some(columns.column(&error)?),
            false => None,
        },
        cycle: cycle.and_then(|(_, cycle)| cycle.parse().ok()),
    };
    if measured.at.len() < FEWEST {
        return Err(columns.refuse(format!("has fewer than {FEWEST} rows of data")));
    }
    let mut errors = measured.errors.iter().flatten();
    if let Some(row) = errors.position(|error| *error <= 0.0) {
        let line = columns.line(row);
        return Err(columns.refuse(format!("line {line}: an error must be greater than 0")));
    }
    Ok(measured)
}

/// Says so where the largest of `radii` and the `reach` of the contact, m, differ by so much that one of
/// them is in another unit.
pub(super) fn check_radii(name: &str, radii: &[f64], reach: f64) -> Result<(), Refusal> {
    let widest = radii.iter().copied().fold(0.0, f64::max);
    if (0.01 * reach..=100.0 * reach).contains(&widest) {
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

/// The points of a closed loop at which its motion turns: those of the least and of the largest displacement.
fn turns(displacements: &[f64]) -> Option<[usize; 2]> {
    let by_value = |a: &usize, b: &usize| displacements[*a].total_cmp(&displacements[*b]);
    let points = 0..displacements.len();
    Some([points.clone().min_by(by_value)?, points.max_by(by_value)?])
}

/// Which points of a closed loop belong to the rising stroke: those from its least displacement on to
/// its largest.
pub fn rises(displacements: &[f64]) -> Vec<bool> {
    let [least, most] = turns(displacements).unwrap_or_default();
    let rises = |i: usize| match least <= most {
        true => (least..=most).contains(&i),
        false => i >= least || i <= most,
    };
    (0..displacements.len()).map(rises).collect()
}

/// A loop as two functions of the displacement: the stroke there, and the one back.
#[derive(Debug, Clone, PartialEq)]
pub struct Strokes {
    /// u and F of the rising displacement, in the order of time.
    rising: (Vec<f64>, Vec<f64>),
    /// u and F of the falling one.
    falling: (Vec<f64>, Vec<f64>),
    /// The least and the largest displacement.
    pub ends: [f64; 2],
}

impl Strokes {
    /// The strokes of a closed loop of displacements and forces; `None` without a point.
    pub fn new(points: &[(f64, f64)]) -> Option<Self> {
        let displacements: Vec<f64> = points.iter().map(|point| point.0).collect();
        let [least, most] = turns(&displacements)?;
        // Both strokes share the points at which the motion turns.
        let stroke = |from: usize, to: usize| {
            let count = (to + points.len() - from) % points.len();
            let round = (from..=from + count).map(|i| points[i % points.len()]);
            round.unzip()
        };
        Some(Self {
            rising: stroke(least, most),
            falling: stroke(most, least),
            ends: [displacements[least], displacements[most]],
        })
    }

    /// The force at a displacement on one of the strokes; beyond their ends the one there.
    pub fn force(&self, displacement: f64, rising: bool) -> f64 {
        let (shifts, forces) = if rising { &self.rising } else { &self.falling };
        let [least, most] = self.ends;
        value_at(shifts, forces, displacement.clamp(least, most)).unwrap_or(f64::NAN)
    }
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
        assert_eq!((scar.axes, scar.at[0]), (Axes::WEAR, 1e-6));
        assert!((scar.errors.expect("errors")[2] / 2e-9 - 1.0).abs() < 1e-12);
        let profile = Measured::scar(&columns("r_m,f_m\n0,0\n1,1\n2,4\n")).expect("a scar");
        assert_eq!((profile.axes, profile.errors), (Axes::PROFILE, None));
        let history = Measured::history(&columns("cycle,wear_volume_m3\n0,0\n1,1\n2,4\n"));
        assert_eq!(history.expect("a history").axes, Axes::VOLUME);
        let history = Measured::history(&columns("cycle,depth_um\n0,0\n1,1\n2,4\n"));
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
        let history = Measured::history(&columns("cycle,depth_m\n0,0\n-1,1\n2,4\n"));
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
        let refused = Measured::fretting_loop(&columns(&open)).expect_err("refused");
        assert!(
            refused.to_string().contains("the loop does not close"),
            "{refused}"
        );
    }

    #[test]
    fn strokes_are_told_apart_and_interpolated() {
        // An ellipse-like loop that begins in the middle of its rising stroke.
        let points: Vec<(f64, f64)> = (0..400)
            .map(|i| std::f64::consts::TAU * f64::from(i) / 400.0)
            .map(|t| (t.sin(), (t + 0.5).sin()))
            .collect();
        let strokes = Strokes::new(&points).expect("strokes");
        for u in [-0.9f64, -0.2, 0.0, 0.6] {
            let t = u.asin();
            let back = std::f64::consts::PI - t;
            assert!((strokes.force(u, true) - (t + 0.5).sin()).abs() < 1e-3);
            assert!((strokes.force(u, false) - (back + 0.5).sin()).abs() < 1e-3);
        }
        assert_eq!(strokes.force(5.0, true), strokes.force(5.0, false));
    }
}
