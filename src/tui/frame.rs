//! What the worker publishes of the simulation, and the slot where the screen picks it up.

use std::sync::{Arc, Mutex, PoisonError};

use super::facts::Facts;
use crate::charts::Run;
use crate::reading::subsurface::{Peak, SpringLoad};
use crate::reading::{Check, CycleFigures, Observation};

/// What the worker is doing.
#[derive(Debug, Clone, PartialEq)]
pub enum Activity {
    /// Stepping.
    Running,
    /// Waiting for orders.
    Paused,
    /// At the planned end of the scenario.
    Done,
    /// Failed, with the reason.
    Stopped(String),
}

/// A second run in lockstep with the first.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// Method and cells.
    pub name: String,
    /// Its curves and scalars.
    pub observation: Observation,
    /// Its time per step, s.
    pub step_cost: Option<f64>,
    /// Why it stopped, if it did.
    pub stopped: Option<String>,
}

/// Everything that the screen shows of the simulation.
#[derive(Debug, Clone)]
pub struct Frame {
    /// What charts are made of: the curves that were computed, the past, and those of other sources.
    pub run: Run,
    /// What is known of the scenario.
    pub facts: Arc<Facts>,
    /// The curves and scalars.
    pub observation: Observation,
    /// What a fretting test reports of the last cycle.
    pub figures: Option<CycleFigures>,
    /// The phase of the tangential motion at which frames are taken, degrees; `None` while the motion is shown.
    pub phase: Option<f64>,
    /// What the worker does.
    pub activity: Activity,
    /// The requested pace, cycles per second; infinite without limit.
    pub pace: f64,
    /// Its actual speed, cycles per second; `None` until measured.
    pub speed: Option<f64>,
    /// Time per step, s.
    pub step_cost: Option<f64>,
    /// The cycle of the present, while the screen shows a state of the past.
    pub present: Option<f64>,
    /// The changes of the run up to the present: the cycle of each, and `KEY = VALUE`.
    pub changes: Vec<(f64, String)>,
    /// The cycles at which snapshots were written.
    pub snapshots: Vec<f64>,
    /// The load on the half-space, where its stresses are shown.
    pub load: Option<Arc<SpringLoad>>,
    /// The loads of the last cycle, where they are shown.
    pub cycle_loads: Vec<Arc<SpringLoad>>,
    /// The largest von Mises and the largest principal stress in the half-space, where they are shown.
    pub peaks: Option<[Peak; 2]>,
    /// The estimated error of the worn depth or of the volume, whichever is larger, relative, where it is known.
    pub error: Option<f64>,
    /// The checks of the moment; `None` if p is not computed.
    pub checks: Vec<Check>,
    /// The comparison run.
    pub comparison: Option<Comparison>,
}

/// The slot that holds the latest frame.
#[derive(Debug, Default)]
pub struct Slot(Mutex<Option<Arc<Frame>>>);

impl Slot {
    /// Takes the latest frame, if there is a new one.
    pub fn take(&self) -> Option<Arc<Frame>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Stores a frame; returns true if the slot was empty and the screen must be notified.
    pub(super) fn put(&self, frame: Arc<Frame>) -> bool {
        self.0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .replace(frame)
            .is_none()
    }
}
