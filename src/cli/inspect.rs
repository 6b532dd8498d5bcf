//! `mdr-tui inspect`: how a measured table is understood, before anything is fitted to it.

use anyhow::{Result, bail};
use serde::Serialize;

use super::args::Inspect;
use super::cycles::Cycles;
use super::fit::at_cycle;
use super::given;
use super::report::Report;
use crate::math::scan::range;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve};
use crate::scenario::columns::Columns;
use crate::studies::measured::{DataKind, Measured};
use crate::studies::table::Rows;
use crate::traces::Axes;

/// How a table is understood.
#[derive(Serialize)]
struct Understood {
    file: String,
    /// The format of the text.
    written: String,
    /// The kind of data.
    kind: &'static str,
    rows: usize,
    /// Each with the name that this program uses, in SI units, and its ends.
    columns: Rows,
    notes: Vec<String>,
    #[serde(flatten)]
    cycles: Cycles,
}

/// Prints and draws how a file is understood.
pub fn inspect(options: &Inspect) -> Result<()> {
    let (path, cycle) = at_cycle(&options.file);
    let columns = Columns::read_as(&path, &options.naming.of_columns())?;
    let kind = DataKind::detect(&columns);
    let measured = match kind {
        Some(DataKind::Loop) => Some(Measured::fretting_loop(&columns, options.pick)?),
        Some(DataKind::History) => Some(Measured::history(&columns, Some(1.0))?),
        Some(DataKind::Scar | DataKind::Map) => Some(Measured::scar(&columns)?),
        None => None,
    };
    let Some(measured) = measured else {
        bail!(columns.refuse(format!(
            "holds no scar (r, wear or f), loop (u, F) or history (cycle, wear_volume or depth) with units: its columns are \
             {}; --fields r=1,wear=2 --units um,nm says which is which",
            columns.list_names()
        )));
    };
    let mut understood = interpret(&columns, &measured, kind);
    if kind == Some(DataKind::Loop) {
        let scenario = options.scenario.as_ref();
        let scenario = scenario
            .map(|name| given::scenario(name, &[]))
            .transpose()?;
        let compared = scenario.as_ref().map(|scenario| {
            let end = cycle.or(measured.cycle).or(scenario.run().cycles);
            (scenario, end.unwrap_or(1.0))
        });
        understood.cycles = Cycles::new(&measured, options.load, compared)?;
        understood.notes.extend(understood.cycles.trends());
    }
    let mut report = understood.report();
    let mut charts = vec![chart(&measured)];
    charts.extend(understood.cycles.charts());
    report.charts(&charts, options.marker);
    report.print(options.json.then_some(&understood))
}

fn interpret(columns: &Columns, measured: &Measured, kind: Option<DataKind>) -> Understood {
    let all = columns.all();
    let mut described = Rows::with_columns(&[("", "name read_as least largest missing")]);
    for ((name, own, _), (_, values)) in columns.described().zip(&all) {
        let finite = values.iter().copied().filter(|value| value.is_finite());
        if let Some([least, largest]) = range(finite.clone()) {
            described.push((name, own, least, largest, values.len() - finite.count()));
        }
    }
    let mut notes = measured.notes.clone();
    if measured.axes.over_r() {
        notes.extend(of_trace(measured));
    }
    Understood {
        file: columns.path.clone(),
        written: columns.written.clone(),
        kind: match (kind, measured.axes) {
            (Some(DataKind::Map), _) => "a map",
            (_, Axes::LOOP) => "a fretting loop",
            (_, Axes::WEAR) => "a scar: worn depth over the radius",
            (_, Axes::PROFILE) => "a scar: the worn profile over the radius",
            _ => "a history",
        },
        rows: columns.len(),
        columns: described,
        notes,
        cycles: Cycles::default(),
    }
}

/// Describes sides, centre, offset and tilt of a trace, as far as they can be seen without a model.
fn of_trace(measured: &Measured) -> Vec<String> {
    let (at, values) = (&measured.at, &measured.values);
    if measured.is_averaged {
        return Vec::new();
    }
    if !measured.is_two_sided() {
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

impl Understood {
    fn report(&self) -> Report {
        let mut report = Report::default();
        report.line(format!("{}: {}", self.file, self.kind));
        report.line(format!("{} rows, {}", self.rows, self.written));
        report.table(&self.columns, 4);
        report.lines(&self.notes);
        self.cycles.add_to(&mut report);
        report
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
