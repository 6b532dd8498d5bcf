//! Indenters from tables: they act as the shapes they were taken from, and bad tables are refused.

use std::fmt::Write;

use crate::common::{holds, largest, load, ran};
use crate::test_dir::TestDir;

/// A table with `points` intervals from `from` to 2.5e-4 m.
fn table(points: u32, from: f64, f: impl Fn(f64) -> f64) -> String {
    let mut text = "r_m,f_m\n".to_owned();
    for i in 0..=points {
        let r = from + (2.5e-4 - from) * f64::from(i) / f64::from(points);
        let _ = writeln!(text, "{r},{}", f(r));
    }
    text
}

/// What an instrument could not measure is left out, and the run says how much.
#[test]
fn gaps_of_a_table_are_left_out_and_counted() {
    let dir = TestDir::new();
    let text = table(30, 0.0, |r| r * r / 0.02) + "3e-4,nan\n3.1e-4,\n";
    dir.write("shape.csv", text.as_bytes());
    let run = "run li2019-fig3 --set indenter.shape=table --set indenter.file=shape.csv --set numerics.points=20 \
               --cycles 0.1 --out new";
    dir.line(run).ends(
        0,
        "shape.csv: 2 of 33 rows have missing values and are left out",
    );
}

/// F_z, F_x, a and V after two cycles.
fn results(sets: &[&str]) -> [f64; 4] {
    let session = ran(load("li2019-fig3", sets), 2.0);
    let moment = session.simulation().moment();
    [
        moment.normal_force,
        moment.tangential_force,
        moment.contact_radius,
        moment.wear_volume,
    ]
}

/// A paraboloid and a cone are reproduced to rounding, a quartic with the order of the interpolant.
#[test]
fn a_table_of_a_closed_shape_gives_the_results_of_the_shape() {
    let dir = TestDir::new();
    let file = format!("indenter.file={}", dir.path("shape.csv").display());
    let error = |text: String, exact: [f64; 4]| {
        dir.write("shape.csv", text.as_bytes());
        let found = results(&["indenter.shape=table", &file]);
        largest(found.iter().zip(exact).map(|(a, b)| a / b - 1.0))
    };
    let sphere = results(&[]);
    holds(
        "paraboloid",
        error(table(30, 0.0, |r| r * r / 0.02), sphere),
        1e-6,
    );
    let cone = results(&["indenter.shape=cone", "indenter.angle=0.01"]);
    holds(
        "cone",
        error(table(30, 0.0, |r| r * f64::tan(0.01)), cone),
        1e-6,
    );
    let quartic = [
        "indenter.shape=power",
        "indenter.coefficient=1e10",
        "indenter.exponent=4.0",
    ];
    let quartic = results(&quartic);
    let errors = [20, 40, 80].map(|n| error(table(n, 0.0, |r| 1e10 * r.powi(4)), quartic));
    eprintln!("quartic: {errors:?}");
    assert!(errors[2] < 1e-4, "{errors:?}");
    let order = (errors[0] / errors[2]).log2() / 2.0;
    assert!(order > 2.0, "order {order} of {errors:?}");
}
