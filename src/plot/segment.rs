//! Straight segments on a grid of dots.
//!
//! A segment is clipped to the grid before it is walked (Liang and Barsky 1984), so that the walk is never longer than
//! the grid is wide or high.

/// Visits the dots nearest to the line from `a` to `b` on a grid of `size` dots, the centre of dot `i` being at
/// position `i`: one per column if the line is shallow, one per row if it is steep. `visit` gets the column, the row,
/// and whether the line is steep.
pub(super) fn walk(
    a: [f64; 2],
    b: [f64; 2],
    size: [f64; 2],
    mut visit: impl FnMut(usize, usize, bool),
) {
    let Some([a, b]) = clip(a, b, [-0.5; 2], size.map(|length| length - 0.5)) else {
        return;
    };
    let nearest = |k: usize, position: f64| {
        let last = (size[k] - 1.0).max(0.0);
        position.round().clamp(0.0, last) as usize
    };
    let is_steep = (b[1] - a[1]).abs() > (b[0] - a[0]).abs();
    let [k, other] = if is_steep { [1, 0] } else { [0, 1] };
    let [a, b] = if a[k] <= b[k] { [a, b] } else { [b, a] };
    let slope = match b[k] - a[k] {
        0.0 => 0.0,
        along => (b[other] - a[other]) / along,
    };
    for along in nearest(k, a[k])..=nearest(k, b[k]) {
        let from_start = (along as f64).clamp(a[k], b[k]) - a[k];
        let across = nearest(other, a[other] + from_start * slope);
        if is_steep {
            visit(across, along, true)
        } else {
            visit(along, across, false)
        }
    }
}

/// Returns the part of the line from `from` to `to` within `low` and `high` (Liang and Barsky). Ends that lie inside
/// stay exactly the same.
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
