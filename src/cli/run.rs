//! `mdr-tui run`: the simulation without a screen.

use std::fs;
use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, anyhow, bail};

use super::args::{CycleAsGiven, Run};
use super::job::RunJob;
use super::progress::Progress;
use super::{FAILED, accuracy, complain, provenance, stop};
use crate::export::autosave::{Autosave, Recent, state_directory};
use crate::export::file::{RUN_CHECKPOINT, RunDirectory, WriteError, shell_word, write_whole};
use crate::export::header::{self, number};
use crate::export::{field, state};
use crate::reading::verdict;
use crate::scenario::checkpoint;
use crate::scenario::session::{Session, SessionError};
use crate::scenario::{Refusal, Scenario, printable};
use crate::studies::refinement;

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
        (None, scenario) => {
            let name = scenario.as_deref().unwrap_or_default();
            Job::start(options, name, &go_on)?
        }
    };
    let remark = |line: String| match options.quiet {
        true => {}
        false => complain(&line),
    };
    let simulation = job.session.simulation();
    let never = simulation.why_never_jumped();
    let never = never.map(|why| format!("no cycle jumps: {why}"));
    let indenter = job.session.scenario().setup().indenter.remark();
    let indenter = indenter.map(|told| format!("indenter: {told}"));
    never.into_iter().chain(indenter).for_each(remark);
    let warned = simulation.warnings();
    warned.iter().cloned().for_each(remark);
    let is_over = job.watch(Arc::clone(&stop));
    // A bug must not destroy hours of computing.
    let outcome = catch_unwind(AssertUnwindSafe(|| job.advance(&go_on)));
    while is_over.swap(true, Ordering::SeqCst) {
        // The copy is being saved, and the process ends.
        thread::park();
    }
    let outcome = outcome.unwrap_or_else(|_| Ok(Ended::Broken(job.go_back())));
    if matches!(outcome, Ok(Ended::Interrupted | Ended::Broken(_))) {
        save(&mut locked(&job.checkpoints), &job.session, &job.job);
    }
    // What has come up during the run; the same warning may have got another cycle.
    let warnings = job.session.simulation().warnings();
    let has_more = warnings.len() > warned.len();
    let new = |line: &String| has_more && !warned.contains(line);
    warnings.into_iter().filter(new).for_each(remark);
    if options.estimate_error && matches!(outcome, Ok(Ended::Done)) {
        job.estimate(&go_on);
    }
    // Saves what was computed, whatever happened.
    if let Err(error) = job.write_end() {
        // The directory was writable when the run began, so this is a failure, not misuse.
        return Err(anyhow!("{error}; {}", job.rescue()));
    }
    if matches!(outcome, Ok(Ended::Done) | Err(_)) {
        job.directory.close()?;
    }
    // Everything is done: blocking on the reader of the summary must not need a second signal.
    stop.store(true, Ordering::SeqCst);
    match outcome {
        Ok(Ended::Done) => {
            if options.json {
                job.print_json()?;
            } else if !options.quiet {
                job.summarize()?;
            }
            Ok(ExitCode::SUCCESS)
        }
        Ok(Ended::Interrupted) => {
            let cycle = number(job.session.simulation().cycle());
            complain(&format!(
                "interrupted at cycle {cycle}; saved in {}; {}",
                job.directory.path().display(),
                job.how_to_resume()
            ));
            Ok(ExitCode::from(FAILED))
        }
        Ok(Ended::Broken(word)) => Err(anyhow!("{word}; {}", job.how_to_resume())),
        Err(error) => Err(error.context(format!(
            "{} (saved in {})",
            job.name,
            job.directory.path().display()
        ))),
    }
}

enum Ended {
    Done,
    Interrupted,
    /// By a bug, with its message.
    Broken(String),
}

struct Job {
    /// What messages call the run.
    name: String,
    session: Session,
    job: RunJob,
    directory: RunDirectory,
    checkpoints: Arc<Mutex<Autosave>>,
    /// The run a moment ago.
    copy: Arc<Mutex<Recent<(Session, RunJob)>>>,
    /// When writing the rows of the history last failed.
    unwritten: Option<Instant>,
    /// Snapshots that could not be written when their cycle came, to be tried again at the end.
    owed: Vec<(String, String)>,
    quiet: bool,
    /// Whether the stresses inside the half-space are wanted.
    field: bool,
}

