//! Harsh wear: the guard takes every K to its limit, the raw methods fail where it was predicted.

use crate::closed_forms::limiting_profile::LimitingProfile;
use crate::closed_forms::partial_slip::stiffness_ratio;
use crate::common::{
    Scene, holds, in_steps, limit, load, near, ours, rms, run_setup, without_numerics,
};
use crate::test_dir::has;
use mdr_tui::math::abel::AbelMethod::{self, A, APlusB, B, Benad, Product};
use mdr_tui::math::abel::worn;
use mdr_tui::scenario::preset;
use mdr_tui::simulation::{Scheme, Setup, Simulation, Stability};
use mdr_tui::studies::stability::{Ending, StabilityStudy, VISIBLE, Variant, sawtooth};
use std::f64::consts::FRAC_PI_4;

/// Fig. 3 with the default numerics.
fn fig3(wear_number: f64, cells: usize) -> Setup {
    let scene = Scene::fig3(wear_number).cells(cells).steps(100);
    ours(scene.domain(2.2f64.sqrt()))
}

/// The stick radius of the first pass, before the springs have settled: where d ± κu_x from springs that
/// begin unloaded is smallest. What slips there at K = 1e3 wears at once, so that the stick zone which Melan's
/// theorem keeps, 0.4164, is never reached.
fn first_stick_radius() -> f64 {
    let pull = stiffness_ratio(0.3) / 0.1;
    let swing = 0.1 * (1.0 + pull * pull + 2.0 * pull * FRAC_PI_4.cos()).sqrt();
    (1.0 - swing).sqrt()
}

/// rms of f at 401 radii against the limit at the largest depth, in d.
fn limit_error(simulation: &Simulation) -> f64 {
    let limit = LimitingProfile {
        depth: 1.1,
        ..limit(first_stick_radius())
    };
    let (grid, wear) = (&simulation.setup().grid, &simulation.state().wear);
    let radii = (0..=400).map(|i| grid.radius() * f64::from(i) / 400.0);
    rms(radii.map(|r| 0.5 * r * r + worn::interpolate(grid, wear, r) - limit.profile(r)))
}

#[test]
fn the_guard_takes_the_harshest_wear_to_its_limit() {
    holds("c", (first_stick_radius() - 0.3206).abs(), 1e-3);
    let simulation = run_setup(fig3(1e3, 100), 20.0);
    holds("rms of f", limit_error(&simulation), 1e-2);
    assert!(simulation.state().stats.parts > simulation.state().steps / 2);
    assert!(simulation.state().wear.iter().all(|&worn| worn >= 0.0));
}

/// The work of springs that let go is known to a tenth only: at N = 200 and 400, and not to 100 alone, where errors
/// happen to cancel. Where they do not let go, V = kE_d.
#[test]
fn harsh_wear_costs_its_work() {
    for (wear_number, allowed) in [(40.0, 4e-3), (60.0, 4e-3), (1e3, 0.1)] {
        for cells in [200, 400] {
            let simulation = run_setup(fig3(wear_number, cells), 1.0);
            let residual = simulation.moment().energy_residual.expect("worn").abs();
            holds(format!("K = {wear_number}, N = {cells}"), residual, allowed);
        }
    }
}

/// Parts that ring let springs go that hold with fine steps, and the permanent stick zone is lost.
#[test]
fn parts_of_harsh_steps_end_where_fine_steps_do() {
    for (wear_number, cells) in [(50.0, 100), (60.0, 100), (40.0, 200), (60.0, 200)] {
        let fine = run_setup(in_steps(1600, fig3(wear_number, cells)), 3.0);
        let mut parts = run_setup(fig3(wear_number, cells), 1.0);
        let mut highest = 0.0_f64;
        for cycle in 1..=3 {
            parts.advance_to(f64::from(cycle)).expect("a run");
            highest = highest.max(sawtooth(&parts.state().wear));
        }
        assert!(parts.state().stats.parts > 100);
        let radii = (0..=400).map(|i| fine.setup().grid.radius() * f64::from(i) / 400.0);
        let worn = |run: &Simulation, r| worn::interpolate(&run.setup().grid, &run.state().wear, r);
        let rms = rms(radii.map(|r| worn(&parts, r) - worn(&fine, r)));
        let case = format!("rms of f, K = {wear_number}, N = {cells}");
        holds(&case, rms, 2e-3);
        holds("sawtooth", highest, VISIBLE);
    }
}

