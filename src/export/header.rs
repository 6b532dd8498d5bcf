//! The `# key: value` lines at the top of every CSV file.

use crate::math::grid::RadialGrid;
use crate::math::number::exact;
use crate::reading::{Column, Table};
use crate::scenario::escape::{csv_line, printable};
use crate::scenario::scalars::text;
use crate::scenario::session::Session;
use crate::simulation::{Setup, Spacing};

/// How a file begins that tells of the present state of `session`: the header and the names of the columns.
pub fn head(session: &Session, columns: &[Column]) -> String {
    let entries = entries(session);
    let lines = entries.iter().map(|(key, value)| line(key, value));
    lines.collect::<String>() + &csv_line(columns.iter().map(|column| column.name()))
}

/// Returns the rows of a table as lines of a file.
pub fn lines(table: &Table) -> String {
    let columns: Vec<_> = table.columns().collect();
    let line = |row: usize| {
        let fields = columns
            .iter()
            .map(|(column, values)| text(*column, values[row]));
        fields.collect::<Vec<_>>().join(",") + "\n"
    };
    (0..table.rows()).map(line).collect()
}

/// Returns a whole file.
pub fn file(session: &Session, table: &Table) -> String {
    let columns: Vec<Column> = table.columns().map(|(column, _)| column).collect();
    head(session, &columns) + &lines(table)
}

/// Returns one line of a header.
pub fn line(key: &str, value: &str) -> String {
    // A title must stay on one line and must not control a terminal.
    format!("# {}: {}\n", printable(key), printable(value))
}

/// Key and value of the line of a run whose error is not known.
pub const UNMEASURED: (&str, &str) = (
    Column::WornDepthError.name(),
    "not measured (--estimate-error)",
);

/// Returns the keys and values of a file's header for the present state of `session`.
pub fn entries(session: &Session) -> Vec<(String, String)> {
    let scenario = session.scenario();
    let setup = session.simulation().setup();
    let law = setup.wear.map_or("none", |law| law.name());
    let mut entries = Vec::new();
    let mut line = |key: &str, value: &str| entries.push((key.to_owned(), value.to_owned()));
    line("mdr-tui", env!("CARGO_PKG_VERSION"));
    line("arithmetic", arithmetic());
    line("scenario", scenario.title());
    line(Column::Cycle.name(), &exact(session.simulation().cycle()));
    if let Some(remark) = setup.geometry.remark() {
        line("geometry", &remark);
    }
    line("method", setup.method.name());
    line("law", law);
    if let Some(law) = &setup.wear {
        // 1/Pa = m³/J: worn volume per friction work.
        let k = law.coefficient();
        line("wear_coefficient_per_Pa", &exact(k));
        line("wear_coefficient_mm3_per_J", &exact(k * 1e9));
        line("wear_coefficient_um3_per_J", &exact(k * 1e18));
        // Archard's coefficient, per load and sliding distance, at the present friction.
        let per_load = exact(k * setup.material.friction() * 1e9);
        line("wear_coefficient_per_load_mm3_per_Nm", &per_load);
    }
    line("points", &setup.grid.cells().to_string());
    line("steps_per_cycle", &setup.steps_per_cycle.to_string());
    line("grid", grid(setup));
    line("scheme", setup.scheme.name());
    if let Some(remark) = setup.indenter.remark() {
        line("table", &remark);
    }
    if let Some(share) = scenario.wear_share() {
        line("wear_share_of_indenter", &exact(share));
    }
    if setup.scar.is_some() {
        let initial = session.simulation().moment().initial_volume;
        line("initial_wear_volume_m3", &exact(initial));
    }
    line("checks", &checks(session));
    for warning in session.warnings() {
        line("warning", &warning);
    }
    if let Some(note) = &session.loaded().run().note {
        line("note", note);
    }
    for (key, value) in session.errors().entries() {
        line(key, &value);
    }
    let moves = setup.drive.tangential().is_some();
    if moves && !session.errors().are_measured() {
        line(UNMEASURED.0, UNMEASURED.1);
    }
    for change in session.changes() {
        let place = format!("at cycle {}", exact(change.at_cycle));
        line(&place, &change.to_string());
    }
    entries
}

/// Names what the last digits depend on: whether the processor rounds a multiply-add once or twice.
pub fn arithmetic() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            "x86_64, fused multiply-add"
        } else {
            "x86_64, separate multiply and add"
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        std::env::consts::ARCH
    }
}

/// Returns the grid's spacing: a graded grid without anything to refine towards is in fact uniform.
fn grid(setup: &Setup) -> &'static str {
    let even = RadialGrid::uniform(setup.grid.cells(), setup.grid.radius());
    if even.is_ok_and(|even| even.nodes() == setup.grid.nodes()) {
        Spacing::Uniform.name()
    } else {
        setup.spacing.name()
    }
}

/// Returns `ok`, or each failing check with its error.
fn checks(session: &Session) -> String {
    let checks = session.checks();
    let failing = checks.iter().filter(|check| !check.holds());
    let failing =
        failing.map(|check| format!("{} {:.1e}", check.subject.name(), check.error.abs()));
    match failing.collect::<Vec<String>>() {
        none if none.is_empty() => "ok".into(),
        failing => failing.join(", "),
    }
}
