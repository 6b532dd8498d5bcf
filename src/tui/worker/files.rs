//! What the user asks for besides the run: files, texts and studies.

use std::path::PathBuf;

use super::Order;
use crate::scenario::Scenario;
use crate::tui::event::Event;
use crate::tui::map::live::LiveStudy;
use crate::tui::map::range::SweepRange;
use crate::tui::recorded::Recorded;
use crate::tui::{figure as drawing, snapshot as state};

/// What can be copied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Copied {
    /// The numbers of the moment.
    Readings,
    /// The scenario that repeats the run.
    Scenario,
    /// The command that repeats the run.
    Command,
}

/// Starts a study of the present scenario, up to the present cycle.
pub fn sweep(range: SweepRange) -> Order {
    Order::Make(Box::new(move |run, screen| {
        let cycles = match run.cycle() {
            0.0 => run.session.loaded().run().cycles.unwrap_or(1.0),
            cycle => cycle,
        };
        let events = screen.events.clone();
        let tell = move || {
            let _ = events.send(Event::News);
        };
        let live = LiveStudy::start(&range, run.session.scenario(), cycles, tell);
        if let Some(live) = screen.or_notice(live) {
            screen.send(Event::Sweep(live));
        }
    }))
}

/// Writes the state to a new directory, with a note if there is one.
pub fn snapshot(note: Option<String>) -> Order {
    Order::Make(Box::new(move |run, screen| {
        let written = state::write(run, note.as_deref());
        let cycle = written.is_ok().then(|| run.cycle());
        screen.snapshots.extend(cycle);
        screen.written("snapshot", written);
    }))
}

/// Draws a figure of the state into a file, and writes its data to a second one.
pub fn figure(path: PathBuf) -> Order {
    Order::Make(Box::new(move |run, screen| {
        let written = drawing::write(run, &path);
        screen.written("figure", written.map(|()| &path));
    }))
}

/// Sends the screen a text that repeats the run, for the clipboard.
pub fn copy(what: Copied) -> Order {
    Order::Make(Box::new(move |run, screen| {
        let scenario = run.session.as_run(Vec::new()).to_toml();
        let (text, copied_name) = match what {
            Copied::Command => (command(run, scenario), "the command is"),
            _ => (scenario, "the scenario is"),
        };
        screen.send(Event::Copied(text, copied_name));
    }))
}

/// Returns the command that repeats the run. If options cannot describe the run, it includes the whole scenario.
fn command(run: &Recorded, scenario: String) -> String {
    let (loaded, cycle) = (run.session.loaded(), run.cycle());
    let origin = loaded.origin();
    let is_as_named = Scenario::load(origin, &[]).is_ok_and(|named| named == *loaded);
    if is_as_named && run.session.changes().is_empty() && !origin.contains('\'') {
        format!("mdr-tui run '{origin}' --cycles {cycle} --out again\n")
    } else {
        format!("mdr-tui run - --out again <<'END'\n{scenario}END\n")
    }
}
