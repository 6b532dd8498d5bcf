//! The explorer in a real pseudo-terminal: started, driven, resized, quit, killed and broken.

use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use portable_pty::CommandBuilder;
use vt100::{Cell, Color, MouseProtocolMode, Screen};

use crate::pty::{Line, Terminal, cycle, program};
use crate::random::Random;
use crate::test_dir::{TestDir, end, has};

fn is_running(screen: &Screen) -> bool {
    screen.contents().contains("running") && cycle(screen).is_some_and(|cycle| cycle > 0.0)
}

/// The explorer in 80 by 24, running.
fn running(arguments: &[&str]) -> Terminal {
    let terminal = Terminal::start(program(arguments), 80, 24);
    terminal.wait_until("running explorer", is_running);
    terminal
}

/// Main screen, cursor shown, cooked mode.
pub fn assert_given_back(terminal: &Terminal) {
    terminal.look(|screen| {
        assert!(!screen.alternate_screen(), "still on the alternate screen");
        assert!(!screen.hide_cursor(), "the cursor is still hidden");
        let mouse = screen.mouse_protocol_mode();
        assert_eq!(mouse, MouseProtocolMode::None, "the mouse is still taken");
    });
    assert!(terminal.has_its_modes_back(), "still in raw mode");
    let raw = terminal.raw();
    let last = |mark: &[u8]| raw.windows(mark.len()).rposition(|bytes| bytes == mark);
    assert!(
        last(b"\x1b[?2026h") <= last(b"\x1b[?2026l"),
        "still collecting output"
    );
}

/// Waits for the end and expects exit code 0 and nothing left behind.
fn assert_clean_end(terminal: &mut Terminal) {
    let status = terminal.wait_for_end();
    assert_eq!((status.exit_code(), status.signal()), (0, None));
    assert_given_back(terminal);
    kept_at(terminal);
}

/// The cycle and the checkpoint that the only line on the screen tells of; none where it is empty.
fn kept_at(terminal: &Terminal) -> Option<(f64, PathBuf)> {
    let text = terminal.look(|screen| {
        let (_, columns) = screen.size();
        let rows: Vec<String> = screen.rows(0, columns.get()).collect();
        rows.concat().trim().to_owned()
    });
    if text.is_empty() {
        return None;
    }
    let told = text
        .strip_prefix("mdr-tui: saved at cycle ")
        .and_then(|rest| rest.split_once("; resume with: mdr-tui --resume "));
    let (cycle, path) = told.unwrap_or_else(|| panic!("left behind: {text}"));
    Some((cycle.parse().expect("a cycle"), path.into()))
}

#[test]
fn it_runs_pauses_switches_resizes_and_quits() {
    let mut terminal = running(&[]);
    assert!(!terminal.has_its_modes_back(), "no raw mode");
    terminal.look(|screen| {
        assert!(screen.alternate_screen() && screen.hide_cursor());
        let text = screen.contents();
        let lines: Vec<&str> = text.lines().collect();
        // In 80 columns the title gives way to what runs and how.
        assert!(lines[0].starts_with(" ▶ running │ cycle "), "{text}");
        has(lines[0], " │ 0.5 cycles/s │ method: product │ ");
        has(lines[23], "? help");
        has(lines[23], "q quit");
    });
    let seen = terminal.look(cycle).expect("a cycle");
    terminal.wait_until("later cycle", |screen| {
        cycle(screen).is_some_and(|now| now > seen + 0.5)
    });

    terminal.press(" ");
    terminal.wait_for("paused");
    terminal.wait_for_silence();
    let (length, paused_at) = (terminal.raw().len(), terminal.look(cycle));
    thread::sleep(Duration::from_millis(500));
    assert_eq!(terminal.raw().len(), length, "output while paused");

    terminal.press("m");
    terminal.wait_for("numerics.method = a at cycle");
    terminal.press("m");
    terminal.wait_for("numerics.method = a+b at cycle");
    terminal.press(".");
    terminal.wait_for(" │ method: a+b ");
    terminal.wait_for("q quit");
    terminal.wait_until("later cycle", |screen| cycle(screen) > paused_at);

    for (columns, rows) in [(120, 40), (60, 15), (80, 24)] {
        terminal.resize(columns, rows);
        terminal.wait_until("screen of the new size", |screen| {
            let lines: Vec<String> = screen.rows(0, columns).collect();
            let last = usize::from(rows) - 1;
            // Where there is room, the title ends the line.
            let title = if columns < 100 { "" } else { " Dual oscil" };
            lines[0].starts_with(" ‖ paused")
                && lines[0].contains(title)
                && lines[last].contains("q quit")
        });
        terminal.wait_for_silence();
        terminal.look(|screen| {
            let footers = screen.contents().matches("q quit").count();
            assert_eq!(footers, 1, "{}", screen.contents());
        });
    }

    terminal.press("?");
    terminal.wait_for("run or pause the simulation");
    terminal.press("\x1b");
    terminal.wait_until("closed help", |screen| {
        !screen.contents().contains("run or pause the simulation")
    });
    terminal.press("q");
    assert_clean_end(&mut terminal);
}

