//! Presets of published cases, held against the numbers in the papers.

use mdr_tui::reading::Curves;
use mdr_tui::scenario::session::Session;

use crate::common::{begin, largest, load, near, ran};
use crate::test_dir::cases;

const SMALL: [&str; 3] = [
    "numerics.points=60",
    "numerics.steps_per_cycle=40",
    "numerics.tolerance=1e-3",
];

fn within(what: &str, found: f64, published: f64, share: f64) {
    let case = format!("{what}: {found:.4e}, published {published:.4e}");
    near(case, found, published, share);
}

/// Kalker's CONTACT, case cattaneo.inp: its elements are 1/15 of the contact wide.
#[test]
fn cattaneo_as_kalkers_program_has_it() {
    let session = ran(load("cattaneo-kalker", &[]), 0.25);
    let simulation = session.simulation();
    let moment = simulation.moment();
    within("F_x", moment.tangential_force, 3.218, 3e-3);
    within("depth", moment.depth, 19.98e-6, 3e-3);
    let pressure = simulation.pressure();
    within("largest pressure", pressure[0], 4.393e6, 2e-3);
    let stick = moment.stick_radius.expect("springs") / moment.contact_radius;
    within("sticking part", stick * stick, 45.0 / 177.0, 0.02);
}

/// I. I. Argatov (2011): under gross slip a⁴ = a₀⁴ + 4VR/π, and the scar is a²/2R deep. The scar has
/// grown by then to almost three times the contact's first radius.
#[test]
fn gross_slip_grows_by_argatovs_law() {
    let mut session = begin(load("julia2022-gross-slip", &SMALL));
    let first = session.simulation().moment().contact_radius;
    session.advance_to(1e5).expect("a hundred thousand cycles");
    let simulation = session.simulation();
    let moment = simulation.moment();
    let radius = 0.05;
    let law = (first.powi(4) + 4.0 * moment.wear_volume * radius / std::f64::consts::PI).powf(0.25);
    within("a by the law from V", moment.contact_radius, law, 0.02);
    within("a", moment.contact_radius, 1.770e-3, 0.01);
    let deepest = simulation.observe(Curves::PROFILE).wear()[0];
    within("depth of the scar", deepest, 3.134e-5, 0.03);
}

/// J. Juliá, L. Rodríguez-Tembleque (2022): read off colour bars, one digit. The scar has stopped
/// growing by 1e4 cycles.
#[test]
fn partial_slip_stops_wearing() {
    let mut session = begin(load("julia2022-partial-slip", &SMALL));
    let deepest = |session: &Session| {
        let seen = session.simulation().observe(Curves::PROFILE);
        seen.wear().iter().copied().fold(0.0, f64::max)
    };
    session.advance_to(1e4).expect("ten thousand cycles");
    let middle = deepest(&session);
    within("after 1e4 cycles", middle, 2e-6, 0.2);
    session.advance_to(1e5).expect("a hundred thousand cycles");
    let end = deepest(&session);
    within("after 1e5 cycles", end, 2e-6, 0.2);
    near("depth", end, middle, 0.05);
    let stick = session.simulation().moment().permanent_stick_radius;
    assert!(stick.expect("springs") > 0.0);
}

/// What the page `published` says of the program itself is what its presets give, to the last digit.
#[test]
fn the_figures_of_the_guide_are_those_of_the_presets() {
    let page = include_str!("../../src/guide/published.md");
    let mut found = Vec::new();
    for (preset, section) in cases([
        "julia2022-gross-slip => ## Gross slip of steel on steel",
        "julia2022-partial-slip => ## Partial slip of steel on steel",
    ]) {
        let section = page.split(section).nth(1).expect("the section");
        let mut session = begin(load(preset, &[]));
        for (row, cycles) in [
            ("| 100 cycles", 100.0),
            ("| 10⁴ cycles", 1e4),
            ("| 10⁵ cycles", 1e5),
        ] {
            session.advance_to(cycles).expect("the cycles");
            let deepest = largest(session.simulation().worn_depth().iter().copied());
            let case = format!("{preset}, {row}");
            found.push((case, last_cell(section, row), 1e3 * deepest));
        }
        if preset.ends_with("gross-slip") {
            let moment = session.simulation().moment();
            let (row, radius) = ("| radius of the scar", 1e3 * moment.contact_radius);
            found.push((row.to_owned(), last_cell(section, row), radius));
            let volume = section.split("run here\n(").nth(1).expect("V");
            found.push(("V".to_owned(), volume.to_owned(), moment.wear_volume));
        }
    }
    let session = ran(load("cattaneo-kalker", &[]), 0.25);
    let simulation = session.simulation();
    let moment = simulation.moment();
    let stick = moment.stick_radius.expect("springs") / moment.contact_radius;
    for (row, value) in [
        ("| F_x", moment.tangential_force),
        ("| largest pressure", 1e-6 * simulation.pressure()[0]),
        ("| depth", 1e6 * moment.depth),
        ("| sticking part", stick * stick),
    ] {
        let line = page.lines().find(|line| line.starts_with(row)).expect(row);
        let cell = line.split('|').nth(3).expect("a column");
        found.push((row.to_owned(), cell.replace("c²/a² = ", ""), value));
    }
    found.retain(|(_, stated, value)| !is_rounded(stated, *value));
    assert!(found.is_empty(), "{found:#?}");
}

/// The last cell of the table row that begins with `row`.
fn last_cell(section: &str, row: &str) -> String {
    let line = section.lines().find(|line| line.starts_with(row));
    let cells = line.expect(row).trim_end_matches('|').rsplit('|');
    cells.map(str::to_owned).next().expect("a cell")
}

/// Whether the number at the start of `stated` is `value`, to within one of its last digit.
fn is_rounded(stated: &str, value: f64) -> bool {
    let word = stated.trim().split([' ', ')']).next().expect("a word");
    let number: f64 = word.parse().expect("a number");
    let (digits, exponent) = word.split_once('e').unwrap_or((word, "0"));
    let places = digits.split_once('.').map_or(0, |(_, after)| after.len()) as i32;
    let last = 10f64.powi(exponent.parse::<i32>().expect("an exponent") - places);
    (number - value).abs() <= last
}
