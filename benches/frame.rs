//! What the explorer costs: a frame drawn and sent, a key answered, the first frame of a start, and
//! the simulation under it against the same simulation alone.
//!
//! `cargo bench --bench frame`. The bytes of a frame are counted by a test, `tests/suite/ansi_writer.rs`.

use std::io::{Read, Write};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Duration;

use divan::Bencher;
use mdr_tui::plot::Marker;
use mdr_tui::plot::theme::{Look, Theme};
use mdr_tui::scenario::Scenario;
use mdr_tui::scenario::session::Session;
use mdr_tui::tui::ansi_writer::AnsiWriter;
use mdr_tui::tui::app::App;
use mdr_tui::tui::event::Event;
use mdr_tui::tui::frame::Activity;
use mdr_tui::tui::keys::parse_script;
use mdr_tui::tui::screen;
use mdr_tui::tui::worker::{Order, Orders, Worker};
use portable_pty::{CommandBuilder, PtySize, native_pty_system};
use ratatui::buffer::Buffer;
use ratatui::layout::Size;

fn main() {
    divan::main();
}

/// Cycles of the runs that are compared.
const CYCLES: f64 = 600.0;

const SMALL: Size = Size::new(80, 24);
const LARGE: Size = Size::new(200, 50);

/// The explorer without a terminal.
struct Stage {
    app: App,
    orders: Orders,
    events: Receiver<Event>,
    line: AnsiWriter,
}

impl Stage {
    fn new(size: Size) -> Self {
        let set = format!("run.cycles={CYCLES}");
        let scenario = Scenario::load("li2019-fig3", &[set]).expect("a preset");
        let session = Session::start(scenario).expect("a contact");
        let (orders, to_worker) = Orders::channel();
        let (sender, events) = channel();
        let interval = Duration::from_millis(100);
        let mut worker = Worker::new(session, sender, interval, false);
        thread::spawn(move || worker.serve(&to_worker));
        let (theme, frame) = (Theme::new(Look::Dark, Marker::Braille), orders.frame());
        let mut app = App::new(theme, orders.clone(), frame.expect("a worker"));
        app.explorer.resize(size);
        Self {
            app,
            orders,
            events,
            line: AnsiWriter::default(),
        }
    }

    fn press(&mut self, keys: &str) {
        for key in parse_script(keys).expect("a script") {
            self.app.press(key);
        }
        self.app
            .explorer
            .show_frame(self.orders.frame().expect("a worker"));
    }

    fn draw(&mut self) {
        let area = self.app.explorer.stage.area;
        let mut wanted = Buffer::empty(area);
        screen::draw(&self.app, area, &mut wanted);
        self.line.chunk(&wanted, usize::MAX);
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        self.orders.send(Order::Quit);
    }
}

/// A frame drawn, compared with the one before, and turned into bytes: two moments in turn.
#[divan::bench(args = ["80x24", "200x50"])]
fn frame(bencher: Bencher, size: &str) {
    let mut stage = Stage::new(if size == "80x24" { SMALL } else { LARGE });
    let moments = [",,,", "......"].map(|keys| {
        stage.press(keys);
        stage.app.explorer.frame.clone()
    });
    let mut turn = 0;
    bencher.bench_local(|| {
        turn = 1 - turn;
        stage.app.explorer.show_frame(Arc::clone(&moments[turn]));
        stage.draw();
    });
}

/// What the worker takes from the simulation for a frame: at ten frames a second, ten of these.
#[divan::bench]
fn observation(bencher: Bencher) {
    let mut stage = Stage::new(LARGE);
    stage.press(",");
    bencher.bench_local(|| stage.orders.frame().expect("a worker"));
}

/// The run of Fig. 3 alone.
#[divan::bench(sample_count = 10, sample_size = 1)]
fn run_headless() {
    let scenario = Scenario::load("li2019-fig3", &[]).expect("a preset");
    let mut session = Session::start(scenario).expect("a contact");
    while session.simulation().cycle() < CYCLES {
        session.step_until(f64::INFINITY).expect("a step");
    }
}

