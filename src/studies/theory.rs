//! Closed forms for the scenario on the screen, if there are any, to draw over the plots and to check the run.

use crate::contact::indenter::Indenter;
use crate::oracle::cattaneo_mindlin::CattaneoMindlin;
use crate::oracle::fretting_loop::Branch;
use crate::oracle::limiting_profile::LimitingProfile;
use crate::oracle::line_contact::Cylinder;
use crate::oracle::power_law::PowerLaw;
use crate::simulation::drive::{Control, Oscillation};
use crate::simulation::{Setup, Unworn};

/// The closed forms that apply.
#[derive(Debug, Clone, Default)]
pub struct Theory {
    /// The permanent stick radius by Melan's theorem, m; `None` without a permanent stick zone.
    pub stick_radius: Option<f64>,
    limit: Option<LimitingProfile>,
    line: Option<LineContact>,
    unworn: Option<(PowerLaw, f64)>,
    cattaneo: Option<CattaneoMindlin>,
    /// 1/κ = μE*/G*: the ratio of u_x to depth at which gross slip of the unworn indenter begins.
    pub slip_per_depth: f64,
}

/// A cylinder on a flat, under its largest load.
#[derive(Debug, Clone)]
struct LineContact {
    cylinder: Cylinder,
    /// Whether it wears to a limit.
    is_limited: bool,
    /// The length of the contact and the depth of the gauge, m.
    length: f64,
    gauge: f64,
    /// The amplitude of a tangential force from rest under a held load, N/m.
    amplitude: Option<f64>,
}

impl LineContact {
    /// The same under another load, N/m.
    fn under(&self, load: f64) -> Cylinder {
        Cylinder {
            load: load.max(0.0),
            ..self.cylinder
        }
    }
}

/// Whether the closed forms of a sine hold at all its moments.
fn is_sine(swing: &Oscillation) -> bool {
    swing.waveform().is_harmonic() || swing.amplitude() == 0.0
}

/// Whether the tangential motion begins at rest and swings about it, under a normal one that is held.
fn is_from_rest(normal: &Oscillation, tangential: &Oscillation) -> bool {
    let is_centred = tangential.mean() == 0.0 && tangential.phase() == 0.0;
    normal.amplitude() == 0.0 && is_centred && is_sine(tangential)
}

/// Where in a cycle from rest the tangential motion is.
fn branch(cycle: f64) -> Branch {
    match cycle {
        first if first <= 0.25 => Branch::Loading,
        later if (0.25..0.75).contains(&later.fract()) => Branch::Unloading,
        _ => Branch::Reloading,
    }
}

impl Theory {
    /// Finds the closed forms for the parts of a simulation.
    pub fn new(setup: &Setup) -> Self {
        let e_star = setup.material.normal_modulus();
        if let Some(length) = setup.geometry.length() {
            return Self::of_line(setup, length);
        }
        let mut theory = Self {
            slip_per_depth: setup.material.stick_ratio().recip(),
            unworn: power_law(&setup.indenter).map(|shape| (shape, e_star)),
            ..Self::default()
        };
        let drive = &setup.drive;
        let tangential = drive.tangential().and_then(Control::displacement);
        let Some((normal, tangential)) = drive.normal().displacement().zip(tangential) else {
            return theory;
        };
        // The closed forms begin with the unworn indenter on a stiff rig. For waveforms other than sines they only hold
        // at the turning points.
        let is_stiff = setup.drive.rig_compliance() == 0.0;
        if setup.scar.is_some() || !is_stiff || !is_sine(normal) || !is_sine(tangential) {
            return theory;
        }
        theory.stick_radius = Unworn::new(setup).melan().map(|(_, radius)| radius);
        let Some(radius) = setup.indenter.ball_radius() else {
            return theory;
        };
        let wears = setup.wear.is_some_and(|law| law.traits().reaches_limit);
        let limit = |stick_radius| LimitingProfile {
            e_star,
            radius,
            depth: normal.highest(),
            stick_radius,
        };
        theory.limit = theory.stick_radius.filter(|_| wears).map(limit);
        let from_rest = is_from_rest(normal, tangential);
        let cattaneo = CattaneoMindlin {
            e_star,
            g_star: setup.material.tangential_modulus(),
            mu: setup.material.friction(),
            radius,
            depth: normal.mean(),
            amplitude: tangential.amplitude(),
        };
        theory.cattaneo = (from_rest && !cattaneo.is_gross_slip()).then_some(cattaneo);
        theory
    }

