//! The figures of each cycle of a measured record, compared with a scenario's: a table, and plots over the cycles.

use anyhow::{Context, Result, ensure};
use serde::{Serialize, Serializer};

use super::report::Report;
use crate::charts::fretting_log;
use crate::math::number::exact;
use crate::math::scan::thinned;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve};
use crate::reading::Column;
use crate::scenario::scalars::Value;
use crate::scenario::{Refusal, Scenario};
use crate::studies::fit::model_cycles;
use crate::studies::measured::Measured;
use crate::studies::measured::record::{self, COLUMNS, FigureRow, Record};
use crate::studies::table::Rows;
use crate::traces::{Axes, Loop};

/// Maximum number of cycles printed; a longer record is thinned evenly to this number.
const MOST_ROWS: usize = 20;

/// How the model is drawn: dotted.
const MODEL: Role = Role::Ghost(0);

/// The cycles of a record.
#[derive(Default, Serialize)]
pub(super) struct Cycles {
    /// The measured ones.
    cycles: Vec<CycleRow>,
    #[serde(skip_serializing_if = "Option::is_none")]
    beside: Option<ModelCycles>,
}

#[derive(Serialize)]
struct ModelCycles {
    /// The model's cycles, one for each cycle of the record that is printed.
    model: Vec<CycleRow>,
    /// The sums over these measured cycles in units of the model's.
    ratio: CycleRow,
}

/// The figures of a cycle.
struct CycleRow {
    /// Its number in the record, or its end in the model; `None` for a ratio.
    cycle: Option<f64>,
    row: FigureRow,
    /// The loop about its zeros, m and N: the zeros of instruments are arbitrary.
    u: Vec<f64>,
    force: Vec<f64>,
}

impl Serialize for CycleRow {
    /// Writes an object with the names of a history's columns, where these are the same.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let cycle = self.cycle.map(|cycle| (Column::Cycle, cycle));
        let all = cycle.into_iter().chain(COLUMNS.into_iter().zip(self.row));
        serializer.collect_map(all.map(|(column, value)| (column.name(), value)))
    }
}

impl CycleRow {
    fn new(cycle: f64, u: &[f64], force: &[f64], of: &record::Figures, load: Option<f64>) -> Self {
        let less = |values: &[f64], zero: f64| values.iter().map(|value| value - zero).collect();
        Self {
            cycle: Some(cycle),
            row: of.row(load),
            u: less(u, of.means[0]),
            force: less(force, of.means[1]),
        }
    }

    fn value(&self, wanted: Column) -> f64 {
        let mut row = COLUMNS.into_iter().zip(self.row);
        row.find(|(column, _)| *column == wanted)
            .map_or(f64::NAN, |(_, value)| value)
    }

    /// Returns its row in the table.
    fn cells(&self, of: &str) -> Vec<Value> {
        let cycle = self.cycle.map(exact);
        let values = printed().map(|column| self.value(column).into());
        [of.into(), cycle.into()]
            .into_iter()
            .chain(values)
            .collect()
    }
}

/// Whether a column is a zero of the instrument, which has a separate line and no ratio to the model's.
fn is_zero(column: Column) -> bool {
    [Column::MeanShift, Column::MeanForce].contains(&column)
}

/// The columns of the printed table.
fn printed() -> impl Iterator<Item = Column> {
    COLUMNS.into_iter().filter(|column| !is_zero(*column))
}

/// Returns the cycles to show.
fn shown<T>(cycles: &[T]) -> Vec<&T> {
    thinned(cycles, MOST_ROWS)
}

impl Cycles {
    /// Computes the figures of a record, with μ_e under a normal force, N, and the figures of a scenario's cycles: the
    /// record ends at the given one, and its cycles follow each other. Without a force, uses the scenario's.
    ///
    /// # Errors
    /// A scenario without a loop, or whose contact cannot be computed.
    pub fn new(
        measured: &Measured,
        load: Option<f64>,
        beside: Option<(&Scenario, f64)>,
    ) -> Result<Self> {
        let numbers = shown(&measured.cycles);
        let numbers: Vec<f64> = numbers.iter().map(|one| one.number as f64).collect();
        let mut model = Vec::new();
        let mut load = load;
        if let Some((scenario, end)) = beside {
            let first = end - numbers.last().copied().unwrap_or_default();
            let ends: Vec<f64> = numbers
                .iter()
                .map(|number| (first + number).max(1.0))
                .collect();
            let ours = model_cycles(scenario, &ends)?;
            let rule = "has no tangential motion, so no loop stands beside the measured one";
            ensure!(!ours.is_empty(), Refusal::new(scenario.title(), rule));
            for (one, end) in ours.iter().zip(&ends) {
                let (u, force) = (&one.displacements, &one.forces);
                let record = Record::new(u, force).map_err(anyhow::Error::msg)?;
                let cycle = record.cycles.first().context("the model has no cycle")?;
                model.push(CycleRow::new(
                    *end,
                    u,
                    force,
                    &cycle.figures,
                    Some(one.load),
                ));
            }
            load = load.or(ours.last().map(|one| one.load));
        }
        let cycles = measured.cycles.iter().map(|one| {
            let [u, force] = [&measured.at, &measured.values].map(|all| &all[one.points.clone()]);
            CycleRow::new(one.number as f64, u, force, &one.figures, load)
        });
        let cycles: Vec<CycleRow> = cycles.collect();
        let sum = |all: &mut dyn Iterator<Item = &CycleRow>, column: Column| {
            all.map(|one| one.value(column)).sum::<f64>()
        };
        let ratio = COLUMNS.map(|column| match column {
            column if is_zero(column) => f64::NAN,
            _ => sum(&mut shown(&cycles).into_iter(), column) / sum(&mut model.iter(), column),
        });
        let ratio = CycleRow {
            cycle: None,
            row: ratio,
            u: Vec::new(),
            force: Vec::new(),
        };
        let beside = beside.is_some().then_some(ModelCycles { model, ratio });
        Ok(Self { cycles, beside })
    }

