//! What the worker shows of the simulation, and the place where it waits to be taken.

use std::sync::{Arc, Mutex, PoisonError};

use super::pace::Pace;
use super::settings::Setting;
use super::trend::Trend;
use crate::contact::indenter::Indenter;
use crate::contact::subsurface::{Peak, SpringLoad};
use crate::simulation::{Check, CycleFigures, Observation};
use crate::studies::ghost::Ghost;
use crate::studies::theory::Theory;

/// What the worker is doing.
#[derive(Debug, Clone, PartialEq)]
pub enum Activity {
    /// Stepping.
    Running,
    /// Waiting for orders.
    Paused,
    /// At the end of the scenario's plan.
    Done,
    /// Broken down; the text says why.
    Stopped(String),
}

/// A second run in lockstep with the first.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// Method and cells.
    pub name: String,
    /// Its curves and scalars.
    pub observation: Observation,
    /// What a step of it costs, s.
    pub step_cost: Option<f64>,
    /// Why it stopped, if it did.
    pub stopped: Option<String>,
}

/// All that a screen shows of the simulation.
#[derive(Debug, Clone)]
pub struct Frame {
    /// The curves and scalars.
    pub observation: Observation,
    /// What a fretting test reports of the last cycle.
    pub figures: Option<CycleFigures>,
    /// The wear coefficient k, 1/Pa; none without wear.
    pub wear_coefficient: Option<f64>,
    /// The phase of the tangential motion at which frames are taken, degrees; none while the motion is shown.
    pub phase: Option<f64>,
    /// The past.
    pub trend: Trend,
    /// What the worker does.
    pub activity: Activity,
    /// How fast it may go.
    pub pace: Pace,
    /// How fast it goes, cycles a second; none until measured.
    pub speed: Option<f64>,
    /// What a step costs, s.
    pub step_cost: Option<f64>,
    /// The scenario's title.
    pub title: String,
    /// The preset's name or the file.
    pub origin: String,
    /// Where the scenario's plan ends, cycles.
    pub planned_cycles: Option<f64>,
    /// Steps a cycle.
    pub steps_per_cycle: u32,
    /// The cycle of the present, while the screen shows a state of the past.
    pub present: Option<f64>,
    /// The keys that can be changed, with their values.
    pub settings: Arc<Vec<Setting>>,
    /// The unworn shape, which goes on beyond the domain.
    pub indenter: Indenter,
    /// The indenter's share of the wear, where the scenario gives one.
    pub wear_share: Option<f64>,
    /// μ, for the scale of τ.
    pub friction: f64,
    /// The load on the half-space, where its stresses are shown.
    pub load: Option<Arc<SpringLoad>>,
    /// The loads of the last cycle, where they are shown.
    pub cycle_loads: Vec<Arc<SpringLoad>>,
    /// The largest von Mises and the largest principal stress in the half-space, where they are shown.
    pub peaks: Option<[Peak; 2]>,
    /// The amplitude of u_x from which the present profile slips as a whole, m, where it is shown.
    pub slip_border: Option<f64>,
    /// The certificates of the moment; none where p is not computed.
    pub checks: Vec<Check>,
    /// Where the scene lies outside of the theory.
    pub warnings: Arc<Vec<String>>,
    /// What theory says of the scene.
    pub theory: Arc<Theory>,
    /// Curves of other sources, to be drawn over those of the run.
    pub ghosts: Vec<Arc<Ghost>>,
    /// The run beside this one.
    pub comparison: Option<Comparison>,
}

/// The place where the latest frame waits to be taken.
#[derive(Debug, Default)]
pub struct Slot(Mutex<Option<Arc<Frame>>>);

impl Slot {
    /// Takes the latest frame, if there is a new one.
    pub fn take(&self) -> Option<Arc<Frame>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Puts a frame there; true if the place was empty and the screen must be told.
    pub(super) fn put(&self, frame: Arc<Frame>) -> bool {
        self.0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .replace(frame)
            .is_none()
    }
}
