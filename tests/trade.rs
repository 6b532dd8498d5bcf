//! `mdr-tui trade`: what it prints, writes and refuses, and that its numbers are those of the runs.

use std::fs;
use std::process::{Command, Stdio};

use mdr_tui::math::abel::AbelMethod;
use mdr_tui::scenario::Scenario;
use mdr_tui::simulation::{Integrator, Scheme};
use mdr_tui::studies::trade::{self, Ladder, Setting};
use serde_json::Value;

#[expect(dead_code, reason = "the tests of other commands use the rest")]
mod desk;

use desk::{Desk, Said};

fn say(arguments: &[&str]) -> Said {
    Desk::new().say(&[&["trade"], arguments].concat())
}

const SMALL: [&str; 9] = [
    "li2019-fig3",
    "--cycles",
    "3",
    "--points",
    "8,16,32",
    "--steps",
    "10,20",
    "--methods",
    "product,a",
];

fn small(more: &[&str]) -> Said {
    say(&[&SMALL[..], more].concat())
}

fn load(name: &str, sets: &[&str]) -> Scenario {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    Scenario::load(name, &sets).expect("a scenario")
}

#[test]
fn the_front_is_printed_and_drawn_and_everything_is_written() {
    let directory = tempfile::tempdir().expect("a directory");
    let file = directory.path().join("trade.csv");
    let path = file.to_str().expect("a path");
    let Said { code, out, err } = small(&["--plot", "--marker", "ascii", "--csv", path]);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(
        out.contains("reference: product, N = 64, 40 steps a cycle"),
        "{out}"
    );
    assert!(out.contains("half as fine differs from it by"), "{out}");
    assert!(out.contains("time [s]"), "{out}");
    let stars = out.lines().filter(|line| line.ends_with('*')).count();
    assert!(stars >= 2, "{out}");

    let csv = fs::read_to_string(&file).expect("the file");
    let rows: Vec<&str> = csv.lines().filter(|line| !line.starts_with('#')).collect();
    // Two methods by two schemes on three grids in two step sizes, and five tolerances by the best.
    assert_eq!(rows.len(), 1 + 2 * 2 * 3 * 2 + 3 * 2 * 5, "{csv}");
    assert!(
        rows[0].starts_with("method,scheme,integrator,points,steps_per_cycle,tolerance,time_s")
    );

    let Said { code, err, .. } = small(&["--csv", path]);
    assert_eq!(code, 2);
    assert!(err.contains("exists already"), "{err}");
}

