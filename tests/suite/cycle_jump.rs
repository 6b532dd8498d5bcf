//! Jumps over cycles against every cycle stepped, and what they cost.
//!
//! Lengths are in a₀ or d₀ throughout.

use crate::common::{
    Scene, apart, as_published, begin, change, holds, largest, load, near, ours, ran, rms,
    run_setup, swing,
};
use crate::test_dir::has;
use mdr_tui::math::abel::AbelMethod::A;
use mdr_tui::reading::{Curves, Moment};
use mdr_tui::scenario::session::Session;
use mdr_tui::simulation::running_in::{Course, Over, RunningIn};
use mdr_tui::simulation::{Integrator, Setup, Simulation};
use mdr_tui::wear::{Powers, WearLaw};
use std::f64::consts::SQRT_2;

fn jumping(setup: &Setup, tolerance: f64) -> Setup {
    Setup {
        integrator: Integrator::CycleJump { tolerance },
        ..setup.clone()
    }
}

/// Constant depth, μ = 0.1, swings of 0.1 d₀: a scar of 0.36 d₀ in the end.
fn held(wear_number: f64) -> Setup {
    ours(Scene::default().shaken(0.1).wear(wear_number))
}

/// Fig. 3 of the paper.
fn fig3(wear_number: f64) -> Setup {
    ours(Scene::fig3(wear_number))
}

/// The rms and the largest difference of the worn depth, both runs on the same nodes.
fn difference(one: &Simulation, other: &Simulation) -> [f64; 2] {
    assert_eq!(one.setup().grid, other.setup().grid);
    let (one, other) = (&one.state().wear, &other.state().wear);
    let pairs = one.iter().zip(other);
    [rms(pairs.map(|(a, b)| a - b)), apart(one, other)]
}

fn work(run: &Simulation) -> f64 {
    run.state().ledger.dissipated_energy
}

#[test]
fn a_jumped_scar_is_the_stepped_one() {
    let powers = Powers {
        stress_exponent: 1.5,
        slip_rate_exponent: 0.8,
        reference_stress: 0.3,
        reference_slip_rate: 0.1,
    };
    let power = Some(WearLaw::power(0.3, powers).expect("a law"));
    let mut by_power = fig3(1.0);
    by_power.wear = power;
    let by_a = as_published(A, fig3(0.05));
    let scenes = [
        ("held", held(0.1), 400.0),
        ("Fig. 3", fig3(0.05), 400.0),
        ("power law", by_power, 200.0),
        ("Fig. 3 by Method A", by_a, 400.0),
    ];
    for (name, setup, cycles) in scenes {
        let direct = run_setup(setup.clone(), cycles);
        let deepest = direct.state().wear.iter().copied().fold(0.0, f64::max);
        assert!(deepest > 0.05, "{name} wears to {deepest}");
        for tolerance in [1e-3, 1e-4] {
            let jumped = run_setup(jumping(&setup, tolerance), cycles);
            assert_eq!(jumped.cycle(), cycles);
            let stats = jumped.state().stats;
            assert!(stats.jumps >= 2, "{name}: {stats:?}");
            let [rms, largest] = difference(&direct, &jumped);
            let volume = jumped.wear_volume() / direct.wear_volume() - 1.0;
            let work = work(&jumped) / work(&direct) - 1.0;
            for (what, off, tolerances) in [
                ("rms", rms, 1.5),
                ("largest", largest, 10.0),
                ("volume", volume, 20.0),
                ("work", work, 20.0),
            ] {
                let what = format!("{name} at {tolerance}, {what}");
                holds(&what, off.abs(), tolerances * tolerance);
            }
        }
    }
}

