//! The layout of the screen, used for drawing and for the mouse.
//!
//! Four readable panels on a small screen, nine or twelve on a large one; the others are on further
//! pages.

use ratatui::layout::Constraint::{Length, Min};
use ratatui::layout::{Layout, Rect};

/// Three panels fit side by side from this width on.
const WIDE: u16 = 110;

/// Four from this width on.
const VERY_WIDE: u16 = 160;

/// There are three rows from this height on.
const TALL: u16 = 33;

/// Below this width one panel fills the row.
const NARROW: u16 = 56;

/// There is a timeline from this height on.
const WITH_TIMELINE: u16 = 24;

/// Minimum size; a smaller screen shows a message instead of panels.
pub const SMALLEST: (u16, u16) = (40, 10);

/// The status line, the timeline, which has no row on a low screen, the panels' area and the footer; `None` if the
/// screen is too small.
pub fn bands(screen: Rect) -> Option<[Rect; 4]> {
    if screen.width < SMALLEST.0 || screen.height < SMALLEST.1 {
        return None;
    }
    let timeline = u16::from(screen.height >= WITH_TIMELINE);
    let rows = [Length(1), Length(timeline), Min(0), Length(1)];
    Some(Layout::vertical(rows).areas(screen))
}

/// The area of the panels on a screen; empty if that is too small.
pub fn panels(screen: Rect) -> Rect {
    bands(screen).map_or(Rect::ZERO, |[_, _, panels, _]| panels)
}

/// Columns and rows of panels in an area.
pub fn grid(area: Rect) -> (usize, usize) {
    let down = if area.height >= TALL { 3 } else { 2 };
    match area.width {
        VERY_WIDE.. => (4, down),
        WIDE.. => (3, down),
        NARROW.. => (2, down),
        _ => (1, down),
    }
}
