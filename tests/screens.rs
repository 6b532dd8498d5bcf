//! Screens: a few that tell much are pinned, all others must fit their size and not fail.
//!
//! Keys are played by `--keys`, and the screen comes from `--print`, so no terminal is needed. The
//! pinned screens stand in `snapshots/`; `INSTA_UPDATE=always cargo test --test screens` writes them
//! anew, to be read before they are kept.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::Duration;

use mdr_tui::scenario::session::Session;
use mdr_tui::scenario::{Scenario, preset};
use mdr_tui::tui::app::App;
use mdr_tui::tui::command::{self, BINDINGS};
use mdr_tui::tui::keys::{Key, Named, parse_script};
use mdr_tui::tui::plot::Marker;
use mdr_tui::tui::theme::Theme;
use mdr_tui::tui::worker::{Order, Slot, Worker};
use mdr_tui::tui::{Event, screen};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use tempfile::TempDir;

fn explorer(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_mdr-tui"))
        .args(arguments)
        .current_dir(directory)
        .env("LC_ALL", "C.UTF-8")
        .stdin(Stdio::null())
        .output()
        .expect("the program starts")
}

/// The screen of `size` after `keys`; nothing on stderr, every line within the size.
fn shot(directory: &Path, scenario: &str, keys: &str, size: (usize, usize)) -> String {
    let print = format!("{}x{}", size.0, size.1);
    let arguments = [scenario, "--keys", keys, "--print", &print];
    checked(explorer(directory, &arguments), size, keys)
}

fn checked(output: Output, size: (usize, usize), what: &str) -> String {
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{what} at {size:?}: {complaint}");
    assert_eq!(complaint, "", "{what} at {size:?}");
    let text = String::from_utf8(output.stdout).expect("text");
    assert_eq!(text.lines().count(), size.1, "{what} at {size:?}");
    for line in text.lines() {
        assert!(line.chars().count() <= size.0, "{what} at {size:?}: {line}");
        assert!(!line.chars().any(char::is_control), "{line:?}");
    }
    text
}

fn desk() -> TempDir {
    tempfile::tempdir().expect("a directory")
}

/// Pins the screens of `keys` in 80 by 24 and 200 by 50.
fn pin(name: &str, scenario: &str, keys: &str) {
    let desk = desk();
    for size in [(80, 24), (200, 50)] {
        let text = shot(desk.path(), scenario, keys, size);
        insta::assert_snapshot!(format!("{name}-{}x{}", size.0, size.1), text);
    }
}

#[test]
fn the_start() {
    pin("start", "li2019-fig3", "");
}

#[test]
fn after_some_cycles() {
    pin("cycles", "li2019-fig3", ",,,,,,.......");
}

#[test]
fn a_method_and_a_law_switched() {
    pin("switched", "li2019-fig3", ",mm,w.<Esc>");
}

#[test]
fn a_method_just_switched_says_so() {
    pin("notice", "li2019-fig3", ",,m");
}

#[test]
fn a_zoomed_panel() {
    pin("zoomed", "li2019-fig3", ",,<Tab>z");
}

#[test]
fn a_logarithmic_panel() {
    pin("logarithmic", "li2019-fig3", ",,<Tab>L");
}

#[test]
fn the_help() {
    pin("help", "li2019-fig3", "?");
}

#[test]
fn the_presets() {
    pin("presets", "li2019-fig3", "pjj");
}

#[test]
fn a_scene_without_tangential_motion() {
    pin("hertz", "hertz", ",.........................");
}

#[test]
fn contact_lost() {
    pin("separation", "separation", ",...........................");
}

#[test]
fn ascii_is_ascii() {
    let desk = desk();
    for (name, keys) in [
        ("cycles", ",,"),
        ("zoomed", ",<Tab><Tab><Tab>z"),
        ("help", "?"),
        ("notice", ",m"),
    ] {
        let arguments = ["--marker", "ascii", "--keys", keys, "--print", "80x24"];
        let text = checked(explorer(desk.path(), &arguments), (80, 24), keys);
        assert!(text.is_ascii(), "{text}");
        insta::assert_snapshot!(format!("ascii-{name}-80x24"), text);
    }
}

#[test]
fn every_marker_draws() {
    let desk = desk();
    for marker in ["braille", "halfblock", "dot", "ascii"] {
        let arguments = ["--marker", marker, "--keys", ",,", "--print", "80x24"];
        let text = checked(explorer(desk.path(), &arguments), (80, 24), marker);
        assert!(text.contains("fretting loop"), "{text}");
    }
}

