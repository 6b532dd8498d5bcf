//! The engine against closed forms; every bound is a constant times a power of the cell's width h.
//!
//! The constants are about 1.5 times what was measured at N = 50 … 800.

use crate::closed_forms::dual_oscillation::{DualOscillation, Frequencies};
use crate::closed_forms::flat_punch::FlatPunch;
use crate::closed_forms::fretting_loop::Branch;
use crate::closed_forms::limiting_profile::LimitingProfile;
use crate::closed_forms::partial_slip::stiffness_ratio;
use crate::closed_forms::power_law::PowerLaw;
use crate::closed_forms::truncated::TruncatedParaboloid;
use crate::common::{
    PUBLISHED, Scene, cattaneo, fig3_motion, force, holds, largest, limit, near, run, swing,
};
use mdr_tui::contact::indenter::Indenter;
use mdr_tui::math::abel::AbelMethod::{self, A, APlusB, B, Benad, Product};
use mdr_tui::reading::Curves;
use mdr_tui::scenario::Scenario;
use mdr_tui::simulation::Simulation;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};
use std::ops::Range;

/// A displacement in shares of the one at which everything slips.
fn amplitude(share: f64) -> f64 {
    share * cattaneo(0.0).gross_slip_displacement()
}

/// The largest |value − exact| over the nodes in a range of radii.
fn worst(radii: &[f64], values: &[f64], range: Range<f64>, exact: impl Fn(f64) -> f64) -> f64 {
    let nodes = radii.iter().zip(values);
    largest(
        nodes
            .filter(|(r, _)| range.contains(r))
            .map(|(&r, value)| (value - exact(r)).abs()),
    )
}

/// h.
fn width(simulation: &Simulation) -> f64 {
    simulation.setup().grid.nodes()[1]
}

const EVERYWHERE: Range<f64> = 0.0..f64::INFINITY;

/// `bounds`, a factor and a power of h each: of g, of a, F and d, of p in 0.2 … 0.8 and of p in all but the axis.
fn check_normal(
    methods: &[AbelMethod],
    indenter: Indenter,
    exact: PowerLaw,
    bounds: [(f64, f64); 4],
) {
    let cases = methods
        .iter()
        .flat_map(|&method| [(method, 50), (method, 200)]);
    for (method, cells) in cases {
        let scene = Scene::by(method).indenter(indenter.clone());
        let scene = scene.cells(cells).still();
        let simulation = run(scene.clone(), 0.0);
        let h = width(&simulation);
        let [profile, scalars, pressure, edge] =
            bounds.map(|(factor, power)| factor * h.powf(power));
        let seen = simulation.observe(Curves::all());
        let what = |name| format!("{} by {method}, N={cells}, {name}", indenter.name());
        let g = |x| exact.mdr_profile(x);
        let p = |r| exact.pressure(1.0, 1.0, r);
        let load = exact.force(1.0, 1.0);
        let error = worst(seen.radii(), seen.profile_1d(), EVERYWHERE, g);
        holds(what("g"), error, profile);
        let error = (seen.moment.contact_radius - 1.0).abs();
        holds(what("a"), error, scalars);
        let error = (seen.moment.normal_force / load - 1.0).abs();
        holds(what("F"), error, scalars);
        let held = scene.normal(force(load, 0.0));
        let error = (run(held, 0.0).moment().depth - 1.0).abs();
        holds(what("d of F"), error, scalars);
        let error = worst(seen.radii(), seen.pressure(), 0.2..0.8, p);
        holds(what("p inside"), error, pressure);
        let error = worst(seen.radii(), seen.pressure(), 0.5 * h..1.5, p);
        holds(what("p"), error, edge);
    }
}

#[test]
fn hertz() {
    let shape = Indenter::paraboloid(1.0).expect("a shape");
    let bounds = [(1.2, 1.5), (0.5, 1.5), (0.5, 1.5), (0.3, 0.5)];
    check_normal(&PUBLISHED, shape, PowerLaw::paraboloid(1.0), bounds);
}

