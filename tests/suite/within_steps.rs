//! What begins, ends or changes inside a step, against what is exact however long the step is.

use mdr_tui::scenario::Scenario;
use mdr_tui::scenario::session::Session;
use mdr_tui::studies::refinement::{Budget, Outcome, Verdict, run_to_accuracy};

use crate::common::{energy, near, ran, volume};
use crate::random::Random;
use crate::random_kinds::{CHOICES, KINDS, choose, words};
use crate::random_scenarios;

/// A scenario of the fixtures, with `sets`.
fn scenario(name: &str, sets: &[&str]) -> Scenario {
    let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/within_steps");
    crate::common::load(&format!("{directory}/{name}.toml"), sets)
}

/// The same at its end, on so many cells and steps.
fn ended(name: &str, points: usize, steps: u32, sets: &[&str]) -> Session {
    let level = [
        format!("numerics.points={points}"),
        format!("numerics.steps_per_cycle={steps}"),
    ];
    let sets: Vec<&str> = level
        .iter()
        .map(String::as_str)
        .chain(sets.iter().copied())
        .collect();
    let scenario = scenario(name, &sets);
    let cycles = scenario.run().cycles.expect("cycles");
    ran(scenario, cycles)
}

/// V = k(E_d − E_th) in steps of any length, also where the last step passes the threshold.
#[test]
fn a_threshold_is_passed_inside_a_step() {
    for steps in [6, 12, 60] {
        let run = ended("threshold-late-step", 100, steps, &[]);
        let beyond = energy(&run) - 2.168598757309153e-7;
        near(format!("{steps} steps"), volume(&run), 4e-13 * beyond, 5e-3);
    }
    let fine = ended("threshold-late-step", 100, 240, &[]);
    near("V", volume(&fine), 7.544e-21, 5e-3);
}

/// μ by a table with a corner between two regular moments.
#[test]
fn courses_are_of_second_order() {
    let [coarse, half, fine] =
        [20, 40, 320].map(|steps| volume(&ended("friction-table", 60, steps, &[])));
    near("20 steps", coarse, fine, 2e-2);
    near("40 steps", half, fine, 5e-3);
}

/// μ that falls over the work of friction.
#[test]
fn friction_over_work_is_of_second_order() {
    let [coarse, half, fine] = [12, 24, 192].map(|steps| {
        let sets = [
            "friction.settled=0.15",
            "friction.running_in_energy=1e-7",
            "wear.threshold_energy=0",
        ];
        let run = ended("threshold-late-step", 60, steps, &sets);
        [energy(&run), volume(&run)]
    });
    for k in 0..2 {
        near(k, coarse[k], fine[k], 2e-2);
        near(k, half[k], fine[k], 6e-3);
    }
}

/// The springs that the tip leaves behind in each cycle lose what they hold, whatever the friction is: 3.46e-9 J by a row
/// of springs stepped 2,000 times a cycle.
#[test]
fn what_a_spring_holds_when_it_leaves_is_lost_for_any_friction() {
    for friction in ["1", "10", "300", "1e5"] {
        for (steps, error) in [(12, 0.1), (100, 0.05)] {
            let friction = format!("friction.coefficient={friction}");
            let run = ended(
                "relaxation-10nm-1e-12",
                100,
                steps,
                &[&friction, "wear.coefficient=0"],
            );
            near(
                format!("{friction}, {steps} steps"),
                energy(&run),
                3.455e-9,
                error,
            );
        }
    }
}

/// Another grid in the middle of a run adds nothing to what has worn of a scar.
#[test]
fn a_scar_is_not_worn_by_another_grid() {
    let scenario = scenario("scar-v0", &[]);
    let mut run = ran(scenario, 9.9);
    let initial = run.simulation().moment().initial_volume;
    let worn = |run: &Session| volume(run) - initial;
    let before = worn(&run) / energy(&run);
    run.advance_to(10.0).expect("the second block");
    near("V − V₀", worn(&run), 3.465e-17, 2e-2);
    near("V/E_d", worn(&run) / energy(&run), before, 5e-3);
    assert_eq!(run.simulation().moment().initial_volume, initial);
    let outcome = Outcome::from_session(&run);
    near("new wear", outcome.volume, worn(&run), 1e-9);
}

