//! `mdr-tui inspect`: how a measured table is understood, before anything is fitted to it.

use anyhow::{Context, Result, anyhow, bail};
use serde::Serialize;

use super::args::Inspect;
use super::fit::at_cycle;
use super::{given, results, small_multiples};
use crate::math::scan::range;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve};
use crate::reading::column::unit_of;
use crate::scenario::Refusal;
use crate::scenario::columns::Columns;
use crate::studies::fit::{ModelCycle, model_cycle};
use crate::studies::measured::record::{Figures, Record};
use crate::studies::measured::{Kind, Measured, loop_columns};
use crate::traces::Axes;

/// Maximum number of cycles printed; a longer record is thinned evenly to this number.
const MOST_ROWS: usize = 20;

/// How a table is understood.
#[derive(Serialize)]
struct Understood {
    file: String,
    /// The format of the text.
    written: String,
    /// The kind of data.
    kind: &'static str,
    rows: usize,
    columns: Vec<Column>,
    notes: Vec<String>,
    /// The measured figures of each cycle of a loop.
    cycles: Vec<CycleRow>,
    /// Those of the scenario, and the mean of the measured ones in units of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    beside: Option<Beside>,
}

#[derive(Serialize)]
struct Beside {
    model: CycleRow,
    ratio: CycleRow,
}

#[derive(Serialize)]
struct Column {
    name: String,
    /// The name that this program uses, in SI units.
    read_as: String,
    least: f64,
    largest: f64,
    missing: usize,
}

/// Named as the columns of a history, where these are the same.
#[derive(Serialize)]
#[allow(non_snake_case)]
struct CycleRow {
    cycle: usize,
    energy_per_cycle_J: f64,
    F_x_amplitude_N: f64,
    u_x_amplitude_m: f64,
    opening_m: f64,
    energy_ratio: f64,
    energy_ratio_B: f64,
    sliding_ratio: f64,
    friction: Option<f64>,
    mean_displacement_m: f64,
    mean_force_N: f64,
}

/// Prints and draws how a file is understood.
pub fn inspect(options: &Inspect) -> Result<()> {
    let (path, cycle) = at_cycle(&options.file);
    let columns = Columns::read_as(&path, &options.naming.of_columns())?;
    let kind = Kind::detect(&columns);
    let measured = match kind {
        Some(Kind::Loop) => Some(Measured::fretting_loop(&columns, options.pick)?),
        Some(Kind::History) => Some(Measured::history(&columns, Some(1.0))?),
        Some(Kind::Scar | Kind::Map) => Some(Measured::scar(&columns)?),
        None => None,
    };
    let Some(measured) = measured else {
        bail!(columns.refuse(format!(
            "holds no scar (r, wear or f), loop (u, F) or history (cycle, wear_volume or depth): its columns are {}; \
             --fields r=1,wear=2 --units um,nm says which is which",
            columns.list_names()
        )));
    };
    let mut understood = interpret(&columns, &measured, kind);
    if kind == Some(Kind::Loop) {
        let ours = options.scenario.as_ref().map(|name| {
            let scenario = given::scenario(name, &[])?;
            let cycle = cycle.or(measured.cycle).or(scenario.run().cycles);
            let cycle = cycle.unwrap_or(1.0);
            let ours = model_cycle(&scenario, cycle)?;
            ours.map(|ours| (cycle, ours)).ok_or_else(|| {
                let rule = "has no tangential motion, so no loop stands beside the measured one";
                anyhow!(Refusal::new(scenario.title(), rule))
            })
        });
        let ours = ours.transpose()?;
        let load = options.load.or(ours.as_ref().map(|(_, ours)| ours.load));
        understood.cycles = cycles(&columns, options, load)?;
        understood.notes.extend(trends(&understood.cycles));
        understood.beside = match &ours {
            Some((cycle, ours)) => Some(beside(&understood.cycles, *cycle, ours)?),
            None => None,
        };
    }
    results::print(options.json.then_some(&understood), || {
        let over_cycles = of_cycles(&understood.cycles);
        let charts: Vec<Chart> = [chart(&measured)].into_iter().chain(over_cycles).collect();
        understood.text() + &small_multiples::draw(&charts, options.marker)
    })
}

