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
//!
//! Two panels side by side on a narrow screen, three on a wide one.

use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Paragraph, Widget};

use super::app::{App, Overlay};
use super::command::BINDINGS;
use super::panels::Panel;
use super::theme::Role;
use super::worker::{Activity, Frame, Pace};
use crate::scenario::preset;

/// From this width on, three panels stand side by side.
const WIDE: u16 = 110;

/// Below this size there is a message instead of panels.
const SMALLEST: (u16, u16) = (40, 10);

/// Draws everything.
pub fn draw(app: &App, area: Rect, buffer: &mut Buffer) {
    if area.width < SMALLEST.0 || area.height < SMALLEST.1 {
        let text = format!(
            "mdr-tui needs {} by {} characters; q quits",
            SMALLEST.0, SMALLEST.1
        );
        Paragraph::new(text)
            .wrap(ratatui::widgets::Wrap { trim: true })
            .render(area, buffer);
        return;
    }
    let [top, middle, bottom] = Layout::vertical([
        Constraint::Length(1),
        Constraint::Min(0),
        Constraint::Length(1),
    ])
    .areas(area);
    match &app.frame {
        Some(frame) => {
            status(frame, app, top, buffer);
            panels(frame, app, middle, buffer);
        }
        None => Line::raw("starting ...").render(middle, buffer),
    }
    footer(app, bottom, buffer);
    match app.overlay {
        Overlay::None => {}
        Overlay::Help(line) => help(app, line, middle, buffer),
        Overlay::Presets(at) => presets(app, at, middle, buffer),
    }
}

fn panels(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    if app.zoomed {
        app.focus.draw(frame, app, area, buffer);
        return;
    }
    let columns: usize = if area.width >= WIDE { 3 } else { 2 };
    let rows = Panel::ALL.len() / columns;
    let bands = Layout::vertical(vec![Constraint::Fill(1); rows]).split(area);
    for (band, row) in bands.iter().zip(Panel::ALL.chunks(columns)) {
        let cells = Layout::horizontal(vec![Constraint::Fill(1); columns])
            .spacing(1)
            .split(*band);
        for (cell, panel) in cells.iter().zip(row) {
            panel.draw(frame, app, *cell, buffer);
        }
    }
}

/// Title on the left, what runs and how on the right; the title gives way.
fn status(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    let bar = app.theme.style(Role::Bar);
    buffer.set_style(area, bar);
    let separator = if app.theme.ascii() { " | " } else { " │ " };
    let right = status_parts(frame, app.theme.ascii()).join(separator);
    let width = usize::from(area.width);
    let room = width.saturating_sub(right.chars().count() + 3);
    let mut title: String = frame
        .title
        .chars()
        .filter(|c| !c.is_control())
        .take(room)
        .collect();
    if title.chars().count() < frame.title.chars().count() && room > 12 {
        title.truncate(
            title
                .char_indices()
                .nth(room - 2)
                .map_or(title.len(), |(at, _)| at),
        );
        title.push_str("..");
    }
    Line::styled(format!(" {title}"), bar).render(area, buffer);
    Line::styled(format!("{right} "), bar)
        .right_aligned()
        .render(area, buffer);
}

fn status_parts(frame: &Frame, ascii: bool) -> Vec<String> {
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
    let activity = match (&frame.activity, ascii) {
        (Activity::Running, false) => "▶ running",
        (Activity::Running, true) => "> running",
        (Activity::Paused, false) => "⏸ paused",
        (Activity::Paused, true) => "= paused",
        (Activity::Done, false) => "■ done",
        (Activity::Done, true) => "# done",
        (Activity::Stopped(_), _) => "! stopped",
    };
    vec![
        format!("{}", frame.observation.method),
        law.into(),
        cycle,
        pace,
        activity.into(),
    ]
}

/// Two or three digits of a speed.
fn short(value: f64) -> String {
    match value.abs() {
        size if size >= 10_000.0 => format!("{:.0}k", value / 1000.0),
        size if size >= 10.0 => format!("{value:.0}"),
        _ => format!("{value:.1}"),
    }
}

/// A word for the user if there is one, else as many keys as fit.
fn footer(app: &App, area: Rect, buffer: &mut Buffer) {
    let stopped = app.frame.as_ref().and_then(|frame| match &frame.activity {
        Activity::Stopped(reason) => Some(reason.as_str()),
        _ => None,
    });
    if let Some(text) = app.notice.as_deref().or(stopped) {
        let text: String = text
            .chars()
            .map(|c| if c.is_control() { ' ' } else { c })
            .collect();
        Line::styled(format!(" {text}"), app.theme.style(Role::Alarm)).render(area, buffer);
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

/// A cleared box in the middle of `area`, with a title; returns its inside.
fn popup(app: &App, title: &str, size: (u16, u16), area: Rect, buffer: &mut Buffer) -> Rect {
    let (width, height) = (size.0.min(area.width), size.1.min(area.height));
    let place = Rect::new(
        area.x + (area.width - width) / 2,
        area.y + (area.height - height) / 2,
        width,
        height,
    );
    Clear.render(place, buffer);
    let mut block = Block::bordered()
        .border_style(app.theme.style(Role::Quiet))
        .title(format!(" {title} "));
    if app.theme.ascii() {
        block = block.border_set(ASCII_BORDER);
    }
    let inside = block.inner(place);
    block.render(place, buffer);
    inside
}

const ASCII_BORDER: ratatui::symbols::border::Set = ratatui::symbols::border::Set {
    top_left: "+",
    top_right: "+",
    bottom_left: "+",
    bottom_right: "+",
    vertical_left: "|",
    vertical_right: "|",
    horizontal_top: "-",
    horizontal_bottom: "-",
};

fn help(app: &App, first: u16, area: Rect, buffer: &mut Buffer) {
    let lines: Vec<Line> = BINDINGS
        .iter()
        .map(|binding| {
            let keys: Vec<String> = binding.keys.iter().map(ToString::to_string).collect();
            Line::from(vec![
                Span::styled(
                    format!(" {:>11}  ", keys.join(" ")),
                    app.theme.style(Role::Title),
                ),
                Span::raw(binding.help),
            ])
        })
        .collect();
    let height = lines.len() as u16 + 2;
    let title = if height > area.height {
        "keys (up and down scroll, Esc closes)"
    } else {
        "keys (Esc closes)"
    };
    let inside = popup(app, title, (76, height), area, buffer);
    let first = first.min((lines.len() as u16).saturating_sub(inside.height));
    Paragraph::new(lines)
        .scroll((first, 0))
        .render(inside, buffer);
}

fn presets(app: &App, at: usize, area: Rect, buffer: &mut Buffer) {
    let width = preset::ALL
        .iter()
        .map(|preset| preset.name.len())
        .max()
        .unwrap_or(0);
    let lines: Vec<Line> = preset::ALL
        .iter()
        .enumerate()
        .map(|(i, preset)| {
            let text = format!(" {:width$}  {} ", preset.name, preset.title());
            if i == at {
                Line::styled(text, app.theme.style(Role::Focus))
            } else {
                Line::raw(text)
            }
        })
        .collect();
    let height = lines.len() as u16 + 2;
    let inside = popup(
        app,
        "presets (Enter starts, Esc closes)",
        (76, height),
        area,
        buffer,
    );
    let first = (at as u16 + 1).saturating_sub(inside.height);
    Paragraph::new(lines)
        .scroll((first, 0))
        .render(inside, buffer);
}
