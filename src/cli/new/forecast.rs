//! What closed forms say of a scenario before it is run: size and pressure of the unworn contact, and
//! whether it will stick in the middle or slip as a whole.

use crate::contact::indenter::Indenter;
use crate::plot::units::{format_value, plain};
use crate::scenario::Scenario;
use crate::simulation::Unworn;
use crate::simulation::drive::Control;

/// Seconds of a day.
const DAY: f64 = 86_400.0;

/// The closed forms of a scenario.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// d, m.
    depth: f64,
    /// a, m.
    radius: f64,
    /// F_z, N.
    force: f64,
    /// F_z/(π a²), Pa.
    mean_pressure: f64,
    is_ball: bool,
    /// The amplitude from which the whole contact slips, m.
    threshold: f64,
    amplitude: f64,
    /// Hz.
    frequency: f64,
}

impl Forecast {
    /// What is known of a scenario; `None` where nothing is moved by a displacement.
    pub fn of(scenario: &Scenario) -> Option<Self> {
        let setup = scenario.setup();
        let Some(Control::Displacement(shift)) = setup.drive.tangential() else {
            return None;
        };
        let unworn = Unworn::of(setup);
        let depth = unworn.deepest();
        Some(Self {
            depth,
            radius: unworn.radius(depth),
            force: unworn.force(depth),
            mean_pressure: unworn.mean_pressure(depth),
            is_ball: matches!(setup.indenter, Indenter::Paraboloid { .. }),
            // By Ciavarella and Jäger: u_t = (μ E*/G*) d, whatever the shape.
            threshold: depth / setup.material.stick_ratio(),
            amplitude: shift.amplitude(),
            frequency: shift.angular_frequency() / std::f64::consts::TAU,
        })
    }

    /// Size and pressure of the unworn contact.
    pub fn contact(&self) -> String {
        let value = |value: f64, unit: &str| format_value(value, unit, 3);
        let mean = self.mean_pressure;
        let (what, pressure, place) = match self.is_ball {
            // Hertz: p0 = 3/2 of the mean.
            true => ("Hertz pressure", 1.5 * mean, " at its centre"),
            false => ("mean pressure", mean, ""),
        };
        format!(
            "contact radius {}, depth {}, load {}, {what} {}{place}",
            value(self.radius, "m"),
            value(self.depth, "m"),
            value(self.force, "N"),
            value(pressure, "Pa"),
        )
    }

    /// The regime that the unworn contact is in.
    pub fn regime(&self) -> String {
        let threshold = format_value(self.threshold, "m", 3);
        let share = self.amplitude / self.threshold;
        if share >= 1.0 {
            return format!("gross slip: the amplitude is beyond {threshold}, where all slips");
        }
        // c² = a² (1 − U/u_t) of Cattaneo and Mindlin's sphere; a punch slips nowhere or everywhere.
        match self.is_ball {
            true => format!(
                "partial slip: a ring outside {:.0} % of the contact radius; all slips from an amplitude of {threshold}",
                100.0 * (1.0 - share).sqrt()
            ),
            false => format!("stick, but for the rim; all slips from an amplitude of {threshold}"),
        }
    }

    /// How many cycles of the test a day takes.
    pub fn a_day(&self) -> String {
        let (cycles, frequency) = (plain(self.frequency * DAY), plain(self.frequency));
        format!("a day on the rig is {cycles} cycles at {frequency} Hz")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    fn forecast(sets: &[&str]) -> Forecast {
        let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
        let scenario = Scenario::load("li2019-fig3", &sets).expect("a scenario");
        Forecast::of(&scenario).expect("a contact")
    }

    #[test]
    fn the_contact_is_that_of_hertz() {
        let found = forecast(&["motion.normal.amplitude=0"]);
        // a = √(R d), F = 4/3 E* √R d^1.5, p0 = 2 E* √(d/R)/π.
        assert!((found.radius / 1e-4 - 1.0).abs() < 1e-3);
        let peak = 2.0 * 2.3077e11 * 1e-2 / std::f64::consts::PI;
        let found = 1.5 * found.mean_pressure;
        assert!((found / peak - 1.0).abs() < 2e-3, "{found}");
    }

    #[test]
    fn the_regime_turns_where_the_whole_contact_slips() {
        let found = forecast(&["motion.normal.amplitude=0"]);
        let more = |factor: f64| {
            let amplitude = format!("motion.tangential.amplitude={}", factor * found.threshold);
            forecast(&["motion.normal.amplitude=0", &amplitude]).regime()
        };
        assert!(
            more(0.99).starts_with("partial slip: a ring outside 10 %"),
            "{}",
            more(0.99)
        );
        assert!(more(1.01).starts_with("gross slip"));
    }
}
