//! Scenarios: what is refused and how it is said, `--set`, and that a scenario written out reads
//! back as itself.

use std::fs;
use std::path::Path;

use mdr_tui::math::abel::AbelMethod;
use mdr_tui::scenario::session::Session;
use mdr_tui::scenario::{RunPlan, Scenario, preset};
use mdr_tui::simulation::drive::Control;
use mdr_tui::simulation::{Scheme, Setup, Simulation, Spacing};
use mdr_tui::wear::{Law, LawForm};
use proptest::prelude::*;
use strum::VariantNames;

use crate::common::{again, begin, change, load, near, planned, ran, refused, try_load, volume};
use crate::test_dir::{has, names};

fn fixtures(kind: &str) -> Vec<(String, String)> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/scenarios");
    let directory = directory.join(kind);
    let read = |name: String| {
        let text = fs::read_to_string(directory.join(&name)).expect("a text");
        (name, text)
    };
    names(&directory).into_iter().map(read).collect()
}

/// The file has this line.
fn assert_line(text: &str, line: &str) {
    has(text, &format!("\n{line}\n"));
}

#[test]
fn every_invalid_fixture_is_refused_with_the_line_it_expects() {
    let fixtures = fixtures("invalid");
    assert!(fixtures.len() > 60);
    for (name, text) in fixtures {
        let expected = text
            .lines()
            .map_while(|line| line.strip_prefix("# expect: "));
        let expected: Vec<&str> = expected.collect();
        let error = Scenario::from_toml(&text, &name, &[]).expect_err(&name);
        let (error, expected) = (error.to_string(), expected.join("\n"));
        // A line may leave out the words of a choice.
        match expected.strip_suffix('…') {
            Some(start) => assert!(error.starts_with(start), "{error}"),
            None => assert_eq!(error, expected),
        }
    }
}

#[test]
fn every_preset_and_valid_fixture_presses_its_contact_and_reads_back() {
    let presets = preset::ALL.iter();
    let presets = presets.map(|preset| (preset.name.to_owned(), preset.text.to_owned()));
    for (name, text) in fixtures("valid").into_iter().chain(presets) {
        let scenario =
            Scenario::from_toml(&text, &name, &[]).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(again(&scenario), scenario, "{name}");
        assert_eq!(again(&scenario).to_toml(), scenario.to_toml());
        assert_eq!(
            Setup::try_from(scenario.spec()).as_ref(),
            Ok(scenario.setup())
        );
        let preset = preset::find(&name);
        assert!(preset.is_none_or(|preset| preset.title() == scenario.title()));
        if scenario.setup().grid.cells() < 1000 && name != "narrow-domain.toml" {
            let simulation = Simulation::new(scenario.setup().clone());
            assert!(simulation.is_ok(), "{name}: {:?}", simulation.err());
        }
    }
}

/// As in a study on a preset that names its cells and steps.
#[test]
fn an_accuracy_chooses_the_integrator_whatever_numbers_stood_there() {
    let fig3 = load("li2019-fig3", &[]);
    let set = |assignments: &[(&str, &str)]| fig3.assigned(assignments).expect("a scenario");
    let integrator = "numerics.integrator";
    assert!(fig3.value(integrator).is_some());
    let accurate = ("numerics.accuracy", "1e-2");
    assert_eq!(set(&[accurate]).value(integrator), None);
    let direct = set(&[(integrator, "direct"), accurate]);
    assert!(direct.value(integrator).is_some());
    assert!(set(&[("run.cycles", "5")]).value(integrator).is_some());
}

#[test]
fn another_shape_drops_the_size_of_the_one_before() {
    let scenario = load(
        "li2019-fig3",
        &["indenter.angle=0.02", "indenter.shape=cone"],
    );
    assert_eq!(scenario.setup().indenter.name(), "cone");
    assert_eq!(scenario.value("indenter.radius"), None);
    let both = [("indenter.shape", "cone"), ("indenter.angle", "0.02")];
    assert_eq!(load("li2019-fig3", &[]).assigned(&both), Ok(scenario));
}

