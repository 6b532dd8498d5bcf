//! What the worker publishes of the simulation, and the slot where the screen picks it up.

use std::sync::{Arc, Mutex, PoisonError};

use super::pace::Pace;
use super::settings::Setting;
use super::trend::Trend;
use crate::charts::{Live, Loop, Run};
use crate::contact::indenter::Indenter;
use crate::export::state;
use crate::reading::subsurface::{Peak, SpringLoad};
use crate::reading::{Check, Observation};
use crate::simulation::CycleFigures;
use crate::studies::ghost::Ghost;
use crate::studies::theory::Theory;
use crate::traces::Table;

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
    /// The curves and scalars.
    pub observation: Observation,
    /// What a fretting test reports of the last cycle.
    pub figures: Option<CycleFigures>,
    /// The wear coefficient k, 1/Pa; `None` without wear.
    pub wear_coefficient: Option<f64>,
    /// The phase of the tangential motion at which frames are taken, degrees; `None` while the motion is shown.
    pub phase: Option<f64>,
    /// The past.
    pub trend: Trend,
    /// What the worker does.
    pub activity: Activity,
    /// The requested pace.
    pub pace: Pace,
    /// Its actual speed, cycles per second; `None` until measured.
    pub speed: Option<f64>,
    /// Time per step, s.
    pub step_cost: Option<f64>,
    /// The scenario's title.
    pub title: String,
    /// The preset's name or the file.
    pub origin: String,
    /// Where the scenario's plan ends, cycles.
    pub planned_cycles: Option<f64>,
    /// About the deepest wear at the planned end, m; 0 where it is not known.
    pub expected_wear: f64,
    /// Steps per cycle.
    pub steps_per_cycle: u32,
    /// The cycle of the present, while the screen shows a state of the past.
    pub present: Option<f64>,
    /// The changes of the run up to the present: the cycle of each, and `KEY = VALUE`.
    pub changes: Vec<(f64, String)>,
    /// The cycles at which snapshots were written.
    pub snapshots: Vec<f64>,
    /// The keys that can be changed, with their values.
    pub settings: Arc<Vec<Setting>>,
    /// The unworn shape, also beyond the domain.
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
    /// The estimated error of the worn depth or of the volume, whichever is larger, relative, where it is known.
    pub error: Option<f64>,
    /// The checks of the moment; `None` if p is not computed.
    pub checks: Vec<Check>,
    /// Where the scenario leaves the theory.
    pub warnings: Arc<Vec<String>>,
    /// Closed forms for the scenario.
    pub theory: Arc<Theory>,
    /// Curves of other sources, to be drawn over those of the run.
    pub ghosts: Vec<Arc<Ghost>>,
    /// The comparison run.
    pub comparison: Option<Comparison>,
}

impl Frame {
    /// What charts are made of: the curves that were computed, and the past.
    pub fn run(&self) -> Run {
        let seen = &self.observation;
        let log = self.trend.loops().map(|(end, shifts, forces)| Loop {
            end,
            shifts,
            forces,
            ..Loop::default()
        });
        Run {
            states: vec![Table::of_columns(
                vec![("cycle".to_owned(), seen.moment.cycle.to_string())],
                state::columns(seen),
            )],
            history: Some(self.trend.history()),
            loops: vec![self.trend.last_loop(seen.moment.cycle)],
            ghosts: self.ghosts.clone(),
            field: None,
            theory: Some(Arc::clone(&self.theory)),
            indenter: Some(self.indenter.clone()),
            live: Some(Live {
                moment: seen.moment,
                wears: seen.law.is_some(),
                friction: self.friction,
                planned_cycles: self.planned_cycles,
                expected_wear: self.expected_wear,
                is_within_a_cycle: self.trend.is_within_a_cycle(),
                regime: self.figures.as_ref().map(|figures| figures.regime.title()),
                slip_border: self.slip_border,
                log: log.collect(),
            }),
        }
    }
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
