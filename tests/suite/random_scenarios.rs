//! Random scenarios that a rig could run, to test error estimates on.
//!
//! Each seed gives one scenario, the same on every machine and in every version.
//!
//! What is drawn are dimensionless numbers, in the ranges of real fretting tests:
//!
//! | number | range |
//! |---|---|
//! | contact radius over size of the indenter | 0.003 to 0.1 |
//! | amplitude of the depth over its mean | 0, or 0.01 to 0.5; above 1 with lift-off |
//! | amplitude of the shift over that of gross slip | 0.15 to 2 |
//! | amplitude of the tangential force over μF_z | 0.3 to 0.85 |
//! | ω₁/ω₂ | 1, 2, 3, 5, 1/2, 1/3, 3/2, √2 |
//! | rubbed-off depth in depths, 4kμE*Uz/a over the run | 0.05 to 3 |
//! | cycles z | 3 to 100, up to 3000 where cycles are jumped; from the seed [`LONG`] on, 1e4 to 1e6 |
//!
//! Seeds from [`KINDS`] on add [more kinds](crate::random_kinds) to these.

use std::f64::consts::{PI, SQRT_2, TAU};

use mdr_tui::contact::indenter::Indenter;
use mdr_tui::math::geometry::Geometry;
use mdr_tui::scenario::Scenario;

use crate::random::Random;
use crate::random_kinds::{self, KINDS, Known};

/// From this seed on runs are long, and forces held and lift-off more frequent.
pub const LONG: u64 = 1_000_000;

/// From this seed on contacts are lines, under forces or against a gauge.
pub const LINES: u64 = 3_000_000;

/// The scenario of a seed.
///
/// # Panics
/// If the scenario is refused, which the tests rule out for the first thousand seeds.
pub fn scenario(seed: u64) -> Scenario {
    let text = text(seed);
    match Scenario::from_toml(&text, &format!("random-{seed}"), &[]) {
        Ok(scenario) => scenario,
        Err(error) => panic!("random scenario {seed}: {error}\n{text}"),
    }
}

/// The scenario of a seed as TOML.
pub fn text(seed: u64) -> String {
    let (text, known) = first(seed);
    match (KINDS..LINES).contains(&seed) {
        false => text,
        true => random_kinds::extend(&text, &known, &mut Random::new(!seed)),
    }
}

