//! The keys of a scenario that can be changed while it runs, with their present values.

use crate::math::number::{exact, rounded};
use crate::math::scan::shifted;
use crate::plot::units::reading;
use crate::scenario::Scenario;
use crate::scenario::key::{Key, Kind};
use crate::scenario::units::{self, shown_in};
use crate::scenario::value::Value;

/// A key of the scenario as the explorer shows it.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// The key, its range and its meaning.
    pub key: Key,
    /// The unit in this scenario.
    pub unit: &'static str,
    /// The value; `None` if the scenario leaves it to the program.
    pub value: Option<Value>,
}

impl Setting {
    /// Returns every key that has a value or may be given one, in the order of a scenario file; also those that the
    /// chosen law, shape or waveform uses.
    pub fn all(scenario: &Scenario) -> Vec<Self> {
        let fixed = ["", "run", "changes"];
        Key::all()
            .filter(|key| !fixed.contains(&key.section()))
            // Long lists come from files, not from the keyboard.
            .filter(|key| key.kind != Kind::Numbers)
            .map(|key| Self {
                key,
                unit: units::unit_of(&key, scenario.prescribes_force(key.path)),
                value: scenario.value_in_use(key),
            })
            .filter(|setting| setting.value.is_some() || setting.key.section() == "numerics")
            .collect()
    }

    /// Returns the value as TOML, words without quotes.
    pub fn text(&self) -> Option<String> {
        Some(self.value.as_ref()?.bare())
    }

    /// Returns the value with its unit, as an engineer writes it: `230.77 GPa`.
    pub fn shown(&self, ascii: bool) -> String {
        match (self.reading(ascii), self.text()) {
            (Some((number, unit)), _) => format!("{number} {unit}").trim_end().to_owned(),
            (None, Some(value)) => format!("{value} {}", self.unit).trim_end().to_owned(),
            (None, None) => "default".to_owned(),
        }
    }

    /// Returns the number and the unit of a value that has a unit, as shown.
    fn reading(&self, ascii: bool) -> Option<(String, String)> {
        let value = self.value.as_ref()?.number()?;
        let has_unit = self.key.kind == Kind::Number && !self.unit.is_empty();
        has_unit.then(|| reading(value, self.unit, ascii))
    }

    /// Returns the hint next to a value being typed: the unit of a bare number, as in a scenario file, and the one in the
    /// list if it differs.
    pub fn typed_unit(&self) -> String {
        match (self.unit, shown_in(self.unit)) {
            ("", _) => String::new(),
            (unit, None) => format!("{unit}, or with a unit"),
            (unit, Some((other, _))) => format!("{unit}, or with a unit: {other}"),
        }
    }

    /// Returns why the value cannot change during a run, in a sentence; `None` if it can.
    pub fn fixed(&self) -> Option<String> {
        let because = self.key.fixed?;
        Some(format!("fixed during a run: {because}"))
    }

    /// Returns the words to choose the value from, if it is a choice.
    pub fn words(&self) -> Option<Vec<&'static str>> {
        self.key.kind.words()
    }

    /// Returns the next value up or down: the next word of a choice, or the next number with two digits; `None` at the
    /// last one.
    pub fn next(&self, up: bool) -> Option<String> {
        match self.value.as_ref()? {
            Value::Word(word) => {
                let places = if up { 1 } else { -1 };
                Some(shifted(&self.words()?, *word, places).to_owned())
            }
            Value::Flag(flag) => Some((!flag).to_string()),
            Value::Whole(whole) => {
                let next = next_number(*whole as f64, up);
                Some(if up { next.ceil() } else { next.floor() }.to_string())
            }
            // One step of the number as shown: 45 degrees are followed by 46.
            Value::Number(bare) => match self.reading(true) {
                Some((number, unit)) => {
                    let next = next_number(number.parse().ok()?, up);
                    let next = exact(rounded(next, 7));
                    Some(format!("{next} {unit}"))
                }
                None => Some(exact(rounded(next_number(*bare, up), 7))),
            },
            Value::Text(_) | Value::Numbers(_) => None,
        }
    }
}

