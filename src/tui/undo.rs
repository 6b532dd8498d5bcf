//! History for time travel: whole states to return to, within a limit of memory.
//!
//! A state is stored at the end of a cycle, after every manual step and before every change. States are in the order in
//! which the user saw them: a branch, a restart or another scenario begins a new stretch after the one it leaves, so
//! that the way back leads through all of them. When the memory is full, states are thinned where they are closest for
//! their age, so that the recent past stays dense and the early past never vanishes. A state holds the whole session,
//! so a run continued from it is bit for bit the same, without later changes.

use std::sync::Arc;
use std::time::Instant;

use super::recorded::Recorded;
use crate::export::autosave::mark;

/// Maximum number of states, and of numbers at nodes in all of them (64 MB), which counts on large grids.
const MOST: usize = 256;
const MOST_NUMBERS: usize = 8 << 20;

/// Upper bounds of the number of nodal arrays in a session, and in the operators of a method in its fast form.
const ARRAYS: usize = 40;
const FAST_ARRAYS: usize = 200;

/// One state of the past.
#[derive(Debug)]
pub(super) struct Kept {
    /// The run at that time.
    pub run: Recorded,
    /// The stretch that it belongs to. Within a stretch, time never goes backwards.
    stretch: u32,
    /// The scenario that it belongs to. A restart also counts as a new one.
    scenario: u32,
}

impl Kept {
    fn cycle(&self) -> f64 {
        self.run.cycle()
    }

    /// Returns an upper bound of the numbers at nodes that it does not share with the state `after`. Operators are
    /// shared unless method or grid differ; the newest state's operators do not count, because they are in use anyway.
    fn numbers(&self, after: Option<&Self>) -> usize {
        let setup = self.run.simulation().setup();
        let nodes = setup.grid.len();
        let shares_operators = after.is_none_or(|after| {
            let other = after.run.simulation().setup();
            self.scenario == after.scenario
                && setup.method == other.method
                && setup.indenter == other.indenter
                && setup.geometry == other.geometry
                && setup.grid == other.grid
        });
        let is_fast = setup.method.prefers_fast(nodes) && !setup.geometry.is_line();
        let operators = match is_fast {
            _ if shares_operators => 0,
            true => FAST_ARRAYS,
            false => 4 * nodes,
        };
        (ARRAYS + operators) * nodes
    }
}

/// Which state to show.
#[derive(Debug, Clone, Copy)]
pub enum Way {
    /// The one this many places forward, or the last one there.
    Places(isize),
    /// The latest one at or before a cycle, on the way that led to the present.
    Before(f64),
    /// The one of the shown run nearest to a cycle, the latest if there are several.
    Near(f64),
    /// The last one.
    Present,
}

/// What a branch leaves.
pub(super) struct Left {
    /// The state at the end of the stretch.
    pub end: Arc<Kept>,
    /// Whether the branch belongs to another run.
    pub is_other_run: bool,
}

/// The states of the past, oldest first, and which of them is on the screen.
#[derive(Debug, Default)]
pub(super) struct Past {
    kept: Vec<Arc<Kept>>,
    /// The index of the state on the screen; `None` at the present.
    at: Option<usize>,
    /// When the present was last stored.
    pub stored: Option<Instant>,
    stretch: u32,
    scenario: u32,
}

impl Past {
    /// Stores the present state, but no state twice.
    pub fn store(&mut self, run: &Recorded) {
        self.stored = Some(Instant::now());
        if self.at.is_some() || self.is_kept(run) {
            return;
        }
        self.push(run.clone());
    }

    fn push(&mut self, run: Recorded) {
        self.kept.push(Arc::new(Kept {
            run,
            stretch: self.stretch,
            scenario: self.scenario,
        }));
        self.make_room(MOST, MOST_NUMBERS);
    }

