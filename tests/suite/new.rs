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
        ("Which one: ball, punch, cylinder? [ball]", "\r"),
        ("Which one: load, depth? [load]", "spring\r"),
        ("Which one: load, depth? [load]", "l\r"),
        ("Radius of a ball", "\r"),
        ("Material of the indenter", "stone\r"),
        ("must be one of steel", "bronze\r"),
        ("Material of the flat body", "\r"),
        ("as it wears [10 N]", "0,5\r"),
        ("must be written with a point", "20\r"),
        ("= contact radius", ""),
        ("turning point [20 um]", "\r"),
        ("Coefficient of friction", "\r"),
        ("gross slip: the amplitude is beyond", ""),
        ("Cycles per second", "\r"),
        ("Wear coefficient of a pin test", "none\r"),
        ("Number of cycles", "50\r"),
        ("Open it", "n\r"),
    ] {
        terminal.wait_for(question);
        terminal.press(keys);
    }
    assert!(terminal.wait_for_end().success());
    let text = dir.read("mine.toml");
    has(
        &text,
        "title = \"ball of bronze on steel, 20 N, stroke 20 um\"",
    );
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
        terminal.wait_for("Which one");
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