impl Job {
    fn start(options: &Run, name: &str, go_on: &dyn Fn() -> bool) -> Result<Self> {
        let mut scenario = Scenario::load(name, &options.changes.set)?;
        let mut job = RunJob::new(options, &scenario, name)?;
        if options.budget.is_some() && scenario.accuracy().is_none() {
            let rule = "limits the search for numerics.accuracy, but that key is not set";
            bail!(Refusal::new("--budget", rule));
        }
        let directory = match &options.out {
            Some(path) => RunDirectory::claim(path, options.force)?,
            None => new_directory(&scenario)?,
        };
        if scenario.run().cycles == Some(job.cycles) {
            job.statements = scenario.statements();
        }
        if scenario.accuracy().is_some() {
            let budget = options.budget.unwrap_or(f64::INFINITY);
            let found =
                accuracy::resolve(&scenario, Some(job.cycles), budget, options.quiet, go_on);
            let found = found.with_context(|| printable(name))?;
            scenario = found.scenario;
            job.statements = found.statements;
            if let Some(word) = found.warning {
                complain(&word);
            }
        }
        let session = Session::start(scenario).with_context(|| printable(name))?;
        // Only now, when there is something to put in their place.
        if options.force {
            directory.clear()?;
        }
        Ok(Self::new(name, session, job, None, directory, options))
    }

    /// Resumes a run in its own directory, or in another one, to which the files written so far are
    /// copied.
    fn resume(options: &Run, file: &Path) -> Result<Self> {
        let name = printable(&file.display().to_string());
        let real = |path: &Path| path.canonicalize().ok();
        let elsewhere = |home: &Path| {
            let out = options.out.as_deref();
            out.filter(|out| real(out).is_none() || real(out) != real(home))
        };
        let beside = file.parent().map(|home| match home.as_os_str().is_empty() {
            true => Path::new("."),
            false => home,
        });
        let is_at_home =
            file.is_file() && file.file_name().is_some_and(|name| name == RUN_CHECKPOINT);
        let beside = beside.filter(|_| is_at_home);
        // Only the first process may resume it.
        let claimed = beside.filter(|home| elsewhere(home).is_none());
        let claimed = claimed.map(RunDirectory::reopen).transpose()?;
        let kept = checkpoint::read::<RunJob>(file)?;
        let session = kept.session;
        let mut job = RunJob::resumed(kept.job, &session, options.cycles, &name)?;
        let home = beside.or(job.home()).map(Path::to_owned);
        let directory = match (claimed, &home) {
            (Some(directory), _) => directory,
            (None, Some(home)) if elsewhere(home).is_none() && home.is_dir() => {
                if home.join(RUN_CHECKPOINT).exists() {
                    RunDirectory::reopen(home)?
                } else {
                    RunDirectory::claim(home, options.force)?
                }
            }
            (None, _) => match &options.out {
                Some(out) => RunDirectory::claim(out, options.force)?,
                None => new_directory(session.loaded())?,
            },
        };
        let home = home.as_deref();
        for snapshot in job.taken() {
            let (name, home) = (file_of(&snapshot), home.unwrap_or(Path::new(".")));
            let (from, to) = (home.join(&name), directory.path().join(&name));
            if to.exists() {
                continue;
            }
            match std::fs::read(&from) {
                Ok(table) => write_whole(&to, &table)?,
                Err(_) => complain(&format!("{}: no longer exists", from.display())),
            }
        }
        if let Err(error) = job.move_to(home, directory.path()) {
            let cycle = number(session.simulation().cycle());
            complain(&format!(
                "{name}: the history before cycle {cycle} no longer exists: {error}"
            ));
        }
        Ok(Self::new(
            &name,
            session,
            job,
            Some(file),
            directory,
            options,
        ))
    }

