//! `mdr-tui run`: the simulation without a screen.

use std::fs;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use anyhow::{Result, anyhow};

use super::args::{CycleAsGiven, RunOptions};
use super::job::{RunJob, file_of};
use super::progress::{self, Bar};
use super::{FAILED, UNFINISHED, accuracy, complain, stop};
use crate::export::autosave::{Autosave, Work};
use crate::export::file::WriteError;
use crate::export::header;
use crate::export::run_folder::RunFolder;
use crate::export::{field, last_loop, provenance, state};
use crate::math::number::exact;
use crate::panics::locked;
use crate::reading::Errors;
use crate::scenario::checkpoint;
use crate::scenario::session::{Session, SessionError};

mod begin;
mod summary;

use summary::remarks;

/// Longest wait for the current step to end after a signal.
const STEP_TIMEOUT: Duration = Duration::from_millis(400);

/// Time between attempts to write rows to a full disk.
const ANOTHER_TRY: Duration = Duration::from_secs(1);

/// Runs or resumes a scenario and writes its files.
pub fn run(options: &RunOptions) -> Result<ExitCode> {
    let (begun, stop) = (Instant::now(), stop::signal()?);
    let phase = Arc::new(Mutex::new(Phase::Starting));
    let at_signal = Arc::clone(&phase);
    stop::after(&stop, STEP_TIMEOUT, move || end_at_once(&at_signal));
    let is_asked_to_go_on = || !stop.load(Ordering::Relaxed);
    let budget = options.budget.unwrap_or(f64::INFINITY);
    let is_in_time = || begun.elapsed().as_secs_f64() < budget;
    let why_stop = || match (is_asked_to_go_on(), is_in_time()) {
        (true, true) => None,
        (false, _) => Some("interrupted"),
        (true, false) => Some("budget spent"),
    };
    let mut job = match (&options.resume, &options.scenario) {
        (Some(path), _) => Job::resume(options, path)?,
        (None, scenario) => {
            let name = scenario.as_deref().unwrap_or_default();
            Job::start(options, name, &is_asked_to_go_on)?
        }
    };
    let remark = |line: &String| {
        if !options.quiet {
            complain(line);
        }
    };
    let remarks_before = remarks(&job.session);
    remarks_before.iter().for_each(remark);
    *locked(&phase) = Phase::Running(Arc::clone(&job.autosave));
    // A bug must not destroy hours of computing.
    let outcome = catch_unwind(AssertUnwindSafe(|| job.advance(&why_stop)));
    *locked(&phase) = Phase::Over;
    let is_bug = outcome.is_err();
    let outcome = outcome.unwrap_or_else(|_| Ok(Some(job.go_back())));
    if matches!(outcome, Ok(Some(_))) {
        save(&mut locked(&job.autosave), &job.work());
    }
    // Shows what has come up during the run; the same warning may now name another cycle.
    let now = remarks(&job.session);
    if now.len() > remarks_before.len() {
        let new = now.iter().filter(|line| !remarks_before.contains(line));
        new.for_each(remark);
    }
    if job.job.estimates && matches!(outcome, Ok(None)) {
        job.estimate(&|| why_stop().is_none());
    }
    // Saves what was computed, whatever happened.
    if let Err(error) = job.write_end() {
        // The directory was writable when the run began, so this is a failure, not misuse. A checkpoint may still be
        // saved elsewhere.
        locked(&job.autosave).save(&job.work());
        return Err(anyhow!("{error}; {}", job.how_to_resume()));
    }
    if matches!(outcome, Ok(None) | Err(_)) {
        job.folder.close()?;
    }
    stop::nothing_is_left_to_save();
    let folder = job.folder.path().display();
    match outcome {
        Ok(None) => {
            if options.json {
                job.print_json()?;
            } else if !options.quiet {
                job.summarize()?;
            }
            Ok(ExitCode::SUCCESS)
        }
        Ok(Some(why)) => {
            complain(&format!("{why}; {}", job.how_to_resume()));
            // After a bug, the same command would fail at the same place.
            let can_resume = !is_bug && locked(&job.autosave).kept().is_some();
            Ok(ExitCode::from(if can_resume { UNFINISHED } else { FAILED }))
        }
        Err(error) => Err(error.context(format!("{} (saved in {folder})", job.name))),
    }
}

