//! What the screen says is what the run is: numbers read off the screen against the state behind it.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::common::{Explorer, begin, load, rehearsed_on};
use crate::test_dir::has;
use mdr_tui::plot::Marker;
use mdr_tui::plot::theme::{Depth, Look, Role, Theme};
use mdr_tui::reading::Column;
use mdr_tui::reading::subsurface::Stress;
use mdr_tui::tui::frame::Frame;
use mdr_tui::tui::keys::Keystroke;
use mdr_tui::tui::{screen, text};
use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Rect, Size};

const DARK: Theme = Theme {
    look: Look::Dark,
    depth: Depth::Indexed,
    marker: Marker::Braille,
    follows_background: false,
};

fn explorer(preset: &str, size: (u16, u16), theme: Theme) -> Explorer {
    let mut explorer = Explorer::on(preset, theme);
    explorer.app.explorer.resize(size.into());
    explorer
}

fn shown(explorer: &Explorer, size: (u16, u16)) -> String {
    text(&explorer.app, Size::from(size))
}

/// A number and its unit, in SI.
fn si(number: &str, unit: &str) -> f64 {
    let number: f64 = number.parse().unwrap_or_else(|_| panic!("{number} {unit}"));
    let factors = [
        ("n", 1e-9),
        ("µ", 1e-6),
        ("m", 1e-3),
        ("k", 1e3),
        ("M", 1e6),
        ("G", 1e9),
    ];
    let prefix = factors
        .into_iter()
        .find(|(prefix, _)| unit.len() > prefix.len() && unit.starts_with(prefix));
    number * prefix.map_or(1.0, |(_, factor)| factor)
}

/// The number behind a name on the screen, and the unit behind that.
fn value(screen: &str, name: &str) -> f64 {
    let (_, behind) = screen
        .split_once(name)
        .unwrap_or_else(|| panic!("no {name} in\n{screen}"));
    let mut words = behind.split_whitespace();
    si(
        words.next().expect("a number"),
        words.next().expect("a unit"),
    )
}

#[test]
fn the_cursor_reads_true_values_of_what_is_drawn_magnified() {
    let size = (120, 40);
    let mut explorer = explorer("li2019-fig3", size, DARK);
    explorer.press(",,,x<Right><Right>z");
    let (screen, frame) = (shown(&explorer, size), explorer.frame());
    let foot = screen.lines().last().expect("a line");
    let r = value(foot, " r ");
    let (_, factor) = screen.split_once("worn ×").expect("a magnification");
    let factor: f64 = factor
        .split_whitespace()
        .next()
        .expect("a number")
        .parse()
        .expect("a number");
    assert!(factor > 1.0);
    let read = value(&screen, &format!("worn ×{factor}"));
    let state = frame.run.states.last().expect("a state");
    let [radii, profile] =
        [Column::Radius, Column::Profile].map(|column| state.column(column).expect("a column"));
    let above = radii.iter().position(|node| *node > r).expect("a node");
    let within = profile[above - 1] * 0.999..=profile[above] * 1.001;
    assert!(
        within.contains(&read),
        "{read} is not in {within:?}\n{screen}"
    );
    // The last line says the same.
    assert!((value(foot, " f ") / read - 1.0).abs() < 1e-3, "{foot}");
}

/// The top of the key of the stress in the cross-section, Pa, and whether larger stresses are cut off.
fn key(screen: &str) -> Option<(f64, bool)> {
    let line = screen.lines().find(|line| line.contains(" von Mises "))?;
    let (_, behind) = line.split_once(" von Mises ")?;
    let words: Vec<&str> = behind.split_whitespace().take(12).collect();
    let at = words.iter().rposition(|word| word.ends_with("Pa"))?;
    Some((si(words[at - 1], words[at]), words.contains(&"≥")))
}

/// The stresses of von Mises that most of the picture has: 90 % of the area under the contact stay below.
fn bulk(frame: &Frame) -> (f64, f64) {
    let load = frame.load.as_ref().expect("a load");
    let step = load.contact_radius() / 40.0;
    let places = (0..40 * 40).map(|k| [k % 40, k / 40].map(|at| (f64::from(at) + 0.5) * step));
    let mut values: Vec<f64> = places.map(|[r, z]| load.stress(r, z).von_mises()).collect();
    values.sort_by(f64::total_cmp);
    let largest = load.largest(Stress::von_mises).value;
    (values[values.len() * 9 / 10], largest)
}