    /// Thins the past, then drops the oldest states, until at most `states` with at most `numbers` are left.
    /// The last state stays, and the first as long as possible.
    fn make_room(&mut self, states: usize, numbers: usize) {
        while self.kept.len() > 2 && (self.kept.len() > states || self.numbers() > numbers) {
            let least = self.least_missed().unwrap_or(0);
            self.kept.remove(least);
            self.at = self.at.map(|at| at - usize::from(least < at));
        }
    }

    /// Whether the newest state is the present one, with no step or change since.
    fn is_kept(&self, run: &Recorded) -> bool {
        self.kept.last().is_some_and(|last| {
            last.stretch == self.stretch && mark(&last.run.session) == mark(&run.session)
        })
    }

    /// Returns an upper bound of the numbers at nodes in all states.
    fn numbers(&self) -> usize {
        let mut after = None;
        let newest_first = self.kept.iter().rev();
        newest_first
            .map(|kept| kept.numbers(after.replace(kept).map(Arc::as_ref)))
            .sum()
    }

    /// Returns the most dispensable state: the one in the smallest gap for its age within its stretch. The ends of a
    /// stretch stay; `None` if there are no others.
    fn least_missed(&self) -> Option<usize> {
        // The number of cycles that the user has seen since, including later stretches.
        let mut age = 0.0;
        let inner = (1..self.kept.len().saturating_sub(1)).rev();
        let gaps = inner.filter_map(|i| {
            let [before, this, after] = [i - 1, i, i + 1].map(|i| &self.kept[i]);
            age += (after.cycle() - this.cycle()).max(0.0);
            let gap = (after.cycle() - before.cycle()) / (age + 1.0);
            let is_inner = before.stretch == after.stretch && Some(i) != self.at;
            is_inner.then_some((gap, i))
        });
        let least = gaps.min_by(|(a, i), (b, k)| a.total_cmp(b).then(i.cmp(k)));
        least.map(|(_, i)| i)
    }