    fn new(
        name: &str,
        session: Session,
        mut job: RunJob,
        from: Option<&Path>,
        directory: RunDirectory,
        options: &Run,
    ) -> Self {
        let mut session = session;
        for (key, value) in &job.statements {
            session.state(key, value);
        }
        let checkpoints = Autosave::new(state_directory(), options.checkpoint_every.0);
        let mut checkpoints = checkpoints.at_home(directory.checkpoint());
        match from {
            Some(file) => checkpoints.remember(file, session.simulation().cycle()),
            None => job.set_home(directory.path()),
        }
        Self {
            name: name.to_owned(),
            checkpoints: Arc::new(Mutex::new(checkpoints)),
            directory,
            copy: Arc::new(Mutex::new(Recent::new((session.clone(), job.clone())))),
            session,
            job,
            unwritten: None,
            owed: Vec::new(),
            quiet: options.quiet,
            field: options.field,
        }
    }

    /// Estimates the error at the end, which the headers of the files then state. An accuracy has stated it before.
    fn estimate(&mut self, go_on: &dyn Fn() -> bool) {
        if !self.job.statements.is_empty() {
            return;
        }
        match accuracy::estimated(&self.session, go_on) {
            Ok(statements) => {
                for (key, value) in statements {
                    self.session.state(&key, &value);
                }
                self.restate();
            }
            Err(word) => complain(&word),
        }
    }

    /// The snapshots state what the run states at its end, as they do where its `scenario.toml` is run again.
    fn restate(&mut self) {
        let unmeasured = header::unmeasured();
        let stated = self.session.statements().iter();
        let stated: String = stated
            .map(|(key, value)| header::line(key, value))
            .collect();
        let due = self.job.snapshots().map(file_of);
        let unwritten = |name: &String| self.owed.iter().all(|(owed, _)| owed != name);
        let written = due.filter(unwritten).filter_map(|name| {
            let table = fs::read_to_string(self.directory.path().join(&name)).ok()?;
            Some((name, table))
        });
        let written: Vec<_> = written.collect();
        self.owed.extend(written);
        for (_, table) in &mut self.owed {
            *table = table.replacen(&unmeasured, &stated, 1);
        }
    }

    /// Saves the copy and ends the process if a signal arrives during a step that takes too long.
    /// Whoever sets the returned flag first ends the run.
    fn watch(&self, stop: Arc<AtomicBool>) -> Arc<AtomicBool> {
        let is_over = Arc::new(AtomicBool::new(false));
        let (copy, checkpoints, over) = (
            Arc::clone(&self.copy),
            Arc::clone(&self.checkpoints),
            Arc::clone(&is_over),
        );
        thread::spawn(move || {
            while !stop.load(Ordering::Relaxed) {
                thread::sleep(GLANCE);
            }
            thread::sleep(STEP_TIMEOUT);
            if over.swap(true, Ordering::SeqCst) {
                return;
            }
            let copy = locked(&copy);
            let (session, job) = copy.get();
            let mut checkpoints = locked(&checkpoints);
            save(&mut checkpoints, session, job);
            let cycle = session.simulation().cycle();
            complain(&format!(
                "interrupted at cycle {}, in the middle of a long step; {}",
                number(cycle),
                how_to_resume(&checkpoints, cycle)
            ));
            std::process::exit(FAILED.into());
        });
        is_over
    }

    /// Steps to the end, taking snapshots on the way.
    fn advance(&mut self, go_on: &dyn Fn() -> bool) -> Result<Ended> {
        let end = self.job.cycles;
        let mut progress = Progress::new(end, self.quiet);
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
        let ended = match ended {
            Ok(()) => Ended::Done,
            Err(SessionError::Interrupted) => Ended::Interrupted,
            Err(error) => return Err(error.into()),
        };
        progress.finish();
        Ok(ended)
    }