#[test]
fn the_radius_of_a_punch_is_none_of_curvature() {
    let error = try_load("flat-punch", &["indenter.shape=paraboloid"]).expect_err("no radius");
    has(&error, "indenter.radius is missing");
    // In either order, and a domain given for another shape does not stand in the way.
    let wide = load("li2019-fig3", &["numerics.domain_radius=3e-4"]);
    let [shape, size] = [
        ("indenter.shape", "flat-punch"),
        ("indenter.radius", "1e-4"),
    ];
    for both in [[shape, size], [size, shape]] {
        let punch = wide.assigned(&both).expect("a punch");
        assert_eq!(punch.setup().indenter.rim(), Some(1e-4));
        assert_eq!(punch.setup().grid.radius(), 1e-4);
    }
    // Between shapes with the same radius it stays.
    let cut = [
        ("indenter.shape", "truncated-paraboloid"),
        ("indenter.tip_radius", "2e-5"),
    ];
    let cut = load("li2019-fig3", &[]).assigned(&cut).expect("a flat tip");
    assert_eq!(cut.value("indenter.radius"), Some("0.01".into()));
    let edge = (2.0 * 0.01 * 1.1e-6 + 4e-10f64).sqrt();
    near("domain", cut.setup().grid.radius(), edge, 1e-14);
    let whole = cut.assigned(&[("indenter.shape", "paraboloid")]);
    assert_eq!(whole, Ok(load("li2019-fig3", &[])));
}

/// What the method's own paper does, or the project's method.
fn choices(method: AbelMethod) -> (Spacing, Scheme) {
    match method {
        AbelMethod::Product => (Spacing::Graded, Scheme::Trapezoid),
        _ => (Spacing::Uniform, Scheme::Euler),
    }
}

#[test]
fn grid_and_scheme_follow_the_method_unless_they_are_given() {
    for preset in preset::ALL {
        let scenario = load(preset.name, &[]);
        if scenario.value("numerics.grid").is_some() {
            continue;
        }
        for method in AbelMethod::for_geometry(scenario.setup().geometry) {
            let changed = scenario.assigned(&[("numerics.method", method.name())]);
            let changed = changed.expect("a method");
            let setup = changed.setup();
            assert_eq!((setup.spacing, setup.scheme), choices(method), "{method}");
            let read = again(&scenario).assigned(&[("numerics.method", method.name())]);
            assert_eq!(read.as_ref(), Ok(&changed), "{}: {method}", preset.name);
            assert_eq!(read.expect("a method").to_toml(), changed.to_toml());
            let text = changed.to_toml();
            for (key, word) in [
                ("grid", setup.spacing.name()),
                ("scheme", setup.scheme.name()),
            ] {
                let line = format!("# {key} = \"{word}\"  # default of method \"{method}\"");
                assert_line(&text, &line);
            }
        }
    }
    for spacing in [Spacing::Graded, Spacing::Uniform] {
        for scheme in Scheme::ALL {
            let given = [
                format!("numerics.grid={spacing}"),
                format!("numerics.scheme={scheme}"),
            ];
            let given = load("hertz", &[&given[0], &given[1]]);
            for method in AbelMethod::ALL {
                let changed = again(&given).assigned(&[("numerics.method", method.name())]);
                let changed = changed.expect("a method");
                let setup = changed.setup();
                assert_eq!((setup.spacing, setup.scheme), (spacing, scheme), "{method}");
                has(&changed.to_toml(), &format!("\ngrid = \"{spacing}\"\n"));
                has(&changed.to_toml(), &format!("\nscheme = \"{scheme}\"\n"));
            }
        }
    }
}

#[test]
fn a_run_that_changed_its_method_replays_to_the_same_bits() {
    for method in AbelMethod::ALL {
        let mut session = ran(load("li2019-fig3", &[]), 0.25);
        change(&mut session, "numerics.method", method.name());
        session.advance_to(0.5).expect("another");
        change(&mut session, "numerics.grid", "uniform");
        change(&mut session, "numerics.method", "b");
        session.advance_to(0.75).expect("a third");
        let replay = ran(again(&session.as_run(Vec::new())), 0.75);
        let setups = [&replay, &session].map(|run| run.scenario().setup());
        assert_eq!(setups[0], setups[1], "{method}");
        let states = [&replay, &session].map(|run| run.simulation().state());
        assert_eq!(states[0], states[1], "{method}");
    }
}

#[test]
fn a_key_changed_follows_the_same_rules() {
    let scenario = load("li2019-fig3", &[]);
    let changed = scenario
        .assigned(&[("numerics.method", "\"b\"")])
        .expect("a method");
    assert_eq!(changed.setup().method.name(), "b");
    let method = scenario.setup().method.name();
    let back = changed.assigned(&[("numerics.method", method)]);
    assert_eq!(back, Ok(scenario.clone()));
    for (key, value, why) in [
        ("material.poisson", "0.7", "must be from 0 to 0.5"),
        (
            "points",
            "7",
            "unknown key points; did you mean numerics.points?",
        ),
    ] {
        let error = scenario.assigned(&[(key, value)]).expect_err("a refusal");
        assert_eq!(error.to_string(), format!("{key} = {value}: {why}"));
    }
}

