//! `mdr-tui run`: the simulation without a screen.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result};

use super::args::{CycleAsGiven, HistoryChoice, Run};
use super::progress::Progress;
use super::{FAILED, Misuse, complain};
use crate::export::file::{RunDirectory, free_directory};
use crate::export::header::number;
use crate::export::history::History;
use crate::export::state;
use crate::scenario::session::Session;
use crate::scenario::{Scenario, printable};

/// Runs a scenario and writes its files.
pub fn run(options: &Run) -> Result<ExitCode> {
    let scenario = Scenario::load(&options.scenario, &options.changes.set)?;
    let cycles = options.cycles.or(scenario.run().cycles).ok_or_else(|| {
        Misuse(format!(
            "{}: has no run.cycles; say how many with --cycles X",
            options.scenario
        ))
    })?;
    let snapshots = snapshots(options, &scenario, cycles)?;
    let session = Session::start(scenario)?;
    let directory = match &options.out {
        Some(path) => path.clone(),
        None => free_directory(&format!("{}-run", session.loaded().stem())),
    };
    let directory = RunDirectory::claim(&directory, options.force)?;
    let mut job = Job {
        session,
        history: History::default(),
        directory,
        options,
        snapshots,
        cycles,
    };
    if let Some(why) = job.session.simulation().why_never_jumped()
        && !options.quiet
    {
        complain(&format!("every cycle is stepped directly: {why}"));
    }
    let stop = stop_signal()?;
    let outcome = job.advance(&stop);
    // Whatever happened, what was computed is kept.
    job.write_end()?;
    match outcome {
        Ok(Ended::Done) => {
            if !options.quiet {
                job.summarize()?;
            }
            Ok(ExitCode::SUCCESS)
        }
        Ok(Ended::Interrupted) => {
            complain(&format!(
                "interrupted at cycle {}; kept in {}",
                number(job.session.simulation().cycle()),
                job.directory.path().display()
            ));
            Ok(ExitCode::from(FAILED))
        }
        Err(error) => Err(error.context(format!(
            "{} (kept in {})",
            options.scenario,
            job.directory.path().display()
        ))),
    }
}

/// The snapshots asked for, sorted by cycle and none beyond the end.
fn snapshots(options: &Run, scenario: &Scenario, cycles: f64) -> Result<Vec<CycleAsGiven>> {
    let mut snapshots = match &options.snapshot_at {
        Some(given) => {
            if let Some(late) = given.iter().find(|snapshot| snapshot.cycle > cycles) {
                let message = format!(
                    "--snapshot-at {}: lies beyond the end at {cycles} cycles",
                    late.spelling
                );
                return Err(Misuse(message).into());
            }
            given.clone()
        }
        None => {
            let planned = scenario
                .run()
                .snapshot_at
                .iter()
                .filter(|&&cycle| cycle <= cycles);
            planned
                .map(|&cycle| CycleAsGiven {
                    cycle,
                    spelling: cycle.to_string(),
                })
                .collect()
        }
    };
    snapshots.sort_by(|a, b| a.cycle.total_cmp(&b.cycle));
    Ok(snapshots)
}

/// Set by the first Ctrl-C or SIGTERM: stop after the step and keep what is done. A second one ends
/// the process at once.
fn stop_signal() -> Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [signal_hook::consts::SIGINT, signal_hook::consts::SIGTERM] {
        signal_hook::flag::register_conditional_shutdown(
            signal,
            i32::from(FAILED),
            Arc::clone(&stop),
        )
        .and_then(|_| signal_hook::flag::register(signal, Arc::clone(&stop)))
        .context("cannot listen for signals")?;
    }
    Ok(stop)
}

enum Ended {
    Done,
    Interrupted,
}

struct Job<'a> {
    session: Session,
    history: History,
    directory: RunDirectory,
    options: &'a Run,
    snapshots: Vec<CycleAsGiven>,
    cycles: f64,
}