/// Friction and k on their courses, over cycles and over work, and a threshold that 150 cycles take: V is that of every
/// cycle stepped, and agrees with the work that k has worn by.
#[test]
fn courses_are_jumped_as_well() {
    let cycles = 400.0;
    let all = work(&run_setup(fig3(0.05), cycles));
    let exponential = |first: f64, last, constant, over| {
        Some(Course::exponential(first, last, constant, over).expect("a course"))
    };
    let table =
        |at: &[f64], values: &[f64], over| Some(Course::table(at, values, over).expect("a course"));
    let k = fig3(0.05).wear.expect("a law").coefficient();
    let courses = [
        RunningIn {
            friction: exponential(0.1, 0.15, 60.0, Over::Cycles),
            ..RunningIn::default()
        },
        RunningIn {
            friction: table(&[50.0, 150.5, 300.0], &[0.1, 0.14, 0.12], Over::Cycles),
            wear_per_load: Some(0.1 * k),
            ..RunningIn::default()
        },
        RunningIn {
            wear: exponential(2.0 * k, 0.5 * k, 0.2 * all, Over::Energy),
            threshold: 0.4 * all,
            ..RunningIn::default()
        },
        RunningIn {
            friction: table(&[0.1 * all, 0.6 * all], &[0.12, 0.1], Over::Energy),
            wear: table(&[0.0, 0.3 * all, 0.7 * all], &[k, 2.0 * k, k], Over::Energy),
            ..RunningIn::default()
        },
    ];
    for (i, running_in) in courses.into_iter().enumerate() {
        let mut setup = fig3(0.05);
        setup.running_in = Some(running_in);
        let stepped = run_setup(setup.clone(), cycles);
        let jumped = run_setup(jumping(&setup, 1e-5), cycles);
        let [volume, friction_work] = [Simulation::wear_volume, work]
            .map(|of: fn(&Simulation) -> f64| of(&jumped) / of(&stepped) - 1.0);
        assert!(
            volume.abs() < 2e-3 && friction_work.abs() < 1e-3,
            "{i}: {volume:e} {friction_work:e}"
        );
        let [one, other] = [&jumped, &stepped].map(|run| run.moment().energy_residual);
        let residual = one.zip(other).map(|(one, other)| one - other);
        assert!(
            residual.is_some_and(|difference| difference.abs() < 1e-3),
            "{i}: {residual:?}"
        );
        let evaluated = jumped.state().stats.evaluated_cycles;
        assert!((evaluated as f64) < 0.3 * cycles, "{i}: {evaluated}");
    }
}

/// The closed form of a cycle at a held depth, which knows no steps, against the steps of a cycle: a
/// normal motion too small to move anything keeps the closed form from being used.
#[test]
fn a_plain_swing_needs_no_steps() {
    let plain = jumping(&held(0.01), 1e-5);
    let stepped = Setup {
        drive: mdr_tui::simulation::drive::Drive::new(
            swing(1.0, 1e-14, 1.0, 0.0),
            Some(swing(0.0, 0.1, 1.0, 0.0)),
        ),
        ..plain.clone()
    };
    let (plain, stepped) = (run_setup(plain, 1000.0), run_setup(stepped, 1000.0));
    let (few, many) = (plain.state().stats, stepped.state().stats);
    assert!(20 * few.contacts < many.contacts, "{few:?} {many:?}");
    let radii = plain.setup().grid.nodes();
    let worst = radii.iter().zip(&plain.state().wear).map(|(&r, wear)| {
        (wear - stepped.setup().grid.interpolate(&stepped.state().wear, r)).abs()
    });
    holds("largest difference", worst.fold(0.0, f64::max), 1e-5);
    let sticks = [&plain, &stepped].map(|run| run.state().permanent_stick_radius());
    holds("stick radius", (sticks[0] - sticks[1]).abs(), 3e-5);
    let springs = [&plain, &stepped].map(|run| &run.state().contact.spring.nodal[..]);
    holds("springs", apart(springs[0], springs[1]), 3e-3);
}

/// Work counts: a million mild cycles cost what some hundred looks cost.
#[test]
fn a_million_cycles_cost_a_few_hundred() {
    let simulation = run_setup(load("mild-million", &[]).setup().clone(), 1e6);
    let stats = simulation.state().stats;
    let deepest = simulation.state().wear.iter().copied().fold(0.0, f64::max);
    let depth = 1e-6;
    assert!((0.28..0.38).contains(&(deepest / depth)), "{deepest}");
    // Within what other last digits of another processor may change.
    for (what, count, due) in [
        ("jumps", stats.jumps, 158.0),
        ("cycles looked at", stats.evaluated_cycles, 552.0),
        ("transforms", stats.transforms, 2068.0),
    ] {
        near(what, count as f64, due, 0.125);
    }
    // A thousand times the wear a cycle, every cycle stepped.
    let harsh = [
        "numerics.integrator=direct",
        "wear.coefficient=5e-12",
        "numerics.steps_per_cycle=40",
    ];
    let direct = run_setup(load("mild-million", &harsh).setup().clone(), 1000.0);
    let radii = direct.setup().grid.nodes().iter().zip(&direct.state().wear);
    let grid = &simulation.setup().grid;
    let jumped = |r| grid.interpolate(&simulation.state().wear, r);
    let worst = largest(radii.map(|(&r, wear)| wear - jumped(r)));
    holds("largest difference from direct steps", worst / depth, 1e-3);
}

