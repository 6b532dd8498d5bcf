//! The whole screen: status line, panels, footer and overlays.
//!
//! ```text
//! running | cycle 50.72/199.24 | 0.5 cycles/s | product | archard        Fig. 3 ...
//!  0 ======v=====O=======------------------------------------------------- 199.24
//! - 3D profile ----------------------- - stresses ---------------------------
//!   plot                                 plot
//! - 1D profile ----------------------- - fretting loop ----------------------
//!   plot                                 plot
//! - radii over cycles ---------------- - numbers ----------------------------
//!   plot                                 values
//! Space run/pause  . step  , cycle  m method ...                       ? help
//! ```

use ratatui::prelude::*;

use super::app::App;
use super::canvas::Canvas;
use super::explorer::Explorer;
use super::frame::{Activity, Frame};
use super::layout;
use super::overlays::Overlay;
use super::panels::{Content, Panel, Shown};
use super::{footer, present, timeline};
use crate::math::number::{exact, rounded, shown};
use crate::plot::theme::Role;
use crate::reading::verdict;

/// Draws the whole screen.
pub fn draw(app: &App, area: Rect, buffer: &mut Buffer) {
    let (explorer, overlay) = (&app.explorer, app.overlays.last());
    let mut canvas = Canvas::new(&explorer.theme, area, buffer);
    let is_study = |overlay: &&Overlay| matches!(overlay, Overlay::Sweep(_));
    if let Some(study) = app.overlays.iter().find(is_study) {
        study.draw(explorer, canvas.at(area));
        if let Some(keys @ Overlay::MapKeys) = overlay {
            keys.draw(explorer, canvas);
        }
        return;
    }
    let Some([top, line, middle, bottom]) = layout::bands(area) else {
        let (columns, rows) = layout::SMALLEST;
        let text = format!("mdr-tui needs {columns} by {rows} characters; q quits");
        return canvas.write(text);
    };
    status(&explorer.frame, canvas.at(top));
    timeline::draw(&explorer.frame, canvas.at(line));
    let [shown, list] = explorer.stage.with_list(middle);
    panels(explorer, canvas.at(shown));
    footer::draw(app, canvas.at(bottom));
    // An explanation is placed next to its panel; lists need every row.
    let under = match overlay {
        Some(Overlay::Explain) => shown,
        Some(Overlay::Form(_)) if !list.is_empty() => list,
        _ => line.union(middle),
    };
    if let Some(overlay) = overlay {
        overlay.draw(explorer, canvas.at(under));
    }
}

fn panels(explorer: &Explorer, mut canvas: Canvas) {
    let (frame, stage, area) = (&*explorer.frame, &explorer.stage, canvas.area);
    for (panel, place) in stage.places(area) {
        draw_panel(panel, explorer, canvas.at(place));
    }
    let [above, caption] = stage.with_tour(area);
    if stage.presents {
        present::draw(frame, canvas.at(present::areas(above)[2]));
    }
    if let Some(tour) = &stage.tour {
        tour.draw(canvas.at(caption));
    }
}

/// Draws a panel: its picture or its chart.
fn draw_panel(panel: Panel, explorer: &Explorer, mut canvas: Canvas) {
    let (frame, charts) = (&*explorer.frame, &explorer.charts);
    let role = if explorer.stage.focus == panel {
        Role::Focus
    } else {
        Role::Title
    };
    match panel.content() {
        Content::Picture(picture) => {
            let shown = Shown {
                frame: explorer.calm.shown(panel, &explorer.stage, frame),
                calm: explorer.calm.frame_or(frame),
                stress: explorer.stress,
                drawn: &explorer.drawn,
                bounds: charts.bounds(panel),
                role,
            };
            (picture.make.draw)(&shown, canvas);
        }
        Content::Chart(recipe) => match &*charts.get(panel, recipe, frame) {
            Ok(chart) => canvas.plot(chart, role, explorer.cursor_in(panel)),
            Err(why) => canvas
                .titled(recipe.title, role)
                .write_text(why, Role::Quiet),
        },
    }
}

