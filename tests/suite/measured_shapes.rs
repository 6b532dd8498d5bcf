//! Indenters from tables: they act as the shapes they were taken from, and bad tables are refused.

use std::fmt::Write;

use crate::common::{holds, largest, load, ran};
use crate::test_dir::{TestDir, has};

/// What follows `run` for an indenter from the table `shape.csv`.
const TABLE: &str = "li2019-fig3 --set indenter.shape=table --set indenter.file=shape.csv";

/// A table with `points` intervals from `from` to 2.5e-4 m.
fn table(points: u32, from: f64, f: impl Fn(f64) -> f64) -> String {
    let mut text = "r_m,f_m\n".to_owned();
    for i in 0..=points {
        let r = from + (2.5e-4 - from) * f64::from(i) / f64::from(points);
        let _ = writeln!(text, "{r},{}", f(r));
    }
    text
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

/// A run's scenario.toml holds the table, so that it needs no other file, and gives the same bits.
#[test]
fn a_run_of_a_table_can_be_run_again_without_the_table() {
    let dir = TestDir::new();
    let tilted = |r: f64| r * r / 0.02 + 2e-3 * r + 1e-7;
    dir.write("shape.csv", table(500, -2.5e-4, tilted).as_bytes());
    let said = dir.line(&format!(
        "run {TABLE} --set indenter.smoothing=1e-5 --cycles 1 --out first"
    ));
    assert_eq!(said.code, 0, "{}", said.err);
    for word in [
        "tilt 2.000e-3 rad",
        "smoothing changed it by",
        "1.000e-7 m at the axis",
    ] {
        has(&said.err, word);
    }
    std::fs::remove_file(dir.path("shape.csv")).expect("removed");
    dir.done("run first/scenario.toml --cycles 1 --out second --quiet");
    has(&dir.read("first/state.csv"), "# table: 251 points");
    assert_eq!(dir.read("first/state.csv"), dir.read("second/state.csv"));
    assert_eq!(
        dir.read("first/scenario.toml"),
        dir.read("second/scenario.toml")
    );
}

#[test]
fn bad_tables_are_one_line() {
    let dir = TestDir::new();
    let sphere = |r: f64| r * r / 0.02;
    let in_mm = table(100, 0.0, sphere)
        .lines()
        .skip(1)
        .map(|line| {
            let (r, f) = line.split_once(',').expect("two columns");
            let mm = |field: &str| 1e3 * field.parse::<f64>().expect("a number");
            format!("{},{}\n", mm(r), mm(f))
        })
        .collect::<String>();
    let with_um = table(100, 0.0, |r| 1e6 * sphere(r));
    let mut gap = table(100, 0.0, sphere);
    gap.push_str("3e-4,\n");
    let mut back = table(100, 0.0, sphere);
    back.push_str("2e-4,1e-5\n");
    let mut broken = table(100, 0.0, sphere);
    broken.push_str("3e-4,nan\n");
    let short = table(100, 0.0, sphere)
        .lines()
        .take(30)
        .collect::<Vec<_>>()
        .join("\n");
    let crater = table(100, 0.0, |r| {
        sphere(r) + 2e-7 * (-(r / 3e-5 - 2.0).powi(2)).exp()
    });
    for (csv, expected) in [
        (format!("r_m,f_m\n{in_mm}"), "are r and f in m?"),
        (with_um, "are r and f in m?"),
        (gap, "shape.csv: line 103: f_m is empty"),
        (
            broken,
            "shape.csv: line 103: f_m = nan: must be a finite number",
        ),
        (
            back,
            "indenter.file=shape.csv: must increase, and follows 2.5e-4",
        ),
        (
            short,
            "the table ends at r = 7e-5 m, but the contact can reach",
        ),
        (crater, "the contact would be a ring"),
        ("r_m,z_m\n0,0\n".into(), "shape.csv: has no column f_m"),
        ("r_m,f_m\n0,0\n".into(), "must be from 4 to 20000 points"),
    ] {
        dir.write("shape.csv", csv.as_bytes());
        dir.refuse_line(&format!("run {TABLE} --cycles 1 --out new"), expected);
    }
    // Millimetres that say so are no mistake.
    dir.write("shape.csv", format!("r_mm,f_mm\n{in_mm}").as_bytes());
    dir.done(&format!("run {TABLE} --cycles 0.1 --out new --quiet"));
    std::fs::remove_file(dir.path("shape.csv")).expect("removed");
    let gone = format!("run {TABLE} --cycles 1 --out other");
    dir.refuse_line(&gone, "shape.csv: no such file");
}
