//! History for time travel: whole states to return to, within a memory limit.
//!
//! A state is stored at the end of a cycle, after every manual step and before every change. When
//! the memory is full, states are thinned where they are closest for their age, so that the recent
//! past stays dense and the early past never vanishes. A state holds the whole session: a run
//! continued from it is the same to the last bit, without later changes.

use std::sync::Arc;

use super::trend::{Tip, Trend};
use crate::scenario::session::Session;

/// The memory for the past, bytes.
const BUDGET: usize = 64 << 20;

/// Arrays of nodal values that a session holds, rounded up.
const ARRAYS: usize = 40;

/// What a session holds beside nodal values: its texts and tables, in bytes.
const TEXTS: usize = 24 << 10;

/// What a session holds for each change made to it, in bytes.
const CHANGE: usize = 256;

/// One state of the past.
#[derive(Debug, Clone)]
pub(super) struct Kept {
    /// The run as it was.
    pub session: Session,
    /// What the trend cannot find out from later entries.
    pub tip: Tip,
}

impl Kept {
    fn cycle(&self) -> f64 {
        self.session.simulation().cycle()
    }

    fn nodes(&self) -> usize {
        self.session.simulation().setup().grid.len()
    }

    /// An upper bound of what it holds without its operators, in bytes.
    fn bytes(&self) -> usize {
        let changes = self.session.changes().len() * CHANGE;
        8 * ARRAYS * self.nodes() + self.tip.bytes() + TEXTS + changes
    }

    /// An upper bound of the operators that it keeps alive, alone or with others, in bytes.
    fn operator_bytes(&self) -> usize {
        8 * 4 * self.nodes().pow(2)
    }

    /// Whether two states use the same operators.
    fn shares_operators(&self, other: &Self) -> bool {
        let [one, other] = [self, other].map(|kept| kept.session.simulation().setup());
        one.method == other.method && one.indenter == other.indenter && one.grid == other.grid
    }
}

/// A state that the user has marked, with the trend that led there.
#[derive(Debug, Clone)]
pub(super) struct Bookmark {
    /// The state.
    pub kept: Arc<Kept>,
    /// The cycles before it.
    pub trend: Trend,
    /// A later mark has a higher number.
    number: u64,
}

/// The states of the past, oldest first, and the one on the screen.
#[derive(Debug)]
pub(super) struct Past {
    kept: Vec<Arc<Kept>>,
    /// The state on the screen; `None` at the present.
    at: Option<usize>,
    /// In the order of their cycles.
    bookmarks: Vec<Bookmark>,
    /// How many states have been marked so far.
    marked: u64,
    budget: usize,
}

impl Default for Past {
    fn default() -> Self {
        Self {
            kept: Vec::new(),
            at: None,
            bookmarks: Vec::new(),
            marked: 0,
            budget: BUDGET,
        }
    }
}

impl Past {
    /// Keeps the present state, once.
    pub fn keep(&mut self, session: &Session, trend: &Trend) {
        if self.at.is_some() || self.is_kept(session) {
            return;
        }
        self.kept.push(Arc::new(Kept {
            session: session.clone(),
            tip: trend.tip(),
        }));
        self.make_room();
    }

    /// Thins the past, then drops the oldest marks, until the rest is within the budget. The first
    /// and the last state and the newest mark stay.
    fn make_room(&mut self) {
        // Bookmarks may take half of the memory.
        while self.bookmarks.len() > 1 && self.bookmark_bytes() > self.budget / 2 {
            self.drop_oldest_mark();
        }
        while self.kept.len() > 2 && self.bytes() > self.budget {
            self.thin();
        }
        while self.bookmarks.len() > 1 && self.bytes() > self.budget {
            self.drop_oldest_mark();
        }
    }

    fn drop_oldest_mark(&mut self) {
        let numbered = self.bookmarks.iter().enumerate();
        if let Some((oldest, _)) = numbered.min_by_key(|(_, mark)| mark.number) {
            self.bookmarks.remove(oldest);
        }
    }

    /// Whether the newest state is the present one: no step and no change since.
    fn is_kept(&self, session: &Session) -> bool {
        self.kept.last().is_some_and(|last| {
            last.session.simulation().cycle() == session.simulation().cycle()
                && last.session.changes().len() == session.changes().len()
        })
    }

    /// Memory in use, bytes.
    fn bytes(&self) -> usize {
        let states: usize = self.kept.iter().map(|kept| kept.bytes()).sum();
        // The operators of the present are there in any case.
        let mut known: Vec<&Kept> = self.kept.last().map(|kept| &**kept).into_iter().collect();
        let mut operators = 0;
        let marked = self.bookmarks.iter().map(|mark| &mark.kept);
        for kept in self.kept.iter().chain(marked) {
            if !known.iter().any(|other| other.shares_operators(kept)) {
                operators += kept.operator_bytes();
                known.push(kept);
            }
        }
        states + self.bookmark_bytes() + operators
    }

