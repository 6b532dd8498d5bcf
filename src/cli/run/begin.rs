//! How a run begins: from a scenario, or where an interrupted run ended.

use std::ffi::OsStr;
use std::path::Path;
use std::sync::{Arc, Mutex};

use anyhow::{Context, Result, ensure};

use super::Job;
use crate::cli::args::RunOptions;
use crate::cli::job::RunJob;
use crate::cli::{accuracy, complain, given};
use crate::export::autosave::{self, Autosave};
use crate::export::file::{WriteError, directory_of, shell_path};
use crate::export::own_directory;
use crate::export::run_folder::{RUN_CHECKPOINT, RUN_ROWS, RunFolder};
use crate::math::number::exact;
use crate::panics::locked;
use crate::scenario::checkpoint;
use crate::scenario::session::Session;
use crate::scenario::{Refusal, Scenario, printable};
use crate::studies::refinement::{self, Budget};

impl<'a> Job<'a> {
    /// Starts the scenario called `name`.
    pub(super) fn start(
        options: &'a RunOptions,
        name: &OsStr,
        go_on: &dyn Fn() -> bool,
    ) -> Result<Self> {
        let mut scenario = given::scenario(name, &options.changes.set)?;
        let name = &*scenario.origin().to_owned();
        let mut job = RunJob::new(options, &scenario, name)?;
        let folder = match &options.out {
            Some(path) => RunFolder::create(path, options.force)?,
            None => new_folder(&scenario)?,
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
            folder.clear()?;
        }
        Ok(Self::new(options, name.to_owned(), session, job, folder))
    }

    /// Resumes a run in the folder that its checkpoint lies in. A checkpoint without a folder continues in the one that
    /// it names, or in another one.
    pub(super) fn resume(options: &'a RunOptions, file: &Path) -> Result<Self> {
        let name = printable(&file.display().to_string());
        let out = options.out.as_deref();
        let is_of_a_folder = file.is_file() && file.ends_with(RUN_CHECKPOINT);
        let lies_in = is_of_a_folder.then(|| directory_of(file));
        let in_place = lies_in.filter(|lies_in| out.is_none_or(|out| is_same(lies_in, out)));
        // Claims it before reading, because only the first process that does so may resume the run.
        let in_place = in_place.map(RunFolder::open).transpose()?;
        let kept = checkpoint::read::<RunJob>(file)?;
        let session = kept.session;
        let mut job = RunJob::resumed(kept.job, &session, options.cycles, &name)?;
        job.field |= options.field;
        job.estimates |= options.estimate_error;
        let run = lies_in.and_then(RunFolder::run_in);
        let is_own = run.as_ref() == Some(&job.id);
        let folder = match in_place {
            Some(folder) => {
                let rule =
                    "another run has used this folder since; continue in another one with --out";
                let is_free = run.is_none() || is_own;
                ensure!(is_free, Refusal::new(folder.path().display(), rule));
                folder
            }
            None => {
                let rule = "is resumed in the folder where it lies, without --out; to have it elsewhere, move that first";
                ensure!(!is_own, Refusal::new(&name, rule));
                folder_for(options, &session, &job)?
            }
        };
        bring_files(&mut job, &folder)?;
        // The session is resumed here, so the notice about its crash is no longer needed.
        autosave::forget_crash(file);
        let resumed = Self::new(options, name, session, job, folder);
        let cycle = resumed.session.simulation().cycle();
        locked(&resumed.autosave).remember(file, cycle);
        Ok(resumed)
    }

    fn new(
        options: &'a RunOptions,
        name: String,
        mut session: Session,
        mut job: RunJob,
        folder: RunFolder,
    ) -> Self {
        session.state(job.errors.clone());
        job.set_home(folder.path());
        folder.begin(&job.provenance());
        let home = Some(folder.clone());
        let start = (session.clone(), job.clone());
        let every = options.checkpoint_every;
        let autosave = Autosave::new(home, own_directory::state(), every, start);
        Self {
            options,
            name,
            autosave: Arc::new(Mutex::new(autosave)),
            folder,
            session,
            job,
            unwritten: None,
            owed: Vec::new(),
        }
    }
}

/// Claims the folder in which a checkpoint that lies in none continues: the one that it names, or `--out`.
fn folder_for(options: &RunOptions, session: &Session, job: &RunJob) -> Result<RunFolder> {
    let (out, force) = (options.out.as_deref(), options.force);
    let home = job.home.as_deref().filter(|home| home.is_dir());
    let home = home.filter(|home| out.is_none_or(|out| is_same(home, out)));
    let Some(path) = home.or(out) else {
        return Ok(new_folder(session.loaded())?);
    };
    if home.is_some() && RunFolder::run_in(path).as_ref() == Some(&job.id) {
        let folder = RunFolder::open(path)?;
        if !force {
            refuse_going_back(&folder, session)?;
        }
        return Ok(folder);
    }
    let folder = RunFolder::create(path, force)?;
    if force {
        folder.clear()?;
    }
    Ok(folder)
}

/// Copies the files that the run has written so far into `folder`, if they lie in another one, and tells if the rows of
/// the history are lost.
fn bring_files(job: &mut RunJob, folder: &RunFolder) -> Result<()> {
    let is_of_run = |path: &Path| RunFolder::run_in(path).as_ref() == Some(&job.id);
    let home = job.home.as_deref().filter(|home| is_of_run(home));
    if let Some(home) = home.filter(|_| !is_of_run(folder.path())) {
        let names = job.snapshot_files().chain([RUN_ROWS.to_owned()]);
        folder.copy_from(home, names)?;
    }
    if job.history.loses_rows(&folder.rows()) {
        complain("the history so far no longer exists; the rows begin at the checkpoint");
    }
    Ok(())
}

/// Refuses to undo what the run has done in its folder since the checkpoint of `session`.
fn refuse_going_back(folder: &RunFolder, session: &Session) -> Result<()> {
    let (path, checkpoint) = (folder.path(), folder.checkpoint());
    if checkpoint.symlink_metadata().is_err() {
        return Ok(folder.refuse_results()?);
    }
    let there = checkpoint::read::<RunJob>(&checkpoint)?.session;
    let there = there.simulation().cycle();
    let rule = format!(
        "the run has come further there, to cycle {}; resume with: mdr-tui run --resume {}, or choose another directory \
         with --out (--force goes back)",
        exact(there),
        shell_path(&checkpoint)
    );
    let is_newer = session.simulation().cycle() >= there;
    ensure!(is_newer, Refusal::new(path.display(), rule));
    Ok(())
}

/// Whether two paths lead to the same directory.
fn is_same(one: &Path, other: &Path) -> bool {
    let [one, other] = [one, other].map(|path| path.canonicalize().ok());
    one.is_some() && one == other
}

/// Claims a new folder named after the scenario.
fn new_folder(scenario: &Scenario) -> Result<RunFolder, WriteError> {
    RunFolder::create_named(&format!("{}-run", scenario.stem()))
}
