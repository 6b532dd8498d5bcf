//! `mdr-tui new`: the scenario of answers and of options, and what closed forms say of it.

use mdr_tui::scenario::Scenario;

use crate::pty::{Terminal, program};
use crate::test_dir::{TestDir, has, lacks};

#[test]
fn options_are_the_answers_where_nobody_is_asked() {
    let dir = TestDir::new();
    let said = dir.say(&[
        "new",
        "pin.toml",
        "--ball",
        "5",
        "--against",
        "titanium alloy",
        "--load",
        "20 N",
        "--stroke",
        "0.8 um",
        "--wear",
        "1e-5",
    ]);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
    for part in [
        "contact radius 96.8 µm",
        "Hertz pressure 1.02 GPa",
        "partial slip: a ring outside 84 %",
        "864000 cycles at 10 Hz",
    ] {
        has(&said.out, part);
    }
    let text = dir.read("pin.toml");
    has(&text, "# of a pin test: per load and sliding distance");
    let scenario = Scenario::from_toml(&text, "pin.toml", &[]).expect("a scenario");
    for (key, value) in [
        ("indenter.radius", "0.005"),
        ("material.half_space.youngs_modulus", "1.14e11"),
        ("motion.normal.mean", "20.0"),
        ("motion.tangential.amplitude", "4e-7"),
        ("motion.tangential.frequency", "10.0"),
        ("wear.coefficient_per_load", "1e-14"),
        ("run.cycles", "1000.0"),
    ] {
        assert_eq!(scenario.value(key).as_deref(), Some(value), "{key}");
    }
    dir.done("run pin.toml --cycles 0.1 --out x");
    // Another file is not written over.
    dir.refuse_line("new pin.toml", "pin.toml: already exists");
}

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
fn wrong_answers_are_told_and_nothing_is_written() {
    let dir = TestDir::new();
    for (options, rule) in [
        (
            &["--load", "10 mm"][..],
            "--load 10 mm: must have a unit compatible with N",
        ),
        (
            &["--material", "stone"],
            "--material stone: must be one of steel",
        ),
        (&["--ball", "0"], "--ball 0: must be greater than 0"),
        (&["--friction", "0,3"], "--friction 0,3: must be"),
        (&["--friction", "0"], "needs friction greater than 0"),
        (&["--material", "rigid", "--against", "rigid"], "rigid"),
        (&["--ball", "1", "--punch", "1"], "cannot be used with"),
    ] {
        dir.refuse(&[&["new", "x.toml"], options].concat(), rule);
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
