//! Stresses inside the half-space against closed forms and point forces, on loads as runs produce them.

use std::f64::consts::PI;

use crate::closed_forms::half_space::{
    DEPTH_OF_LARGEST, LARGEST_VON_MISES, by_point_forces, hertz_on_axis, hertz_outside,
    sliding_at_trailing_edge, sliding_inside,
};
use crate::common::{Scene, apart, holds, ours, run_setup};
use mdr_tui::contact::indenter::Indenter;
use mdr_tui::reading::Curves;
use mdr_tui::reading::subsurface::{SpringLoad, Stress};
use mdr_tui::simulation::Simulation;

/// p₀ of the default scene: E* = R = d = 1 and a = 1.
const P0: f64 = 2.0 / PI;

fn load_of(simulation: &Simulation) -> SpringLoad {
    simulation
        .observe(Curves::SPRINGS)
        .spring_load(simulation.setup().material.poisson())
}

/// The Hertz contact of a run with the default numerics on 100 cells.
fn hertz(poisson: f64) -> SpringLoad {
    load_of(&run_setup(
        ours(Scene::default().poisson(poisson).still()),
        0.25,
    ))
}

/// The same contact, slipping as a whole towards +x: u_x is at its largest.
fn sliding(poisson: f64) -> SpringLoad {
    let scene = Scene::default().poisson(poisson).shaken(10.0);
    load_of(&run_setup(ours(scene), 0.25))
}

#[test]
fn hertz_on_the_axis() {
    for poisson in [0.0, 0.3, 0.5] {
        let load = hertz(poisson);
        let mut worst: f64 = 0.0;
        for k in 0..=60 {
            let z = f64::from(k) * 0.05;
            let seen = load.stress(0.0, z);
            let [radial, axial] = hertz_on_axis(z, poisson);
            for (seen, exact) in [(seen.xx, radial), (seen.yy, radial), (seen.zz, axial)] {
                worst = worst.max((seen / P0 - exact).abs());
            }
            assert_eq!(seen.xz, 0.0);
        }
        holds("Hertz on the axis", worst, 1e-3);
    }
}

#[test]
fn the_largest_von_mises_stress_is_below_the_surface() {
    let load = hertz(0.3);
    let depths = (0..1500).map(|k| f64::from(k) * 1e-3);
    let points = depths.map(|z| (z, load.stress(0.0, z).von_mises() / P0));
    let largest = points.max_by(|a, b| a.1.total_cmp(&b.1));
    let (depth, largest) = largest.expect("points");
    let off = (largest - LARGEST_VON_MISES).abs();
    holds("largest von Mises stress", off, 1e-3);
    holds("its depth", (depth - DEPTH_OF_LARGEST).abs(), 2e-3);
    let found = load.largest(Stress::von_mises);
    holds("found", (found.value / P0 - largest).abs(), 1e-5);
    holds("its place", (found.z - depth).hypot(found.x), 5e-3);
    // Nowhere off the axis is it larger.
    for x in [0.1, 0.4, 0.8, 1.0, 1.2] {
        for k in 0..30 {
            assert!(load.stress(x, f64::from(k) * 0.05).von_mises() / P0 < LARGEST_VON_MISES);
        }
    }
}

#[test]
fn the_surface_outside_is_in_pure_shear() {
    for poisson in [0.0, 0.3, 0.5] {
        let load = hertz(poisson);
        for r in [1.01, 1.2, 1.5, 3.0] {
            let seen = load.stress(-r, 0.0);
            let exact = hertz_outside(r, poisson);
            holds("σ_r", (seen.xx / P0 - exact).abs(), 1e-3);
            holds("σ_θ", (seen.yy / P0 + exact).abs(), 1e-3);
            holds("σ_z", seen.zz.abs() / P0, 1e-6);
        }
    }
}

/// What the traction adds: everything but σ_xz changes sign from +x to −x, and p does not.
fn of_traction(load: &SpringLoad, x: f64) -> f64 {
    let [right, left] = load.mirrored(x.abs(), 0.0);
    x.signum() * (right.xx - left.xx) / (2.0 * 0.1 * P0)
}

#[test]
fn a_sliding_contact_tears_at_its_trailing_edge() {
    for poisson in [0.0, 0.3, 0.5] {
        let load = sliding(poisson);
        for x in [-0.95, -0.5, -0.1, 0.3, 0.8] {
            let error = of_traction(&load, x) - sliding_inside(x, poisson);
            let bound = 1e-3 * sliding_at_trailing_edge(poisson);
            holds("σ_xx inside", error.abs(), bound);
        }
        let edge = of_traction(&load, -load.contact_radius());
        let exact = sliding_at_trailing_edge(poisson);
        holds("σ_xx at the edge", (edge / exact - 1.0).abs(), 1e-3);
        // The largest tension is there, on the surface.
        let torn = load.largest(Stress::max_principal);
        assert!((torn.x + 1.0).abs() < 0.01 && torn.z < 0.01, "{torn:?}");
    }
}

#[test]
fn every_component_is_that_of_the_point_forces() {
    let load = sliding(0.3);
    let hertz = |r: f64| P0 * (1.0 - r * r).sqrt();
    for (x, z) in [
        (0.3, 0.4),
        (-0.7, 0.25),
        (1.1, 0.5),
        (0.0, 1.0),
        (-1.4, 1.5),
    ] {
        let exact = by_point_forces([x, z], 0.3, hertz, |r| 0.1 * hertz(r), 60);
        let Stress { xx, yy, zz, xz } = load.stress(x, z);
        let off = apart(&[xx, yy, zz, xz], &exact);
        holds(format!("stress at {x}, {z}"), off / P0, 1e-3);
    }
}

#[test]
fn partial_slip_and_worn_contacts_carry_their_own_tractions_into_the_half_space() {
    let simulation = run_setup(ours(Scene::default().wear(0.3)), 10.25);
    let seen = simulation.observe(Curves::all());
    let load = seen.spring_load(0.3);
    let a = seen.moment.contact_radius;
    // On the surface the stresses are the tractions that the run computed by other means.
    for (j, &r) in seen.radii().iter().enumerate() {
        if (0.05..0.95).contains(&(r / a)) {
            let below = load.stress(r, 0.0);
            let peak = seen.pressure()[0];
            let [p, tau] = [below.zz + seen.pressure()[j], below.xz + seen.shear()[j]];
            holds("−σ_zz = p", p.abs() / peak, 2e-2);
            holds("−σ_xz = τ", tau.abs() / (0.1 * peak), 2e-2);
        }
    }
}

#[test]
fn a_flat_punch_ends_with_a_jump() {
    let punch = Indenter::flat_punch(1.0).expect("a punch");
    let scene = Scene::default().indenter(punch).still().domain(1.0);
    let load = load_of(&run_setup(scene.into(), 0.25));
    for z in [0.2, 0.5, 1.0, 2.0] {
        // Sneddon: on the axis σ_z = −(E*d/πa)(1 + 3z²)/(1 + z²)².
        let exact = -(1.0 + 3.0 * z * z) / (PI * (1.0 + z * z) * (1.0 + z * z));
        holds("punch", (load.stress(0.0, z).zz - exact).abs(), 1e-3);
    }
}

#[test]
fn nothing_in_contact_stresses_nothing() {
    let load = SpringLoad::new(&[0.0, 1.0, 2.0], &[0.0; 3], &[0.0; 3], 0.0, 0.3);
    assert_eq!(load.stress(0.3, 0.2), Stress::default());
}