#[test]
fn a_tiny_screen_says_what_it_needs() {
    let desk = desk();
    let text = shot(desk.path(), "li2019-fig3", ",", (30, 8));
    insta::assert_snapshot!("tiny-30x8", text);
}

/// How a script spells a key.
fn spelled(key: Key) -> String {
    match key {
        Key::Char('<') => "<lt>".into(),
        Key::Char(' ') => "<Space>".into(),
        Key::Char(character) => character.into(),
        Key::Ctrl(character) => format!("<C-{character}>"),
        Key::Named(Named::BackTab) => "<S-Tab>".into(),
        Key::Named(_) => format!("<{key}>"),
    }
}

#[test]
fn every_key_of_the_table_can_be_pressed() {
    let desk = desk();
    let all: Vec<String> = BINDINGS
        .iter()
        .flat_map(|binding| binding.keys)
        .map(|&key| spelled(key))
        .collect();
    assert!(all.len() >= 25);
    for key in &all {
        for before in ["", ",", "?", "p", "z"] {
            shot(
                desk.path(),
                "li2019-fig3",
                &format!("{before}{key}"),
                (80, 24),
            );
        }
    }
    // All of them, in the table's order and backwards, up to the first that quits.
    let mut keys: Vec<String> = all
        .into_iter()
        .filter(|key| {
            let read = parse_script(key).expect("a key");
            !matches!(
                command::of_key(read[0]),
                Some(command::Command::Quit | command::Command::QuitKeepingScreen)
            )
        })
        .collect();
    shot(desk.path(), "li2019-fig3", &keys.concat(), (80, 24));
    keys.reverse();
    shot(desk.path(), "li2019-fig3", &keys.concat(), (80, 24));
}

#[test]
fn keys_that_mean_nothing_change_nothing() {
    let desk = desk();
    let plain = shot(desk.path(), "li2019-fig3", ",", (80, 24));
    let with = shot(
        desk.path(),
        "li2019-fig3",
        ",€é%0<C-z><Backspace>",
        (80, 24),
    );
    assert_eq!(plain, with);
}

#[test]
fn quitting_ends_the_script() {
    let desk = desk();
    for quit in ["q", "Q", "<C-c>", "?q", "p<C-c>"] {
        let text = shot(desk.path(), "li2019-fig3", &format!(",{quit},,"), (80, 24));
        assert!(text.contains("cycle 1.00/"), "{quit}: {text}");
    }
}

#[test]
fn a_snapshot_tells_of_the_switches_and_runs_again_bit_for_bit() {
    for (i, keys) in [",m,s", "...........m....W...M..w,.s", ",mmm,s", "ww.,M.,,s"]
        .into_iter()
        .enumerate()
    {
        let desk = desk();
        shot(desk.path(), "li2019-fig3", keys, (80, 24));
        let snapshot = fs::read_dir(desk.path())
            .expect("a directory")
            .map(|entry| entry.expect("an entry").path())
            .collect::<Vec<_>>();
        let [directory] = snapshot.as_slice() else {
            panic!("{keys}: {snapshot:?}");
        };
        let state = fs::read_to_string(directory.join("state.csv")).expect("the state");
        let scenario = fs::read_to_string(directory.join("scenario.toml")).expect("the scenario");
        let changes = state.matches("# at cycle ").count();
        let switches = keys.matches(|c| "mMwW".contains(c)).count();
        assert_eq!(changes, switches, "{keys}");
        assert_eq!(scenario.matches("[[changes]]").count(), switches, "{keys}");
        if i == 0 {
            assert!(state.contains("\n# method: a+b\n"), "{state}");
            assert!(
                state.contains("\n# at cycle 1: numerics.method = \"a+b\"\n"),
                "{state}"
            );
            assert!(directory.ends_with("li2019-fig3-cycle-2"));
        }
        let given = directory.join("scenario.toml");
        let given = given.to_string_lossy();
        let output = explorer(desk.path(), &["run", &given, "--out", "again", "--quiet"]);
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{keys}");
        let again = fs::read_to_string(desk.path().join("again/state.csv")).expect("the state");
        assert!(again == state, "{keys}: the states differ");
    }
}

