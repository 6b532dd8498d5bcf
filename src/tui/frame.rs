//! What the worker publishes about the simulation, and the slot from which the screen takes frames.

use std::sync::{Arc, Mutex, OnceLock};

use super::settings::Setting;
use crate::charts::{Live, Run};
use crate::panics::locked;
use crate::reading::Check;
use crate::reading::subsurface::{Peak, SpringLoad, Stress};
use crate::scenario::Change;
use crate::studies::refinement::Difference;

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

/// Everything that the screen shows about the simulation.
#[derive(Debug, Clone)]
pub struct Frame {
    /// The data for charts: computed curves, the past, and overlays.
    pub run: Run,
    /// The present moment.
    pub live: Live,
    /// Warnings about limits of the theory.
    pub warnings: Arc<[String]>,
    /// Whether frames are taken at the ends of cycles, phase 0 of the motion; otherwise they show the motion.
    pub shows_ends: bool,
    /// What the worker is doing.
    pub activity: Activity,
    /// The requested pace, cycles per second; infinite for no limit.
    pub pace: f64,
    /// The actual speed, cycles per second; `None` until measured.
    pub speed: Option<f64>,
    /// Time per step, s.
    pub step_cost: Option<f64>,
    /// The cycle of the present, while the screen shows the past.
    pub present: Option<f64>,
    /// The changes of the run up to the present.
    pub changes: Vec<Change>,
    /// The cycles at which snapshots were written.
    pub snapshots: Vec<f64>,
    /// The load on the half-space, if its stresses are shown.
    pub load: Option<Arc<SpringLoad>>,
    /// The loads of the last cycle, if they are shown.
    pub cycle_loads: Vec<Arc<SpringLoad>>,
    /// The largest stresses in the half-space, once [`Self::peaks`] has found them.
    pub found_peaks: OnceLock<Option<[Peak; 2]>>,
    /// The cycle up to which the run's errors are estimated, with the errors, or why there is no estimate.
    pub errors: Result<(f64, Difference), String>,
    /// The present checks.
    pub checks: Vec<Check>,
    /// Whether one of the ghosts is the run by another method, which the keys for methods change.
    pub compares: bool,
}

impl Frame {
    /// The keys that can be changed, with their values.
    pub fn settings(&self) -> Vec<Setting> {
        Setting::all(&self.live.scenario)
    }

    /// Finds the setting of a key.
    pub fn setting(&self, key: &str) -> Option<Setting> {
        let mut settings = self.settings().into_iter();
        settings.find(|setting| setting.key.path == key)
    }

    /// Returns the largest von Mises and the largest principal stress in the half-space; `None` without contact, or
    /// unless stresses are shown.
    pub fn peaks(&self) -> Option<[Peak; 2]> {
        let touches = self.live.observation.moment.contact_radius > 0.0;
        let shown: [fn(&Stress) -> f64; 2] = [Stress::von_mises, Stress::max_principal];
        let find = || {
            let load = self.load.as_ref().filter(|_| touches)?;
            Some(shown.map(|of| load.largest(of)))
        };
        *self.found_peaks.get_or_init(find)
    }
}

/// The slot that holds the latest frame.
#[derive(Debug, Default)]
pub struct Slot(Mutex<Option<Arc<Frame>>>);

impl Slot {
    /// Takes the latest frame, if there is a new one.
    pub fn take(&self) -> Option<Arc<Frame>> {
        locked(&self.0).take()
    }

    /// Stores a frame; returns true if the slot was empty, in which case the screen must be notified.
    pub(super) fn put(&self, frame: Arc<Frame>) -> bool {
        locked(&self.0).replace(frame).is_none()
    }
}
