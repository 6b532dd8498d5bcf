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
    let ends = clip(a.into(), b.into(), [-0.5; 2], [width - 0.5, height - 0.5]);
    let Some([a, b]): Option<[(f64, f64); 2]> = ends.map(|ends| ends.map(Into::into)) else {
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

/// The part of the line from `from` to `to` within `low` and `high` (Liang and Barsky). Ends that lie inside
/// stay as they are to the last bit.
pub fn clip(from: [f64; 2], to: [f64; 2], low: [f64; 2], high: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for k in 0..2 {
        let step = to[k] - from[k];
        let bounds = [low[k] - from[k], high[k] - from[k]];
        if step == 0.0 {
            if bounds[0] > 0.0 || bounds[1] < 0.0 {
                return None;
            }
            continue;
        }
        let (a, b) = (bounds[0] / step, bounds[1] / step);
        first = first.max(a.min(b));
        last = last.min(a.max(b));
    }
    let at = |share: f64| [0, 1].map(|k| from[k] + share * (to[k] - from[k]));
    let start = if first == 0.0 { from } else { at(first) };
    let end = if last == 1.0 { to } else { at(last) };
    (first <= last).then_some([start, end])
}