/// The scenario of the first family that belongs to a seed, and what is known of it.
pub fn first(seed: u64) -> (String, Known) {
    let mut draw = Random::new(seed);
    let shape = Shape::draw(&mut draw);
    let poisson = draw.between(0.0, 0.5);
    let modulus = draw.log_between(1e9, 4e11);
    let friction = draw.log_between(0.05, 1.0);
    // G*/E* and κ = G*/(μE*): a shift of d/κ makes the whole unworn contact slip.
    let is_line = seed >= LINES;
    let stiffness_ratio = match is_line {
        true => 1.0,
        false => 2.0 * (1.0 - poisson) / (2.0 - poisson),
    };
    let stick_ratio = stiffness_ratio / friction;
    let pressed = match is_line {
        true => shape.pressed_line(modulus),
        false => shape.pressed(modulus),
    };

    let is_long = seed >= LONG && !is_line && (seed < KINDS || seed.is_multiple_of(10));
    let by_force = draw.chance(if is_long { 0.6 } else { 0.3 }) || is_line;
    let tangential_by_force = by_force && draw.chance(0.4);
    let lifts = !tangential_by_force && draw.chance(if is_long { 0.25 } else { 0.1 });
    let swing = match (lifts, draw.chance(0.35)) {
        (true, _) => draw.between(1.1, 2.5),
        (false, true) => 0.0,
        (false, false) => draw.log_between(0.01, if tangential_by_force { 0.2 } else { 0.5 }),
    };
    let ratio = match (swing > 0.0, draw.chance(0.55)) {
        // Cycles that never repeat are all stepped.
        (true, false) if is_long => draw.pick(&[2.0, 3.0, 0.5, 1.5]),
        (true, false) => draw.pick(&[2.0, 3.0, 5.0, 0.5, 1.0 / 3.0, 1.5, SQRT_2]),
        _ => 1.0,
    };
    // The deepest moment is the one that was pressed.
    let most = if by_force {
        pressed.force
    } else {
        pressed.depth
    };
    let mean = most / (1.0 + swing);
    let least = (mean * (1.0 - swing)).max(0.0);

    let gross_slip = pressed.depth / stick_ratio;
    let (amplitude, shift) = if tangential_by_force {
        let share = draw.between(0.3, 0.85);
        let force = share * friction * least;
        let compliance = 1.0 / (2.0 * stiffness_ratio * modulus * pressed.radius);
        let yields = if is_line { modulus.recip() } else { compliance };
        (force, force * yields)
    } else {
        let shift = gross_slip * draw.log_between(0.15, 2.0);
        (shift, shift)
    };
    // Partial slip rubs by a small part of the shift alone.
    let rubbed = shift * (shift / gross_slip).clamp(0.1, 1.0);

    let jumps = (is_long || draw.chance(0.25)) && ratio != SQRT_2;
    let cycles = match (is_long, jumps) {
        (true, _) => draw.log_between(1e4, 1e6),
        (false, jumps) => draw.log_between(3.0, if jumps { 3000.0 } else { 100.0 }),
    };
    let cycles = if draw.chance(0.5) {
        cycles.round()
    } else {
        cycles
    };
    let most_worn = if by_force { 1.0 } else { 3.0 };
    let worn = draw.log_between(0.05, most_worn).min(0.5 * cycles);
    let coefficient = worn * pressed.radius / (4.0 * friction * modulus * rubbed * cycles);

    let frequency = draw.log_between(1.0, 1e3);
    // Against a gauge, a line that slips as a whole has moved by more than its springs.
    let gauge =
        (is_line && !tangential_by_force).then(|| pressed.radius * draw.log_between(5.0, 500.0));
    let elastic = gauge.map_or(1.0, |gauge| {
        (2.0 * gauge / pressed.radius).ln() * 2.0 / PI + 0.3
    });
    let mut toml = format!(
        "title = \"Random scenario {seed}\"\n[indenter]\n{}[material]\neffective_modulus = {modulus:e}\n\
         poisson = {poisson}\n[friction]\ncoefficient = {friction}\n",
        shape.toml()
    );
    if is_line {
        toml = toml.replacen("[indenter]", "[indenter]\ngeometry = \"line\"", 1);
    }
    let control = |force: bool| if force { "force" } else { "displacement" };
    let mut motion = |name: &str, force: bool, mean: f64, amplitude: f64, frequency: f64, phase| {
        toml += &format!(
            "[motion.{name}]\ncontrol = \"{}\"\nmean = {mean:e}\namplitude = {amplitude:e}\n\
             angular_frequency = {frequency}\nphase = {phase}\n",
            control(force)
        );
    };
    let phases = [draw.between(0.0, TAU), draw.between(0.0, TAU)];
    motion(
        "normal",
        by_force,
        mean,
        mean * swing,
        frequency * ratio,
        phases[0],
    );
    motion(
        "tangential",
        tangential_by_force,
        0.0,
        amplitude * elastic,
        frequency,
        phases[1],
    );
    if let Some(gauge) = gauge {
        toml += &format!("gauge_length = {gauge:e}\n");
    }
    toml += &format!("[wear]\ncoefficient = {coefficient:e}\n");
    if draw.chance(0.25) {
        toml += &format!(
            "law = \"power\"\nstress_exponent = {}\nslip_rate_exponent = {}\n",
            draw.between(0.7, 2.0),
            draw.between(0.7, 1.5)
        );
    }
    if jumps {
        toml += "[numerics]\nintegrator = \"cycle-jump\"\n";
    }
    toml += &format!("[run]\ncycles = {cycles}\n");
    if draw.chance(0.15) {
        let at = cycles * draw.between(0.2, 0.7);
        // What is prescribed grows at most by a tenth, so that no force runs out of contact.
        let (key, value) = match draw.pick(&[0, 1, 2, 3]) {
            0 => ("motion.normal.mean", mean * draw.between(0.7, 1.1)),
            1 => (
                "motion.tangential.amplitude",
                amplitude * elastic * draw.between(0.5, 1.1),
            ),
            2 => ("wear.coefficient", coefficient * draw.log_between(0.3, 3.0)),
            _ => ("friction.coefficient", friction * draw.between(0.95, 1.3)),
        };
        toml += &format!("[[changes]]\nat_cycle = {at}\nset = \"{key} = {value:e}\"\n");
    }
    let known = Known {
        friction,
        coefficient,
        cycles,
        force: pressed.force,
        radius: pressed.radius,
        depth: pressed.depth,
        stiffness: 2.0 * stiffness_ratio * modulus * pressed.radius,
        shift,
        gross_slip,
        tangential_by_force,
        lifts,
    };
    (toml, known)
}

