//! A run's reports: remarks at its start, and its result as text or JSON.

use std::collections::BTreeMap;
use std::io::{self, Write};

use anyhow::Result;

use super::Job;
use crate::export::header;
use crate::math::number::exact;
use crate::reading::{Quantity, verdict};
use crate::scenario::scalars::{Reading, Value};
use crate::scenario::session::Session;
use crate::scenario::{escape, printable};

/// Returns what a user should know about a run: why it never jumps, what its indenter is made from, warnings.
pub(super) fn remarks(session: &Session) -> Vec<String> {
    let never = session.simulation().why_never_jumped();
    let never = never.map(|why| format!("no cycle jumps: {why}"));
    let indenter = session.scenario().setup().indenter.remark();
    let indenter = indenter.map(|text| format!("indenter: {text}"));
    let geometry = session.scenario().setup().geometry.remark();
    let geometry = geometry.map(|text| format!("geometry: {text}"));
    let known = never.into_iter().chain(indenter).chain(geometry);
    known.chain(session.warnings()).collect()
}

impl Job<'_> {
    /// Prints the last row of the history and the header of the files, by the names used there.
    pub(super) fn print_json(&self) -> Result<()> {
        let header = header::entries(&self.session).into_iter();
        let header = header.map(|(key, text)| match text.parse::<f64>() {
            Ok(number) => (key, number.into()),
            Err(_) => (key, text.into()),
        });
        let reading = Reading::new(&self.session);
        let columns = self.job.history.columns().iter();
        let values = columns.map(|&column| (column.name().to_owned(), reading.value(column)));
        let directory = self.folder.path().display().to_string();
        let directory = [("directory".to_owned(), directory.into())];
        let summary: BTreeMap<String, Value> = header.chain(values).chain(directory).collect();
        let summary = escape::json(&summary, false)?;
        Ok(writeln!(io::stdout().lock(), "{summary}")?)
    }

    /// Prints the result as text.
    pub(super) fn summarize(&self) -> Result<()> {
        let simulation = self.session.simulation();
        let (moment, stats) = (simulation.moment(), simulation.stats());
        let mut lines = vec![("contact radius", format!("{:.4e} m", moment.contact_radius))];
        let stick = moment.permanent_stick_radius;
        lines.extend(stick.map(|c| ("permanent stick radius", format!("{c:.4e} m"))));
        let (volume, work) = (moment.wear_volume, moment.dissipated_energy);
        lines.push(("worn volume", format!("{volume:.4e} m3")));
        lines.push(("dissipated energy", format!("{work:.4e} J")));
        let setup = simulation.setup();
        lines.extend(setup.geometry.remark().map(|text| ("geometry", text)));
        lines.extend(setup.wear.map(|law| {
            let k = law.coefficient();
            let per_load = k * setup.material.friction() * 1e9;
            let both = format!("{k:.4e} 1/Pa per friction work, {per_load:.4e} mm3/(N m) per load");
            ("wear coefficient", both)
        }));
        let residual = moment.energy_residual;
        let residual = residual.map(|of| format!("{of:.1e}   (1 - V/(k E_d))"));
        lines.extend(residual.map(|residual| ("energy residual", residual)));
        let error = "estimated error";
        let stated = self.session.errors();
        if volume > 0.0 && stated.get(Quantity::WornDepth).is_none() {
            lines.push((error, "not run (--estimate-error measures it)".into()));
        }
        lines.extend(Quantity::ALL.iter().filter_map(|&of| {
            let (value, name) = (stated.get(of)?, setup.geometry.term(of.name()));
            Some((error, format!("{value:.1e}   of {name}")))
        }));
        if let Some(verdict) = verdict(&self.session.checks()) {
            lines.push(("checks", verdict.trim_start_matches("checks ").to_owned()));
        }
        if stats.parts > 0 {
            let (parts, steps) = (stats.parts, simulation.steps());
            let parts = format!("{parts} sub-steps in {steps} steps   (numerics.stability)");
            lines.push(("stiff wear", parts));
        }
        let directory = self.folder.path().display().to_string();
        lines.push(("files in", printable(&directory)));
        let mut out = io::stdout().lock();
        let title = self.session.scenario().title();
        writeln!(out, "{title}: {} cycles", exact(moment.cycle))?;
        let width = if setup.geometry.is_line() { 26 } else { 22 };
        for (name, text) in lines {
            let name = setup.geometry.term(name);
            writeln!(out, "  {name:<width$}  {text}")?;
        }
        Ok(())
    }
}
