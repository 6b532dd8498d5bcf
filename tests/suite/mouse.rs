//! The mouse in a real pseudo-terminal: asked for only with `--mouse`;
//! clicks and the wheel as a terminal tells of them.

use std::thread;
use std::time::{Duration, Instant};

use vt100::{Color, Screen};

use crate::pty::{TIMEOUT, Terminal, program};
use crate::test_dir::lacks;

/// Longer than the two halves of a double click may lie apart.
const APART: Duration = Duration::from_millis(500);

/// The explorer, paused after the first cycle.
fn paused(arguments: &[&str]) -> Terminal {
    let mut terminal = Terminal::start(program(arguments), 80, 24);
    terminal.wait_for("running");
    terminal.press(" ,");
    terminal.wait_for("paused");
    terminal.wait_for_silence();
    terminal
}

/// A press and a release of the left button, at a column and row counted from 1.
fn click(column: u16, row: u16) -> String {
    format!("\x1b[<0;{column};{row}M\x1b[<0;{column};{row}m")
}

/// Which panels the screen shows.
fn panels(screen: &Screen) -> Vec<&'static str> {
    let text = screen.contents();
    let titles = [
        "3D profile",
        "stresses",
        "1D profile",
        "fretting loop",
        "radii over cycles",
        "numbers",
    ];
    // A title stands at the beginning of a rule, with what is magnified behind it.
    let ends = [" ─", ", wear"];
    let is_shown = |title: &&str| {
        ends.iter()
            .any(|end| text.contains(&format!(" {title}{end}")))
    };
    titles.into_iter().filter(is_shown).collect()
}

/// Waits until the screen shows these panels and no others.
fn await_panels(terminal: &Terminal, expected: &[&str]) {
    terminal.wait_until(&format!("{expected:?}"), |screen| {
        panels(screen) == expected
    });
}

/// The radius that the cursor reads, µm, once it is another one than `before`.
fn radius(terminal: &Terminal, before: f64) -> f64 {
    let read = |screen: &Screen| -> Option<f64> {
        let text = screen.contents();
        let mut words = text.lines().last().unwrap_or_default().split_whitespace();
        match [words.next(), words.next(), words.next()] {
            [Some("r"), Some(number), Some("µm")] => number.parse().ok(),
            _ => None,
        }
    };
    terminal.wait_until("a radius", |screen| {
        read(screen).is_some_and(|r| r != before)
    });
    terminal.look(read).expect("a radius")
}

#[test]
fn without_the_option_the_terminal_keeps_its_mouse() {
    let mut terminal = paused(&[]);
    // What a terminal in an odd mode may tell all the same.
    terminal.press(&click(60, 3));
    terminal.press("z");
    await_panels(&terminal, &["3D profile"]);
    terminal.quit();
    let text = String::from_utf8_lossy(&terminal.raw()).into_owned();
    for mode in ["?9", "?1000", "?1002", "?1003", "?1005", "?1006", "?1015"] {
        for end in ["h", "l"] {
            lacks(&text, &format!("\x1b[{mode}{end}"));
        }
    }
}

#[test]
fn a_click_focuses_and_another_zooms() {
    let mut terminal = paused(&["--mouse"]);
    let all = terminal.look(panels);
    assert_eq!(all.len(), 4, "{}", terminal.text());
    // At first the profile has the focus.
    terminal.press(&click(60, 3));
    await_panels(&terminal, &all);
    terminal.press("z");
    await_panels(&terminal, &["stresses"]);
    terminal.press("z");
    await_panels(&terminal, &all);
    thread::sleep(APART);
    terminal.press(&click(60, 3));
    await_panels(&terminal, &["stresses"]);
    thread::sleep(APART);
    terminal.press(&click(10, 20));
    await_panels(&terminal, &all);

    // A double click zooms whether the panel had the focus or not.
    for panel in ["fretting loop", "fretting loop"] {
        thread::sleep(APART);
        terminal.press(&click(10, 20).repeat(2));
        await_panels(&terminal, &[panel]);
        terminal.press("\x1b");
        await_panels(&terminal, &all);
    }

    // Status line and footer, other buttons: nothing.
    thread::sleep(APART);
    for event in [&click(10, 1), &click(10, 24), "\x1b[<2;60;3M"] {
        terminal.press(event);
        terminal.press("z");
        await_panels(&terminal, &["fretting loop"]);
        terminal.press("z");
        await_panels(&terminal, &all);
    }
    terminal.quit();
}

