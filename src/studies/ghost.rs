//! Curves to lay beside a simulation: what somebody measured, the files of a run, a state that was frozen.

use std::path::Path;

use super::measured::{Measured, Strokes, check_radii};
use crate::scenario::columns::{Columns, Quantity};
use crate::scenario::{ScenarioError, printable};
use crate::simulation::Observation;

/// The fewest rows of a history that show a loop.
const SHORTEST_LOOP: usize = 9;

/// What a trace shows, and over what.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axes {
    /// f over r, m.
    Profile,
    /// f − f₀ over r, m.
    Wear,
    /// g over x, m.
    Springs,
    /// p over r, Pa.
    Pressure,
    /// τ over r, Pa.
    Shear,
    /// F_x, N, over u_x, m.
    Loop,
    /// V, m³, over cycles.
    Volume,
    /// The largest f − f₀, m, over cycles.
    Depth,
    /// The largest a in each cycle, m, over cycles.
    Contact,
    /// The smallest c in each cycle, m, over cycles.
    Stick,
}

impl Axes {
    /// The symbol and the unit of what is shown.
    pub fn quantity(self) -> (&'static str, &'static str) {
        match self {
            Self::Profile => ("f", "m"),
            Self::Wear => ("worn", "m"),
            Self::Springs => ("g", "m"),
            Self::Pressure => ("p", "Pa"),
            Self::Shear => ("τ", "Pa"),
            Self::Loop => ("F_x", "N"),
            Self::Volume => ("V", "m³"),
            Self::Depth => ("depth", "m"),
            Self::Contact => ("a", "m"),
            Self::Stick => ("c", "m"),
        }
    }

    /// Whether it is shown over the radius.
    pub fn over_r(self) -> bool {
        use Axes::{Pressure, Profile, Shear, Springs, Wear};
        matches!(self, Profile | Wear | Springs | Pressure | Shear)
    }
}

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// What it shows.
    pub axes: Axes,
    /// Abscissae.
    pub xs: Vec<f64>,
    /// Ordinates; NaN is a gap.
    pub ys: Vec<f64>,
    /// Standard errors of the ordinates, where they are known.
    pub errors: Option<Vec<f64>>,
}

impl Trace {
    /// The ordinate at `x`, between the neighbouring points that have it between them; none outside.
    pub fn value_at(&self, x: f64) -> Option<f64> {
        let points = self.xs.iter().zip(&self.ys);
        let points: Vec<(f64, f64)> = points.map(|(x, y)| (*x, *y)).collect();
        points.windows(2).find_map(|pair| {
            let [(x0, y0), (x1, y1)] = [pair[0], pair[1]];
            let value = match x1 == x0 {
                true => y0,
                false => y0 + (y1 - y0) * ((x - x0) / (x1 - x0)),
            };
            ((x0.min(x1)..=x0.max(x1)).contains(&x) && value.is_finite()).then_some(value)
        })
    }

    /// The force of a loop at a displacement on one of its strokes; none beyond its ends.
    pub fn force_at(&self, displacement: f64, rising: bool) -> Option<f64> {
        let points = self.xs.iter().copied().zip(self.ys.iter().copied());
        let points: Vec<(f64, f64)> = points.filter(|(_, force)| force.is_finite()).collect();
        let ends = points
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], (x, _)| {
                [low.min(*x), high.max(*x)]
            });
        let is_within = (ends[0]..=ends[1]).contains(&displacement);
        is_within.then(|| Strokes::new(&points).force(displacement, rising))
    }
}

/// What has worn, over the radius.
#[derive(Debug, Clone, PartialEq)]
pub struct Worn {
    /// r, m.
    pub radii: Vec<f64>,
    /// f₀ there, m.
    pub unworn: Vec<f64>,
    /// f − f₀, m.
    pub wear: Vec<f64>,
    /// Standard errors of f or f − f₀, m.
    pub errors: Option<Vec<f64>>,
}

/// Traces of one source.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ghost {
    /// What legends call it.
    pub name: String,
    /// Whether the values were measured, at points that say nothing of what lies between them.
    pub is_measured: bool,
    traces: Vec<Trace>,
}