/// What merely is stiff is taken in short parts, not limited: a part whose wear is limited loses volume.
#[test]
fn few_steps_of_harsh_wear_lose_no_volume() {
    let volume = |steps| run_setup(in_steps(steps, fig3(300.0, 100)), 1.0).wear_volume();
    // Measured: 1.12e-3.
    near("V of 12 steps", volume(12), volume(400), 1.2e-3);
}

#[test]
fn mild_wear_is_the_same_to_the_last_bit_with_and_without_the_guard() {
    for scheme in Scheme::ALL {
        let [guarded, raw] = [Stability::SubStep, Stability::Off].map(|stability| {
            let setup = fig3(0.3, 50);
            run_setup(
                Setup {
                    scheme,
                    stability,
                    ..setup
                },
                5.0,
            )
        });
        assert_eq!(guarded.state().wear, raw.state().wear);
        assert_eq!(guarded.state().stats, raw.state().stats);
        assert_eq!(guarded.state().stats.parts, 0);
        let margin = guarded.moment().stability_margin.expect("it wears");
        assert!(margin > 1.0, "{margin}");
    }
}

#[test]
fn raw_steps_explode_with_a_plain_word() {
    let raw = Setup {
        stability: Stability::Off,
        ..fig3(1e3, 100)
    };
    let mut simulation = Simulation::new(raw).expect("a contact");
    let broken = simulation.advance_to(20.0).expect_err("it explodes");
    has(&broken.to_string(), "numerics.steps_per_cycle");
}

/// 100 steps a cycle against 1000: the permanent stick zone is the same for every wear number. Whether the
/// narrowest cells
/// next to it let go at once is decided by rounding at such K, so that of the profiles one in ten is further
/// apart: their median is what is held.
#[test]
fn the_stick_zone_of_the_first_pass_is_independent_of_the_step() {
    for method in [Product, A] {
        let apart = [920.0, 1e3, 1080.0].map(|k| {
            let [found, finest] = [100, 1000].map(|steps_per_cycle| {
                let setup = in_steps(steps_per_cycle, fig3(k, 100));
                run_setup(Setup { method, ..setup }, 3.0)
            });
            let stuck = |run: &Simulation| run.state().permanent_stick_radius();
            let off = (stuck(&found) / stuck(&finest) - 1.0).abs();
            let case = format!("permanent stick zone of {method}, K = {k}");
            // Close to the sawtooth, rounding decides about one cell: 1.26e-2.
            holds(&case, off, if k > 1e3 { 2e-2 } else { 1e-6 });
            let pairs = found.state().wear.iter().zip(&finest.state().wear);
            rms(pairs.map(|(wear, finest)| wear - finest))
        });
        let median = apart.into_iter().sum::<f64>()
            - apart.into_iter().fold(f64::MIN, f64::max)
            - apart.into_iter().fold(f64::MAX, f64::min);
        holds(format!("profiles of {method}"), median, 1e-3);
    }
}

#[test]
fn smooth_presets_have_no_sawtooth() {
    for preset in preset::ALL.iter().filter(|p| p.name != "harsh-wear") {
        let scenario = load(preset.name, &[]);
        let cycles = scenario.run().cycles.unwrap_or(20.0).min(20.0);
        let simulation = run_setup(scenario.setup().clone(), cycles);
        let depth = simulation.setup().largest_depth();
        let depth = depth.unwrap_or(simulation.moment().depth);
        let height = sawtooth(&simulation.state().wear) / depth;
        holds(preset.name, height, 0.2 * VISIBLE);
    }
}