/// Exact to rounding for methods that take f as piecewise linear; B's f′ = 0 at the tip costs order ½.
#[test]
fn cone() {
    let shape = Indenter::cone(FRAC_2_PI.atan()).expect("a shape");
    let exact = [(1e-13, 0.0), (1e-13, 0.0), (0.04, 1.5), (0.17, 0.5)];
    let of_b = [(0.75, 1.0), (1.0, 1.0), (0.25, 1.0), (0.27, 0.5)];
    for (methods, bounds) in [(&[A, APlusB, Benad][..], exact), (&[B], of_b)] {
        check_normal(methods, shape.clone(), PowerLaw::cone(FRAC_2_PI), bounds);
    }
}

#[test]
fn quartic() {
    let shape = Indenter::power(0.375, 4.0).expect("a shape");
    let bounds = [(11.0, 1.5), (0.7, 1.5), (1.2, 1.5), (0.6, 0.5)];
    check_normal(&PUBLISHED, shape, PowerLaw::quartic(0.375), bounds);
}

/// A punch exactly; a flat tip but for a tenth of a about its edge, where p is infinite.
#[test]
fn flat_faces() {
    for (cells, bound) in [("50", 6e-3), ("200", 1e-3)] {
        let pressed = |preset| {
            let sets = [
                format!("numerics.points={cells}"),
                "numerics.grid=uniform".into(),
            ];
            let scenario = Scenario::load(preset, &sets).expect("a scenario");
            Simulation::new(scenario.setup().clone()).expect("a contact")
        };
        let simulation = pressed("flat-punch");
        let (setup, seen) = (simulation.setup(), simulation.observe(Curves::PRESSURE));
        let punch = FlatPunch {
            e_star: setup.material.normal_modulus(),
            g_star: setup.material.tangential_modulus(),
            mu: setup.material.friction(),
            radius: setup.indenter.rim().expect("a punch"),
            depth: seen.moment.depth,
        };
        let a = punch.radius;
        let mean = punch.force() / (PI * a * a);
        let inside = 0.0..a * (1.0 - 1e-9);
        let error = worst(seen.radii(), seen.pressure(), inside, |r| punch.pressure(r));
        holds(format!("p of a punch, N={cells}"), error / mean, 1e-12);

        let simulation = pressed("truncated-paraboloid");
        let (setup, seen) = (simulation.setup(), simulation.observe(Curves::PRESSURE));
        let tip = TruncatedParaboloid {
            e_star: setup.material.normal_modulus(),
            radius: 0.01,
            tip_radius: setup.indenter.tip_radius(),
        };
        let (a, b) = (tip.contact_radius(seen.moment.depth), tip.tip_radius);
        let mean = tip.force(a) / (PI * a * a);
        for range in [0.0..b - 0.1 * a, b + 0.1 * a..a] {
            let error = worst(seen.radii(), seen.pressure(), range, |r| tip.pressure(a, r));
            holds(format!("p of a flat tip, N={cells}"), error / mean, bound);
        }
    }
}

#[test]
fn cattaneo_and_mindlin_on_first_loading() {
    for method in PUBLISHED {
        for cells in [50, 200, 800] {
            for share in [0.01, 0.3, 0.7, 0.95] {
                let exact = cattaneo(amplitude(share));
                let motion = swing(0.0, exact.amplitude, 1.0, FRAC_PI_2);
                let simulation = run(Scene::by(method).cells(cells).moved(motion), 0.0);
                let h = width(&simulation);
                let seen = simulation.observe(Curves::all());
                let moment = seen.moment;
                let what = |name| format!("U={share}U_s by {method}, N={cells}, {name}");
                let c = moment.stick_radius.expect("springs");
                let error = (c - exact.stick_radius()).abs();
                holds(what("c"), error, 1.6 * h.powf(1.5));
                let friction = exact.mu * exact.normal_force();
                let load = exact.first_loading_force(exact.amplitude);
                let error = (moment.tangential_force - load).abs() / friction;
                holds(what("F_x"), error, 0.6 * h.powf(1.5));
                let tau = |r| exact.shear_stress(r);
                let error = worst(seen.radii(), seen.shear(), EVERYWHERE, tau);
                holds(what("tau"), error, 0.04 * h.sqrt());
                let slip: Vec<f64> = seen.surface().iter().map(|u| exact.amplitude - u).collect();
                let error = worst(seen.radii(), &slip, 0.0..1.0, |r| exact.slip(r));
                let bound = match method {
                    A | Product => 0.04 * h.powf(1.5),
                    APlusB | B => 0.1 * h.powf(1.5),
                    Benad => 0.07 * h,
                };
                holds(what("slip"), error, bound);
            }
        }
    }
}