fn interpret(columns: &Columns, measured: &Measured, kind: Option<Kind>) -> Understood {
    let all = columns.all();
    let described = columns
        .described()
        .zip(&all)
        .filter(|(_, (_, values))| values.iter().any(|value| value.is_finite()));
    let described = described.map(|((name, own, _), (_, values))| {
        let finite = values.iter().copied().filter(|value| value.is_finite());
        let [least, largest] = range(finite.clone()).unwrap_or_default();
        let missing = values.len() - finite.count();
        Column {
            name: name.to_owned(),
            read_as: own.to_owned(),
            least,
            largest,
            missing,
        }
    });
    let mut notes = measured.notes.clone();
    if measured.axes.over_r() {
        notes.extend(of_trace(measured));
    }
    Understood {
        file: columns.path.clone(),
        written: columns.written.clone(),
        kind: match (kind, measured.axes) {
            (Some(Kind::Map), _) => "a map",
            (_, Axes::LOOP) => "a fretting loop",
            (_, Axes::WEAR) => "a scar: worn depth over the radius",
            (_, Axes::PROFILE) => "a scar: the worn profile over the radius",
            _ => "a history",
        },
        rows: columns.len(),
        columns: described.collect(),
        notes,
        cycles: Vec::new(),
        beside: None,
    }
}

/// Describes sides, centre, offset and tilt of a trace, as far as they can be seen without a model.
fn of_trace(measured: &Measured) -> Vec<String> {
    let (at, values) = (&measured.at, &measured.values);
    if measured.is_averaged || !measured.is_two_sided() {
        return vec![
            "one side of the axis, or a trace whose zero is at its end: a fit tells which"
                .to_owned(),
        ];
    }
    let middle = measured.centre();
    let mut notes = vec![format!(
        "both sides of the axis; symmetric about x = {middle:.3e} m"
    )];
    if measured.axes == Axes::WEAR {
        // The outer twentieths of the trace.
        let outer = (at.len() / 20).max(2);
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let ends = [&values[..outer], &values[values.len() - outer..]].map(mean);
        let places = [&at[..outer], &at[at.len() - outer..]].map(mean);
        notes.push(format!(
            "at its ends: {:.2e} and {:.2e} m (offset {:.2e} m, tilt {:.1e} rad)",
            ends[0],
            ends[1],
            0.5 * (ends[0] + ends[1]),
            (ends[1] - ends[0]) / (places[1] - places[0])
        ));
    }
    notes
}

/// Returns the figures of every selected cycle.
fn cycles(columns: &Columns, options: &Inspect, load: Option<f64>) -> Result<Vec<CycleRow>> {
    let ([u, force], _) = columns.whole_rows(loop_columns(columns))?;
    let mut record = Record::new(&u, &force).map_err(|why| columns.refuse(why))?;
    if let Some(pick) = options.pick {
        record.pick(pick).map_err(|why| columns.refuse(why))?;
    }
    Ok(record
        .cycles
        .iter()
        .map(|cycle| row(cycle.number, &cycle.figures, load))
        .collect())
}

fn row(number: usize, figures: &Figures, load: Option<f64>) -> CycleRow {
    let figures = Figures {
        energy: figures.energy.abs(),
        ..*figures
    };
    let [a, d, b] = figures.ratios();
    CycleRow {
        cycle: number,
        energy_per_cycle_J: figures.energy,
        F_x_amplitude_N: figures.force,
        u_x_amplitude_m: figures.amplitude,
        opening_m: figures.opening,
        energy_ratio: a,
        energy_ratio_B: b,
        sliding_ratio: d,
        friction: load.map(|load| figures.friction(load)),
        mean_displacement_m: figures.means[0],
        mean_force_N: figures.means[1],
    }
}

/// Returns the figures of the model's cycle, and the mean measured ones in units of these.
fn beside(cycles: &[CycleRow], cycle: f64, ours: &ModelCycle) -> Result<Beside> {
    let record = Record::new(&ours.displacements, &ours.forces).map_err(anyhow::Error::msg)?;
    let figures = record.cycles.first().context("the model has no cycle")?;
    let model = row(cycle.round() as usize, &figures.figures, Some(ours.load));
    let ratio = |of: fn(&CycleRow) -> f64| {
        cycles.iter().map(of).sum::<f64>() / cycles.len() as f64 / of(&model)
    };
    let friction = |row: &CycleRow| row.friction.unwrap_or(f64::NAN);
    let ratio = CycleRow {
        cycle: cycles.len(),
        energy_per_cycle_J: ratio(|row| row.energy_per_cycle_J),
        F_x_amplitude_N: ratio(|row| row.F_x_amplitude_N),
        u_x_amplitude_m: ratio(|row| row.u_x_amplitude_m),
        opening_m: ratio(|row| row.opening_m),
        energy_ratio: ratio(|row| row.energy_ratio),
        energy_ratio_B: ratio(|row| row.energy_ratio_B),
        sliding_ratio: ratio(|row| row.sliding_ratio),
        friction: Some(ratio(friction)),
        // An instrument's zeros are arbitrary, so their ratios to the model's mean nothing.
        mean_displacement_m: f64::NAN,
        mean_force_N: f64::NAN,
    };
    Ok(Beside { model, ratio })
}

