//! Straight segments on a grid of dots.
//!
//! A segment is clipped to the grid before it is walked (Liang and Barsky 1984), so that
//! the walk is never longer than the grid is wide or high.

/// Visits the dots nearest to the line from `a` to `b` on a grid of `size` dots, dot `i`
/// being centred on position `i`: one a column where the line is shallow, one per row where it
/// is steep. `visit` gets column, row, and whether the line is steep.
pub(super) fn walk(
    a: (f64, f64),
    b: (f64, f64),
    size: (f64, f64),
    mut visit: impl FnMut(usize, usize, bool),
) {
    let (width, height) = size;
    let Some((a, b)) = clip(a, b, width - 0.5, height - 0.5) else {
        return;
    };
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    if dx.abs() >= dy.abs() {
        let (a, b) = if dx >= 0.0 { (a, b) } else { (b, a) };
        let slope = if dx == 0.0 { 0.0 } else { dy / dx };
        for column in nearest(a.0, width)..=nearest(b.0, width) {
            let y = a.1 + ((column as f64).clamp(a.0, b.0) - a.0) * slope;
            visit(column, nearest(y, height), false);
        }
    } else {
        let (a, b) = if dy >= 0.0 { (a, b) } else { (b, a) };
        let slope = dx / dy;
        for row in nearest(a.1, height)..=nearest(b.1, height) {
            let x = a.0 + ((row as f64).clamp(a.1, b.1) - a.1) * slope;
            visit(nearest(x, width), row, true);
        }
    }
}

/// The dot nearest to a position inside the raster.
fn nearest(position: f64, size: f64) -> usize {
    position.round().clamp(0.0, (size - 1.0).max(0.0)) as usize
}

/// The part of the line from `a` to `b` inside -0.5..`right`, -0.5..`top` (Liang and Barsky).
fn clip(a: (f64, f64), b: (f64, f64), right: f64, top: f64) -> Option<((f64, f64), (f64, f64))> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut start, mut end) = (0.0f64, 1.0f64);
    let edges = [
        (-dx, a.0 + 0.5),
        (dx, right - a.0),
        (-dy, a.1 + 0.5),
        (dy, top - a.1),
    ];
    for (outward, distance) in edges {
        if outward < 0.0 {
            start = start.max(distance / outward);
        } else if outward > 0.0 {
            end = end.min(distance / outward);
        } else if distance < 0.0 {
            return None;
        }
    }
    let at = |t: f64| (a.0 + t * dx, a.1 + t * dy);
    (start <= end).then(|| (at(start), at(end)))
}
