//! The program in a pseudo-terminal whose screen can be looked at.

use std::io::{Read, Write};
use std::num::NonZeroU16;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use portable_pty::{
    Child, CommandBuilder, ExitStatus, MasterPty, PtyPair, PtySize, SlavePty, native_pty_system,
};
use vt100::{Parser, Screen};

/// Longer than anything takes on a busy machine.
pub const PATIENCE: Duration = Duration::from_secs(20);

/// What has come out of the program.
struct Output {
    parser: Parser,
    raw: Vec<u8>,
}

/// The test's own handles of the terminal.
struct Handles {
    master: Box<dyn MasterPty + Send>,
    writer: Box<dyn Write + Send>,
    /// Kept open, so that the terminal's modes can be read when the program is gone.
    _slave: Box<dyn SlavePty + Send>,
}

/// A terminal with the program in it.
pub struct Terminal {
    child: Box<dyn Child + Send + Sync>,
    /// None once the terminal has gone away.
    handles: Option<Handles>,
    /// Reads what comes out, until the terminal is gone or reading is over.
    collector: thread::JoinHandle<()>,
    reading_is_over: Arc<AtomicBool>,
    output: Arc<Mutex<Output>>,
    modes_before: String,
}

/// Where the program keeps its checkpoints under test.
pub fn state_home() -> &'static Path {
    Path::new(concat!(env!("CARGO_TARGET_TMPDIR"), "/state"))
}

/// The program with these arguments, in an environment of its own.
pub fn program(arguments: &[&str]) -> CommandBuilder {
    let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_mdr-tui"));
    command.args(arguments);
    for name in ["NO_COLOR", "MDR_TUI_FAULT", "LANG", "LC_CTYPE"] {
        command.env_remove(name);
    }
    command.env("XDG_STATE_HOME", state_home());
    command.env("TERM", "xterm-256color");
    command.env("LC_ALL", "C.UTF-8");
    command
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
        let collector = collect(reader, Arc::clone(&output), Arc::clone(&reading_is_over));
        let writer = master.take_writer().expect("a writer");
        let child = slave.spawn_command(command).expect("the program starts");
        Self {
            child,
            handles: Some(Handles {
                master,
                writer,
                _slave: slave,
            }),
            collector,
            reading_is_over,
            output,
            modes_before,
        }
    }

    /// Types `keys`.
    pub fn press(&mut self, keys: &str) {
        let writer = &mut self.handles.as_mut().expect("a terminal").writer;
        writer.write_all(keys.as_bytes()).expect("a terminal");
        writer.flush().expect("a terminal");
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
        let start = Instant::now();
        let (mut length, mut since) = (0, start);
        while since.elapsed() < Duration::from_millis(300) {
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
        let status = self.patiently("it does not end", |terminal| {
            terminal.child.try_wait().expect("a program")
        });
        self.wait_for_silence();
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
        assert!(
            waited < PATIENCE,
            "{failure} after {waited:.0?}; the screen:\n{}",
            self.text()
        );
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
            && start.elapsed() < PATIENCE
        {
            let _ = self.child.kill();
            thread::sleep(Duration::from_millis(10));
        }
    }
}

fn collect(
    mut reader: Box<dyn Read + Send>,
    output: Arc<Mutex<Output>>,
    is_over: Arc<AtomicBool>,
) -> thread::JoinHandle<()> {
    thread::spawn(move || {
        let mut bytes = [0; 4096];
        while let Ok(count @ 1..) = reader.read(&mut bytes) {
            if is_over.load(Ordering::Relaxed) {
                return;
            }
            let mut output = output.lock().unwrap_or_else(PoisonError::into_inner);
            output.parser.process(&bytes[..count]);
            output.raw.extend_from_slice(&bytes[..count]);
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