#[test]
fn a_snapshot_never_writes_over_another() {
    let desk = desk();
    let text = shot(desk.path(), "hertz", ",sss", (80, 24));
    assert!(text.contains("snapshot in hertz-cycle-1-3"), "{text}");
    let count = fs::read_dir(desk.path()).expect("a directory").count();
    assert_eq!(count, 3);
}

/// An app with its worker, without a terminal and without a process.
struct Stage {
    app: App,
    orders: Sender<Order>,
    events: Receiver<Event>,
    worker: Option<thread::JoinHandle<()>>,
}

impl Stage {
    fn new(scenario: &str, marker: Marker) -> Self {
        let scenario = Scenario::load(scenario, &[]).expect("a preset");
        let session = Session::start(scenario).expect("a contact");
        let (orders, to_worker) = channel();
        let (sender, events) = channel();
        let slot = Arc::new(Slot::default());
        let worker = Worker::new(session, slot, sender, Duration::from_secs(1), false);
        let worker = thread::spawn(move || worker.serve(&to_worker));
        Self {
            app: App::new(Theme::new(true, marker), orders.clone()),
            orders,
            events,
            worker: Some(worker),
        }
    }

    fn press(&mut self, keys: &str) {
        for key in parse_script(keys).expect("a script") {
            self.app.press(key);
            let (reply, answer) = channel();
            self.orders.send(Order::Sync(reply)).expect("a worker");
            self.app.take_frame(answer.recv().expect("a frame"));
            for event in self.events.try_iter() {
                if let Event::Notice(text) = event {
                    self.app.notice = Some(text);
                }
            }
        }
    }

    /// Draws at `columns` by `rows`, within a larger buffer that must stay clean around it.
    fn draw(&self, columns: u16, rows: u16) {
        let mut buffer = Buffer::empty(Rect::new(0, 0, columns + 2, rows + 2));
        for cell in &mut buffer.content {
            cell.set_char('#');
        }
        let area = Rect::new(1, 1, columns, rows);
        screen::draw(&self.app, area, &mut buffer);
        for at in buffer.area.positions() {
            let outside = !area.contains(at);
            assert!(
                !outside || buffer[at].symbol() == "#",
                "{columns}x{rows} draws at {at}"
            );
        }
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        let _ = self.orders.send(Order::Quit);
        if let Some(worker) = self.worker.take() {
            let _ = worker.join();
        }
    }
}

#[test]
fn no_size_makes_it_fail() {
    let columns = (20..=220).step_by(9).chain([1, 39, 40, 80, 109, 110]);
    let rows = (5..=60).step_by(5).chain([1, 9, 11, 24]);
    let sizes: Vec<(u16, u16)> = columns
        .flat_map(|columns| rows.clone().map(move |rows| (columns, rows)))
        .collect();
    for keys in [
        ",,",
        "z",
        "<Tab>z",
        "<Tab>z",
        "<Tab>z",
        "<Tab>z",
        "<Tab>z",
        "?",
        "jjjjjjjj",
        "<Esc>zp",
        "kk",
        "<Esc>",
        "L<Tab>L<Tab>L<Tab>L<Tab>L",
        "zm",
    ]
    .iter()
    .scan(Stage::new("li2019-fig3", Marker::Braille), |stage, keys| {
        stage.press(keys);
        for &(columns, rows) in &sizes {
            stage.draw(columns, rows);
        }
        Some(keys)
    }) {
        assert!(parse_script(keys).is_ok());
    }
}

#[test]
fn no_size_makes_any_preset_fail() {
    for (i, preset) in preset::ALL.iter().enumerate() {
        let markers = [
            Marker::Ascii,
            Marker::Dot,
            Marker::HalfBlock,
            Marker::Braille,
        ];
        let mut stage = Stage::new(preset.name, markers[i % markers.len()]);
        for keys in ["", ".", ",", "L<Tab>L<Tab>L<Tab>L<Tab>L"] {
            stage.press(keys);
            for (columns, rows) in [(20, 5), (40, 10), (43, 13), (80, 24), (131, 17), (220, 60)] {
                stage.draw(columns, rows);
            }
        }
    }
}

#[test]
fn the_printed_screen_has_the_size_asked_for() {
    let desk = desk();
    for columns in [1, 20, 39, 40, 57, 80, 110, 163, 220] {
        for rows in [1, 5, 10, 24, 60] {
            shot(desk.path(), "li2019-fig3", ",", (columns, rows));
        }
    }
}
