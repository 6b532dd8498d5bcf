//! How a run begins: from a scenario, or where an interrupted run ended.

use std::ffi::OsStr;
use std::path::Path;
use std::sync::{Arc, Mutex};

use anyhow::{Context, Result};

use super::past::Past;
use super::{Job, Safe};
use crate::cli::args::Run;
use crate::cli::job::RunJob;
use crate::cli::{accuracy, given};
use crate::export::autosave::{Autosave, Recent};
use crate::export::file::{WriteError, directory_of};
use crate::export::own_directory;
use crate::export::run_directory::{RUN_CHECKPOINT, RunDirectory};
use crate::panics::locked;
use crate::scenario::checkpoint::{self, Stamp};
use crate::scenario::session::Session;
use crate::scenario::{Scenario, printable};
use crate::studies::refinement::{self, Budget};

impl<'a> Job<'a> {
    /// Starts the scenario called `name`.
    pub(super) fn start(options: &'a Run, name: &OsStr, go_on: &dyn Fn() -> bool) -> Result<Self> {
        let mut scenario = given::scenario(name, &options.changes.set)?;
        let name = &*scenario.origin().to_owned();
        let mut job = RunJob::new(options, &scenario, name)?;
        let directory = match &options.out {
            Some(path) => RunDirectory::claim(path, options.force)?,
            None => new_directory(&scenario)?,
        };
        if scenario.run().cycles == Some(job.cycles) {
            job.errors = scenario.errors().unwrap_or_default();
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
            job.errors = found.errors;
        }
        job = job.identify(&scenario);
        let session = Session::start(scenario).with_context(|| printable(name))?;
        // Clears the old files only now, when there is something to replace them.
        if options.force {
            directory.clear(|_| false)?;
        }
        job.set_home(directory.path());
        Ok(Self::new(options, name.to_owned(), session, job, directory))
    }

    /// Resumes a run in its own directory, or in another one, to which the files written so far are copied.
    pub(super) fn resume(options: &'a Run, file: &Path) -> Result<Self> {
        let name = printable(&file.display().to_string());
        let out = options.out.as_deref();
        let is_out = |home: &Path| out.is_none_or(|out| is_same(home, out));
        let is_of_a_run = file.is_file() && file.ends_with(RUN_CHECKPOINT);
        let beside = is_of_a_run.then(|| directory_of(file));
        // Only the first process that claims the directory may resume it.
        let claimed = beside.filter(|home| is_out(home));
        let claimed = claimed.map(RunDirectory::reopen).transpose()?;
        let kept = checkpoint::read::<RunJob>(file)?;
        let session = kept.session;
        let mut job = RunJob::resumed(kept.job, &session, options.cycles, &name)?;
        job.field |= options.field;
        job.estimates |= options.estimate_error;
        let home = beside.or(job.home.as_deref()).map(Path::to_owned);
        let past = Past::find(&job, home.as_deref())?;
        let is_returning = claimed.is_none();
        let inside = home.as_deref();
        let inside = inside.filter(|home| is_out(home) && home.is_dir());
        let directory = match (claimed, inside, out) {
            (Some(directory), ..) => directory,
            (None, Some(home), _) => {
                let (run, cycle) = (job.id.clone(), session.simulation().cycle());
                let is_own = |name: &str| past.is_own(name);
                RunDirectory::return_to(home, &Stamp { run, cycle }, is_own, options.force)?
            }
            (None, None, Some(out)) => RunDirectory::claim(out, options.force)?,
            (None, None, None) => new_directory(session.loaded())?,
        };
        past.refuse_foreign(options.force)?;
        let is_at_home = home.as_deref();
        let is_at_home = is_at_home.is_some_and(|home| is_same(home, directory.path()));
        if is_returning && options.force {
            directory.clear(|name| is_at_home && past.is_own(name))?;
        }
        job.set_home(directory.path());
        past.copy_into(&mut job, &directory, is_at_home)?;
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
        session.state(job.errors.clone());
        let home = Some(directory.clone());
        let safe = Safe {
            checkpoints: Autosave::new(home, own_directory::state(), options.checkpoint_every),
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

/// Whether two paths lead to the same directory.
fn is_same(one: &Path, other: &Path) -> bool {
    let [one, other] = [one, other].map(|path| path.canonicalize().ok());
    one.is_some() && one == other
}

/// Claims a new directory named after the scenario.
fn new_directory(scenario: &Scenario) -> Result<RunDirectory, WriteError> {
    RunDirectory::claim_new(&format!("{}-run", scenario.stem()))
}
