//! The whole screen: a status line, the panels, a line of keys, and what lies over them.
//!
//! ```text
//! Fig. 3 ...    a | archard | cycle 50.72 of 199.24 | 10 cycles/s | running
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
use super::command::BINDINGS;
use super::frame::{Activity, Frame};
use super::layout;
use super::overlays::Overlay;
use super::pace::Pace;
use super::panels::compare;
use super::readout;
use super::theme::Role;
use super::trust;

/// What somebody sees who has not pressed a key yet.
const HINT: &str = " New here? Space pauses, v shows more, : lists all commands.   ? help   q quit";

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
    match &app.frame {
        Some(frame) => {
            status(frame, app, top, buffer);
            panels(frame, app, middle, buffer);
        }
        None => Line::raw("starting ...").render(middle, buffer),
    }
    footer(app, bottom, buffer);
    app.overlay.draw(app, middle, buffer);
}

fn panels(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    if let Some(rival) = &frame.rival {
        compare::draw(frame, rival, app, area, buffer);
        return;
    }
    for (panel, place) in layout::places(app, area) {
        panel.draw(frame, app, place, buffer);
    }
}

/// Title on the left, what runs and how on the right. On a narrow screen the title gives way, then
/// the parts that are missed least.
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
            .min_by_key(|(_, (weight, _))| *weight)
            .map_or(0, |(at, _)| at);
        parts.remove(least);
    }
    let right = parts_text(&parts, separator);
    let room = usize::from(area.width).saturating_sub(Line::raw(right.as_str()).width() + 3);
    let title = shortened(app.theme.printable(&frame.title), room);
    Line::styled(format!(" {title}"), bar).render(area, buffer);
    Line::styled(format!("{right} "), bar)
        .right_aligned()
        .render(area, buffer);
}

fn parts_text(parts: &[(u8, String)], separator: &str) -> String {
    parts
        .iter()
        .map(|(_, text)| text.as_str())
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

/// What the status line says, each part with its weight.
fn status_parts(frame: &Frame, ascii: bool) -> Vec<(u8, String)> {
    let moment = &frame.observation.moment;
    let law = frame.observation.law.unwrap_or("no wear");
    let mut cycle = format!("cycle {:.2}", moment.cycle);
    if let Some(planned) = frame.planned_cycles {
        cycle.push_str(&format!("/{planned}"));
    }
    let pace = match (frame.speed, frame.pace) {
        (Some(speed), _) => format!("{} cycles/s", short(speed)),
        (None, Pace::Cycles(pace)) => format!("{} cycles/s", short(pace)),
        (None, Pace::Unlimited) => "unlimited".into(),
    };
    if let Some(present) = frame.present {
        cycle.push_str(&format!(" (present {present:.2})"));
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
    let mut parts = vec![
        (4, frame.observation.method.to_string()),
        (3, law.into()),
        (5, cycle),
        (1, pace),
    ];
    parts.extend(trust::figure(frame).map(|figure| (2, format!("trust {figure}"))));
    parts.push((6, activity.into()));
    parts
}

/// Two or three digits of a speed.
fn short(value: f64) -> String {
    match value.abs() {
        size if size >= 10_000.0 => format!("{:.0}k", value / 1000.0),
        size if size >= 10.0 => format!("{value:.0}"),
        _ => format!("{value:.1}"),
    }
}

/// A word for the user if there is one, the values at the cursor if there is one, else as many keys
/// as fit.
fn footer(app: &App, area: Rect, buffer: &mut Buffer) {
    let stopped = app.frame.as_ref().and_then(|frame| match &frame.activity {
        Activity::Stopped(reason) => Some(reason.as_str()),
        _ => None,
    });
    // The form has a line of its own for what is answered to it.
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
    if app.is_new && HINT.len() <= usize::from(area.width) {
        Line::styled(HINT, app.theme.style(Role::Notice)).render(area, buffer);
        return;
    }
    let frame = app.frame.as_ref();
    if let Some((frame, r)) = frame.and_then(|frame| Some((frame, app.cursor_radius(frame)?))) {
        let text = readout::line(frame, r, usize::from(area.width), app.theme.ascii());
        Line::raw(text).render(area, buffer);
        return;
    }
    let mut spans = Vec::new();
    let mut left = usize::from(area.width);
    // Help and quit are always there; the others as far as they fit.
    let in_footer = || BINDINGS.iter().filter(|binding| binding.in_footer);
    let reserved: usize = in_footer()
        .rev()
        .take(2)
        .map(|binding| footer_width(binding.name, binding.keys))
        .sum();
    let count = in_footer().count();
    for (i, binding) in in_footer().enumerate() {
        let width = footer_width(binding.name, binding.keys);
        if i + 2 < count && width + reserved > left {
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
            format!(" {}", binding.name),
            app.theme.style(Role::Quiet),
        ));
    }
    Line::from(spans).render(area, buffer);
}

fn footer_width(name: &str, keys: &[super::keys::Key]) -> usize {
    keys.first()
        .map_or(0, |key| key.to_string().chars().count())
        + name.len()
        + 2
}
