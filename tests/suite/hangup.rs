//! The explorer's session outlives its terminal: hangups, defects, full disks, a cut connection.

use std::fs;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use mdr_tui::scenario::session::Session;
use tempfile::TempDir;
use vt100::{MouseProtocolEncoding, MouseProtocolMode, Screen};

use crate::pty::{Terminal, at_home, cycle, home, kept, patiently, program, read};
use crate::terminal::assert_given_back;
use crate::test_dir::{Table, has};

fn is_under_way(screen: &Screen) -> bool {
    cycle(screen).is_some_and(|cycle| cycle > 0.5)
}

/// The explorer in a terminal so many columns wide, as soon as it has stepped for a while.
fn under_way(home: &TempDir, arguments: &[&str], columns: u16) -> Terminal {
    let terminal = Terminal::start(at_home(home, arguments), columns, 24);
    terminal.wait_until("explorer under way", is_under_way);
    terminal
}

/// A kept session is where an undisturbed one would be.
fn assert_exact(session: &Session) {
    let mut straight = Session::start(session.loaded().clone()).expect("a contact");
    let cycle = session.simulation().cycle();
    while straight.simulation().cycle() < cycle {
        straight.step_until(f64::INFINITY).expect("a step");
    }
    assert_eq!(straight.simulation().state(), session.simulation().state());
}

#[test]
fn a_hangup_keeps_the_session() {
    let bin = env!("CARGO_BIN_EXE_mdr-tui");
    for start in [
        format!("exec '{bin}'"),
        format!("trap '' HUP; exec '{bin}'"),
        // A session without this terminal gets no signal.
        format!("exec setsid -w '{bin}'"),
    ] {
        let home = home();
        let mut command = at_home(&home, &[]);
        *command.get_argv_mut() = ["sh", "-c", &start].map(Into::into).to_vec();
        let mut terminal = Terminal::start(command, 80, 24);
        terminal.wait_until("explorer under way", is_under_way);
        let seen = terminal.look(cycle).expect("a cycle");
        terminal.go_away();
        let hung_up = Instant::now();
        let status = terminal.wait_for_end();
        // What waits for it in the terminal's session is ended by the hangup.
        let ended = (status.exit_code(), status.signal());
        let is_well = start.contains("setsid") || ended == (0, None);
        assert!(is_well, "{start}: {ended:?}");
        eprintln!("{start}: ended {:.0?} after the hangup", hung_up.elapsed());
        let session = read(&kept(&home).expect("a checkpoint"));
        assert!(session.simulation().cycle() >= seen - 0.005, "{start}");
        assert_exact(&session);
    }
}

/// The terminal has its modes and its mouse back, which has been asked for once.
#[test]
fn every_way_out_gives_the_terminal_back_keeps_the_session_and_says_where() {
    for way in ["q", "Q", "\x03"].iter().chain(&crate::signals::ENDING) {
        let home = home();
        let mut terminal = under_way(&home, &["--mouse"], 200);
        terminal.look(|screen| {
            // No movements: each would be bytes on the wire.
            let mode = screen.mouse_protocol_mode();
            assert_eq!(mode, MouseProtocolMode::PressRelease);
            let encoding = screen.mouse_protocol_encoding();
            assert_eq!(encoding, MouseProtocolEncoding::Sgr);
        });
        terminal.ask(way);
        let status = terminal.wait_for_end();
        assert_eq!((status.exit_code(), status.signal()), (0, None), "{way:?}");
        assert_given_back(&terminal);
        let path = kept(&home).expect("a checkpoint");
        let session = read(&path);
        // A screen that is left behind pushes the line off the top.
        let text = String::from_utf8_lossy(&terminal.raw()).into_owned();
        let [on, off] = ["\x1b[?1000h\x1b[?1006h", "\x1b[?1006l\x1b[?1000l"];
        let count = |sequence: &str| text.matches(sequence).count();
        assert_eq!((count(on), count(off)), (1, 1), "{way:?}");
        assert!(text.find(on) < text.find(off), "{way:?}");
        let cycle = session.simulation().cycle();
        let line = format!(
            "mdr-tui: saved at cycle {cycle}; resume with: mdr-tui --resume {}",
            path.display()
        );
        assert!(text.contains(&line), "{way:?}: {text}");
        assert_exact(&session);
    }
}

