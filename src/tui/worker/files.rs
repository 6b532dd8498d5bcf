//! What the user asks for beside the run: files and studies.

use std::path::Path;

use super::Worker;
use crate::scenario::Scenario;
use crate::tui::event::Event;
use crate::tui::explorer::Copied;
use crate::tui::map::live::Live;
use crate::tui::map::range::Range;
use crate::tui::{figure, snapshot};

impl Worker {
    /// Starts a study of the present scenario, up to the present cycle.
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

    /// Sends the screen a text that repeats the run, for the clipboard.
    pub(in crate::tui) fn copy(&self, what: Copied) {
        let session = &self.run.session;
        let scenario = session.as_run(Vec::new()).to_toml();
        let (text, told) = match what {
            Copied::Command => (self.run_command(scenario), "the command is"),
            _ => (scenario, "the scenario is"),
        };
        self.screen.send(Event::Copied(text, told));
    }

    /// Returns the command that repeats the run. If options cannot describe the run, it includes the whole scenario.
    fn run_command(&self, scenario: String) -> String {
        let (session, cycle) = (&self.run.session, self.run.cycle());
        let loaded = session.loaded();
        let is_as_named = Scenario::load(loaded.origin(), &[]).is_ok_and(|named| named == *loaded);
        if is_as_named && session.changes().is_empty() && !loaded.origin().contains('\'') {
            format!(
                "mdr-tui run '{}' --cycles {cycle} --out again\n",
                loaded.origin()
            )
        } else {
            format!("mdr-tui run - --out again <<'END'\n{scenario}END\n")
        }
    }

    /// Draws a figure of the state into a file, and writes its data to a second one.
    pub fn write_figure(&self, path: &Path) {
        let written = figure::write(&self.run, path);
        self.screen.written("figure", written.map(|()| path));
    }
}