/// Over N = 25 to 200 and 50 to 200 steps a cycle, the boundary was seen at 1.00 to 1.16 of what is predicted for a and
/// at 0.59 to 1.10 for product, but for 0.41 at N = 100 with 100 steps: there, a small sawtooth comes at single K.
/// Shorter steps bear more: with 400 of them N = 50 shows none up to 1.5 times.
#[test]
fn a_sawtooth_is_seen_where_it_was_predicted() {
    seen_where_predicted(&[
        (Product, 50, 50, 20.0),
        (Product, 100, 100, 20.0),
        (A, 50, 100, 20.0),
        (A, 100, 50, 10.0),
        (APlusB, 50, 50, 20.0),
    ]);
}

/// The constants of b and benad were fitted to Fig. 3 with 20 cycles and amplitudes of 0.1 d: other numbers of
/// cycles. On another motion they are not right: at an amplitude of 0.07 d, a sawtooth of b comes at less than 2/3 of what they
/// say.
#[test]
fn methods_that_no_step_helps_show_a_sawtooth_where_they_did_before() {
    seen_where_predicted(&[
        (B, 50, 50, 5.0),
        (B, 50, 50, 40.0),
        (Benad, 50, 50, 5.0),
        (Benad, 50, 50, 60.0),
    ]);
}

/// How far from the prediction the first sawtooth may be.
const APART: f64 = 1.6;

/// Smooth below the prediction by that factor, and not above.
fn seen_where_predicted(cases: &[(AbelMethod, usize, u32, f64)]) {
    for &(method, points, steps, cycles) in cases {
        let setting = Variant {
            method,
            points,
            steps,
            guard: false,
        };
        let study = study(cycles);
        let run = |rungs: &[f64]| {
            let line = study.line(setting, rungs, &|| true, || {});
            line.expect("runs")
        };
        let predicted = run(&[]).predicted.expect("a boundary");
        let below = run(&[predicted / APART]);
        assert_eq!(below.seen, None, "{setting:?}: {predicted}, {below:?}");
        let above = run(&[predicted * APART]);
        assert!(above.seen.is_some(), "{setting:?}: {predicted}, {above:?}");
    }
}

/// A study of Fig. 3 over this many cycles.
fn study(cycles: f64) -> StabilityStudy {
    let study = StabilityStudy::new(load("li2019-fig3", &[]), cycles).expect("a contact");
    study.expect("it wears")
}

/// By the ladder of the maps. With the guard, springs that let go at once leave a sawtooth of up to 7e-3 d at the end of
/// a cycle at other K, between 15 and 200, until later ones wear them off.
#[test]
fn a_map_has_its_sawtooth_where_predicted_and_with_the_guard_none() {
    let study = study(20.0);
    for (method, points) in [(Product, 100), (A, 50), (A, 100), (APlusB, 100)] {
        let line = |guard| {
            let setting = Variant {
                method,
                points,
                steps: 100,
                guard,
            };
            let rungs = [31.6, 100.0, 316.0, 1000.0];
            let line = study.line(setting, &rungs, &|| true, || {});
            line.expect("runs")
        };
        let ratio = line(false).ratio().expect("a boundary");
        eprintln!("{method}: seen/predicted {ratio:.2}");
        assert!((1.0 / 1.5..1.5).contains(&ratio), "{method}: {ratio}");
        let guarded = line(true);
        let stable = |(_, outcome): &(f64, Ending)| outcome.is_stable();
        assert!(guarded.outcomes.iter().all(stable), "{guarded:?}");
        assert_eq!(guarded.seen, None);
    }
}

#[test]
fn a_scenario_without_numerics_has_limits_on_the_default_level() {
    let scenario = without_numerics(1.0);
    assert!(scenario.accuracy().is_some());
    let study = StabilityStudy::new(scenario, 1.0).expect("a contact");
    assert!(study.is_some(), "something wears");
}