/// The session, and what the run still has to do.
type RunState = (Session, RunJob);

impl Work for RunState {
    fn session(&self) -> &Session {
        &self.0
    }

    fn checkpoint(&self) -> Vec<u8> {
        checkpoint::encode(&self.0, Some(&self.1))
    }
}

/// What a signal finds that comes during a long step, or during a search before the first one.
enum Phase {
    Starting,
    Running(Arc<Mutex<Autosave<RunState>>>),
    Over,
}

/// Saves the copy of a run in the middle of a step and ends the process. The run waits for the lock meanwhile.
fn end_at_once(phase: &Mutex<Phase>) {
    match &*locked(phase) {
        Phase::Starting => {
            complain("interrupted before the first step: nothing is computed yet");
            stop::exit(FAILED);
        }
        Phase::Running(autosave) => {
            let mut autosave = locked(autosave);
            let copy = autosave.copy().clone();
            save(&mut autosave, &copy);
            let cycle = copy.session().simulation().cycle();
            let (at, hint) = (exact(cycle), autosave.how_to_resume(cycle));
            complain(&format!(
                "interrupted at cycle {at}, in the middle of a long step; {hint}"
            ));
            let is_kept = autosave.kept().is_some();
            stop::exit(if is_kept { UNFINISHED } else { FAILED });
        }
        Phase::Over => {}
    }
}

/// Writes a checkpoint. If that fails, tells the user once; the run continues.
fn save(autosave: &mut Autosave<RunState>, state: &RunState) {
    if let Some(word) = autosave.save(state) {
        complain(&word);
    }
}

struct Job<'a> {
    options: &'a RunOptions,
    /// The name of the run in messages.
    name: String,
    session: Session,
    job: RunJob,
    folder: RunFolder,
    autosave: Arc<Mutex<Autosave<RunState>>>,
    /// When writing the rows of the history last failed.
    unwritten: Option<Instant>,
    /// Snapshots that could not be written at their cycle and are tried again at the end.
    owed: Vec<(String, String)>,
}

