//! `mdr-tui run`: the simulation without a screen.

use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use anyhow::{Context, Result, anyhow};

use super::args::{CycleAsGiven, Run};
use super::errand::{Errand, Mark};
use super::progress::Progress;
use super::{FAILED, complain, stop};
use crate::export::file::{
    RUN_CHECKPOINT, RunDirectory, WriteError, free_directory, shell_word, write_whole,
};
use crate::export::header::number;
use crate::export::keep::{self, COPY_INTERVAL, Keeper};
use crate::export::state;
use crate::scenario::checkpoint;
use crate::scenario::session::Session;
use crate::scenario::{Scenario, printable};
use crate::tui::panics;

/// Runs a scenario, or goes on with one, and writes its files.
pub fn run(options: &Run) -> Result<ExitCode> {
    let mut job = match (&options.resume, &options.scenario) {
        (Some(path), _) => Job::resume(options, path)?,
        (None, scenario) => Job::start(options, scenario.as_deref().unwrap_or_default())?,
    };
    if let Some(why) = job.session.simulation().why_never_jumped()
        && !options.quiet
    {
        complain(&format!("every cycle is stepped directly: {why}"));
    }
    let stop = stop::signal()?;
    panics::keep();
    // A defect must not take hours of computing with it.
    let outcome = catch_unwind(AssertUnwindSafe(|| job.advance(&stop)));
    let outcome = outcome.unwrap_or_else(|_| Ok(Ended::Broken(job.go_back())));
    if matches!(outcome, Ok(Ended::Interrupted | Ended::Broken(_))) {
        job.put_away();
    }
    // Whatever happened, what was computed is kept.
    if let Err(error) = job.write_end() {
        // The directory was good when the run began: this is a failure, not misuse.
        return Err(anyhow!("{error}; {}", job.rescue()));
    }
    if matches!(outcome, Ok(Ended::Done) | Err(_)) {
        job.directory.close()?;
    }
    match outcome {
        Ok(Ended::Done) => {
            if !options.quiet {
                job.summarize(options.json)?;
            }
            Ok(ExitCode::SUCCESS)
        }
        Ok(Ended::Interrupted) => {
            let cycle = number(job.session.simulation().cycle());
            complain(&format!(
                "interrupted at cycle {cycle}; kept in {}; {}",
                job.directory.path().display(),
                job.way_on()
            ));
            Ok(ExitCode::from(FAILED))
        }
        Ok(Ended::Broken(word)) => Err(anyhow!("{word}; {}", job.way_on())),
        Err(error) => Err(error.context(format!(
            "{} (kept in {})",
            job.name,
            job.directory.path().display()
        ))),
    }
}

enum Ended {
    Done,
    Interrupted,
    /// By a defect, as told.
    Broken(String),
}

struct Job {
    /// What messages call the run.
    name: String,
    session: Session,
    errand: Errand,
    directory: RunDirectory,
    keeper: Keeper,
    /// Whether the user knows that checkpoints fail.
    has_warned: bool,
    /// The run a moment ago, and the moment.
    copy: (Session, Mark),
    copied: Instant,
    /// Snapshots that could not be written when their cycle came, to be tried again at the end.
    owed: Vec<(String, String)>,
    quiet: bool,
}

impl Job {
    fn start(options: &Run, name: &str) -> Result<Self> {
        let mut scenario = Scenario::load(name, &options.changes.set)?;
        if let Some(cycles) = options.cycles
            && scenario.value("numerics.accuracy").is_some()
        {
            // An accuracy chooses by the length of this run.
            scenario = scenario.with("run.cycles", &cycles.to_string())?;
        }
        let errand = Errand::new(options, &scenario, name)?;
        let session = Session::start(scenario).with_context(|| printable(name))?;
        let path = options.out.clone();
        let path = path.unwrap_or_else(|| new_directory(&session));
        let directory = RunDirectory::claim(&path, options.force)?;
        Ok(Self::new(name, session, errand, directory, options))
    }

