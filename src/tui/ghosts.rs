//! Sources of ghosts: files, states frozen by the user, and scenarios run beside.

use std::ffi::OsStr;
use std::path::Path;
use std::sync::Arc;

use super::beside::Beside;
use super::trend::Recorded;
use crate::reading::Curves;
use crate::scenario::Scenario;
use crate::scenario::columns::Naming;
use crate::scenario::session::{Session, SessionError};
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
    pub(super) beside: Option<Box<Beside>>,
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
                beside: Some(Box::new(Beside::new(start, true))),
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

    /// Continues a run as it was before it was changed.
    pub(super) fn before(session: Session) -> Self {
        Self {
            ghost: Arc::new(Ghost::new("before")),
            beside: Some(Box::new(Beside::new(session, true))),
        }
    }

    /// Makes a source with fixed curves.
    fn still(ghost: Ghost) -> Self {
        Self {
            ghost: Arc::new(ghost),
            beside: None,
        }
    }

    /// Returns its name in legends.
    pub(super) fn name(&self) -> &str {
        &self.ghost.name
    }

    /// Returns its curves; if it is a run, those selected by `curves`.
    pub(super) fn seen(&self, curves: Curves) -> Arc<Ghost> {
        let Some(beside) = &self.beside else {
            return Arc::clone(&self.ghost);
        };
        let mut name = self.name().to_owned();
        if beside.stopped.is_some() {
            name += &format!(" (ends at {:.2})", beside.run.cycle());
        }
        Arc::new(ghost(&name, &beside.run, curves))
    }
}

fn ghost(name: &str, run: &Recorded, curves: Curves) -> Ghost {
    let seen = run.simulation().observe(curves);
    run.charted(&seen).ghost(name)
}
