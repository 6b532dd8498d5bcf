//! Warns, before the run, about scenarios outside the theory.

use super::Log;
use crate::math::invalid::Invalid;
use crate::simulation::drive::{Control, Drive, Oscillation};
use crate::simulation::{Integrator, Setup, Simulation, Spacing, Unworn, border};

/// Larger slopes and a/R no longer act as a half-space.
const STEEP: f64 = 0.3;

/// Larger pressures, in units of E*, cause more than small strains.
const STRONG: f64 = 0.1;

/// With fewer steps, wear by a power n ≠ 1 of the slip rate loses percents where slip begins within a step.
const STEPS_FOR_POWERS: u32 = 50;

/// Longer strokes, relative to the half-width of a line contact, are not small.
const LONG_STROKE: f64 = 0.1;

/// The usual a/R is greater than this, and the usual stroke of a fretting contact, in units of its radius, lies between
/// these: beyond them, a length is most often in another unit.
const SHALLOW: f64 = 5e-4;
const STROKES: [f64; 2] = [3e-5, 1.5];

/// By how much of the depth g may fall and still counts as level: noise of a scar.
const LEVEL: f64 = 0.02;

impl Simulation {
    /// Returns one line for each way in which the scene lies outside the theory, or beyond the resolution of any grid.
    /// The log of the run tells which limits it has passed.
    pub fn warnings(&self, log: &Log) -> Vec<String> {
        let mut lines = warnings(self.setup());
        lines.extend(self.hardness_warning(log));
        lines.extend(self.ring_of_contact());
        lines
    }

    /// Explains why cycles that should be jumped are all stepped; `None` if they are jumped.
    pub fn why_never_jumped(&self) -> Option<&'static str> {
        let Setup {
            drive,
            wear,
            integrator,
            ..
        } = self.setup();
        match integrator {
            Integrator::Direct => None,
            _ if drive.tangential().is_none() || wear.is_none() => Some("nothing wears"),
            _ if drive.repeats_after().is_none() => {
                Some("the two frequencies have no common period, so no two cycles are the same")
            }
            Integrator::CycleJump { .. } => None,
        }
    }

    /// Warns if a scar leaves a profile that touches in a ring, which the springs cannot represent.
    fn ring_of_contact(&self) -> Option<String> {
        self.setup().scar.as_ref()?;
        let g = self.profile_1d();
        let nodes = self.setup().grid.nodes();
        let mut reached = f64::NEG_INFINITY;
        let falls = nodes.iter().zip(&g).map(|(&x, &g)| {
            reached = reached.max(g);
            (x, reached - g)
        });
        let (x, fall) = falls.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let scale = self.setup().depth_scale(self.state().contact.depth);
        (fall > LEVEL * scale).then(|| {
            format!(
                "outside the theory: with its scar the 1D profile g falls by {fall:.1e} m at x = {x:.2e} m, \
                 so the contact may be a ring, where the theory needs a disc"
            )
        })
    }

    /// Warns that the pressure has passed the hardness, or, before the first step, that it will at the deepest contact.
    fn hardness_warning(&self, log: &Log) -> Option<String> {
        let hardness = self.setup().hardness?;
        let (pressure, radius, when) = match log.passed_hardness() {
            Some(passed) => (
                passed.pressure,
                passed.radius,
                format!("at cycle {:.4}", passed.cycle),
            ),
            None if self.state().steps > 0 => return None,
            None => {
                let deepest = Self::new(at_deepest(self.setup()).ok()?).ok()?;
                let (radius, pressure) = deepest.highest_pressure();
                (pressure, radius, "where the contact is deepest".to_owned())
            }
        };
        (pressure > hardness).then(|| {
            format!(
                "outside the theory: the pressure exceeds the hardness, {hardness:.3e} Pa: it is \
                 {pressure:.3e} Pa at r = {radius:.2e} m {when}, and the material yields there"
            )
        })
    }
}

fn warnings(setup: &Setup) -> Vec<String> {
    let unworn = Unworn::new(setup);
    let depth = unworn.deepest();
    let radius = unworn.radius(depth);
    let mut lines = Vec::new();
    let slope = slope(setup, radius);
    if slope > STEEP {
        lines.push(format!(
            "outside the theory: the indenter's slope at the contact's edge, a/R of a {}, is \
             {slope:.2}; a half-space with small slopes needs less than {STEEP}",
            if setup.geometry.is_line() {
                "cylinder"
            } else {
                "sphere"
            }
        ));
    }
    let pressure = unworn.mean_pressure(depth) / setup.material.normal_modulus();
    // The largest pressure of a sphere is 3/2 of the mean; tips and rims have more, in theory without bound.
    if 1.5 * pressure > STRONG {
        lines.push(format!(
            "outside the theory: the pressure reaches {:.2} E*; linear elasticity needs less than \
             {STRONG} E*",
            1.5 * pressure
        ));
    }
    if slope > 0.0 && slope < SHALLOW {
        lines.push(format!(
            "outside the theory, or a length in another unit than m: the slope at the contact's edge is {slope:.1e}, where \
             contacts have {SHALLOW:.0e} or more"
        ));
    }
    lines.extend(unusual_stroke(setup, radius));
    lines.extend(slip_instability(setup, 1.5 * pressure));
    lines.extend(gross_slip_under_force(setup, unworn));
    lines.extend(long_stroke(setup, unworn, radius));
    let exponent = setup
        .wear
        .map_or(1.0, |law| law.traits().slip_rate_exponent);
    if exponent != 1.0 && setup.steps_per_cycle < STEPS_FOR_POWERS {
        lines.push(format!(
            "a power of the slip rate, here {exponent}, on {} steps per cycle may give wear wrong \
             by some percent; use numerics.steps_per_cycle = {STEPS_FOR_POWERS} or more",
            setup.steps_per_cycle
        ));
    }
    if let Some(width) = border::unseen_ring(setup) {
        lines.push(format!(
            "the ring of slip is {width:.1e} m wide, thinner than a cell: its wear and its \
             friction work are missed"
        ));
    }
    lines
}