#[test]
fn a_session_without_a_step_leaves_nothing() {
    let home = home();
    let mut terminal = Terminal::start(at_home(&home, &["--fps", "1"]), 80, 24);
    terminal.press(" q");
    terminal.wait_for_end();
    if !terminal.text().contains("saved at cycle") {
        assert_eq!(kept(&home), None);
    }
}

#[test]
fn resuming_shows_the_session_paused_where_it_was_and_goes_on() {
    let home = home();
    let mut terminal = under_way(&home, &[], 80);
    terminal.press(" ");
    terminal.wait_for("paused");
    terminal.press("m");
    terminal.wait_for("numerics.method = a at cycle");
    terminal.press(",");
    terminal.wait_for("q quit");
    terminal.quit();
    let path = kept(&home).expect("a checkpoint");
    let was = read(&path).simulation().cycle();
    let again = path.to_str().expect("a path").to_owned();

    let mut terminal = Terminal::start(at_home(&home, &["--resume", &again]), 80, 24);
    terminal.wait_for("paused");
    assert_eq!(terminal.look(cycle), Some(was));
    has(&terminal.text(), " │ method: a  ");
    // Nothing has happened, so nothing more is kept.
    terminal.resize(100, 30);
    terminal.wait_for("q quit");
    terminal.quit();
    assert_eq!(terminal.text().trim(), "");
    assert!(terminal.has_its_modes_back(), "still in raw mode");
    assert_eq!(kept(&home), Some(path.clone()));

    // A resumed session has a separate checkpoint, and leaves the first unchanged.
    let before = fs::read(&path).expect("the checkpoint");
    let mut terminal = Terminal::start(at_home(&home, &["--resume", &again]), 80, 24);
    terminal.wait_for("paused");
    terminal.press(" ");
    terminal.wait_until("later cycle", |screen| cycle(screen) > Some(was + 0.2));
    terminal.quit();
    assert!(before == fs::read(&path).expect("the checkpoint"));
    let files = fs::read_dir(home.path().join("mdr-tui")).expect("a directory");
    let is_checkpoint = |name: &std::ffi::OsStr| name.to_string_lossy().ends_with(".checkpoint");
    let names = files.map(|file| file.expect("a file").file_name());
    assert_eq!(names.filter(|name| is_checkpoint(name)).count(), 2);
}

#[test]
fn where_nothing_can_be_kept_the_run_goes_on_and_says_so() {
    let base = home();
    let file = base.path().join("file");
    fs::write(&file, "in the way").expect("a file");
    let bin = env!("CARGO_BIN_EXE_mdr-tui");
    // A path that is a file; a system that takes no files; a limit of no bytes, like a full disk.
    for (state_home, limit) in [
        (file.as_path(), ""),
        (Path::new("/proc"), ""),
        (base.path(), "trap '' XFSZ; ulimit -f 0; "),
    ] {
        let mut command = program(&[]);
        let start = format!("{limit}exec '{bin}' --checkpoint-every 0.3");
        *command.get_argv_mut() = ["sh", "-c", &start].map(Into::into).to_vec();
        command.env("XDG_STATE_HOME", state_home);
        let mut terminal = Terminal::start(command, 200, 24);
        terminal.wait_for("the run continues without a checkpoint");
        let seen = terminal.look(cycle);
        terminal.wait_until("later cycle", |screen| cycle(screen) > seen);
        terminal.quit();
        let text = terminal.text();
        has(&text, "mdr-tui: nothing was saved: ");
        assert_eq!(kept(&base), None);
    }
}

// The faults are there in debug builds only.
#[cfg(debug_assertions)]
#[test]
fn a_defect_keeps_the_session_of_a_moment_ago() {
    let home = home();
    let mut command = at_home(&home, &[]);
    command.env("MDR_TUI_FAULT", "sixth cycle");
    let mut terminal = Terminal::start(command, 200, 24);
    terminal.wait_for("running");
    terminal.press("++++");
    let status = terminal.wait_for_end();
    assert_eq!(status.exit_code(), 1);
    let text = terminal.text();
    has(&text, "a fault in the sixth cycle");
    has(&text, "; saved at cycle ");
    assert_exact(&read(&kept(&home).expect("a checkpoint")));
}

