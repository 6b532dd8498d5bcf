//! Two programs that want the same files: one has them, the other is refused and says why.

use std::fs;
use std::thread;
use std::time::Duration;

use crate::test_dir::{Said, TestDir, end, has, kill, names, signal};

/// Starts two programs, the second one `pause` after the first; what the winner and the loser say.
fn race(dir: &TestDir, lines: [&str; 2], pause: Duration) -> (usize, Said, Said) {
    let first = dir.start(lines[0], &[]);
    thread::sleep(pause);
    let second = dir.start(lines[1], &[]);
    let (first, second) = (end(first), end(second));
    match (first.code, second.code) {
        (0, 2) => (0, first, second),
        (2, 0) => (1, second, first),
        codes => panic!("{codes:?}: {}{}", first.err, second.err),
    }
}

/// The loser fails with one line: that the other program is at work, or what it has left.
#[track_caller]
fn hears_why(loser: &Said, left: &str) {
    let under_way = loser.err.contains("another run is writing there");
    assert!(under_way || loser.err.contains(left), "{}", loser.err);
    assert_eq!(loser.err.lines().count(), 1, "{}", loser.err);
}

#[test]
fn of_two_runs_into_one_directory_the_second_is_refused() {
    let dir = TestDir::new();
    let lines = ["hertz", "cone"].map(|preset| {
        format!("run {preset} --cycles 10 --set numerics.points=20 --quiet --history every-step")
    });
    for (line, out) in lines.iter().zip(["whole-0", "whole-1"]) {
        dir.done(&format!("{line} --out {out}"));
    }
    for round in 0..6 {
        let out = format!("x-{round}");
        let both = [0, 1].map(|i| format!("{} --out {out}", lines[i]));
        let pause = Duration::from_millis([0, 1, 5, 20, 60, 150][round % 6]);
        let (winner, _, loser) = race(&dir, [&both[0], &both[1]], pause);
        hears_why(&loser, "not empty");
        dir.alike(&format!("whole-{winner}"), &out);
    }
    // Without --out each has a separate directory.
    let [first, second] = [0, 1].map(|_| dir.start("run hertz --cycles 1 --quiet", &[]));
    assert_eq!((end(first).code, end(second).code), (0, 0));
    dir.alike("hertz-run", "hertz-run-2");
}

#[test]
fn a_run_under_way_is_refused_to_others_even_by_force_and_a_killed_one_is_not() {
    let dir = TestDir::new();
    let plan = "run hertz --cycles 1e9 --set numerics.points=8 --out x --checkpoint-every 0.001";
    let mut alive = dir.start(plan, &[]);
    dir.wait_for(&mut alive, "x/run.checkpoint");
    for line in [
        "run cone --cycles 1 --out x",
        "run cone --cycles 1 --out x --force",
        "run --resume x/run.checkpoint",
        "run --resume x/run.checkpoint --out x",
    ] {
        let owner = format!("another run is writing there (process {} on ", alive.id());
        dir.line(line).fails(2, &owner);
    }
    assert!(matches!(alive.try_wait(), Ok(None)), "it was disturbed");
    // A copy elsewhere disturbs nobody.
    fs::copy(dir.path("x/run.checkpoint"), dir.path("copy")).expect("a copy");
    dir.done("run --resume copy --cycles 3000 --out y --quiet");
    kill(alive);
    // What it has left behind is stale.
    dir.done("run cone --cycles 1 --out x --force --quiet");
    let files = ["history.csv", "loop.csv", "scenario.toml", "state.csv"];
    assert_eq!(names(&dir.path("x")), files);
}

/// Moved, or removed: what another run has put in its place since stays as it is, and the first keeps its checkpoint
/// elsewhere.
#[test]
fn a_run_whose_directory_is_gone_writes_over_no_other() {
    let dir = TestDir::new();
    let state = dir.path("state");
    let state = [("XDG_STATE_HOME", state.to_str().expect("a path"))];
    let plan =
        "run li2019-fig3 --cycles 1e9 --set numerics.points=20 --quiet --checkpoint-every 0.02";
    dir.done("run hertz --cycles 1 --out whole --quiet");
    for is_moved in [true, false] {
        let out = if is_moved { "x" } else { "y" };
        let mut first = dir.start(&format!("{plan} --out {out}"), &state);
        dir.wait_for(&mut first, &format!("{out}/run.checkpoint"));
        match is_moved {
            true => fs::rename(dir.path(out), dir.path("away")).expect("a directory"),
            false => fs::remove_dir_all(dir.path(out)).expect("a directory"),
        }
        dir.done(&format!("run hertz --cycles 1 --out {out} --quiet"));
        thread::sleep(Duration::from_millis(300));
        signal(&first, "TERM");
        let said = end(first);
        assert_eq!(said.code, 1, "{}", said.err);
        has(&said.err, "was moved, removed or cleared meanwhile");
        has(&said.err, "resume with: mdr-tui run --resume ");
        dir.alike("whole", out);
        let kept = said
            .err
            .rsplit_once("--resume ")
            .map(|(_, path)| path.trim());
        let kept = kept.expect("a checkpoint");
        // Where the other run is now, it does not go on.
        dir.refuse_line(&format!("run --resume {kept}"), "not empty");
    }
}

#[test]
fn of_two_that_resume_one_checkpoint_the_second_is_refused() {
    let dir = TestDir::new();
    let plan = "run li2019-fig3 --set numerics.points=40 --history every-step --quiet";
    dir.done(&format!("{plan} --cycles 12 --out whole"));
    for pause in [0, 3] {
        let line = format!("{plan} --cycles 12 --out x --checkpoint-every 0.001 --force");
        let mut broken = dir.start(&line, &[]);
        dir.wait_for(&mut broken, "x/run.checkpoint");
        kill(broken);
        let line = "run --resume x/run.checkpoint --quiet --checkpoint-every 0.001";
        let (_, _, loser) = race(&dir, [line; 2], Duration::from_millis(pause));
        hears_why(&loser, "no such file");
        dir.alike("whole", "x");
    }
}
