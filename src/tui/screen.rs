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

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget};

use super::app::App;
use super::command::{BINDINGS, Binding, Command};
use super::frame::{Activity, Frame};
use super::layout;
use super::overlays::Overlay;
use super::pace::Pace;
use super::panels::compare;
use super::theme::Role;
use super::{present, readout, timeline};
use crate::simulation::verdict;

/// The hint before the first key.
const HINT: &str =
    " Space pauses, + runs faster, Enter explains, V: the contact, n: a tour.   ? help   q quit";

/// Draws everything.
pub fn draw(app: &App, area: Rect, buffer: &mut Buffer) {
    let Some([top, middle, bottom]) = layout::bands(area) else {
        let (columns, rows) = layout::SMALLEST;
        let text = format!("mdr-tui needs {columns} by {rows} characters; q quits");
        Paragraph::new(text)
            .wrap(ratatui::widgets::Wrap { trim: true })
            .render(area, buffer);
        return;
    };
    let (line, middle) = layout::timeline(middle);
    match &app.frame {
        Some(frame) => {
            status(frame, app, top, buffer);
            if let Some(line) = line {
                timeline::draw(frame, app, line, buffer);
            }
            panels(frame, app, middle, buffer);
        }
        None => Line::raw("starting ...").render(middle, buffer),
    }
    footer(app, bottom, buffer);
    app.overlay.draw(app, middle, buffer);
}

fn panels(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    if let Some(comparison) = &frame.comparison {
        compare::draw(frame, comparison, app, area, buffer);
        return;
    }
    for (panel, place) in layout::places(app, area) {
        panel.draw(frame, app, place, buffer);
    }
    if app.presents {
        let (above, _) = layout::with_tour(app, area);
        present::draw(frame, app, present::areas(above)[2], buffer);
    }
    if let (Some(tour), (_, Some(place))) = (&app.tour, layout::with_tour(app, area)) {
        tour.draw(app, place, buffer);
    }
}

/// The state of the run on the left, in slots of fixed width, and the title on the right. A narrow
/// screen drops the title first, then the least important parts.
fn status(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    let bar = app.theme.style(Role::Bar);
    buffer.set_style(area, bar);
    let ascii = app.theme.ascii();
    let separator = if ascii { " | " } else { " │ " };
    let mut parts = status_parts(frame, ascii);
    while parts.len() > 1
        && Line::raw(parts_text(&parts, separator)).width() + 2 > usize::from(area.width)
    {
        let least = parts
            .iter()
            .enumerate()
            .min_by_key(|(_, part)| part.weight)
            .map_or(0, |(at, _)| at);
        parts.remove(least);
    }
    let left = parts_text(&parts, separator);
    let room = usize::from(area.width).saturating_sub(Line::raw(left.as_str()).width() + 4);
    let title = shortened(app.theme.printable(&frame.title), room);
    Line::styled(format!(" {left}"), bar).render(area, buffer);
    Line::styled(format!("{title} "), bar)
        .right_aligned()
        .render(
            Rect {
                x: area.right() - (room as u16 + 1).min(area.width),
                width: (room as u16 + 1).min(area.width),
                ..area
            },
            buffer,
        );
}

/// A part of the status line; the least important parts are dropped first.
struct Part {
    weight: u8,
    text: String,
    /// The least width of its slot, cells.
    width: usize,
}

fn parts_text(parts: &[Part], separator: &str) -> String {
    parts
        .iter()
        .map(|part| format!("{:1$}", part.text, part.width))
        .collect::<Vec<_>>()
        .join(separator)
}

/// As much of a title as fits in `room` cells.
fn shortened(mut text: String, room: usize) -> String {
    if Line::raw(text.as_str()).width() <= room {
        return text;
    }
    if room < 12 {
        return String::new();
    }
    while Line::raw(text.as_str()).width() + 2 > room {
        text.pop();
    }
    text + ".."
}