/// The loop and its energy depend on the springs alone, so not on how many steps a cycle takes:
/// a spring that slips stands at its limit wherever the step ends.
#[test]
fn the_loop_and_its_energy() {
    for method in PUBLISHED {
        for (cells, share) in [
            (50, 0.1),
            (50, 0.5),
            (50, 0.9),
            (50, 1.5),
            (200, 0.1),
            (200, 0.9),
            (200, 1.5),
        ] {
            let exact = cattaneo(amplitude(share));
            let friction = exact.mu * exact.normal_force();
            let energy = [8, 40].map(|steps| {
                let scene = Scene::by(method).cells(cells).steps(steps);
                let scene = scene.shaken(exact.amplitude);
                // From the turning point +U on.
                let mut simulation = run(scene, 1.25);
                let before = simulation.state().ledger.dissipated_energy;
                let error = largest((0..steps).map(|i| {
                    simulation.step().expect("a step");
                    let moment = simulation.moment();
                    let branch = if i < steps / 2 {
                        Branch::Unloading
                    } else {
                        Branch::Reloading
                    };
                    let u = moment.shift.clamp(-exact.amplitude, exact.amplitude);
                    (moment.tangential_force - exact.loop_force(branch, u)).abs() / friction
                }));
                let what = format!("U={share}U_s by {method}, N={cells}, {steps} steps, F_x(u)");
                holds(&what, error, 0.5 * width(&simulation).powf(1.5));
                simulation.state().ledger.dissipated_energy - before
            });
            let what = format!("U={share}U_s by {method}, N={cells}, energy");
            let case = format!("{what} of 8 against 40 steps");
            holds(&case, (energy[0] / energy[1] - 1.0).abs(), 1e-12);
            // The slipping ring is what has to be resolved.
            let ring = 1.0 - exact.stick_radius();
            let h = 1.5 / cells as f64;
            let error = (energy[1] / exact.energy_per_cycle() - 1.0).abs();
            holds(&what, error, 0.6 * h.powf(1.5) / ring);
        }
    }
}

/// On a practically frozen profile a cycle wears 4μk p s, in units of its peak; where τ has its
/// root at the edge only to order ½.
#[test]
fn the_wear_of_a_settled_cycle() {
    let exact = cattaneo(0.05);
    let k = 1e-9;
    let peak = largest((0..1000).map(|i| exact.wear_per_cycle(1.0, f64::from(i) / 1000.0)));
    for method in PUBLISHED {
        for cells in [50, 200] {
            let scene = Scene::by(method).cells(cells).steps(200).wear(k);
            let mut simulation = run(scene, 1.25);
            let before = simulation.state().wear.clone();
            simulation.advance_to(2.25).expect("a cycle");
            let after = simulation.state().wear.iter();
            let worn: Vec<f64> = after
                .zip(&before)
                .map(|(a, b)| (a - b) / k / peak)
                .collect();
            let h = width(&simulation);
            let radii = simulation.setup().grid.nodes();
            let wear = |r| exact.wear_per_cycle(1.0, r) / peak;
            let what = |name| format!("wear a cycle by {method}, N={cells}, {name}");
            let bound = match method {
                A | Product => 4.5 * h.powf(1.5),
                APlusB => 10.0 * h.powf(1.5),
                B => 2.8 * h,
                Benad => 13.0 * h,
            };
            let error = worst(radii, &worn, 0.0..1.0 - 2.0 * h, wear);
            holds(what("inside"), error, bound);
            let error = worst(radii, &worn, EVERYWHERE, wear);
            holds(what("with the edge"), error, bound.max(2.2 * h.sqrt()));
        }
    }
}

/// V = k E_d, the 3D side against the 1D side, over ten cycles that wear visibly.
#[test]
fn volume_is_k_times_energy() {
    for (method, constant) in [(A, 1.2), (APlusB, 2.6), (B, 2.2), (Benad, 8.5)] {
        let residual = [100, 400].map(|cells| {
            let scene = Scene::by(method).cells(cells).wear(0.3);
            let simulation = run(scene, 10.0);
            let moment = simulation.moment();
            let residual = moment.energy_residual.expect("wear").abs();
            let direct = 1.0 - moment.wear_volume / (0.3 * moment.dissipated_energy);
            assert!(
                (direct.abs() - residual).abs() < 1e-12,
                "{direct} {residual}"
            );
            let what = format!("1 - V/kE_d by {method}, N={cells}");
            holds(&what, residual, constant * width(&simulation));
            residual
        });
        // Better than first order.
        holds(format!("fall by {method}"), residual[1] / residual[0], 0.25);
    }
}

