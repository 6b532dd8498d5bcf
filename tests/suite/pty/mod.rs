//! The program in a pseudo-terminal whose screen can be looked at.

use std::io::{Read, Write};
use std::num::NonZeroU16;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use mdr_tui::scenario::checkpoint;
use mdr_tui::scenario::session::Session;
use portable_pty::{
    Child, CommandBuilder, ExitStatus, MasterPty, PtyPair, PtySize, SlavePty, native_pty_system,
};
use serde::de::IgnoredAny;
use tempfile::TempDir;
use vt100::{Parser, Screen};

/// Longer than anything takes on a busy machine.
pub const TIMEOUT: Duration = Duration::from_secs(60);

/// A second is what is promised; a machine that is busy with all the other tests takes longer.
pub const SOON: Duration = Duration::from_millis(2500);

/// Longer than a busy machine needs to answer a key.
const QUIET: Duration = Duration::from_secs(1);

/// What has come out of the program.
struct Output {
    parser: Parser,
    raw: Vec<u8>,
}

/// How the terminal reads what comes out of the program.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// Bytes per second; `None`: as fast as they come; 0: not at all.
    pub rate: Option<u32>,
    /// Whether it answers when it is asked whether it is ready, or where its cursor is, as most terminals do.
    pub answers: bool,
    /// How long its answers are on their way, there and back.
    pub round_trip: Duration,
}

impl Default for Line {
    fn default() -> Self {
        Self {
            rate: None,
            answers: true,
            round_trip: Duration::ZERO,
        }
    }
}

type Writer = Arc<Mutex<Box<dyn Write + Send>>>;

/// The test's own handles of the terminal.
struct Handles {
    master: Box<dyn MasterPty + Send>,
    writer: Writer,
    /// Kept open, so that the terminal's modes can be read when the program is gone. None from then on: what the program
    /// has written is complete once no process has the terminal open.
    slave: Option<Box<dyn SlavePty + Send>>,
}

/// A terminal with the program in it.
pub struct Terminal {
    child: Box<dyn Child + Send + Sync>,
    /// None once the terminal has gone away.
    handles: Option<Handles>,
    /// Reads what comes out, until the terminal is gone or reading is over.
    collector: thread::JoinHandle<()>,
    reading_is_over: Arc<AtomicBool>,
    line: Arc<Mutex<Line>>,
    output: Arc<Mutex<Output>>,
    modes_before: String,
    /// Those when the program had ended.
    modes_after: Option<String>,
}

/// Where the program keeps its checkpoints under test.
pub fn state_home() -> &'static Path {
    Path::new(concat!(env!("CARGO_TARGET_TMPDIR"), "/state"))
}

/// The program with these arguments, in a separate environment.
pub fn program(arguments: &[&str]) -> CommandBuilder {
    let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_mdr-tui"));
    command.args(arguments);
    for name in ["NO_COLOR", "MDR_TUI_FAULT", "LANG", "LC_CTYPE"] {
        command.env_remove(name);
    }
    command.env("XDG_STATE_HOME", state_home());
    // The tour of the default preset has begun before.
    let seen = state_home().join("mdr-tui/tour-seen");
    let made = seen.parent().map(std::fs::create_dir_all);
    assert!(made.is_some_and(|made| made.is_ok()));
    std::fs::write(&seen, "").expect("a file");
    // Nor does a test remember how another one has left the screen: a path that is not a file is neither read nor written.
    let _ = std::fs::create_dir(state_home().join("mdr-tui/look.toml"));
    command.env("TERM", "xterm-256color");
    command.env("LC_ALL", "C.UTF-8");
    command
}

/// The program, keeping its checkpoints in `home`.
pub fn at_home(home: &TempDir, arguments: &[&str]) -> CommandBuilder {
    let mut command = program(arguments);
    command.env("XDG_STATE_HOME", home.path());
    command
}

/// A directory for the checkpoints of one test.
pub fn home() -> TempDir {
    tempfile::tempdir().expect("a directory")
}