/// What the status line says, the state first.
fn status_parts(frame: &Frame, ascii: bool) -> Vec<Part> {
    let moment = &frame.observation.moment;
    let mut cycle = format!("cycle {:.2}", moment.cycle);
    let mut widest = "cycle 0000.00".len();
    if let Some(planned) = frame.planned_cycles {
        cycle.push_str(&format!("/{planned}"));
        widest = format!("cycle {planned:.2}/{planned}").len();
    }
    let mut pace = match (frame.speed, frame.pace) {
        (Some(speed), _) => format!("{} cycles/s", short(speed)),
        (None, Pace::Cycles(pace)) => format!("{} cycles/s", short(pace)),
        (None, Pace::Unlimited) => "unlimited".into(),
    };
    let mut pace_width = "0.5 cycles/s".len();
    if let Some(phase) = frame.phase.filter(|_| frame.activity == Activity::Running) {
        let degrees = if ascii { " deg" } else { "°" };
        pace.push_str(&format!(", phase {phase:.0}{degrees}"));
        pace_width = pace.len().max("1000 cycles/s, phase 90°".len());
    }
    let activity = match (&frame.activity, ascii) {
        (Activity::Paused, false) if frame.present.is_some() => "◂ past",
        (Activity::Paused, true) if frame.present.is_some() => "< past",
        (Activity::Running, false) => "▶ running",
        (Activity::Running, true) => "> running",
        (Activity::Paused, false) => "⏸ paused",
        (Activity::Paused, true) => "= paused",
        (Activity::Done, false) => "■ done",
        (Activity::Done, true) => "# done",
        (Activity::Stopped(_), _) => "! stopped",
    };
    let part = |weight, text: String, width| Part {
        weight,
        text,
        width,
    };
    let law = frame.observation.law.unwrap_or("no wear");
    let mut parts = vec![
        part(6, activity.into(), 9),
        part(5, cycle, widest),
        part(4, pace, pace_width),
        part(3, frame.observation.method.to_string(), 7),
        part(1, law.into(), 7),
    ];
    parts.extend(verdict(&frame.checks).map(|verdict| {
        let fails = verdict != "checks ok";
        part(if fails { 3 } else { 2 }, verdict, 12)
    }));
    parts.extend(
        frame
            .error
            .map(|error| part(2, wear_error(error, ascii), 12)),
    );
    let outside = |warning: &String| warning.starts_with("outside");
    if frame.warnings.iter().any(outside) {
        parts.push(part(2, "! outside the theory".into(), 0));
    }
    if let Some(present) = frame.present {
        parts.insert(2, part(4, format!("present {present:.2}"), 0));
    }
    parts
}

/// The estimated error of what has worn, to a digit.
fn wear_error(error: f64, ascii: bool) -> String {
    let sign = if ascii { "+-" } else { "±" };
    let percent = 100.0 * error;
    match percent {
        size if size < 0.01 => format!("wear {sign}<0.01 %"),
        size if size < 0.1 => format!("wear {sign}{size:.2} %"),
        size if size < 1.0 => format!("wear {sign}{size:.1} %"),
        size => format!("wear {sign}{size:.0} %"),
    }
}

/// Two or three digits of a speed.
fn short(value: f64) -> String {
    match value.abs() {
        size if size >= 10_000.0 => format!("{:.0}k", value / 1000.0),
        size if size >= 10.0 => format!("{value:.0}"),
        _ => format!("{value:.1}"),
    }
}

