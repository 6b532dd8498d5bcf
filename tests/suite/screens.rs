//! Screens: a few that show much are pinned, all others must fit their size and not fail.
//!
//! Keys are played by `--keys`, and the screen comes from `--print`, so no terminal is needed. The
//! pinned screens are in `snapshots/`; `INSTA_UPDATE=always cargo test screens::` rewrites them, to
//! be reviewed before they are kept.

use std::sync::Arc;
use std::time::Duration;

use crate::common::{Explorer, LiveWorker, begin, load, ran, rehearsed as shot, rehearsed_on};
use crate::screen_table::{hold, pin, words_of};
use crate::test_dir::{TestDir, has, lacks};
use mdr_tui::plot::theme::{Look, Theme};
use mdr_tui::plot::{Marker, Scale};
use mdr_tui::scenario::preset;
use mdr_tui::tui::app::App;
use mdr_tui::tui::command::{self, COMMANDS, Command};
use mdr_tui::tui::event::Event;
use mdr_tui::tui::frame::{Activity, Frame};
use mdr_tui::tui::keys::{Keystroke, Named, parse_script};
use mdr_tui::tui::manual;
use mdr_tui::tui::mouse::Gesture;
use mdr_tui::tui::panels::Panel;
use mdr_tui::tui::worker::Order;
use mdr_tui::tui::worker::pace::Pace;
use mdr_tui::tui::{screen, tour};
use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Position, Rect, Size};
use ratatui::text::Line;

/// Small to large screens.
const SIZES: [(usize, usize); 4] = [(60, 18), (80, 24), (120, 40), (200, 50)];

#[test]
fn screens_are_as_the_table_says() {
    hold("screens", |_| {});
}

#[test]
fn a_second_method_lies_over_the_plots() {
    let text = shot("li2019-fig3", ",,,,C", (80, 24));
    // The time per step is another on every machine.
    let lines = text
        .lines()
        .map(|line| line.split("time per step").next().unwrap_or_default());
    pin(
        "suite__screens__compared-80x24",
        &lines.collect::<Vec<_>>().join("\n"),
    );
    for size in SIZES {
        let text = shot("li2019-fig3", ",,,,Cz", size);
        has(&text, "┈ B, N = 100");
    }
}

#[test]
fn a_cut_through_the_bodies() {
    let text = shot("hertz", ",,:focus cross-section<Enter>z", (81, 24));
    for line in panels(&text).iter().skip(4).take(12) {
        // Left and right are alike.
        let line: Vec<char> = format!("{line:81}").chars().collect();
        assert!(line.iter().eq(line.iter().rev()), "{text}");
    }
}

#[test]
fn a_click_on_the_timeline_travels_there() {
    let mut stage = explorer("li2019-fig3");
    stage.app.explorer.resize(Size::new(100, 30));
    stage.press(",,,,,,,,");
    // 89 columns for 199.24 cycles.
    for (column, cycle, present) in [(4, 3.0, Some(8.0)), (60, 8.0, None)] {
        stage.app.point(Gesture::Click(Position::new(column, 1)));
        stage.press("<Esc>");
        let frame = stage.app.explorer.frame.clone();
        let seen = (frame.live.observation.moment.cycle, frame.present);
        assert_eq!(seen, (cycle, present));
    }
}

/// It begins slowly and speeds up, but not so much that the run would be over in a moment.
#[test]
fn a_lecture_speeds_up_by_itself() {
    let stage = explorer("li2019-fig3");
    let mut frame = Frame::clone(&stage.frame());
    let theme = Theme::new(Look::Dark, Marker::Braille);
    let mut app = App::new(theme, stage.worker.orders.clone(), stage.frame());
    app.explorer.stage.present();
    let (running, paused) = (Activity::Running, Activity::Paused);
    for (at, cycle, activity, rises) in [
        (0.5, 0.0, &running, false),
        (0.5, 3.9, &running, false),
        (0.5, 4.1, &running, true),
        (0.5, 4.2, &running, false),
        (1.0, 4.3, &running, false),
        (1.0, 12.2, &running, false),
        (1.0, 12.4, &running, true),
        (5.0, 20.0, &running, false),
        (5.0, 90.0, &running, false),
        (0.5, 91.0, &paused, false),
        (0.5, 99.0, &paused, false),
    ] {
        frame.live.observation.moment.cycle = cycle;
        frame.pace = at;
        frame.activity = activity.clone();
        let before = stage.frame().pace;
        app.explorer.show_frame(Arc::new(frame.clone()));
        let has_risen = stage.frame().pace != before;
        assert_eq!(has_risen, rises, "at cycle {cycle}, {at} a second");
    }
}