#[test]
fn a_tiny_terminal_says_what_it_needs_and_grows() {
    let mut terminal = Terminal::start(program(&[]), 30, 6);
    terminal.wait_for("needs 40 by 10");
    terminal.resize(80, 24);
    terminal.wait_until("running explorer", is_running);
    terminal.resize(1, 1);
    terminal.resize(80, 24);
    terminal.wait_until("running explorer", is_running);
    terminal.press("q");
    assert_clean_end(&mut terminal);
}

#[test]
fn leaving_with_the_screen_kept_leaves_it_on_the_main_screen() {
    let mut terminal = running(&[]);
    terminal.press(" ");
    terminal.wait_for("paused");
    terminal.wait_for_silence();
    let before = terminal.text();
    terminal.press("Q");
    let status = terminal.wait_for_end();
    assert_eq!(status.exit_code(), 0);
    assert_given_back(&terminal);
    let after = terminal.text();
    let status = |text: &str| text.lines().next().map(|line| line.trim_end().to_owned());
    assert_eq!(status(&after), status(&before), "{after}");
    for part in ["3D profile", "fretting loop", "stresses", "q quit"] {
        has(&after, part);
    }
}

/// Whatever is typed ahead of a signal does nothing to it, and a paused explorer listens as well.
#[test]
fn ctrl_c_and_signals_quit_from_anywhere() {
    for (keys, then) in [
        ("\x03", None),
        ("?\x03", None),
        ("p\x03", None),
        ("z\x03", None),
        ("q\x1c\x03", Some("QUIT")),
        (" ", Some("TERM")),
    ] {
        let mut terminal = running(&[]);
        terminal.press(keys);
        if keys == " " {
            terminal.wait_for("paused");
        }
        if let Some(signal) = then {
            terminal.signal(signal);
        }
        assert_clean_end(&mut terminal);
    }
}

// The faults are there in debug builds only.
#[cfg(debug_assertions)]
#[test]
fn a_panic_gives_the_terminal_back_and_says_so_in_one_line() {
    for place in ["worker", "screen"] {
        let mut command = program(&["--mouse"]);
        command.env("MDR_TUI_FAULT", place);
        let mut terminal = Terminal::start(command, 200, 24);
        let status = terminal.wait_for_end();
        assert_eq!((status.exit_code(), status.signal()), (1, None));
        assert_given_back(&terminal);
        let text = terminal.text();
        let lines: Vec<&str> = text.lines().filter(|line| !line.is_empty()).collect();
        assert_eq!(lines.len(), 1, "{text}");
        assert!(lines[0].starts_with("mdr-tui: bug in mdr-tui: "));
        has(lines[0], &format!("a fault in the {place}"));
    }
}