/// Draws the state of the run on the left, in slots of fixed width, and the title on the right. A narrow screen drops
/// the title first, then the least important parts.
fn status(frame: &Frame, mut canvas: Canvas) {
    let (theme, area, bar) = (canvas.theme, canvas.area, canvas.style(Role::Bar));
    let mut parts = status_parts(frame, area.width >= WITH_WORDS);
    let text = |parts: &[StatusPart]| {
        let slots = parts.iter();
        let slots = slots.map(|(_, text, width)| format!("{:1$}", theme.printable(text), width));
        slots.collect::<Vec<_>>().join(&theme.printable(" │ "))
    };
    let mut left = text(&parts);
    while parts.len() > 1 && Line::raw(&*left).width() + 1 > usize::from(area.width) {
        let least = (0..parts.len()).min_by_key(|&at| parts[at].0);
        parts.remove(least.unwrap_or(0));
        left = text(&parts);
    }
    let room = usize::from(area.width).saturating_sub(Line::raw(left.as_str()).width() + 4);
    let title = shortened(theme.printable(frame.live.scenario.title()), room);
    canvas.show(Line::styled(title, bar).right_aligned());
    canvas.show(Line::styled(format!(" {left}"), bar));
}

/// Minimum columns for the method's description in the status line.
const WITH_WORDS: u16 = 80;

/// A part of the status line: its weight (the least important parts are dropped first), its text, and the minimum width
/// of its slot, in cells.
type StatusPart = (u8, String, usize);

/// Shortens a title to `room` cells, including a blank after it.
fn shortened(mut text: String, room: usize) -> String {
    let width = |text: &str| Line::raw(text).width();
    match width(&text) {
        0 => text,
        all if all <= room => text + " ",
        _ if room < 12 => String::new(),
        _ => {
            while width(&text) + 2 > room {
                text.pop();
            }
            text + ".. "
        }
    }
}

/// Returns the parts of the status line, the state first.
fn status_parts(frame: &Frame, has_room: bool) -> Vec<StatusPart> {
    let moment = &frame.live.observation.moment;
    let planned = frame.live.scenario.run().cycles;
    // Hundredths are of no interest among ten thousand cycles.
    let most = planned.unwrap_or(0.0).max(moment.cycle);
    let decimals = if most < 1e4 { 2 } else { 0 };
    let mut cycle = format!("cycle {:.decimals$}", moment.cycle);
    let mut widest = "cycle 0000.00".len();
    if let Some(planned) = planned {
        cycle.push_str(&format!("/{planned}"));
        widest = format!("cycle {planned:.decimals$}/{planned}").len();
    }
    let mut pace = match frame.speed.unwrap_or(frame.pace) {
        pace if pace.is_finite() => format!("{} cycles/s", exact(rounded(pace, 2))),
        _ => "unlimited".into(),
    };
    let mut pace_width = "0.5 cycles/s".len();
    if frame.shows_ends && frame.activity == Activity::Running {
        pace.push_str(", phase 0°");
        pace_width = pace.len().max("1000 cycles/s, phase 90°".len());
    }
    let activity = match &frame.activity {
        Activity::Paused if frame.present.is_some() => "◂ past",
        Activity::Running => "▶ running",
        Activity::Paused => "‖ paused",
        Activity::Done => "■ done",
        Activity::Stopped(_) => "! stopped",
    };
    let law = frame.live.observation.law.unwrap_or("no wear");
    let word = if has_room { "method: " } else { "" };
    let method = format!("{word}{}", frame.live.observation.method);
    let present = frame.present.map(|present| format!("present {present:.2}"));
    let verdict = verdict(&frame.checks);
    let errors = frame.errors.as_ref().ok();
    let error = errors.map(|(_, errors)| errors.of_wear());
    let error = error.filter(|error| error.is_finite()).map(wear_error);
    let mut warnings = frame.warnings.iter();
    let is_outside = warnings.any(|warning| warning.starts_with("outside"));
    let parts = [
        Some((6, activity.into(), 9)),
        Some((5, cycle, widest)),
        present.map(|present| (4, present, 0)),
        Some((4, pace, pace_width)),
        Some((3, method, 7 + word.len())),
        Some((1, law.into(), 7)),
        verdict.map(|word| (if word == "checks ok" { 2 } else { 3 }, word, 12)),
        error.map(|error| (2, error, 12)),
        is_outside.then(|| (2, "! outside the theory".into(), 0)),
    ];
    parts.into_iter().flatten().collect()
}

/// Formats the estimated error of the wear, to one digit.
fn wear_error(error: f64) -> String {
    match 100.0 * error {
        size if size < 0.01 => "wear ±<0.01 %".into(),
        size => format!("wear ±{} %", shown(size, 1)),
    }
}
