//! Sources of ghosts: files, states frozen by the user, and runs that follow this one: of another scenario, by
//! another method or on half the cells, or as it was before a change.

use std::ffi::OsStr;
use std::path::Path;
use std::sync::Arc;

use super::following::FollowingRun;
use super::recorded::Recorded;
use crate::math::abel::AbelMethod;
use crate::math::grid::MIN_CELLS;
use crate::reading::Curves;
use crate::scenario::columns::Naming;
use crate::scenario::session::{Session, SessionError};
use crate::scenario::{Scenario, Spec};
use crate::studies::ghost::Ghost;
use crate::studies::refinement;

/// Maximum number of ghosts; each has a different stroke.
pub const MOST: usize = 4;

/// Curves to compare the run with.
#[derive(Debug, Clone)]
pub struct Source {
    /// Its name, and its curves if they do not change.
    ghost: Arc<Ghost>,
    /// A run that computes its curves at the same cycle, if it is one.
    pub(super) follower: Option<Box<FollowingRun>>,
}

impl Source {
    /// What `given` names, which is to be shown over a contact that reaches as far as `reach`, m: a
    /// directory or a CSV file, whose columns `naming` may name, or else a scenario.
    ///
    /// # Errors
    /// What cannot be read, is refused as measured data, or cannot be run.
    pub fn load(
        given: impl AsRef<OsStr>,
        naming: &Naming,
        reach: f64,
    ) -> Result<Self, SessionError> {
        let path = Path::new(&given);
        let ending = path.extension();
        if ending.is_none_or(|end| end.eq_ignore_ascii_case("toml")) && !path.is_dir() {
            let scenario = Scenario::load(path, &[])?;
            let start = Session::start(refinement::resolve_soon(&scenario)?.scenario)?;
            return Ok(Self {
                ghost: Arc::new(Ghost::new(&scenario.stem())),
                follower: Some(Box::new(FollowingRun::new(start, true))),
            });
        }
        let ghost = Ghost::read(path, naming)?;
        ghost.check_radii(reach)?;
        Ok(Self::still(ghost))
    }

    /// Freezes the present state of a run.
    pub(super) fn frozen(run: &Recorded) -> Self {
        let name = format!("cycle {:.2}", run.cycle());
        Self::still(ghost(&name, run, Curves::all()))
    }

    /// Runs `session` by another method or on half the cells: the `choice`th of these, counted round. Begins at the
    /// present state, or at the start with the changes made since.
    ///
    /// # Errors
    /// If that run cannot be made.
    pub(super) fn rival(
        session: &Session,
        choice: isize,
        since: Since,
    ) -> Result<Self, SessionError> {
        let choices = choices(session);
        let chosen = &choices[choice.rem_euclid(choices.len() as isize) as usize];
        let session = match since {
            Since::Now => {
                let mut session = session.clone();
                session.edit(chosen)?;
                session
            }
            Since::Start => {
                let run = session.as_run(Vec::new());
                let mut others = run.changes().to_vec();
                let run = run.with_changes(Vec::new());
                let scenario = run.edited(chosen)?;
                let replaced = run.spec().diff(scenario.spec());
                others.retain(|change| replaced.iter().all(|(key, _)| change.key != *key));
                Session::start(scenario.with_changes(others))?
            }
        };
        let setup = session.simulation().setup();
        let name = format!(
            "{}, N = {}",
            setup.method.traits().title,
            setup.grid.cells()
        );
        Ok(Self {
            ghost: Arc::new(Ghost::new(&name)),
            follower: Some(Box::new(FollowingRun::new(session, false))),
        })
    }

    /// Continues a run as it was before it was changed.
    pub(super) fn unchanged(session: Session) -> Self {
        Self {
            ghost: Arc::new(Ghost::new("before")),
            follower: Some(Box::new(FollowingRun::new(session, true))),
        }
    }

    /// Makes a source with fixed curves.
    fn still(ghost: Ghost) -> Self {
        Self {
            ghost: Arc::new(ghost),
            follower: None,
        }
    }

    /// Returns its name in legends.
    pub(super) fn name(&self) -> &str {
        &self.ghost.name
    }

    /// Returns its curves; if it is a run, those selected by `curves`.
    pub(super) fn curves(&self, curves: Curves) -> Arc<Ghost> {
        let Some(follower) = &self.follower else {
            return Arc::clone(&self.ghost);
        };
        let mut name = self.name().to_owned();
        if follower.stopped.is_some() {
            name += &format!(" (ends at {:.2})", follower.run.cycle());
        }
        Arc::new(ghost(&name, &follower.run, curves))
    }
}

fn ghost(name: &str, run: &Recorded, curves: Curves) -> Ghost {
    let seen = run.simulation().observe(curves);
    run.charted(&seen).ghost(name)
}

/// Where a comparison begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Since {
    /// At the present state of the run.
    Now,
    /// At the start of the scenario.
    Start,
}

/// What tells another run apart.
type Edit = Box<dyn Fn(&mut Spec)>;

/// What a run can be compared with: every other method, and itself on half the cells.
fn choices(session: &Session) -> Vec<Edit> {
    let setup = session.simulation().setup();
    let mut others = AbelMethod::for_geometry(setup.geometry);
    others.retain(|method| *method != setup.method);
    // Method b comes first, because the paper's conclusion is about it.
    others.sort_by_key(|method| *method != AbelMethod::B);
    let half = (setup.grid.cells() / 2).max(MIN_CELLS);
    let by = |method| -> Edit { Box::new(move |spec| spec.numerics.method = Some(method)) };
    let on_half: Edit = Box::new(move |Spec { numerics, .. }| {
        (numerics.accuracy, numerics.points, numerics.nodes) = (None, Some(half), None);
    });
    others.into_iter().map(by).chain([on_half]).collect()
}
