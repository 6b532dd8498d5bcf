//! What the worker publishes of the simulation, what is known of a run before it is run, and the slot where the screen
//! picks a frame up.

use std::sync::{Arc, Mutex};

use super::beside::Comparison;
use super::settings::Setting;
use crate::charts::Run;
use crate::panics::locked;
use crate::reading::subsurface::{Peak, SpringLoad};
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
    /// Whether frames are taken at the ends of cycles, phase 0 of the motion; else the motion is shown.
    pub shows_ends: bool,
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
    /// The changes of the run up to the present.
    pub changes: Vec<Change>,
    /// The cycles at which snapshots were written.
    pub snapshots: Vec<f64>,
    /// The load on the half-space, where its stresses are shown.
    pub load: Option<Arc<SpringLoad>>,
    /// The loads of the last cycle, where they are shown.
    pub cycle_loads: Vec<Arc<SpringLoad>>,
    /// The largest von Mises and the largest principal stress in the half-space, where they are shown.
    pub peaks: Option<[Peak; 2]>,
    /// The cycle up to which the errors of the run are estimated, and what they are; else why they are not.
    pub errors: Result<(f64, Difference), String>,
    /// The checks of the moment.
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
        locked(&self.0).take()
    }

    /// Stores a frame; returns true if the slot was empty and the screen must be notified.
    pub(super) fn put(&self, frame: Arc<Frame>) -> bool {
        locked(&self.0).replace(frame).is_none()
    }
}

/// The present scenario in numbers and words.
#[derive(Debug, Clone)]
pub struct Facts {
    /// The scenario that the run follows now.
    pub scenario: Scenario,
    /// About the deepest wear at the planned end of the scenario as it was loaded, m; 0 where it is not known. An
    /// edit does not change it: wear is drawn by one factor from the start of a run to its end.
    pub expected_wear: f64,
    /// The keys that can be changed, with their values.
    pub settings: Vec<Setting>,
    /// Where the scenario leaves the theory.
    pub warnings: Vec<String>,
    /// What the warnings say of the hardness, which any step may pass.
    pub passed_hardness: Option<Passed>,
    /// Closed forms for the scenario.
    pub theory: Arc<Theory>,
}

impl Facts {
    /// Those of the scenario that `session` runs now.
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
