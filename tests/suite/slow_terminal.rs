//! Slow or stalled terminals: keys are answered first, and every end comes within a second.
//!
//! The line is a pseudo-terminal that is read at a limited rate. It holds some 16 kB that
//! nobody has read yet, so that a program which sends what it has is soon half a minute behind.

use std::thread;
use std::time::{Duration, Instant};

use mdr_tui::scenario::session::Session;
use tempfile::TempDir;
use vt100::Screen;

use crate::flow::bounds;
use crate::pty::{Line, Terminal, at_home, cycle, home, kept, patiently, read};

fn is_under_way(screen: &Screen) -> bool {
    cycle(screen).is_some_and(|cycle| cycle > 0.0)
}

fn session(home: &TempDir) -> Session {
    read(&kept(home).expect("a checkpoint"))
}

/// How long keys take to show on a line that becomes this slow.
fn latencies(line: Line) -> Vec<Duration> {
    let home = home();
    let before = Line { rate: None, ..line };
    let mut terminal = Terminal::start_on(before, at_home(&home, &[]), 80, 24);
    terminal.wait_until("explorer under way", is_under_way);
    if let Some(rate) = line.rate {
        terminal.slow_down(rate);
    }
    // Long enough to fall behind.
    thread::sleep(Duration::from_secs(5));
    let mut latencies = Vec::new();
    for sign in ["paused", "running", "paused", "running"] {
        let pressed = Instant::now();
        terminal.press(" ");
        terminal.wait_for(sign);
        latencies.push(pressed.elapsed());
        thread::sleep(Duration::from_millis(700));
    }
    eprintln!("{line:?}: {latencies:.1?}");
    assert_eq!(terminal.ends_soon("q"), 0);
    assert!(session(&home).simulation().cycle() > 0.0);
    latencies
}

#[test]
fn on_a_slow_line_a_key_shows_within_two_seconds() {
    let lines = [
        (Some(600), true, 0),
        (Some(600), true, 300),
        (None, false, 0),
    ];
    let lines = lines.map(|(rate, answers, round_trip)| Line {
        rate,
        answers,
        round_trip: Duration::from_millis(round_trip),
    });
    let found = lines.map(|line| thread::spawn(move || latencies(line)));
    for (found, line) in found.into_iter().zip(lines) {
        let found = found.join().expect("a line");
        // Whoever runs all the tests at once has a busy machine: one of four may be late.
        let late = found
            .iter()
            .filter(|found| **found > Duration::from_secs(2));
        assert!(late.count() <= 1, "{line:?}: {found:.1?}");
    }
}

/// What a busy machine takes to start the program, and to answer a key.
const BUSY: [f64; 2] = [4.0, 1.0];

/// However far away it is, slow and large, and whether it answers or not: within the bounds of the simulated line. Each
/// takes a few seconds, mostly of waiting.
#[test]
fn a_terminal_far_away_shows_the_whole_screen_and_keys() {
    let lines = [
        (f64::INFINITY, 0.3, 1),
        (f64::INFINITY, 1.0, 0),
        (9600.0, 0.3, 1),
        (9600.0, 0.05, 2),
        (1200.0, 1.0, 1),
        (2400.0, 0.1, 0),
    ];
    let far = lines.map(|(rate, round_trip, size)| {
        thread::spawn(move || {
            let home = home();
            let ([columns, rows], [complete, echo]) = bounds(rate, round_trip, size);
            let line = Line {
                rate: rate.is_finite().then_some(rate as u32),
                answers: true,
                round_trip: Duration::from_secs_f64(round_trip),
            };
            let start = Instant::now();
            let mut terminal = Terminal::start_on(line, at_home(&home, &[]), columns, rows);
            let whole = shown_whole(&terminal, start);
            let mut keys = [" ", " ", " "].map(|key| {
                thread::sleep(Duration::from_millis(300));
                let was = terminal.text().contains("paused");
                let pressed = Instant::now();
                terminal.press(key);
                terminal.wait_until("other state", |screen| {
                    screen.contents().contains("paused") != was
                });
                pressed.elapsed().as_secs_f64()
            });
            keys.sort_by(f64::total_cmp);
            eprintln!(
                "{line:?}, {columns} by {rows}: complete after {whole:.1} s (at most {complete:.1}), keys \
                 {keys:.1?} (at most {echo:.1})"
            );
            assert!(whole < complete + BUSY[0], "{line:?}: {whole} s");
            assert!(keys[1] < echo + BUSY[1], "{line:?}: {keys:?} s");
            assert_eq!(terminal.ends_soon("TERM"), 0);
        })
    });
    for far in far {
        far.join().expect("a line");
    }
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

/// An explorer whose first screen is more than a line holds that nobody reads.
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
    // What nobody reads is there already.
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
