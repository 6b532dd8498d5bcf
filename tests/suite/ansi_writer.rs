//! What goes over the wire: few bytes, and exactly the screen that was meant.

use std::num::NonZeroU16;
use std::sync::Arc;

use mdr_tui::plot::Marker;
use mdr_tui::plot::theme::{Depth, Look, Theme};
use mdr_tui::tui::ansi_writer::AnsiWriter;
use mdr_tui::tui::frame::{Activity, Frame};
use mdr_tui::tui::keys::parse_script;
use mdr_tui::tui::panels::Panel;
use mdr_tui::tui::screen;
use mdr_tui::tui::worker::Order;
use proptest::prelude::*;
use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Rect, Size};
use ratatui::style::{Color, Modifier, Style};
use vt100::Parser;

use crate::common::Explorer;

/// The explorer on a terminal that counts.
pub struct Counted {
    line: AnsiWriter,
    explorer: Explorer,
}

impl Counted {
    /// On a terminal of 256 colours.
    pub fn new(columns: u16, rows: u16) -> Self {
        Self::with(Depth::Indexed, columns, rows)
    }

    fn with(depth: Depth, columns: u16, rows: u16) -> Self {
        let theme = Theme::new(Look::Dark, Marker::Braille).with_depth(depth);
        let mut explorer = Explorer::on("li2019-fig3", theme);
        explorer.app.explorer.resize(Size::new(columns, rows));
        let line = AnsiWriter::default();
        Self { line, explorer }
    }

    /// Plays keys, draws once, and returns the bytes of the frame.
    pub fn frame(&mut self, keys: &str) -> usize {
        for key in parse_script(keys).expect("a script") {
            self.explorer.app.press(key);
        }
        let frame = self.explorer.frame();
        self.explorer.app.explorer.show_frame(frame);
        self.draw()
    }

    /// Takes this many steps as if the run had made them by itself: the worker steps, and no key is pressed.
    pub fn running_frame(&mut self, steps: usize) -> usize {
        for _ in 0..steps {
            let step = Order::Step(|_, _| true);
            self.explorer.worker.orders.send(step);
        }
        let mut frame = Frame::clone(&self.explorer.frame());
        frame.activity = Activity::Running;
        self.explorer.app.explorer.show_frame(Arc::new(frame));
        self.draw()
    }

    /// What the screen shows.
    pub fn screen(&self) -> Buffer {
        let area = self.explorer.app.explorer.stage.area;
        let mut buffer = Buffer::empty(area);
        screen::draw(&self.explorer.app, area, &mut buffer);
        buffer
    }

    /// Draws, and returns the bytes that this takes.
    fn draw(&mut self) -> usize {
        let screen = self.screen();
        self.line.chunk(&screen, usize::MAX).0.len()
    }
}

/// The status request behind each frame, which the flow control adds.
const REQUEST: usize = 4;

/// Fails unless each of `count` frames takes at most the given number of bytes, and a paused screen none.
fn take_few_bytes(
    counted: &mut Counted,
    budget: usize,
    count: usize,
    of: fn(&mut Counted) -> usize,
) {
    let total: usize = (0..count).map(|_| of(counted) + REQUEST).sum();
    let (bytes, area) = (total / count, counted.explorer.app.explorer.stage.area);
    assert!(bytes <= budget, "{bytes} bytes per frame in {area}");
    assert_eq!(counted.draw(), 0, "a paused screen sends something");
}

/// Frames of about a cycle each: what ten cycles per second send at ten frames per second, whose moments wander
/// through the cycle. The cross-section, with its stresses, is among the nine panels of the second screen. The axis of
/// cycles grows four times within these frames.
#[test]
fn a_frame_of_the_figure_takes_few_bytes() {
    for (columns, rows, budget) in [(80, 24, 165), (120, 40, 570), (200, 50, 890)] {
        let mut counted = Counted::new(columns, rows);
        counted.frame("");
        let app = &counted.explorer.app;
        let has_stresses = app.explorer.stage.visible().contains(&Panel::Section)
            && app.explorer.stress.bounds().is_some();
        assert!(columns != 120 || has_stresses);
        take_few_bytes(&mut counted, budget, 60, |counted| counted.frame(",.."));
    }
}

/// Frames at the initial pace, half a cycle per second at ten frames per second, over two cycles after the third. Where
/// motion is seen, every curve and every mark moves between two frames. In the large contact the indenter moves, and the
/// half-space stands still for a cycle.
#[test]
fn a_frame_in_motion_takes_few_bytes() {
    for (keys, depth, budgets) in [
        ("", Depth::Indexed, [330, 1005, 1445]),
        ("V", Depth::Indexed, [470, 810, 840]),
        ("V", Depth::True, [600, 1120, 1205]),
    ] {
        for ((columns, rows), budget) in [(80, 24), (120, 40), (200, 50)].into_iter().zip(budgets) {
            let mut counted = Counted::with(depth, columns, rows);
            counted.frame(keys);
            counted.frame(",,,");
            take_few_bytes(&mut counted, budget, 40, |counted| counted.running_frame(5));
        }
    }
}

/// A run's cross-section and numbers follow within two frames, and at once when it pauses or a key is
/// pressed.
#[test]
fn calm_panels_are_never_three_frames_behind() {
    let mut counted = Counted::new(120, 40);
    counted.frame(",");
    let force = |counted: &Counted| {
        let text: String = counted.screen().content.iter().map(Cell::symbol).collect();
        let at = text.find("F_z   ").expect("the numbers");
        text[at..at + 40].to_owned()
    };
    let mut seen = Vec::new();
    for _ in 0..7 {
        counted.running_frame(5);
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
    let mut counted = Counted::new(80, 24);
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
    let has_ink = text != " " || cell.inverse();
    let ink = has_ink.then(|| (cell.fgcolor(), cell.bold(), cell.dim()));
    format!("{text:?} {ink:?} {:?} {}", cell.bgcolor(), cell.inverse())
}

/// The same cell as a terminal would show it if it were written by itself.
fn meant(cell: &Cell) -> String {
    let mut screen = Buffer::empty(Rect::new(0, 0, COLUMNS as u16, ROWS as u16));
    screen[(0, 0)] = cell.clone();
    let mut parser = terminal();
    let (text, _) = AnsiWriter::default().chunk(&screen, usize::MAX);
    parser.process(text.as_bytes());
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
            parser.process(line.chunk(&meant_cells, usize::MAX).0.as_bytes());
            for (at, cell) in meant_cells.content.iter().enumerate() {
                let (row, column) = (at / COLUMNS, at % COLUMNS);
                prop_assert_eq!(seen(&parser, row as u16, column as u16), meant(cell), "{} {}", row, column);
            }
        }
    }
}