    /// Takes the snapshots that are due, records the moment and saves what is due. `before` is the session before
    /// the step, where a snapshot may lie within it.
    fn step_is_over(&mut self, session: &Session, before: &mut Option<Session>) -> Result<()> {
        let simulation = session.simulation();
        let (cycle, close) = (simulation.cycle(), simulation.rounding());
        if let Some(before) = before.take() {
            while let Some(snapshot) = self.job.next_snapshot(cycle - close) {
                let table = table_at(&snapshot, &before)?;
                self.keep_snapshot(&snapshot, table);
            }
        }
        self.job.record(session);
        self.checkpoint_if_due(session);
        while let Some(snapshot) = self.job.next_snapshot(cycle + close) {
            let table = table_at(&snapshot, session)?;
            self.keep_snapshot(&snapshot, table);
        }
        #[cfg(debug_assertions)]
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
        locked(&self.copy).refresh(|| (session.clone(), self.job.clone()));
        if self.unwritten.is_none_or(|at| at.elapsed() >= ANOTHER_TRY) {
            // Rows that cannot be written stay in memory.
            let written = self.job.spill(&self.directory.rows());
            self.unwritten = written.is_err().then(Instant::now);
        }
        if locked(&self.checkpoints).is_due() {
            save(&mut locked(&self.checkpoints), session, &self.job);
        }
    }

    /// After a bug, goes back to the copy: the interrupted step has left half a state.
    fn go_back(&mut self) -> String {
        let copy = locked(&self.copy);
        let (session, job) = copy.get();
        self.session = session.clone();
        self.job.rewind(job);
        drop(copy);
        let cycle = number(self.session.simulation().cycle());
        let word = crate::panics::take_message().unwrap_or_default();
        format!("bug in mdr-tui: {word}; saved at cycle {cycle}")
    }

    /// Says how to resume a run that has stopped.
    fn how_to_resume(&self) -> String {
        how_to_resume(
            &locked(&self.checkpoints),
            self.session.simulation().cycle(),
        )
    }

    /// Writes a snapshot, or remembers to try again at the end.
    fn keep_snapshot(&mut self, snapshot: &CycleAsGiven, table: String) {
        let name = file_of(snapshot);
        if let Err(error) = self.directory.write(&name, table.as_bytes()) {
            complain(&format!(
                "{error}; the run continues and tries again at its end"
            ));
            self.owed.push((name, table));
        }
    }

    /// Writes the final files, as many as possible.
    fn write_end(&mut self) -> Result<(), WriteError> {
        let owed = self.owed.iter().cloned();
        let files = [
            (
                "scenario.toml".to_owned(),
                self.session.as_run(self.job.snapshot_at()).to_toml(),
            ),
            ("state.csv".to_owned(), state::table(&self.session)),
            (provenance::FILE.to_owned(), provenance::text()),
        ];
        let field = self
            .field
            .then(|| ("field.csv".to_owned(), field::table(&self.session)));
        let simulation = self.session.simulation();
        let is_done = simulation.cycle() + simulation.rounding() >= self.job.cycles;
        let last_loop = is_done.then(|| self.job.last_loop(&self.session)).flatten();
        let last_loop = last_loop.map(|table| ("loop.csv".to_owned(), table));
        let rows = self.directory.rows();
        let mut outcome = self.directory.write_with("history.csv", |file| {
            let mut out = io::BufWriter::new(file);
            self.job.write_history(&self.session, &rows, &mut out)?;
            out.flush()
        });
        for (name, text) in owed.chain(files).chain(last_loop).chain(field) {
            let written = self.directory.write(&name, text.as_bytes());
            outcome = outcome.and(written.map(|_| ()));
        }
        outcome
    }

    /// If the files cannot be written, tries a checkpoint in their place or in the directory of the
    /// explorer's checkpoints, and says where it is.
    fn rescue(&mut self) -> String {
        let bytes = checkpoint::encode(&self.session, Some(&self.job));
        locked(&self.checkpoints).save(&self.session, &bytes);
        self.how_to_resume()
    }

    /// The last row of the history and the header of the files, by the names that they have there.
    fn print_json(&self) -> Result<()> {
        let mut summary = serde_json::Map::new();
        for (key, text) in header::entries(&self.session) {
            let value = match text.parse::<f64>() {
                Ok(number) => number.into(),
                Err(_) => text.into(),
            };
            summary.insert(key, value);
        }
        for (name, value) in self.job.values(&self.session) {
            summary.insert(name.into(), value.into());
        }
        let directory = self.directory.path().display().to_string();
        summary.insert("directory".into(), directory.into());
        writeln!(
            io::stdout().lock(),
            "{}",
            serde_json::Value::Object(summary)
        )?;
        Ok(())
    }