/// The same run in the explorer as fast as it can, drawn in 200 by 50 ten times a second.
#[divan::bench(sample_count = 10, sample_size = 1)]
fn run_in_the_explorer() {
    let mut stage = Stage::new(LARGE);
    stage.press(&"+".repeat(20));
    stage.press("<Space>");
    while let Ok(event) = stage.events.recv() {
        if let Event::Frame(slot) = event
            && let Some(frame) = slot.take()
        {
            let is_done = frame.activity == Activity::Done;
            stage.app.explorer.show_frame(frame);
            stage.draw();
            if is_done {
                return;
            }
        }
    }
}

/// The program in a terminal of its own.
struct Terminals {
    reader: Box<dyn Read + Send>,
    writer: Box<dyn Write + Send>,
    child: Box<dyn portable_pty::Child + Send + Sync>,
    _master: Box<dyn portable_pty::MasterPty + Send>,
}

impl Terminals {
    fn start() -> Self {
        let size = PtySize {
            rows: 24,
            cols: 80,
            pixel_width: 0,
            pixel_height: 0,
        };
        let pair = native_pty_system().openpty(size).expect("a terminal");
        let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_mdr-tui"));
        command.args(["--set", "run.cycles=1e9"]);
        command.env("TERM", "xterm-256color");
        command.env("LC_ALL", "C.UTF-8");
        Self {
            reader: pair.master.try_clone_reader().expect("a reader"),
            writer: pair.master.take_writer().expect("a writer"),
            child: pair.slave.spawn_command(command).expect("the program"),
            _master: pair.master,
        }
    }

    /// Reads until `mark` has come, and says that it has read each frame, as terminals do.
    fn read_to(&mut self, mark: &[u8]) {
        let mut seen = Vec::new();
        let mut bytes = [0; 4096];
        let mut answered = 0;
        while !seen.windows(mark.len()).any(|part| part == mark) {
            match self.reader.read(&mut bytes) {
                Ok(count @ 1..) => seen.extend_from_slice(&bytes[..count]),
                _ => panic!("the program has ended"),
            }
            let asked = seen.windows(4).filter(|&part| part == b"\x1b[5n").count();
            self.press(&"\x1b[0n".repeat(asked - answered));
            answered = asked;
        }
    }

    fn press(&mut self, keys: &str) {
        self.writer.write_all(keys.as_bytes()).expect("a terminal");
        self.writer.flush().expect("a terminal");
    }
}

impl Drop for Terminals {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// From the start of the process to its first whole frame.
#[divan::bench(sample_count = 20, sample_size = 1)]
fn first_frame_in_a_terminal(bencher: Bencher) {
    bencher.bench_local(|| {
        let mut terminal = Terminals::start();
        terminal.read_to(b"\x1b[?2026l");
        // Its end is waited for after the watch has stopped.
        terminal
    });
}

/// From a key to its answer on the wire while the simulation runs flat out.
#[divan::bench(sample_count = 40, sample_size = 1)]
fn key_in_a_terminal(bencher: Bencher) {
    let mut terminal = Terminals::start();
    terminal.read_to(b"running");
    terminal.press(&"+".repeat(20));
    thread::sleep(Duration::from_millis(500));
    let terminal = std::cell::RefCell::new(terminal);
    bencher
        .with_inputs(|| {
            // What is open is closed, outside of what is measured.
            let mut terminal = terminal.borrow_mut();
            terminal.press("\x1b");
            terminal.read_to(b"\x1b[?2026l");
            thread::sleep(Duration::from_millis(30));
        })
        .bench_local_values(|()| {
            let mut terminal = terminal.borrow_mut();
            terminal.press("?");
            terminal.read_to(b"keys (");
        });
}