/// The only checkpoint in `home`; none if there is none yet.
pub fn kept(home: &TempDir) -> Option<PathBuf> {
    let entries = std::fs::read_dir(home.path().join("mdr-tui")).ok()?;
    let paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    let is_one = |path: &PathBuf| path.extension().is_some_and(|end| end == "checkpoint");
    let mut whole = paths.into_iter().filter(is_one);
    let path = whole.next();
    assert_eq!(whole.next(), None, "more than one checkpoint");
    path
}

/// Waits until there is what is looked for.
#[track_caller]
pub fn patiently<T>(failure: &str, attempt: impl Fn() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = attempt() {
            return found;
        }
        assert!(start.elapsed() < TIMEOUT, "{failure}");
        thread::sleep(Duration::from_millis(10));
    }
}

/// The session in a checkpoint.
pub fn read(path: &Path) -> Session {
    let checkpoint = checkpoint::read::<IgnoredAny>(path);
    checkpoint.expect("a checkpoint").session
}

/// The cycle in the explorer's status line.
pub fn cycle(screen: &Screen) -> Option<f64> {
    let text = screen.contents();
    let (_, after) = text.lines().next()?.split_once("cycle ")?;
    after.split_once('/')?.0.parse().ok()
}

impl Terminal {
    /// Starts `command` in a terminal of `columns` by `rows`.
    pub fn start(command: CommandBuilder, columns: u16, rows: u16) -> Self {
        Self::start_on(Line::default(), command, columns, rows)
    }

    /// The same at the other end of such a line.
    pub fn start_on(line: Line, command: CommandBuilder, columns: u16, rows: u16) -> Self {
        let PtyPair { slave, master } = native_pty_system()
            .openpty(pty_size(columns, rows))
            .expect("a pseudo-terminal");
        let modes_before = format!("{:?}", master.get_termios());
        let output = Arc::new(Mutex::new(Output {
            parser: Parser::new(nonzero(rows), nonzero(columns), 0),
            raw: Vec::new(),
        }));
        let reader = master.try_clone_reader().expect("a reader");
        let reading_is_over = Arc::new(AtomicBool::new(false));
        let writer = Arc::new(Mutex::new(master.take_writer().expect("a writer")));
        let line = Arc::new(Mutex::new(line));
        let shared = (writer.clone(), output.clone(), line.clone());
        let collector = collect(reader, shared, reading_is_over.clone());
        let child = slave.spawn_command(command).expect("the program starts");
        Self {
            child,
            handles: Some(Handles {
                master,
                writer,
                slave: Some(slave),
            }),
            collector,
            reading_is_over,
            line,
            output,
            modes_before,
            modes_after: None,
        }
    }

    /// Types `keys`.
    pub fn press(&mut self, keys: &str) {
        let writer = &self.handles.as_ref().expect("a terminal").writer;
        let mut writer = writer.lock().unwrap_or_else(PoisonError::into_inner);
        writer.write_all(keys.as_bytes()).expect("a terminal");
        writer.flush().expect("a terminal");
    }

    /// Types `q`, after which the program must end well.
    #[track_caller]
    pub fn quit(&mut self) {
        self.press("q");
        assert_eq!(self.wait_for_end().exit_code(), 0);
    }

    /// Presses a key or sends a signal by its name, such as TERM.
    pub fn ask(&mut self, way: &str) {
        match way.len() > 1 && way.starts_with(|sign: char| sign.is_ascii_uppercase()) {
            true => self.signal(way),
            false => self.press(way),
        }
    }

    /// [`ask`](Self::ask)s the program to end, which it must do soon, in its own time whether the terminal reads or not.
    /// Returns the exit code.
    #[track_caller]
    pub fn ends_soon(&mut self, way: &str) -> u32 {
        let start = Instant::now();
        self.ask(way);
        let (waited, status) = self.end_since(start);
        eprintln!("{way:?}: ended after {waited:.0?}");
        assert!(waited < SOON, "{way:?}: {waited:.1?}");
        assert_eq!(status.signal(), None, "{way:?}");
        status.exit_code()
    }