#[test]
fn what_is_no_terminal_is_refused_with_a_way_out() {
    // Neither standard stream is a terminal.
    let said = end(TestDir::new().start("", &[]));
    said.fails(2, "mdr-tui run");
    assert_eq!(said.out, "");

    // One of them is not.
    for redirection in ["</dev/null", "| cat", ">/dev/null"] {
        let bin = env!("CARGO_BIN_EXE_mdr-tui");
        let mut command = CommandBuilder::new("sh");
        command.args(["-c", &format!("('{bin}'; echo code $? >&2) {redirection}")]);
        let mut terminal = Terminal::start(command, 120, 24);
        terminal.wait_for_end();
        let text = terminal.text();
        has(&text, "mdr-tui run");
        has(&text, "code 2");
        assert_eq!(text.trim_end().lines().count(), 2, "{text}");
        assert_given_back(&terminal);
    }

    let mut command = program(&[]);
    command.env("TERM", "dumb");
    let mut terminal = Terminal::start(command, 120, 24);
    assert_eq!(terminal.wait_for_end().exit_code(), 2);
    let text = terminal.text();
    has(&text, "TERM=dumb");
    has(&text, "mdr-tui run");
    assert!(!terminal.raw().contains(&0x1b), "{text}");
}

/// The parameters of every SGR sequence, `ESC [ ... m`.
fn styles(raw: &[u8]) -> Vec<u16> {
    let mut found = Vec::new();
    for piece in String::from_utf8_lossy(raw).split("\x1b[").skip(1) {
        let end = piece.find(|c: char| !c.is_ascii_digit() && !";:".contains(c));
        if let Some((parameters, "m")) = end.map(|end| (&piece[..end], &piece[end..=end])) {
            let numbers = parameters.split([';', ':']);
            found.extend(numbers.filter_map(|number| number.parse::<u16>().ok()));
        }
    }
    found
}

fn sets_colour(style: u16) -> bool {
    matches!(style, 30..=38 | 40..=48 | 58 | 90..=97 | 100..=107)
}

fn cells(screen: &Screen) -> impl Iterator<Item = &Cell> {
    let (rows, columns) = screen.size();
    let places = (0..rows.get()).flat_map(move |row| (0..columns.get()).map(move |at| (row, at)));
    places.filter_map(|(row, column)| screen.cell(row, column))
}

/// Whether any cell of the screen has a colour.
fn is_coloured(screen: &Screen) -> bool {
    let plain = (Color::Default, Color::Default);
    cells(screen).any(|cell| (cell.fgcolor(), cell.bgcolor()) != plain)
}

/// Asked once, behind which the first frame does not wait; a chosen theme stays.
#[test]
fn the_colours_follow_the_background_that_the_terminal_tells() {
    const QUESTION: &[u8] = b"\x1b]11;?";
    let [white, solarized] = ["ffff/ffff/ffff", "0000/2b2b/3636"];
    // The orange of the worn profile, on dark and on light.
    let [on_dark, on_light] = [178, 130].map(Color::Idx);
    for (arguments, console, background, asks, expected) in [
        (&[][..], false, white, true, on_light),
        (&[], false, solarized, true, on_dark),
        (&["--theme", "dark"], false, white, false, on_dark),
        (&["--theme", "light"], false, solarized, false, on_light),
        (&["--color", "never"], false, white, false, Color::Default),
        (&[], true, white, false, Color::Idx(3)),
    ] {
        let mut command = program(arguments);
        if console {
            command.env("TERM", "linux");
        }
        let mut terminal = Terminal::start(command, 80, 24);
        terminal.wait_until("running explorer", is_running);
        let what = format!("{arguments:?} {background}");
        let count = |terminal: &Terminal| {
            let raw = terminal.raw();
            let windows = raw.windows(QUESTION.len());
            windows.filter(|&bytes| bytes == QUESTION).count()
        };
        assert_eq!(count(&terminal), usize::from(asks), "{what}");
        terminal.press(&format!("\x1b]11;rgb:{background}\x1b\\"));
        // The key is answered behind the colours.
        terminal.press("?");
        terminal.wait_for("keys (");
        terminal.press("\x1b");
        terminal.wait_until("the colours", |screen| {
            let profiles = [on_dark, on_light, Color::Idx(3)];
            let found = cells(screen).find(|cell| profiles.contains(&cell.fgcolor()));
            screen.contents().contains("3D profile")
                && found.map_or(Color::Default, |cell| cell.fgcolor()) == expected
        });
        assert_eq!(count(&terminal), usize::from(asks), "{what}");
        terminal.quit();
    }
}