    /// What the marked states hold beside their operators, in bytes. A state that is both marked and
    /// kept is counted here as well: it may soon be marked alone.
    fn bookmark_bytes(&self) -> usize {
        let marked = self.bookmarks.iter();
        marked
            .map(|mark| mark.kept.bytes() + mark.trend.bytes())
            .sum()
    }

    /// Drops the state that is missed least: the one in the smallest gap for its age. The first and
    /// the last stay.
    fn thin(&mut self) {
        let newest = self.kept.last().map_or(0.0, |kept| kept.cycle());
        let gap = |i: usize| {
            let width = self.kept[i + 1].cycle() - self.kept[i - 1].cycle();
            width / (newest - self.kept[i].cycle() + 1.0)
        };
        let least = (1..self.kept.len() - 1).min_by(|&a, &b| gap(a).total_cmp(&gap(b)));
        if let Some(least) = least {
            self.kept.remove(least);
        }
    }

    /// Goes one state back; `None` at the start. The present must have been stored.
    pub fn back(&mut self) -> Option<Arc<Kept>> {
        let now = self.at.unwrap_or(self.kept.len().saturating_sub(1));
        self.at = Some(now.checked_sub(1)?);
        self.kept.get(now - 1).cloned()
    }

    /// Goes one state forward; `None` at the present.
    pub fn forth(&mut self) -> Option<Arc<Kept>> {
        let next = self.at? + 1;
        let found = self.kept.get(next).cloned();
        self.at = (next + 1 < self.kept.len()).then_some(next);
        found
    }

    /// The session at the present, whatever is on the screen: the state worth saving.
    pub fn line<'a>(&'a self, shown: &'a Session) -> &'a Session {
        let last = self.kept.last().filter(|_| self.at.is_some());
        last.map_or(shown, |kept| &kept.session)
    }

    /// The cycle of the present, while the screen is in the past.
    pub fn present(&self) -> Option<f64> {
        self.at?;
        self.kept.last().map(|kept| kept.cycle())
    }

    /// Makes the state on the screen the present: what came after it is dropped. True if there was
    /// anything to drop.
    pub fn branch(&mut self) -> bool {
        let Some(at) = self.at.take() else {
            return false;
        };
        self.kept.truncate(at + 1);
        true
    }

    /// Marks a state, once. Older marks give way where memory asks for it; returns how many did.
    pub fn mark(&mut self, session: &Session, trend: &Trend) -> usize {
        let is_there = |mark: &Bookmark| is_same(&mark.kept.session, session);
        if self.bookmarks.iter().any(is_there) {
            return 0;
        }
        let kept = self.kept.iter().rev();
        let kept = kept
            .filter(|kept| is_same(&kept.session, session))
            .map(Arc::clone)
            .next();
        let kept = kept.unwrap_or_else(|| {
            Arc::new(Kept {
                session: session.clone(),
                tip: trend.tip(),
            })
        });
        let trend = trend.clone();
        let before = self.bookmarks.len();
        self.marked += 1;
        self.bookmarks.push(Bookmark {
            kept,
            trend,
            number: self.marked,
        });
        let cycle = |mark: &Bookmark| mark.kept.cycle();
        self.bookmarks.sort_by(|a, b| cycle(a).total_cmp(&cycle(b)));
        self.make_room();
        before + 1 - self.bookmarks.len()
    }

    /// How many states are marked.
    pub fn marks(&self) -> usize {
        self.bookmarks.len()
    }

    /// The bookmark before `session`, going around to the last one.
    pub fn bookmark_before(&self, session: &Session) -> Option<Bookmark> {
        let same = |mark: &Bookmark| is_same(&mark.kept.session, session);
        let now = session.simulation().cycle();
        let at = self.bookmarks.iter().position(same);
        let at = at.unwrap_or_else(|| {
            let earlier = self.bookmarks.iter();
            earlier.filter(|mark| mark.kept.cycle() < now).count()
        });
        let before = at.checked_sub(1).or(self.bookmarks.len().checked_sub(1))?;
        self.bookmarks.get(before).cloned()
    }

    /// Goes to a bookmark. On the line of the present it becomes a place in the past; on another one
    /// it becomes the present itself, and only what led to it stays.
    pub fn visit(&mut self, mark: &Bookmark) {
        let goal = &mark.kept.session;
        let is_past = self
            .kept
            .last()
            .is_some_and(|present| leads_to(goal, &present.session));
        if !is_past {
            self.kept.retain(|kept| leads_to(&kept.session, goal));
        }
        let at = self
            .kept
            .iter()
            .position(|kept| is_same(&kept.session, goal));
        let at = at.unwrap_or_else(|| {
            let before = |kept: &&Arc<Kept>| leads_to(&kept.session, goal);
            let at = self.kept.iter().take_while(before).count();
            self.kept.insert(at, Arc::clone(&mark.kept));
            at
        });
        self.at = (at + 1 < self.kept.len()).then_some(at);
    }
}