    /// Shows another state, or says at which end of the past there is none. The present must have been stored.
    pub fn visit(&mut self, way: Way) -> Result<Arc<Kept>, &'static str> {
        self.find(way)
            .and_then(|at| self.show(at))
            .ok_or(match way {
                Way::Places(1..) | Way::Present => "this is the present",
                _ => "this is the start of the run",
            })
    }

    /// Returns the index of the state to which `way` leads.
    fn find(&self, way: Way) -> Option<usize> {
        let last = self.kept.len().checked_sub(1)?;
        let shown = self.at.unwrap_or(last);
        let mut latest_first = (0..=last).rev();
        match way {
            Way::Places(places) => {
                let next = shown.saturating_add_signed(places).min(last);
                (next != shown).then_some(next)
            }
            Way::Before(cycle) => {
                let scenario = self.kept[last].scenario;
                // A stretch that was left continues beyond the branch.
                let mut limit = f64::INFINITY;
                latest_first.find(|&at| {
                    let kept = &self.kept[at];
                    let is_on_the_way = kept.scenario == scenario && kept.cycle() <= limit;
                    if is_on_the_way {
                        limit = kept.cycle();
                    }
                    is_on_the_way && kept.cycle() <= cycle
                })
            }
            Way::Near(cycle) => {
                let scenario = self.kept[shown].scenario;
                let near = |at: &usize| (self.kept[*at].cycle() - cycle).abs();
                let of_run = latest_first.filter(|&at| self.kept[at].scenario == scenario);
                of_run.min_by(|a, b| near(a).total_cmp(&near(b)))
            }
            Way::Present => Some(last),
        }
    }

    /// Stores a state between the one on the screen and the next, and goes there.
    pub fn insert(&mut self, run: Recorded) {
        let Some((at, shown)) = self.at.and_then(|at| Some((at, self.kept.get(at)?))) else {
            return;
        };
        let (stretch, scenario) = (shown.stretch, shown.scenario);
        let kept = Kept {
            run,
            stretch,
            scenario,
        };
        self.kept.insert(at + 1, Arc::new(kept));
        self.at = Some(at + 1);
        self.make_room(MOST, MOST_NUMBERS);
    }

    /// Shows a state; the last one is the present.
    fn show(&mut self, at: usize) -> Option<Arc<Kept>> {
        self.at = (at + 1 < self.kept.len()).then_some(at);
        self.kept.get(at).cloned()
    }

    /// Returns the run at the present, whatever is on the screen: the state worth saving.
    pub fn line<'a>(&'a self, shown: &'a Recorded) -> &'a Recorded {
        let last = self.kept.last().filter(|_| self.at.is_some());
        last.map_or(shown, |kept| &kept.run)
    }

    /// Returns the cycle of the present, while the screen shows the past.
    pub fn present(&self) -> Option<f64> {
        self.at?;
        self.kept.last().map(|kept| kept.cycle())
    }

    /// Makes the state on the screen the present, in a new stretch after the one that it leaves. Returns what it
    /// leaves, if the screen was in the past.
    pub fn branch(&mut self) -> Option<Left> {
        let from = Arc::clone(self.kept.get(self.at.take()?)?);
        let end = Arc::clone(self.kept.last()?);
        let is_other_run = end.scenario != from.scenario;
        self.stretch += 1;
        self.scenario += u32::from(is_other_run);
        self.push(from.run.clone());
        Some(Left { end, is_other_run })
    }

    /// Prepares for another run after the present one, which must have been stored.
    pub fn leave(&mut self) {
        self.at = None;
        self.stretch += 1;
        self.scenario += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;
    use crate::scenario::session::Session;

    /// Stores a state without a recorded past.
    fn keep(past: &mut Past, session: &Session) {
        past.store(&Recorded::unrecorded(session.clone(), 0.0));
    }

    /// Returns the cycle of the state that is then shown.
    fn visit(past: &mut Past, way: Way) -> Option<f64> {
        past.visit(way).ok().map(|kept| kept.cycle())
    }

    fn session() -> Session {
        let sets = [
            "numerics.points=16".into(),
            "numerics.steps_per_cycle=4".into(),
        ];
        let scenario = Scenario::load("li2019-fig3", &sets).expect("a preset");
        Session::start(scenario).expect("a contact")
    }

    /// Returns a run whose cycles up to `end` are all stored.
    fn run_to(end: u32) -> (Session, Past) {
        let (mut session, mut past) = (session(), Past::default());
        for cycle in 0..=end {
            session.advance_to(f64::from(cycle)).expect("a step");
            keep(&mut past, &session);
        }
        (session, past)
    }

    fn cycles(past: &Past) -> Vec<f64> {
        past.kept.iter().map(|kept| kept.cycle()).collect()
    }

    #[test]
    fn memory_is_bounded_and_the_recent_past_is_dense() {
        let mut session = session();
        let mut past = Past::default();
        keep(&mut past, &session);
        for cycle in 1..=300 {
            session.advance_to(f64::from(cycle)).expect("a step");
            keep(&mut past, &session);
            keep(&mut past, &session);
            past.make_room(24, usize::MAX);
            assert!(past.kept.len() <= 24);
        }
        let cycles = cycles(&past);
        assert_eq!((cycles[0], cycles[cycles.len() - 1]), (0.0, 300.0));
        assert!(cycles.len() >= 16, "{cycles:?}");
        assert!(cycles.is_sorted_by(|a, b| a < b));
        // The last few cycles are all there, and gaps grow no faster than age.
        assert!(cycles.ends_with(&[298.0, 299.0, 300.0]), "{cycles:?}");
        for pair in cycles.windows(2) {
            assert!(
                pair[1] - pair[0] <= 0.7 * (300.0 - pair[0]) + 1.0,
                "{cycles:?}"
            );
        }
    }

    #[test]
    fn restarts_stay_within_the_memory_and_the_latest_can_be_undone() {
        let start = session();
        let mut past = Past::default();
        keep(&mut past, &start);
        let budget = 12 * past.kept[0].numbers(None);
        for _ in 0..40 {
            let mut session = start.clone();
            keep(&mut past, &session);
            for cycle in 1..=5 {
                session.advance_to(f64::from(cycle)).expect("a step");
                keep(&mut past, &session);
                past.make_room(MOST, budget);
                assert!(past.numbers() <= budget);
            }
            past.leave();
        }
        keep(&mut past, &start);
        assert_eq!(visit(&mut past, Way::Places(-1)), Some(5.0));
    }

    #[test]
    fn back_and_forth_end_at_the_ends() {
        let (_, mut past) = run_to(3);
        assert!(past.visit(Way::Places(1)).is_err());
        assert_eq!(visit(&mut past, Way::Places(-1)), Some(2.0));
        assert_eq!(past.present(), Some(3.0));
        assert_eq!(visit(&mut past, Way::Places(-1)), Some(1.0));
        assert_eq!(visit(&mut past, Way::Places(1)), Some(2.0));
        assert_eq!(visit(&mut past, Way::Places(1)), Some(3.0));
        assert_eq!(past.present(), None);
        assert!(past.branch().is_none());
        assert_eq!(visit(&mut past, Way::Places(-1)), Some(2.0));
        for _ in 0..2 {
            visit(&mut past, Way::Places(-1));
        }
        assert!(past.visit(Way::Places(-1)).is_err());
        assert_eq!(past.present(), Some(3.0));
        for (cycle, nearest) in [(1.4, 1.0), (-7.0, 0.0), (2.6, 3.0), (1e9, 3.0)] {
            assert_eq!(visit(&mut past, Way::Near(cycle)), Some(nearest));
            assert_eq!(past.present().is_none(), nearest == 3.0);
        }
    }

    #[test]
    fn a_cycle_is_found_on_the_way_that_led_to_the_present() {
        let (mut session, mut past) = run_to(3);
        visit(&mut past, Way::Near(1.0));
        past.branch();
        keep(&mut past, &session);
        session.advance_to(5.0).expect("a step");
        keep(&mut past, &session);
        assert_eq!(cycles(&past), [0.0, 1.0, 2.0, 3.0, 1.0, 3.0, 5.0]);
        // The second and third state belong to the stretch that was left.
        assert_eq!(visit(&mut past, Way::Before(2.9)), Some(1.0));
        assert_eq!(past.at, Some(4));
        past.insert(past.kept[2].run.clone());
        assert_eq!((past.at, past.present()), (Some(5), Some(5.0)));
        assert_eq!(visit(&mut past, Way::Before(2.9)), Some(2.0));
        assert_eq!(visit(&mut past, Way::Before(0.5)), Some(0.0));
        assert_eq!(visit(&mut past, Way::Present), Some(5.0));
        assert_eq!(past.present(), None);
    }

    #[test]
    fn the_way_back_leads_through_what_a_branch_and_a_restart_left() {
        let (mut session, mut past) = run_to(3);
        assert_eq!(visit(&mut past, Way::Places(-1)), Some(2.0));
        assert_eq!(visit(&mut past, Way::Places(-1)), Some(1.0));
        let left = past.branch().expect("a branch");
        assert_eq!((left.end.cycle(), left.is_other_run), (3.0, false));
        assert_eq!(cycles(&past), [0.0, 1.0, 2.0, 3.0, 1.0]);
        session.advance_to(4.0).expect("a step");
        keep(&mut past, &session);
        past.leave();
        keep(&mut past, &run_to(0).0);
        assert_eq!(cycles(&past), [0.0, 1.0, 2.0, 3.0, 1.0, 4.0, 0.0]);
        assert_eq!(visit(&mut past, Way::Places(-1)), Some(4.0));
        let left = past.branch().expect("a branch");
        assert_eq!((left.end.cycle(), left.is_other_run), (0.0, true));
    }
}