#[test]
fn the_law_can_be_switched_there_and_back() {
    let archard = load("li2019-fig3", &[]);
    let power = archard
        .assigned(&[("wear.law", "\"power\"")])
        .expect("a law");
    let law = power.setup().wear.expect("a law");
    let LawForm::Power(powers) = law.form() else {
        panic!("the power law");
    };
    let exponents = (powers.stress_exponent, powers.slip_rate_exponent);
    assert_eq!(exponents, (1.5, 1.0));
    // mu F/(pi a^2) of Hertz, with the error of 200 cells.
    let mean_pressure =
        4.0 / 3.0 * 2.3077e11 * 1e-3 * 0.01f64.sqrt() * 1e-6 / (std::f64::consts::PI * 1e-8);
    near("stress", powers.reference_stress, 0.1 * mean_pressure, 1e-3);
    near("slip rate", powers.reference_slip_rate, 1e-5, 1e-12);
    let given = load("power-law", &["wear.reference_stress=1e8"]);
    for law in Law::VARIANTS {
        for scenario in [&archard, &given] {
            let other = scenario.assigned(&[("wear.law", law)]).expect("a law");
            assert_eq!(other.setup().wear.map(|law| law.name()), Some(*law));
            let before = scenario.setup().wear.expect("a law").name();
            assert_eq!(
                other.assigned(&[("wear.law", before)]).as_ref(),
                Ok(scenario)
            );
        }
    }
}

#[test]
fn every_law_wears_the_same_with_fewer_steps_and_in_jumps() {
    for law in Law::VARIANTS {
        let law = format!("wear.law={law}");
        let run = |sets: &[&str]| {
            let all = [&law, "numerics.points=80", "numerics.steps_per_cycle=80"];
            volume(&ran(load("limit-shape", &[&all, sets].concat()), 40.0))
        };
        let direct = run(&["numerics.integrator=direct"]);
        let jumped = ["numerics.integrator=cycle-jump", "numerics.tolerance=1e-4"];
        near("jumped", run(&jumped), direct, 3e-3);
        let euler = ["numerics.integrator=direct", "numerics.scheme=euler"];
        near("explicit", run(&euler), direct, 3e-2);
        let published = ["numerics.integrator=direct", "numerics.method=a+b"];
        near("a+b", run(&published), direct, 0.1);
    }
}

#[test]
fn a_run_written_out_keeps_its_plan_and_its_changes() {
    let plan = RunPlan {
        shortened_at: Vec::new(),
        cycles: Some(12.345),
        snapshot_at: vec![0.1 + 0.2, 7.0],
        note: Some("a \"remark\"\nin two lines".into()),
        stated: None,
    };
    let changes = vec![
        planned(1.0, "numerics.method", "\"b\""),
        planned(2.75, "wear.law", "power"),
    ];
    let scenario = load("li2019-fig3", &[])
        .with_run(plan.clone())
        .with_changes(changes.clone());
    let read = again(&scenario);
    assert_eq!((read.run(), read.changes()), (&plan, changes.as_slice()));
    assert_eq!(read, scenario);
    let stages: Vec<_> = changes
        .iter()
        .scan(read, |stage, change| {
            *stage = stage.after(std::slice::from_ref(change)).expect("a stage");
            Some(stage.clone())
        })
        .collect();
    assert_eq!(stages[1].setup().method.name(), "b");
    assert_eq!(stages[1].setup().wear.map(|law| law.name()), Some("power"));
    assert!(stages[1].changes().is_empty());
}

#[test]
fn an_accuracy_is_no_number_of_cells_and_steps() {
    let asked = load("li2019-fig3", &["numerics.accuracy=1e-3"]);
    assert_eq!(again(&asked), asked);
    let by_hand = asked
        .assigned(&[("numerics.points", "50")])
        .expect("by hand");
    assert_eq!(again(&by_hand), by_hand);
    // Without numbers there is no run, and during one it cannot change.
    let told = Session::start(asked).expect_err("no points and steps");
    let told = told.to_string();
    assert!(told.starts_with("numerics.accuracy = 1e-3: points and steps"));
    let mut session = begin(load("li2019-fig3", &[]));
    let told = refused(&mut session, "numerics.accuracy", "1e-3");
    has(&told, "cannot change during a run");
}

