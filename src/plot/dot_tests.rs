//! Tests how exactly the widget draws: each value on its dot.

use super::Curve;
use super::tests::{axes, draw, shown};
use super::theme::Role;

/// Returns the dots of a Braille rendering as (column, row), counted from the bottom left of the plot area, and the
/// area's size in dots.
fn braille_dots(lines: &[String]) -> (Vec<(usize, usize)>, (usize, usize)) {
    let lines: Vec<Vec<char>> = lines.iter().map(|line| line.chars().collect()).collect();
    let line_row = lines.iter().position(|line| line.contains(&'└'));
    let bottom = line_row.expect("an axis line");
    let left = lines[bottom]
        .iter()
        .position(|&c| c == '└')
        .expect("a corner")
        + 1;
    let (width, height) = (2 * (lines[0].len() - left), 4 * (bottom - 1));
    let mut dots = Vec::new();
    for (y, line) in lines.iter().enumerate().take(bottom).skip(1) {
        for (x, &c) in line.iter().enumerate().skip(left) {
            let bits = (c as u32).checked_sub(0x2800).filter(|&bits| bits < 256);
            let order = [
                (0, 0),
                (0, 1),
                (0, 2),
                (1, 0),
                (1, 1),
                (1, 2),
                (0, 3),
                (1, 3),
            ];
            for (bit, (dx, dy)) in order.into_iter().enumerate() {
                if bits.is_some_and(|bits| bits & (1 << bit) != 0) {
                    dots.push((2 * (x - left) + dx, height - 1 - (4 * (y - 1) + dy)));
                }
            }
        }
    }
    (dots, (width, height))
}

#[test]
fn a_value_lands_on_the_nearest_dot() {
    // The values lie on one side of zero, since a zero line would add dots; and the lower end is on no tick, since the
    // upper end would otherwise move to space the ticks evenly.
    let (x_bounds, y_bounds) = ([2.0e-6, 5.0e-6], [0.1234, 3.3]);
    for (width, height) in [(20, 9), (40, 12), (80, 20), (133, 45)] {
        for i in 0..200 {
            let share = [f64::from(i) / 199.0, f64::from(i * 37 % 200) / 199.0];
            let x = x_bounds[0] + share[0] * (x_bounds[1] - x_bounds[0]);
            let y = y_bounds[0] + share[1] * (y_bounds[1] - y_bounds[0]);
            let (xs, ys) = ([x], [y]);
            let plot = axes(x_bounds, y_bounds).curve(Curve::new("", xs, ys, Role::Profile));
            let (dots, size) = braille_dots(&draw(&shown(plot), width, height));
            let exact = [
                share[0] * (size.0 - 1) as f64,
                share[1] * (size.1 - 1) as f64,
            ];
            assert_eq!(dots.len(), 1);
            let near = |&(column, row): &(usize, usize)| {
                (column as f64 - exact[0]).abs() <= 0.5 + 1e-9
                    && (row as f64 - exact[1]).abs() <= 0.5 + 1e-9
            };
            assert!(dots.iter().all(near), "{x} {y}: {dots:?} {exact:?}");
        }
    }
}

#[test]
fn peaks_survive() {
    let xs: Vec<f64> = (0..10_000).map(f64::from).collect();
    for spike in [1, 17, 2500, 5003, 9998] {
        let mut ys = vec![1.0; xs.len()];
        ys[spike] = 10.0;
        let plot = axes([0.0, 9999.0], [0.1234, 10.0]).curve(Curve::new(
            "",
            xs.clone(),
            ys.clone(),
            Role::Profile,
        ));
        let (dots, size) = braille_dots(&draw(&shown(plot), 43, 12));
        let column = (spike as f64 / 9999.0 * (size.0 - 1) as f64).round() as usize;
        assert!(dots.contains(&(column, size.1 - 1)), "{spike}");
        let low = ((1.0 - 0.1234) / (10.0 - 0.1234) * (size.1 - 1) as f64).round() as usize;
        assert!((0..size.0).all(|column| dots.contains(&(column, low))));
        assert!(dots.iter().all(|&(c, row)| row == low || c == column));
    }
}

#[test]
fn gaps_stay_open() {
    let xs: Vec<f64> = (0..=100).map(f64::from).collect();
    let ys = xs.iter().map(|&x| {
        if (40.0..=60.0).contains(&x) {
            f64::NAN
        } else {
            5.0
        }
    });
    let ys: Vec<f64> = ys.collect();
    let plot = axes([0.0, 100.0], [0.0, 10.0]).curve(Curve::new(
        "",
        xs.clone(),
        ys.clone(),
        Role::Profile,
    ));
    let (dots, size) = braille_dots(&draw(&shown(plot), 60, 12));
    for column in 0..size.0 {
        let x = column as f64 / (size.0 - 1) as f64 * 100.0;
        let drawn = dots.iter().any(|dot| dot.0 == column);
        assert_eq!(drawn, !(39.5..=60.5).contains(&x), "{x}");
    }
}