/// A server on the loopback interface with its own keys.
struct Server {
    child: Child,
    directory: TempDir,
    port: u16,
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Server {
    /// None, and a word why, where there is no server to start.
    fn start() -> Option<Self> {
        let sshd = Path::new("/usr/sbin/sshd");
        if !sshd.exists() {
            eprintln!("skipped: no {}; apt install openssh-server", sshd.display());
            return None;
        }
        // It refuses to start without; only root can and need make it.
        let _ = fs::create_dir_all("/run/sshd");
        let directory = home();
        let path = |name: &str| directory.path().join(name).display().to_string();
        for key in ["host", "client"] {
            let made = Command::new("ssh-keygen")
                .args(["-q", "-t", "ed25519", "-N", "", "-f", &path(key)])
                .status();
            assert!(made.expect("ssh-keygen").success());
        }
        let free = TcpListener::bind("127.0.0.1:0").expect("a port");
        let port = free.local_addr().expect("an address").port();
        drop(free);
        let config = format!(
            "ListenAddress 127.0.0.1:{port}\nHostKey {}\nAuthorizedKeysFile {}\nPidFile none\n\
             StrictModes no\nUsePAM no\nPasswordAuthentication no\nPermitRootLogin yes\n",
            path("host"),
            path("client.pub"),
        );
        fs::write(path("config"), config).expect("a file");
        let child = Command::new(sshd)
            .args(["-D", "-e", "-f", &path("config")])
            .stderr(Stdio::null())
            .spawn()
            .expect("sshd starts");
        Some(Self {
            child,
            directory,
            port,
        })
    }

    /// A client in a terminal that has the server run `line`.
    fn run(&self, line: &str) -> Terminal {
        let key = self.directory.path().join("client").display().to_string();
        let port = self.port.to_string();
        let mut command = program(&[]);
        let options = "-o StrictHostKeyChecking=no -o UserKnownHostsFile=/dev/null -o LogLevel=ERROR \
                       -o ConnectionAttempts=20 127.0.0.1";
        let mut arguments = vec!["ssh", "-tt", "-F", "none", "-i", &key, "-p", &port];
        arguments.extend(options.split_whitespace().chain([line]));
        *command.get_argv_mut() = arguments.into_iter().map(Into::into).collect();
        Terminal::start(command, 80, 24)
    }
}

#[test]
fn a_connection_that_is_cut_keeps_the_session() {
    let Some(server) = Server::start() else {
        return;
    };
    let home = home();
    let line = format!(
        "XDG_STATE_HOME='{}' LC_ALL=C.UTF-8 '{}'",
        home.path().display(),
        env!("CARGO_BIN_EXE_mdr-tui")
    );
    let mut terminal = server.run(&line);
    terminal.wait_until("explorer under way", is_under_way);
    terminal.press("m");
    terminal.wait_for("numerics.method = a at cycle");
    terminal.wait_until("later cycle", |screen| cycle(screen) > Some(1.0));
    let seen = terminal.look(cycle).expect("a cycle");
    // The client dies without a word.
    terminal.signal("KILL");
    terminal.wait_for_end();
    let is_whole = |path: &PathBuf| fs::metadata(path).is_ok_and(|about| about.len() > 0);
    let path = patiently("no checkpoint", || kept(&home).filter(is_whole));
    let session = read(&path);
    assert!(session.simulation().cycle() >= seen - 0.005);
    assert_eq!(session.changes().len(), 1);

    let mut terminal = server.run(&format!("{line} --resume '{}'", path.display()));
    terminal.wait_for("paused");
    let shown = terminal.look(cycle).expect("a cycle");
    assert!((shown - session.simulation().cycle()).abs() < 0.0051);
    has(&terminal.text(), " │ method: a  ");
    terminal.press(" ");
    terminal.wait_until("later cycle", |screen| cycle(screen) > Some(shown));
    terminal.quit();
}

#[test]
fn an_explorer_that_is_killed_loses_an_interval_at_most() {
    for pause in [0.3, 0.71, 0.95] {
        let home = home();
        let mut terminal = under_way(&home, &["--checkpoint-every", "0.01"], 80);
        thread::sleep(Duration::from_secs_f64(pause));
        let seen = terminal.look(cycle).expect("a cycle");
        terminal.signal("KILL");
        terminal.wait_for_end();
        let path = kept(&home).expect("a checkpoint");
        let session = read(&path);
        // Ten cycles a second, a checkpoint a hundredth: a second's tenth is generous.
        assert!(session.simulation().cycle() > seen - 1.0, "{seen}");
        assert_exact(&session);
        // Without a screen it goes on as well.
        let out = home.path().join("out");
        let run = Command::new(env!("CARGO_BIN_EXE_mdr-tui"))
            .args(["run", "--quiet", "--cycles", "30", "--resume"])
            .arg(&path)
            .arg("--out")
            .arg(&out)
            .status();
        assert!(run.expect("the program starts").success());
        let mut straight = Session::start(session.loaded().clone()).expect("a contact");
        straight.advance_to(30.0).expect("thirty cycles");
        let table = mdr_tui::export::state::table(&straight);
        assert!(fs::read_to_string(out.join("state.csv")).expect("the state") == table);
        // The cycles before the checkpoint are in its history, too.
        let history = fs::read_to_string(out.join("history.csv")).expect("the history");
        let cycles = Table::parse(&history).column("cycle");
        let whole = (1..=30).map(f64::from);
        assert!(
            cycles
                .iter()
                .copied()
                .filter(|cycle| *cycle >= 1.0)
                .eq(whole),
            "{cycles:?}"
        );
    }
}

/// The next explorer names the session, has a separate file, and asks no more once the session is resumed.
#[test]
fn an_explorer_that_was_killed_is_told_of_until_it_goes_on() {
    let home = home();
    let told = "a session was killed; mdr-tui --resume ";
    let mut terminal = under_way(&home, &["--checkpoint-every", "0.01"], 200);
    let path = patiently("no checkpoint", || kept(&home));
    terminal.signal("KILL");
    terminal.wait_for_end();
    let left = fs::read(&path).expect("a checkpoint");
    let mut terminal = Terminal::start(at_home(&home, &["--checkpoint-every", "0.01"]), 200, 24);
    terminal.wait_for(told);
    terminal.wait_until("explorer under way", is_under_way);
    terminal.quit();
    assert!(left == fs::read(&path).expect("a checkpoint"));
    let again = path.to_str().expect("a path");
    let mut terminal = Terminal::start(at_home(&home, &["--resume", again]), 200, 24);
    terminal.wait_for("paused");
    terminal.quit();
    let mut terminal = under_way(&home, &[], 200);
    assert!(!terminal.text().contains(told));
    terminal.quit();
}

#[test]
fn without_a_shell_ctrl_z_says_so_and_nothing_stops() {
    let home = home();
    let mut terminal = under_way(&home, &[], 80);
    // On a slow line the terminal's answer is awaited before the stop; what comes in meanwhile must not be lost.
    terminal.slow_down(6000);
    for stop in ["key", "signal"].repeat(4) {
        match stop {
            "key" => terminal.press("\x1a"),
            _ => terminal.signal("TSTP"),
        }
        terminal.wait_for("there is no shell to return to");
        let seen = terminal.look(cycle);
        terminal.wait_until("later cycle", |screen| cycle(screen) > seen);
        terminal.press("x");
        terminal.wait_until("keys again", |screen| {
            !screen.contents().contains("no shell")
        });
    }
    terminal.quit();
}

#[test]
fn leaving_from_the_past_keeps_the_present() {
    let home = home();
    let mut terminal = under_way(&home, &[], 80);
    terminal.press(" ");
    terminal.wait_for("paused");
    terminal.press(",,");
    terminal.wait_until("third cycle", |screen| cycle(screen) >= Some(2.0));
    terminal.wait_for_silence();
    let present = terminal.look(cycle);
    terminal.press("[[");
    terminal.wait_until("the past", |screen| cycle(screen) < present);
    terminal.quit();
    let session = read(&kept(&home).expect("a checkpoint"));
    assert_eq!(Some(session.simulation().cycle()), present);
    assert_exact(&session);
}