    /// Finds the closed forms for a line contact of this `length` (m).
    fn of_line(setup: &Setup, length: f64) -> Self {
        let is_worn = setup.scar.is_some();
        let melan = Unworn::new(setup).melan().filter(|_| !is_worn);
        let stick_radius = melan.map(|(_, radius)| radius);
        let wears = setup.wear.is_some_and(|law| law.traits().reaches_limit);
        let normal = setup.drive.normal().oscillation();
        let load = normal.highest() / length;
        let held = setup.material.friction() * load;
        let amplitude = match setup.drive.tangential() {
            Some(Control::Force(force)) if !is_worn && is_from_rest(normal, force) => {
                Some(force.amplitude() / length)
            }
            _ => None,
        };
        let line = |radius| LineContact {
            cylinder: Cylinder {
                e_star: setup.material.normal_modulus(),
                radius,
                friction: setup.material.friction(),
                load,
            },
            is_limited: wears && stick_radius.is_some(),
            length,
            gauge: setup.drive.gauge_length().unwrap_or_default(),
            amplitude: amplitude.filter(|amplitude| *amplitude < held),
        };
        Self {
            stick_radius,
            line: setup.indenter.ball_radius().map(line),
            slip_per_depth: setup.material.stick_ratio().recip(),
            ..Self::default()
        }
    }

    /// Returns f∞(r), m: the limiting profile of wear.
    pub fn limiting_profile(&self, radii: &[f64]) -> Option<Vec<f64>> {
        if let (Some(line), Some(stick)) = (&self.line, self.stick_radius) {
            let unworn = |x: f64| 0.5 * x * x / line.cylinder.radius;
            let limit = |x: f64| unworn(x) + line.cylinder.limit_depth(stick, x);
            return line.is_limited.then(|| over(radii, limit));
        }
        let limit = self.limit.as_ref()?;
        Some(over(radii, |r| limit.profile(r)))
    }

    /// Estimates the deepest wear after `cycles` cycles, m, by Archard's law under the pressure of the unworn contact,
    /// limited by the depth at which wear ends. `None` if nothing slips, or without a closed form.
    pub fn expected_wear(&self, setup: &Setup, cycles: Option<f64>) -> Option<f64> {
        let law = setup.wear?;
        let nodes = setup.grid.nodes();
        let unworn = |r: f64| setup.indenter.profile(r);
        let settled = self.limiting_profile(nodes).map(|limit| {
            let worn = limit.iter().zip(nodes).map(|(f, &r)| f - unworn(r));
            worn.filter(|worn| worn.is_finite()).fold(0.0, f64::max)
        });
        let by_law = || {
            let shift = setup.drive.tangential()?.displacement()?;
            let unworn = Unworn::new(setup);
            let pressure = unworn.mean_pressure(unworn.deepest());
            let stress = setup.material.friction() * pressure;
            Some(4.0 * law.coefficient() * stress * shift.amplitude() * cycles?)
        };
        let reached = by_law().into_iter().chain(settled).reduce(f64::min)?;
        // Under a prescribed displacement, wear cannot exceed the largest depth.
        let most = setup.largest_depth().filter(|_| !setup.geometry.is_line());
        let most = most.unwrap_or(f64::INFINITY);
        Some(reached.min(most)).filter(|depth| *depth > 0.0)
    }

    /// The amplitude of u_x, m, from which the unworn indenter slips as a whole under `load` (N):
    /// u_t = d/κ with F ∝ d^((n+1)/n) for a tip ∝ rⁿ. That of a line is told against its gauge.
    pub fn gross_slip_amplitude(&self, load: f64) -> Option<f64> {
        if let Some(line) = &self.line {
            let pressed = line.under(load / line.length);
            return Some(pressed.shift(pressed.friction * pressed.load, line.gauge));
        }
        let (shape, e_star) = self.unworn.as_ref()?;
        let depth = 1e-6;
        let share = load.max(0.0) / shape.force(*e_star, depth);
        let power = shape.exponent / (shape.exponent + 1.0);
        Some(depth * share.powf(power) * self.slip_per_depth)
    }