/// The notice if there is one, else the values at the cursor, else as many keys as fit.
fn footer(app: &App, area: Rect, buffer: &mut Buffer) {
    let stopped = app.frame.as_ref().and_then(|frame| match &frame.activity {
        Activity::Stopped(reason) => Some(reason.as_str()),
        _ => None,
    });
    // The form shows its own notices.
    let notice = app
        .notice
        .as_deref()
        .filter(|_| !matches!(app.overlay, Overlay::Form(_)));
    if let Some(text) = notice.or(stopped) {
        let text = app.theme.printable(text);
        let role = if notice.is_some() {
            Role::Notice
        } else {
            Role::Alarm
        };
        Line::styled(format!(" {text}"), app.theme.style(role)).render(area, buffer);
        return;
    }
    if app.is_new
        && app.tour.is_none()
        && !app.shows_contact()
        && HINT.len() <= usize::from(area.width)
    {
        Line::styled(HINT, app.theme.style(Role::Notice)).render(area, buffer);
        return;
    }
    let frame = app.frame.as_ref();
    if let Some((frame, r)) = frame.and_then(|frame| Some((frame, app.cursor_radius(frame)?))) {
        let text = readout::line(
            frame,
            app.focus,
            r,
            usize::from(area.width),
            app.theme.ascii(),
        );
        Line::raw(text).render(area, buffer);
        return;
    }
    let mut spans = Vec::new();
    let mut left = usize::from(area.width);
    let commands = footer_commands(app);
    // Help and quit are always shown; the others as far as they fit.
    let reserved: usize = commands
        .iter()
        .rev()
        .take(2)
        .map(|(binding, name)| footer_width(name, binding.keys))
        .sum();
    for (i, (binding, name)) in commands.iter().enumerate() {
        let width = footer_width(name, binding.keys);
        if i + 2 < commands.len() && width + reserved > left {
            continue;
        }
        left = left.saturating_sub(width);
        let key = binding
            .keys
            .first()
            .map(ToString::to_string)
            .unwrap_or_default();
        spans.push(Span::styled(
            format!(" {key}"),
            app.theme.style(Role::Title),
        ));
        spans.push(Span::styled(
            format!(" {name}"),
            app.theme.style(Role::Quiet),
        ));
    }
    Line::from(spans).render(area, buffer);
}

/// The commands that the footer shows in the present mode, with the name they have in it.
fn footer_commands(app: &App) -> Vec<(&'static Binding, &'static str)> {
    let frame = app.frame.as_deref();
    let past: &[(Command, &str)] = &[
        (Command::TimeBack, "back"),
        (Command::TimeForth, "forward"),
        (Command::RunPause, "run on from here"),
        (Command::Edit, "change from here"),
    ];
    let compare: &[(Command, &str)] = &[
        (Command::NextMethod, "other method"),
        (Command::CompareFromStart, "from the start"),
        (Command::Compare, "end comparison"),
        (Command::RunPause, "run/pause"),
        (Command::Step, "step"),
        (Command::Cycle, "cycle"),
    ];
    let contact: &[(Command, &str)] = &[
        (Command::Contact, "all panels"),
        (Command::RunPause, "run/pause"),
        (Command::Faster, "faster"),
        (Command::Step, "step"),
        (Command::Cycle, "cycle"),
        (Command::Accept, "explain"),
        (Command::Stress, "other stress"),
        (Command::Edit, "edit"),
        (Command::Presets, "presets"),
        (Command::Palette, "commands"),
    ];
    let tour: &[(Command, &str)] = &[
        (Command::Tour, "next caption"),
        (Command::Back, "close the tour"),
        (Command::RunPause, "run/pause"),
        (Command::Faster, "faster"),
        (Command::Accept, "explain"),
    ];
    let mode = match frame {
        Some(frame) if frame.comparison.is_some() => Some(compare),
        Some(frame) if frame.present.is_some() => Some(past),
        _ if app.tour.is_some() => Some(tour),
        _ if app.shows_contact() => Some(contact),
        _ => None,
    };
    let of = |command: Command| BINDINGS.iter().find(|binding| binding.command == command);
    let always = [Command::Help, Command::Quit];
    let Some(mode) = mode else {
        return BINDINGS
            .iter()
            .filter(|binding| binding.in_footer)
            .map(|binding| (binding, binding.name))
            .collect();
    };
    let named = mode
        .iter()
        .filter_map(|&(command, name)| Some((of(command)?, name)));
    let always = always
        .into_iter()
        .filter_map(of)
        .map(|binding| (binding, binding.name));
    named.chain(always).collect()
}

fn footer_width(name: &str, keys: &[super::keys::Key]) -> usize {
    keys.first()
        .map_or(0, |key| key.to_string().chars().count())
        + name.len()
        + 2
}