    /// Goes on where a run was put away: in its own directory, or in another one, into which the
    /// snapshots that it has written are copied.
    fn resume(options: &Run, file: &Path) -> Result<Self> {
        let name = printable(&file.display().to_string());
        let kept = checkpoint::read::<Errand>(file)?;
        let session = kept.session;
        let errand = Errand::resumed(kept.errand, &session, options.cycles, &name)?;
        let home = file.parent().map(|home| match home.as_os_str().is_empty() {
            true => Path::new("."),
            false => home,
        });
        let home = home.filter(|_| file.file_name().is_some_and(|name| name == RUN_CHECKPOINT));
        let path = match (&options.out, home) {
            (Some(out), _) => out.clone(),
            (None, Some(home)) => home.to_owned(),
            (None, None) => new_directory(&session),
        };
        let real = |path: &Path| path.canonicalize().ok();
        let directory = match home {
            Some(home) if real(home) == real(&path) => RunDirectory::reopen(&path)?,
            _ => RunDirectory::claim(&path, options.force)?,
        };
        for snapshot in errand.taken() {
            let (name, home) = (file_of(&snapshot), home.unwrap_or(Path::new(".")));
            let (from, to) = (home.join(&name), directory.path().join(&name));
            if to.exists() {
                continue;
            }
            match std::fs::read(&from) {
                Ok(table) => write_whole(&to, &table)?,
                Err(_) => complain(&format!("{}: is not there any more", from.display())),
            }
        }
        Ok(Self::new(&name, session, errand, directory, options))
    }

    fn new(
        name: &str,
        session: Session,
        errand: Errand,
        directory: RunDirectory,
        options: &Run,
    ) -> Self {
        Self {
            name: name.to_owned(),
            keeper: Keeper::new(directory.checkpoint(), options.checkpoint_every.0),
            directory,
            has_warned: false,
            copy: (session.clone(), errand.mark()),
            session,
            errand,
            copied: Instant::now(),
            owed: Vec::new(),
            quiet: options.quiet,
        }
    }

    /// Steps to the end, taking snapshots on the way.
    fn advance(&mut self, stop: &AtomicBool) -> Result<Ended> {
        let mut progress = Progress::new(self.errand.cycles, self.quiet);
        self.errand.record(&self.session);
        loop {
            let simulation = self.session.simulation();
            let (cycle, close) = (simulation.cycle(), simulation.rounding());
            while let Some(snapshot) = self.errand.next_snapshot(cycle + close) {
                let table = table_at(&snapshot, &self.session)?;
                self.keep_snapshot(&snapshot, table);
            }
            if cycle >= self.errand.cycles {
                break;
            }
            if stop.load(Ordering::Relaxed) {
                progress.finish();
                return Ok(Ended::Interrupted);
            }
            #[cfg(debug_assertions)]
            crate::tui::fault::strike("run");
            let simulation = self.session.simulation();
            let reach = if simulation.may_jump() {
                f64::INFINITY
            } else {
                simulation.next_moment()
            };
            // Between two steps a copy takes the fraction of a step: looking does not change the run.
            let copied = self.errand.has_snapshot_before(reach);
            let before = copied.then(|| self.session.clone());
            self.session.step_until(self.errand.cycles)?;
            let now = self.session.simulation().cycle() - close;
            if let Some(before) = before {
                while let Some(snapshot) = self.errand.next_snapshot(now) {
                    let table = table_at(&snapshot, &before)?;
                    self.keep_snapshot(&snapshot, table);
                }
            }
            self.errand.record(&self.session);
            self.look_after();
            progress.at(cycle);
        }
        progress.finish();
        Ok(Ended::Done)
    }

    /// Keeps a copy in memory and a checkpoint on the disk up to date.
    fn look_after(&mut self) {
        if self.copied.elapsed() >= COPY_INTERVAL {
            self.copy = (self.session.clone(), self.errand.mark());
            self.copied = Instant::now();
        }
        if self.keeper.is_due() {
            self.put_away();
        }
    }

