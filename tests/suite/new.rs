//! `mdr-tui new`: the scenario of answers and of options, and what closed forms say of it.

use mdr_tui::scenario::Scenario;

use crate::pty::{Terminal, program};
use crate::terminal::assert_given_back;
use crate::test_dir::{TestDir, has, lacks};

#[test]
fn every_shape_and_press_makes_a_scenario_that_loads() {
    let dir = TestDir::new();
    for (i, options) in [
        "",
        "--punch 1 --depth 1 --stroke 4 --wear none",
        "--ball 2 --depth 0.5um --material rigid --against 70,0.2",
        "--punch 200um --load 5N --cycles 100000",
        "--material steel --against UHMWPE --frequency 1 --friction 0.1",
    ]
    .into_iter()
    .enumerate()
    {
        let file = format!("{i}.toml");
        dir.done(&format!("new {file} {options}"));
        let text = dir.read(&file);
        let scenario = Scenario::from_toml(&text, &file, &[])
            .unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(text.contains("cycle-jump"), options.contains("100000"));
        assert_eq!(scenario.setup().wear.is_none(), options.contains("none"));
    }
}

#[test]
fn questions_are_asked_in_a_terminal_and_answered_at_once() {
    let dir = TestDir::new();
    let mut command = program(&["new", "mine.toml"]);
    command.cwd(dir.path("."));
    let mut terminal = Terminal::start(command, 120, 50);
    for (question, keys) in [
        ("Which shape presses", "\r"),
        ("Radius of the ball", "\r"),
        ("the indenter made of", "\r"),
        ("the flat body", "\r"),
        ("What presses the bodies", "\r"),
        ("Load (10 N)", "0,5\r"),
        ("must be written with a point", "\x7f\x7f\x7f20\r"),
        ("Stroke (20 um)", "\r"),
        ("Coefficient of friction", "\r"),
        ("gross slip: the amplitude is beyond", ""),
        ("Frequency", "\r"),
        ("Wear coefficient of a pin test", "none\r"),
        ("Cycles (1000)", "50\r"),
        ("Open it now", "n"),
    ] {
        terminal.wait_for(question);
        terminal.press(keys);
    }
    assert!(terminal.wait_for_end().success());
    let text = dir.read("mine.toml");
    has(&text, "mean = \"20 N\"");
    has(&text, "cycles = 50.0");
    lacks(&text, "[wear]");
}

/// The terminal is as it was, no lock is left, and one line says what has happened.
#[test]
fn questions_that_are_stopped_leave_nothing_behind() {
    let dir = TestDir::new();
    for way in ["\x03", "TERM", "HUP", "USR1"] {
        let mut command = program(&["new", "stopped.toml"]);
        command.cwd(dir.path("."));
        let mut terminal = Terminal::start(command, 80, 24);
        terminal.wait_for("Which shape presses");
        assert_eq!(terminal.ends_soon(way), 1);
        terminal.wait_for_end();
        assert_given_back(&terminal);
        has(
            &terminal.text(),
            "mdr-tui: interrupted; nothing was written",
        );
        let left = std::fs::read_dir(dir.path(".")).expect("a directory");
        assert_eq!(left.count(), 0, "{way}");
    }
}

#[test]
fn questions_that_have_no_room_are_refused() {
    let dir = TestDir::new();
    for (columns, rows, then) in [(80, 1, None), (1, 24, None), (80, 24, Some((80, 1)))] {
        let mut command = program(&["new", "small.toml"]);
        command.cwd(dir.path("."));
        let mut terminal = Terminal::start(command, columns, rows);
        if let Some((columns, rows)) = then {
            terminal.wait_for("Which shape presses");
            terminal.resize(columns, rows);
            terminal.press("\x1b[B");
        }
        assert_eq!(terminal.wait_for_end().exit_code(), 2);
        assert_given_back(&terminal);
        let raw = String::from_utf8_lossy(&terminal.raw()).replace(['\r', '\n'], "");
        has(&raw, "questions need 20 by 3");
    }
}