/// The indenter follows its motion.
#[test]
fn the_indenter_moves_with_every_step() {
    let flank = |steps: usize| {
        let keys = format!("V,{}", ".".repeat(steps));
        let text = shot("gross-slip", &keys, (100, 30));
        let line = panels(&text)[8].to_owned();
        line.chars().take_while(|c| *c == ' ').count()
    };
    // A quarter and three quarters of a cycle: far to the right, far to the left.
    let [right, left] = [flank(25), flank(75)];
    assert!(right >= left + 4, "{right} {left}");
}

/// How a script spells a key.
fn spelled(key: Keystroke) -> String {
    match key {
        Keystroke::Char('<') => "<lt>".into(),
        Keystroke::Char(' ') => "<Space>".into(),
        Keystroke::Char(character) => character.into(),
        Keystroke::Ctrl(character) => format!("<C-{character}>"),
        Keystroke::Named(Named::BackTab) => "<S-Tab>".into(),
        Keystroke::Named(_) => format!("<{key}>"),
    }
}

#[test]
fn every_key_of_the_table_can_be_pressed() {
    let keys = COMMANDS.iter().flat_map(|row| row.keys);
    let all: Vec<String> = keys.map(|&key| spelled(key)).collect();
    assert!(all.len() >= 30);
    for key in ["t", "c", "a"] {
        assert!(all.iter().any(|bound| bound == key), "{key} calls nothing");
    }
    let start = begin(load("li2019-fig3", &[]));
    // What writes files needs a directory.
    let writes = |key: &str| ["s", "S"].contains(&key);
    for key in &all {
        for before in ["", ",a"] {
            let keys = format!("{before}{key}");
            match writes(key) {
                true => TestDir::new().screen(&["li2019-fig3"], &keys, (80, 24)),
                false => rehearsed_on(start.clone(), &keys, (80, 24)),
            };
        }
    }
    // All of them, in the table's order and backwards, up to the first that quits.
    let quits = |key: &String| {
        let called = command::of_key(parse_script(key).expect("a key")[0]);
        matches!(called, Some(Command::Quit | Command::QuitKeepingScreen))
    };
    let mut keys: Vec<String> = all.into_iter().filter(|key| !quits(key)).collect();
    let dir = TestDir::new();
    dir.screen(&["li2019-fig3"], &keys.concat(), (80, 24));
    keys.reverse();
    dir.screen(&["li2019-fig3"], &keys.concat(), (80, 24));
}

/// The explorer on a preset.
fn explorer(preset: &str) -> Explorer {
    Explorer::on(preset, Theme::new(Look::Dark, Marker::Braille))
}

