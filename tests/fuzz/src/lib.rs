//! What each target does with what the fuzzer makes up. `tests/hostile.rs` replays some of it.

use std::cell::OnceCell;
use std::sync::Arc;
use std::sync::mpsc::channel;
use std::time::Duration;

use mdr_tui::plot::Marker;
use mdr_tui::plot::theme::{Look, Theme};
use mdr_tui::scenario::checkpoint::{decode, encode, sealed};
use mdr_tui::scenario::session::Session;
use mdr_tui::scenario::{Scenario, preset};
use mdr_tui::tui::app::App;
use mdr_tui::tui::keys::parse_script;
use mdr_tui::tui::screen;
use mdr_tui::tui::worker::{Order, Orders, Worker};
use mdr_tui::tui::{ScriptStep, press, text};
use ratatui::buffer::Buffer;
use ratatui::layout::{Rect, Size};

pub mod strokes;

/// Grids up to this many cells are stepped on.
const CELLS: usize = 16;

/// An error is one line that does nothing to a terminal; many are one each.
fn assert_lines(text: &str) {
    text.lines().for_each(assert_line);
    assert!(!text.is_empty() && text.lines().count() <= 20, "{text}");
}

/// A line that does nothing to a terminal.
fn assert_line(text: &str) {
    assert!(
        !text.is_empty() && !text.chars().any(char::is_control),
        "{text:?}"
    );
    assert!(text.len() < 4000, "{} bytes: {text}", text.len());
}

/// One input in `many` takes the way that costs most.
fn is_chosen(text: &str, many: u32) -> bool {
    let sum = text.bytes().fold(0_u32, |sum, byte| {
        sum.wrapping_mul(31).wrapping_add(byte.into())
    });
    sum % many == 0
}

/// A scenario that was accepted writes itself down and is read back as itself; it can be stepped.
fn accepted(scenario: &Scenario) {
    assert_line(&format!(".{}", scenario.title()));
    let text = scenario.to_toml();
    let again = Scenario::from_toml(&text, scenario.origin(), &[]);
    assert!(again.as_ref() == Ok(scenario), "{text}\n{again:?}");
    if scenario.setup().grid.cells() > CELLS || !is_chosen(&text, 8) {
        return;
    }
    match Session::start(scenario.clone()) {
        Ok(session) => step(session),
        Err(error) => assert_lines(&error.to_string()),
    }
}

/// Some steps: every state is finite, or the run stops with a word.
fn step(mut session: Session) {
    for _ in 0..3 {
        if let Err(error) = session.step_until(f64::INFINITY) {
            assert_lines(&error.to_string());
            break;
        }
    }
    let simulation = session.simulation();
    assert!(
        simulation.cycle().is_finite()
            && simulation.worn_depth().iter().all(|wear| wear.is_finite())
    );
}

/// Any text as a scenario.
pub fn scenario(text: &str) {
    match Scenario::from_toml(text, "fuzz.toml", &[]) {
        Ok(scenario) => accepted(&scenario),
        Err(error) => assert_lines(&error.to_string()),
    }
}

/// Any text as `--set`, on the preset that its length chooses.
pub fn set(text: &str) {
    let preset = &preset::ALL[text.len() % preset::ALL.len()];
    let small = "numerics.points=8".to_owned();
    match Scenario::load(preset.name, &[small, text.to_owned()]) {
        Ok(scenario) => accepted(&scenario),
        Err(error) => assert_lines(&error.to_string()),
    }
}

/// Any text as `--keys`, pressed in an explorer whose worker does not answer.
pub fn keys(text: &str) {
    let keys = match parse_script(text) {
        Ok(keys) => keys,
        Err(error) => return assert_lines(&error),
    };
    if !is_chosen(text, 64) {
        return;
    }
    let (orders, _inbox) = Orders::channel();
    let scenario = Scenario::load("hertz", &["numerics.points=8".to_owned()]).expect("a preset");
    let session = Session::start(scenario).expect("a contact");
    let mut worker = Worker::new(session, channel().0, Duration::MAX, false);
    let first = Arc::new(worker.frame());
    let mut app = App::new(Theme::new(Look::Dark, Marker::Braille), orders, first);
    let area = Rect::new(0, 0, 80, 24);
    for key in keys.into_iter().take(100) {
        app.press(key);
    }
    screen::draw(&app, area, &mut Buffer::empty(area));
}