/// What endless fretting leaves: N decides all but the ring, which time has brought to g = d.
#[test]
fn the_limiting_profile() {
    let exact = limit(cattaneo(0.05).stick_radius());
    let (b, c) = (exact.outer_radius(), exact.stick_radius);
    for method in [A, APlusB] {
        for cells in [50, 100, 200] {
            let scene = Scene::by(method).cells(cells).wear(3.0);
            let simulation = run(scene, 400.0);
            let h = width(&simulation);
            let seen = simulation.observe(Curves::all());
            let what = |name| format!("limit by {method}, N={cells}, {name}");
            let permanent = seen.moment.permanent_stick_radius.expect("springs");
            // Near the limit d − g falls to nothing within c's cell: it can only be placed in it.
            holds(what("c"), (permanent - c).abs(), h);
            let error = worst(seen.radii(), seen.profile(), EVERYWHERE, |r| {
                exact.profile(r)
            });
            holds(what("f"), error, 0.8 * h);
            let g = |x| exact.mdr_profile(x);
            let stuck = worst(seen.radii(), seen.profile_1d(), 0.0..c - h, g);
            let case = what("g in the permanent stick zone");
            holds(&case, stuck, 0.4 * h.powf(1.5));
            let ring = c + 2.0 * h..b - 2.0 * h;
            let ring = worst(seen.radii(), seen.profile_1d(), ring, |_| 1.0);
            holds(what("g in the ring"), ring, 1e-7);
            let error = (seen.moment.normal_force / exact.force() - 1.0).abs();
            holds(what("F"), error, 0.4 * h);
        }
    }
}

/// Both forces held: c stays, the depth grows to N/(2E*c) + c²/3R.
#[test]
fn the_limiting_depth_under_held_forces() {
    let partial = cattaneo(0.05);
    let (load, c) = (partial.normal_force(), partial.stick_radius());
    let exact = LimitingProfile::under_force(1.0, 1.0, load, c);
    for method in [A, APlusB] {
        for cells in [50, 100] {
            let swing = force(0.0, partial.first_loading_force(0.05));
            let scene = Scene::by(method).cells(cells).wear(3.0);
            let simulation = run(scene.normal(force(load, 0.0)).moved(swing), 300.0);
            let h = width(&simulation);
            let moment = simulation.moment();
            let what = |name| format!("held forces by {method}, N={cells}, {name}");
            near(what("F_z"), moment.normal_force, load, 1e-12);
            holds(what("d"), (moment.depth - exact.depth).abs(), 0.4 * h);
            let permanent = moment.permanent_stick_radius.expect("springs");
            // Near the limit d − g falls to nothing within c's cell: it can only be placed in it.
            holds(what("c"), (permanent - c).abs(), h);
        }
    }
}

/// Without a stick zone the tip wears too: the contact unloads towards f = d and never past it.
#[test]
fn gross_slip_unloads_the_contact() {
    for method in PUBLISHED {
        let scene = Scene::by(method).wear(1.0).shaken(amplitude(1.5));
        let mut simulation = run(scene, 0.0);
        let (unworn, mut before) = (simulation.moment().normal_force, f64::INFINITY);
        for cycle in 1..=200 {
            simulation.advance_to(f64::from(cycle)).expect("a cycle");
            let load = simulation.moment().normal_force;
            assert!(load < before, "{method}: {load} after {before}, {cycle}");
            before = load;
        }
        holds(format!("load left by {method}"), before / unworn, 0.01);
        let seen = simulation.observe(Curves::PROFILE);
        let nodes = seen.profile().iter().zip(seen.wear());
        let worn = nodes.filter(|(_, w)| **w > 0.0);
        let touched = largest(worn.map(|(f, _)| *f));
        holds(format!("highest worn point by {method}"), touched, 1.0);
        holds(format!("tip left by {method}"), 1.0 - seen.wear()[0], 0.01);
    }
}

