//! The timeline below the title: cycles done and planned, changes and snapshots as ticks, and the shown moment. `[` and
//! `]` move along it, and so does a click.
//!
//! ```text
//!  0 ━━━━━━━━━▼━━━━━━━●━━━◆━━━━━━────────────────── 200   at cycle 40: friction.coefficient = 0.2
//! ```

use ratatui::prelude::*;

use super::canvas::Canvas;
use super::frame::Frame;
use crate::charts::round_end;
use crate::plot::theme::Role;

/// Minimum width of the line, if the text needs more than half of the row.
const LEAST: u16 = 30;

/// Returns the present cycle, and the cycle at the end of the line.
fn ends(frame: &Frame) -> [f64; 2] {
    let now = frame.present.unwrap_or(frame.live.observation.moment.cycle);
    let end = match frame.live.scenario.run().cycles {
        Some(planned) if now <= planned => planned,
        _ => round_end(now),
    };
    [now, end]
}

/// Rounds a cycle to two decimals.
fn short(cycle: f64) -> f64 {
    (100.0 * cycle).round() / 100.0
}

/// Describes the last change before the shown moment in as many words as fit. The cycle can be seen on the line, and
/// the end of a key says more than its beginning.
fn edit(frame: &Frame, room: usize) -> Option<String> {
    let shown = frame.live.observation.moment.cycle + 1e-9;
    let mut latest_first = frame.changes.iter().rev();
    let change = latest_first.find(|change| change.at_cycle <= shown)?;
    // A whole number is shown as one.
    let set = change.to_string();
    let set = set.strip_suffix(".0").unwrap_or(&set);
    let whole = format!("at cycle {}: {set}", short(change.at_cycle));
    let key = set.split('=').next().unwrap_or_default();
    let ends = key.match_indices('.').map(|(at, _)| &set[at + 1..]);
    let mut shorter = [whole.as_str(), set].into_iter().chain(ends);
    let fits = shorter.find(|text| Line::raw(*text).width() <= room);
    Some(fits.unwrap_or(set).to_owned())
}

/// Returns the text after the line, and the area of the line.
fn parts(frame: &Frame, area: Rect) -> (String, Rect) {
    let mut words = format!(" {}", short(ends(frame)[1]));
    let room = usize::from((area.width / 2).max(area.width.saturating_sub(LEAST)));
    let left = room.saturating_sub(words.len() + 3);
    words.extend(edit(frame, left).map(|edit| format!("   {edit}")));
    let words: String = words.chars().take(room).collect();
    let taken = Line::raw(words.as_str()).width() as u16 + 1;
    let width = area.width.saturating_sub(3 + taken);
    (words, Rect::new(area.x + 3, area.y, width, area.height))
}

/// Returns the cycle at a place of the screen, if it is on the timeline in `area`.
pub fn cycle_at(frame: &Frame, area: Rect, at: Position) -> Option<f64> {
    let (_, line) = parts(frame, area);
    let share = (f64::from(at.x) + 0.5 - f64::from(line.x)) / f64::from(line.width);
    line.contains(at).then(|| share * ends(frame)[1])
}

/// Draws the timeline.
pub fn draw(frame: &Frame, mut canvas: Canvas) {
    let (theme, ascii) = (canvas.theme, canvas.theme.ascii());
    let ([now, end], (words, line)) = (ends(frame), parts(frame, canvas.area));
    let place = |cycle: f64| {
        let share = (cycle / end).clamp(0.0, 1.0) * f64::from(line.width);
        (share as u16).min(line.width.saturating_sub(1))
    };
    let sign = |signs: [&'static str; 2]| signs[usize::from(ascii)];
    let mut signs: Vec<Span<'_>> = (0..line.width)
        .map(|column| {
            if column <= place(now) && now > 0.0 {
                Span::styled(sign(["━", "="]), theme.style(Role::Quiet))
            } else {
                Span::styled(sign(["─", "-"]), theme.style(Role::Faint))
            }
        })
        .collect();
    let changes = frame.changes.iter();
    let changes = changes.map(|change| (change.at_cycle, ["▼", "v"], Role::Notice));
    let snapshots = frame.snapshots.iter();
    let snapshots = snapshots.map(|cycle| (*cycle, ["◆", "s"], Role::Contact));
    let shown = (frame.live.observation.moment.cycle, ["●", "O"], Role::Title);
    for (cycle, signs_of, role) in changes.chain(snapshots).chain([shown]) {
        if let Some(span) = signs.get_mut(usize::from(place(cycle))) {
            *span = Span::styled(sign(signs_of), theme.style(role));
        }
    }
    signs.insert(0, Span::raw(" 0 "));
    signs.push(Span::raw(theme.printable(&words)));
    canvas.show(Line::from(signs));
}