/// A scar of less than a hundredth of the depth wants a tolerance far below it, of which only the wear is measured in
/// depths: the work of friction need not be right to the same digits.
#[test]
fn a_shallow_scar_is_jumped_as_well() {
    let overrides = [
        "motion.tangential.amplitude=1e-8",
        "numerics.points=60",
        "numerics.steps_per_cycle=30",
    ];
    let with = |more: &[&str]| {
        let scenario = load("li2019-fig3", &[&overrides[..], more].concat());
        run_setup(scenario.setup().clone(), 1000.0)
    };
    let stepped = with(&[]);
    let jumped = with(&["numerics.integrator=cycle-jump", "numerics.tolerance=1e-7"]);
    let [rms, _] = difference(&stepped, &jumped);
    let deepest = stepped.state().wear.iter().copied().fold(0.0, f64::max);
    assert!(deepest < 1e-2 * 1e-6, "{deepest}");
    holds("rms of the worn depth", rms / deepest, 1e-3);
    near("friction work", work(&jumped), work(&stepped), 1e-3);
    let looked_at = jumped.state().stats.evaluated_cycles;
    assert!(looked_at < 300 && jumped.cycle() == 1000.0, "{looked_at}");
    let direct = jumped.steps();
    assert!(direct < 200 * 60, "{direct} steps");
}

/// A border that passes a node makes jumps too short for a while. They are tried again, and longer, soon after.
#[test]
fn jumps_go_on_after_a_hard_place() {
    let overrides = [
        "motion.normal.mean=1.0526315789473685e-6",
        "motion.normal.amplitude=1.0526315789473685e-7",
        "motion.tangential.amplitude=1e-8",
        "numerics.points=80",
        "numerics.steps_per_cycle=75",
        "numerics.integrator=cycle-jump",
        "numerics.tolerance=3e-7",
    ];
    let run = run_setup(load("li2019-fig3", &overrides).setup().clone(), 1000.0);
    let stats = run.state().stats;
    assert!(stats.rejected_jumps > 2, "{stats:?}");
    assert!(run.steps() < 20 * 75, "{} steps: {stats:?}", run.steps());
}

/// Neither narrow cells nor cycles in which hardly anything wears any more ask for more jumps: their length is bound by
/// their error, and not by stiffness.
#[test]
fn stiffness_does_not_bind_jumps() {
    let looked_at = |preset, points: &str, cycles| {
        let points = format!("numerics.points={points}");
        let jumping = ["numerics.integrator=cycle-jump", "numerics.tolerance=1e-3"];
        let steps = "numerics.steps_per_cycle=24";
        let overrides = [&jumping[..], &[&points, steps]].concat();
        let run = run_setup(load(preset, &overrides).setup().clone(), cycles);
        run.state().stats.evaluated_cycles
    };
    for preset in ["strong-wear", "li2019-fig3", "limit-shape"] {
        let [some, all] = [1e4, 1e6].map(|cycles| looked_at(preset, "100", cycles));
        assert!(2 * all < 3 * some, "{preset}: {some} {all}");
    }
    let [wide, narrow] = ["100", "400"].map(|points| looked_at("strong-wear", points, 2000.0));
    assert!(2 * narrow < 3 * wide, "{wide} {narrow}");
}

/// Where jumps are implicit, their error follows the tolerance as well.
#[test]
fn a_stiff_scar_is_jumped_as_well() {
    let overrides = [
        "numerics.integrator=cycle-jump",
        "numerics.steps_per_cycle=24",
    ];
    let mut setup = load("strong-wear", &overrides).setup().clone();
    let fine = run_setup(jumping(&setup, 1e-6), 2000.0);
    for tolerance in [1e-3, 1e-4, 1e-5] {
        setup = jumping(&setup, tolerance);
        let run = run_setup(setup.clone(), 2000.0);
        let [rms, _] = difference(&fine, &run).map(|error| error / 1e-6);
        holds(format!("rms at {tolerance}"), rms, tolerance);
        let volume = (run.wear_volume() / fine.wear_volume() - 1.0).abs();
        holds(format!("volume at {tolerance}"), volume, 3.0 * tolerance);
    }
}

