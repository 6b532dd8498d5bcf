//! Every signal that asks a program to end is answered soon, whatever the program waits for.

use std::process::Child;
use std::thread;
use std::time::{Duration, Instant};

use crate::pty::SOON;
use crate::test_dir::{TestDir, end, names, signal};

/// What asks a program to end and can be kept from ending it at once.
pub const ENDING: [&str; 9] = [
    "INT", "TERM", "HUP", "QUIT", "ABRT", "ALRM", "USR1", "USR2", "XCPU",
];

fn start(dir: &TestDir, out: &str, fault: &str) -> Child {
    let line = "run li2019-fig3 --set numerics.points=20 --cycles 1e9 --checkpoint-every 0.01 \
                --snapshot-at 0.5 --out";
    let mut child = dir.start(&format!("{line} {out}"), &[("MDR_TUI_FAULT", fault)]);
    dir.wait_for(&mut child, &format!("{out}/run.checkpoint"));
    dir.wait_for(&mut child, &format!("{out}/state-0.5.csv"));
    child
}

/// The run ends soon with a checkpoint, which it names; the cycle that it tells.
fn ends(dir: &TestDir, child: Child, sign: &str, out: &str) -> String {
    let start = Instant::now();
    signal(&child, sign);
    let said = end(child);
    let waited = start.elapsed();
    eprintln!("{out}, {sign}: ended after {waited:.0?}");
    assert!(waited < SOON, "{sign}: {waited:.1?}");
    said.fails(75, "interrupted");
    let path = format!("{out}/run.checkpoint");
    let cycle = said.err.strip_prefix("mdr-tui: interrupted at cycle ");
    let (cycle, rest) = cycle
        .and_then(|rest| rest.split_once([';', ',']))
        .expect("a cycle");
    let hint = format!("; resume with: mdr-tui run --resume {path}\n");
    assert!(rest.ends_with(&hint), "{}", said.err);
    let kept = std::fs::read(dir.path(&path)).expect("a checkpoint");
    assert!(kept.starts_with(b"mdr-tui checkpoint "));
    assert_eq!(said.out, "");
    cycle.to_owned()
}

#[test]
fn a_run_keeps_itself_at_every_signal_that_asks_it_to_end() {
    let dir = TestDir::new();
    for sign in ENDING {
        let child = start(&dir, sign, "");
        let cycle = ends(&dir, child, sign, sign);
        // What is done is there.
        let state = dir.table(&format!("{sign}/state.csv"));
        assert_eq!(state.header("cycle"), cycle);
        let kept = [
            "history.csv",
            "run.checkpoint",
            "scenario.toml",
            "state-0.5.csv",
            "state.csv",
        ];
        assert_eq!(names(&dir.path(sign)), kept);
    }
}

// The faults are there in debug builds only.
#[cfg(debug_assertions)]
#[test]
fn a_step_that_takes_an_hour_keeps_no_signal_waiting() {
    let dir = TestDir::new();
    let child = start(&dir, "x", "long step");
    thread::sleep(Duration::from_millis(300));
    ends(&dir, child, "TERM", "x");
}

// The faults are there in debug builds only.
#[cfg(debug_assertions)]
#[test]
fn a_second_signal_does_not_cost_the_checkpoint() {
    let dir = TestDir::new();
    for (first, second) in [("HUP", "TERM"), ("INT", "INT")] {
        let child = start(&dir, first, "long step");
        thread::sleep(Duration::from_millis(300));
        signal(&child, first);
        thread::sleep(Duration::from_millis(100));
        ends(&dir, child, second, first);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_sweep_stops_at_the_signals_of_queues_and_starts_no_idle_threads() {
    let dir = TestDir::new();
    let study = "base = \"li2019-fig3\"\n[set]\n\"run.cycles\" = 1e6\n\"numerics.points\" = 20\n\
                 [[axis]]\nkey = \"friction.coefficient\"\nvalues = [0.1, 0.2, 0.3]\n";
    dir.write("s.toml", study.as_bytes());
    for sign in ["USR1", "XCPU"] {
        let out = format!("{sign}.csv");
        let mut child = dir.start(&format!("sweep s.toml --threads 4096 --out {out}"), &[]);
        dir.wait_for(&mut child, &format!(".mdr-tui-{out}.lock"));
        thread::sleep(Duration::from_millis(300));
        let threads = std::fs::read_dir(format!("/proc/{}/task", child.id()));
        let threads = threads.expect("a process").count();
        assert!(threads <= 3 + 3, "{threads} threads");
        signal(&child, sign);
        end(child).ends(75, "interrupted: 0 of 3 points");
    }
}

#[test]
fn a_figure_and_a_fit_that_are_interrupted_leave_no_lock_behind() {
    let dir = TestDir::new();
    dir.done("run li2019-fig3 --cycles 2 --set numerics.points=20 --out x --quiet");
    let long = "li2019-fig3 --set numerics.points=3000 --cycles 1000";
    let figure = format!("figure {long} -o f.svg");
    let fit = format!("fit {long} --scar x/state.csv --free wear.coefficient --out f.svg");
    for (line, sign) in [(&figure, "INT"), (&figure, "TERM"), (&fit, "INT")] {
        let mut child = dir.start(line, &[]);
        dir.wait_for(&mut child, ".mdr-tui-f.svg.lock");
        let start = Instant::now();
        signal(&child, sign);
        end(child).fails(1, "interrupted");
        assert!(start.elapsed() < SOON);
        assert_eq!(names(&dir.path("")), ["x"]);
    }
}

#[test]
fn a_file_that_has_grown_to_its_limit_is_an_error_in_one_line() {
    let dir = TestDir::new();
    let said = dir.shell("ulimit -f 8; exec $BIN run hertz --cycles 1 --out x --quiet");
    said.fails(1, "cannot write");
}
