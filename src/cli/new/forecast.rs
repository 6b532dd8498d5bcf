//! Predictions of closed forms before a scenario is run: size and pressure of the unworn contact, and whether it will
//! be in partial or gross slip.

use std::f64::consts::{FRAC_2_PI, TAU};

use crate::math::number::{exact, rounded};
use crate::plot::units::format_value;
use crate::scenario::Scenario;
use crate::simulation::drive::Oscillation;
use crate::simulation::{Setup, Unworn};

/// Seconds per day.
const DAY: f64 = 86_400.0;

/// The closed forms of a scenario with a prescribed tangential displacement.
pub struct Forecast<'a> {
    setup: &'a Setup,
    shift: &'a Oscillation,
}

impl<'a> Forecast<'a> {
    /// Returns the predictions for a scenario; `None` without a prescribed displacement.
    pub fn from_scenario(scenario: &'a Scenario) -> Option<Self> {
        let setup = scenario.setup();
        let shift = setup.drive.tangential()?.displacement()?;
        Some(Self { setup, shift })
    }

    fn is_ball(&self) -> bool {
        self.setup.indenter.ball_radius().is_some()
    }

    /// The amplitude from which the whole contact slips, m.
    fn threshold(&self) -> f64 {
        let unworn = Unworn::new(self.setup);
        unworn.gross_slip_amplitude(unworn.deepest())
    }

    /// Describes size and pressure of the unworn contact.
    pub fn contact(&self) -> String {
        let value = |value: f64, unit: &str| format_value(value, unit, 3);
        let unworn = Unworn::new(self.setup);
        let depth = unworn.deepest();
        let mean = unworn.mean_pressure(depth);
        let is_line = self.setup.geometry.is_line();
        // Hertz: p0 is 3/2 of the mean under a ball, 4/π of it under a cylinder.
        let (what, pressure, place) = match self.is_ball() {
            true if is_line => ("Hertz pressure", 2.0 * FRAC_2_PI * mean, " at its centre"),
            true => ("Hertz pressure", 1.5 * mean, " at its centre"),
            false => ("mean pressure", mean, ""),
        };
        let approach = if is_line {
            String::new()
        } else {
            format!("depth {}, ", value(depth, "m"))
        };
        format!(
            "{} {}, {approach}load {}, {what} {}{place}",
            self.setup.geometry.term("contact radius"),
            value(unworn.radius(depth), "m"),
            value(unworn.force(depth), "N"),
            value(pressure, "Pa"),
        )
    }

    /// Describes the regime of the unworn contact.
    pub fn regime(&self) -> String {
        let share = self.shift.amplitude() / self.threshold();
        let threshold = format_value(self.threshold(), "m", 3);
        if share >= 1.0 {
            return format!("gross slip: the amplitude is beyond {threshold}, where all slips");
        }
        // A punch slips nowhere or everywhere.
        let ring = Unworn::new(self.setup).ring().filter(|_| self.is_ball());
        match ring {
            Some(ring) => format!(
                "partial slip: {} outside {:.0} % of the {}; all slips from an amplitude of {threshold}",
                if self.setup.geometry.is_line() {
                    "strips"
                } else {
                    "a ring"
                },
                100.0 * ring.stick_radius / ring.contact_radius,
                self.setup.geometry.term("contact radius"),
            ),
            None => format!("stick, but for the rim; all slips from an amplitude of {threshold}"),
        }
    }

    /// Says how many cycles the rig runs per day.
    pub fn a_day(&self) -> String {
        let frequency = self.shift.angular_frequency() / TAU;
        let [cycles, frequency] =
            [frequency * DAY, frequency].map(|value| exact(rounded(value, 7)));
        format!("a day on the rig is {cycles} cycles at {frequency} Hz")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    fn scenario(sets: &[&str]) -> Scenario {
        let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
        Scenario::load("li2019-fig3", &sets).expect("a scenario")
    }

    #[test]
    fn the_contact_is_that_of_hertz() {
        let scenario = scenario(&["motion.normal.amplitude=0"]);
        let (unworn, depth) = (Unworn::new(scenario.setup()), 1e-6);
        assert!((unworn.deepest() / depth - 1.0).abs() < 1e-12);
        // a = √(R d), F = 4/3 E* √R d^1.5, p0 = 2 E* √(d/R)/π.
        assert!((unworn.radius(depth) / 1e-4 - 1.0).abs() < 1e-3);
        let peak = 2.0 * 2.3077e11 * 1e-2 / std::f64::consts::PI;
        let found = 1.5 * unworn.mean_pressure(depth);
        assert!((found / peak - 1.0).abs() < 2e-3, "{found}");
        let forecast = Forecast::from_scenario(&scenario)
            .expect("a contact")
            .contact();
        assert!(forecast.contains("Hertz pressure 1.47 GPa"), "{forecast}");
    }

    #[test]
    fn the_regime_turns_where_the_whole_contact_slips() {
        let regime = |amplitude: f64| {
            let amplitude = format!("motion.tangential.amplitude={amplitude}");
            let scenario = scenario(&["motion.normal.amplitude=0", &amplitude]);
            let found = Forecast::from_scenario(&scenario).expect("a contact");
            (found.threshold(), found.regime())
        };
        let (threshold, _) = regime(1e-7);
        let more = |factor: f64| regime(factor * threshold).1;
        assert!(
            more(0.99).starts_with("partial slip: a ring outside 10 %"),
            "{}",
            more(0.99)
        );
        assert!(more(1.01).starts_with("gross slip"));
    }
}