impl Ghost {
    /// A ghost without traces.
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            ..Self::default()
        }
    }

    /// Reads measured data or a table of a run from a CSV file, or all tables of a run's directory.
    ///
    /// # Errors
    /// One line: what cannot be read, holds nothing that could be drawn, or is refused as measured data.
    pub fn read(path: &Path) -> Result<Self, ScenarioError> {
        let name = path.file_name().unwrap_or(path.as_os_str());
        let name = printable(&name.to_string_lossy());
        if !path.is_dir() {
            return Self::of_columns(&name, &Columns::read(path)?);
        }
        let mut ghost = Self::new(&name);
        // The loop of a snapshot has its own file.
        for file in ["state.csv", "history.csv", "loop.csv"] {
            let file = path.join(file);
            if file.is_file() {
                let columns = Columns::read(&file)?;
                ghost.take_state(&columns);
                ghost.take_history(&columns);
                ghost.take_loop(&columns);
            }
        }
        match ghost.traces.is_empty() {
            true => Err(ScenarioError::Unreadable {
                origin: printable(&path.display().to_string()),
                reason: "holds no state.csv and no history.csv of a run".into(),
            }),
            false => Ok(ghost),
        }
    }

    /// The traces of a table, by its columns: a state or a history of this program, else measured data.
    ///
    /// # Errors
    /// Columns that make nothing that could be drawn; gaps and more in measured data.
    pub fn of_columns(name: &str, columns: &Columns) -> Result<Self, ScenarioError> {
        let mut ghost = Self::new(name);
        let has = |name, quantity| columns.has(name, quantity);
        if has("f0", Quantity::Length) {
            ghost.take_state(columns);
        } else if has("u_z", Quantity::Length) || has("scar_depth", Quantity::Length) {
            ghost.take_history(columns);
        } else {
            ghost.is_measured = true;
            if has("r", Quantity::Length) {
                ghost.take_measured(Measured::scar(columns)?);
            }
            if has("u", Quantity::Length) || has("u_x", Quantity::Length) {
                ghost.take_measured(Measured::fretting_loop(columns)?);
            } else if has("cycle", Quantity::Number) {
                ghost.take_measured(Measured::history(columns)?);
            }
        }
        match ghost.traces.is_empty() {
            true => Err(columns.refuse(format!(
                "has nothing to draw: needs r_m with wear_m or f_m, u_m with F_N, or cycle with \
                 wear_volume_m3 or depth_m; the first line names {}",
                columns.named()
            ))),
            false => Ok(ghost),
        }
    }

    /// The curves of an observation, as far as they were asked for.
    pub fn of_observation(name: &str, seen: &Observation) -> Self {
        let mut ghost = Self::new(name);
        for (axes, values) in [
            (Axes::Profile, &seen.profile),
            (Axes::Wear, &seen.wear),
            (Axes::Springs, &seen.profile_1d),
            (Axes::Pressure, &seen.pressure),
            (Axes::Shear, &seen.shear),
        ] {
            if !values.is_empty() {
                ghost.add(axes, seen.radii.to_vec(), values.clone());
            }
        }
        ghost
    }

    /// Adds a trace, unless it has no finite value.
    pub fn add(&mut self, axes: Axes, xs: Vec<f64>, ys: Vec<f64>) {
        if ys.iter().any(|value| value.is_finite()) {
            self.traces.push(Trace {
                axes,
                xs,
                ys,
                errors: None,
            });
        }
    }

    /// The trace that shows this.
    pub fn trace(&self, axes: Axes) -> Option<&Trace> {
        self.traces.iter().find(|trace| trace.axes == axes)
    }

    /// What has worn of it: as its traces say, or by its profile less `unworn`, m at r; `None` if
    /// neither is known.
    pub fn worn(&self, unworn: impl Fn(f64) -> f64) -> Option<Worn> {
        let (profile, wear) = (self.trace(Axes::Profile), self.trace(Axes::Wear));
        let trace = wear.or(profile)?;
        let radii = trace.xs.clone();
        let unworn: Vec<f64> = match (profile, wear) {
            (Some(profile), Some(wear)) => {
                let both = profile.ys.iter().zip(&wear.ys);
                both.map(|(f, wear)| f - wear).collect()
            }
            _ => radii.iter().map(|&r| unworn(r)).collect(),
        };
        let wear = match wear {
            Some(wear) => wear.ys.clone(),
            None => trace.ys.iter().zip(&unworn).map(|(f, f0)| f - f0).collect(),
        };
        Some(Worn {
            radii,
            unworn,
            wear,
            errors: trace.errors.clone(),
        })
    }

    /// All traces.
    pub fn traces(&self) -> &[Trace] {
        &self.traces
    }

    /// Says so where its radii and the `reach` of the contact, m, differ by so much that one of them is
    /// in another unit.
    ///
    /// # Errors
    /// A line that names both.
    pub fn check_radii(&self, reach: f64) -> Result<(), String> {
        let over_r = |trace: &&Trace| matches!(trace.axes, Axes::Profile | Axes::Wear);
        self.traces
            .iter()
            .filter(over_r)
            .try_for_each(|trace| check_radii(&self.name, &trace.xs, reach))
    }

    fn take_measured(&mut self, measured: Measured) {
        use super::measured::Kind;
        self.traces.push(Trace {
            axes: match measured.kind {
                Kind::Profile => Axes::Profile,
                Kind::Wear => Axes::Wear,
                Kind::Loop => Axes::Loop,
                Kind::Volume => Axes::Volume,
                Kind::Depth => Axes::Depth,
            },
            xs: measured.at,
            ys: measured.values,
            errors: measured.errors,
        });
    }

    fn take_state(&mut self, columns: &Columns) {
        let lengths = [
            (Axes::Profile, "f", Quantity::Length),
            (Axes::Wear, "wear", Quantity::Length),
            (Axes::Springs, "g", Quantity::Length),
            (Axes::Pressure, "p", Quantity::Stress),
            (Axes::Shear, "tau", Quantity::Stress),
        ];
        self.take_columns(columns, ("r", Quantity::Length), &lengths);
    }

    fn take_history(&mut self, columns: &Columns) {
        let radii = [
            (Axes::Volume, "wear_volume", Quantity::Volume),
            (Axes::Depth, "scar_depth", Quantity::Length),
            (Axes::Contact, "contact_radius", Quantity::Length),
            (Axes::Stick, "permanent_stick_radius", Quantity::Length),
        ];
        self.take_columns(columns, ("cycle", Quantity::Number), &radii);
        let column = |name, quantity| columns.column_with_gaps(name, quantity);
        if let (Some(cycles), Some(shifts), Some(forces)) = (
            column("cycle", Quantity::Number),
            column("u_x", Quantity::Length),
            column("F_x", Quantity::Force),
        ) {
            let end = cycles.last().copied().unwrap_or(0.0);
            let rows = (0..cycles.len()).filter(|&row| cycles[row] >= end - 1.0 - 1e-9);
            let (xs, ys): (Vec<f64>, Vec<f64>) = rows.map(|row| (shifts[row], forces[row])).unzip();
            if xs.len() >= SHORTEST_LOOP {
                self.add(Axes::Loop, xs, ys);
            }
        }
    }

    fn take_loop(&mut self, columns: &Columns) {
        let force = [(Axes::Loop, "F", Quantity::Force)];
        self.take_columns(columns, ("u", Quantity::Length), &force);
    }

    /// Columns of this program's own tables, which may have gaps.
    fn take_columns(
        &mut self,
        columns: &Columns,
        (at, quantity): (&str, Quantity),
        values: &[(Axes, &str, Quantity)],
    ) {
        let Some(xs) = columns.column_with_gaps(at, quantity) else {
            return;
        };
        for (axes, name, quantity) in values {
            if let Some(ys) = columns.column_with_gaps(name, *quantity) {
                self.add(*axes, xs.clone(), ys);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ghost(text: &str) -> Result<Ghost, ScenarioError> {
        Ghost::of_columns("data.csv", &Columns::parse(text, "data.csv")?)
    }

    #[test]
    fn columns_tell_what_a_table_is() {
        let axes = |text: &str| -> Vec<Axes> {
            let ghost = ghost(text).expect("a ghost");
            ghost.traces.iter().map(|trace| trace.axes).collect()
        };
        assert_eq!(axes("r_um,wear_nm\n0,3\n1,2\n2,1\n"), [Axes::Wear]);
        assert_eq!(axes("r_m,f_m\n0,0\n1,1\n2,4\n"), [Axes::Profile]);
        assert_eq!(axes("cycle,depth_um\n0,0\n1,1\n2,4\n"), [Axes::Depth]);
        assert_eq!(
            axes("r_m,f0_m,f_m,p_Pa,wear_m\n0,0,0,inf,0\n1,1,2,3,1\n"),
            [Axes::Profile, Axes::Wear, Axes::Pressure]
        );
        assert_eq!(
            axes("cycle,u_z_m,wear_volume_m3,permanent_stick_radius_m\n0,0,0,\n1,1,2,\n"),
            [Axes::Volume]
        );
    }

    #[test]
    fn what_cannot_be_drawn_is_one_line() {
        for (text, part) in [
            ("a,b\n1,2\n", "has nothing to draw: needs r_m with wear_m"),
            ("r_m,z_m\n0,0\n1,1\n2,2\n", "has no column f_m"),
            ("r_m,wear_m\n0,0\n1,\n2,2\n", "line 3: wear_m is empty"),
            ("r_m,wear_m\n0,0\n1,NaN\n2,2\n", "must be a finite number"),
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
        assert!(error.contains("are they in m?"), "{error}");
    }

    #[test]
    fn values_are_read_between_points_and_not_beyond() {
        let mut ghost = Ghost::new("x");
        ghost.add(Axes::Wear, vec![0.0, 1.0, 3.0], vec![2.0, 4.0, 0.0]);
        let trace = ghost.trace(Axes::Wear).expect("a trace");
        assert_eq!(trace.value_at(0.5), Some(3.0));
        assert_eq!(trace.value_at(2.0), Some(2.0));
        assert_eq!(trace.value_at(3.5), None);
        assert_eq!(ghost.trace(Axes::Loop), None);
    }
}
