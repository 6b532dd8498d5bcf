//! The layout of the screen, used for drawing and for the mouse.
//!
//! Shows four readable panels on a small screen, nine or twelve on a large one; the others are on further pages.

use ratatui::layout::Constraint::{Length, Min};
use ratatui::layout::{Layout, Rect};

/// Minimum width for three panels side by side.
const WIDE: u16 = 110;

/// Minimum width for four panels.
const VERY_WIDE: u16 = 160;

/// Minimum height for three rows.
const TALL: u16 = 33;

/// Below this width a single panel fills the row.
const NARROW: u16 = 56;

/// Minimum height for a timeline.
const WITH_TIMELINE: u16 = 24;

/// Minimum size; a smaller screen shows a message instead of panels.
pub const SMALLEST: (u16, u16) = (40, 10);

/// Returns the areas of the status line, the timeline (empty on a low screen), the panels and the footer; `None` if the
/// screen is too small.
pub fn bands(screen: Rect) -> Option<[Rect; 4]> {
    if screen.width < SMALLEST.0 || screen.height < SMALLEST.1 {
        return None;
    }
    let timeline = u16::from(screen.height >= WITH_TIMELINE);
    let rows = [Length(1), Length(timeline), Min(0), Length(1)];
    Some(Layout::vertical(rows).areas(screen))
}

/// Returns the area of the panels; empty if the screen is too small.
pub fn panels(screen: Rect) -> Rect {
    bands(screen).map_or(Rect::ZERO, |[_, _, panels, _]| panels)
}

/// Returns the number of columns and rows of panels in an area.
pub fn grid(area: Rect) -> (usize, usize) {
    let down = if area.height >= TALL { 3 } else { 2 };
    match area.width {
        VERY_WIDE.. => (4, down),
        WIDE.. => (3, down),
        NARROW.. => (2, down),
        _ => (1, down),
    }
}