/// Draws at `columns` by `rows`, within a larger buffer that must stay clean around it.
fn draw(app: &App, columns: u16, rows: u16) -> String {
    let mut buffer = Buffer::empty(Rect::new(0, 0, columns + 2, rows + 2));
    for cell in &mut buffer.content {
        cell.set_char('#');
    }
    let area = Rect::new(1, 1, columns, rows);
    screen::draw(app, area, &mut buffer);
    for at in buffer.area.positions() {
        let is_clean = area.contains(at) || buffer[at].symbol() == "#";
        assert!(is_clean, "{columns}x{rows} draws at {at}");
    }
    buffer.content.iter().map(Cell::symbol).collect()
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

#[test]
fn the_help_has_one_key_a_row_by_groups() {
    // On a large screen all of it, on a small one by scrolling.
    let large = shot("li2019-fig3", "?", (200, 50));
    let pages = [0, 15, 30, 45, 60]
        .map(|rows| shot("li2019-fig3", &format!("?{}", "j".repeat(rows)), (80, 24)));
    for text in [large, pages.concat()] {
        for (group, rows) in manual::groups() {
            let titles = [format!("│ {group} "), format!("  {group}  ")];
            assert!(titles.iter().any(|title| text.contains(title)), "{group}");
            for row in rows {
                let keys = row.key_names().join(" ");
                has(&text, &format!(" {keys}  {}", row.help));
            }
        }
    }
}

#[test]
fn a_panel_is_explained_where_it_stands() {
    let shot = |keys: &str| shot("li2019-fig3", keys, (80, 24));
    // The explanation follows the focus, and does not cover the panel itself.
    for panel in Panel::ALL {
        let focus = format!(":focus {}<Enter>", panel.recipe().title);
        let text = shot(&format!(",{focus}<Enter>"));
        has(&text, &format!("┌ {} (", panel.recipe().title));
        let plain = shot(&format!(",{focus}"));
        let is_same = |line: &&str| text.lines().any(|seen| seen == *line);
        assert!(plain.lines().filter(is_same).count() >= 12, "{text}");
        let symbols = panel.recipe().symbols;
        has(&words_of(&text), symbols.last().expect("a symbol").1);
    }
}

#[test]
fn every_tour_can_be_walked_to_its_end() {
    for preset in preset::ALL {
        let captions = tour::captions(preset.name);
        let mut stage = explorer(preset.name);
        stage.press("<Esc>");
        for caption in captions {
            stage.press("n");
            // The caption is there, and the panel that it is about has the focus.
            let tour = stage.app.explorer.stage.tour.as_ref();
            assert_eq!(tour.map(tour::Tour::caption), Some(caption));
            let panel = caption.panel().unwrap_or(stage.app.explorer.stage.focus);
            assert_eq!(stage.app.explorer.stage.focus, panel, "{caption:?}");
            draw(&stage.app, 80, 24);
        }
        stage.press("n");
        assert_eq!(stage.app.explorer.stage.tour, None);
        stage.press("n<Esc>");
        assert_eq!(stage.app.explorer.stage.tour, None);
    }
}

#[test]
fn the_status_line_has_fixed_slots() {
    let places = |keys: &str| {
        let text = shot("li2019-fig3", keys, (120, 24));
        let status = text.lines().next().expect("a status line").to_owned();
        let bars = status.chars().enumerate().filter(|(_, c)| *c == '│');
        bars.map(|(at, _)| at).take(4).collect::<Vec<_>>()
    };
    let first = places(",");
    assert_eq!(first.len(), 4);
    for keys in [",,", ",,,,,,,,,,", ",m", ",mm.", ",---"] {
        assert_eq!(places(keys), first, "{keys}");
    }
}

/// The phase of the motion is shown only for a run that is shown at one phase.
#[test]
fn no_phase_is_told_when_the_run_is_done() {
    let mut stage = explorer("li2019-fig3");
    let mut frame = Frame::clone(&stage.frame());
    frame.shows_ends = true;
    for activity in [Activity::Running, Activity::Paused, Activity::Done] {
        frame.activity = activity.clone();
        stage.app.explorer.show_frame(Arc::new(frame.clone()));
        let is_told = draw(&stage.app, 120, 24).contains("phase 0°");
        assert_eq!(is_told, activity == Activity::Running, "{activity:?}");
    }
}

/// A preset may ask for a logarithmic scale; the user has the last word, and another scenario its own.
#[test]
fn a_preset_asks_for_a_logarithmic_scale() {
    let mut stage = explorer("mild-million");
    stage.press(".");
    assert_eq!(stage.app.explorer.charts.scale(Panel::Volume), Scale::Log);
    assert_eq!(stage.app.explorer.charts.scale(Panel::Radii), Scale::Linear);
    stage.app.explorer.stage.focus = Panel::Volume;
    stage.press("L,");
    assert_eq!(
        stage.app.explorer.charts.scale(Panel::Volume),
        Scale::Linear
    );
    let mut other = explorer("li2019-fig3");
    other.press(".");
    assert_eq!(
        other.app.explorer.charts.scale(Panel::Volume),
        Scale::Linear
    );
}

/// A run of 20 cycles.
const SHORT: [&str; 2] = ["li2019-fig3", "--set=run.cycles=20"];

/// Where a legend has no room next to the curves, their names stand at their ends.
#[test]
fn a_small_panel_hides_no_curve_behind_its_names() {
    let dir = TestDir::new();
    let text = dir.screen(&SHORT, &",".repeat(19), (60, 18));
    let rows = text
        .lines()
        .skip_while(|line| !line.contains("radii over cycles"));
    let panel: String = rows
        .map(|row| row.chars().skip(31).collect::<String>() + "\n")
        .collect();
    has(&panel, "stick c");
    has(&panel, "contact a");
    lacks(&panel, "╌ stick c");
    // The last dashes of c are there, at the right end.
    let dashes = panel.lines().filter(|row| row.contains("⠤⠤")).count();
    assert!(dashes > 0, "{panel}");
}

#[test]
fn a_comparison_can_begin_at_the_start() {
    // It is the run of that method: the same numbers as in a separate run.
    let keys = ",,,,,,C:focus wear volume<Enter>x";
    let text = shot("strong-wear", keys, (200, 50));
    let alone = ran(load("strong-wear", &["numerics.method=b"]), 6.0);
    let volume = alone.simulation().moment().wear_volume;
    let shown = mdr_tui::plot::units::format_value(volume, "m³", 4);
    has(
        line_with(&text, " now  V"),
        &format!(" B, N = 100 {shown} ("),
    );
}

/// A worker that runs for so many cycles.
fn live(scenario: &str, cycles: f64) -> LiveWorker {
    let scenario = load(scenario, &[&format!("run.cycles={cycles}")]);
    LiveWorker::on(scenario, Duration::from_millis(20), true)
}

/// A fast run is shown at one phase of the motion: frames as they come would be a stroboscope.
#[test]
fn fast_runs_are_shown_at_one_phase() {
    let worker = live("li2019-fig3", 1e6);
    let (orders, events) = (&worker.orders, &worker.events);
    let frames = |wanted: usize| {
        let mut seen = Vec::new();
        while seen.len() < wanted {
            let event = events.recv_timeout(Duration::from_secs(30));
            let event = event.expect("a frame");
            if let Event::Frame(slot) = event {
                seen.extend(slot.take());
            }
        }
        seen
    };
    assert_eq!(frames(1)[0].pace, 0.5);
    // To 20 cycles per second.
    orders.send(Order::Pace(5));
    // What was on the way, and the answer to the order.
    frames(3);
    for frame in frames(8) {
        let part = frame.live.observation.moment.cycle.fract();
        assert!(frame.shows_ends);
        assert!(part < 0.011, "{part}");
    }
    orders.send(Order::Run(Pace::hold_or_release_phase));
    frames(3);
    let is_off = |frame: &Frame| frame.live.observation.moment.cycle.fract() > 0.05;
    assert!(frames(8).iter().any(|frame| is_off(frame)));
}

/// A run slow enough to watch shows each end of a cycle, whenever else frames are due: the stress of the large contact,
/// which is held for a cycle, is of one phase.
#[test]
fn slow_runs_show_the_end_of_each_cycle() {
    let never = Duration::from_secs(3600);
    let worker = LiveWorker::on(load("li2019-fig3", &[]), never, true);
    worker.orders.send(Order::Pace(2));
    let mut ends = Vec::new();
    while ends.len() < 2 {
        let event = worker.events.recv_timeout(Duration::from_secs(30));
        if let Event::Frame(slot) = event.expect("a frame") {
            let cycles = slot.take().map(|frame| frame.live.observation.moment.cycle);
            ends.extend(cycles.filter(|cycle| *cycle > 0.5));
        }
    }
    let off = |cycle: &f64| (cycle - cycle.round()).abs() > 1e-9;
    assert!(!ends.iter().any(off), "{ends:?}");
    assert!(ends[1] > ends[0]);
}

/// Space at the planned end runs on only when pressed twice.
#[test]
fn space_at_the_end_asks_first() {
    let worker = live("hertz", 0.2);
    let (orders, events) = (&worker.orders, &worker.events);
    let next = || events.recv_timeout(Duration::from_secs(30));
    let until = |activity: Activity| loop {
        if let Event::Frame(slot) = next().expect("a frame")
            && slot.take().is_some_and(|frame| frame.activity == activity)
        {
            break;
        }
    };
    until(Activity::Done);
    orders.send(Order::Run(Pace::run_or_pause));
    let notice = loop {
        match next().expect("a notice") {
            Event::Notice(text) => break text,
            Event::Frame(slot) => assert!(slot.take().is_none_or(|f| f.activity == Activity::Done)),
            _ => {}
        }
    };
    has(&notice, "planned end");
    orders.send(Order::Run(Pace::run_or_pause));
    until(Activity::Running);
}

#[test]
fn the_accuracy_panel_waits_for_the_twin_and_shows_what_it_tells() {
    let text = shot("li2019-fig3", ",,a", (80, 24));
    for (meaning, largest) in [
        ("V of the profile against k E_d since the start", 5e-3),
        ("error of the worn depth", 1e-2),
        ("error of the worn volume", 1e-2),
        ("error of the deepest wear", 2e-2),
        ("error of the friction work", 1e-2),
        ("error of F_x", 1e-2),
        ("error of the loop's area", 1e-2),
        ("error of p away from borders", 5e-2),
        ("error of the stick radii", 1e-2),
    ] {
        let line = line_with(&text, meaning);
        let (before, _) = line.split_once(meaning).expect(meaning);
        let number = before.split_whitespace().last().expect(meaning);
        let found: f64 = number.parse().expect(meaning);
        assert!(found != 0.0 && found.abs() < largest, "{meaning}: {found}");
    }
}

/// After jumps the screen tells of one contact: what slides as a whole does not stick now either, and has a loop.
#[test]
fn after_a_jump_every_panel_tells_of_the_same_cycle() {
    let text = shot("julia2022-gross-slip", ",,,,,,", (120, 40));
    for radius in ["stick radius now", "permanent stick radius c"] {
        assert!(
            line_with(&text, radius).contains(" 0 m"),
            "{radius}: {text}"
        );
    }
    assert!(
        text.contains("regime") && text.contains("gross slip"),
        "{text}"
    );
    // The force of the loop reaches both ways; without a loop its axis would end at zero.
    let forces = text.lines().filter(|line| line.contains(" -50┤"));
    assert!(forces.count() > 0, "{text}");
}

#[test]
fn the_status_line_begins_sensibly_however_narrow() {
    for columns in (40..=130).step_by(5).chain([49, 59, 79, 99]) {
        let text = shot("li2019-fig3", ",,", (columns, 10));
        let status = text.lines().next().expect("a status line");
        assert!(status.starts_with(" ‖ paused "), "{columns}: {status}");
        let parts: Vec<&str> = status.split('│').map(str::trim).collect();
        let is_told = parts[1].starts_with("cycle 2.00/199.24");
        assert!(is_told, "{columns}: {status}");
        // The pace stays longer than method, checks and law.
        let pace = parts.get(2).and_then(|part| part.split("  ").next());
        let is_told = columns < 50 || pace == Some("0.5 cycles/s");
        assert!(is_told, "{columns}: {status}");
        let method = match columns {
            80.. => "│ method: product",
            60.. => "│ product",
            _ => "",
        };
        assert!(status.contains(method), "{columns}: {status}");
        // The title fills what is left, whole or begun.
        let whole = "Dual oscillation of a paraboloid";
        let end = status.find("Dual").map_or("", |at| &status[at..]);
        let begun = end.strip_suffix("..").unwrap_or(end);
        let is_whole = end.is_empty() || end == whole || begun != end;
        assert!(is_whole && whole.starts_with(begun), "{columns}: {status}");
        // The estimated error has precedence over the note that nothing is wrong.
        if columns >= 80 {
            has(status, "wear ±0.");
        }
        if columns >= 100 {
            has(status, "checks ok");
        }
    }
}

#[test]
fn a_title_of_wide_characters_stays_within_the_screen() {
    let dir = TestDir::new();
    let title =
        "title=接触\u{1b}[31mの摩耗 𝒻 é e\u{301} 👩\u{200d}🔬 — längerer Titel als Platz ist";
    for locale in ["C", "C.UTF-8"] {
        for columns in [1, 7, 20, 40, 80, 110, 200] {
            for keys in [",", ",s"] {
                let text = dir.screen_in(locale, &["--set", title], keys, (columns, 24));
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
fn no_size_makes_it_fail() {
    // The smallest, the limits of each layout, and a large one.
    let columns = [1, 20, 39, 40, 80, 109, 110, 220];
    let sizes: Vec<(u16, u16)> = columns
        .into_iter()
        .flat_map(|columns| [1, 9, 11, 24, 60].map(|rows| (columns, rows)))
        .collect();
    let script = ",,|z|<Tab>z|<Tab>z|<Tab>z|<Tab>z|<Tab>z|?|jjjjjjjj|<Esc>zp|kk|<Esc>|L<Tab>L<Tab>L<Tab>L<Tab>L|zm|t|c,|mmmm.|ct|\
                  cxhh|vz|lz|x[|]e|jjjj7|<Esc><Esc>:|set num|<Esc>S|note|<Esc>/wear";
    let mut stage = explorer("li2019-fig3");
    for keys in script.split('|') {
        stage.press(keys);
        for &(columns, rows) in &sizes {
            draw(&stage.app, columns, rows);
        }
    }
}

#[test]
fn no_size_makes_any_preset_fail() {
    for (i, preset) in preset::ALL.iter().enumerate() {
        let mut stage = explorer(preset.name);
        stage.app.explorer.theme.marker = match i % 4 {
            0 => Marker::Ascii,
            1 => Marker::Dot,
            2 => Marker::HalfBlock,
            _ => Marker::Braille,
        };
        let first = draw(&stage.app, 80, 24);
        assert!(
            !first.contains("u_x [m]"),
            "{}: an axis of a metre\n{first}",
            preset.name
        );
        for keys in ["", ".", ",", "t", "c.", "c", "L<Tab>L<Tab>L<Tab>L<Tab>L"] {
            stage.press(keys);
            for (columns, rows) in [(20, 5), (43, 13), (131, 17)] {
                draw(&stage.app, columns, rows);
            }
        }
    }
}