    /// From now on it reads so many bytes a second, or none at all.
    pub fn slow_down(&self, rate: u32) {
        let mut line = self.line.lock().unwrap_or_else(PoisonError::into_inner);
        line.rate = Some(rate);
    }

    /// Whether the program has ended, and how long that took from `start` on, whether the terminal reads
    /// or not.
    pub fn end_since(&mut self, start: Instant) -> (Duration, ExitStatus) {
        let status = self.patiently("it does not end", |terminal| {
            terminal.child.try_wait().expect("a program")
        });
        (start.elapsed(), status)
    }

    /// Closes the terminal from outside, as closing its window does. The program must be drawing,
    /// for its next output is the last that is read.
    pub fn go_away(&mut self) {
        self.reading_is_over.store(true, Ordering::Relaxed);
        self.patiently("its next output never comes", |terminal| {
            terminal.collector.is_finished().then_some(())
        });
        self.handles = None;
    }

    /// Gives the terminal another size.
    pub fn resize(&mut self, columns: u16, rows: u16) {
        self.with(|output| {
            let screen = output.parser.screen_mut();
            screen.set_size(nonzero(rows), nonzero(columns));
        });
        let master = &self.handles.as_ref().expect("a terminal").master;
        master.resize(pty_size(columns, rows)).expect("a terminal");
    }

    /// Sends the program a signal.
    pub fn signal(&self, name: &str) {
        let id = self.child.process_id().expect("a running program");
        let kill = format!("kill -{name} {id}");
        let status = std::process::Command::new("sh")
            .args(["-c", &kill])
            .status();
        assert!(status.expect("a shell").success());
    }

    /// Waits until the screen is as it should be.
    pub fn wait_until(&self, what: &str, seen: impl Fn(&Screen) -> bool) {
        let start = Instant::now();
        while !self.look(&seen) {
            self.assert_patience(start, &format!("no {what}"));
            thread::sleep(Duration::from_millis(10));
        }
    }

    /// Waits until the screen shows `text`.
    pub fn wait_for(&self, text: &str) {
        self.wait_until(text, |screen| screen.contents().contains(text));
    }

    /// Waits until nothing has come out for a while.
    pub fn wait_for_silence(&self) {
        self.wait_for_silence_of(QUIET);
    }

    /// Waits until nothing has come out for so long.
    pub fn wait_for_silence_of(&self, quiet: Duration) {
        let start = Instant::now();
        let (mut length, mut since) = (0, start);
        while since.elapsed() < quiet {
            let now = self.raw().len();
            if now != length {
                (length, since) = (now, Instant::now());
            }
            self.assert_patience(start, "it never falls silent");
            thread::sleep(Duration::from_millis(10));
        }
    }

    /// Waits until the program has ended and all it has said has come out.
    pub fn wait_for_end(&mut self) -> ExitStatus {
        let (_, status) = self.end_since(Instant::now());
        if let Some(handles) = &mut self.handles {
            self.modes_after = Some(format!("{:?}", handles.master.get_termios()));
            handles.slave = None;
        }
        // Another program may go on in the terminal.
        let start = Instant::now();
        while !self.collector.is_finished() && start.elapsed() < QUIET {
            thread::sleep(Duration::from_millis(10));
        }
        if self.handles.is_none() || !self.collector.is_finished() {
            self.wait_for_silence();
        }
        status
    }

    /// Tries until something comes of it.
    fn patiently<T>(
        &mut self,
        failure: &str,
        mut attempt: impl FnMut(&mut Self) -> Option<T>,
    ) -> T {
        let start = Instant::now();
        loop {
            if let Some(found) = attempt(self) {
                return found;
            }
            self.assert_patience(start, failure);
            thread::sleep(Duration::from_millis(10));
        }
    }

    /// Fails when a wait that began at `start` has taken too long.
    fn assert_patience(&self, start: Instant, failure: &str) {
        let waited = start.elapsed();
        let text = || format!("{failure} after {waited:.0?}; the screen:\n{}", self.text());
        assert!(waited < TIMEOUT, "{}", text());
    }

