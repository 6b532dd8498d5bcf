//! `mdr-tui trade`: what it prints, writes and refuses, and that its numbers are the runs'.

use std::fs;

use mdr_tui::math::abel::AbelMethod;
use mdr_tui::reading::Quantity;
use mdr_tui::simulation::Scheme;
use mdr_tui::studies::refinement::{Level, Outcome};
use mdr_tui::studies::trade::{self, Candidate, POINTS, STEPS};

use crate::common::load;
use crate::test_dir::{Said, TestDir, end, has, signal};

fn small(more: &str) -> Said {
    let line = "trade li2019-fig3 --cycles 3 --points 12,24,48 --steps 50,100 --methods product,a";
    TestDir::new().line(&format!("{line} {more}"))
}

#[test]
fn the_front_is_printed_and_drawn_and_everything_is_written() {
    let directory = tempfile::tempdir().expect("a directory");
    let file = directory.path().join("trade.csv");
    let path = file.to_str().expect("a path");
    let Said { code, out, err } = small(&format!("--plot --marker ascii --csv {path}"));
    assert_eq!((code, err.as_str()), (0, ""));
    // Its own error is known, and far below what it accuses others of.
    let own = out.split("; its own error is ").nth(1);
    let own = own.and_then(|rest| rest.split(' ').next()?.parse::<f64>().ok());
    assert!(own.is_some_and(|own| own < 1e-3), "{out}");
    // The cost of an accuracy that finds its level by itself, next to the best fixed setting.
    for accuracy in ["1e-2: ", "1e-3: "] {
        let start = format!("numerics.accuracy = {accuracy}");
        let line = out.lines().find(|line| line.contains(&start));
        let line = line.unwrap_or_else(|| panic!("{accuracy}{out}"));
        let rest = line.split("error of scar and volume ").nth(1);
        let error = rest.and_then(|rest| rest.split(';').next()?.parse::<f64>().ok());
        let asked: f64 = accuracy.trim_end_matches(": ").parse().expect("a number");
        assert!(error.is_some_and(|error| error < asked), "{line}");
        has(line, "fixed setting");
    }
    has(&out, "time_s");
    // The last line can be typed: it passes its checks, and its worst error is small enough.
    let last = out.lines().last().expect("a line");
    assert!(last.starts_with("use this: --set numerics."), "{last}");
    let stars = out.lines().filter(|line| line.ends_with('*')).count();
    assert!(stars >= 2, "{out}");

    let csv = fs::read_to_string(&file).expect("the file");
    let rows: Vec<&str> = csv.lines().filter(|line| !line.starts_with('#')).collect();
    // Two methods by two schemes on three grids in two step sizes, and five tolerances by the best.
    assert_eq!(rows.len(), 1 + 2 * 2 * 3 * 2 + 3 * 2 * 5, "{csv}");
    assert!(
        rows[0].starts_with("method,scheme,integrator,points,steps_per_cycle,tolerance,time_s")
    );

    let Said { code, err, .. } = small(&format!("--csv {path}"));
    assert_eq!(code, 2);
    has(&err, "already exists");
}

#[test]
fn the_cheapest_setting_for_an_accuracy_reaches_it() {
    let Said { code, out, err } = small("--accuracy 8e-3");
    assert_eq!((code, err.as_str()), (0, ""));
    let sets = out.lines().filter_map(|line| line.strip_prefix("--set "));
    let sets: Vec<&str> = sets.collect();
    let has_points = sets.iter().any(|set| set.starts_with("numerics.points="));
    assert!(has_points, "{out}");
    // Against a reference of another make: Method A on many cells.
    let scenario = load("li2019-fig3", &[]);
    let end = |setting: &Candidate| {
        let (session, _) = setting.run(&scenario, 3.0, &|| true).expect("a run");
        Outcome::from_session(&session)
    };
    let recommended = load("li2019-fig3", &sets);
    let setup = recommended.setup();
    let setting = Candidate {
        method: setup.method,
        scheme: setup.scheme,
        level: Level::from_scenario(&recommended),
    };
    let reference = Candidate {
        method: AbelMethod::A,
        scheme: Scheme::Trapezoid,
        level: Level {
            points: 1600,
            steps: 50,
            tolerance: None,
            nodes: None,
        },
    };
    let errors = end(&setting).difference_from(&end(&reference));
    assert!(errors[Quantity::WornDepth] <= 8e-3, "{errors:?}");
    // The references differ by some of it.
    assert!(errors.promised() <= 1e-2, "{errors:?}");

    // What no fixed setting meets, a search may.
    let Said { code, out, err } = small("--accuracy 2e-4");
    assert_eq!((code, err.as_str()), (0, ""));
    has(&out, "--set numerics.accuracy=2e-4");

    let Said { code, err, .. } = small("--accuracy 1e-12");
    assert_eq!(code, 1);
    has(&err, "no setting reached an error of 1e-12");
}

#[test]
fn every_setting_is_a_scenario() {
    for name in ["li2019-fig3", "mild-million"] {
        let scenario = load(name, &[]);
        let settings = trade::settings(&scenario, &AbelMethod::ALL, &POINTS, &STEPS);
        assert!(settings.len() > 50, "{}", settings.len());
        for setting in &settings {
            let made = setting.of_scenario(&scenario).expect("a scenario");
            let setup = made.setup();
            let (method, scheme) = (setup.method, setup.scheme);
            assert_eq!((method, scheme), (setting.method, setting.scheme));
            assert_eq!(Level::from_scenario(&made), setting.level);
        }
        // A million cycles are not stepped for a table.
        let mut jumps = settings.iter().map(|setting| setting.level.tolerance);
        let all_jump = jumps.all(|tolerance| tolerance.is_some());
        assert_eq!(all_jump, name == "mild-million");
    }
}

#[test]
fn an_interrupt_keeps_what_is_done() {
    let dir = TestDir::new();
    let line = "trade li2019-fig3 --points 8,2000 --steps 10,20 --methods a --cycles 3 --all";
    let child = dir.start(line, &[]);
    std::thread::sleep(std::time::Duration::from_millis(300));
    signal(&child, "INT");
    let Said { code, out, err } = end(child);
    // Whenever it came: one of the two plain ends, and no panic.
    assert_eq!(code, 1);
    let early = err.contains("interrupted before the reference was computed");
    assert!(early || out.contains("settings were tried"), "{err} {out}");
}
