//! Conformance: every transform pair of the catalogue by every method on uniform and graded grids, with its observed
//! order of convergence.
//!
//! `conformance.csv` has the orders; `UPDATE_ORDERS=1 cargo test conformance::` rewrites it, to be reviewed before it
//! is kept. A kink is a third of a cell away from the nearest node of a uniform grid and on a node of a graded one,
//! as where a simulation grades its own.

use std::fmt::Write as _;
use std::path::Path;

use crate::closed_forms::pair_catalogue::Transform::{LineToSurface, LoadToStress, ProfileToMdr};
use crate::closed_forms::pair_catalogue::{PAIRS, Pair};
use crate::common::{PUBLISHED, largest};
use mdr_tui::math::abel::{AbelMethod, AbelPlan};
use mdr_tui::math::grid::RadialGrid;

/// Errors below this part of the largest value are rounding: such a pair is reproduced exactly.
const EXACT: f64 = 1e-9;

/// How far an order may be below the one in the table.
const BAND: f64 = 0.1;

/// Both meet a kink at the same place in its cell.
const CELLS: [usize; 2] = [100, 400];

#[derive(Debug, Clone, Copy, PartialEq)]
enum Order {
    Exact,
    Observed(f64),
}

/// The grid of a kind, for data that may have a kink at 1.
fn grid(kind: &str, pair: &Pair, cells: usize) -> RadialGrid {
    let has_kink = !pair.kinks.is_empty();
    let grid = match kind {
        "uniform" if has_kink => RadialGrid::uniform(cells, 150.0 / 76.0),
        "uniform" => RadialGrid::uniform(cells, pair.domain),
        _ if has_kink => RadialGrid::graded(cells, 1.0, 1.9),
        _ => RadialGrid::graded(cells, 0.4 * pair.domain, pair.domain),
    };
    grid.expect("a grid")
}

/// How near to an infinite value, in parts of its place, nothing is compared.
const AROUND_SINGULAR: f64 = 0.05;

/// The image of the pair's source at the nodes.
fn image(method: AbelMethod, pair: &Pair, grid: &RadialGrid) -> Vec<f64> {
    let plan = AbelPlan::new(method, grid);
    let source: Vec<f64> = grid.nodes().iter().map(|&x| pair.source(x)).collect();
    let mut image = vec![f64::NAN; grid.len()];
    match pair.transform {
        ProfileToMdr => plan.profile(&source, &mut image),
        LineToSurface => plan.displacement(&source, &mut image),
        LoadToStress => plan.stress(&source, &mut image),
    }
    image
}

/// The rms error over the domain without its innermost tenth, relative to the largest value of the image.
fn error(method: AbelMethod, pair: &Pair, grid: &RadialGrid) -> f64 {
    let image = image(method, pair, grid);
    let (mut sum, mut largest) = (0.0, 0.0_f64);
    let nodes = grid.nodes().windows(2).zip(&image[1..]);
    for (cell, value) in nodes.filter(|(cell, _)| cell[1] >= 0.1 * grid.radius()) {
        if pair
            .singular
            .is_some_and(|at| (cell[1] / at - 1.0).abs() < AROUND_SINGULAR)
        {
            continue;
        }
        let exact = pair.image(cell[1]);
        sum += (value - exact).powi(2) * (cell[1] - cell[0]);
        largest = largest.max(exact.abs());
    }
    (sum / grid.radius()).sqrt() / largest
}

fn order(method: AbelMethod, pair: &Pair, kind: &str) -> Order {
    let [coarse, fine] = CELLS.map(|cells| error(method, pair, &grid(kind, pair, cells)));
    match fine < EXACT {
        true => Order::Exact,
        false => Order::Observed(0.5 * (coarse / fine).log2()),
    }
}

#[test]
fn every_method_has_its_order_on_every_pair() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/conformance.csv");
    let mut observed = Vec::new();
    for pair in PAIRS {
        for method in AbelMethod::ALL {
            for kind in ["uniform", "graded"] {
                let name = format!("{:?},{},{method},{kind}", pair.transform, pair.name);
                observed.push((name, order(method, pair, kind)));
            }
        }
    }
    if std::env::var_os("UPDATE_ORDERS").is_some() {
        let mut text = String::from("transform,pair,method,grid,order\n");
        for (name, order) in &observed {
            let _ = match order {
                Order::Exact => writeln!(text, "{name},exact"),
                Order::Observed(order) => writeln!(text, "{name},{order:.2}"),
            };
        }
        std::fs::write(&path, text).expect("the table");
    }
    let table = std::fs::read_to_string(&path).expect("the table");
    let rows: Vec<&str> = table.lines().skip(1).collect();
    assert_eq!(rows.len(), observed.len());
    for (row, (name, order)) in rows.into_iter().zip(observed) {
        let (known, expected) = row.rsplit_once(',').expect("a row");
        assert_eq!(known, name);
        match (expected, order) {
            ("exact", order) => assert_eq!(order, Order::Exact, "{name}"),
            (expected, Order::Observed(order)) => {
                let expected: f64 = expected.parse().expect("an order");
                assert!(order > expected - BAND, "{row}: now {order:.2}");
            }
            (_, Order::Exact) => {}
        }
    }
}

/// The first cell is taken alone at r = 0, hence order 1 there.
#[test]
fn the_stress_of_smooth_data_is_of_first_order_at_the_axis() {
    let is_it = |pair: &&Pair| pair.name == "gauss" && pair.transform == LoadToStress;
    let pair = PAIRS.iter().find(is_it).expect("a pair");
    for method in PUBLISHED {
        let errors = [400, 800].map(|cells| {
            let grid = grid("uniform", pair, cells);
            let nodes = grid.nodes().iter().zip(image(method, pair, &grid));
            largest(nodes.map(|(&x, value)| value - pair.image(x)))
        });
        let order = (errors[0] / errors[1]).log2();
        assert!((order - 1.0).abs() < 0.08, "{method}: {order}");
    }
}