#[test]
fn the_domain_ends_where_nothing_can_touch() {
    let ends = |preset: &str, sets: &[&str], depth: f64, share: f64| {
        let radius = load(preset, sets).setup().grid.radius();
        near(preset, radius, (2.0 * 0.01 * depth).sqrt(), share);
    };
    ends("li2019-fig3", &[], 1.1e-6, 1e-14);
    // Under a force that swings there is room to sink to three times the depth of Hertz.
    let swings = [
        "motion.normal.amplitude=1e-9",
        "motion.normal.angular_frequency=100",
    ];
    ends("gross-slip", &swings, 3e-6, 1e-3);
    // A force that is held sinks in until nothing slips: (2/3) c³/R + (U/λ) c = F_z/(2E*), d = c²/R + U/λ.
    let scenario = load("gross-slip", &[]);
    let setup = scenario.setup();
    let depth = setup.grid.radius().powi(2) / (2.0 * 0.01) / 1.05;
    let swing = setup.drive.tangential().expect("a motion").oscillation();
    let yielding = swing.amplitude() * setup.material.stick_ratio();
    let c = ((depth - yielding) * 0.01).sqrt();
    let force =
        2.0 * setup.material.normal_modulus() * (2.0 / 3.0 * c.powi(3) / 0.01 + yielding * c);
    let held = setup.drive.normal().oscillation().mean();
    near("force", force, held, 1e-6);
}

#[test]
fn what_stands_still_shares_the_period_of_what_moves() {
    let scenario = load("mindlin", &[]);
    let frequency = |control: &Control| control.oscillation().angular_frequency();
    assert_eq!(frequency(scenario.setup().drive.normal()), 100.0);
    assert_eq!(scenario.setup().drive.repeats_after(), Some(1));
}

/// A number of any size, to the last bit.
fn positive() -> impl Strategy<Value = f64> {
    (1.0..10.0f64, -12..3i32).prop_map(|(digits, exponent)| digits * 10f64.powi(exponent))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn a_scenario_written_out_reads_back_as_itself(
        preset in 0..preset::ALL.len(),
        title in any::<String>(),
        description in "(?s).{0,80}",
        (mean, amplitude, modulus, coefficient) in (positive(), positive(), positive(), positive()),
        (phase, poisson) in (-10.0..10.0f64, 0.0..=0.5f64),
        (points, steps) in (4..300i64, 1..1000i64),
        domain in proptest::option::of(positive()),
        (law, method, other) in (0..Law::VARIANTS.len(), 0..AbelMethod::ALL.len(), 0..AbelMethod::ALL.len()),
        grid in proptest::option::of(0..2usize),
        scheme in proptest::option::of(0..2usize),
        cycles in proptest::option::of(positive()),
        snapshot_at in proptest::collection::vec(positive(), 0..4),
        at_cycle in positive(),
    ) {
        // A contact of any size does not lie within a gauge length.
        if preset::ALL[preset].text.contains("gauge_length") {
            return Ok(());
        }
        let setup = load(preset::ALL[preset].name, &[]).setup().clone();
        let methods = AbelMethod::for_geometry(setup.geometry);
        // A bare text: escapes of TOML would be read as such.
        let quoted = |text: &str| toml::Value::String(text.to_owned()).to_string();
        let number = |value: f64| format!("{value:?}");
        let two_bodies = preset::ALL[preset].text.contains("[material.indenter]");
        let material = if two_bodies {
            ["material.indenter.youngs_modulus", "material.indenter.poisson"]
        } else {
            ["material.effective_modulus", "material.poisson"]
        };
        let mut assignments = vec![
            ("title", quoted(&title)),
            ("description", quoted(&description)),
            ("motion.normal.mean", number(mean)),
            ("motion.normal.amplitude", number(amplitude)),
            ("motion.normal.angular_frequency", number(coefficient)),
            ("motion.normal.phase", number(phase)),
            (material[0], number(modulus)),
            (material[1], number(poisson)),
            ("friction.coefficient", number(amplitude)),
            ("wear.coefficient", number(coefficient)),
            ("wear.law", Law::VARIANTS[law].to_owned()),
            ("numerics.method", methods[method % methods.len()].to_string()),
            ("numerics.points", points.to_string()),
            ("numerics.steps_per_cycle", steps.to_string()),
        ];
        let indenter = setup.indenter;
        // A punch ends its own domain, and a tip of given size must lie within any other.
        let free = indenter.rim().is_none() && indenter.tip_radius() == 0.0;
        let domain = domain.filter(|_| free);
        assignments.extend(domain.map(|domain| ("numerics.domain_radius", number(domain))));
        assignments.extend(grid.map(|grid| ("numerics.grid", Spacing::VARIANTS[grid].to_owned())));
        assignments.extend(scheme.map(|scheme| ("numerics.scheme", Scheme::ALL[scheme].to_string())));
        let assignments: Vec<(&str, &str)> = assignments.iter().map(|(key, value)| (*key, value.as_str())).collect();
        let scenario = load(preset::ALL[preset].name, &[])
            .assigned(&assignments)
            .map_err(|error| TestCaseError::fail(error.to_string()))?
            .with_run(RunPlan { cycles, snapshot_at, ..RunPlan::default() })
            .with_changes(vec![planned(at_cycle, "friction.coefficient", &number(phase.abs()))]);
        let text = scenario.to_toml();
        let read = Scenario::from_toml(&text, scenario.origin(), &[])
            .map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
        prop_assert_eq!(&read, &scenario);
        prop_assert_eq!(read.title(), scenario.title());
        prop_assert_eq!(read.to_toml(), text);
        let other = methods[other % methods.len()].name();
        prop_assert_eq!(read.assigned(&[("numerics.method", other)]), scenario.assigned(&[("numerics.method", other)]));
        prop_assert!(!scenario.title().contains(char::is_control));
    }

    #[test]
    fn no_text_makes_the_reader_panic_or_break_the_line(text in any::<String>(), set in any::<String>()) {
        if let Err(error) = Scenario::from_toml(&text, &text, &[]) {
            prop_assert!(!error.to_string().lines().any(|line| line.contains(char::is_control)));
        }
        if let Err(error) = Scenario::load(&text, &[]) {
            prop_assert!(!error.to_string().contains(char::is_control));
        }
        for set in [set.clone(), format!("title={set}"), format!("numerics.points={set}")] {
            if let Err(error) = Scenario::load("hertz", &[set]) {
                prop_assert!(!error.to_string().contains(char::is_control));
            }
        }
    }
}

