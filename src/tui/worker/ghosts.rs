//! Companions of the run: ghosts over the plots, and the twin that estimates its error.

use std::mem::take;
use std::time::Duration;

use super::Worker;
use crate::scenario::columns::Naming;
use crate::tui::following::FollowingRun;
use crate::tui::ghosts::{MOST, Since, Source};
use crate::tui::recorded::Recorded;

/// How long each companion catches up before the worker looks for orders again.
const CATCH_UP: Duration = Duration::from_millis(10);

/// What is drawn over the plots. Methods that change it return the notice about that.
#[derive(Default)]
pub struct Ghosts {
    /// States frozen by the user, and overlays.
    pub(super) fixed: Vec<Source>,
    pub(super) rival: Option<Rival>,
    /// A copy of the run from before the first change in the list of parameters, while the list is open.
    pub(super) before: Option<Source>,
}

/// A run by another method.
pub(super) struct Rival {
    run: Source,
    choice: isize,
    since: Since,
}

impl Ghosts {
    /// Returns all of them, in the order of the legends.
    pub(super) fn all(&self) -> impl Iterator<Item = &Source> {
        let rival = self.rival.as_ref().map(|rival| &rival.run);
        self.fixed.iter().chain(&self.before).chain(rival)
    }

    /// Returns those that run.
    fn running(&mut self) -> impl Iterator<Item = &mut FollowingRun> {
        let rival = self.rival.as_mut().map(|rival| &mut rival.run);
        let all = self.fixed.iter_mut().chain(&mut self.before).chain(rival);
        all.flat_map(|ghost| ghost.follower.as_deref_mut())
    }

    /// Lets them catch up with the run, which is at `cycle`.
    pub(super) fn follow(&mut self, cycle: f64) {
        self.running()
            .for_each(|follower| follower.follow(cycle, cycle, CATCH_UP));
    }

    /// Drops the run from before the changes.
    pub(in crate::tui) fn drop_before(&mut self, _: &Recorded) -> Option<String> {
        self.before = None;
        None
    }

    /// Begins or ends the comparison with another method.
    pub(in crate::tui) fn compare_or_stop(&mut self, run: &Recorded) -> Option<String> {
        match self.rival.take() {
            Some(_) => None,
            None => self.compare(run, 0, Since::Now),
        }
    }

    /// Compares with the method this many places on; `None` if there is no comparison.
    pub(super) fn shift_rival(&mut self, run: &Recorded, places: isize) -> Option<String> {
        let rival = self.rival.as_ref()?;
        self.compare(run, rival.choice + places, rival.since)
    }

    /// Lays a run by the `choice`th other method over the plots, which begins now or at the start.
    pub(in crate::tui) fn compare(
        &mut self,
        run: &Recorded,
        choice: isize,
        since: Since,
    ) -> Option<String> {
        let run = match Source::rival(&run.session, choice, since) {
            Ok(run) => run,
            Err(error) => return Some(error.to_string()),
        };
        let name = run.name();
        let notice = match since {
            Since::Now => format!("comparing with {name} from here; C: from the start"),
            Since::Start => format!("comparing with {name} from the start"),
        };
        self.rival = Some(Rival { run, choice, since });
        Some(notice)
    }

    /// Freezes the present state.
    pub(in crate::tui) fn freeze(&mut self, run: &Recorded) -> Option<String> {
        self.add(Source::frozen(run))
    }

    /// Overlays the curves of a file, a directory or a scenario.
    pub(in crate::tui) fn overlay(&mut self, run: &Recorded, given: &str) -> Option<String> {
        let reach = run.simulation().setup().grid.radius();
        match Source::load(given, &Naming::default(), reach) {
            Ok(ghost) => self.add(ghost),
            Err(error) => Some(error.to_string()),
        }
    }

    fn add(&mut self, ghost: Source) -> Option<String> {
        if self.fixed.len() >= MOST {
            return Some(format!("{MOST} ghosts are there already; G removes them"));
        }
        let notice = format!("{} is over the plots now; G removes it", ghost.name());
        self.fixed.push(ghost);
        Some(notice)
    }

    /// Removes frozen states and overlays.
    pub(in crate::tui) fn drop_fixed(&mut self, _: &Recorded) -> Option<String> {
        let notice = "there is no ghost; g freezes this state, :overlay FILE takes a file";
        take(&mut self.fixed).is_empty().then(|| notice.to_owned())
    }
}

impl Worker {
    /// Whether any companion lags behind; a running run does not wait for its twin.
    pub(super) fn is_awaited(&mut self) -> bool {
        let cycle = self.run.cycle();
        let twin = self.twin.as_ref().filter(|_| !self.pace.is_running());
        let twin_lags = twin.is_some_and(|twin| twin.lags(cycle));
        twin_lags || self.ghosts.running().any(|follower| follower.lags(cycle))
    }

    /// Lets the twin catch up with the run.
    pub(super) fn follow_with_twin(&mut self, budget: Duration) {
        if let Some(twin) = &mut self.twin {
            twin.follow_for(self.run.cycle(), budget);
        }
    }

    /// Lets all companions catch up for a moment.
    pub(super) fn catch_up(&mut self) {
        self.ghosts.follow(self.run.cycle());
        self.follow_with_twin(CATCH_UP);
        if self.screen.is_due() || !self.is_awaited() {
            self.publish();
        }
    }

    /// Makes the twin compare with the present moment, if `must` or due; it knows nothing of the past.
    pub(super) fn compare_twin(&mut self, must: bool) {
        let twin = self.twin.as_mut();
        if let Some(twin) = twin.filter(|_| self.past.present().is_none()) {
            twin.look_at(&self.run.session, must);
        }
    }
}
