//! The keys of a scenario that can be changed while it runs, with their present values.

use crate::scenario::Scenario;
use crate::scenario::parameters::{Kind, PARAMETERS, Parameter};

/// A key of the scenario as the explorer shows it.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Range and meaning.
    pub parameter: &'static Parameter,
    /// The unit that holds in this scenario.
    pub unit: &'static str,
    /// The value: TOML, words without quotes; none where the scenario leaves it to the program.
    pub value: Option<String>,
}

impl Setting {
    /// Every key that has a value or may be given one, in the order of a scenario's file.
    pub fn all(scenario: &Scenario) -> Vec<Self> {
        let fixed = ["", "run", "changes"];
        PARAMETERS
            .iter()
            .filter(|parameter| !fixed.contains(&parameter.section()))
            .map(|parameter| Self::of(parameter, scenario))
            .filter(|setting| setting.value.is_some() || setting.parameter.section() == "numerics")
            .collect()
    }

    fn of(parameter: &'static Parameter, scenario: &Scenario) -> Self {
        let word = |path: &str| {
            let value = scenario.value(path)?;
            Some(value.trim_matches('"').to_owned())
        };
        let is_force =
            || word(&format!("{}.control", parameter.section())).as_deref() == Some("force");
        let unit = match parameter.unit {
            "m, or N where control = \"force\"" if is_force() => "N",
            "m, or N where control = \"force\"" => "m",
            unit => unit,
        };
        Self {
            parameter,
            unit,
            value: word(parameter.path),
        }
    }

    /// The value with its unit, as a reader expects it.
    pub fn shown(&self) -> String {
        let value = self.value.as_deref().unwrap_or("default");
        format!("{value} {}", self.unit).trim_end().to_owned()
    }

    /// What a greater value, or another word, does to the contact.
    pub fn effect(&self) -> &'static str {
        let found = EFFECTS
            .iter()
            .find(|(path, _)| *path == self.parameter.path);
        found.map_or("", |(_, effect)| effect)
    }

    /// What a value must be, in a line.
    pub fn rule(&self) -> String {
        let range = self.parameter.range;
        match self.parameter.kind {
            Kind::Choice(words) => words.join(", "),
            Kind::Whole if !range.is_empty() => format!("a whole number {range}"),
            Kind::Number if !range.is_empty() => format!("a number {range}"),
            kind => kind.wanted(),
        }
    }

    /// The next value up or down: the next word of a choice, the next number of two digits.
    /// None where there is no next one.
    pub fn next(&self, up: bool) -> Option<String> {
        let value = self.value.as_deref()?;
        match self.parameter.kind {
            Kind::Choice(words) => {
                let at = words.iter().position(|word| *word == value)?;
                let places = if up { 1 } else { words.len() - 1 };
                Some(words[(at + places) % words.len()].to_owned())
            }
            Kind::Flag => Some((value != "true").to_string()),
            Kind::Whole => {
                let next = next_number(value.parse().ok()?, up);
                Some(if up { next.ceil() } else { next.floor() }.to_string())
            }
            Kind::Number => Some(plain(next_number(value.parse().ok()?, up))),
            Kind::Text | Kind::Numbers => None,
        }
    }
}

