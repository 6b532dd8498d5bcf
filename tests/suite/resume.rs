//! `run --resume`: what a run that was interrupted, killed or starved of disk writes in the end.

use std::fs;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use mdr_tui::scenario::checkpoint;
use serde::de::IgnoredAny;

use crate::common::{load, planned};
use crate::random::Random;
use crate::test_dir::{TestDir, bits, end, has, kill, names, signal};

/// A run with snapshots between steps, a row a step, and changes on the way.
fn scenario() -> String {
    let changes = [
        (3.0, "numerics.method", "b"),
        (7.25, "numerics.method", "product"),
        (11.5, "numerics.points", "71"),
    ];
    let changes = changes.map(|(at, key, value)| planned(at, key, value));
    let scenario = load("li2019-fig3", &["numerics.points=60", "run.snapshot_at=[]"]);
    scenario.with_changes(changes.to_vec()).to_toml()
}

const ORDER: &str = "run mine.toml --cycles 240.125 --snapshot-at 10.123,2,30 --history every-step";

fn dir() -> TestDir {
    let dir = TestDir::new();
    dir.write("mine.toml", scenario().as_bytes());
    dir.done(&format!("{ORDER} --out whole --quiet"));
    dir
}

#[test]
fn a_run_that_was_interrupted_writes_what_one_that_was_not_writes() {
    let dir = dir();
    // Slowed down by a checkpoint after every step, so that the signal finds it under way.
    for (round, sign) in ["INT", "HUP"].into_iter().enumerate() {
        let out = format!("broken-{round}");
        let line = format!("{ORDER} --out {out} --checkpoint-every 0.001");
        let mut child = dir.start(&line, &[]);
        dir.wait_for(&mut child, &format!("{out}/state-2.csv"));
        signal(&child, sign);
        let said = end(child);
        assert_eq!(said.code, 75, "{}", said.err);
        let checkpoint = format!("{out}/run.checkpoint");
        // The files of an interrupted run show the moment of the interruption.
        let history = dir.table(&format!("{out}/history.csv"));
        let state = dir.table(&format!("{out}/state.csv"));
        let cycle: f64 = state.header("cycle").parse().expect("a number");
        let last = bits(&history.column("cycle")).last().copied();
        assert_eq!(last, Some(cycle.to_bits()));
        assert_eq!(history.rows[0].len(), history.columns.len());

        let hint = format!("resume with: mdr-tui run --resume {checkpoint}");
        dir.refuse_line(&format!("run mine.toml --cycles 1 --out {out}"), &hint);

        // Where it lies; the folder may have been moved.
        let elsewhere = format!("run --resume {checkpoint} --out elsewhere");
        dir.refuse_line(&elsewhere, "is resumed in the folder where it lies");
        if round == 0 {
            fs::rename(dir.path(&out), dir.path("moved")).expect("a directory");
            dir.done("run --resume moved/run.checkpoint --quiet");
            dir.alike("whole", "moved");
            assert!(!dir.path(&out).exists());
        } else {
            dir.done(&format!("run --resume {checkpoint} --out {out} --quiet"));
            dir.alike("whole", &out);
        }
    }
}

/// Starts a run with snapshots and many rows in `out`, and interrupts it after its second snapshot.
fn interrupted(dir: &TestDir, out: &str, more: &str) {
    let line = format!(
        "run li2019-fig3 --cycles 9e4 --set numerics.points=30 --snapshot-at 1,8 --history every-step \
         --checkpoint-every 0.001 --out {out} {more}"
    );
    let mut child = dir.start(&line, &[]);
    dir.wait_for(&mut child, &format!("{out}/state-8.csv"));
    signal(&child, "TERM");
    let said = end(child);
    assert!(
        dir.path(&format!("{out}/run.checkpoint")).exists(),
        "{}",
        said.err
    );
}

