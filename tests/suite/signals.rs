//! Every signal that asks a program to end is answered soon, whatever the program waits for.

use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::test_dir::{TestDir, end};

/// A second is what is promised; a machine that is busy with all the other tests takes longer.
pub const SOON: Duration = Duration::from_millis(2500);

/// What asks a program to end and can be kept from ending it at once.
pub const ENDING: [&str; 9] = [
    "INT", "TERM", "HUP", "QUIT", "ABRT", "ALRM", "USR1", "USR2", "XCPU",
];

fn start(dir: &TestDir, out: &str, fault: &str) -> Child {
    let line =
        "run li2019-fig3 --set numerics.points=20 --cycles 1e9 --checkpoint-every 0.01 --out";
    let mut command = dir.command(&line.split(' ').collect::<Vec<_>>());
    command.arg(out).env("MDR_TUI_FAULT", fault);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().expect("the program starts")
}

fn wait_for(dir: &TestDir, name: &str) {
    let start = Instant::now();
    while !dir.path(name).exists() {
        assert!(start.elapsed() < Duration::from_secs(60), "no {name}");
        thread::sleep(Duration::from_millis(2));
    }
}

fn signal(child: &Child, name: &str) {
    let kill = format!("kill -{name} {}", child.id());
    let sent = Command::new("sh").args(["-c", &kill]).status();
    assert!(sent.expect("a shell").success());
}

/// The run ends soon with a checkpoint, which it names.
fn assert_ends(dir: &TestDir, child: Child, sign: &str, out: &str) {
    let start = Instant::now();
    signal(&child, sign);
    let said = end(child);
    let waited = start.elapsed();
    eprintln!("{out}, {sign}: ended after {waited:.0?}");
    assert!(waited < SOON, "{sign}: {waited:.1?}");
    assert_eq!(
        (said.code, said.err.lines().count()),
        (1, 1),
        "{sign}: {}",
        said.err
    );
    let path = format!("{out}/run.checkpoint");
    let hint = format!("; resume with: mdr-tui run --resume {path}\n");
    assert!(
        said.err.contains("interrupted at cycle ") && said.err.ends_with(&hint),
        "{}",
        said.err
    );
    let kept = std::fs::read(dir.path(&path)).expect("a checkpoint");
    assert!(kept.starts_with(b"mdr-tui checkpoint "));
}

#[test]
fn a_run_keeps_itself_at_every_signal_that_asks_it_to_end() {
    let dir = TestDir::new();
    for sign in ENDING {
        let child = start(&dir, sign, "");
        wait_for(&dir, &format!("{sign}/run.checkpoint"));
        assert_ends(&dir, child, sign, sign);
    }
}

// The faults are there in debug builds only.
#[cfg(debug_assertions)]
#[test]
fn a_step_that_takes_an_hour_keeps_no_signal_waiting() {
    let dir = TestDir::new();
    let child = start(&dir, "x", "long step");
    wait_for(&dir, "x/run.checkpoint");
    thread::sleep(Duration::from_millis(300));
    assert_ends(&dir, child, "TERM", "x");
}

#[test]
fn a_file_that_has_grown_to_its_limit_is_an_error_in_one_line() {
    let dir = TestDir::new();
    let bin = env!("CARGO_BIN_EXE_mdr-tui");
    let line = format!("ulimit -f 8; exec '{bin}' run hertz --cycles 1 --out x --quiet");
    let mut command = Command::new("bash");
    command.args(["-c", &line]).current_dir(dir.path(""));
    command.env("XDG_STATE_HOME", dir.path("state"));
    let said = crate::test_dir::Said::from(command.output().expect("a shell"));
    assert_eq!(
        (said.code, said.err.lines().count()),
        (1, 1),
        "{}",
        said.err
    );
    assert!(said.err.contains("cannot write"), "{}", said.err);
}
