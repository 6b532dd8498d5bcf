//! What goes over the wire: few bytes, and exactly the screen that was meant.

use std::num::NonZeroU16;
use std::sync::Arc;
use std::time::Duration;

use mdr_tui::plot::Marker;
use mdr_tui::tui::ansi_writer::AnsiWriter;
use mdr_tui::tui::app::App;
use mdr_tui::tui::frame::{Activity, Frame};
use mdr_tui::tui::keys::{Key, parse_script};
use mdr_tui::tui::panels::Panel;
use mdr_tui::tui::screen;
use mdr_tui::tui::theme::{Depth, Look, Theme};
use mdr_tui::tui::worker::Worker;
use proptest::prelude::*;
use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Rect, Size};
use ratatui::style::{Color, Modifier, Style};
use vt100::Parser;

use crate::common::{LiveWorker, load};

/// The explorer on a terminal that counts.
struct Counted {
    line: AnsiWriter,
    app: App,
    worker: LiveWorker,
}

impl Counted {
    fn new(size: Size) -> Self {
        let worker = LiveWorker::on(load("li2019-fig3", &[]), Duration::from_secs(1), false);
        // The longest names of colours.
        let theme = Theme::new(Look::Dark, Marker::Braille).with_depth(Depth::Indexed);
        let mut app = App::new(theme, worker.orders.clone());
        app.resize(size.width, size.height);
        Self {
            line: AnsiWriter::default(),
            app,
            worker,
        }
    }

    /// Plays keys, draws once, and returns the bytes of the frame.
    fn frame(&mut self, keys: &str) -> usize {
        for key in parse_script(keys).expect("a script") {
            self.app.press(key);
        }
        let frame = self.sync();
        self.app.take_frame(frame);
        self.draw()
    }

    /// The same as if the run had come there by itself: the worker takes the steps, and the screen
    /// knows of no key.
    fn running_frame(&mut self, keys: &str) -> usize {
        for key in parse_script(keys).expect("a script") {
            assert_eq!(key, Key::Char('.'));
            self.worker.orders.send(Worker::step_once);
        }
        let mut frame = Frame::clone(&self.sync());
        frame.activity = Activity::Running;
        self.app.take_frame(Arc::new(frame));
        self.draw()
    }

    fn sync(&self) -> Arc<Frame> {
        self.worker.orders.frame().expect("a worker")
    }

    /// What the screen shows.
    fn screen(&self) -> Buffer {
        let area = self.app.stage.area;
        let mut buffer = Buffer::empty(area);
        screen::draw(&self.app, area, &mut buffer);
        buffer
    }

    /// Draws, and returns the bytes that this takes.
    fn draw(&mut self) -> usize {
        let screen = self.screen();
        self.line.frame(screen).len()
    }
}

/// The status request behind each frame, which the flow control adds.
const REQUEST: usize = 4;

/// Average bytes per frame over `frames` of about a cycle each: what ten cycles per second send at ten
/// frames per second, whose moments wander through the cycle.
fn average(size: Size, frames: usize) -> usize {
    let mut counted = Counted::new(size);
    counted.frame("");
    let total: usize = (0..frames).map(|_| counted.frame(",..") + REQUEST).sum();
    total / frames
}

/// Average bytes per frame at the initial pace: half a cycle per second at ten frames per second, over
/// two cycles after the third. A scripted run, so the bytes are the same on every machine.
fn at_the_initial_pace(counted: &mut Counted) -> usize {
    counted.frame(",,,");
    let frames = 40;
    let total: usize = (0..frames)
        .map(|_| counted.running_frame(".....") + REQUEST)
        .sum();
    total / frames
}

#[test]
fn a_frame_of_the_figure_takes_few_bytes() {
    let small = average(Size::new(80, 24), 60);
    assert!(small <= 165, "{small} bytes per frame in 80 by 24");
    let large = average(Size::new(200, 50), 60);
    assert!(large <= 840, "{large} bytes per frame in 200 by 50");
}