/// Returns the slope of the unworn profile at the contact's edge.
fn slope(setup: &Setup, radius: f64) -> f64 {
    if setup.indenter.rim().is_some() || radius <= 0.0 {
        return 0.0;
    }
    let inside = radius * (1.0 - 1e-6);
    let rise = setup.indenter.profile(radius) - setup.indenter.profile(inside);
    rise / (radius - inside)
}

/// An amplitude that no fretting contact of this `radius`, m, has.
fn unusual_stroke(setup: &Setup, radius: f64) -> Option<String> {
    let amplitude = setup.drive.tangential()?.displacement()?.amplitude();
    let share = amplitude / radius;
    let [least, most] = STROKES;
    (amplitude > 0.0 && radius > 0.0 && !(least..=most).contains(&share)).then(|| {
        format!(
            "outside the theory, or a length in another unit than m: the amplitude is {share:.1e} of the contact's radius, \
             where fretting has {least:.0e} to {most}"
        )
    })
}

/// Wear that lets springs slip on by more than they slipped, at a `pressure` in units of E*. Beyond that, a quasi-static
/// contact jumps, and where it lands depends on the cells.
fn slip_instability(setup: &Setup, pressure: f64) -> Option<String> {
    let law = setup.wear.filter(|law| law.traits().linear_in_work)?;
    setup.drive.tangential()?;
    let material = &setup.material;
    let per_slip = law.coefficient() * material.friction() * pressure * material.normal_modulus();
    let gain = per_slip / material.stick_ratio();
    (gain > 1.0).then(|| {
        format!(
            "outside the theory: the wear of a slip lets springs slip on by {gain:.3} of it (k mu^2 p E*/G*); from 1 \
             on they slip all at once, and the volume may differ by percents from one number of cells to the next"
        )
    })
}

/// Warns if friction cannot hold a prescribed tangential force: there is no quasi-static motion then.
fn gross_slip_under_force(setup: &Setup, unworn: Unworn<'_>) -> Option<String> {
    let Some(Control::Force(tangential)) = setup.drive.tangential() else {
        return None;
    };
    let lowest = match setup.drive.normal() {
        Control::Force(normal) => normal.lowest(),
        Control::Displacement(normal) => unworn.force(normal.lowest()),
    };
    let asked = tangential.mean().abs() + tangential.amplitude();
    let held = setup.material.friction() * lowest.max(0.0);
    (asked >= held).then(|| {
        format!(
            "outside the theory: a tangential force of {asked:.3e} N may exceed the friction \
             limit, {held:.3e} N; gross slip under a prescribed force never stops"
        )
    })
}

/// Warns if a line contact slides further than a part of its half-width (m). It then wears the other body where that is
/// not always in contact, and the theory knows only the sum of both worn depths, at one place.
fn long_stroke(setup: &Setup, unworn: Unworn<'_>, half_width: f64) -> Option<String> {
    let swing = setup.drive.tangential()?.displacement()?;
    let elastic = setup
        .geometry
        .length()
        .map(|_| unworn.gross_slip_amplitude(unworn.deepest()))?;
    let stroke = (swing.amplitude() - elastic).max(0.0) / half_width;
    (stroke > LONG_STROKE).then(|| {
        format!(
            "outside the theory: the contact slides by {stroke:.2} of its half-width to each side, where strokes must be \
             small; more of the flat body wears than the contact covers, and less deep"
        )
    })
}

/// Returns the same contact, held at the deepest point of its motion, on the same nodes.
fn at_deepest(setup: &Setup) -> Result<Setup, Invalid> {
    let normal = setup.drive.normal();
    let held = Oscillation::new(normal.oscillation().highest(), 0.0, 1.0, 0.0)?;
    let gauge = setup.drive.gauge_length().unwrap_or_default();
    Ok(Setup {
        drive: Drive::new(
            match normal {
                Control::Displacement(_) => Control::Displacement(held),
                Control::Force(_) => Control::Force(held),
            },
            None,
        )
        .in_geometry(setup.geometry, &setup.material, gauge),
        wear: None,
        running_in: None,
        hardness: None,
        spacing: Spacing::Given,
        ..setup.clone()
    })
}
