//! What goes over the wire: few bytes, and exactly the screen that was meant.

use std::io;
use std::num::NonZeroU16;
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::Duration;

use mdr_tui::plot::Marker;
use mdr_tui::scenario::Scenario;
use mdr_tui::scenario::session::Session;
use mdr_tui::tui::ansi_backend::AnsiBackend;
use mdr_tui::tui::app::App;
use mdr_tui::tui::frame::Slot;
use mdr_tui::tui::keys::parse_script;
use mdr_tui::tui::order::Order;
use mdr_tui::tui::panels::Panel;
use mdr_tui::tui::screen;
use mdr_tui::tui::theme::{Look, Theme};
use mdr_tui::tui::worker::Worker;
use proptest::prelude::*;
use ratatui::Terminal;
use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Rect, Size};
use ratatui::style::{Color, Modifier, Style};
use vt100::Parser;

/// A terminal that remembers what it was sent.
type Line = Terminal<AnsiBackend<Vec<u8>>>;

fn line(size: fn() -> io::Result<Size>) -> Line {
    Terminal::new(AnsiBackend::new(Vec::new(), size)).expect("a terminal")
}

fn sent(line: &Line) -> usize {
    line.backend().get_ref().len()
}

/// The explorer on a terminal that counts.
struct Counted {
    line: Line,
    app: App,
    orders: Sender<Order>,
}

impl Counted {
    fn new(size: fn() -> io::Result<Size>) -> Self {
        let scenario = Scenario::load("li2019-fig3", &[]).expect("a preset");
        let session = Session::start(scenario).expect("a contact");
        let (orders, to_worker) = channel();
        let (events, _) = channel();
        let interval = Duration::from_secs(1);
        let worker = Worker::new(session, Arc::new(Slot::default()), events, interval, false);
        thread::spawn(move || worker.serve(&to_worker));
        let mut app = App::new(Theme::new(Look::Dark, Marker::Braille), orders.clone());
        let Size { width, height } = size().expect("a size");
        app.resize(width, height);
        Self {
            line: line(size),
            app,
            orders,
        }
    }

    /// Plays keys, draws once, and returns the bytes of the frame.
    fn frame(&mut self, keys: &str) -> usize {
        for key in parse_script(keys).expect("a script") {
            self.app.press(key);
        }
        let (reply, answer) = channel();
        self.orders.send(Order::Sync(reply)).expect("a worker");
        self.app.take_frame(answer.recv().expect("a frame"));
        self.draw()
    }

    fn draw(&mut self) -> usize {
        let before = sent(&self.line);
        let app = &self.app;
        self.line
            .draw(|frame| screen::draw(app, frame.area(), frame.buffer_mut()))
            .expect("a drawing");
        sent(&self.line) - before
    }
}

impl Drop for Counted {
    fn drop(&mut self) {
        let _ = self.orders.send(Order::Quit);
    }
}

/// Bytes a frame on average over `frames` of about a cycle each: what ten cycles a second send at ten
/// frames a second, whose moments wander through the cycle.
fn average(size: fn() -> io::Result<Size>, frames: usize) -> usize {
    let mut counted = Counted::new(size);
    counted.frame("");
    let total: usize = (0..frames).map(|_| counted.frame(",..")).sum();
    total / frames
}

#[test]
fn a_frame_of_the_figure_takes_few_bytes() {
    let small = average(|| Ok(Size::new(80, 24)), 60);
    assert!(small <= 450, "{small} bytes a frame in 80 by 24");
    let large = average(|| Ok(Size::new(200, 50)), 60);
    assert!(large <= 2000, "{large} bytes a frame in 200 by 50");
}

#[test]
fn stresses_in_the_half_space_take_few_bytes() {
    let size = || Ok(Size::new(120, 40));
    let mut counted = Counted::new(size);
    counted.frame("");
    // The cross-section is among the nine panels of this screen, and shows stresses.
    assert!(counted.app.visible().contains(&Panel::Section));
    assert!(counted.app.stress_bounds().is_some());
    let frames = 60;
    let total: usize = (0..frames).map(|_| counted.frame(",..")).sum();
    assert!(total / frames <= 2000, "{} bytes a frame", total / frames);
    assert_eq!(counted.draw(), 0, "a paused screen sends something");
}

