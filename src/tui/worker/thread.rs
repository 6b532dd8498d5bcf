//! The worker's thread: starting it, ending it, and what it has saved.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, TryLockError};
use std::thread;
use std::time::Duration;

use anyhow::{Context, Result};

use super::{Order, Orders, Worker};
use crate::export::autosave::Autosave;
use crate::tui::event::Event;
use crate::tui::recorded::Recorded;

/// Maximum time for the worker to finish its step on exit.
const LAST_STEP: Duration = Duration::from_millis(500);

/// Maximum time for a checkpoint being written on exit.
const SAVING_TIME: Duration = Duration::from_secs(5);

/// A running worker.
pub(in crate::tui) struct WorkerThread {
    orders: Orders,
    halt: Arc<AtomicBool>,
    autosave: Arc<Mutex<Autosave<Recorded>>>,
    /// Its final message about what it saved.
    saved: Receiver<Option<String>>,
}

/// Reports the end of the thread, however it ends.
struct EndReport(Sender<Event>);

impl Drop for EndReport {
    fn drop(&mut self) {
        let _ = self.0.send(Event::HangUp);
    }
}

impl WorkerThread {
    /// Starts `worker`, which receives its `orders` at `inbox` and whose session is saved automatically.
    pub fn start(
        mut worker: Worker,
        orders: Orders,
        inbox: Receiver<Order>,
        autosave: Autosave<Recorded>,
    ) -> Result<Self> {
        let (tell, saved) = channel();
        let halt = Arc::clone(&worker.halt);
        worker.autosave = Arc::new(Mutex::new(autosave));
        let autosave = Arc::clone(&worker.autosave);
        thread::Builder::new()
            .name("simulation".into())
            .spawn(move || {
                let _report = EndReport(worker.screen.events.clone());
                let _ = tell.send(worker.run_with_checkpoints(&inbox));
            })
            .context("cannot start the simulation's thread")?;
        Ok(Self {
            orders,
            halt,
            autosave,
            saved,
        })
    }

    /// Interrupts the worker and tells it to quit.
    pub fn end(&self) {
        self.halt.store(true, Ordering::SeqCst);
        self.orders.send(Order::Quit);
    }

    /// Returns where the session is saved. Does not wait for a worker in the middle of a long step, but saves its most
    /// recent copy.
    pub fn saved(&self) -> Option<String> {
        match self.saved.recv_timeout(LAST_STEP) {
            Ok(outcome) => return outcome,
            Err(RecvTimeoutError::Disconnected) => return None,
            Err(RecvTimeoutError::Timeout) => {}
        }
        match self.autosave.try_lock() {
            Ok(mut autosave) => autosave.finish(None),
            Err(TryLockError::Poisoned(autosave)) => autosave.into_inner().finish(None),
            // The session is being saved, which may take a while on a slow disk.
            Err(TryLockError::WouldBlock) => self.saved.recv_timeout(SAVING_TIME).ok().flatten(),
        }
    }
}
