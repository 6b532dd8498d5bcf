//! `mdr-tui run`: the simulation without a screen.
//!
//! What its parts need is imported here, and they begin with `use super::*`.

use std::fs;
use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Result, anyhow};

use super::args::{CycleAsGiven, Run};
use super::job::RunJob;
use super::progress::Progress;
use super::{FAILED, accuracy, complain, provenance, stop};
use crate::export::autosave::{Autosave, Recent};
use crate::export::file::{WriteError, shell_word, write_whole_with};
use crate::export::header::{self, number};
use crate::export::run_directory::RunDirectory;
use crate::export::{field, last_loop, state};
use crate::panics::locked;
use crate::scenario::session::{Session, SessionError};
use crate::scenario::{Scenario, checkpoint, printable};
use crate::studies::refinement;

mod begin;
mod summary;

use summary::remarks;

/// Polling interval for signals.
const GLANCE: Duration = Duration::from_millis(20);

/// Longest wait for the current step to end after a signal.
const STEP_TIMEOUT: Duration = Duration::from_millis(500);

/// Time between attempts to write rows to a full disk.
const ANOTHER_TRY: Duration = Duration::from_secs(1);

/// Runs or resumes a scenario and writes its files.
pub fn run(options: &Run) -> Result<ExitCode> {
    let stop = stop::signal()?;
    let go_on = || !stop.load(Ordering::Relaxed);
    let mut job = match (&options.resume, &options.scenario) {
        (Some(path), _) => Job::resume(options, path)?,
        (None, scenario) => Job::start(options, scenario.as_deref().unwrap_or_default(), &go_on)?,
    };
    let remark = |line: &String| {
        if !options.quiet {
            complain(line);
        }
    };
    let told = remarks(&job.session);
    told.iter().for_each(remark);
    let is_over = job.watch(Arc::clone(&stop));
    // A bug must not destroy hours of computing.
    let outcome = catch_unwind(AssertUnwindSafe(|| job.advance(&go_on)));
    while is_over.swap(true, Ordering::SeqCst) {
        // The copy is being saved, and the process ends.
        thread::park();
    }
    let outcome = outcome.unwrap_or_else(|_| Ok(Some(job.go_back())));
    if matches!(outcome, Ok(Some(_))) {
        locked(&job.safe).save(&job.session, &job.job);
    }
    // What has come up during the run; the same warning may have got another cycle.
    let now = remarks(&job.session);
    if now.len() > told.len() {
        let new = now.iter().filter(|line| !told.contains(line));
        new.for_each(remark);
    }
    if options.estimate_error && matches!(outcome, Ok(None)) {
        job.estimate(&go_on);
    }
    // Saves what was computed, whatever happened.
    if let Err(error) = job.write_end() {
        // The directory was writable when the run began, so this is a failure, not misuse. A checkpoint may go
        // elsewhere.
        locked(&job.safe).save_silently(&job.session, &job.job);
        return Err(anyhow!("{error}; {}", job.how_to_resume()));
    }
    if matches!(outcome, Ok(None) | Err(_)) {
        job.directory.close()?;
    }
    // Everything is done: blocking on the reader of the summary must not need a second signal.
    stop.store(true, Ordering::SeqCst);
    let directory = job.directory.path().display();
    match outcome {
        Ok(None) => {
            if options.json {
                job.print_json()?;
            } else if !options.quiet {
                job.summarize()?;
            }
            Ok(ExitCode::SUCCESS)
        }
        Ok(Some(why)) => Err(anyhow!("{why}; {}", job.how_to_resume())),
        Err(error) => Err(error.context(format!("{} (saved in {directory})", job.name))),
    }
}

/// What survives the run: a copy in memory, and a checkpoint on disk.
struct Safe {
    checkpoints: Autosave,
    /// The run a moment ago.
    copy: Recent<(Session, RunJob)>,
}

impl Safe {
    /// Writes a checkpoint. If that fails, the user is told once and the run continues.
    fn save(&mut self, session: &Session, job: &RunJob) {
        if let Some(word) = self.save_silently(session, job) {
            complain(&word);
        }
    }

    fn save_silently(&mut self, session: &Session, job: &RunJob) -> Option<String> {
        let checkpoint = checkpoint::encode(session, Some(job));
        self.checkpoints.save(session, &checkpoint)
    }

