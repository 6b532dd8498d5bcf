//! The fretting log: the loops F_x over u_x of earlier cycles behind that of the last one, each a step
//! further to the right and up. The axes are those of the last loop.

use super::*;
use crate::math::scan::range;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    title: "fretting log",
    is_calm: true,
    text: "The fretting loops of earlier cycles behind the last one. The axes belong to the last loop; older \
           loops are shifted to the right and up.",
    symbols: &[U_X, F_X],
    ..Recipe::new(make)
};

/// The most loops that are drawn.
const MOST: usize = 12;

/// How far the oldest loop lies behind the newest, in widths and heights of the largest.
const SHIFT: [f64; 2] = [0.6, 1.2];

fn make(run: &Run, _: &View) -> Result<Chart, &'static str> {
    let live = run.live.as_ref().filter(|live| live.moves());
    let log = &live.ok_or(NO_MOTION)?.log;
    let every = log.len().div_ceil(MOST).max(1);
    let mut loops: Vec<&Loop> = log.iter().rev().step_by(every).map(AsRef::as_ref).collect();
    loops.reverse();
    let (first, last) = loops.first().zip(loops.last()).ok_or(NO_CYCLE)?;
    let extent = |of: fn(&Loop) -> &Vec<f64>| {
        let values = loops.iter().flat_map(|one| of(one)).copied();
        range(values).map_or(0.0, |[low, high]| high - low)
    };
    let size = [extent(|one| &one.shifts), extent(|one| &one.forces)];
    let newest = loops.len() - 1;
    let mut chart = Chart::new("", Axis::new("u_x", "m"), Axis::new("F_x", "N"));
    chart.note = format!("cycles {:.0} (back) to {:.0}", first.end, last.end);
    // The newest is drawn last, over the others.
    Ok(chart.curves(loops.iter().enumerate().map(|(k, one)| {
        let step = (newest - k) as f64 / newest.max(1) as f64;
        let moved = |values: &[f64], axis: usize| -> Vec<f64> {
            let by = step * SHIFT[axis] * size[axis];
            values.iter().map(|value| value + by).collect()
        };
        let role = if k == newest {
            Role::Shear
        } else {
            Role::Unworn
        };
        Curve::new("", moved(&one.shifts, 0), moved(&one.forces, 1), role)
    })))
}