    /// Returns p(r), Pa, of the unworn indenter at a depth (m).
    pub fn unworn_pressure(&self, depth: f64, radii: &[f64]) -> Option<Vec<f64>> {
        if let Some(line) = &self.line {
            let pressed = line.under(line.cylinder.e_star * depth);
            return Some(over(radii, |x| pressed.pressure(pressed.half_width(), x)));
        }
        let (shape, e_star) = self.unworn.as_ref()?;
        let radius = shape.contact_radius(depth.max(0.0));
        Some(over(radii, |r| shape.pressure(*e_star, radius, r)))
    }

    /// τ(r), Pa, of the unworn paraboloid at constant depth at a cycle and a shift (m), or of the unworn cylinder under a
    /// `force` (N).
    pub fn unworn_shear(
        &self,
        cycle: f64,
        [shift, force]: [f64; 2],
        radii: &[f64],
    ) -> Option<Vec<f64>> {
        let branch = branch(cycle);
        if let Some(line) = &self.line {
            let amplitude = line.amplitude?;
            // Rounding may pass the turning points.
            let force = (force / line.length).clamp(-amplitude, amplitude);
            let shear = |x| line.cylinder.loop_shear(branch, [force, amplitude], x);
            return Some(over(radii, shear));
        }
        let cattaneo = self.cattaneo.as_ref()?;
        Some(over(radii, |r| cattaneo.loop_shear(branch, shift, r)))
    }
}

/// Evaluates a function at every radius.
pub(super) fn over(radii: &[f64], value: impl Fn(f64) -> f64) -> Vec<f64> {
    radii.iter().map(|&r| value(r)).collect()
}

/// Returns the profile as a power law, if it is one.
fn power_law(indenter: &Indenter) -> Option<PowerLaw> {
    match *indenter {
        _ if indenter.tip_radius() > 0.0 => None,
        Indenter::Paraboloid { radius, .. } => Some(PowerLaw::paraboloid(radius)),
        Indenter::Cone { angle, .. } => Some(PowerLaw::cone(angle.tan())),
        Indenter::Power {
            coefficient,
            exponent,
        } => Some(PowerLaw {
            coefficient,
            exponent,
        }),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    fn of(preset: &str) -> Theory {
        Theory::new(Scenario::load(preset, &[]).expect("a preset").setup())
    }

    #[test]
    fn figure_three_has_a_stick_radius_and_a_limit() {
        let theory = of("li2019-fig3");
        let stick = theory.stick_radius.expect("a stick zone");
        assert!((stick / 1e-4 - 0.4164).abs() < 1e-4, "{stick}");
        let limit = theory.limiting_profile(&[0.2e-4, 0.8e-4]).expect("a limit");
        assert!((limit[0] - 0.2e-4f64.powi(2) / 0.02).abs() < 1e-15);
        assert!(limit[1] > 0.8e-4f64.powi(2) / 0.02);
        assert!(theory.unworn_shear(0.1, [1e-9, 0.0], &[0.0]).is_none());
    }

    /// u_t = 3μN/(4aG*) for a sphere.
    #[test]
    fn the_border_of_gross_slip_is_that_of_mindlin() {
        let scenario = Scenario::load("mindlin", &[]).expect("a preset");
        let setup = scenario.setup();
        let radius = setup.indenter.ball_radius().expect("a ball");
        let material = &setup.material;
        for load in [0.1, 20.0, 300.0] {
            let a = (3.0 * load * radius / (4.0 * material.normal_modulus())).cbrt();
            let exact =
                3.0 * material.friction() * load / (4.0 * a * material.tangential_modulus());
            let border = Theory::new(setup)
                .gross_slip_amplitude(load)
                .expect("a border");
            assert!((border / exact - 1.0).abs() < 1e-12, "{load}");
        }
    }

    #[test]
    fn gross_slip_and_normal_contact_have_none() {
        for preset in ["gross-slip", "hertz", "flat-punch"] {
            assert!(of(preset).stick_radius.is_none(), "{preset}");
            assert!(of(preset).limiting_profile(&[0.0]).is_none(), "{preset}");
        }
        assert!(of("hertz").unworn_pressure(1e-6, &[0.0]).is_some());
        assert!(
            of("mindlin")
                .unworn_shear(0.1, [1e-9, 0.0], &[0.0])
                .is_some()
        );
    }
}
