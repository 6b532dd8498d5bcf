//! Closed forms for the scenario on the screen, if there are any, to draw over the plots and to check the run.

use crate::simulation::drive::Control;
use crate::simulation::{Setup, Unworn};

/// A reference depth, m; loads at other depths follow from its load.
const REFERENCE: f64 = 1e-6;

/// The closed forms that apply.
#[derive(Debug, Clone)]
pub struct Theory {
    /// The contact before wear.
    setup: Setup,
    /// The permanent stick radius by Melan's theorem, m; `None` without a permanent stick zone.
    pub stick_radius: Option<f64>,
    /// The depth and the stick radius at which wear ends, m.
    limit: Option<[f64; 2]>,
    /// 1/κ = μE*/G*: the ratio of u_x to depth at which gross slip of the unworn indenter begins.
    pub slip_per_depth: f64,
}

impl Theory {
    /// Finds the closed forms for the parts of a simulation.
    pub fn new(setup: &Setup) -> Self {
        let (unworn, drive) = (Unworn::new(setup), &setup.drive);
        // The closed forms begin with the unworn indenter. For waveforms other than sines they only hold at the turning
        // points.
        let mut swings = [Some(drive.normal()), drive.tangential()]
            .into_iter()
            .flatten();
        let holds =
            setup.geometry.is_line() || swings.all(|control| control.oscillation().is_sine());
        let melan = unworn.melan().filter(|_| setup.scar.is_none() && holds);
        let stick_radius = melan.map(|(_, radius)| radius);
        let wears = setup.wear.is_some_and(|law| law.traits().reaches_limit);
        let limit = stick_radius.filter(|_| wears && setup.indenter.rim().is_none());
        Self {
            stick_radius,
            limit: limit.map(|stick| [unworn.deepest(), stick]),
            slip_per_depth: setup.material.stick_ratio().recip(),
            setup: setup.clone(),
        }
    }

    /// Returns f∞(r), m: the limiting profile of wear.
    pub fn limiting_profile(&self, radii: &[f64]) -> Option<Vec<f64>> {
        let [depth, stick] = self.limit?;
        let unworn = Unworn::new(&self.setup);
        Some(over(radii, |r| unworn.limit(depth, stick, r)))
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

    /// Returns the amplitude of u_x, m, from which the unworn indenter slips as a whole under `load` (N);
    /// relative to the gauge for a line.
    pub fn gross_slip_amplitude(&self, load: f64) -> Option<f64> {
        let unworn = Unworn::new(&self.setup);
        let exponent = self.setup.indenter.exponent()?;
        // F ∝ d^((n+1)/n) under a round tip ∝ rⁿ.
        let depth = if self.setup.geometry.is_line() {
            unworn.depth(load)
        } else {
            let share = load.max(0.0) / unworn.force(REFERENCE);
            REFERENCE * share.powf(exponent / (exponent + 1.0))
        };
        Some(unworn.gross_slip_shift(depth))
    }

    /// Returns p(r), Pa, of the unworn indenter at a depth (m).
    pub fn unworn_pressure(&self, depth: f64, radii: &[f64]) -> Option<Vec<f64>> {
        let unworn = Unworn::new(&self.setup);
        let pressure = unworn.pressure(depth)?;
        Some(over(radii, pressure))
    }

    /// Returns τ(r), Pa, of the unworn indenter under a held load at a cycle, a shift (m) and a `force` (N).
    pub fn unworn_shear(
        &self,
        cycle: f64,
        [shift, force]: [f64; 2],
        radii: &[f64],
    ) -> Option<Vec<f64>> {
        let at = match self.setup.drive.tangential()? {
            Control::Displacement(_) => shift,
            Control::Force(_) => force,
        };
        let unworn = Unworn::new(&self.setup);
        let shear = unworn
            .shear(cycle, at)
            .filter(|_| self.setup.scar.is_none());
        Some(over(radii, shear?))
    }
}

/// Evaluates a function at every radius.
fn over(radii: &[f64], value: impl Fn(f64) -> f64) -> Vec<f64> {
    radii.iter().map(|&r| value(r)).collect()
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