#[test]
fn a_copy_of_a_checkpoint_leaves_the_run_that_took_its_place_alone() {
    let dir = TestDir::new();
    interrupted(&dir, "x", "");
    fs::copy(dir.path("x/run.checkpoint"), dir.path("copy")).expect("a copy");
    fs::rename(dir.path("x"), dir.path("kept")).expect("a directory");
    interrupted(&dir, "x", "--set friction.coefficient=0.3");
    dir.refuse_line("run --resume copy", "x: holds an interrupted run");
    dir.refuse_line("run --resume copy --out x", "x: holds an interrupted run");
    // Neither its rows nor its snapshots are mistaken for the copy's.
    let said = dir.line("run --resume copy --cycles 20 --out y --quiet");
    said.fails(0, "the history so far no longer exists");
    assert!(!names(&dir.path("y")).contains(&"state-1.csv".into()));
    let first = dir.table("y/history.csv").column("cycle")[0];
    assert!(first >= 1.0, "{first}");
    // Not even in its folder.
    fs::copy(dir.path("copy"), dir.path("x/run.checkpoint")).expect("a copy");
    let other = "another run has used this folder since";
    dir.refuse_line("run --resume x/run.checkpoint", other);
    // Even where the checkpoint is gone.
    fs::remove_file(dir.path("x/run.checkpoint")).expect("a file");
    dir.refuse_line("run --resume copy", "not empty");
    // With its own files back, the run goes on, to the same numbers.
    fs::rename(dir.path("x"), dir.path("other")).expect("a directory");
    fs::rename(dir.path("kept"), dir.path("x")).expect("a directory");
    dir.done("run --resume copy --cycles 20 --out z --quiet");
    let line = "run li2019-fig3 --cycles 20 --set numerics.points=30 --snapshot-at 1,8 --history every-step";
    dir.done(&format!("{line} --out whole --quiet"));
    dir.alike("whole", "z");
    fs::create_dir(dir.path("alone")).expect("a directory");
    fs::copy(dir.path("copy"), dir.path("alone/run.checkpoint")).expect("a copy");
    dir.done("run --resume alone/run.checkpoint --cycles 20 --quiet");
    dir.alike("whole", "alone");
    dir.done("run --resume x/run.checkpoint --cycles 20 --quiet");
    dir.alike("whole", "x");
}

#[test]
fn an_older_checkpoint_does_not_undo_what_its_run_has_done_since() {
    let dir = TestDir::new();
    interrupted(&dir, "x", "");
    fs::copy(dir.path("x/run.checkpoint"), dir.path("older")).expect("a copy");
    let mut child = dir.start(
        "run --resume x/run.checkpoint --checkpoint-every 0.001",
        &[],
    );
    let cycle = |name: &str| crate::pty::read(&dir.path(name)).simulation().cycle();
    let reached = cycle("older");
    while cycle("x/run.checkpoint") <= reached {
        assert!(matches!(child.try_wait(), Ok(None)), "an early end");
    }
    signal(&child, "TERM");
    end(child);
    let before = dir.inventory();
    dir.refuse_line("run --resume older", "the run has come further there");
    assert!(dir.inventory() == before);
    dir.line("run --resume older --cycles 20 --force --quiet")
        .ends(0, "");
}

#[test]
fn a_resumed_run_writes_the_field_that_was_asked_for() {
    let dir = TestDir::new();
    let line = "run li2019-fig3 --cycles 200 --set numerics.points=20 --checkpoint-every 0.001 --field --out x";
    let mut child = dir.start(line, &[]);
    dir.wait_for(&mut child, "x/run.checkpoint");
    kill(child);
    dir.done("run --resume x/run.checkpoint --quiet");
    assert!(names(&dir.path("x")).contains(&"field.csv".into()));
}

#[test]
fn a_resumed_run_may_go_further() {
    let dir = TestDir::new();
    let plan = "run li2019-fig3 --set numerics.points=40 --set run.snapshot_at=[1,3.5]";
    dir.done(&format!("{plan} --cycles 300 --out whole --quiet"));
    let line = format!("{plan} --cycles 1e9 --out broken --checkpoint-every 0.001");
    let mut child = dir.start(&line, &[]);
    dir.wait_for(&mut child, "broken/run.checkpoint");
    // The first one may be of the start.
    let kept = || crate::pty::read(&dir.path("broken/run.checkpoint"));
    while kept().simulation().cycle() == 0.0 {}
    kill(child);
    let shorter = "run --resume broken/run.checkpoint --cycles 0";
    dir.line(shorter).ends(2, "is already at cycle");
    dir.done("run --resume broken/run.checkpoint --cycles 300 --quiet");
    dir.alike("whole", "broken");
}

