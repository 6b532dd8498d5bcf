//! `mdr-tui verify`: what it prints, writes and refuses, and that its numbers are those of the
//! paper's Fig. 2 in kind.

use mdr_tui::math::abel::AbelMethod::{self, A, APlusB, B, Benad};
use mdr_tui::studies::verify::errors::NodalErrors;
use mdr_tui::studies::verify::{Problem, Solved, Task, tasks};
use serde_json::Value;

use crate::common::near;
use crate::test_dir::{TestDir, lacks};

fn said(arguments: &str) -> String {
    TestDir::new().done(&format!("verify {arguments}"))
}

fn errors(problem: Problem, method: AbelMethod, points: usize) -> Vec<NodalErrors> {
    let task = Task {
        problem,
        method,
        points,
    };
    task.run().errors.expect("errors")
}

fn hertz(method: AbelMethod) -> [NodalErrors; 3] {
    let all = errors(Problem::Hertz, method, 100);
    all.try_into().expect("g, p and w")
}

#[test]
fn the_tables_have_every_method_and_n_and_fit_eighty_columns() {
    let text = said("--points 100,50,100 --all");
    for &problem in Problem::ALL {
        let from = text.split(&format!("{problem}\n  ")).nth(1);
        let from = from.expect("a problem");
        let table = from.split("\n\n").next().expect("a table");
        let found: Vec<(String, String)> = table
            .lines()
            .skip_while(|line| !line.starts_with("method"))
            .skip(1)
            .map(|line| {
                let mut words = line.split_whitespace().map(str::to_owned);
                let mut word = || words.next().expect("a word");
                (word(), word())
            })
            .collect();
        let expected: Vec<(String, String)> = AbelMethod::ALL
            .iter()
            .flat_map(|method| ["50", "100"].map(|n| (method.name().into(), n.into())))
            .collect();
        assert_eq!(found, expected, "{problem}");
    }
    assert!(text.lines().all(|line| line.chars().count() <= 80));
    lacks(&text, "NaN");
    lacks(&text, "inf ");
    // The last line sums up: the default method's worst error on the finest grids.
    let last = text.lines().last().expect("a line");
    let worst = last.strip_prefix("verdict: product within ");
    let worst = worst
        .and_then(|rest| rest.split(' ').next())
        .expect("a verdict");
    let worst: f64 = worst.parse().expect("a number");
    assert!((1e-6..1e-1).contains(&worst), "{last}");
    // Without --all it is the only one.
    assert_eq!(said("--points 100,50,100"), format!("{last}\n"));
}

#[test]
fn json_has_a_row_for_each_quantity_and_its_observed_order() {
    let rows = said("--json --points 50,200 --problem hertz");
    let rows: Vec<Value> = serde_json::from_str(&rows).expect("JSON");
    assert_eq!(rows.len(), 3 * 2 * AbelMethod::ALL.len());
    let find = |method: &str, quantity: &str, points: u64| {
        let wanted = |row: &&Value| {
            row["method"] == method && row["quantity"] == quantity && row["points"] == points
        };
        rows.iter().find(wanted).expect("a row")
    };
    let fine = find("a", "w", 200);
    assert!((fine["max_order"].as_f64().expect("an order") - 2.0).abs() < 0.02);
    assert_eq!([&fine["nodes"], &fine["nodes_left_out"]], [201, 0]);
    assert!(fine["stopped_at_cycle"].is_null());
    let order = find("b", "w", 200)["max_order"].as_f64();
    assert!((order.expect("an order") - 1.45).abs() < 0.05);
    assert!(find("a", "w", 50)["max_order"].is_null());
    assert_eq!(find("a", "g", 50)["nodes_left_out"], 1);
    assert_eq!(find("a", "p", 50)["nodes_left_out"], 1);
}

/// "For the profile, there is no difference for the two methods, but for the deformation, the
/// method A is better". At the last node alone B's one-sided difference tells in g.
#[test]
fn the_errors_of_hertz_are_those_of_the_papers_figure_in_kind() {
    let ([g_a, p_a, w_a], [g_b, p_b, w_b]) = (hertz(A), hertz(B));
    for (r, (a, b)) in g_a.radii.iter().zip(g_a.errors.iter().zip(&g_b.errors)) {
        assert!(*r == 1.0 || (a / b - 1.0).abs() < 0.02, "g at {r}: {a} {b}");
    }
    // The largest error stands next to the axis and falls outwards.
    assert!(g_a.errors.windows(2).all(|pair| pair[0] > pair[1]));
    assert!(p_a.rms() < 1e-3 && p_b.rms() < 1e-3);
    let pairs = w_a.errors.iter().zip(&w_b.errors);
    // At the first node the trapezoid of B is right by chance: ½(u_0 + u_1) is the mean it needs.
    for (r, (a, b)) in w_a.radii.iter().zip(pairs).skip(2) {
        assert!(a < b, "w at {r}: {a} {b}");
        assert!(*r < 0.2 || 3.0 * a < *b, "w at {r}: {a} {b}");
    }
    assert_eq!([&*g_a.left_out, &p_a.left_out], [[0.0], [1.0]]);
    // The paper's suggestion (b) is A but for w, where it is B.
    let [g, p, w] = hertz(APlusB);
    assert_eq!((g, p, w), (g_a.clone(), p_a, w_b));
    assert_eq!(hertz(Benad)[0], g_a);
}

#[test]
fn edges_between_nodes_cost_the_published_methods_half_an_order() {
    for method in [A, APlusB, B, Benad] {
        let worst = [100, 400].map(|n| errors(Problem::Cattaneo, method, n)[0].max());
        let order = 0.5 * (worst[0] / worst[1]).log2();
        assert!((0.4..0.55).contains(&order), "{method}: {order}");
    }
}

#[test]
fn the_limit_tells_b_from_the_causal_methods_and_waits_for_long_on_fine_grids() {
    let rms = |method| errors(Problem::Limit, method, 100)[0].rms();
    near("a", rms(A), 1.87e-3, 0.03);
    near("b", rms(B), 4.25e-2, 0.03);
    let tasks = |long| tasks(&[Problem::Limit], &[400, 200], long).len();
    assert_eq!(tasks(false), AbelMethod::ALL.len());
    assert!(Problem::Limit.is_long(400) && !Problem::Limit.is_long(200));
    assert_eq!(tasks(true), 2 * AbelMethod::ALL.len());
}

#[test]
fn tasks_run_alike_twice() {
    let task = Task {
        problem: Problem::Cattaneo,
        method: A,
        points: 64,
    };
    let (once, again): (Solved, Solved) = (task.run(), task.run());
    assert_eq!(once, again);
}
