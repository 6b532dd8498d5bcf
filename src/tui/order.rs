//! Orders from the explorer to the worker: the only data flow back from the screen.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::Sender;

use super::frame::Frame;
use super::map::live::Range;
use super::snapshot::Opened;
use crate::scenario::Scenario;
use crate::simulation::Curves;

/// What the explorer asks of the worker.
#[derive(Debug)]
pub enum Order {
    /// Run or pause.
    RunPause,
    /// Pause, one step.
    Step,
    /// Pause, to the end of the cycle.
    Cycle,
    /// Change the method by this many places.
    Method(isize),
    /// Change the wear law by this many places.
    Law(isize),
    /// Change the accuracy by this many places; finer if positive.
    Accuracy(isize),
    /// Change the pace by this many places.
    Pace(i32),
    /// A key of the scenario gets a value: TOML, or a bare word.
    Change {
        /// The dotted path.
        key: String,
        /// The value.
        value: String,
    },
    /// One saved state back in time.
    Back,
    /// One saved state forward in time.
    Forth,
    /// The saved state of this run that is nearest to a cycle.
    Visit(f64),
    /// Start again as loaded.
    Restart,
    /// Another scenario, from the start.
    Load(Box<Scenario>),
    /// A state that was written to a directory, to go on from.
    Open(Box<Opened>),
    /// Write the state to files, with a note if there is one.
    Snapshot(Option<String>),
    /// Draw a figure of the state into a file, its data beside it.
    Figure(PathBuf),
    /// Begin or end the comparison with another method.
    Compare,
    /// The same, begun at the start of the scenario.
    CompareFromStart,
    /// Lay the curves of a file, a directory or a scenario over the panels.
    Overlay(String),
    /// The same with the present state.
    Freeze,
    /// Take all of them away.
    DropGhosts,
    /// Take the frames of a fast run at one phase of the motion, or as they come.
    HoldPhase,
    /// Run the refinement_check on half the cells.
    RefinementCheck,
    /// Run a study over a range of one key, up to the present cycle.
    Sweep(Range),
    /// Compute these curves from now on.
    Show(Curves),
    /// Publish a frame when all earlier orders have been carried out.
    Sync(Sender<Arc<Frame>>),
    /// End.
    Quit,
}
