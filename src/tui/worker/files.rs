//! What the user asks for beside the run: files, and a study.

use super::*;
use crate::tui::map::live::Live;
use crate::tui::map::range::Range;
use crate::tui::{figure, snapshot};

impl Worker {
    /// Starts a study around the present scenario, up to the present cycle.
    pub fn sweep(&self, range: &Range) {
        let cycles = match self.run.cycle() {
            0.0 => self.run.session.loaded().run().cycles.unwrap_or(1.0),
            cycle => cycle,
        };
        let events = self.screen.events.clone();
        let tell = move || {
            let _ = events.send(Event::News);
        };
        let live = Live::start(range, self.run.session.scenario(), cycles, tell);
        if let Some(live) = self.screen.or_notice(live) {
            self.screen.send(Event::Sweep(live));
        }
    }

    /// Writes the state to a new directory, with a note if there is one.
    pub fn write_snapshot(&mut self, note: Option<&str>) {
        let written = snapshot::write(&self.run, note);
        let cycle = written.is_ok().then(|| self.run.cycle());
        self.snapshots.extend(cycle);
        self.screen.written("snapshot", written);
    }

    /// Draws a figure of the state into a file, its data beside it.
    pub fn write_figure(&self, path: &Path) {
        let written = figure::write(&self.run, path);
        self.screen.written("figure", written.map(|()| path));
    }
}