    /// Looks at the screen.
    pub fn look<T>(&self, look: impl Fn(&Screen) -> T) -> T {
        self.with(|output| look(output.parser.screen()))
    }

    /// The screen's text.
    pub fn text(&self) -> String {
        self.look(Screen::contents)
    }

    /// All that has come out so far.
    pub fn raw(&self) -> Vec<u8> {
        self.with(|output| output.raw.clone())
    }

    /// Whether line discipline, echo and all else are as they were before the program started.
    pub fn has_its_modes_back(&self) -> bool {
        if let Some(after) = &self.modes_after {
            return *after == self.modes_before;
        }
        let master = &self.handles.as_ref().expect("a terminal").master;
        format!("{:?}", master.get_termios()) == self.modes_before
    }

    fn with<T>(&self, action: impl FnOnce(&mut Output) -> T) -> T {
        action(&mut self.output.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        // A test that failed leaves no program behind.
        let start = Instant::now();
        while let Ok(None) = self.child.try_wait()
            && start.elapsed() < TIMEOUT
        {
            let _ = self.child.kill();
            thread::sleep(Duration::from_millis(10));
        }
    }
}

/// Reads what comes out, as fast as the line is.
fn collect(
    mut reader: Box<dyn Read + Send>,
    (writer, output, line): (Writer, Arc<Mutex<Output>>, Arc<Mutex<Line>>),
    is_over: Arc<AtomicBool>,
) -> thread::JoinHandle<()> {
    let (answers_to_come, due) = channel::<(Instant, &[u8])>();
    thread::spawn(move || {
        for (then, answer) in due {
            thread::sleep(then.saturating_duration_since(Instant::now()));
            let mut writer = writer.lock().unwrap_or_else(PoisonError::into_inner);
            let _ = writer.write_all(answer);
            let _ = writer.flush();
        }
    });
    thread::spawn(move || {
        let mut bytes = [0; 4096];
        // When the line has carried what was read: on a busy machine, sleeping alone would make it slower than it is.
        let mut carried = Instant::now();
        loop {
            let Line {
                rate,
                answers,
                round_trip,
            } = *line.lock().unwrap_or_else(PoisonError::into_inner);
            if rate == Some(0) {
                if is_over.load(Ordering::Relaxed) {
                    return;
                }
                thread::sleep(Duration::from_millis(10));
                continue;
            }
            // Twenty reads a second.
            let most = rate.map_or(bytes.len(), |rate| (rate as usize / 20).clamp(1, 4096));
            let Ok(count @ 1..) = reader.read(&mut bytes[..most]) else {
                return;
            };
            if is_over.load(Ordering::Relaxed) {
                return;
            }
            let mut output = output.lock().unwrap_or_else(PoisonError::into_inner);
            output.parser.process(&bytes[..count]);
            let before = output.raw.len().saturating_sub(3);
            output.raw.extend_from_slice(&bytes[..count]);
            for request in output.raw[before..].windows(4).filter(|_| answers) {
                let answer: &[u8] = match request {
                    b"\x1b[5n" => b"\x1b[0n",
                    b"\x1b[6n" => b"\x1b[1;1R",
                    _ => continue,
                };
                let _ = answers_to_come.send((Instant::now() + round_trip, answer));
            }
            drop(output);
            if let Some(rate) = rate {
                let took = Duration::from_secs_f64(count as f64 / f64::from(rate));
                carried = carried.max(Instant::now() - Duration::from_millis(200)) + took;
                thread::sleep(carried.saturating_duration_since(Instant::now()));
            }
        }
    })
}

fn pty_size(columns: u16, rows: u16) -> PtySize {
    PtySize {
        rows,
        cols: columns,
        pixel_width: 0,
        pixel_height: 0,
    }
}

fn nonzero(value: u16) -> NonZeroU16 {
    NonZeroU16::new(value).expect("a size that is not 0")
}