#[test]
fn a_frequency_is_given_in_either_unit() {
    let given = |value: &str| {
        let sets = ["tangential", "normal"].map(|name| format!("motion.{name}.{value}"));
        load("li2019-fig3", &sets.each_ref().map(String::as_str))
    };
    let of = |scenario: &Scenario| {
        let motion = scenario.setup().drive.tangential().expect("a motion");
        motion.oscillation().angular_frequency()
    };
    let hertz = given("frequency=50");
    let angular = given("angular_frequency=50 Hz");
    for scenario in [&hertz, &angular, &again(&hertz)] {
        assert_eq!(of(scenario), std::f64::consts::TAU * 50.0);
    }
}

/// Archard's k of a pin test is per load and distance: per friction work it is k over friction.
#[test]
fn a_wear_coefficient_per_load_is_over_the_friction_of_the_moment() {
    let run = |sets: &[&str]| Ok::<_, String>(ran(try_load("li2019-fig3", sets)?, 2.0));
    let k = |session: &Session| {
        let law = session.simulation().setup().wear;
        law.expect("wear").coefficient()
    };
    let work = run(&["wear.coefficient=1.3e-10"]).expect("a run");
    let load = run(&["wear.coefficient_per_load=0.013 mm3/Nm"]).expect("a run");
    near("k", k(&load), 1.3e-10, 1e-12);
    near("volume", volume(&load), volume(&work), 1e-9);
    // Where friction runs in, so does k per friction work, the other way.
    let changes = ["friction.settled=0.2", "friction.running_in_cycles=1"];
    let load =
        run(&[&["wear.coefficient_per_load=1.3e-11"], &changes[..]].concat()).expect("a run");
    let friction = load.simulation().setup().material.friction();
    assert!(friction > 0.15 && (k(&load) * friction / 1.3e-11 - 1.0).abs() < 1e-12);
    // A change during a run goes with it as well.
    let mut changed = work.clone();
    change(&mut changed, "wear.coefficient_per_load", "1.3e-11");
    change(&mut changed, "friction.coefficient", "0.2");
    near("k", k(&changed), 6.5e-11, 1e-12);
}
