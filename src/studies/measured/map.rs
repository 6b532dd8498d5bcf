//! A map of heights or depths over x and y, averaged around the axis of its scar.

use super::{FEWEST, Measured, span};
use crate::reading::Column;
use crate::scenario::Refusal;
use crate::scenario::columns::Columns;
use crate::traces::Axes;

/// Rings of one width that a map is averaged in.
const RINGS: usize = 100;

/// The axis is found to this part of the map's width.
const FINEST: f64 = 1e-4;

/// Reads a map; its axis is where the values of each ring differ least.
pub(super) fn read(columns: &Columns, axes: Axes) -> Result<Measured, Refusal> {
    let ([x, y, z], rows) = columns.whole_rows([Column::X, Column::Y, axes.y])?;
    let width = span(&x).min(span(&y));
    if x.len() < RINGS || width == 0.0 {
        return Err(columns.refuse(format!("a map needs {RINGS} rows or more, over an area")));
    }
    let middle = |values: &[f64]| {
        let [least, most] = crate::math::scan::range(values.iter().copied()).unwrap_or_default();
        0.5 * (least + most)
    };
    let mut axis = [middle(&x), middle(&y)];
    let reach = 0.5 * width;
    let rings = |axis: [f64; 2]| {
        let mut rings = [[0.0; 4]; RINGS];
        for ((x, y), z) in x.iter().zip(&y).zip(&z) {
            let r = (x - axis[0]).hypot(y - axis[1]);
            if let Some([count, radius, sum, squares]) =
                rings.get_mut((r / reach * RINGS as f64) as usize)
            {
                (*count, *radius, *sum, *squares) =
                    (*count + 1.0, *radius + r, *sum + z, *squares + z * z);
            }
        }
        rings
    };
    let scatter = |axis: [f64; 2]| {
        let sums = rings(axis).into_iter().filter(|ring| ring[0] > 1.0);
        let (scatter, count) = sums.fold((0.0, 0.0), |(scatter, count), [n, _, sum, squares]| {
            (scatter + squares - sum * sum / n, count + n)
        });
        scatter / count
    };
    // A search along both directions, with ever smaller steps.
    let (mut step, mut best) = (0.1 * width, scatter(axis));
    while step > FINEST * width {
        let places = [[step, 0.0], [-step, 0.0], [0.0, step], [0.0, -step]]
            .map(|[dx, dy]| [axis[0] + dx, axis[1] + dy]);
        let scored = places.map(|place| (place, scatter(place)));
        match scored.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((place, found)) if found < best => (axis, best) = (place, found),
            _ => step *= 0.5,
        }
    }
    let kept: Vec<[f64; 4]> = rings(axis)
        .into_iter()
        .filter(|ring| ring[0] > 3.0)
        .collect();
    if kept.len() < FEWEST {
        return Err(columns.refuse("a map needs 4 rows or more in each of 3 rings around its axis"));
    }
    let error =
        |[n, _, sum, squares]: &[f64; 4]| ((squares - sum * sum / n) / (n - 1.0) / n).sqrt();
    let typical = best.sqrt() / (x.len() as f64 / RINGS as f64).sqrt();
    Ok(Measured {
        name: columns.path.clone(),
        axes,
        at: kept.iter().map(|[n, radius, ..]| radius / n).collect(),
        values: kept.iter().map(|[n, _, sum, _]| sum / n).collect(),
        // A ring of few points may scatter little by chance.
        errors: Some(
            kept.iter()
                .map(|ring| error(ring).max(0.3 * typical).max(f64::MIN_POSITIVE))
                .collect(),
        ),
        cycle: None,
        rising: Vec::new(),
        is_averaged: true,
        notes: vec![format!(
            "a map of {} points, averaged around x = {:.2e} m, y = {:.2e} m",
            rows.len(),
            axis[0],
            axis[1]
        )],
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
}