/// Kills runs at random moments and resumes them, `MDR_TUI_KILLS` times.
#[test]
fn killed_at_any_moment_nothing_is_torn_and_the_result_is_exact() {
    let kills = std::env::var("MDR_TUI_KILLS").ok();
    let kills: usize = kills.map_or(8, |kills| kills.parse().expect("a number"));
    let dir = dir();
    let (mut killed, mut resumed, mut rounds) = (0, 0, 0);
    let mut random = Random::new(std::process::id().into());
    while killed < kills {
        rounds += 1;
        let out = format!("round-{rounds}");
        let checkpoint = format!("{out}/run.checkpoint");
        loop {
            let line = if dir.path(&checkpoint).exists() {
                resumed += 1;
                format!("run --resume {checkpoint} --checkpoint-every 0.003 --quiet")
            } else {
                format!("{ORDER} --out {out} --checkpoint-every 0.003 --quiet --force")
            };
            let mut child = dir.start(&line, &[]);
            if killed < kills {
                thread::sleep(Duration::from_micros(random.next() % 150_000));
                let _ = child.kill();
            }
            let status = child.wait().expect("an end");
            assert_whole(&dir, &out);
            match status.code() {
                None => killed += 1,
                Some(code) => {
                    assert_eq!(code, 0);
                    break;
                }
            }
        }
        dir.alike("whole", &out);
    }
    eprintln!("{killed} kills, {resumed} resumed, {rounds} rounds: nothing torn");
}

/// Every file of a run that was killed is whole, or a temporary one.
fn assert_whole(dir: &TestDir, out: &str) {
    let Ok(entries) = fs::read_dir(dir.path(out)) else {
        return;
    };
    for entry in entries {
        let name = entry.expect("an entry").file_name();
        let name = name.to_string_lossy().into_owned();
        let path = dir.path(out).join(&name);
        if name == "run.checkpoint" {
            checkpoint::read::<IgnoredAny>(&path).expect("a whole checkpoint");
        } else if name == "provenance.toml" {
            let text = dir.read(&format!("{out}/{name}"));
            has(&text, "\narithmetic = \"");
            assert!(text.ends_with("\"\n"), "{text}");
        } else if !name.starts_with(".mdr-tui-") {
            let [found, due] = [out, "whole"].map(|of| dir.read(&format!("{of}/{name}")));
            assert!(found == due, "{out}: {name} is torn");
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn under_nohup_a_run_outlives_its_terminal() {
    let dir = dir();
    let bin = env!("CARGO_BIN_EXE_mdr-tui");
    let line =
        format!("trap '' HUP; exec '{bin}' {ORDER} --out nohup --checkpoint-every 0.001 --quiet");
    let mut command = Command::new("sh");
    command.args(["-c", &line]).current_dir(dir.path(""));
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("a shell");
    dir.wait_for(&mut child, "nohup/run.checkpoint");
    signal(&child, "HUP");
    let said = end(child);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
    dir.alike("whole", "nohup");
}

// The faults are there in debug builds only.
#[cfg(debug_assertions)]
#[test]
fn a_defect_keeps_what_is_done_and_says_so_in_one_line() {
    let dir = TestDir::new();
    let said = dir.line_with("run hertz --cycles 1 --out x", &[("MDR_TUI_FAULT", "run")]);
    said.fails(1, "a fault in the run");
    let kept = "history.csv run.checkpoint scenario.toml state.csv";
    assert_eq!(names(&dir.path("x")).join(" "), kept);
    dir.done("run --resume x/run.checkpoint --quiet");
    dir.done("run hertz --cycles 1 --out whole --quiet");
    dir.alike("whole", "x");
}
