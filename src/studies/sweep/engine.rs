//! Runs many points on several threads. Each thread takes the next free point, so all threads end at about the same
//! time, and rows arrive nearly in order.

use std::io;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, Sender};
use std::thread;
use std::time::{Duration, Instant};

use super::point;
use super::{Row, Shard, Study};
use crate::scenario::Refusal;

/// Maximum time for checking points before the first one runs.
const CHECKED_FIRST: Duration = Duration::from_secs(1);

/// Number of points from which the ends of the axes are checked first.
const MANY: usize = 256;

/// Checks for a second that the points of a shard are valid scenarios. Invalid points are usually at the end of an
/// axis, so in a large study the points at the ends of all axes come first.
///
/// # Errors
///
/// The first invalid point, and why it is invalid.
pub fn check(study: &Study, shard: Shard) -> Result<(), Refusal> {
    let (start, all) = (Instant::now(), shard.points(study.points()));
    let first = if all.len() > MANY {
        edges(study, shard)
    } else {
        Vec::new()
    };
    let points = first.into_iter().chain(all);
    let mut points = points.take_while(|_| start.elapsed() < CHECKED_FIRST);
    points.try_for_each(|point| validated(study, point))
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

/// Runs the points `todo` of `study` on as many `threads`, and passes each row to `finished` on the calling thread as
/// soon as it is complete. If `go_on` or `finished` returns false, stops after the current steps and loses unfinished
/// points.
///
/// # Errors
///
/// If the system cannot start a thread.
pub fn run(
    study: &Study,
    todo: &[usize],
    threads: usize,
    go_on: &(dyn Fn() -> bool + Sync),
    finished: impl FnMut(Row) -> bool,
) -> io::Result<()> {
    let (next, is_halted) = (AtomicUsize::new(0), AtomicBool::new(false));
    let go_on = || go_on() && !is_halted.load(Ordering::Relaxed);
    let work = |send: Sender<Row>| {
        while go_on()
            && let Some(&point) = todo.get(next.fetch_add(1, Ordering::Relaxed))
            && let Some(row) = point::run(study, point, &go_on)
            && send.send(row).is_ok()
        {}
    };
    let work = &work;
    thread::scope(|scope| {
        let (send, rows) = mpsc::channel();
        let started = (0..threads.min(todo.len())).try_for_each(|_| {
            let send = send.clone();
            let thread = thread::Builder::new().spawn_scoped(scope, move || work(send));
            thread.map(drop)
        });
        drop(send);
        if started.is_ok() {
            // Ends with the last thread, which drops the last sender.
            let _ = rows.into_iter().map(finished).find(|go_on| !go_on);
        }
        is_halted.store(true, Ordering::Relaxed);
        started
    })
}