    fn summarize(&self) -> Result<()> {
        let simulation = self.session.simulation();
        let (moment, stats) = (simulation.moment(), simulation.stats());
        let mut lines = vec![("contact radius", format!("{:.4e} m", moment.contact_radius))];
        if let Some(radius) = moment.permanent_stick_radius {
            lines.push(("permanent stick radius", format!("{radius:.4e} m")));
        }
        let (volume, work) = (moment.wear_volume, moment.dissipated_energy);
        lines.push(("worn volume", format!("{volume:.4e} m3")));
        lines.push(("dissipated energy", format!("{work:.4e} J")));
        let setup = simulation.setup();
        if let Some(law) = &setup.wear {
            let k = law.coefficient();
            let per_load = k * setup.material.friction() * 1e9;
            let both = format!("{k:.4e} 1/Pa per friction work, {per_load:.4e} mm3/(N m) per load");
            lines.push(("wear coefficient", both));
        }
        if let Some(residual) = moment.energy_residual {
            let residual = format!("{residual:.1e}   (1 - V/(k E_d))");
            lines.push(("energy residual", residual));
        }
        let error = "estimated error";
        let stated = self.session.statements().iter();
        if volume > 0.0 && stated.clone().all(|(key, _)| key != "estimated_error") {
            lines.push((error, "not run (--estimate-error measures it)".into()));
        }
        for (key, value) in stated {
            let words = refinement::words_of(key);
            lines.extend(words.map(|words| (error, format!("{value}   {words}"))));
        }
        if let Some(verdict) = verdict(&simulation.checks()) {
            lines.push(("checks", verdict.trim_start_matches("checks ").to_owned()));
        }
        if stats.parts > 0 {
            let (parts, steps) = (stats.parts, simulation.steps());
            let parts = format!("{parts} sub-steps in {steps} steps   (numerics.stability)");
            lines.push(("stiff wear", parts));
        }
        let directory = self.directory.path().display().to_string();
        lines.push(("files in", printable(&directory)));
        let mut out = io::stdout().lock();
        let title = self.session.scenario().title();
        writeln!(out, "{title}: {} cycles", number(moment.cycle))?;
        for (name, text) in lines {
            writeln!(out, "  {name:<22}  {text}")?;
        }
        Ok(())
    }
}

/// The table of the state at a cycle that `session` has reached or is yet to reach.
fn table_at(snapshot: &CycleAsGiven, session: &Session) -> Result<String> {
    let simulation = session.simulation();
    if snapshot.cycle <= simulation.cycle() + simulation.rounding() {
        return Ok(state::table(session));
    }
    let mut glimpse = session.clone();
    glimpse.advance_to(snapshot.cycle)?;
    Ok(state::table(&glimpse))
}

/// Writes a checkpoint. If that fails, the user is told once and the run continues.
fn save(checkpoints: &mut Autosave, session: &Session, job: &RunJob) {
    if let Some(word) = checkpoints.save(session, &checkpoint::encode(session, Some(job))) {
        complain(&word);
    }
}

/// Says how to resume a run that stopped at the cycle `now`, and which cycles are lost.
fn how_to_resume(checkpoints: &Autosave, now: f64) -> String {
    let Some((path, cycle)) = checkpoints.kept() else {
        return "there is no checkpoint".into();
    };
    let path = shell_word(path);
    if cycle == now {
        return format!("resume with: mdr-tui run --resume {path}");
    }
    let (cycle, now) = (number(cycle), number(now));
    format!(
        "resume from cycle {cycle} with: mdr-tui run --resume {path} \
         (cycles up to {now} could not be saved)"
    )
}

/// A new directory named after the scenario.
fn new_directory(scenario: &Scenario) -> Result<RunDirectory, WriteError> {
    RunDirectory::claim_new(&format!("{}-run", scenario.stem()))
}

/// The value is always whole, even after a panic: it is replaced, never changed in place.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The name of a snapshot's file.
fn file_of(snapshot: &CycleAsGiven) -> String {
    format!("state-{}.csv", snapshot.spelling)
}