/// Fails unless a frame in motion after `keys` takes no more than the bytes of each size.
fn in_motion(keys: &str, budgets: [usize; 3]) {
    for ((columns, rows), budget) in [(80, 24), (120, 40), (200, 50)].into_iter().zip(budgets) {
        let mut counted = Counted::new(Size::new(columns, rows));
        counted.frame(keys);
        let bytes = at_the_initial_pace(&mut counted);
        assert!(
            bytes <= budget,
            "{bytes} bytes per frame in {columns} by {rows}"
        );
        assert_eq!(counted.draw(), 0, "a paused screen sends something");
    }
}

/// Where motion is seen, every curve and every mark moves between two frames.
#[test]
fn a_frame_in_motion_takes_few_bytes() {
    in_motion("", [395, 1150, 1585]);
}

/// The indenter moves with every frame, the stress below it with every third.
#[test]
fn the_contact_in_motion_takes_few_bytes() {
    in_motion("V", [560, 1655, 2055]);
}

#[test]
fn stresses_in_the_half_space_take_few_bytes() {
    let size = Size::new(120, 40);
    let mut counted = Counted::new(size);
    counted.frame("");
    // The cross-section is among the nine panels of this screen, and shows stresses.
    assert!(counted.app.stage.visible().contains(&Panel::Section));
    assert!(counted.app.stress.bounds.is_some());
    let frames = 60;
    let total: usize = (0..frames).map(|_| counted.frame(",..")).sum();
    assert!(total / frames <= 550, "{} bytes a frame", total / frames);
    assert_eq!(counted.draw(), 0, "a paused screen sends something");
}

/// A run's cross-section and numbers follow within two frames, and at once when it pauses or a key is
/// pressed.
#[test]
fn calm_panels_are_never_three_frames_behind() {
    let mut counted = Counted::new(Size::new(120, 40));
    counted.frame(",");
    let force = |counted: &Counted| {
        let text: String = counted.screen().content.iter().map(Cell::symbol).collect();
        let at = text.find("F_z   ").expect("the numbers");
        text[at..at + 40].to_owned()
    };
    let mut seen = Vec::new();
    for _ in 0..7 {
        counted.running_frame(".....");
        seen.push(force(&counted));
    }
    assert_eq!(seen[0], seen[1]);
    assert_ne!(seen[1], seen[2]);
    assert_eq!([&seen[2]; 2], [&seen[3], &seen[4]]);
    assert_ne!(seen[4], seen[5]);
    assert_eq!(seen[5], seen[6]);
    counted.frame("");
    assert_ne!(force(&counted), seen[6], "paused, but not up to date");
}

#[test]
fn what_stays_the_same_is_not_sent() {
    let mut counted = Counted::new(Size::new(80, 24));
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
    let sign = prop::sample::select(vec![' ', 'a', '⣀', '─', 'µ', '█', '▀', '³', '~']);
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
    let mut screen = Buffer::empty(Rect::new(0, 0, COLUMNS as u16, ROWS as u16));
    screen[(0, 0)] = cell.clone();
    let mut parser = terminal();
    parser.process(AnsiWriter::default().frame(screen).as_bytes());
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
        let mut line = AnsiWriter::default();
        let mut meant_cells = Buffer::empty(Rect::new(0, 0, COLUMNS as u16, ROWS as u16));
        let mut parser = terminal();
        for changes in frames {
            for (at, sign, style) in changes {
                meant_cells.content[at].reset();
                meant_cells.content[at].set_char(sign).set_style(style);
            }
            parser.process(line.frame(meant_cells.clone()).as_bytes());
            for (at, cell) in meant_cells.content.iter().enumerate() {
                let (row, column) = (at / COLUMNS, at % COLUMNS);
                prop_assert_eq!(seen(&parser, row as u16, column as u16), meant(cell), "{} {}", row, column);
            }
        }
    }
}
