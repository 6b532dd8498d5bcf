//! What the worker publishes about the simulation, facts about the scenario, and the slot from which the screen takes
//! frames.

use std::sync::{Arc, Mutex, OnceLock};

use super::beside::Comparison;
use super::settings::Setting;
use crate::charts::Run;
use crate::panics::locked;
use crate::reading::subsurface::{Peak, SpringLoad, Stress};
use crate::reading::{Check, CycleFigures, Observation, Passed};
use crate::scenario::session::Session;
use crate::scenario::{Change, Scenario};
use crate::studies::refinement::Difference;
use crate::studies::theory::Theory;

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
    /// Facts about the scenario.
    pub facts: Arc<Facts>,
    /// The computed curves and scalars.
    pub observation: Arc<Observation>,
    /// What a fretting test reports for the last cycle.
    pub figures: Option<CycleFigures>,
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
    /// The comparison run.
    pub comparison: Option<Comparison>,
}

impl Frame {
    /// Returns the largest von Mises and the largest principal stress in the half-space; `None` without contact, or
    /// unless stresses are shown.
    pub fn peaks(&self) -> Option<[Peak; 2]> {
        let touches = self.observation.moment.contact_radius > 0.0;
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

/// Facts about the present scenario.
#[derive(Debug, Clone)]
pub struct Facts {
    /// The scenario that the run follows now.
    pub scenario: Scenario,
    /// Rough estimate of the deepest wear at the planned end of the scenario as loaded, m; 0 if unknown. An edit does
    /// not change it, so that wear is drawn with one factor during the whole run.
    pub expected_wear: f64,
    /// The keys that can be changed, with their values.
    pub settings: Vec<Setting>,
    /// Warnings about limits of the theory.
    pub warnings: Vec<String>,
    /// Where the pressure first exceeded the hardness, as the warnings say; it can happen in any step.
    pub passed_hardness: Option<Passed>,
    /// Closed forms for the scenario.
    pub theory: Arc<Theory>,
}

impl Facts {
    /// Collects the facts of the scenario that `session` runs now.
    pub fn of(session: &Session) -> Arc<Self> {
        let scenario = session.scenario();
        let loaded = session.loaded().setup();
        let expected_wear = Theory::of(loaded).expected_wear(loaded, scenario.run().cycles);
        Arc::new(Self {
            scenario: scenario.clone(),
            expected_wear: expected_wear.unwrap_or(0.0),
            settings: Setting::all(scenario),
            warnings: session.warnings(),
            passed_hardness: session.log().passed_hardness(),
            theory: Arc::new(Theory::of(session.simulation().setup())),
        })
    }
}