#[test]
fn the_scale_of_the_stress_is_that_of_the_picture_and_holds_for_a_cycle() {
    let size = (100, 30);
    for (preset, most) in [
        ("li2019-fig3", 1),
        ("separation", 2),
        ("flat-punch", 1),
        ("mild-million", 4),
    ] {
        let mut explorer = explorer(preset, size, DARK);
        explorer.press("V,,");
        let mut tops = BTreeSet::new();
        for _ in 0..20 {
            explorer.press(".....");
            let frame = explorer.frame();
            let Some((top, is_cut)) = key(&shown(&explorer, size)) else {
                continue;
            };
            let (bulk, largest) = bulk(&frame);
            assert!(
                is_cut || largest <= 1.01 * top,
                "{preset}: {largest} above {top}"
            );
            assert!(bulk <= 1.2 * top, "{preset}: {bulk} of {top}");
            tops.insert(top.to_bits());
        }
        assert!((1..=most).contains(&tops.len()), "{preset}: {tops:?}");
    }
    // Not flattened by a singular edge.
    let mut explorer = explorer("flat-punch", size, DARK);
    explorer.press("V,.......");
    let (bulk, _) = bulk(&explorer.frame());
    let (top, is_cut) = key(&shown(&explorer, size)).expect("a key");
    assert!(is_cut && top < 4.0 * bulk, "{top} for {bulk}");
}

/// The labels of the ordinate of a zoomed chart.
fn labels(screen: &str) -> Vec<String> {
    let ticks = screen.lines().filter_map(|line| line.split_once('┤'));
    ticks.map(|(label, _)| label.trim().to_owned()).collect()
}

#[test]
fn the_axis_of_stresses_holds_for_a_cycle_and_is_not_that_of_a_spike() {
    let size = (100, 30);
    for preset in ["li2019-fig3", "separation", "flat-punch"] {
        let mut explorer = explorer(preset, size, DARK);
        explorer.press("2z.");
        let mut axes = BTreeSet::new();
        for step in 0..100 {
            explorer.press(".");
            if step % 4 == 0 {
                axes.insert(labels(&shown(&explorer, size)));
            }
        }
        assert!(axes.len() <= 2, "{preset}, first cycle: {axes:?}");
        let before = axes.len();
        for _ in 0..25 {
            explorer.press("....");
            axes.insert(labels(&shown(&explorer, size)));
        }
        assert!(axes.len() <= before + 1, "{preset}: {axes:?}");
        // In the middle the pressure is seen.
        let frame = explorer.frame();
        let pressure = frame.live.observation.pressure()[0];
        let highest = explorer
            .app
            .explorer
            .charts
            .top_of(mdr_tui::tui::panels::Panel::Stresses);
        assert!(
            pressure > 0.1 * highest || pressure == 0.0,
            "{preset}: {pressure} of {highest}"
        );
    }
}

#[test]
fn a_bare_number_is_si_in_every_form() {
    let size = (80, 24);
    for keys in [
        ",etangential.angular<Enter><C-u>100",
        ",:set motion.tangential.angular_frequency=100",
    ] {
        let mut explorer = explorer("li2019-fig3", size, DARK);
        explorer.press(",:set motion.tangential.angular_frequency=90<Enter><Esc>");
        for key in keys
            .chars()
            .skip(1)
            .collect::<String>()
            .split('<')
            .enumerate()
        {
            let script = if key.0 == 0 {
                key.1.to_owned()
            } else {
                format!("<{}", key.1)
            };
            explorer.press(&script);
        }
        has(&shown(&explorer, size), "rad/s, or with a unit");
        explorer.press("<Enter>");
        let frame = explorer.frame();
        let value = frame
            .live
            .scenario
            .value("motion.tangential.angular_frequency");
        assert_eq!(value.as_deref(), Some("100.0"), "{keys}");
    }
    let mut explorer = explorer("li2019-fig3", size, DARK);
    explorer.press(",ewear.coefficient<Enter><C-u>2e-10<Enter>");
    let k = explorer.frame().live.scenario.value("wear.coefficient");
    assert_eq!(k.as_deref(), Some("2e-10"));
    // One unit for one quantity: k in the list and among the numbers.
    has(&shown(&explorer, size), "wear.coefficient");
    has(&shown(&explorer, size), "0.2 mm³/J");
    explorer.press("<Esc><Esc>v2z");
    let screen = shown(&explorer, size);
    let k = screen.split_once("k per friction work").expect("k").1;
    has(k.lines().next().expect("a line"), "0.2000 mm³/J");
}

#[test]
fn without_colours_letters_tell_what_sticks() {
    let size = (100, 30);
    let mono = Theme {
        look: Look::Mono,
        ..DARK
    };
    let mut explorer = explorer("li2019-fig3", size, mono);
    explorer.press("V,,......................");
    let moment = explorer.frame().live.observation.moment;
    let screen = shown(&explorer, size);
    let picture: String = screen
        .lines()
        .take(24)
        .filter(|line| line.contains('█'))
        .collect();
    let [stick, slip] = ['s', '~'].map(|sign| picture.matches(sign).count() as f64);
    let share = moment.stick_radius.expect("a stick radius") / moment.contact_radius;
    assert!(
        (stick / (stick + slip) - share).abs() < 0.15,
        "{stick} {slip} {share}\n{screen}"
    );
    has(&screen, " s sticks ");
    has(&screen, " ~ slips ");
}

