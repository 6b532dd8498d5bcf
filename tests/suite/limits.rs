//! What is read has a limit, what is drawn too, and what does not fit leaves nothing half.

use std::fs;
use std::io::{Read, Write};
use std::process::Command;
use std::time::Duration;

use portable_pty::{CommandBuilder, PtySize, native_pty_system};

use crate::pty::{Terminal, program};
use crate::test_dir::{TestDir, end, has, names};

fn fifo(dir: &TestDir, name: &str) {
    let made = Command::new("mkfifo").arg(dir.path(name)).status();
    assert!(made.expect("mkfifo").success());
}

#[test]
fn in_a_folder_nothing_but_files_is_read() {
    let dir = TestDir::new();
    fs::create_dir(dir.path("x")).expect("a directory");
    fifo(&dir, "x/state.csv");
    for line in ["figure x -o x.svg", "sweep --merge x"] {
        end(dir.start(line, &[])).ends(2, "x");
    }
    // The preferences are nobody's argument.
    fs::create_dir(dir.path("mdr-tui")).expect("a directory");
    fifo(&dir, "mdr-tui/config.toml");
    let said = dir.line("--print 80x24");
    said.ends(0, "config.toml: is not a file");
    let said = dir.line_with(
        "--print 80x24 --keys -,",
        &[("XDG_CONFIG_HOME", "/dev/null")],
    );
    said.ends(0, "goes on without it");
}

#[test]
fn a_fit_of_data_without_end_is_refused() {
    let dir = TestDir::new();
    dir.write(
        "h.csv",
        b"cycle,wear_volume_m3\n0,0\n1,1e-18\n1e300,2e-18\n",
    );
    let said = dir.line("fit li2019-fig3 --history h.csv --free wear.coefficient");
    said.ends(2, "a run has at most");
}

#[test]
fn a_table_with_semicolons_and_decimal_commas_is_read_or_named() {
    let dir = TestDir::new();
    let table = "cycle;wear_volume_m3\n0;0\n1;1e-18\n2;2e-18\n3;3e-18\n";
    dir.write("h.csv", table.as_bytes());
    let line = "fit li2019-fig3 --history h.csv --free wear.coefficient --set numerics.points=10";
    dir.line(line).ends(0, "");
    dir.write("h.csv", table.replace("2;2e-18", "2,5;2e-18").as_bytes());
    dir.line(line).ends(2, "2,5");
}

#[test]
fn a_state_or_a_figure_that_does_not_fit_leaves_nothing_and_a_script_fails() {
    let dir = TestDir::new();
    let explorer = "hertz --set numerics.points=40 --print 80x24 --keys";
    // Blocks of 512 bytes: what comes first still fits.
    for (keys, blocks) in [("....s", 3), ("....:figure x.svg<Enter>", 15)] {
        let said = dir.shell(&format!(
            "ulimit -f {blocks}; exec $BIN {explorer} '{keys}'"
        ));
        said.ends(1, "cannot write");
        assert!(names(&dir.path("")).is_empty(), "{keys}");
    }
    dir.done(&format!("{explorer} ....s"));
    assert_eq!(names(&dir.path("")).len(), 1);
}

#[test]
fn a_huge_terminal_is_drawn_in_part_and_without_memory_it_is_given_back() {
    let bin = env!("CARGO_BIN_EXE_mdr-tui");
    for (limit, keys) in [("unlimited", "q"), ("400000", "")] {
        let size = PtySize {
            cols: 30_000,
            rows: 30_000,
            ..PtySize::default()
        };
        let pair = native_pty_system()
            .openpty(size)
            .expect("a pseudo-terminal");
        let modes = || format!("{:?}", pair.master.get_termios());
        let before = modes();
        let mut command = CommandBuilder::new("sh");
        // In KiB: a part of what so many characters would take.
        command.args(["-c", &format!("ulimit -v {limit}; exec '{bin}' hertz")]);
        command.env("TERM", "xterm-256color");
        let state = tempfile::tempdir().expect("a directory");
        command.env("XDG_STATE_HOME", state.path());
        let mut child = pair.slave.spawn_command(command).expect("it starts");
        let mut reader = pair.master.try_clone_reader().expect("a reader");
        let (tell, told) = std::sync::mpsc::channel();
        std::thread::spawn(move || {
            let mut bytes = [0; 1 << 16];
            while let Ok(count @ 1..) = reader.read(&mut bytes) {
                let _ = tell.send(bytes[..count].to_vec());
            }
        });
        let mut seen = Vec::new();
        let wait = Duration::from_secs(60);
        if !keys.is_empty() {
            while !seen.windows(6).any(|bytes| bytes == b"cycles") {
                seen.extend(told.recv_timeout(wait).expect("something is drawn"));
            }
            let mut writer = pair.master.take_writer().expect("a writer");
            writer.write_all(keys.as_bytes()).expect("a key");
        }
        let status = child.wait().expect("an end");
        assert_eq!(status.success(), !keys.is_empty(), "{status:?}");
        assert_eq!(modes(), before, "{limit}");
        if keys.is_empty() {
            std::thread::sleep(Duration::from_millis(200));
            seen.extend(told.try_iter().flatten());
            let text = String::from_utf8_lossy(&seen).into_owned();
            has(&text, "mdr-tui: ");
            has(&text, "memory");
        }
    }
}

#[test]
fn a_signal_ends_the_map_and_the_explorer_that_it_has_opened() {
    let dir = TestDir::new();
    dir.write(
        "study.toml",
        b"base = \"hertz\"\n[set]\n\"run.cycles\" = 1\n\"numerics.points\" = 10\n\
          [[axis]]\nkey = \"motion.normal.mean\"\nvalues = [1e-6, 2e-6]\n",
    );
    dir.done("sweep study.toml --quiet");
    let table = dir.path("study.csv").display().to_string();
    for sign in ["TERM", "HUP", "INT"] {
        let state = tempfile::tempdir().expect("a directory");
        let mut command = program(&["sweep", "--view", &table]);
        command.env("XDG_STATE_HOME", state.path());
        let mut terminal = Terminal::start(command, 100, 30);
        terminal.wait_for("mean depth d");
        terminal.press("\r");
        terminal.wait_until("the explorer", |screen| {
            crate::pty::cycle(screen).is_some_and(|cycle| cycle > 0.1)
        });
        assert_eq!(terminal.ends_soon(sign), 0);
        assert!(terminal.has_its_modes_back(), "{sign}");
        let mut left = names(&state.path().join("mdr-tui"));
        left.retain(|name| name != "tour-seen");
        assert_eq!(left.len(), 1, "{sign}: {left:?}");
    }
}
