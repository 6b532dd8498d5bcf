//! The frame that calm panels show while a run goes on: every third one, a third of the bytes and of the stresses.

use std::sync::Arc;

use super::frame::{Activity, Frame};
use super::panels::Panel;
use super::stage::Stage;

/// How many frames it lasts.
const LASTS: u32 = 3;

/// The frame, and how many it has lasted; none where the newest one is shown.
#[derive(Debug, Default)]
pub struct Calm(Option<(Arc<Frame>, u32)>);

impl Calm {
    /// Keeps its frame where `newest` comes, or takes that; for all of a cycle where it is `slow`: a contact that is
    /// shown large has the stress of one phase of the motion.
    pub fn take(&mut self, newest: &Arc<Frame>, slow: bool) {
        let begins = |frame: &Frame| frame.observation.moment.cycle.floor();
        let may_stay = |calm: &Frame, lasted| match slow {
            true => begins(calm) == begins(newest),
            false => lasted < LASTS,
        };
        let kept = self.0.take();
        let kept = kept.filter(|(calm, lasted)| may_stay(calm, *lasted) && may_last(calm, newest));
        self.0 = Some(kept.map_or_else(
            || (Arc::clone(newest), 1),
            |(calm, lasted)| (calm, lasted + 1),
        ));
    }

    /// The next frame is shown as it comes: the answer to a key is seen at once.
    pub fn wake(&mut self) {
        self.0 = None;
    }

    /// What a calm panel shows where the others show `frame`.
    pub fn of<'a>(&'a self, frame: &'a Frame) -> &'a Frame {
        self.0.as_ref().map_or(frame, |(calm, _)| calm)
    }

    /// What a panel shows where the screen is that of `frame`: large, the indenter moves with every frame.
    pub fn shown<'a>(&'a self, panel: Panel, stage: &Stage, frame: &'a Frame) -> &'a Frame {
        let is_large = panel == Panel::Section && stage.shows_contact();
        match panel.recipe().is_calm && !is_large {
            true => self.of(frame),
            false => frame,
        }
    }
}

/// Whether `calm` may stay where the others show `frame`: the run goes on, and both have what a panel shows.
fn may_last(calm: &Frame, frame: &Frame) -> bool {
    frame.activity == Activity::Running
        && frame.observation.moment.cycle >= calm.observation.moment.cycle
        && frame.load.is_some() == calm.load.is_some()
        && frame.comparison.is_some() == calm.comparison.is_some()
}