/// The contact opens in a part of every cycle.
#[test]
fn separation_leaves_no_traction_and_no_memory() {
    for method in PUBLISHED {
        let scene = Scene::by(method).wear(0.5).steps(100);
        let scene = scene.normal(swing(0.3, 0.7, 1.0, 0.0));
        let mut simulation = run(scene.moved(swing(0.0, 0.1, 1.0, 0.8)), 0.0);
        let reach = 0.1 / stiffness_ratio(0.3);
        let (mut open_steps, mut touching) = (0, 0);
        let mut before = simulation.observe(Curves::all());
        for _ in 0..400 {
            simulation.step().expect("a step");
            let now = simulation.observe(Curves::all());
            let moved = now.moment.shift - before.moment.shift;
            if now.moment.depth <= 0.0 && now.moment.normal_force == 0.0 {
                open_steps += 1;
                let [radius, force] = [now.moment.contact_radius, now.moment.tangential_force];
                assert_eq!([radius, force], [0.0; 2]);
                for curve in [now.pressure(), now.shear(), now.spring(), now.surface()] {
                    assert!(curve.iter().all(|&value| value == 0.0));
                }
                assert!(now.tangential_load().iter().all(|&load| load == 0.0));
                assert_eq!(now.wear(), before.wear());
            }
            for (j, &load) in now.normal_load().iter().enumerate() {
                if load == 0.0 {
                    assert_eq!((now.spring()[j], now.tangential_load()[j]), (0.0, 0.0));
                } else if before.normal_load()[j] == 0.0 {
                    touching += 1;
                    let fresh = moved.clamp(-reach * load, reach * load);
                    let case = format!("node {j} by {method}");
                    holds(&case, (now.spring()[j] - fresh).abs(), 1e-15);
                }
            }
            before = now;
        }
        assert!(open_steps > 50 && touching > 100, "{open_steps} {touching}");
    }
}

/// Tangential and normal frequency, and cycles until it has repeated twice.
const RATIOS: [(u32, u32, f64); 3] = [(1, 2, 3.0), (2, 3, 5.0), (3, 1, 7.0)];

/// Melan's permanent stick radius within a cell.
#[test]
fn melan() {
    let motion = |swing: f64, phases: [f64; 2], amplitude: f64, frequencies| DualOscillation {
        normal_amplitude: swing,
        normal_phase: phases[0],
        tangential_amplitude: amplitude,
        tangential_phase: phases[1],
        frequencies,
        ..fig3_motion()
    };
    let fig3 = fig3_motion();
    let own = (fig3.stick_radius(1.0) - 0.4164).abs();
    holds("Fig. 3, the oracle's own", own, 5e-5);
    let mut cases = vec![(1.0, fig3, 3.0)];
    for (swing, phases, amplitude) in [
        (0.1, [0.0, 0.0], 0.05),
        (0.1, [0.0, FRAC_PI_2], 0.05),
        (0.2, [0.3, 2.0], 0.03),
        (1.2, [0.0, 1.0], 0.05),
    ] {
        let motion = motion(swing, phases, amplitude, Frequencies::Equal);
        cases.push((1.0, motion, 3.0));
    }
    let never = motion(0.1, [0.0, 0.3], 0.05, Frequencies::Incommensurate);
    cases.push((std::f64::consts::SQRT_2, never, 41.0));
    for (tangential, normal, cycles) in RATIOS {
        let ratio = f64::from(normal) / f64::from(tangential);
        let frequencies = Frequencies::Rational { tangential, normal };
        cases.push((ratio, motion(0.1, [0.0, 0.3], 0.05, frequencies), cycles));
    }
    for (ratio, exact, cycles) in cases {
        for (method, cells) in [(A, 100), (A, 400), (B, 100)] {
            let up = swing(1.0, exact.normal_amplitude, ratio, exact.normal_phase);
            let (amplitude, phase) = (exact.tangential_amplitude, exact.tangential_phase);
            let scene = Scene::by(method).cells(cells).steps(200).normal(up);
            let scene = scene.domain((2.0 * exact.largest_depth()).sqrt());
            let simulation = run(scene.moved(swing(0.0, amplitude, 1.0, phase)), cycles);
            let c = simulation.state().permanent_stick_radius();
            let what = format!("c by {method}, N={cells}, ratio {ratio}, {exact:?}");
            let off = (c - exact.stick_radius(1.0)).abs();
            holds(&what, off, width(&simulation));
        }
    }
}
