//! What is read has a limit, what is drawn too, and what does not fit leaves nothing half.

use std::io::{Read, Write};
use std::time::Duration;

use portable_pty::{CommandBuilder, PtySize, native_pty_system};

use crate::pty::{Terminal, program};
use crate::test_dir::{TestDir, has, names};

#[test]
fn a_huge_terminal_is_drawn_in_part_and_without_memory_it_is_given_back() {
    let bin = env!("CARGO_BIN_EXE_mdr-tui");
    // In KiB: less than the eight screens of a million characters that there must be memory for. With a little more, the
    // threads' timing would decide whether it is refused or an allocation fails later, which ends any program.
    for (limit, keys) in [("unlimited", "q"), ("300000", "")] {
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
        terminal.wait_for("paused");
        terminal.press(" ");
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