/// Describes zeros that are off, and drift from the first cycle to the last.
fn trends(cycles: &[CycleRow]) -> Vec<String> {
    let (Some(first), Some(last)) = (cycles.first(), cycles.last()) else {
        return Vec::new();
    };
    let mean = |of: fn(&CycleRow) -> f64| cycles.iter().map(of).sum::<f64>() / cycles.len() as f64;
    let mut notes = vec![format!(
        "stroke ±{:.3e} m, mean displacement {:.2e} m, mean force {:.2e} N",
        mean(|row| row.u_x_amplitude_m),
        mean(|row| row.mean_displacement_m),
        mean(|row| row.mean_force_N)
    )];
    if cycles.len() > 1 {
        notes.push(format!(
            "from cycle {} to {}: mean displacement {:+.1e} m, mean force {:+.1e} N, energy {:+.1} %",
            first.cycle, last.cycle,
            last.mean_displacement_m - first.mean_displacement_m,
            last.mean_force_N - first.mean_force_N,
            100.0 * (last.energy_per_cycle_J / first.energy_per_cycle_J - 1.0)
        ));
    }
    notes
}

impl Understood {
    fn text(&self) -> String {
        let mut lines = vec![
            format!("{}: {}", self.file, self.kind),
            format!("{} rows, {}", self.rows, self.written),
        ];
        let width = self
            .columns
            .iter()
            .map(|column| column.name.chars().count())
            .max()
            .unwrap_or(0);
        for Column {
            name,
            read_as,
            least,
            largest,
            missing,
        } in &self.columns
        {
            let gaps = if *missing > 0 {
                format!(", {missing} missing")
            } else {
                String::new()
            };
            let unit = unit_of(read_as);
            lines.push(format!(
                "  {name:width$}  read as {read_as}: {least:.3e} to {largest:.3e} {unit}{gaps}"
            ));
        }
        lines.extend(self.notes.iter().cloned());
        if !self.cycles.is_empty() {
            lines.push(
                "cycle      E_d/J       Q*/N        U/m       d0/m      A      B      D    mu_e"
                    .to_owned(),
            );
            let every = self.cycles.len().div_ceil(MOST_ROWS);
            let rows = self.cycles.iter().step_by(every);
            lines.extend(rows.map(|row| row.text(&row.cycle.to_string())));
            if let Some(Beside { model, ratio }) = &self.beside {
                lines.push(model.text("model"));
                lines.push(ratio.text("ratio"));
                let (count, cycle) = (ratio.cycle, model.cycle);
                lines.push(format!(
                    "ratio: the mean of {count} cycles to cycle {cycle} of the model"
                ));
            }
        }
        lines.iter().map(|line| format!("{line}\n")).collect()
    }
}

impl CycleRow {
    /// Its line in the table.
    fn text(&self, label: &str) -> String {
        let friction = self.friction.map(|friction| format!("{friction:7.4}"));
        format!(
            "{label:>5}  {:9.3e}  {:9.3e}  {:9.3e}  {:9.3e}  {:5.3}  {:5.3}  {:5.3} {}",
            self.energy_per_cycle_J,
            self.F_x_amplitude_N,
            self.u_x_amplitude_m,
            self.opening_m,
            self.energy_ratio,
            self.energy_ratio_B,
            self.sliding_ratio,
            friction.unwrap_or_else(|| "      -".to_owned())
        )
    }
}

fn chart(measured: &Measured) -> Chart {
    let axes = measured.axes;
    let curve = Curve::new("", &measured.at[..], &measured.values[..], Role::Profile);
    Chart::new(
        "",
        Axis::new(axes.x.quantity(), axes.x.unit()),
        Axis::new(axes.y.symbol(), axes.y.unit()),
    )
    .curve(curve)
}

/// E_d over the cycles of a record of several.
fn of_cycles(cycles: &[CycleRow]) -> Option<Chart> {
    let column = |of: fn(&CycleRow) -> f64| cycles.iter().map(of).collect::<Vec<f64>>();
    let (at, energies) = (
        column(|row| row.cycle as f64),
        column(|row| row.energy_per_cycle_J),
    );
    let curve = Curve::new("", at, energies, Role::Profile);
    (cycles.len() > 1)
        .then(|| Chart::new("", Axis::new("cycle", ""), Axis::new("E_d", "J")).curve(curve))
}
