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
use mdr_tui::tui::frame::Slot;
use mdr_tui::tui::keys::{Key, Named, parse_script};
use mdr_tui::tui::order::Order;
use mdr_tui::tui::panels::Panel;
use mdr_tui::tui::plot::Marker;
use mdr_tui::tui::theme::{Look, Theme};
use mdr_tui::tui::worker::Worker;
use mdr_tui::tui::{Event, screen};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;
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
fn more_panels() {
    pin("more", "li2019-fig3", ",,,,v");
}

#[test]
fn a_cut_through_the_bodies() {
    pin("section", "strong-wear", ",,,,,,,,,vz");
    let desk = desk();
    let text = shot(desk.path(), "li2019-fig3", ",,vz", (81, 24));
    for line in panels(&text).iter().skip(4).take(12) {
        // Left and right are alike.
        let line: Vec<char> = format!("{line:81}").chars().collect();
        assert!(line.iter().eq(line.iter().rev()), "{text}");
    }
}

#[test]
fn nine_panels_on_a_middling_screen() {
    let desk = desk();
    let text = shot(desk.path(), "gross-slip", ",,,", (120, 40));
    insta::assert_snapshot!("gross-slip-120x40", text);
}

#[test]
fn panels_come_in_pages() {
    let desk = desk();
    let shot = |keys: &str, size| shot(desk.path(), "li2019-fig3", keys, size);
    let first = shot(",", (80, 24));
    assert!(first.contains("fretting loop") && !first.contains("wear rate"));
    let second = shot(",v", (80, 24));
    assert!(second.contains("wear rate") && !second.contains("fretting loop"));
    assert_eq!(shot(",vv", (80, 24)), first);
    // Tab walks over the page's end; the page follows the focus.
    assert_eq!(shot(",<Tab><Tab><Tab><Tab><Tab><Tab>", (80, 24)), second);
    // A large screen has them all.
    let all = shot(",", (200, 50));
    for panel in Panel::ALL {
        assert!(all.contains(panel.title()), "{panel:?}");
    }
    assert_eq!(shot(",v", (200, 50)), all);
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
    assert!(all.len() >= 30);
    for key in ["t", "c", "a"] {
        assert!(all.iter().any(|bound| bound == key), "{key} calls nothing");
    }
    for key in &all {
        for before in ["", ",", "?", "p", "z", "c", "a"] {
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
    for (i, keys) in [
        ",m,s",
        "...........m....W...M..w,.s",
        ",mmmm,s",
        "ww.,M.,,s",
    ]
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
            assert!(state.contains("\n# method: a\n"), "{state}");
            assert!(
                state.contains("\n# at cycle 1: numerics.method = \"a\"\n"),
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
            app: App::new(Theme::new(Look::Dark, marker), orders.clone()),
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

/// The panels' part of a screen, without the status line and the line of keys.
fn panels(text: &str) -> Vec<&str> {
    let lines: Vec<&str> = text.lines().collect();
    lines[1..lines.len() - 1].to_vec()
}

/// The one line of a screen that has `word` in it.
fn line_with<'a>(text: &'a str, word: &str) -> &'a str {
    let mut lines = text.lines().filter(|line| line.contains(word));
    let line = lines.next();
    assert!(lines.next().is_none(), "{word} is there twice:\n{text}");
    line.unwrap_or_else(|| panic!("no {word} in\n{text}"))
}

/// The relative difference in a line of the accuracy panel.
fn difference(text: &str, meaning: &str) -> f64 {
    let line = line_with(text, meaning);
    let number = line
        .split(meaning)
        .next()
        .and_then(|before| before.split_whitespace().last());
    number
        .and_then(|number| number.parse().ok())
        .unwrap_or_else(|| panic!("no number in {line:?}"))
}

#[test]
fn the_help_shows_every_key_in_80_by_24_without_scrolling() {
    let desk = desk();
    let text = shot(desk.path(), "li2019-fig3", "?", (80, 24));
    assert!(text.contains(" keys (Esc closes) "), "{text}");
    let lines = panels(&text);
    for key in BINDINGS.iter().flat_map(|binding| binding.keys) {
        let name = key.to_string();
        let is_there = lines.iter().any(|line| {
            let inside = line
                .split('│')
                .find(|part| part.contains("  "))
                .unwrap_or("");
            line.split_whitespace()
                .chain(inside.split_whitespace())
                .any(|word| word == name)
        });
        assert!(is_there, "{name} is not in\n{text}");
    }
    for binding in [
        "leave; Ctrl-C leaves",
        "leave, and leave the last screen",
        "this help",
    ] {
        assert!(text.contains(binding), "{binding} is not in\n{text}");
    }
}

#[test]
fn theory_over_the_plots() {
    pin("theory", "li2019-fig3", ",,,t");
}

#[test]
fn theory_comes_and_goes() {
    let desk = desk();
    let shot = |keys: &str| shot(desk.path(), "li2019-fig3", keys, (80, 24));
    let (plain, with, without) = (shot(",,"), shot(",,t"), shot(",,tt"));
    assert_ne!(plain, with);
    assert_eq!(plain, without);
    // Zoomed, each curve is named.
    let zoomed = shot(",,tz");
    assert!(zoomed.contains("limit"), "{zoomed}");
    assert!(!shot(",,z").contains("limit"));
    let stresses = shot(",,t<Tab>z");
    assert!(stresses.contains("unworn p"), "{stresses}");
    assert!(!shot(",,<Tab>z").contains("unworn p"));
}

#[test]
fn a_comparison_sets_a_rival_beside_the_run() {
    let desk = desk();
    let shot = |keys: &str| shot(desk.path(), "li2019-fig3", keys, (80, 24));
    let before = shot(",,,");
    let mut seen = Vec::new();
    for (keys, rival) in [
        (",,c,", "b 100"),
        (",,cm,", "a 100"),
        (",,cmm,", "a+b 100"),
        (",,cmmm,", "benad 100"),
        (",,cmmmm,", "product 50"),
        (",,cmmmmm,", "b 100"),
        (",,cM,", "product 50"),
    ] {
        let text = shot(keys);
        for title in ["pressure", "difference of f", "both"] {
            assert!(text.contains(title), "{keys}: {title}\n{text}");
        }
        let title = format!(" 3D profile: product 100 and {rival} ");
        assert!(text.contains(&title), "{keys}:\n{text}");
        // The run itself is what it was: m has changed the rival only.
        assert_eq!(text.lines().next(), before.lines().next(), "{keys}");
        // Both columns of numbers are whole.
        let names = line_with(&text, &format!("product 100  {rival:>10}"));
        assert!(names.ends_with(rival), "{text}");
        for name in [
            "stick c ",
            "contact a ",
            "worn volume ",
            "1 - V/(k E_d)",
            "rms difference",
        ] {
            line_with(&text, name);
        }
        for (name, unit) in [
            ("stick c ", "µm"),
            ("contact a ", "µm"),
            ("worn volume ", "µm³"),
        ] {
            let line = line_with(&text, name);
            assert!(line.ends_with(&format!(" {unit}")), "{line}");
            assert_eq!(line.matches(&format!(" {unit}")).count(), 2, "{line}");
        }
        seen.push(line_with(&text, "rms difference").to_owned());
    }
    // Once around, the rival is the first again; each of the others differs by an amount of its own.
    assert_eq!(seen[0], seen[5]);
    assert_eq!(seen[4], seen[6]);
    let mut distinct = seen[..5].to_vec();
    distinct.sort();
    distinct.dedup();
    assert_eq!(distinct.len(), 5, "{seen:?}");
    // A comparison leaves no trace.
    assert_eq!(shot(",,cm,c"), before);
}

#[test]
fn the_accuracy_panel_waits_for_the_companion_and_shows_what_it_found() {
    let desk = desk();
    let shot = |keys: &str| shot(desk.path(), "li2019-fig3", keys, (80, 24));
    let text = shot(",,,a");
    assert!(text.contains(" accuracy (Esc closes) "), "{text}");
    assert!(!text.contains("running ..."), "{text}");
    line_with(&text, "   50 cells, to cycle 3.00, in ");
    for (meaning, largest) in [
        ("V against k E_d over the last period", 5e-3),
        ("F_z of the springs against", 5e-3),
        ("permanent stick radius against theory", 5e-2),
        ("V of the profile against k E_d since the start", 5e-3),
        ("rms difference of f", 1e-4),
        ("permanent stick radius  ", 5e-2),
        ("worn volume", 5e-2),
        ("so about this much error of f", 1e-4),
    ] {
        let found = difference(&text, meaning);
        assert!(found != 0.0 && found.abs() < largest, "{meaning}: {found}");
    }
    let ratio = difference(&text, "rms difference of f")
        / difference(&text, "so about this much error of f");
    assert!((ratio - 3.0).abs() < 0.2, "{ratio}");
    // The run goes on below it, and it closes without a trace.
    assert!(shot(",a,,").contains(" accuracy "));
    assert_eq!(shot(",,,a<Esc>"), shot(",,,"));
    assert_eq!(shot(",,,aa"), shot(",,,"));
}

#[test]
fn the_status_line_begins_sensibly_however_narrow() {
    let desk = desk();
    for columns in 40..=130 {
        let text = shot(desk.path(), "li2019-fig3", ",,", (columns, 10));
        let status = text.lines().next().expect("a status line");
        assert!(status.ends_with("⏸ paused"), "{columns}: {status}");
        let parts: Vec<&str> = status.split('│').map(str::trim).collect();
        assert!(parts.contains(&"cycle 2.00/199.24"), "{columns}: {status}");
        let method = parts[0];
        let titled = method.strip_suffix("product").map(str::trim);
        let title = titled.unwrap_or_else(|| panic!("{columns}: {status}"));
        let whole = "Dual oscillation of a paraboloid";
        let is_begun = title
            .strip_suffix("..")
            .is_some_and(|begun| whole.starts_with(begun));
        assert!(
            title.is_empty() || title == whole || is_begun,
            "{columns}: {status}"
        );
        if columns >= 80 {
            assert!(
                parts.iter().any(|part| part.starts_with("trust 99.")),
                "{status}"
            );
        }
    }
    let text = shot(desk.path(), "li2019-fig3", ",,", (40, 10));
    let status = text.lines().next().map(str::trim);
    assert_eq!(status, Some("product │ cycle 2.00/199.24 │ ⏸ paused"));
}

#[test]
fn a_title_of_wide_characters_stays_within_the_screen() {
    let desk = desk();
    let title =
        "title=接触\u{1b}[31mの摩耗 𝒻 é e\u{301} 👩\u{200d}🔬 — längerer Titel als Platz ist";
    for locale in ["C", "C.UTF-8"] {
        for columns in (1..=200).step_by(7).chain([40, 80, 110]) {
            let print = format!("{columns}x24");
            for keys in [",", ",s"] {
                let output = Command::new(env!("CARGO_BIN_EXE_mdr-tui"))
                    .args(["--set", title, "--keys", keys, "--print", &print])
                    .current_dir(desk.path())
                    .env("LC_ALL", locale)
                    .stdin(Stdio::null())
                    .output()
                    .expect("the program starts");
                let text = checked(output, (columns, 24), &format!("{locale} {keys}"));
                assert!(locale != "C" || text.is_ascii(), "{text}");
                for line in text.lines() {
                    let width = Line::raw(line).width();
                    assert!(width <= columns, "{width} of {columns} columns: {line}");
                }
            }
        }
    }
}

#[test]
fn a_file_with_a_wide_name_is_told_in_ascii_where_it_must_be() {
    let desk = desk();
    let text = preset::find("hertz").expect("a preset").text;
    fs::write(desk.path().join("接触.toml"), text).expect("a file");
    let output = Command::new(env!("CARGO_BIN_EXE_mdr-tui"))
        .args(["接触.toml", "--keys", ",s", "--print", "80x24"])
        .current_dir(desk.path())
        .env("LC_ALL", "C")
        .stdin(Stdio::null())
        .output()
        .expect("the program starts");
    let text = checked(output, (80, 24), "a wide name");
    assert!(text.is_ascii(), "{text}");
    assert!(text.contains(" snapshot in ??-cycle-1"), "{text}");
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
        "t",
        "c,",
        "mmmm.",
        "ct",
        "cxhh",
        "vz",
        "lz",
        "x[",
        "]e",
        "jjjj7",
        "<Esc><Esc>:",
        "set num",
        "<Esc>S",
        "note",
        "<Esc>/wear",
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
        for keys in ["", ".", ",", "t", "c.", "c", "L<Tab>L<Tab>L<Tab>L<Tab>L"] {
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