    fn of_model(&self) -> &[CycleRow] {
        self.beside.as_ref().map_or(&[], |beside| &beside.model)
    }

    fn values(figures: &[CycleRow], column: Column) -> Vec<f64> {
        figures.iter().map(|one| one.value(column)).collect()
    }

    /// Describes zeros that are off, and drift from the first cycle to the last.
    pub fn trends(&self) -> Vec<String> {
        let mean = |column: Column| {
            Self::values(&self.cycles, column).iter().sum::<f64>() / self.cycles.len() as f64
        };
        let mut notes = Vec::new();
        if !self.cycles.is_empty() {
            notes.push(format!(
                "stroke ±{:.3e} m, mean displacement {:.2e} m, mean force {:.2e} N",
                mean(Column::ShiftAmplitude),
                mean(Column::MeanShift),
                mean(Column::MeanForce)
            ));
        }
        if let [first, .., last] = &self.cycles[..] {
            let change = |column: Column| last.value(column) - first.value(column);
            notes.push(format!(
                "from cycle {} to {}: mean displacement {:+.1e} m, mean force {:+.1e} N, energy {:+.1} %",
                first.cycle.unwrap_or_default(),
                last.cycle.unwrap_or_default(),
                change(Column::MeanShift),
                change(Column::MeanForce),
                100.0 * change(Column::EnergyPerCycle) / first.value(Column::EnergyPerCycle)
            ));
        }
        notes
    }

    /// Adds the table; nothing without a cycle.
    pub fn add_to(&self, report: &mut Report) {
        if self.cycles.is_empty() {
            return;
        }
        let mut rows = Rows::with_columns(&[("", "of cycle")]);
        for column in printed() {
            match (column.symbol(), column.unit()) {
                // A history has E_d since the start under this symbol.
                ("", unit) => rows.column("", &format!("E_d/{unit}")),
                (symbol, "") => rows.column("", symbol),
                (symbol, unit) => rows.column("", &format!("{symbol}/{unit}")),
            }
        }
        for (k, one) in shown(&self.cycles).into_iter().enumerate() {
            rows.push(one.cells("measured"));
            let model = self.of_model().get(k);
            model
                .into_iter()
                .for_each(|model| rows.push(model.cells("model")));
        }
        let Some(ModelCycles { model, ratio }) = &self.beside else {
            return report.table(&rows, 4);
        };
        rows.push(ratio.cells("ratio"));
        report.table(&rows, 4);
        let ends = [model.first(), model.last()].map(|one| one.and_then(|one| one.cycle));
        let [first, last] = ends.map(Option::unwrap_or_default);
        report.line(format!(
            "model: its cycles {first} to {last}; ratio: measured to model, by their means"
        ));
    }

    /// Draws the last loop where there is a model; for several cycles E_d over these, and the loops at their heights.
    pub fn charts(&self) -> Vec<Chart> {
        let (measured, model) = (shown(&self.cycles), self.of_model());
        let chart = |x: Axis, y: Axis| Chart::new("", x, y);
        let mut charts = Vec::new();
        if let Some((one, other)) = measured.last().zip(model.last()) {
            let Axes { x, y } = Axes::LOOP;
            let curves = [(*one, Role::Profile), (other, MODEL)];
            let curves = curves.map(|(one, role)| Curve::new("", &one.u[..], &one.force[..], role));
            let x = Axis::new(x.quantity(), x.unit());
            let y = Axis::new(y.symbol(), y.unit());
            charts.push(chart(x, y).curves(curves));
        }
        if measured.len() > 1 {
            let at: Vec<f64> = measured.iter().filter_map(|one| one.cycle).collect();
            let energy = |of: &[&CycleRow]| {
                of.iter()
                    .map(|one| one.value(Column::EnergyPerCycle))
                    .collect::<Vec<f64>>()
            };
            let ours: Vec<&CycleRow> = model.iter().collect();
            let curves = [(&measured, Role::Profile), (&ours, MODEL)];
            let curves = curves.map(|(of, role)| Curve::new("", &at[..of.len()], energy(of), role));
            charts.push(chart(Axis::new("cycle", ""), Axis::new("E_d", "J")).curves(curves));
            let logs = [&measured, &ours].map(|of| {
                let loops = of.iter().zip(&at).map(|(one, at)| Loop {
                    end: *at,
                    shifts: one.u.clone(),
                    forces: one.force.clone(),
                    ..Loop::default()
                });
                loops.collect::<Vec<_>>()
            });
            let logs = logs.each_ref().map(|log| log.iter().collect::<Vec<_>>());
            charts.extend(fretting_log::of_logs(logs.each_ref().map(|log| &log[..])));
        }
        charts
    }
}