    /// Writes a checkpoint. Where that fails, the user is told once, and the run goes on.
    fn put_away(&mut self) {
        let bytes = checkpoint::encode(&self.session, Some(&self.errand));
        match self.keeper.keep(&bytes) {
            Ok(()) => self.has_warned = false,
            Err(error) if !self.has_warned => {
                self.has_warned = true;
                complain(&format!("{error}; the run goes on without a checkpoint"));
            }
            Err(_) => {}
        }
    }

    /// After a defect: back to the copy, for a step that was cut short has left half a state.
    fn go_back(&mut self) -> String {
        self.session = self.copy.0.clone();
        self.errand.rewind(self.copy.1);
        let cycle = number(self.session.simulation().cycle());
        let word = panics::word().unwrap_or_default();
        format!("a defect in mdr-tui: {word}; kept at cycle {cycle}")
    }

    /// How to go on with a run that has stopped.
    fn way_on(&self) -> String {
        match self.keeper.path() {
            path if path.exists() => {
                format!("mdr-tui run --resume {} goes on", shell_word(path))
            }
            _ => "there is no checkpoint".into(),
        }
    }

    /// Writes a snapshot. What cannot be written is owed.
    fn keep_snapshot(&mut self, snapshot: &CycleAsGiven, table: String) {
        let name = file_of(snapshot);
        if let Err(error) = self.directory.write(&name, table.as_bytes()) {
            complain(&format!(
                "{error}; the run goes on, to try again at its end"
            ));
            self.owed.push((name, table));
        }
    }

    /// Writes the files of the end; all that can be, where not all can.
    fn write_end(&mut self) -> Result<(), WriteError> {
        let owed = self.owed.iter().cloned();
        let files = [
            (
                "scenario.toml".to_owned(),
                self.session.as_run(self.errand.snapshot_at()).to_toml(),
            ),
            ("history.csv".to_owned(), self.errand.table(&self.session)),
            ("state.csv".to_owned(), state::table(&self.session)),
        ];
        let mut outcome = Ok(());
        for (name, text) in owed.chain(files) {
            let written = self.directory.write(&name, text.as_bytes());
            outcome = outcome.and(written.map(|_| ()));
        }
        outcome
    }

    /// Where the files cannot be written, a checkpoint may: in their place, or where explorers keep
    /// theirs. Says where it is.
    fn rescue(&mut self) -> String {
        let bytes = checkpoint::encode(&self.session, Some(&self.errand));
        let stem = self.session.loaded().stem();
        let elsewhere = || keep::place(&keep::state_directory()?, &stem).ok();
        for path in std::iter::once_with(|| Some(self.directory.checkpoint()))
            .chain(std::iter::once_with(elsewhere))
            .flatten()
        {
            let mut keeper = Keeper::new(path, None);
            if keeper.keep(&bytes).is_ok() {
                self.keeper = keeper;
                return self.way_on();
            }
            // A checkpoint that was kept before is better than none.
            if let Some(keeper) = keeper.if_ever() {
                self.keeper = keeper;
                return self.way_on();
            }
        }
        "there is no checkpoint".into()
    }

    fn summarize(&self, as_json: bool) -> Result<()> {
        let simulation = self.session.simulation();
        let (moment, state) = (simulation.moment(), simulation.state());
        let mut out = io::stdout().lock();
        if as_json {
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
        let (parts, steps) = (state.effort.parts, state.steps);
        if parts > 0 {
            writeln!(
                out,
                "  harsh wear              {parts} parts in {steps} steps   (numerics.stability)"
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

/// The table of the state at a cycle at or after the one where `session` stands.
fn table_at(snapshot: &CycleAsGiven, session: &Session) -> Result<String> {
    let simulation = session.simulation();
    if snapshot.cycle <= simulation.cycle() + simulation.rounding() {
        return Ok(state::table(session));
    }
    let mut glimpse = session.clone();
    glimpse.advance_to(snapshot.cycle)?;
    Ok(state::table(&glimpse))
}

/// A directory that is not there yet, named after the scenario.
fn new_directory(session: &Session) -> PathBuf {
    free_directory(&format!("{}-run", session.loaded().stem()))
}

/// The name of a snapshot's file.
fn file_of(snapshot: &CycleAsGiven) -> String {
    format!("state-{}.csv", snapshot.spelling)
}
