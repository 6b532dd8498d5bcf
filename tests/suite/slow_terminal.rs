//! Slow or stalled terminals: keys are answered first, and every end comes within a second.
//!
//! The line is a pseudo-terminal that is read at a limited rate. It holds some 16 kB that
//! is unread, so that a program which sends what it has is soon half a minute behind.

use std::thread;
use std::time::{Duration, Instant};

use mdr_tui::scenario::session::Session;
use tempfile::TempDir;
use vt100::Screen;

use crate::pty::{Line, Terminal, at_home, cycle, home, kept, patiently, read};

fn is_under_way(screen: &Screen) -> bool {
    cycle(screen).is_some_and(|cycle| cycle > 0.0)
}

fn session(home: &TempDir) -> Session {
    read(&kept(home).expect("a checkpoint"))
}

/// The one line that is really slow, 600 bytes a second and 300 ms there and back; `flow.rs` simulates all others.
#[test]
fn on_a_slow_line_a_key_shows_within_two_seconds() {
    let home = home();
    let line = Line {
        round_trip: Duration::from_millis(300),
        ..Line::default()
    };
    let mut terminal = Terminal::start_on(line, at_home(&home, &[]), 80, 24);
    terminal.wait_until("explorer under way", is_under_way);
    terminal.slow_down(600);
    // Long enough to fall behind.
    thread::sleep(Duration::from_secs(5));
    let latencies = ["paused", "running", "paused", "running"].map(|sign| {
        let pressed = Instant::now();
        terminal.press(" ");
        terminal.wait_for(sign);
        let latency = pressed.elapsed();
        thread::sleep(Duration::from_millis(700));
        latency
    });
    eprintln!("{latencies:.1?}");
    assert_eq!(terminal.ends_soon("q"), 0);
    assert!(session(&home).simulation().cycle() > 0.0);
    // All tests at once keep the machine busy: one of four may be late.
    let late = latencies
        .iter()
        .filter(|found| **found > Duration::from_secs(2));
    assert!(late.count() <= 1, "{latencies:.1?}");
}

/// The seconds from `start` until nearly all rows show something; some of the picture's are empty, on a large screen a
/// third.
fn shown_whole(terminal: &Terminal, start: Instant) -> f64 {
    terminal.wait_until("whole screen", |screen| {
        let (_, columns) = screen.size();
        let rows: Vec<String> = screen.rows(0, columns.get()).collect();
        let shown = rows.iter().filter(|row| !row.trim().is_empty());
        let empty = if rows.len() > 48 { 30 } else { 5 };
        is_under_way(screen) && shown.count() + empty > rows.len()
    });
    start.elapsed().as_secs_f64()
}

#[test]
fn a_terminal_that_never_answers_shows_the_whole_screen() {
    let home = home();
    let line = Line {
        answers: false,
        ..Line::default()
    };
    let start = Instant::now();
    let mut terminal = Terminal::start_on(line, at_home(&home, &[]), 80, 24);
    let whole = shown_whole(&terminal, start);
    assert!(whole < 8.0, "{whole} s");
    assert_eq!(terminal.ends_soon("TERM"), 0);
}

/// An explorer whose first screen is more than an unread line holds.
fn stalled(home: &TempDir, arguments: &[&str], fault: &str) -> Terminal {
    let line = Line {
        rate: Some(0),
        ..Line::default()
    };
    let mut command = at_home(home, &[&["--checkpoint-every", "0.02"], arguments].concat());
    command.env("MDR_TUI_FAULT", fault);
    let terminal = Terminal::start_on(line, command, 400, 150);
    patiently("no checkpoint", || kept(home));
    thread::sleep(Duration::from_millis(100));
    terminal
}

#[test]
fn a_terminal_that_stops_reading_keeps_nobody_from_ending() {
    let ways = ["TERM", "INT", "HUP", "QUIT", "USR1", "q", "\x03", "Q"];
    for some in ways.chunks(4) {
        let ends = some.iter().map(|&way| {
            thread::spawn(move || {
                let home = home();
                let mut terminal = stalled(&home, &[], "");
                assert_eq!(terminal.ends_soon(way), 0);
                assert!(terminal.has_its_modes_back(), "{way:?}: still in raw mode");
                let kept = session(&home);
                assert!(kept.simulation().cycle() > 0.0);
            })
        });
        for end in ends.collect::<Vec<_>>() {
            end.join().expect("an end");
        }
    }
}

// The faults are there in debug builds only.
#[cfg(debug_assertions)]
#[test]
fn a_step_that_takes_an_hour_keeps_no_end_waiting() {
    let home = home();
    let mut command = at_home(&home, &[]);
    command.env("MDR_TUI_FAULT", "long step");
    let mut terminal = Terminal::start(command, 200, 24);
    terminal.wait_until("sixth cycle", |screen| cycle(screen) > Some(4.5));
    thread::sleep(Duration::from_millis(300));
    assert_eq!(terminal.ends_soon("q"), 0);
    terminal.wait_for("mdr-tui: saved at cycle ");
    assert!(session(&home).simulation().cycle() > 4.0);
}

#[test]
fn whatever_was_typed_or_pasted_ctrl_c_comes_first() {
    let text = "set numerics.points=".repeat(50_000);
    let marked = format!("\x1b[200~{text}\x1b[201~");
    let unended = format!("\x1b[200~{text}");
    let steps = ".".repeat(20_000);
    for (what, keys) in [
        ("text", &text),
        ("marked", &marked),
        ("a paste without an end", &unended),
        ("steps", &steps),
    ] {
        let home = home();
        let mut terminal = Terminal::start(at_home(&home, &[]), 80, 24);
        terminal.wait_until("explorer under way", is_under_way);
        if what != "steps" {
            terminal.press(":");
            terminal.wait_for("commands (");
        }
        terminal.press(keys);
        // By hand, it comes a moment later.
        thread::sleep(Duration::from_millis(50));
        assert_eq!(terminal.ends_soon("\x03"), 0, "{what}");
    }
}

#[test]
fn what_is_pasted_is_typed_into_a_line_and_nowhere_else() {
    let home = home();
    let mut terminal = Terminal::start(at_home(&home, &[]), 100, 24);
    terminal.wait_until("explorer under way", is_under_way);
    terminal.press("\x1b[200~q\x1b[201~");
    terminal.wait_for("there is no line to paste into");
    terminal.press(":");
    terminal.wait_for("commands (");
    terminal.press("\x1b[200~set numerics.points=80\x1b[201~");
    terminal.wait_for(":set numerics.points=80");
    terminal.press("\r");
    terminal.wait_for("numerics.points = 80");
    terminal.quit();
}

#[test]
fn a_run_on_a_terminal_that_stops_reading_answers_signals() {
    let home = home();
    let line = Line {
        rate: Some(0),
        ..Line::default()
    };
    let bin = env!("CARGO_BIN_EXE_mdr-tui");
    // The unread output is there already.
    let start = format!(
        "(yes | head -c 100000 >&2) & sleep 0.2; exec '{bin}' run li2019-fig3 --cycles 1e9 \
         --checkpoint-every 0.02 --out '{}/x'",
        home.path().display()
    );
    let mut command = at_home(&home, &[]);
    *command.get_argv_mut() = ["sh", "-c", &start].map(Into::into).to_vec();
    let mut terminal = Terminal::start_on(line, command, 80, 24);
    let checkpoint = home.path().join("x/run.checkpoint");
    patiently("no checkpoint", || checkpoint.exists().then_some(()));
    thread::sleep(Duration::from_millis(300));
    assert_eq!(terminal.ends_soon("TERM"), 75);
}