impl Job<'_> {
    /// Estimates the error at the end for the headers of the files, unless a search for an accuracy has already stated
    /// it.
    fn estimate(&mut self, go_on: &dyn Fn() -> bool) {
        if self.job.errors != Errors::default() {
            return;
        }
        match accuracy::estimated(&self.session, go_on) {
            Ok(errors) => {
                self.session.state(errors);
                self.update_snapshot_headers();
            }
            Err(word) => complain(&word),
        }
    }

    /// Copies the errors stated at the end into the snapshots' headers, as if the run's `scenario.toml` had been run
    /// again.
    fn update_snapshot_headers(&mut self) {
        let lines = self.session.errors().entries();
        let stated: String = lines
            .map(|(key, value)| header::line(key, &value))
            .collect();
        for name in self.job.snapshot_files() {
            let is_owed = self.owed.iter().any(|(owed, _)| *owed == name);
            let written = fs::read_to_string(self.folder.path().join(&name));
            if let (false, Ok(table)) = (is_owed, written) {
                self.owed.push((name, table));
            }
        }
        let unmeasured = header::line(header::UNMEASURED.0, header::UNMEASURED.1);
        for (_, table) in &mut self.owed {
            *table = table.replacen(&unmeasured, &stated, 1);
        }
    }

    /// Steps to the end, taking snapshots on the way, until there is a reason to stop. Returns why and where it stopped
    /// early.
    fn advance(&mut self, why_stop: &dyn Fn() -> Option<&'static str>) -> Result<Option<String>> {
        let end = self.job.cycles;
        let progress = Bar::new("cycle", end, progress::TIMES, self.options.quiet);
        // A bug may leave this clone half-stepped; the copy then replaces it.
        let mut session = self.session.clone();
        let (mut before, mut outcome) = (None, Ok(()));
        let goal = session.heading(end);
        let ended = session.advance_towards(goal, end, |session| {
            outcome = self.step_is_over(session, &mut before);
            progress.set_position(session.simulation().cycle());
            outcome.is_ok() && why_stop().is_none()
        });
        self.session = session;
        outcome?;
        match ended {
            Err(SessionError::Interrupted) => {
                let cycle = exact(self.session.simulation().cycle());
                let place = self.folder.path().display();
                let why = why_stop().unwrap_or("interrupted");
                Ok(Some(format!("{why} at cycle {cycle}; saved in {place}")))
            }
            ended => Ok(ended.map(|()| None)?),
        }
    }

    /// Takes the snapshots that are due, records the moment and saves if due. `before` is the session before the step,
    /// if a snapshot may lie within the step.
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
        let reach = if simulation.may_jump() {
            f64::INFINITY
        } else {
            simulation.next_moment()
        };
        // A copy between two steps costs a fraction of a step and does not change the run.
        *before = self.job.next_snapshot(reach).map(|_| session.clone());
        Ok(())
    }

    /// Keeps a copy in memory and a checkpoint on disk up to date.
    fn checkpoint_if_due(&mut self, session: &Session) {
        let is_time = |at: Instant| at.elapsed() >= ANOTHER_TRY;
        if self.job.history.is_full() && self.unwritten.is_none_or(is_time) {
            // Rows that cannot be written stay in memory.
            let rows = self.folder.check().map(|()| self.folder.rows());
            let is_written = rows.is_ok_and(|rows| self.job.history.spill(&rows).is_ok());
            self.unwritten = (!is_written).then(Instant::now);
        }
        let progress = || (session.clone(), self.job.clone());
        let word = locked(&self.autosave).update(session, progress);
        word.iter().for_each(|word| complain(word));
    }

    fn work(&self) -> RunState {
        (self.session.clone(), self.job.clone())
    }

    /// After a bug, returns to the copy, because the interrupted step has left an inconsistent state.
    fn go_back(&mut self) -> String {
        let (session, job) = locked(&self.autosave).copy().clone();
        self.session = session;
        self.job.rewind(&job);
        let cycle = exact(self.session.simulation().cycle());
        let word = crate::panics::take_message().unwrap_or_default();
        format!("bug in mdr-tui: {word}; saved at cycle {cycle}")
    }

    /// Says how to resume a run that has stopped.
    fn how_to_resume(&self) -> String {
        locked(&self.autosave).how_to_resume(self.session.simulation().cycle())
    }

    /// Takes the snapshots that are due from the cycle of `session` to the cycle `end`. Those that cannot be written
    /// are tried again at the end.
    fn take_snapshots(&mut self, session: &Session, end: f64) -> Result<()> {
        while let Some(snapshot) = self.job.next_snapshot(end) {
            let (name, table) = (file_of(snapshot), table_at(snapshot, session)?);
            self.job.snapshot_is_done();
            if let Err(error) = self.folder.write(&name, &table) {
                let hint = "the run continues and tries again at its end";
                complain(&format!("{error}; {hint}"));
                self.owed.push((name, table));
            }
        }
        Ok(())
    }

    /// Writes as many of the final files as possible.
    fn write_end(&mut self) -> Result<(), WriteError> {
        let (session, job) = (&self.session, &self.job);
        let rows = self.folder.rows();
        let history = |out: &mut dyn io::Write| job.history.write(session, &rows, out);
        let mut outcome = self.folder.write_with("history.csv", history);
        let simulation = session.simulation();
        let is_done = simulation.cycle() + simulation.rounding() >= job.cycles;
        let last_loop = is_done.then(|| last_loop::file(session)).flatten();
        let field = job.field.then(|| field::file(session));
        let scenario = session.as_run(job.snapshot_at()).to_toml();
        let files = [
            ("scenario.toml", Some(scenario)),
            ("state.csv", Some(state::table(session))),
            (provenance::FILE, Some(job.provenance().text())),
            ("loop.csv", last_loop),
            ("field.csv", field),
        ];
        let owed = self.owed.iter().map(|(name, table)| (name.as_str(), table));
        let made = files.iter();
        let made = made.filter_map(|(name, text)| Some((*name, text.as_ref()?)));
        for (name, text) in owed.chain(made) {
            outcome = outcome.and(self.folder.write(name, text));
        }
        outcome
    }
}

/// Returns the table of the state at a cycle that `session` has reached or has yet to reach.
fn table_at(snapshot: &CycleAsGiven, session: &Session) -> Result<String> {
    let simulation = session.simulation();
    if snapshot.cycle() <= simulation.cycle() + simulation.rounding() {
        return Ok(state::table(session));
    }
    let mut glimpse = session.clone();
    glimpse.advance_to(snapshot.cycle())?;
    Ok(state::table(&glimpse))
}
