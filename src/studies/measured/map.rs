//! A map of heights or depths over x and y, averaged around the axis of its scar, or along the scar of a line contact.

use super::{FEWEST, Measured, span};
use crate::reading::Column;
use crate::scenario::Refusal;
use crate::scenario::columns::Columns;
use crate::traces::Axes;

/// Rings or strips of one width that a map is averaged in.
const RINGS: usize = 100;

/// The axis is found to this part of the map's width.
const FINEST: f64 = 1e-4;

/// A map shows a line contact if averaging along it leaves less than this share of the mean square around any axis.
const MUCH_LESS: f64 = 0.3;

/// The sums over a ring or a strip: points, places, values and their squares.
type RingSums = [f64; 4];

/// The sums over rings or strips up to a place `end` (m).
fn sums(places: impl Iterator<Item = f64>, values: &[f64], end: f64) -> [RingSums; RINGS] {
    let mut rings = [[0.0; 4]; RINGS];
    for (r, z) in places.zip(values) {
        if let Some([count, radius, sum, squares]) =
            rings.get_mut((r / end * RINGS as f64) as usize)
        {
            (*count, *radius, *sum, *squares) =
                (*count + 1.0, *radius + r, *sum + z, *squares + z * z);
        }
    }
    rings
}

/// The mean square of what the values of each ring differ by.
fn scatter(rings: &[RingSums]) -> f64 {
    let sums = rings.iter().filter(|ring| ring[0] > 1.0);
    let (scatter, count) = sums.fold((0.0, 0.0), |(scatter, count), [n, _, sum, squares]| {
        (scatter + squares - sum * sum / n, count + n)
    });
    scatter / count
}

/// Reads a map; its axis is where the values of each ring differ least.
pub(super) fn read(columns: &Columns, axes: Axes) -> Result<Measured, Refusal> {
    let ([x, y, z], rows) = columns.whole_rows([Column::X, Column::Y, axes.y])?;
    let width = span(&x).min(span(&y));
    if x.len() < RINGS || width == 0.0 {
        return Err(columns.refuse(format!("a map needs {RINGS} rows or more, over an area")));
    }
    let ends =
        |values: &[f64]| crate::math::scan::range(values.iter().copied()).unwrap_or_default();
    let middle = |values: &[f64]| 0.5 * (ends(values)[0] + ends(values)[1]);
    let mut axis = [middle(&x), middle(&y)];
    let around = |axis: [f64; 2]| {
        let points = x.iter().zip(&y);
        let radii = points.map(|(x, y)| (x - axis[0]).hypot(y - axis[1]));
        sums(radii, &z, 0.5 * width)
    };
    // A search along both directions, with ever smaller steps.
    let (mut step, mut best) = (0.1 * width, scatter(&around(axis)));
    while step > FINEST * width {
        let places = [[step, 0.0], [-step, 0.0], [0.0, step], [0.0, -step]]
            .map(|[dx, dy]| [axis[0] + dx, axis[1] + dy]);
        let scored = places.map(|place| (place, scatter(&around(place))));
        match scored.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((place, found)) if found < best => (axis, best) = (place, found),
            _ => step *= 0.5,
        }
    }
    let mut rings = around(axis);
    let (mut first, mut how) = (
        0.0,
        format!("around x = {:.2e} m, y = {:.2e} m", axis[0], axis[1]),
    );
    // Along a line: a trace across it, whose centre is found as of any trace.
    let is_averaged = [(&x, "y"), (&y, "x")].into_iter().all(|(across, along)| {
        let [start, end] = ends(across);
        // The outermost points belong to the last strip.
        let width = (end - start) * (1.0 + 1e-9);
        let strips = sums(across.iter().map(|at| at - start), &z, width);
        let scatter = scatter(&strips);
        let is_line = scatter < MUCH_LESS * best;
        if is_line {
            (rings, first, best, how) = (strips, start, scatter, format!("along {along}"));
        }
        !is_line
    });
    let kept: Vec<RingSums> = rings.into_iter().filter(|ring| ring[0] > 3.0).collect();
    if kept.len() < FEWEST {
        return Err(columns.refuse("a map needs 4 rows or more in each of 3 rings around its axis"));
    }
    let error =
        |[n, _, sum, squares]: &RingSums| ((squares - sum * sum / n) / (n - 1.0) / n).sqrt();
    let typical = best.sqrt() / (x.len() as f64 / RINGS as f64).sqrt();
    Ok(Measured {
        name: columns.path.clone(),
        axes,
        at: kept
            .iter()
            .map(|[n, place, ..]| first + place / n)
            .collect(),
        values: kept.iter().map(|[n, _, sum, _]| sum / n).collect(),
        // A ring of few points may scatter little by chance.
        errors: Some(
            kept.iter()
                .map(|ring| error(ring).max(0.3 * typical).max(f64::MIN_POSITIVE))
                .collect(),
        ),
        cycle: None,
        rising: Vec::new(),
        cycles: Vec::new(),
        is_averaged,
        notes: vec![format!("a map of {} points, averaged {how}", rows.len())],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_is_averaged_around_its_axis() {
        let mut text = "x_um,y_um,depth_nm\n".to_owned();
        for i in 0..61 {
            for j in 0..61 {
                let (x, y) = (f64::from(i), f64::from(j));
                let r = (x - 33.0).hypot(y - 28.5);
                let noise = f64::from((i * 61 + j) * 7919 % 101) / 50.0 - 1.0;
                text += &format!("{x},{y},{}\n", 50.0 * (1.0 - r / 20.0).max(0.0) + noise);
            }
        }
        let map =
            Measured::scar(&Columns::parse(&text, "map.csv").expect("columns")).expect("a map");
        assert!(
            map.notes[0].contains("x = 3.3") && map.notes[0].contains("y = 2.8"),
            "{:?}",
            map.notes
        );
        for (r, depth) in map.at.iter().zip(&map.values) {
            assert!(
                (depth - 50e-9 * (1.0 - r / 20e-6).max(0.0)).abs() < 2e-9,
                "{r} {depth}"
            );
        }
    }

    #[test]
    fn a_map_of_a_line_contact_is_averaged_along_it() {
        for (names, along) in [("x_um,y_um", "along y"), ("y_um,x_um", "along x")] {
            let mut text = format!("{names},depth_nm\n");
            for i in 0..61 {
                for j in 0..41 {
                    let noise = f64::from((i * 61 + j) * 7919 % 101) / 50.0 - 1.0;
                    let depth = 50.0 * (1.0 - f64::from(i - 33).abs() / 20.0).max(0.0);
                    text += &format!("{i},{j},{}\n", depth + noise);
                }
            }
            let columns = Columns::parse(&text, "map.csv").expect("columns");
            let map = Measured::scar(&columns).expect("a map");
            assert!(map.notes[0].ends_with(along), "{:?}", map.notes);
            for (x, depth) in map.at.iter().zip(&map.values) {
                let exact = 50e-9 * (1.0 - (x - 33e-6).abs() / 20e-6).max(0.0);
                assert!((depth - exact).abs() < 1e-9, "{x} {depth}");
            }
        }
    }
}
