//! The worker's thread: how it begins and ends, and what it has saved then.

use std::sync::TryLockError;
use std::thread;

use anyhow::{Context, Result};

use super::*;

/// How long the worker may take to finish its step on exit.
const LAST_STEP: Duration = Duration::from_millis(500);

/// How long a checkpoint being written may take on exit.
const SAVING_TIME: Duration = Duration::from_secs(5);

/// A worker that runs.
pub(in crate::tui) struct WorkerThread {
    orders: Orders,
    halt: Arc<AtomicBool>,
    autosave: Arc<Mutex<ScreenAutosave>>,
    /// Its final message about what it has saved.
    saved: Receiver<Option<String>>,
}

/// Reports its end, however it ends.
struct EndReport(Sender<Event>);

impl Drop for EndReport {
    fn drop(&mut self) {
        let _ = self.0.send(Event::HangUp);
    }
}

impl WorkerThread {
    /// Starts `worker`, whose `orders` come at `inbox`, and which has its session saved.
    pub fn start(
        mut worker: Worker,
        orders: Orders,
        inbox: Receiver<Order>,
        autosave: ScreenAutosave,
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
        self.orders.send(Worker::quit);
    }

    /// Where the session is saved. A worker in the middle of a long step is not waited for: its most recent copy is
    /// saved instead.
    pub fn saved(&self) -> Option<String> {
        match self.saved.recv_timeout(LAST_STEP) {
            Ok(told) => return told,
            Err(RecvTimeoutError::Disconnected) => return None,
            Err(RecvTimeoutError::Timeout) => {}
        }
        match self.autosave.try_lock() {
            Ok(mut autosave) => autosave.finish(None),
            Err(TryLockError::Poisoned(autosave)) => autosave.into_inner().finish(None),
            // It is being saved, which may take a while on a slow disk.
            Err(TryLockError::WouldBlock) => self.saved.recv_timeout(SAVING_TIME).ok().flatten(),
        }
    }
}
