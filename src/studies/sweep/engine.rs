//! Many points on several threads. Each thread takes the next free point, so all threads end at
//! about the same time, and rows arrive nearly in order.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;

use rayon::ThreadPool;
use rayon::prelude::*;

use super::point::{self, Success};
use super::{Shard, Study};
use crate::scenario::Refusal;

/// How many points are checked between two looks at the clock.
const CHUNK: usize = 256;

/// A check of the points of a shard: that each of them makes a valid scenario.
pub struct Check<'a> {
    study: &'a Study,
    /// The points that are not checked yet.
    left: Box<dyn Iterator<Item = usize> + Send + 'a>,
}

impl<'a> Check<'a> {
    /// None of them is checked yet. An invalid point is most often where an axis ends, so of many points those at both
    /// ends of all axes come first.
    pub fn new(study: &'a Study, shard: Shard) -> Self {
        let all = shard.points(study.points());
        Self {
            study,
            left: match all.len() > CHUNK {
                true => Box::new(edges(study, shard).into_iter().chain(all)),
                false => Box::new(all),
            },
        }
    }

    /// Checks points on the threads of `pool` as long as `go_on`, which is given the number checked so far,
    /// says so. Returns whether every point is checked.
    ///
    /// # Errors
    ///
    /// The first point of those checked together that is invalid, and why.
    pub fn advance(
        &mut self,
        pool: &ThreadPool,
        mut go_on: impl FnMut(usize) -> bool,
    ) -> Result<bool, Refusal> {
        let mut checked = 0;
        while go_on(checked) {
            let chunk: Vec<usize> = self.left.by_ref().take(CHUNK).collect();
            if chunk.is_empty() {
                return Ok(true);
            }
            checked += chunk.len();
            let invalid = |point| validated(self.study, point).err();
            let refused = pool.install(|| chunk.into_par_iter().find_map_first(invalid));
            refused.map_or(Ok(()), Err)?;
        }
        Ok(false)
    }

    /// Checks what is left on this thread, as long as `go_on` says so.
    ///
    /// # Errors
    ///
    /// The first point that is invalid, and why.
    fn finish(self, go_on: &dyn Fn() -> bool) -> Result<(), Refusal> {
        let mut left = self.left.take_while(|_| go_on());
        left.try_for_each(|point| validated(self.study, point))
    }
}

/// The points of a shard at the ends of each axis, the others at one of their ends.
fn edges(study: &Study, shard: Shard) -> Vec<usize> {
    let last = study.points() - 1;
    let mut step = 1_usize;
    let mut edges = vec![0, last];
    for axis in study.axes.iter().rev() {
        let along = step.saturating_mul(axis.count() - 1);
        edges.extend([along.min(last), last.saturating_sub(along)]);
        step = step.saturating_mul(axis.count());
    }
    edges.retain(|&point| shard.holds(point));
    edges
}

/// Refuses a point that makes no valid scenario.
fn validated(study: &Study, point: usize) -> Result<(), Refusal> {
    let refused = |error| Refusal::new(study.name(point), error);
    study.scenario(point).map(drop).map_err(refused)
}

/// Runs the points `todo` of `study` on the threads of `pool`, and gives each row to `finished`, on
/// the calling thread, when it is there. Stops after the present steps, losing the points that are
/// not finished, if `go_on` or `finished` says no.
///
/// # Errors
///
/// If `check` finds an invalid point among those it has not checked yet, which stops the others.
pub fn run(
    study: &Study,
    todo: impl Iterator<Item = usize> + Send,
    check: Option<Check>,
    pool: &ThreadPool,
    go_on: &(dyn Fn() -> bool + Sync),
    mut finished: impl FnMut(usize, Vec<String>) -> bool,
) -> Result<(), Refusal> {
    let (send, rows) = mpsc::channel();
    let is_halted = AtomicBool::new(false);
    let halt = || is_halted.store(true, Ordering::Relaxed);
    let go_on = || go_on() && !is_halted.load(Ordering::Relaxed);
    // Nobody waits for the check once the points are done.
    let is_done = AtomicBool::new(false);
    let is_strict = check.is_some();
    let row_of = |point| {
        let row = point::run(study, point, &go_on)?;
        // The check may not have come to it yet.
        let is_refused = is_strict && Success::of(&row) == Success::Invalid;
        let checked = is_refused.then(|| validated(study, point));
        Some(checked.unwrap_or(Ok(())).map(|()| (point, row)))
    };
    let mut refused = Ok(());
    std::thread::scope(|scope| {
        let check = scope.spawn(|| {
            let is_needed = || !is_done.load(Ordering::Relaxed);
            let checked = check.map_or(Ok(()), |check| check.finish(&is_needed));
            if checked.is_err() {
                halt();
            }
            checked
        });
        pool.in_place_scope(|scope| {
            scope.spawn(|_| {
                let todo = todo.take_while(|_| go_on()).par_bridge();
                let _ = todo.try_for_each_with(send, |send, point| send.send(row_of(point)?).ok());
            });
            for row in &rows {
                let is_taken = row.map(|(point, row)| finished(point, row));
                if !matches!(is_taken, Ok(true)) {
                    halt();
                    refused = is_taken.map(drop);
                    return;
                }
            }
        });
        is_done.store(true, Ordering::Relaxed);
        check.join().unwrap_or(Ok(()))
    })?;
    refused
}