#[test]
fn what_stays_the_same_is_not_sent() {
    let mut counted = Counted::new(|| Ok(Size::new(80, 24)));
    assert!(counted.frame(",") > 1000);
    assert_eq!(counted.frame(""), 0);
    assert_eq!(counted.draw(), 0);
}

fn color() -> impl Strategy<Value = Color> {
    prop_oneof![
        3 => Just(Color::Reset),
        1 => Just(Color::Red),
        1 => Just(Color::DarkGray),
        1 => Just(Color::LightCyan),
        1 => any::<u8>().prop_map(Color::Indexed),
    ]
}

fn cells() -> impl Strategy<Value = Vec<(usize, char, Style)>> {
    let modifiers = prop_oneof![
        4 => Just(Modifier::empty()),
        1 => Just(Modifier::BOLD),
        1 => Just(Modifier::DIM),
        1 => Just(Modifier::BOLD | Modifier::REVERSED),
    ];
    let sign = prop::sample::select(vec![' ', 'a', '⣀', '─', 'µ', '█', '³', '~']);
    let style = (color(), color(), modifiers)
        .prop_map(|(fg, bg, modifier)| Style::new().fg(fg).bg(bg).add_modifier(modifier));
    prop::collection::vec((0..COLUMNS * ROWS, sign, style), 0..40)
}

const COLUMNS: usize = 12;
const ROWS: usize = 7;

/// What a terminal shows in a cell: sign and how it looks; a blank without a ground has no look.
fn seen(parser: &Parser, row: u16, column: u16) -> String {
    let cell = parser.screen().cell(row, column).expect("a cell");
    let text = if cell.has_contents() {
        cell.contents()
    } else {
        " "
    };
    let ink = (cell.fgcolor(), cell.bold(), cell.dim());
    let ink = if text == " " && !cell.inverse() {
        None
    } else {
        Some(ink)
    };
    format!("{text:?} {ink:?} {:?} {}", cell.bgcolor(), cell.inverse())
}

/// The same cell as a terminal would show it if it were written by itself.
fn meant(cell: &Cell) -> String {
    let mut line = AnsiBackend::new(Vec::new(), || Ok(Size::new(COLUMNS as u16, ROWS as u16)));
    ratatui::backend::Backend::draw(&mut line, [(0, 0, cell)].into_iter()).expect("a cell");
    ratatui::backend::Backend::flush(&mut line).expect("a frame");
    let mut parser = terminal();
    parser.process(line.get_ref());
    seen(&parser, 0, 0)
}

fn terminal() -> Parser {
    let size = |cells: usize| NonZeroU16::new(cells as u16).expect("a size");
    Parser::new(size(ROWS), size(COLUMNS), 0)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whatever changes from frame to frame, the terminal ends up with the cells that were meant.
    #[test]
    fn a_terminal_shows_what_was_drawn(frames in prop::collection::vec(cells(), 1..6)) {
        let mut line = line(|| Ok(Size::new(COLUMNS as u16, ROWS as u16)));
        let mut meant_cells = Buffer::empty(Rect::new(0, 0, COLUMNS as u16, ROWS as u16));
        let mut parser = terminal();
        let mut read = 0;
        for changes in frames {
            for (at, sign, style) in changes {
                meant_cells.content[at].reset();
                meant_cells.content[at].set_char(sign).set_style(style);
            }
            line.draw(|frame| frame.buffer_mut().clone_from(&meant_cells)).expect("a drawing");
            parser.process(&line.backend().get_ref()[read..]);
            read = sent(&line);
            for (at, cell) in meant_cells.content.iter().enumerate() {
                let (row, column) = (at / COLUMNS, at % COLUMNS);
                prop_assert_eq!(seen(&parser, row as u16, column as u16), meant(cell), "{} {}", row, column);
            }
        }
    }
}