#[test]
fn no_color_means_no_colour_unless_asked_for() {
    for (no_color, arguments, coloured) in [
        (None, vec![], true),
        (Some("1"), vec![], false),
        (Some("0"), vec![], false),
        (Some(""), vec![], true),
        (None, vec!["--color", "never"], false),
        (Some("1"), vec!["--color", "always"], true),
    ] {
        let mut command = program(&arguments);
        if let Some(value) = no_color {
            command.env("NO_COLOR", value);
        }
        let mut terminal = Terminal::start(command, 80, 24);
        terminal.wait_until("running explorer", is_running);
        let what = format!("NO_COLOR {no_color:?}, {arguments:?}");
        terminal.wait_until(&what, |screen| is_coloured(screen) == coloured);
        terminal.press("?");
        terminal.wait_for("keys (");
        // The help answers its own keys alone.
        terminal.press("\x1b");
        terminal.wait_until("no help", |screen| !screen.contents().contains("keys ("));
        terminal.quit();
        let styles = styles(&terminal.raw());
        assert_eq!(styles.iter().any(|&s| sets_colour(s)), coloured, "{what}");
    }
}

#[test]
fn a_locale_without_utf8_gets_plain_ascii() {
    let mut command = program(&[]);
    command.env("LC_ALL", "C");
    let mut terminal = Terminal::start(command, 80, 24);
    terminal.wait_until("running explorer", is_running);
    for (keys, sign) in [
        (" ", "paused"),
        ("?", "keys ("),
        ("\x1bp", "presets and"),
        ("\x1bz", "[um]"),
        ("\t\tL", "fretting loop"),
        ("zm", "numerics.method"),
        ("w", "wear.law"),
    ] {
        for key in keys.split_inclusive(|_| true) {
            terminal.press(key);
            terminal.wait_for_silence();
        }
        terminal.wait_for(sign);
    }
    terminal.press("q");
    assert_clean_end(&mut terminal);
    let raw = terminal.raw();
    let first = raw.iter().position(|byte| !byte.is_ascii());
    let near = first.map(|at| String::from_utf8_lossy(&raw[at.saturating_sub(40)..=at]));
    assert_eq!(near, None, "{}", terminal.text());
}

/// A shell with job control, in which the explorer is started by typing.
fn shell(directory: &Path) -> Terminal {
    let mut command = program(&[]);
    *command.get_argv_mut() = ["bash", "--norc", "--noprofile", "-i"]
        .map(Into::into)
        .to_vec();
    command.cwd(directory);
    command.env("PS1", "ready> ");
    let terminal = Terminal::start(command, 80, 24);
    terminal.wait_for("ready>");
    terminal
}

#[test]
fn ctrl_z_gives_the_terminal_to_the_shell_and_fg_takes_it_back() {
    let base = tempfile::tempdir().expect("a directory");
    let bin = env!("CARGO_BIN_EXE_mdr-tui");
    std::fs::write(base.path().join("wrapped"), format!("'{bin}' --mouse\n")).expect("a script");
    for (start, mouse) in [
        (bin, MouseProtocolMode::None),
        ("sh wrapped", MouseProtocolMode::PressRelease),
    ] {
        let mut terminal = shell(base.path());
        terminal.press(&format!("{start}\n"));
        terminal.wait_until("running explorer", is_running);
        for _ in 0..2 {
            assert_eq!(terminal.look(Screen::mouse_protocol_mode), mouse);
            terminal.press("\x1a");
            terminal.wait_until("shell", |screen| {
                let text = screen.contents();
                !screen.alternate_screen() && !screen.hide_cursor() && text.contains("Stopped")
            });
            let mode = terminal.look(Screen::mouse_protocol_mode);
            assert_eq!(mode, MouseProtocolMode::None);
            // The shell echoes and answers.
            terminal.press("echo $((6*7))\n");
            terminal.wait_for("\n42");
            terminal.press("clear; fg\n");
            terminal.wait_until("explorer again", |screen| {
                screen.alternate_screen() && is_running(screen)
            });
        }
        let seen = terminal.look(cycle);
        terminal.wait_until("later cycle", |screen| cycle(screen) > seen);
        terminal.press("q");
        terminal.wait_for("resume with");
        terminal.press("exit\n");
        terminal.wait_for_end();
    }
}