/// What the keys do.
const EFFECTS: &[(&str, &str)] = &[
    (
        "indenter.shape",
        "where pressure concentrates: a rim, a tip, or the middle",
    ),
    (
        "indenter.radius",
        "more: a wider contact and less pressure at the same depth",
    ),
    (
        "indenter.angle",
        "more: a sharper tip, a smaller contact, more pressure",
    ),
    (
        "indenter.tip_radius",
        "more: the contact begins wider, its rim carries more",
    ),
    (
        "indenter.coefficient",
        "more: a steeper profile, a smaller contact",
    ),
    (
        "indenter.exponent",
        "more: flatter in the middle, steeper outside",
    ),
    (
        "material.effective_modulus",
        "more: more pressure and force at the same depth",
    ),
    (
        "material.poisson",
        "more: softer sideways, so a wider stick zone",
    ),
    ("material.indenter.youngs_modulus", "more: a stiffer pair"),
    (
        "material.indenter.poisson",
        "more: softer sideways, so a wider stick zone",
    ),
    (
        "material.indenter.rigid",
        "rigid: only the half-space yields",
    ),
    ("material.half_space.youngs_modulus", "more: a stiffer pair"),
    (
        "material.half_space.poisson",
        "more: softer sideways, so a wider stick zone",
    ),
    (
        "material.half_space.rigid",
        "rigid: only the indenter yields",
    ),
    (
        "friction.coefficient",
        "more: a wider stick zone, higher shear where it slips",
    ),
    (
        "motion.normal.control",
        "displacement: wear unloads the contact; force: it sinks in",
    ),
    (
        "motion.normal.mean",
        "more: a wider contact, a wider stick zone",
    ),
    (
        "motion.normal.amplitude",
        "more: the edge of the contact opens and closes further",
    ),
    (
        "motion.normal.angular_frequency",
        "another ratio to the tangential one: another loop",
    ),
    (
        "motion.normal.phase",
        "when the contact is deepest, relative to the shaking",
    ),
    (
        "motion.tangential.control",
        "displacement or force is what swings",
    ),
    (
        "motion.tangential.mean",
        "where the shaking is centred; forgotten after a cycle",
    ),
    (
        "motion.tangential.amplitude",
        "more: a wider slip ring, then gross slip",
    ),
    (
        "motion.tangential.angular_frequency",
        "one period is a cycle; powers of slip rate feel it",
    ),
    (
        "motion.tangential.phase",
        "when the shift is largest, relative to the depth",
    ),
    (
        "wear.law",
        "archard follows the work of friction; power weighs stress and speed",
    ),
    (
        "wear.coefficient",
        "more: the same wear in fewer cycles, until steps are too coarse",
    ),
    (
        "wear.stress_exponent",
        "more: wear gathers where the stress is high",
    ),
    (
        "wear.slip_rate_exponent",
        "more: wear gathers where slip is fast",
    ),
    (
        "wear.reference_stress",
        "more: less wear where stress has a power above 1",
    ),
    (
        "wear.reference_slip_rate",
        "more: less wear where slip rate has a power above 1",
    ),
    (
        "numerics.accuracy",
        "less: finer and slower; chooses method, points, steps, jumps",
    ),
    ("numerics.method", "how the three transforms are computed"),
    ("numerics.points", "more: finer and slower"),
    ("numerics.steps_per_cycle", "more: finer in time and slower"),
    (
        "numerics.domain_radius",
        "more: room to grow, coarser at the same points",
    ),
    (
        "numerics.grid",
        "graded: narrow cells where the worn profile is steep",
    ),
    (
        "numerics.scheme",
        "trapezoid: second order in time; euler: the paper's",
    ),
    (
        "numerics.stability",
        "sub-step: harsh steps in parts; off: the raw method",
    ),
    (
        "numerics.integrator",
        "direct: every step; cycle-jump: over cycles that are alike",
    ),
    (
        "numerics.tolerance",
        "more: longer jumps over cycles, less accurate",
    ),
];

/// The next number of two significant digits, up or down from `value`. Zero stays: it has no size.
fn next_number(value: f64, up: bool) -> f64 {
    if value == 0.0 {
        return value;
    }
    let (size, away) = (value.abs(), up == (value > 0.0));
    let exponent = size.log10().floor() as i32 - 1;
    // In units of the second digit: 10 to 99, and rounding of the logarithm aside.
    let count = size / 10f64.powi(exponent);
    let (count, exponent) = if away {
        ((count + 1e-9).floor() + 1.0, exponent)
    } else if count < 10.0 + 1e-9 {
        (99.0, exponent - 1)
    } else {
        ((count - 1e-9).ceil() - 1.0, exponent)
    };
    // Read back from text, so that 1.4e-10 is the number that a user would type.
    let text = format!("{count:.0}e{exponent}");
    text.parse::<f64>().unwrap_or(size).copysign(value)
}

/// A number as a reader writes it.
fn plain(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_go_by_their_second_digit() {
        for (value, up, down) in [
            (1.3e-10, 1.4e-10, 1.2e-10),
            (0.1, 0.11, 0.099),
            (100.0, 110.0, 99.0),
            (99.0, 100.0, 98.0),
            (0.7254, 0.73, 0.72),
            (2.3077e11, 2.4e11, 2.3e11),
            (-2.0, -1.9, -2.1),
            (0.0, 0.0, 0.0),
        ] {
            assert_eq!(next_number(value, true), up, "{value}");
            assert_eq!(next_number(value, false), down, "{value}");
        }
    }

    #[test]
    fn every_key_that_can_change_says_what_it_does() {
        for parameter in PARAMETERS
            .iter()
            .filter(|known| !["", "run", "changes"].contains(&known.section()))
        {
            let found = EFFECTS.iter().filter(|(path, _)| *path == parameter.path);
            assert_eq!(found.count(), 1, "{}", parameter.path);
        }
        assert!(
            EFFECTS
                .iter()
                .all(|(_, effect)| effect.chars().count() <= 68)
        );
    }

    #[test]
    fn settings_show_what_can_be_changed() {
        let scenario = Scenario::load("li2019-fig3", &[]).expect("a preset");
        let settings = Setting::all(&scenario);
        let of = |path: &str| {
            let found = settings.iter().find(|known| known.parameter.path == path);
            found.unwrap_or_else(|| panic!("no {path}"))
        };
        assert_eq!(of("motion.normal.mean").shown(), "1e-6 m");
        assert_eq!(of("numerics.method").next(true).as_deref(), Some("a"));
        assert_eq!(of("numerics.method").next(false).as_deref(), Some("benad"));
        assert_eq!(of("numerics.points").next(true).as_deref(), Some("110"));
        assert_eq!(
            of("friction.coefficient").next(true).as_deref(),
            Some("0.11")
        );
        assert!(
            settings
                .iter()
                .all(|known| known.parameter.section() != "run")
        );
        assert!(
            !settings
                .iter()
                .any(|known| known.parameter.path == "indenter.angle")
        );
    }
}