#[test]
fn motions_that_never_repeat_are_stepped() {
    let setup = ours(Scene::fig3(0.01).normal(swing(1.0, 0.1, SQRT_2, 0.0)));
    let jumped = run_setup(jumping(&setup, 1e-3), 30.0);
    let why = jumped.why_never_jumped().expect("a reason");
    has(why, "no common period");
    let stepped = run_setup(setup, 30.0);
    assert_eq!(jumped.state().wear, stepped.state().wear);
    assert_eq!(stepped.why_never_jumped(), None);
}

#[test]
fn a_run_with_jumps_and_changes_repeats_itself() {
    let overrides = ["numerics.integrator=cycle-jump", "wear.coefficient=1e-12"];
    let mut session = begin(load("li2019-fig3", &overrides));
    while session.simulation().cycle() < 500.0 {
        session.step_until(f64::INFINITY).expect("a step");
    }
    change(&mut session, "wear.law", "archard");
    change(&mut session, "friction.coefficient", "0.12");
    for _ in 0..20 {
        session.step_until(f64::INFINITY).expect("a step");
    }
    let cycle = session.simulation().cycle();
    assert!(cycle > 1000.0, "{cycle}");
    let replay = ran(session.as_run(Vec::new()), cycle);
    assert_eq!(replay.simulation().state(), session.simulation().state());
}

/// Of direct stepping: three transforms a step, and one to begin with; now and then the second-order scheme needs another
/// stress, and explicit Euler never. Nothing but steps.
#[test]
fn a_step_costs_its_transforms() {
    for (setup, most) in [(fig3(0.05), 3.5), (as_published(A, fig3(0.05)), 3.0)] {
        let run = run_setup(setup, 10.0);
        let stats = run.state().stats;
        let a_step = (stats.transforms - 1) as f64 / run.state().steps as f64;
        assert!((3.0..=most).contains(&a_step), "{a_step}");
        assert_eq!(stats.contacts, run.state().steps + 1);
        assert_eq!((stats.evaluated_cycles, stats.jumps), (0, 0));
    }
}

/// A state after a jump is one of the steady cycle at that moment: what slips and sticks there, the radii and the regime
/// are those of a run that steps on from it for two cycles, at any phase of the motion.
#[test]
fn a_state_after_a_jump_is_one_of_the_cycle() {
    type Radius = fn(&Moment) -> Option<f64>;
    let radii: [Radius; 2] = [
        |moment| moment.stick_radius,
        |moment| moment.permanent_stick_radius,
    ];
    for (preset, phase, cycles) in [
        ("julia2022-gross-slip", "0", 20_000.0),
        ("julia2022-partial-slip", "0", 300.0),
        ("mild-million", "0", 20_000.0),
        ("mild-million", "0.7853981633974483", 20_000.0),
        ("mild-million", "1.5707963267948966", 20_000.0),
        ("mild-million", "4.2", 20_000.0),
    ] {
        let phase = format!("motion.tangential.phase={phase}");
        let mut session = ran(load(preset, &[&phase]), cycles);
        assert!(session.simulation().state().stats.jumps > 0, "{preset}");
        let seen = |session: &Session| {
            let zones = session.simulation().observe(Curves::ZONES).zones;
            let regime = session.cycle_figures().expect("figures").regime;
            (zones, session.simulation().moment(), regime)
        };
        let (jumped, at_jump, regime) = seen(&session);
        change(&mut session, "numerics.integrator", "direct");
        session.advance_to(cycles + 2.0).expect("two cycles");
        let (stepped, moment, stepped_regime) = seen(&session);
        assert_eq!(regime, stepped_regime, "{preset}");
        let differ = jumped.iter().zip(&stepped).filter(|(a, b)| a != b).count();
        // Where the step before the last one ended, a node may have slipped or not.
        assert!(differ <= 1, "{preset} {phase}: {differ} zones differ");
        let a = moment.contact_radius;
        for of in radii {
            let [jumped, stepped] = [&at_jump, &moment].map(|moment| of(moment).expect("springs"));
            assert!(
                (jumped - stepped).abs() < 0.01 * a,
                "{preset} {phase}: {jumped} {stepped}"
            );
        }
    }
}