/// It waits, stopped, for the terminal, whether it begins there or gets there by `bg`, and ends when it is asked to.
#[test]
fn a_job_in_the_background_hears_that_it_shall_end() {
    let base = tempfile::tempdir().expect("a directory");
    let bin = env!("CARGO_BIN_EXE_mdr-tui");
    let end = "clear; kill %1; while jobs | grep -q .; do sleep 0.1; done; echo ended $((6*7))\n";
    let mut terminal = shell(base.path());
    terminal.press(&format!("set -b; '{bin}' &\n"));
    terminal.wait_for("Stopped");
    terminal.press(end);
    terminal.wait_for("ended 42");
    terminal.press(&format!("clear; '{bin}' &\n"));
    terminal.wait_for("Stopped");
    terminal.press("clear; fg\n");
    terminal.wait_until("running explorer", is_running);
    terminal.press("\x1a");
    terminal.wait_for("Stopped");
    terminal.press("clear\n");
    let is_told = |screen: &Screen| screen.contents().contains("Stopped");
    terminal.wait_until("empty screen", |screen| !is_told(screen));
    terminal.press("bg\n");
    terminal.wait_until("stop", is_told);
    terminal.press(end);
    terminal.wait_for("ended 42");
    has(&terminal.text(), "resume with");
    terminal.press("clear; echo $((7*7))\n");
    terminal.wait_for("49");
    terminal.press("exit\n");
    terminal.wait_for_end();
}

/// A program that is started by a line of bash in a terminal like this.
fn by_bash(line: Line, script: &str, columns: u16) -> Terminal {
    let mut command = program(&[]);
    let script = script.replace("BIN", &format!("'{}'", env!("CARGO_BIN_EXE_mdr-tui")));
    *command.get_argv_mut() = ["bash", "-c", &script].map(Into::into).to_vec();
    Terminal::start_on(line, command, columns, 24)
}

#[test]
fn what_is_typed_before_the_start_is_a_key() {
    let mut terminal = by_bash(Line::default(), "sleep 0.4; exec BIN", 80);
    terminal.press("?");
    terminal.wait_for("keys (");
    terminal.press("\x03");
    assert_eq!(terminal.wait_for_end().exit_code(), 0);
    assert_given_back(&terminal);
}

#[test]
fn answers_under_way_at_the_end_do_not_reach_the_shell() {
    let line = Line {
        round_trip: Duration::from_millis(400),
        ..Line::default()
    };
    let then = "IFS= read -rs -t 1 -n 99 rest; printf 'rest:%q:' \"$rest\"";
    let mut terminal = by_bash(line, &format!("BIN; {then}"), 80);
    terminal.wait_until("running explorer", is_running);
    terminal.press("q");
    terminal.wait_for("rest:'':");
    terminal.wait_for_end();
}

#[test]
fn a_bar_of_progress_fits_any_width() {
    for columns in [0, 5, 80] {
        let run = "run li2019-fig3 --cycles 60 --set numerics.points=20 --out";
        let dir = TestDir::new();
        let out = dir.path("x");
        let script = format!("stty cols {columns}; exec BIN {run} {}", out.display());
        let mut terminal = by_bash(Line::default(), &script, 80);
        assert_eq!(terminal.wait_for_end().exit_code(), 0, "{columns} columns");
        assert!(out.join("state.csv").exists());
        let rows = terminal.look(|screen| screen.rows(0, 80).collect::<Vec<_>>());
        let left = rows.iter().filter(|row| row.contains("gone"));
        assert_eq!(left.count(), 0, "{rows:?}");
    }
}

#[test]
fn terminals_of_any_kind_are_drawn_on() {
    let kinds = [
        "xterm",
        "vt100",
        "linux",
        "ansi",
        "screen.xterm-256color",
        "tmux-256color",
        "no-such-kind",
        "",
    ];
    for pair in kinds.chunks(2) {
        let started = pair.iter().map(|kind| {
            let mut command = program(&[]);
            command.env("TERM", kind);
            Terminal::start(command, 80, 24)
        });
        for mut terminal in started.collect::<Vec<_>>() {
            terminal.wait_until("running explorer", is_running);
            terminal.press("q");
            assert_clean_end(&mut terminal);
        }
    }
}