/// Returns the next number with two significant digits, up or down from `value`. Zero stays, because it has no scale.
fn next_number(value: f64, up: bool) -> f64 {
    if value == 0.0 {
        return value;
    }
    let (size, away) = (value.abs(), up == (value > 0.0));
    let exponent = size.log10().floor() as i32 - 1;
    // Counts in units of the second digit, 10 to 99 except for rounding of the logarithm.
    let count = size / 10f64.powi(exponent);
    let (count, exponent) = if away {
        ((count + 1e-9).floor() + 1.0, exponent)
    } else if count < 10.0 + 1e-9 {
        (99.0, exponent - 1)
    } else {
        ((count - 1e-9).ceil() - 1.0, exponent)
    };
    // Parsed from text, so that 1.4e-10 is exactly the number that a user would type.
    let text = format!("{count:.0}e{exponent}");
    text.parse::<f64>().unwrap_or(size).copysign(value)
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
    fn settings_show_what_can_be_changed() {
        let scenario = Scenario::load("li2019-fig3", &[]).expect("a preset");
        let settings = Setting::all(&scenario);
        let of = |path: &str| {
            let found = settings.iter().find(|known| known.key.path == path);
            found.unwrap_or_else(|| panic!("no {path}"))
        };
        assert_eq!(of("motion.normal.mean").shown(false), "1 µm");
        for ascii in [true, false] {
            assert_eq!(of("motion.tangential.phase").shown(ascii), "45 deg");
        }
        assert_eq!(
            of("motion.normal.angular_frequency").shown(false),
            "100 rad/s"
        );
        let next = of("motion.tangential.phase").next(true);
        assert_eq!(next.as_deref(), Some("46 deg"));
        let modulus = of("material.effective_modulus");
        assert_eq!(modulus.shown(true), "230.77 GPa");
        // What is shown means the same when typed, and its unit is named next to the line.
        for setting in settings.iter().filter(|known| known.value.is_some()) {
            let path = setting.key.path;
            for shown in [true, false].map(|ascii| setting.shown(ascii)) {
                let again = scenario.assigned(&[(path, &shown)]);
                let again = again.unwrap_or_else(|error| panic!("{path} = {shown}: {error}"));
                let number = |of: &Scenario| of.value(path)?.parse::<f64>().ok();
                let [before, after] = [&scenario, &again].map(number);
                let is_same = match before.zip(after) {
                    Some((before, after)) => (before - after).abs() <= 1e-6 * before.abs(),
                    None => scenario.value(path) == again.value(path),
                };
                assert!(is_same, "{path} = {shown}: {before:?} {after:?}");
            }
            let shown = setting.shown(false);
            let unit = shown.split_once(' ').map_or("", |(_, unit)| unit);
            let unit = unit.trim_start_matches(['p', 'n', 'µ', 'm', 'k', 'M', 'G']);
            let hint = setting.typed_unit();
            assert!(hint.contains(unit), "{path} = {shown}: {hint}");
        }
        assert_eq!(of("numerics.method").next(true).as_deref(), Some("a"));
        assert_eq!(of("numerics.method").next(false).as_deref(), Some("benad"));
        assert_eq!(of("numerics.points").next(true).as_deref(), Some("110"));
        assert_eq!(
            of("friction.coefficient").next(true).as_deref(),
            Some("0.11")
        );
        assert!(settings.iter().all(|known| known.key.section() != "run"));
        assert!(
            !settings
                .iter()
                .any(|known| known.key.path == "indenter.angle")
        );
    }

    #[test]
    fn keys_of_the_chosen_law_shape_and_waveform_are_listed_with_what_they_are() {
        let fig3 = Scenario::load("li2019-fig3", &[]).expect("a preset");
        let shown = |scenario: &Scenario, path: &str| {
            let settings = Setting::all(scenario).into_iter();
            let mut found = settings.filter(|known| known.key.path == path);
            found.next().map(|known| known.shown(true))
        };
        for (key, word, used, value) in [
            ("wear.law", "power", "wear.stress_exponent", "1.5"),
            ("wear.law", "power", "wear.reference_slip_rate", "10 um/s"),
        ] {
            assert_eq!(shown(&fig3, used), None, "{used}");
            let other = fig3.assigned(&[(key, word)]).expect("a word");
            assert_eq!(shown(&other, used).as_deref(), Some(value), "{used}");
        }
    }
}
