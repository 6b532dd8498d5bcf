//! Presets of published cases, held against the numbers in the papers.

use mdr_tui::scenario::Scenario;
use mdr_tui::scenario::session::Session;
use mdr_tui::simulation::Curves;

fn started(preset: &str, sets: &[&str]) -> Session {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    let scenario = Scenario::load(preset, &sets).expect("a preset");
    Session::start(scenario).expect("a contact")
}

fn within(what: &str, found: f64, published: f64, share: f64) {
    let error = found / published - 1.0;
    eprintln!(
        "{what}: {found:.4e}, published {published:.4e}, {:.2} %",
        100.0 * error
    );
    assert!(
        error.abs() < share,
        "{what}: {found:e} instead of {published:e}"
    );
}

/// Kalker's CONTACT, case cattaneo.inp: its elements are 1/15 of the contact wide.
#[test]
fn cattaneo_as_kalkers_program_has_it() {
    let mut session = started("cattaneo-kalker", &[]);
    session.advance_to(0.25).expect("a quarter of a cycle");
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
    let sets = [
        "numerics.points=60",
        "numerics.steps_per_cycle=40",
        "numerics.tolerance=1e-3",
    ];
    let mut session = started("julia2022-gross-slip", &sets);
    let first = session.simulation().moment().contact_radius;
    session.advance_to(1e5).expect("a hundred thousand cycles");
    let simulation = session.simulation();
    let moment = simulation.moment();
    let radius = 0.05;
    let law = (first.powi(4) + 4.0 * moment.wear_volume * radius / std::f64::consts::PI).powf(0.25);
    within("a by the law from V", moment.contact_radius, law, 0.02);
    within("a", moment.contact_radius, 1.770e-3, 0.01);
    let deepest = simulation.observe(Curves::PROFILE).wear[0];
    within("depth of the scar", deepest, 3.134e-5, 0.03);
}

/// J. Juliá, L. Rodríguez-Tembleque (2022): read off colour bars, one digit. The scar has stopped
/// growing by 1e4 cycles.
#[test]
fn partial_slip_stops_wearing() {
    let sets = [
        "numerics.points=60",
        "numerics.steps_per_cycle=40",
        "numerics.tolerance=1e-3",
    ];
    let mut session = started("julia2022-partial-slip", &sets);
    let deepest = |session: &Session| {
        let wear = session.simulation().observe(Curves::PROFILE).wear;
        wear.into_iter().fold(0.0, f64::max)
    };
    session.advance_to(1e4).expect("ten thousand cycles");
    let middle = deepest(&session);
    within("after 1e4 cycles", middle, 2e-6, 0.2);
    session.advance_to(1e5).expect("a hundred thousand cycles");
    let end = deepest(&session);
    within("after 1e5 cycles", end, 2e-6, 0.2);
    assert!((end / middle - 1.0).abs() < 0.05, "{middle} {end}");
    let stick = session.simulation().moment().permanent_stick_radius;
    assert!(stick.expect("springs") > 0.0);
}