/// Some that no terminal has, each with keys, and with an overlay open or not.
#[test]
fn sizes_of_all_kinds_with_keys_break_nothing() {
    let mut terminal = by_bash(Line::default(), "stty cols 0 rows 0; exec BIN", 80);
    // Keys that come earlier are echoed, and found at the end.
    terminal.wait_until("raw mode", |_| !terminal.has_its_modes_back());
    terminal.wait_for_silence_of(Duration::from_millis(300));
    let odd = [(1, 1), (500, 200), (65535, 1), (1, 65535), (2, 3)];
    let mut random = Random::new(3);
    let any = (0..35).map(|_| (1 + random.below(250) as u16, 1 + random.below(80) as u16));
    let keys = [
        "?", "\x1b", "p", "\x1b", "e", "\x1b", ":", "\x1b", "z", "z", ".", " ",
    ];
    for (i, (columns, rows)) in odd.into_iter().chain(any.collect::<Vec<_>>()).enumerate() {
        terminal.resize(columns, rows);
        terminal.press(keys[i % keys.len()]);
        thread::sleep(Duration::from_millis(15));
    }
    terminal.press("\x1b");
    thread::sleep(Duration::from_millis(200));
    terminal.press("\x1b");
    terminal.resize(80, 24);
    terminal.wait_until("an explorer", |screen| {
        screen.contents().contains("3D profile") && cycle(screen).is_some()
    });
    terminal.press("\x03");
    assert_clean_end(&mut terminal);
}

/// Stopped in the middle of a frame, with raw mode on: the shell sets its own modes, and the explorer its own again.
#[test]
fn after_a_stop_that_nobody_hears_keys_are_read_again() {
    let base = tempfile::tempdir().expect("a directory");
    let mut terminal = shell(base.path());
    let bin = env!("CARGO_BIN_EXE_mdr-tui");
    terminal.press(&format!("'{bin}' & (sleep 3; kill -STOP $!) & fg %1\n"));
    terminal.wait_until("running explorer", is_running);
    terminal.wait_for("Stopped");
    terminal.press("fg %1\n");
    terminal.wait_until("explorer again", |screen| {
        is_running(screen) && !screen.contents().contains("Stopped")
    });
    terminal.press("?");
    terminal.wait_for("keys (");
    terminal.press("\x1b");
    terminal.wait_until("closed help", |screen| {
        !screen.contents().contains("keys (")
    });
    terminal.press("q");
    terminal.wait_for("resume with");
    terminal.press("exit\n");
    terminal.wait_for_end();
}

#[test]
fn ctrl_l_draws_the_whole_screen_anew() {
    let mut terminal = running(&[]);
    terminal.press(" ");
    terminal.wait_for("paused");
    for keys in ["", ":"] {
        terminal.press(keys);
        terminal.wait_for_silence();
        let rows = |screen: &Screen| -> Vec<String> {
            let rows = screen.rows(0, 80);
            rows.map(|row| row.trim_end().to_owned()).collect()
        };
        let (before, shown) = (terminal.raw().len(), terminal.look(rows));
        terminal.press("\x0c");
        terminal.wait_for_silence();
        let anew = terminal.raw()[before..].to_vec();
        has(&String::from_utf8_lossy(&anew), "\x1b[2J");
        assert!(anew.len() > 1000, "{} bytes", anew.len());
        assert_eq!(terminal.look(rows), shown);
    }
    terminal.press("\x03");
    assert_clean_end(&mut terminal);
}

/// What a terminal sends by itself, late and in parts, or from a mode that another program has left on, is not a key.
#[test]
fn what_the_terminal_sends_in_parts_is_no_key() {
    let mut terminal = running(&[]);
    terminal.press(" ");
    terminal.wait_for("paused");
    terminal.press("\x1b[M q!");
    terminal.press(":");
    terminal.wait_for("commands (");
    terminal.press("\x1b]11;rgb:ffff/ff");
    thread::sleep(Duration::from_millis(600));
    terminal.press("ff/ffff\x1b\\");
    terminal.press("ghost");
    terminal.wait_for(":ghost");
    // Escape and a key at once, as tmux sends what comes within its escape time.
    terminal.press("\x1b?");
    terminal.wait_for("keys (");
    terminal.press("\x03");
    assert_clean_end(&mut terminal);
}