/// Whether two sessions are the same run at the same moment.
fn is_same(a: &Session, b: &Session) -> bool {
    a.simulation().cycle() == b.simulation().cycle() && a.changes() == b.changes()
}

/// Whether `later` went through `earlier`: a run is made of its changes and nothing else, so it did
/// if every change since came after it.
fn leads_to(earlier: &Session, later: &Session) -> bool {
    let (from, to) = (earlier.simulation().cycle(), later.simulation().cycle());
    let made = earlier.changes().len();
    from <= to
        && later.changes().len() >= made
        && later.changes()[..made] == *earlier.changes()
        && later.changes()[made..]
            .iter()
            .all(|change| change.at_cycle >= from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    fn session() -> Session {
        let sets = [
            "numerics.points=16".into(),
            "numerics.steps_per_cycle=4".into(),
        ];
        let scenario = Scenario::load("li2019-fig3", &sets).expect("a preset");
        Session::start(scenario).expect("a contact")
    }

    /// A run whose every cycle up to `end` is kept.
    fn run_to(end: u32) -> (Session, Past) {
        let (mut session, mut past) = (session(), Past::default());
        for cycle in 0..=end {
            session.advance_to(f64::from(cycle)).expect("a step");
            past.keep(&session, &Trend::default());
        }
        (session, past)
    }

    fn cycles(past: &Past) -> Vec<f64> {
        past.kept.iter().map(|kept| kept.cycle()).collect()
    }

    #[test]
    fn memory_is_bounded_and_the_recent_past_is_dense() {
        let (mut session, trend) = (session(), Trend::default());
        let mut past = Past::default();
        past.keep(&session, &trend);
        past.budget = 24 * past.kept[0].bytes();
        for cycle in 1..=300 {
            session.advance_to(f64::from(cycle)).expect("a step");
            past.keep(&session, &trend);
            past.keep(&session, &trend);
            assert!(past.bytes() <= past.budget);
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
    fn marks_count_and_the_oldest_gives_way() {
        let (mut session, trend) = (session(), Trend::default());
        let mut past = Past::default();
        past.keep(&session, &trend);
        past.budget = 24 * past.kept[0].bytes();
        let mut dropped = 0;
        for cycle in 1..=200 {
            session.advance_to(f64::from(cycle)).expect("a step");
            past.keep(&session, &trend);
            dropped += past.mark(&session, &trend);
            assert!(past.bytes() <= past.budget);
            assert_eq!(dropped + past.marks(), cycle as usize);
        }
        // Half of the memory is theirs, and the newest are there.
        assert!(past.marks() >= 10, "{}", past.marks());
        assert!(cycles(&past).len() >= 8);
        let oldest = past.bookmarks[0].kept.cycle();
        assert_eq!(oldest, (201 - past.marks()) as f64);
    }

    #[test]
    fn back_and_forth_end_at_the_ends() {
        let (_, mut past) = run_to(3);
        let at = |kept: Option<Arc<Kept>>| kept.map(|kept| kept.cycle());
        assert!(past.forth().is_none());
        assert_eq!(at(past.back()), Some(2.0));
        assert_eq!(past.present(), Some(3.0));
        assert_eq!(at(past.back()), Some(1.0));
        assert_eq!(at(past.forth()), Some(2.0));
        assert_eq!(at(past.forth()), Some(3.0));
        assert_eq!(past.present(), None);
        assert_eq!(at(past.back()), Some(2.0));
        assert!(past.branch() && !past.branch());
        assert_eq!(cycles(&past), [0.0, 1.0, 2.0]);
        for _ in 0..3 {
            past.back();
        }
        assert!(past.back().is_none());
        assert_eq!(past.present(), Some(2.0));
    }

    #[test]
    fn a_bookmark_on_another_branch_brings_its_own_past() {
        let (mut session, mut past) = run_to(2);
        let trend = Trend::default();
        past.mark(&session, &trend);
        past.mark(&session, &trend);
        assert_eq!(past.marks(), 1);
        let early = past.back().expect("a state");
        past.branch();
        let mut other = early.session.clone();
        other.change("wear.law", "power").expect("a value");
        past.keep(&other, &trend);
        other.advance_to(4.0).expect("a step");
        past.keep(&other, &trend);
        assert_eq!(cycles(&past), [0.0, 1.0, 1.0, 4.0]);
        let mark = past.bookmark_before(&other).expect("a bookmark");
        past.visit(&mark);
        assert_eq!(cycles(&past), [0.0, 1.0, 2.0]);
        assert_eq!(past.present(), None);
        // On the same line it is a place in the past.
        session.advance_to(3.0).expect("a step");
        past.keep(&session, &trend);
        past.visit(&mark);
        assert_eq!(past.present(), Some(3.0));
    }
}