/// A sequence of keys, pastes and resizes, a byte each, in an explorer with its worker; the first byte
/// chooses the preset.
pub fn session(bytes: &[u8]) {
    let Some((first, bytes)) = bytes.split_first() else {
        return;
    };
    let preset = &preset::ALL[usize::from(*first) % preset::ALL.len()];
    let small = ["numerics.points=12", "numerics.steps_per_cycle=8"].map(String::from);
    let Ok(scenario) = Scenario::load(preset.name, &small) else {
        return;
    };
    let Ok(session) = Session::start(scenario) else {
        return;
    };
    let all: Vec<&str> = strokes::KEYS.split_whitespace().collect();
    let all = [&all[..], strokes::RARE].concat();
    let bytes = bytes.iter().take(200);
    let script: String = bytes
        .map(|byte| all[usize::from(*byte) % all.len()])
        .collect();
    let strokes = ScriptStep::script(&script).expect("a script");
    let theme = Theme::new(Look::Dark, Marker::Braille);
    rehearse(session, theme, &strokes, Size::new(80, 24));
}

/// Returns the last screen of a separate explorer that does what `strokes` say. A panic in its worker continues here.
pub fn rehearse(session: Session, theme: Theme, strokes: &[ScriptStep], size: Size) -> String {
    let (orders, to_worker) = Orders::channel();
    let (events, inbox) = channel();
    let mut worker = Worker::new(session, events, Duration::MAX, false);
    let thread = std::thread::spawn(move || worker.serve(&to_worker));
    let played = orders.frame().map(|first| {
        let mut app = App::new(theme, orders.clone(), first);
        press(&mut app, strokes, size, &inbox).map(|size| text(&app, size))
    });
    orders.send(Order::Quit);
    if let Err(panic) = thread.join() {
        std::panic::resume_unwind(panic);
    }
    played.expect("a worker").expect("a screen")
}

thread_local! {
    static WHOLE: OnceCell<Vec<u8>> = const { OnceCell::new() };
}

/// The contents of a checkpoint of four cells, without what seals them.
fn whole() -> Vec<u8> {
    let make = || {
        let sets = ["numerics.points=4".to_owned()];
        let scenario = Scenario::load("li2019-fig3", &sets).expect("a preset");
        let mut session = Session::start(scenario).expect("a contact");
        session.advance_to(0.3).expect("a part of a cycle");
        let bytes = encode(&session, None::<&()>);
        let lines = bytes.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
        let start = lines.map(|(at, _)| at + 1).nth(1).expect("two lines");
        bytes[start..].to_vec()
    };
    WHOLE.with(|whole| whole.get_or_init(make).clone())
}

/// Any bytes as a checkpoint: as a file, as contents that are sealed, and as edits of a whole one,
/// each three bytes: where, and what.
pub fn checkpoint(bytes: &[u8]) {
    if bytes.starts_with(b"mdr-tui ") {
        read(bytes);
    }
    read(&sealed(bytes));
    let mut edited = whole();
    for edit in bytes.chunks_exact(3) {
        let at = usize::from(u16::from_le_bytes([edit[0], edit[1]]));
        let length = edited.len();
        edited[at % length] = edit[2];
    }
    read(&sealed(&edited));
}

fn read(bytes: &[u8]) {
    match decode::<()>(bytes, "fuzz.checkpoint") {
        Ok(checkpoint) => {
            let again = encode(&checkpoint.session, None::<&()>);
            let twice = decode::<()>(&again[..], "again").expect("what was written is read");
            assert!(encode(&twice.session, None::<&()>) == again);
            if checkpoint.session.simulation().setup().grid.cells() <= CELLS {
                step(checkpoint.session);
            }
        }
        Err(error) => assert_lines(&error.to_string()),
    }
}