#[test]
fn rows_as_json_are_all_rows() {
    let Said { code, out, err } = small(&["--json"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let rows: Vec<Value> = serde_json::from_str(&out).expect("JSON");
    assert_eq!(rows.len(), 54);
    for row in &rows {
        assert!(
            row["time_s"].as_f64().is_some_and(|time| time > 0.0),
            "{row}"
        );
        assert!(
            row["error_rms"].as_f64().is_some_and(|error| error < 0.1),
            "{row}"
        );
    }
}

#[test]
fn the_cheapest_setting_for_an_accuracy_reaches_it() {
    let Said { code, out, err } = small(&["--accuracy", "2e-3"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let sets: Vec<&str> = out
        .lines()
        .filter_map(|line| line.strip_prefix("--set "))
        .collect();
    assert!(
        sets.iter().any(|set| set.starts_with("numerics.points=")),
        "{out}"
    );
    // Against a reference of another make: Method A on many cells.
    let scenario = load("li2019-fig3", &[]);
    let reference = Setting {
        method: AbelMethod::A,
        scheme: Scheme::Trapezoid,
        points: 1600,
        steps: 50,
        tolerance: None,
    };
    let go_on = |_| true;
    let fine = trade::run(&scenario, &reference, 3.0, &go_on);
    let fine = fine.expect("not stopped").expect("a run");
    let recommended = load("li2019-fig3", &sets);
    let setup = recommended.setup();
    let tolerance = out
        .lines()
        .find_map(|line| line.strip_prefix("--set numerics.tolerance="));
    let setting = Setting {
        method: setup.method,
        scheme: setup.scheme,
        points: setup.grid.cells(),
        steps: setup.steps_per_cycle,
        tolerance: tolerance.map(|text| text.parse().expect("a number")),
    };
    let found = trade::run(&scenario, &setting, 3.0, &go_on);
    let errors = found.expect("not stopped").expect("a run").against(&fine);
    assert!(errors.rms <= 2e-3, "{errors:?}");

    let Said { code, err, .. } = small(&["--accuracy", "1e-12"]);
    assert_eq!(code, 1);
    assert!(
        err.contains("no setting that was tried errs by 1e-12 or less"),
        "{err}"
    );
}

/// What `numerics.accuracy` chooses for a scene.
fn chosen(name: &str, sets: &[&str], accuracy: f64) -> Setting {
    let asked = format!("numerics.accuracy={accuracy}");
    let scenario = load(name, &[sets, &[&asked]].concat());
    let setup = scenario.setup();
    Setting {
        method: setup.method,
        scheme: setup.scheme,
        points: setup.grid.cells(),
        steps: setup.steps_per_cycle,
        tolerance: match setup.integrator {
            Integrator::Direct => None,
            Integrator::CycleJump { tolerance } => Some(tolerance),
        },
    }
}

/// The factor between the work of what an accuracy chooses and the least that a search over many settings finds,
/// for each accuracy, each of which must be reached. Work is transforms times cells.
fn factors(name: &str, sets: &[&str], accuracies: &[f64]) -> Vec<f64> {
    let best = |points, steps, tolerance| Setting {
        method: AbelMethod::Product,
        scheme: Scheme::Trapezoid,
        points,
        steps,
        tolerance,
    };
    let scenario = load(name, sets);
    let cycles = scenario.run().cycles.expect("an end");
    let run = |scenario: &Scenario, setting: &Setting| {
        let found = trade::run_once(scenario, setting, cycles, &|_| true);
        found.expect("not stopped").expect("a run")
    };
    // Of another make: no cell knows of the stick border, and there are thousands of them.
    let uniform = load(name, &[sets, &["numerics.grid=uniform"]].concat());
    let reference = run(&uniform, &best(2000, 50, None));
    let work = |setting: &Setting| {
        let sample = run(&scenario, setting);
        let work = sample.transforms as f64 * setting.points as f64;
        (work, sample.against(&reference).rms)
    };
    let mut tried = Vec::new();
    for points in [12, 18, 25, 35, 50, 70, 100] {
        for steps in [8, 12, 18] {
            for tolerance in [None, Some(0.1), Some(1e-2), Some(1e-3)] {
                // On few cells jumps are always cheaper.
                if tolerance.is_some() || points >= 70 {
                    tried.push(work(&best(points, steps, tolerance)));
                }
            }
        }
    }
    let factor = |&accuracy: &f64| {
        let setting = chosen(name, sets, accuracy);
        let (work, error) = work(&setting);
        assert!(
            error <= accuracy && error >= 0.1 * accuracy,
            "{accuracy} asked for: {error} of {setting:?}"
        );
        let enough = tried.iter().filter(|(_, error)| *error <= accuracy);
        let least = enough.map(|(work, _)| *work).fold(f64::INFINITY, f64::min);
        work / least
    };
    accuracies.iter().map(factor).collect()
}

/// What `numerics.accuracy` promises on Fig. 3: no more than twice the least that a search finds.
#[test]
fn an_accuracy_costs_at_most_twice_the_least() {
    let found = factors("li2019-fig3", &[], &[1e-2, 1e-3, 1e-4]);
    assert!(found.iter().all(|factor| *factor <= 2.0), "{found:?}");
}

/// And on scenes that it was not made from.
#[test]
fn an_accuracy_asked_for_is_reached() {
    let sets = [
        "motion.tangential.phase=0.5",
        "motion.normal.amplitude=1.5e-7",
        "motion.tangential.amplitude=0.8e-7",
        "wear.coefficient=3e-10",
        "run.cycles=120",
        "run.snapshot_at=[]",
    ];
    let found = factors("li2019-fig3", &sets, &[1e-2, 1e-3]);
    // Measured: 1.6 and 1.5.
    assert!(found.iter().all(|factor| *factor <= 2.0), "{found:?}");
    let sets = [
        "indenter.tip_radius=3e-5",
        "friction.coefficient=0.12",
        "motion.tangential.angular_frequency=200",
        "run.cycles=80",
    ];
    let found = factors("truncated-paraboloid", &sets, &[1e-2, 1e-3]);
    // Measured: 1.2 and 4.2; a lucky jump at a tolerance of 0.01 is the least.
    assert!(found.iter().all(|factor| *factor <= 5.0), "{found:?}");
}

#[test]
fn every_setting_is_a_scenario() {
    for name in ["li2019-fig3", "mild-million"] {
        let scenario = load(name, &[]);
        let ladder = Ladder::default();
        let settings = ladder.settings(&scenario);
        assert!(settings.len() > 50, "{}", settings.len());
        for setting in settings.iter().chain([&ladder.reference(&scenario)]) {
            let made = setting.of(&scenario).expect("a scenario");
            let setup = made.setup();
            assert_eq!(
                (setup.method, setup.scheme, setup.grid.cells()),
                (setting.method, setting.scheme, setting.points)
            );
            assert_eq!(setup.steps_per_cycle, setting.steps);
        }
        let direct = settings
            .iter()
            .filter(|setting| setting.tolerance.is_none());
        // A million cycles are not stepped for a table.
        assert_eq!(direct.count() == 0, name == "mild-million");
    }
}

#[test]
fn an_interrupt_keeps_what_is_done() {
    let child = Command::new(env!("CARGO_BIN_EXE_mdr-tui"))
        .args([
            "trade",
            "li2019-fig3",
            "--points",
            "8,2000",
            "--steps",
            "10,20",
        ])
        .args(["--methods", "a", "--cycles", "3", "--all"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs");
    std::thread::sleep(std::time::Duration::from_millis(300));
    Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .expect("kill");
    let output = child.wait_with_output().expect("an end");
    // Whenever it came: one of the two plain ends, and no panic.
    assert_eq!(output.status.code(), Some(1));
    let err = String::from_utf8(output.stderr).expect("UTF-8");
    let out = String::from_utf8(output.stdout).expect("UTF-8");
    let early = err.contains("interrupted before the reference was there");
    assert!(early || out.contains("settings were tried"), "{err} {out}");
}

#[test]
fn what_cannot_be_traded_is_refused_in_one_line() {
    for (arguments, line) in [
        (&["hertz"][..], "hertz: nothing wears"),
        (
            &["li2019-fig3", "--points", "3"],
            "points are whole numbers",
        ),
        (
            &["li2019-fig3", "--accuracy", "0"],
            "an accuracy is greater than 0",
        ),
        (&["li2019-fig3", "--methods", "c"], "invalid value 'c'"),
        (&["nothing.toml"], "no such file"),
    ] {
        let Said { code, out, err } = say(arguments);
        assert_eq!((code, out.as_str()), (2, ""), "{arguments:?}");
        assert!(err.contains(line), "{err}");
        assert_eq!(err.lines().count(), 1, "{err}");
    }
}