/// The cells of a screen in the colour of a role.
fn inked(explorer: &Explorer, size: (u16, u16), role: Role) -> usize {
    let mut buffer = Buffer::empty(Rect::new(0, 0, size.0, size.1));
    screen::draw(&explorer.app, buffer.area, &mut buffer);
    let color = DARK.style(role).fg;
    let is_dots = |cell: &&Cell| {
        cell.symbol()
            .starts_with(|c| ('\u{2801}'..='\u{28ff}').contains(&c))
    };
    buffer
        .content
        .iter()
        .filter(is_dots)
        .filter(|cell| Some(cell.fg) == color)
        .count()
}

#[test]
fn closed_forms_lie_below_what_they_explain() {
    let size = (100, 30);
    for (preset, panel, role, name) in [
        ("limit-shape", "4z", Role::Stick, "╌ theory c"),
        ("mindlin", "2z", Role::Pressure, "╌ unworn p"),
    ] {
        let mut explorer = explorer(preset, size, DARK);
        explorer.press(&format!(",,..........{panel}"));
        let alone = inked(&explorer, size, role);
        explorer.press("t");
        let screen = shown(&explorer, size);
        has(&screen, name);
        // The legend has one line more, which covers some of the curve.
        let with_theory = inked(&explorer, size, role);
        assert!(
            with_theory + 12 > alone && alone > 5,
            "{with_theory} of {alone}\n{screen}"
        );
    }
}

/// No key in an open list or help does anything to the run: only what is asked for by Enter, `+` and `-`.
#[test]
fn no_key_pressed_in_a_modal_changes_the_run() {
    let size = (80, 24);
    let mut keys: Vec<Keystroke> = (' '..='~').map(Keystroke::Char).collect();
    keys.extend(('a'..='z').filter(|c| *c != 'c').map(Keystroke::Ctrl));
    let mut explorer = explorer("li2019-fig3", size, DARK);
    explorer.press(",,");
    let before = explorer.frame();
    let state = |frame: &Arc<Frame>| {
        let moment = &frame.live.observation.moment;
        (
            frame.live.scenario.to_toml(),
            moment.cycle,
            frame.changes.len(),
            frame.pace,
            frame.activity.clone(),
        )
    };
    let expected = state(&before);
    for open in ["?", "p", "e", ":", "a<Tab>", "<Enter>"] {
        for &key in &keys {
            // These leave the run visible, and have keys that run and step it.
            let is_watched = match open {
                "a<Tab>" | "<Enter>" => " .,+-=",
                "e" => " ,[]+-=",
                _ => "",
            };
            if matches!(key, Keystroke::Char(sign) if is_watched.contains(sign)) {
                continue;
            }
            explorer.press(open);
            explorer.app.press(key);
            explorer.app.explorer.show_frame(explorer.frame());
            assert_eq!(state(&explorer.frame()), expected, "{open} {key}");
            assert!(
                !matches!(
                    explorer.app.explorer.next,
                    mdr_tui::tui::explorer::Next::Leave
                ),
                "{open} {key}"
            );
            explorer.app.explorer.next = mdr_tui::tui::explorer::Next::Stay;
            while !explorer.app.overlays.is_empty() {
                explorer.press("<Esc>");
            }
        }
    }
    let session = begin(load("li2019-fig3", &[]));
    let typed = rehearsed_on(session, ",,pmild<Esc>?r<Esc>", (80, 24));
    has(&typed, "cycle 2.00/199.24");
}

/// Between bodies that are apart there is air, and below it the half-space: nothing but the scar is drawn as worn.
#[test]
fn a_lifted_indenter_leaves_air_above_the_half_space() {
    let size = (120, 40);
    let mut explorer = explorer("separation", size, DARK);
    explorer.press("V,,");
    while explorer.frame().live.observation.moment.contact_radius > 0.0 {
        explorer.press(".");
    }
    let screen = shown(&explorer, size);
    assert!(screen.contains("Nothing touches"), "{screen}");
    assert!(!screen.contains("slips in each cycle"), "{screen}");
    let worn = screen.matches('╱').count();
    let scar = screen.lines().filter(|line| line.contains('╱')).count();
    assert!(
        worn < 100 && scar < 8,
        "{worn} cells of {scar} rows\n{screen}"
    );
}
