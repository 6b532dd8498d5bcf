//! A run that cannot go on stops at its last good step, keeps it, and says what would help.

use crate::test_dir::{TestDir, bits, has, lacks, names};

/// `--set`s that end in each cause, the cause, and what would help.
const CASES: [&str; 5] = [
    "numerics.method=benad wear.coefficient=1e-7 | the profile has diverged | numerics.method = \"product\" is stable",
    "numerics.method=b wear.coefficient=1e-6 | the profile has diverged | more numerics.steps_per_cycle",
    "numerics.method=a wear.coefficient=1e-5 numerics.stability=off | wear diverges | numerics.stability = \"sub-step\", more numerics.steps_per_cycle, fewer numerics.points",
    "numerics.method=a wear.coefficient=1e308 | is not finite | a smaller wear.coefficient",
    "motion.tangential.control=force motion.tangential.amplitude=3.2 | exceeds the friction limit | reduce motion.tangential",
];

/// Those that end before the first step, which have nothing to keep.
const AT_ONCE: [&str; 3] = [
    "motion.normal.control=force motion.normal.mean=1e9 motion.normal.amplitude=0 numerics.domain_radius=1e-4 | the normal force | increase numerics.domain_radius",
    "indenter.radius=1e300 | overflows | are SI",
    "motion.tangential.control=force motion.tangential.amplitude=100 | exceeds the friction limit | reduce motion.tangential",
];

/// Every case, what follows a scenario on the command line, and whether it starts.
fn cases() -> impl Iterator<Item = (String, &'static str, &'static str, bool)> {
    let starts = CASES.iter().map(|case| (case, true));
    let all = starts.chain(AT_ONCE.iter().map(|case| (case, false)));
    all.map(|(case, starts)| {
        let parts: Vec<&str> = case.split(" | ").collect();
        let sets = parts[0].split(' ').map(|set| format!(" --set {set}"));
        (sets.collect(), parts[1], parts[2], starts)
    })
}

#[test]
fn every_cause_keeps_the_last_good_step_and_says_what_would_help() {
    let dir = TestDir::new();
    let preset = mdr_tui::scenario::preset::find("li2019-fig3").expect("a preset");
    dir.write("mine.toml", preset.text.as_bytes());
    for (i, (sets, cause, help, starts)) in cases().enumerate() {
        let out = format!("out-{i}");
        let before = dir.inventory();
        let said = dir.line(&format!("run mine.toml --cycles 20 --out {out}{sets}"));
        assert_eq!(
            (said.code, said.out.as_str()),
            (1, ""),
            "{sets} {}",
            said.err
        );
        let lines = said.err.lines();
        let lines = lines.filter(|line| !line.contains("outside the theory"));
        assert_eq!(lines.count(), 1, "{}", said.err);
        for part in ["mdr-tui: mine.toml", "stopped after ", cause, help] {
            has(&said.err, part);
        }
        if !starts {
            assert!(dir.inventory() == before, "{sets:?} wrote something");
            continue;
        }
        assert_eq!(
            names(&dir.path(&out)),
            ["history.csv", "scenario.toml", "state.csv"]
        );
        let state = dir.table(&format!("{out}/state.csv"));
        let history = dir.table(&format!("{out}/history.csv"));
        let cycle: f64 = state.header("cycle").parse().expect("a number");
        let last = bits(&history.column("cycle")).last().copied();
        assert_eq!(last, Some(cycle.to_bits()));
        has(&said.err, &format!("stopped after {cycle} cycles"));
        for (name, column) in state.columns.iter().zip(0..state.columns.len() - 1) {
            let finite = state
                .rows
                .iter()
                .all(|row| row[column].parse::<f64>().is_ok_and(f64::is_finite));
            assert!(finite, "{sets:?}: {name}");
        }
        // What is kept is a run of its own, which ends well.
        dir.done(&format!("run {out}/scenario.toml --out again-{i} --quiet"));
        assert!(dir.read(&format!("{out}/state.csv")) == dir.read(&format!("again-{i}/state.csv")));
    }
}

#[test]
fn the_explorer_shows_the_cause_and_can_go_on_with_another_method() {
    let dir = TestDir::new();
    for (sets, cause, _, starts) in cases() {
        let said = dir.line(&format!("li2019-fig3 --print 200x24 --keys ,,,{sets}"));
        if !starts {
            assert_eq!(said.code, 1, "{sets:?}");
            has(&said.err, cause);
            continue;
        }
        assert_eq!(said.code, 0, "{sets:?}: {}", said.err);
        if said.out.contains("! stopped") {
            let footer = said.out.lines().last().unwrap_or_default();
            assert!(
                footer.contains(cause) || footer.contains("the run has failed"),
                "{sets:?}: {footer}"
            );
        }
    }
    // With another method the run goes on from the last good step.
    let (sets, ..) = cases().nth(2).expect("a case");
    let said = dir.line(&format!("li2019-fig3 --print 200x24 --keys ,M.{sets}"));
    has(&said.out, "│ method: product │ archard │");
    lacks(&said.out, "stopped");
}