/// A worn punch on a rig loses contact in each cycle, where rounding alone says which spring touches last.
#[test]
fn a_contact_on_a_rig_is_made_and_lost() {
    let run = ended("flat-rig-lift", 20, 12, &["run.cycles=60"]);
    let moment = run.simulation().moment();
    near(
        "V",
        moment.wear_volume,
        7.879491901195845e-12 * energy(&run),
        5e-2,
    );
}

/// Force and shift in phase, with lift-off: hardly anything slips. 9.0e-7 J and 8.9e-21 m³ with 1,000 cells and 2,000
/// steps.
#[test]
fn a_lift_off_in_phase_does_hardly_any_work() {
    let run = ended("lift", 100, 100, &[]);
    near("E_d", energy(&run), 9.0e-7, 0.05);
    near("V", volume(&run), 8.9e-21, 0.05);
}

/// A flat with a rounded edge of 0.1 µm, which slips in a ring of a ten-thousandth of its radius.
#[test]
fn a_scar_in_a_tiny_edge_is_seen() {
    let scenario = scenario("nothing-worn-tiny-edge", &[]);
    let reached = run_to_accuracy(&scenario, 10.0, 2e-2, Budget::UNLIMITED, &|| true);
    let reached = reached.expect("a result");
    assert_eq!(reached.verdict, Verdict::Met);
    near("V", reached.rung.outcome.volume, 5.39e-21, 2e-2);
}

/// The second family of random scenarios holds what its table says.
#[test]
fn random_kinds_are_valid_and_frequent() {
    let seeds = KINDS..KINDS + 300;
    let all: Vec<Scenario> = seeds.map(random_scenarios::scenario).collect();
    let count = |is: &dyn Fn(&Scenario) -> bool| all.iter().filter(|one| is(one)).count();
    let has = |key: &'static str| move |one: &Scenario| one.value(key).is_some();
    for key in [
        "wear.threshold_energy",
        "friction.settled",
        "wear.settled",
        "friction.values",
        "wear.initial_radii",
        "wear.slip_rate_exponent",
        "motion.normal.waveform",
        "motion.tangential.rig_stiffness",
    ] {
        assert!(count(&has(key)) >= 10, "{key}: {}", count(&has(key)));
    }
    assert!(count(&|one| one.changes().len() > 1) >= 15);
    assert!(count(&|one| one.setup().indenter.name() == "rounded-punch") >= 10);
}

/// Also words that are added to a choice, but for tables, which need a file. The first word of each is its default.
#[test]
fn random_kinds_draw_every_word() {
    let all: Vec<Scenario> = (KINDS..KINDS + 300)
        .map(random_scenarios::scenario)
        .collect();
    for (path, _) in CHOICES {
        let words = words(path);
        for word in words.iter().filter(|word| **word != "table") {
            let drawn = all.iter().filter(|one| {
                let value = one.value(path);
                value.map_or(words[0] == *word, |value| value.trim_matches('"') == *word)
            });
            let drawn = drawn.count();
            assert!(drawn >= 3, "{path} = {word}: {drawn}");
        }
    }
}

/// A new word gets values for the keys that it needs: here, words with keys of their own are as new.
#[test]
fn a_word_that_no_table_knows_is_drawn_with_its_keys() {
    for (path, word) in [
        ("wear.law", "power"),
        ("motion.normal.waveform", "trapezoid"),
        ("motion.tangential.waveform", "triangle"),
        ("indenter.shape", "rounded-punch"),
        ("indenter.shape", "cone"),
    ] {
        let (text, known) = random_scenarios::first(7);
        let mut table = text.parse().expect("TOML");
        choose(&mut table, path, word, &known, &mut Random::new(7));
        let found = Scenario::from_toml(&table.to_string(), word, &[]);
        let found = found.unwrap_or_else(|error| panic!("{word}: {error}"));
        assert_eq!(found.value(path).as_deref(), Some(&*format!("\"{word}\"")));
    }
}