impl Job<'_> {
    /// Steps to the end, taking snapshots on the way.
    fn advance(&mut self, stop: &AtomicBool) -> Result<Ended> {
        let mut progress = Progress::new(self.cycles, self.options.quiet);
        let mut snapshots = std::mem::take(&mut self.snapshots).into_iter().peekable();
        self.history.record(&self.session);
        loop {
            let simulation = self.session.simulation();
            let (cycle, close) = (simulation.cycle(), simulation.rounding());
            while let Some(snapshot) = snapshots.next_if(|snapshot| snapshot.cycle < cycle + close)
            {
                self.snapshot(&snapshot, &self.session)?;
            }
            if cycle >= self.cycles {
                break;
            }
            if stop.load(Ordering::Relaxed) {
                progress.finish();
                return Ok(Ended::Interrupted);
            }
            let reach = if simulation.may_jump() {
                f64::INFINITY
            } else {
                simulation.next_moment()
            };
            // Between two steps a copy takes the fraction of a step: looking does not change the run.
            let copied = snapshots.peek().filter(|snapshot| snapshot.cycle < reach);
            let before = copied.map(|_| self.session.clone());
            self.session.step_until(self.cycles)?;
            let now = self.session.simulation().cycle() - close;
            if let Some(before) = before {
                while let Some(snapshot) = snapshots.next_if(|snapshot| snapshot.cycle < now) {
                    self.snapshot(&snapshot, &before)?;
                }
            }
            self.record();
            progress.at(cycle);
        }
        progress.finish();
        Ok(Ended::Done)
    }

    fn record(&mut self) {
        let cycle = self.session.simulation().cycle();
        if self.options.history == HistoryChoice::EveryStep || cycle.fract() == 0.0 {
            self.history.record(&self.session);
        }
    }

    /// Writes the state at a cycle at or after the one where `session` stands.
    fn snapshot(&self, snapshot: &CycleAsGiven, session: &Session) -> Result<PathBuf> {
        let simulation = session.simulation();
        let name = format!("state-{}.csv", snapshot.spelling);
        let table = if snapshot.cycle > simulation.cycle() + simulation.rounding() {
            let mut glimpse = session.clone();
            glimpse.advance_to(snapshot.cycle)?;
            state::table(&glimpse)
        } else {
            state::table(session)
        };
        Ok(self.directory.write(&name, table.as_bytes())?)
    }

    fn write_end(&mut self) -> Result<()> {
        self.history.record(&self.session);
        let snapshot_at = match &self.options.snapshot_at {
            Some(given) => given.iter().map(|snapshot| snapshot.cycle).collect(),
            None => self.session.loaded().run().snapshot_at.clone(),
        };
        let scenario = self.session.as_run(snapshot_at);
        self.directory
            .write("scenario.toml", scenario.to_toml().as_bytes())?;
        self.directory
            .write("history.csv", self.history.table(&self.session).as_bytes())?;
        self.directory
            .write("state.csv", state::table(&self.session).as_bytes())?;
        Ok(())
    }

    fn summarize(&self) -> Result<()> {
        let moment = self.session.simulation().moment();
        let mut out = io::stdout().lock();
        if self.options.json {
            let mut summary = serde_json::to_value(moment)?;
            summary["directory"] = self.directory.path().display().to_string().into();
            writeln!(out, "{summary}")?;
            return Ok(());
        }
        writeln!(
            out,
            "{}: {} cycles",
            self.session.scenario().title(),
            number(moment.cycle)
        )?;
        writeln!(
            out,
            "  contact radius          {:.4e} m",
            moment.contact_radius
        )?;
        if let Some(radius) = moment.permanent_stick_radius {
            writeln!(out, "  permanent stick radius  {radius:.4e} m")?;
        }
        writeln!(
            out,
            "  worn volume             {:.4e} m3",
            moment.wear_volume
        )?;
        writeln!(
            out,
            "  dissipated energy       {:.4e} J",
            moment.dissipated_energy
        )?;
        if let Some(residual) = moment.energy_residual {
            writeln!(
                out,
                "  energy residual         {residual:.1e}   (1 - V/(k E_d))"
            )?;
        }
        writeln!(
            out,
            "  files in                {}",
            printable(&self.directory.path().display().to_string())
        )?;
        Ok(())
    }
}
