//! Runs many points on several threads. Each thread takes the next free point, so all threads end at about the same
//! time, and rows arrive nearly in order.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;

use rayon::ThreadPool;
use rayon::prelude::*;

use super::point;
use super::{Shard, Study};
use crate::scenario::Refusal;

/// Number of points checked between two looks at the clock.
const CHUNK: usize = 256;

/// Checks on the threads of `pool` that the points of a shard are valid scenarios, while `go_on`, called with the
/// number checked so far, returns true. Invalid points are usually at the end of an axis, so in a large study the
/// points at the ends of all axes come first.
///
/// # Errors
///
/// The first invalid point, and why it is invalid.
pub fn check(
    study: &Study,
    shard: Shard,
    pool: &ThreadPool,
    mut go_on: impl FnMut(usize) -> bool,
) -> Result<(), Refusal> {
    let all = shard.points(study.points());
    let first = if all.len() > CHUNK {
        edges(study, shard)
    } else {
        Vec::new()
    };
    let mut left = first.into_iter().chain(all).peekable();
    let mut checked = 0;
    while left.peek().is_some() && go_on(checked) {
        let chunk: Vec<usize> = left.by_ref().take(CHUNK).collect();
        checked += chunk.len();
        let invalid = |point| validated(study, point).err();
        let refused = pool.install(|| chunk.into_par_iter().find_map_first(invalid));
        refused.map_or(Ok(()), Err)?;
    }
    Ok(())
}

/// Returns the points of a shard at the ends of each axis, with the other axes at one of their ends.
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

/// Checks that a point is a valid scenario.
///
/// # Errors
///
/// Why it is not.
pub fn validated(study: &Study, point: usize) -> Result<(), Refusal> {
    let refused = |error| Refusal::new(study.name(point), error);
    study.scenario(point).map(drop).map_err(refused)
}

/// Runs the points `todo` of `study` on the threads of `pool`, and passes each row to
/// `finished` on the calling thread as soon as it is there. If `go_on` or `finished`
/// returns false, stops after the current steps and loses unfinished points.
pub fn run(
    study: &Study,
    todo: impl Iterator<Item = usize> + Send,
    pool: &ThreadPool,
    go_on: &(dyn Fn() -> bool + Sync),
    mut finished: impl FnMut(usize, Vec<String>) -> bool,
) {
    let (send, rows) = mpsc::channel();
    let is_halted = AtomicBool::new(false);
    let go_on = || go_on() && !is_halted.load(Ordering::Relaxed);
    pool.in_place_scope(|scope| {
        scope.spawn(|_| {
            let todo = todo.take_while(|_| go_on()).par_bridge();
            let row_of = |point| Some((point, point::run(study, point, &go_on)?));
            let _ = todo.try_for_each_with(send, |send, point| send.send(row_of(point)?).ok());
        });
        for (point, row) in &rows {
            if !finished(point, row) {
                return is_halted.store(true, Ordering::Relaxed);
            }
        }
    });
}