#[test]
fn a_click_in_a_plot_moves_the_cursor_there() {
    let mut terminal = paused(&["--mouse"]);
    terminal.press("x");
    terminal.wait_for("stick");
    let (mut at, mut seen) = (radius(&terminal, -1.0), Vec::new());
    for column in [10, 20, 30, 50, 57, 64] {
        terminal.press(&click(column, 5));
        at = radius(&terminal, at);
        seen.push(at);
        let has_line = terminal.look(|screen| {
            let cell = screen.cell(5, column - 1).expect("a cell");
            !cell.contents().trim().is_empty()
        });
        assert!(has_line, "no cursor at {column}:\n{}", terminal.text());
    }
    assert!(seen[0] < seen[1] && seen[1] < seen[2], "{seen:?}");
    assert!(seen[3] < seen[4] && seen[4] < seen[5], "{seen:?}");
    // Ten columns are as far everywhere in a plot, to a hundredth of it and half of the last digit.
    let steps = [seen[1] - seen[0], seen[2] - seen[1]];
    assert!((steps[0] - steps[1]).abs() < 0.1 * steps[0], "{seen:?}");
    // A chart over something else has a separate cursor, once it has the focus.
    terminal.press(&click(60, 18));
    terminal.wait_until("cycles", |screen| {
        let text = screen.contents();
        let foot = text.lines().last().unwrap_or_default();
        foot.trim_start().starts_with("cycles ")
    });
    terminal.quit();
}

#[test]
fn the_wheel_zooms_about_the_cursor() {
    let mut terminal = paused(&["--mouse"]);
    let whole = shown(&terminal);
    terminal.press("x");
    let with_cursor = shown_when(&terminal, |now| *now != whole);
    terminal.press("\x1b[<64;20;5M");
    let zoomed = shown_when(&terminal, |now| *now != with_cursor);
    assert!(zoomed != with_cursor, "{}", terminal.text());
    terminal.press("\x1b[<65;20;5M");
    let back = shown_when(&terminal, |now| *now == with_cursor);
    assert!(back == with_cursor, "{}", terminal.text());
    terminal.quit();
}

/// The signs on the screen and how they look; blanks have no ink.
fn shown(terminal: &Terminal) -> Shown {
    // No half of a frame.
    terminal.wait_for_silence_of(Duration::from_millis(100));
    terminal.look(|screen| {
        let (rows, columns) = screen.size();
        let places = (0..rows.get()).flat_map(|row| (0..columns.get()).map(move |at| (row, at)));
        places
            .map(|(row, at)| {
                let cell = screen.cell(row, at).expect("a cell");
                match cell.contents().trim() {
                    "" => (String::new(), Color::Default, false, false),
                    sign => (sign.into(), cell.fgcolor(), cell.bold(), cell.inverse()),
                }
            })
            .collect()
    })
}

type Shown = Vec<(String, Color, bool, bool)>;

/// What the screen shows once `is_there` says so, or when patience ends.
fn shown_when(terminal: &Terminal, is_there: impl Fn(&Shown) -> bool) -> Shown {
    let start = Instant::now();
    loop {
        let now = shown(terminal);
        if is_there(&now) || start.elapsed() > TIMEOUT {
            return now;
        }
    }
}

/// What the screen shows once a whole frame is there, and no part of it.
fn settled(terminal: &mut Terminal) -> Shown {
    terminal.wait_for_silence();
    shown(terminal)
}

#[test]
fn the_wheel_moves_in_lists_and_help() {
    let [down, up] = ["\x1b[B", "\x1b[A"];
    let [wheel_down, wheel_up] = ["\x1b[<65;40;12M", "\x1b[<64;40;12M"];
    // The help is longer than this screen.
    let mut terminal = paused(&["--mouse"]);
    terminal.resize(80, 18);
    let before = settled(&mut terminal);
    for open in ["?", "p", "e", ":"] {
        terminal.press(open);
        shown_when(&terminal, |now| *now != before);
        let first = settled(&mut terminal);
        terminal.press(down);
        shown_when(&terminal, |now| *now != first);
        let second = settled(&mut terminal);
        assert!(first != second, "{open}: {}", terminal.text());
        // A click in what is open does nothing to the panels below.
        for (keys, wanted) in [
            (up, &first),
            (wheel_down, &second),
            (&click(60, 3), &second),
            (wheel_up, &first),
        ] {
            terminal.press(keys);
            let seen = shown_when(&terminal, |now| now == wanted);
            assert!(seen == *wanted, "{open}: {}", terminal.text());
        }
        terminal.press("\x1b");
        shown_when(&terminal, |now| *now == before);
    }
    terminal.press("z");
    await_panels(&terminal, &["3D profile"]);
    terminal.quit();
}
