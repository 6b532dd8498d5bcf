//! Observed order of convergence: of every method and transform, on data that are smooth and on
//! data with a kink between two nodes, and of the time stepping.

use crate::common::{Scene, apart, archard, holds, largest, run, swing};
use mdr_tui::math::abel::AbelMethod::{self, A, APlusB, B, Benad};
use mdr_tui::math::abel::AbelPlan;
use mdr_tui::math::grid::RadialGrid;
use mdr_tui::oracle::pair_catalogue::Transform::{self, LineToSurface, LoadToStress, ProfileToMdr};
use mdr_tui::oracle::pair_catalogue::{PAIRS, Pair};
use std::f64::consts::FRAC_PI_4;

const LADDER: [usize; 5] = [50, 100, 200, 400, 800];

fn pair(name: &str, transform: Transform) -> &'static Pair {
    PAIRS
        .iter()
        .find(|pair| pair.name == name && pair.transform == transform)
        .expect("a pair of the catalogue")
}

/// A domain in which the kink at 1 lies a third of a cell from the nearest node on every rung.
fn domain(pair: &Pair) -> f64 {
    match pair.transform {
        _ if pair.kinks.is_empty() => pair.domain,
        LoadToStress => 1.5,
        ProfileToMdr | LineToSurface => 150.0 / 76.0,
    }
}

/// The largest error over the nodes from `start` times the domain.
fn error(method: AbelMethod, pair: &Pair, cells: usize, start: f64) -> f64 {
    let grid = RadialGrid::uniform(cells, domain(pair)).expect("a grid");
    let plan = AbelPlan::new(method, &grid);
    let source: Vec<f64> = grid.nodes().iter().map(|&x| pair.source(x)).collect();
    let mut image = vec![f64::NAN; grid.len()];
    match pair.transform {
        ProfileToMdr => plan.profile(&source, &mut image),
        LineToSurface => plan.displacement(&source, &mut image),
        LoadToStress => plan.stress(&source, &mut image),
    }
    let errors = grid.nodes().iter().zip(image);
    let errors = errors.filter(|(x, _)| **x >= start * grid.radius());
    largest(errors.map(|(&x, value)| value - pair.image(x)))
}

/// Every order observed between N and 4N, which meet the kink at the same place in its cell, lies
/// within `band` of `expected`.
fn orders(
    name: &str,
    transform: Transform,
    start: f64,
    expected: [(AbelMethod, f64); 4],
    band: f64,
) {
    let pair = pair(name, transform);
    for (method, order) in expected {
        let errors = LADDER.map(|cells| error(method, pair, cells, start));
        for (rung, e) in errors.windows(3).enumerate() {
            let observed = 0.5 * (e[0] / e[2]).log2();
            let what = format!(
                "{name} by {method} from N={}, order {observed:.3}",
                LADDER[rung]
            );
            holds(&what, (observed - order).abs(), band);
        }
    }
}

const THREE_HALVES: [(AbelMethod, f64); 4] = [(A, 1.5), (APlusB, 1.5), (B, 1.5), (Benad, 1.5)];
const ONE_HALF: [(AbelMethod, f64); 4] = [(A, 0.5), (APlusB, 0.5), (B, 0.5), (Benad, 0.5)];

/// The last cell's root costs half an order: second-order data give 3/2.
#[test]
fn the_profile_of_smooth_data_is_of_order_three_halves() {
    orders("paraboloid", ProfileToMdr, 0.0, THREE_HALVES, 0.02);
    orders("quartic", ProfileToMdr, 0.0, THREE_HALVES, 0.07);
}

#[test]
fn the_profile_past_a_kink_is_of_order_one_half() {
    orders("ramp", ProfileToMdr, 0.0, ONE_HALF, 0.03);
    orders("square-ramp", ProfileToMdr, 0.0, ONE_HALF, 0.05);
}

#[test]
fn the_displacement_of_smooth_data_is_of_second_order_by_a_alone() {
    let expected = [(A, 2.0), (APlusB, 1.5), (B, 1.5), (Benad, 1.5)];
    orders("square", LineToSurface, 0.0, expected, 0.06);
    orders("bell", LineToSurface, 0.0, expected, 0.13);
}

#[test]
fn the_displacement_past_a_kink_is_of_order_three_halves_and_one_by_benad() {
    let expected = [(A, 1.5), (APlusB, 1.5), (B, 1.5), (Benad, 1.0)];
    orders("slip", LineToSurface, 0.0, expected, 0.06);
    orders("late-line", LineToSurface, 0.0, expected, 0.1);
}

/// The first cell is taken alone at r = 0, hence order 1 there.
#[test]
fn the_stress_of_smooth_data_is_of_order_three_halves_and_one_at_the_axis() {
    orders("gauss", LoadToStress, 0.1, THREE_HALVES, 0.25);
    let pair = pair("gauss", LoadToStress);
    for method in AbelMethod::PUBLISHED {
        let observed = (error(method, pair, 400, 0.0) / error(method, pair, 800, 0.0)).log2();
        let case = format!("axis by {method}, order {observed:.3}");
        holds(&case, (observed - 1.0).abs(), 0.08);
    }
}

#[test]
fn the_stress_inside_a_kink_is_of_order_one_half() {
    orders("hertz", LoadToStress, 0.0, ONE_HALF, 0.05);
}

/// The Fig. 3 motion at K = 1 over 20 cycles: the change when the step is halved halves too.
#[test]
fn explicit_stepping_is_of_first_order() {
    let worn = |steps| {
        let scene = Scene {
            normal: swing(1.0, 0.1, 1.0, 0.0),
            tangential: Some(swing(0.0, 0.1, 1.0, FRAC_PI_4)),
            law: archard(1.0),
            steps,
            ..Scene::default()
        };
        run(scene, 20.0).state().wear.clone()
    };
    let ladder = [100, 200, 400, 800, 1600].map(worn);
    let changes = ladder.windows(2).map(|pair| apart(&pair[0], &pair[1]));
    let changes: Vec<f64> = changes.collect();
    // Measured 1.0e-4, 5.1e-5, 2.5e-5, 1.3e-5 of d: 0.0195/steps to 0.0202/steps.
    for (change, steps) in changes.iter().zip([100.0, 200.0, 400.0, 800.0]) {
        let case = format!("change from {steps} steps");
        holds(&case, *change, 0.025 / steps);
    }
    for pair in changes.windows(2) {
        let observed = (pair[0] / pair[1]).log2();
        let case = format!("order {observed:.3}");
        holds(&case, (observed - 1.0).abs(), 0.12);
    }
}
