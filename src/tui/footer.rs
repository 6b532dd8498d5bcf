//! The line below the panels: a notice, the values at the cursor, or the keys of the present mode.

use ratatui::prelude::*;

use super::app::App;
use super::canvas::Canvas;
use super::command::Command::{self, self as C};
use super::explorer::Explorer;
use super::frame::Activity;
use super::overlays::Overlay;
use super::readout;
use crate::plot::theme::Role;

/// The hint before the first key.
const HINT: &str =
    "Space pauses, + runs faster, Enter explains, V: the contact, n: a tour.   ? help   q quit";

/// Commands, with names where they differ from the table's.
type Mode = &'static [(Command, &'static str)];

/// The commands shown by default.
#[rustfmt::skip]
pub const USUAL: Mode = &[
    (C::RunPause, ""), (C::Accept, ""), (C::Step, ""), (C::Cycle, ""), (C::NextMethod, ""), (C::NextLaw, ""),
    (C::NextPage, ""), (C::NextPanel, ""), (C::Zoom, ""), (C::Snapshot, ""), (C::Edit, ""), (C::Presets, ""),
    (C::Compare, ""), (C::Palette, ""),
];

/// The commands that are always shown.
const ALWAYS: Mode = &[(C::Help, ""), (C::Quit, "")];

const IN_THE_PAST: Mode = &[
    (C::TimeBack, "back"),
    (C::TimeForth, "forward"),
    (C::RunPause, "run on from here"),
    (C::Edit, "change from here"),
];

#[rustfmt::skip]
const COMPARING: Mode = &[
    (C::NextMethod, "other method"), (C::CompareFromStart, "from the start"), (C::Compare, "end comparison"),
    (C::RunPause, ""), (C::Step, ""), (C::Cycle, ""),
];

#[rustfmt::skip]
const AT_THE_CONTACT: Mode = &[
    (C::Contact, "all panels"), (C::RunPause, ""), (C::Faster, ""), (C::Step, ""), (C::Cycle, ""), (C::Accept, ""),
    (C::Stress, "other stress"), (C::Edit, ""), (C::Presets, ""), (C::Palette, ""),
];

#[rustfmt::skip]
const ON_TOUR: Mode = &[
    (C::Tour, "next caption"), (C::Back, "close the tour"), (C::RunPause, ""), (C::Faster, ""), (C::Accept, ""),
];

fn mode(explorer: &Explorer) -> Mode {
    match &*explorer.frame {
        frame if frame.compares => COMPARING,
        frame if frame.present.is_some() => IN_THE_PAST,
        _ if explorer.stage.tour.is_some() => ON_TOUR,
        _ if explorer.stage.shows_contact() => AT_THE_CONTACT,
        _ => USUAL,
    }
}

/// Draws the notice if there is one, else the values at the cursor, else as many keys as fit.
pub fn draw(app: &App, mut canvas: Canvas) {
    let explorer = &app.explorer;
    let (frame, room) = (&*explorer.frame, usize::from(canvas.area.width));
    // The form shows notices itself.
    let notice = explorer.notice.as_deref();
    let notice = notice.filter(|_| !matches!(app.overlays.last(), Some(Overlay::Form(_))));
    let stopped = match &frame.activity {
        Activity::Stopped(reason) => Some((&**reason, Role::Alarm)),
        _ => None,
    };
    let is_usual = explorer.stage.tour.is_none() && !explorer.stage.shows_contact();
    let hints = explorer.is_new && is_usual && HINT.len() < room;
    let message = notice.map(|text| (text, Role::Notice)).or(stopped);
    let message = message.or(hints.then_some((HINT, Role::Notice)));
    let focus = explorer.stage.focus;
    if let (Some(place), None) = (explorer.cursor_in(focus), message) {
        let charts = &explorer.charts;
        let text = readout::line_at(frame, charts, focus, place, room, &canvas.theme);
        return canvas.show(Line::raw(text));
    }
    let [keys, always] = [mode(explorer), ALWAYS].map(texts);
    canvas.keys(message, &keys, &always);
}

/// Returns the keys of commands and their names.
fn texts(mode: Mode) -> Vec<[String; 2]> {
    let texts = mode.iter().map(|(command, name)| {
        let row = command.row();
        let name = if name.is_empty() { row.name } else { name };
        [row.keys[0].to_string(), name.to_owned()]
    });
    texts.collect()
}