    /// Says how to resume a run that stopped at the cycle `now`, and which cycles are lost.
    fn how_to_resume(&self, now: f64) -> String {
        let Some((path, cycle)) = self.checkpoints.kept() else {
            return "there is no checkpoint".into();
        };
        let path = shell_word(path);
        if cycle == now {
            return format!("resume with: mdr-tui run --resume {path}");
        }
        let (cycle, now) = (number(cycle), number(now));
        format!(
            "resume from cycle {cycle} with: mdr-tui run --resume {path} (cycles up to {now} could not be saved)"
        )
    }
}

struct Job<'a> {
    options: &'a Run,
    /// What messages call the run.
    name: String,
    session: Session,
    job: RunJob,
    directory: RunDirectory,
    safe: Arc<Mutex<Safe>>,
    /// When writing the rows of the history last failed.
    unwritten: Option<Instant>,
    /// Snapshots that could not be written when their cycle came, to be tried again at the end.
    owed: Vec<(String, String)>,
}

impl Job<'_> {
    /// Estimates the error at the end, which the headers of the files then state. An accuracy has stated it before.
    fn estimate(&mut self, go_on: &dyn Fn() -> bool) {
        if !self.job.statements.is_empty() {
            return;
        }
        match accuracy::estimated(&self.session, go_on) {
            Ok(statements) => {
                self.session.state(statements);
                self.restate();
            }
            Err(word) => complain(&word),
        }
    }

    /// The snapshots state what the run states at its end, as they do where its `scenario.toml` is run again.
    fn restate(&mut self) {
        let line = |(key, value): &(String, String)| header::line(key, value);
        let stated: String = self.session.statements().iter().map(line).collect();
        for name in self.job.snapshots.iter().map(file_of) {
            let is_owed = self.owed.iter().any(|(owed, _)| *owed == name);
            let written = fs::read_to_string(self.directory.path().join(&name));
            if let (false, Ok(table)) = (is_owed, written) {
                self.owed.push((name, table));
            }
        }
        let unmeasured = header::line(header::UNMEASURED.0, header::UNMEASURED.1);
        for (_, table) in &mut self.owed {
            *table = table.replacen(&unmeasured, &stated, 1);
        }
    }

    /// Saves the copy and ends the process if a signal arrives during a step that takes too long.
    /// Whoever sets the returned flag first ends the run.
    fn watch(&self, stop: Arc<AtomicBool>) -> Arc<AtomicBool> {
        let is_over = Arc::new(AtomicBool::new(false));
        let (safe, over) = (Arc::clone(&self.safe), Arc::clone(&is_over));
        thread::spawn(move || {
            while !stop.load(Ordering::Relaxed) {
                thread::sleep(GLANCE);
            }
            thread::sleep(STEP_TIMEOUT);
            if over.swap(true, Ordering::SeqCst) {
                return;
            }
            let mut safe = locked(&safe);
            let (session, job) = safe.copy.get().clone();
            safe.save(&session, &job);
            let cycle = session.simulation().cycle();
            let (at, hint) = (number(cycle), safe.how_to_resume(cycle));
            complain(&format!(
                "interrupted at cycle {at}, in the middle of a long step; {hint}"
            ));
            std::process::exit(FAILED.into());
        });
        is_over
    }

    /// Steps to the end, taking snapshots on the way. Returns where it was interrupted, if it was.
    fn advance(&mut self, go_on: &dyn Fn() -> bool) -> Result<Option<String>> {
        let end = self.job.cycles;
        let progress = Progress::new(end, self.options.quiet);
        // A bug leaves this one behind, and the copy takes its place.
        let mut session = self.session.clone();
        let (mut before, mut outcome) = (None, Ok(()));
        let goal = session.heading(end);
        let ended = session.advance_towards(goal, end, |session| {
            outcome = self.step_is_over(session, &mut before);
            progress.at(session.simulation().cycle());
            outcome.is_ok() && go_on()
        });
        self.session = session;
        outcome?;
        match ended {
            Err(SessionError::Interrupted) => {
                let cycle = number(self.session.simulation().cycle());
                let place = self.directory.path().display();
                Ok(Some(format!(
                    "interrupted at cycle {cycle}; saved in {place}"
                )))
            }
            ended => Ok(ended.map(|()| None)?),
        }
    }

    /// Takes the snapshots that are due, records the moment and saves what is due. `before` is the session before
    /// the step, where a snapshot may lie within it.
    fn step_is_over(&mut self, session: &Session, before: &mut Option<Session>) -> Result<()> {
        let simulation = session.simulation();
        let (cycle, close) = (simulation.cycle(), simulation.rounding());
        if let Some(before) = before.take() {
            self.take_snapshots(&before, cycle - close)?;
        }
        self.job.record(session);
        self.checkpoint_if_due(session);
        self.take_snapshots(session, cycle + close)?;
        if cycle < self.job.cycles {
            crate::failpoint::hit("run");
            // Far enough for a first checkpoint.
            if cycle > 500.0 {
                crate::failpoint::stall("long step");
            }
        }
        let reach = match simulation.may_jump() {
            true => f64::INFINITY,
            false => simulation.next_moment(),
        };
        // A copy between two steps takes a fraction of a step and does not change the run.
        *before = self.job.has_snapshot_before(reach).then(|| session.clone());
        Ok(())
    }

    /// Keeps a copy in memory and a checkpoint on disk up to date.
    fn checkpoint_if_due(&mut self, session: &Session) {
        let mut safe = locked(&self.safe);
        safe.copy.refresh(|| (session.clone(), self.job.clone()));
        if self.unwritten.is_none_or(|at| at.elapsed() >= ANOTHER_TRY) {
            // Rows that cannot be written stay in memory.
            let written = self.job.history.spill(&self.directory.rows());
            self.unwritten = written.is_err().then(Instant::now);
        }
        if safe.checkpoints.is_due() {
            safe.save(session, &self.job);
        }
    }

    /// After a bug, goes back to the copy: the interrupted step has left half a state.
    fn go_back(&mut self) -> String {
        let (session, job) = locked(&self.safe).copy.get().clone();
        self.session = session;
        self.job.rewind(&job);
        let cycle = number(self.session.simulation().cycle());
        let word = crate::panics::take_message().unwrap_or_default();
        format!("bug in mdr-tui: {word}; saved at cycle {cycle}")
    }

    /// Says how to resume a run that has stopped.
    fn how_to_resume(&self) -> String {
        locked(&self.safe).how_to_resume(self.session.simulation().cycle())
    }

    /// Takes the snapshots that are due before the cycle `end` and not before `session`. Those that cannot be
    /// written are tried again at the end.
    fn take_snapshots(&mut self, session: &Session, end: f64) -> Result<()> {
        while let Some(snapshot) = self.job.next_snapshot(end) {
            let (name, table) = (file_of(&snapshot), table_at(&snapshot, session)?);
            if let Err(error) = self.directory.write(&name, &table) {
                let hint = "the run continues and tries again at its end";
                complain(&format!("{error}; {hint}"));
                self.owed.push((name, table));
            }
        }
        Ok(())
    }

    /// Writes the final files, as many as possible.
    fn write_end(&mut self) -> Result<(), WriteError> {
        let (session, job) = (&self.session, &self.job);
        let rows = self.directory.rows();
        let file = self.directory.path().join("history.csv");
        let mut outcome = write_whole_with(&file, |out| job.history.write(session, &rows, out));
        let simulation = session.simulation();
        let is_done = simulation.cycle() + simulation.rounding() >= job.cycles;
        let last_loop = is_done.then(|| last_loop::file(session)).flatten();
        let field = self.options.field.then(|| field::table(session));
        let scenario = session.as_run(job.snapshot_at()).to_toml();
        let files = [
            ("scenario.toml", Some(scenario)),
            ("state.csv", Some(state::table(session))),
            (provenance::FILE, Some(provenance::text())),
            ("loop.csv", last_loop),
            ("field.csv", field),
        ];
        let owed = self.owed.iter().map(|(name, table)| (name.as_str(), table));
        let files = files.iter();
        let files = files.filter_map(|(name, text)| Some((*name, text.as_ref()?)));
        for (name, text) in owed.chain(files) {
            outcome = outcome.and(self.directory.write(name, text));
        }
        outcome
    }
}

/// The table of the state at a cycle that `session` has reached or is yet to reach.
fn table_at(snapshot: &CycleAsGiven, session: &Session) -> Result<String> {
    let simulation = session.simulation();
    if snapshot.cycle() <= simulation.cycle() + simulation.rounding() {
        return Ok(state::table(session));
    }
    let mut glimpse = session.clone();
    glimpse.advance_to(snapshot.cycle())?;
    Ok(state::table(&glimpse))
}

/// The name of a snapshot's file.
fn file_of(snapshot: &CycleAsGiven) -> String {
    format!("state-{}.csv", snapshot.0)
}