/// An indenter and how far it is pressed in at the deepest moment.
struct Shape {
    indenter: Indenter,
    /// The lines of `[indenter]`.
    keys: String,
    /// Contact radius where it is deepest, m.
    radius: f64,
}

/// An unworn contact.
struct Pressed {
    depth: f64,
    radius: f64,
    force: f64,
}

impl Shape {
    fn draw(draw: &mut Random) -> Self {
        let size = draw.log_between(1e-3, 0.1);
        // a/R, and for a flank its slope.
        let slope = draw.log_between(3e-3, 0.1);
        let radius = size * slope;
        let kind = draw.pick(&[0, 0, 0, 0, 1, 1, 2, 3, 4, 5]);
        let flat = radius * draw.between(0.1, 0.8);
        let made = match kind {
            1 => (
                Indenter::cone(slope),
                format!("shape = \"cone\"\nangle = {slope}\n"),
            ),
            2 => {
                let exponent = draw.between(1.3, 6.0);
                let coefficient = slope * radius.powf(1.0 - exponent);
                (
                    Indenter::power(coefficient, exponent),
                    format!(
                        "shape = \"power\"\ncoefficient = {coefficient:e}\nexponent = {exponent}\n"
                    ),
                )
            }
            3 => (
                Indenter::flat_punch(radius),
                format!("shape = \"flat-punch\"\nradius = {radius:e}\n"),
            ),
            4 => (
                Indenter::truncated_paraboloid(size, flat),
                format!(
                    "shape = \"truncated-paraboloid\"\nradius = {size:e}\ntip_radius = {flat:e}\n"
                ),
            ),
            5 => (
                Indenter::truncated_cone(slope, flat),
                format!("shape = \"truncated-cone\"\nangle = {slope}\ntip_radius = {flat:e}\n"),
            ),
            _ => (
                Indenter::paraboloid(size),
                format!("shape = \"paraboloid\"\nradius = {size:e}\n"),
            ),
        };
        let (Ok(indenter), keys) = made else {
            panic!("sizes are positive");
        };
        Self {
            indenter,
            keys,
            radius,
        }
    }

    fn toml(&self) -> &str {
        &self.keys
    }

    /// d = g(a) and F = E*d of a line of one metre.
    fn pressed_line(&self, modulus: f64) -> Pressed {
        let radius = self.radius;
        let depth = match self.indenter.rim() {
            Some(_) => 1e-3 * radius,
            None => self.indenter.image(Geometry::Line { length: 1.0 }, radius),
        };
        let force = modulus * depth;
        Pressed {
            depth,
            radius,
            force,
        }
    }

    /// d = g(a) and F = 2E*∫(d − g) dx; a punch is pressed by a thousandth of its radius.
    fn pressed(&self, modulus: f64) -> Pressed {
        let radius = self.radius;
        if self.indenter.rim().is_some() {
            let depth = 1e-3 * radius;
            return Pressed {
                depth,
                radius,
                force: 2.0 * modulus * radius * depth,
            };
        }
        let depth = self.indenter.profile_1d(radius);
        // The midpoint rule in θ, x = a sin θ, is smooth at the edge.
        let parts = 400;
        let sum: f64 = (0..parts)
            .map(|i| {
                let angle = 0.5 * PI * (f64::from(i) + 0.5) / f64::from(parts);
                (depth - self.indenter.profile_1d(radius * angle.sin())) * angle.cos()
            })
            .sum();
        Pressed {
            depth,
            radius,
            force: 2.0 * modulus * radius * sum * 0.5 * PI / f64::from(parts),
        }
    }
}
