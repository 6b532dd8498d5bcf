//! How a run begins: from a scenario, or where an interrupted one ended.

use std::path::Path;

use anyhow::Context;

use super::*;
use crate::export::autosave::state_directory;
use crate::export::file::{directory_of, write_whole};
use crate::export::run_directory::RUN_CHECKPOINT;
use crate::studies::refinement::Budget;

impl<'a> Job<'a> {
    /// Starts the scenario called `name`.
    pub(super) fn start(options: &'a Run, name: &str, go_on: &dyn Fn() -> bool) -> Result<Self> {
        let mut scenario = Scenario::load(name, &options.changes.set)?;
        let mut job = RunJob::new(options, &scenario, name)?;
        let directory = match &options.out {
            Some(path) => RunDirectory::claim(path, options.force)?,
            None => new_directory(&scenario)?,
        };
        if scenario.run().cycles == Some(job.cycles) {
            job.statements = scenario.statements();
        }
        if scenario.accuracy().is_some() {
            let (end, budget) = (
                Some(job.cycles),
                Budget::for_run(options.budget.unwrap_or(f64::INFINITY)),
            );
            let found = accuracy::resolve(&scenario, options.quiet, |scenario| {
                refinement::resolve(scenario, end, budget, go_on)
            });
            let found = found.with_context(|| printable(name))?;
            scenario = found.scenario;
            job.statements = found.statements;
        }
        let session = Session::start(scenario).with_context(|| printable(name))?;
        // Only now, when there is something to put in their place.
        if options.force {
            directory.clear()?;
        }
        job.set_home(directory.path());
        Ok(Self::new(options, name.to_owned(), session, job, directory))
    }

    /// Resumes a run in its own directory, or in another one, to which the files written so far are
    /// copied.
    pub(super) fn resume(options: &'a Run, file: &Path) -> Result<Self> {
        let name = printable(&file.display().to_string());
        let real = |path: &Path| path.canonicalize().ok();
        let out = options.out.as_deref();
        let is_out = |home: &Path| {
            out.is_none_or(|out| real(out).is_some_and(|out| real(home) == Some(out)))
        };
        let is_of_a_run = file.is_file() && file.ends_with(RUN_CHECKPOINT);
        let beside = is_of_a_run.then(|| directory_of(file));
        // Only the first process may resume it.
        let claimed = beside.filter(|home| is_out(home));
        let claimed = claimed.map(RunDirectory::reopen).transpose()?;
        let kept = checkpoint::read::<RunJob>(file)?;
        let session = kept.session;
        let mut job = RunJob::resumed(kept.job, &session, options.cycles, &name)?;
        let home = beside.or(job.home.as_deref()).map(Path::to_owned);
        let inside = home.as_deref();
        let inside = inside.filter(|home| is_out(home) && home.is_dir());
        let directory = match (claimed, inside.or(out)) {
            (Some(directory), _) => directory,
            (None, Some(home)) if inside.is_some() && home.join(RUN_CHECKPOINT).exists() => {
                RunDirectory::reopen(home)?
            }
            (None, Some(directory)) => RunDirectory::claim(directory, options.force)?,
            (None, None) => new_directory(session.loaded())?,
        };
        let from = home.as_deref().unwrap_or(Path::new("."));
        for snapshot in job.taken() {
            let name = file_of(snapshot);
            let (from, to) = (from.join(&name), directory.path().join(&name));
            if to.exists() {
                continue;
            }
            match fs::read(&from) {
                Ok(table) => write_whole(&to, &table)?,
                Err(_) => complain(&format!("{}: no longer exists", from.display())),
            }
        }
        if let Err(error) = job.move_to(from, directory.path()) {
            let cycle = number(session.simulation().cycle());
            let lost = format!("the history before cycle {cycle} no longer exists");
            complain(&format!("{name}: {lost}: {error}"));
        }
        let resumed = Self::new(options, name, session, job, directory);
        let cycle = resumed.session.simulation().cycle();
        locked(&resumed.safe).checkpoints.remember(file, cycle);
        Ok(resumed)
    }

    fn new(
        options: &'a Run,
        name: String,
        mut session: Session,
        job: RunJob,
        directory: RunDirectory,
    ) -> Self {
        session.state(job.statements.clone());
        let home = directory.checkpoint();
        let safe = Safe {
            checkpoints: Autosave::new(Some(home), state_directory(), options.checkpoint_every),
            copy: Recent::new((session.clone(), job.clone())),
        };
        Self {
            options,
            name,
            safe: Arc::new(Mutex::new(safe)),
            directory,
            session,
            job,
            unwritten: None,
            owed: Vec::new(),
        }
    }
}

/// A new directory named after the scenario.
fn new_directory(scenario: &Scenario) -> Result<RunDirectory, WriteError> {
    RunDirectory::claim_new(&format!("{}-run", scenario.stem()))
}
