//! Companions of the run: ghosts over the plots, and the twin that estimates its error.

use std::time::Duration;

use super::Worker;
use crate::scenario::columns::Naming;
use crate::studies::refinement::Difference;
use crate::tui::beside::Beside;
use crate::tui::frame::Activity;
use crate::tui::ghosts::{MOST, Since, Source};

/// A run by another method, over the plots.
pub(super) struct Rival {
    pub run: Source,
    pub choice: isize,
    pub since: Since,
}

/// How long each of them catches up before the worker looks for orders again.
pub(super) const CATCH_UP: Duration = Duration::from_millis(10);

impl Worker {
    /// Returns the visible companions.
    fn followers(&mut self) -> impl Iterator<Item = &mut Beside> {
        let rival = self.rival.as_mut().map(|rival| &mut rival.run);
        let ghosts = self.ghosts.iter_mut().chain(&mut self.before).chain(rival);
        ghosts.flat_map(|ghost| ghost.beside.as_deref_mut())
    }

    /// Lets the visible companions catch up with the run.
    pub(super) fn follow(&mut self) {
        let cycle = self.run.cycle();
        self.followers()
            .for_each(|beside| beside.follow(cycle, cycle, CATCH_UP));
    }

    /// Lets the twin catch up with the run.
    pub(super) fn follow_with_twin(&mut self, budget: Duration) {
        if let Some(twin) = &mut self.twin {
            twin.follow_for(self.run.cycle(), budget);
        }
    }

    /// Whether any companion lags behind; a running run does not wait for its twin.
    pub(super) fn is_awaited(&mut self) -> bool {
        let cycle = self.run.cycle();
        let twin = self.twin.as_ref();
        let twin = twin.filter(|_| self.activity != Activity::Running);
        let twin_lags = twin.is_some_and(|twin| twin.lags(cycle));
        twin_lags || self.followers().any(|beside| beside.lags(cycle))
    }

    /// Lets all companions catch up for a moment.
    pub(super) fn catch_up(&mut self) {
        self.follow();
        self.follow_with_twin(CATCH_UP);
        if self.screen.is_due() || !self.is_awaited() {
            self.publish();
        }
    }

    /// Makes the twin estimate the errors of the present moment.
    pub fn estimate_errors(&mut self) {
        let twin = self.twin.as_mut();
        if let Some(twin) = twin.filter(|_| self.past.present().is_none()) {
            twin.look_at(&self.run.session, true);
        }
    }

    /// Returns the cycle up to which the run's errors are known, with the errors, or why they are unknown.
    pub(super) fn errors(&self) -> Result<(f64, Difference), String> {
        match &self.twin {
            // The twin has compared with the present, not with the past.
            _ if self.past.present().is_some() => Err("of the present: ] leads there".into()),
            Some(twin) => twin.errors(self.run.cycle()),
            None => Err("this run is too coarse to be halved".into()),
        }
    }

    /// Begins or ends the comparison with another method.
    pub fn compare_or_stop(&mut self) {
        if self.rival.take().is_none() {
            self.compare(0, Since::Now);
        }
    }

    /// Lays a run by the `choice`th other method over the plots, which begins now or at the start.
    pub(in crate::tui) fn compare(&mut self, choice: isize, since: Since) {
        let run = Source::rival(&self.run.session, choice, since);
        if let Some(run) = self.screen.or_notice(run) {
            let name = run.name();
            self.screen.notice(&match since {
                Since::Now => format!("comparing with {name} from here; C: from the start"),
                Since::Start => format!("comparing with {name} from the start"),
            });
            self.rival = Some(Rival { run, choice, since });
        }
    }

    /// Freezes the present state as a ghost.
    pub fn freeze(&mut self) {
        self.add_ghost(Source::frozen(&self.run));
    }

    /// Overlays the curves of a file, a directory or a scenario.
    pub fn overlay(&mut self, given: &str) {
        let reach = self.run.simulation().setup().grid.radius();
        if let Some(ghost) = self
            .screen
            .or_notice(Source::load(given, &Naming::default(), reach))
        {
            self.add_ghost(ghost);
        }
    }

    fn add_ghost(&mut self, ghost: Source) {
        if self.ghosts.len() >= MOST {
            let told = format!("{MOST} ghosts are there already; G removes them");
            return self.screen.notice(&told);
        }
        let told = format!("{} is over the plots now; G removes it", ghost.name());
        self.screen.notice(&told);
        self.ghosts.push(ghost);
    }

    /// Removes all ghosts.
    pub fn drop_ghosts(&mut self) {
        if std::mem::take(&mut self.ghosts).is_empty() {
            let told = "there is no ghost; g freezes this state, :overlay FILE takes a file";
            self.screen.notice(told);
        }
    }
}
