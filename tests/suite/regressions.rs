//! Defects that were found once stay away: keys in any order, too many of anything, and runs that are
//! replayed from what they wrote.

use std::process::{Child, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use mdr_tui::scenario::checkpoint;
use mdr_tui::scenario::preset;

use crate::common::{begin, load, ran, rehearsed_on, text_of};
use crate::test_dir::{TestDir, has, lacks};

#[test]
fn a_comparison_may_begin_on_a_panel_that_shows_no_profile() {
    for preset in preset::ALL {
        for keys in ["zkc", "zkkc", "zkkkc."] {
            // Given a number of points, a preset that chooses no numerics waits for no search.
            let session = begin(load(preset.name, &["numerics.points=100"]));
            rehearsed_on(session, keys, (80, 24));
        }
    }
}

// The faults are there in debug builds only.
#[cfg(debug_assertions)]
#[test]
fn a_panic_in_a_script_or_a_study_says_what_failed() {
    let dir = TestDir::new();
    let script = "--print 80x24 --keys .";
    for (place, line) in [
        ("script", script),
        ("worker", script),
        ("command", "presets"),
    ] {
        let said = dir.line_with(line, &[("MDR_TUI_FAULT", place)]);
        said.fails(1, &format!("a fault in the {place}"));
        assert!(said.err.starts_with("mdr-tui: bug in mdr-tui: "));
    }
}

/// The most memory that a program has used so far, in bytes; 0 where it has ended.
#[cfg(target_os = "linux")]
pub fn memory_of(child: &Child) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{}/status", child.id()));
    let status = status.unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.trim().strip_suffix(" kB"));
    kilobytes.map_or(0, |text| {
        1024 * text.trim().parse::<u64>().expect("a number")
    })
}

/// The most memory that a program has used, in bytes, while it ran to its end.
#[cfg(target_os = "linux")]
fn peak_memory(mut child: Child) -> u64 {
    let (mut peak, start) = (0, Instant::now());
    while let Ok(None) = child.try_wait() {
        peak = peak.max(memory_of(&child));
        assert!(start.elapsed() < Duration::from_secs(600), "no end");
        thread::sleep(Duration::from_millis(2));
    }
    assert!(child.wait().expect("an end").success());
    peak
}

#[cfg(target_os = "linux")]
#[test]
fn restarts_and_the_past_stay_within_their_memory() {
    let dir = TestDir::new();
    let keys = "..r".repeat(60);
    let points = "numerics.points=2000";
    let run = |keys: &str| {
        let arguments = ["li2019-fig3", "--set", points, "--print", "80x24", "--keys"];
        let mut command = dir.command(&[&arguments[..], &[keys]].concat());
        command.stdout(Stdio::null());
        peak_memory(command.spawn().expect("the program starts"))
    };
    let grown = run(&keys) - run("..r");
    assert!(grown < 80 << 20, "{} MiB", grown >> 20);
}

/// A scenario whose end, and twice that, lie between two steps.
fn cut_short() -> String {
    let (before, _) = text_of("li2019-fig3").split_once("[run]").expect("a table");
    format!("{before}\n[run]\ncycles = 1.00613\n")
}

#[test]
fn past_an_end_between_two_steps_a_replay_takes_the_same_steps() {
    let dir = TestDir::new();
    dir.write("mine.toml", cut_short().as_bytes());
    dir.done("mine.toml --print 80x24 --keys ,,s");
    let state = dir.read("mine-cycle-2/state.csv");
    let told = dir.read("mine-cycle-2/scenario.toml");
    has(&told, "shortened_at = [1.00613]");
    dir.done("run mine-cycle-2/scenario.toml --out replayed --quiet");
    assert!(dir.read("replayed/state.csv") == state, "another run");
    // What is replayed is written down as it was.
    assert_eq!(told, dir.read("replayed/scenario.toml"));

    // A run that is resumed and sent further.
    let path = dir.path("mine.toml").display().to_string();
    let session = ran(load(&path, &[]), 1.00613);
    let kept = checkpoint::encode(&session, None::<&()>);
    dir.write("kept.checkpoint", &kept);
    dir.done("run --resume kept.checkpoint --cycles 2 --out further --quiet");
    assert!(dir.read("further/state.csv") == state, "another run");
    dir.done("run further/scenario.toml --out again --quiet");
    assert!(dir.read("again/state.csv") == state, "another run");
    // A run to its end is written down as ever.
    dir.done("run mine.toml --out whole --quiet");
    lacks(&dir.read("whole/scenario.toml"), "shortened_at");
}

#[test]
fn a_run_that_was_stopped_on_its_way_jumps_in_a_replay_as_it_did() {
    let dir = TestDir::new();
    let sets = ["numerics.points=40", "numerics.steps_per_cycle=20"];
    let scenario = load("mild-million", &sets);
    // A goal that cuts a jump short, and a stop somewhere before it.
    let mut shortened = 0;
    for goal in [37.3, 211.7, 1003.1, 2500.9] {
        let mut session = begin(scenario.clone());
        while session.simulation().cycle() < goal {
            session.step_until(goal).expect("a step");
            let cycle = session.simulation().cycle();
            let recorded = session.as_run(Vec::new());
            let is_on_its_way = recorded.run().shortened_at.contains(&goal) && cycle < goal;
            if !is_on_its_way || cycle.fract() != 0.5 {
                continue;
            }
            shortened += 1;
            let name = format!("goal-{goal}.toml");
            dir.write(&name, recorded.to_toml().as_bytes());
            dir.done(&format!("run {name} --out out-{goal} --quiet"));
            let state = mdr_tui::export::state::table(&session);
            assert!(
                dir.read(&format!("out-{goal}/state.csv")) == state,
                "{goal}"
            );
            break;
        }
    }
    assert!(shortened > 0, "no goal has cut a jump short");
}
