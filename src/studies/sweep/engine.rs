//! Many points on several threads. Each thread takes the next free point, so all threads end at
//! about the same time, and rows arrive nearly in order.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;

use rayon::ThreadPool;
use rayon::prelude::*;

use super::point::{self, Row};
use super::{Study, StudyError};

/// Builds the scenario of every point of `todo` and returns why the first invalid one is refused.
pub fn first_invalid(study: &Study, todo: &[usize], pool: &ThreadPool) -> Option<StudyError> {
    let refusal = |&point: &usize| {
        let error = study.scenario(point).err()?;
        Some(StudyError(format!("{}: {error}", study.name(point))))
    };
    pool.install(|| todo.par_iter().find_map_first(refusal))
}

/// Runs the points `todo` of `study` on the threads of `pool`, and gives each row to `finished`, on
/// the calling thread, when it is there. Stops after the present steps, losing the points that are
/// not finished, if `halt` is set or `finished` breaks.
pub fn run(
    study: &Study,
    todo: &[usize],
    pool: &ThreadPool,
    halt: &AtomicBool,
    mut finished: impl FnMut(usize, Row) -> ControlFlow<()>,
) {
    let (send, rows) = mpsc::channel();
    let next = AtomicUsize::new(0);
    let work = |send: mpsc::Sender<(usize, Row)>| {
        while !halt.load(Ordering::Relaxed) {
            let Some(&point) = todo.get(next.fetch_add(1, Ordering::Relaxed)) else {
                return;
            };
            let Some(row) = point::run(study, point, halt) else {
                return;
            };
            if send.send((point, row)).is_err() {
                return;
            }
        }
    };
    pool.in_place_scope(|scope| {
        for _ in 0..pool.current_num_threads() {
            let send = send.clone();
            scope.spawn(|_| work(send));
        }
        drop(send);
        for (point, row) in &rows {
            if finished(point, row).is_break() {
                halt.store(true, Ordering::Relaxed);
                return;
            }
        }
    });
}
