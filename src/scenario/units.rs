//! Numbers with units, as people write them: `radius = "10 mm"`, `phase = "45°"`.
//!
//! A text is a number and a unit, which combines known units by `·`, `*`, `/`, powers and parentheses, with SI
//! prefixes: `230.8 GPa`, `0.13 mm³/J`, `1.3e8 um^3/J`. It is accepted if its dimension is the key's. Powers of
//! ten go into the exponent of the number before it is parsed, so that `"10 mm"` is the same float as `0.01`. One hertz
//! is 2π rad/s.

use std::f64::consts::{PI, TAU};

use super::escape::echo;
use super::key::{Kind, Parameter};

/// A product of units: powers of metre, kilogram, second, radian and ten, and the remaining factor to SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Unit {
    powers: [i32; 5],
    factor: f64,
}

/// Whether a symbol is a unit that takes a prefix.
pub fn takes_prefix(symbol: &str) -> bool {
    let mut units = UNITS.iter();
    units.any(|(name, _, takes_prefix)| *name == symbol && *takes_prefix)
}

const fn unit(powers: [i32; 5], factor: f64) -> Unit {
    Unit { powers, factor }
}

/// Units by symbol, and whether they take a prefix.
const UNITS: &[(&str, Unit, bool)] = &[
    ("1", unit([0, 0, 0, 0, 0], 1.0), false),
    ("m", unit([1, 0, 0, 0, 0], 1.0), true),
    ("g", unit([0, 1, 0, 0, -3], 1.0), true),
    ("s", unit([0, 0, 1, 0, 0], 1.0), true),
    ("min", unit([0, 0, 1, 0, 1], 6.0), false),
    ("h", unit([0, 0, 1, 0, 2], 36.0), false),
    ("rad", unit([0, 0, 0, 1, 0], 1.0), true),
    ("deg", unit([0, 0, 0, 1, 0], PI / 180.0), false),
    ("°", unit([0, 0, 0, 1, 0], PI / 180.0), false),
    ("Hz", unit([0, 0, -1, 1, 0], TAU), true),
    ("N", unit([1, 1, -2, 0, 0], 1.0), true),
    ("Pa", unit([-1, 1, -2, 0, 0], 1.0), true),
    ("J", unit([2, 1, -2, 0, 0], 1.0), true),
    ("W", unit([2, 1, -3, 0, 0], 1.0), true),
];

/// Prefixes for displayed numbers, smallest first: symbol, power of ten, and factor.
pub const SHOWN_PREFIXES: [(&str, i32, f64); 8] = [
    ("p", -12, 1e-12),
    ("n", -9, 1e-9),
    ("µ", -6, 1e-6),
    ("m", -3, 1e-3),
    ("", 0, 1.0),
    ("k", 3, 1e3),
    ("M", 6, 1e6),
    ("G", 9, 1e9),
];

/// Further prefixes that are read.
const OTHER_PREFIXES: [(&str, i32); 2] = [("u", -6), ("c", -2)];

impl Unit {
    fn find(symbol: &str) -> Option<Self> {
        let known = |symbol: &str| UNITS.iter().find(|(name, ..)| *name == symbol);
        if let Some((_, unit, _)) = known(symbol) {
            return Some(*unit);
        }
        let shown = SHOWN_PREFIXES.map(|(prefix, power, _)| (prefix, power));
        let mut read = shown.into_iter().chain(OTHER_PREFIXES);
        read.find_map(|(prefix, power)| {
            let (_, known, _) = known(symbol.strip_prefix(prefix)?).filter(|known| known.2)?;
            Some(known.times(unit([0, 0, 0, 0, power], 1.0)))
        })
    }

    /// As [`named`](Self::find), but also accepts newtons and a length without a sign between them, as pin tests
    /// report their wear: `mm³/Nm`.
    fn named_or_moment(symbol: &str) -> Option<Self> {
        Self::find(symbol).or_else(|| {
            let length = Self::find(symbol.strip_prefix('N')?)?;
            length.is_like(Self::find("m")?).then_some(())?;
            Some(length.times(Self::find("N")?))
        })
    }

    /// Whether it has the same dimension, whatever its factor.
    fn is_like(self, other: Self) -> bool {
        self.powers[..4] == other.powers[..4]
    }

    fn power(self, power: i32) -> Self {
        unit(self.powers.map(|of| of * power), self.factor.powi(power))
    }

    fn times(self, other: Self) -> Self {
        let powers = std::array::from_fn(|k| self.powers[k] + other.powers[k]);
        unit(powers, self.factor * other.factor)
    }

    /// Returns `mantissa`·10^`exponent` of it in an `own` unit. The power of ten goes into the text that is parsed.
    fn worth(self, mantissa: &str, exponent: i32, own: Self) -> Option<f64> {
        let power = exponent + self.powers[4] - own.powers[4];
        let value: f64 = format!("{mantissa}e{power}").parse().ok()?;
        Some(value * (self.factor / own.factor))
    }

    /// Parses a whole unit; `None` if it is not one.
    fn read(text: &str) -> Option<Self> {
        let text: String = text.trim().chars().map(one_spelling).collect();
        let mut rest = text.as_str();
        let unit = product(&mut rest)?;
        rest.is_empty().then_some(unit)
    }
}

/// Maps characters with the same meaning to the one that the parser knows.
fn one_spelling(c: char) -> char {
    const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    match c {
        '·' | '⋅' => '*',
        'μ' => 'µ',
        '⁻' => '-',
        c => match RAISED.chars().position(|raised| raised == c) {
            Some(digit) => char::from(b'0' + digit as u8),
            None => c,
        },
    }
}

/// Parses factors up to the end or a closing parenthesis; `/` applies to the next factor only.
fn product(rest: &mut &str) -> Option<Unit> {
    let mut unit = factor(rest)?;
    loop {
        let is_apart = rest.starts_with(' ');
        *rest = rest.trim_start();
        let power = match rest.chars().next() {
            None | Some(')') => return Some(unit),
            Some('/') => -1,
            Some('*') => 1,
            Some(c) if is_apart && c.is_alphabetic() => {
                unit = unit.times(factor(rest)?);
                continue;
            }
            Some(_) => return None,
        };
        *rest = rest[rest.chars().next()?.len_utf8()..].trim_start();
        unit = unit.times(factor(rest)?.power(power));
    }
}

fn factor(rest: &mut &str) -> Option<Unit> {
    if let Some(inside) = rest.strip_prefix('(') {
        *rest = inside;
        let unit = product(rest)?;
        *rest = rest.strip_prefix(')')?;
        return Some(unit.power(power(rest)?));
    }
    if let Some(after) = rest.strip_prefix('1') {
        *rest = after;
        return Unit::find("1");
    }
    let is_of_symbol = |c: char| c.is_alphabetic() || c == '°';
    let end = rest.find(|c| !is_of_symbol(c)).unwrap_or(rest.len());
    let unit = Unit::named_or_moment(&rest[..end])?;
    *rest = &rest[end..];
    Some(unit.power(power(rest)?))
}

/// Parses the power after a symbol: `^3`, `3`, `^-1`; 1 if there is none.
fn power(rest: &mut &str) -> Option<i32> {
    let plain = rest.strip_prefix('^').unwrap_or(rest);
    let end = plain.find(|c: char| !(c.is_ascii_digit() || c == '-'));
    let (digits, after) = plain.split_at(end.unwrap_or(plain.len()));
    if digits.is_empty() {
        return (plain.len() == rest.len()).then_some(1);
    }
    *rest = after;
    digits.parse().ok().filter(|power: &i32| power.abs() <= 9)
}

/// Splits the number at the start of a text into mantissa and exponent, and returns the rest.
fn number(text: &str) -> Option<(&str, i32, &str)> {
    let is_of_number = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let end = text.find(|c| !is_of_number(c)).unwrap_or(text.len());
    let is_number = |end: &usize| text[..*end].parse::<f64>().is_ok();
    let (number, rest) = text.split_at((1..=end).rev().find(is_number)?);
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    Some((mantissa, exponent.parse().ok()?, rest))
}

/// Returns the value of `text` in `unit`; `None` if the text is not a number with a unit.
///
/// # Errors
/// If the unit is unknown or of another dimension: the rule that it breaks.
pub fn in_unit(text: &str, unit: &str) -> Option<Result<f64, String>> {
    let text = text.trim();
    if let Some(pointed) = with_decimal_point(text) {
        let rule = format!("must be written with a point, {}", echo(&pointed));
        return Some(Err(rule));
    }
    let (mantissa, exponent, given) = number(text)?;
    let given = given.trim();
    let due = Unit::read(unit)?;
    if given.is_empty() {
        return None;
    }
    let example = example(unit);
    let Some(found) = Unit::read(given) else {
        return Some(Err(format!(
            "{} is not a unit; write a number in {unit}, or a string such as {example}",
            echo(given)
        )));
    };
    if !found.is_like(due) {
        return Some(Err(format!(
            "must have a unit compatible with {unit}, such as {example}; {} is of another kind",
            echo(given)
        )));
    }
    found.worth(mantissa, exponent, due).map(Ok)
}

/// Returns the value of one `unit` in `own`; `None` if their dimensions differ.
pub(super) fn ratio(unit: &str, own: &str) -> Option<f64> {
    let (unit, own) = (Unit::read(unit)?, Unit::read(own)?);
    unit.worth("1", 0, own).filter(|_| unit.is_like(own))
}

/// Returns the text with a point instead of the decimal comma of its number; `None` if it has no comma.
pub(super) fn with_decimal_point(text: &str) -> Option<String> {
    let (whole, fraction) = text.split_once(',')?;
    let digits = whole.strip_prefix(['+', '-']).unwrap_or(whole);
    let is_number = !digits.is_empty() && digits.chars().all(|c| c.is_ascii_digit());
    let goes_on = fraction.starts_with(|c: char| c.is_ascii_digit());
    (is_number && goes_on && !fraction.contains(',')).then(|| format!("{whole}.{fraction}"))
}

/// Units of keys: an example of a value, and the unit for display if prefixes do not suit. An angular frequency is not
/// displayed in Hz, which is the unit of another key.
const USUAL: [(&str, &str, Option<&str>); 8] = [
    ("m", "\"10 mm\"", None),
    ("N", "\"5 mN\"", None),
    ("rad", "\"45 deg\"", Some("deg")),
    ("rad/s", "\"50 Hz\"", None),
    ("Pa", "\"210 GPa\"", None),
    // 1/Pa = m³/J: per friction work, where m³/(N·m) is per load and distance.
    ("1/Pa", "\"0.13 mm^3/J\"", Some("mm³/J")),
    ("m^3/(N*m)", "\"1e-5 mm^3/(N*m)\"", Some("mm³/(N·m)")),
    ("m/s", "\"10 um/s\"", None),
];

/// Returns an example of a value in a unit.
fn example(unit: &str) -> &'static str {
    let known = USUAL.iter().find(|(known, ..)| *known == unit);
    known.map_or("\"10 mm\" for a length", |(_, example, _)| example)
}

/// Returns the unit in which values of `unit` are displayed instead, and its factor; `None` if prefixes suit.
pub fn shown_in(unit: &str) -> Option<(&'static str, f64)> {
    let (.., shown) = USUAL.iter().find(|(known, ..)| *known == unit)?;
    let shown = (*shown)?;
    Some((shown, ratio(shown, unit)?))
}

/// Unit of a prescribed motion.
pub(super) const PRESCRIBED: &str = "m, or N if control = \"force\"";

/// Returns the rule for a force where a motion prescribes a displacement, and vice versa; `None` for other texts.
pub(super) fn of_other_control(text: &str, known: &Parameter) -> Option<&'static str> {
    let is_of = |unit| matches!(in_unit(text, unit), Some(Ok(_)));
    match known.unit {
        PRESCRIBED if is_of("N") => Some("N is no length: set control = \"force\" for a load"),
        PRESCRIBED if is_of("m") => {
            Some("m is no force: set control = \"displacement\" for a depth")
        }
        _ => None,
    }
}

/// Returns the unit of a key, in a motion that prescribes a force or a displacement.
pub fn unit_of(known: &Parameter, is_force: bool) -> &'static str {
    match known.unit {
        unit if unit != PRESCRIBED => unit,
        _ if is_force => "N",
        _ => "m",
    }
}

/// Returns the number that a text such as `5 um` means as a value of the key; `None` if it is not a number with a unit.
///
/// # Errors
/// If the unit is unknown or of another dimension: the rule that it breaks.
pub fn quantity(text: &str, known: &Parameter, is_force: bool) -> Option<Result<f64, String>> {
    match known.kind {
        Kind::Number => of_other_coefficient(text, known)
            .map(Err)
            .or_else(|| in_unit(text, unit_of(known, is_force))),
        _ => None,
    }
}

/// Returns the rule for a wear coefficient per load and distance where one per friction work is required, and vice
/// versa: both have the same dimension, and differ by the coefficient of friction.
fn of_other_coefficient(text: &str, known: &Parameter) -> Option<String> {
    let (.., unit) = number(text.trim())?;
    let is_volume = unit.contains(['3', '³']);
    let unit = echo(unit.trim());
    match known.unit {
        "1/Pa" if is_volume && unit.contains('N') => Some(format!(
            "{unit} is per load and sliding distance: give it as wear.coefficient_per_load; per friction work a \
             coefficient is in mm^3/J"
        )),
        "m^3/(N*m)" if is_volume && unit.contains('J') => Some(format!(
            "{unit} is per friction work: give it as wear.coefficient; per load and distance a coefficient is in \
             mm^3/(N*m)"
        )),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    #[test]
    fn texts_are_the_same_floats_as_numbers() {
        for (text, unit, expected) in [
            ("10 mm", "m", 0.01),
            ("10mm", "m", 0.01),
            ("1 µm", "m", 1e-6),
            ("0.1um", "m", 1e-7),
            ("230.77 GPa", "Pa", 2.3077e11),
            ("2.3077e5 MPa", "Pa", 2.3077e11),
            ("210e3 N/mm^2", "Pa", 2.1e11),
            ("-5 mN", "N", -5e-3),
            ("45 deg", "rad", std::f64::consts::FRAC_PI_4),
            ("45°", "rad", std::f64::consts::FRAC_PI_4),
            ("1 Hz", "rad/s", TAU),
            ("0.1 krad/s", "rad/s", 100.0),
            ("0.13 mm³/(N·m)", "1/Pa", 1.3e-10),
            ("0.13 mm^3/N/m", "1/Pa", 1.3e-10),
            ("0.13 mm3/Nm", "1/Pa", 1.3e-10),
            ("0.13 mm³/Nm", "1/Pa", 1.3e-10),
            ("0.13 mm3/(N m)", "1/Pa", 1.3e-10),
            ("1.3e-5 mm³/(N·m)", "m^3/(N*m)", 1.3e-14),
            ("50 Hz", "Hz", 50.0),
            ("1.3e8 µm³/J", "1/Pa", 1.3e-10),
            ("1.3e-10 1/Pa", "1/Pa", 1.3e-10),
            ("1.3e-10 Pa⁻¹", "1/Pa", 1.3e-10),
            ("0.13 1/GPa", "1/Pa", 1.3e-10),
            ("10 um/s", "m/s", 1e-5),
            ("2 N/µm", "N/m", 2e6),
        ] {
            assert_eq!(in_unit(text, unit), Some(Ok(expected)), "{text}");
        }
    }

    #[test]
    fn other_units_and_what_is_none_are_refused() {
        for (text, unit) in [
            ("10 mn", "m"),
            ("10 N", "m"),
            ("10 mm²", "m"),
            ("5 rad", "rad/s"),
            ("5 1/s", "rad/s"),
            ("10 mm)", "m"),
            ("10 (mm", "m"),
            ("10 mm/", "m"),
            ("10 mm^", "m"),
            ("1 mm^99", "m"),
            ("1 mm3/N m", "1/Pa"),
            ("1 Nkg", "J"),
        ] {
            let answer = in_unit(text, unit);
            assert!(matches!(answer, Some(Err(_))), "{text}: {answer:?}");
        }
        // Not a number with a unit: the check of all keys reports it.
        for text in ["ten mm", "", "10", "mm", "nan m"] {
            assert_eq!(in_unit(text, "m"), None, "{text}");
        }
    }

    #[test]
    fn scenarios_take_units_and_keep_exact_numbers() {
        let sets = [
            "indenter.radius=10 mm",
            "indenter.radius=\"10 mm\"",
            "indenter.radius=0.01",
        ];
        let loaded =
            sets.map(|set| Scenario::load("li2019-fig3", &[set.into()]).expect("a scenario"));
        assert!(loaded.iter().all(|scenario| *scenario == loaded[0]));
        assert!(loaded[0].to_toml().contains("radius = 0.01"));
        let force = Scenario::load(
            "li2019-fig3",
            &[
                "motion.normal.control=force".into(),
                "motion.normal.mean=20 N".into(),
                "motion.normal.amplitude=0 N".into(),
            ],
        )
        .expect("a scenario");
        assert_eq!(force.value("motion.normal.mean").as_deref(), Some("20.0"));
        for (set, word) in [
            ("motion.normal.mean=20 N", "N is no length: set control"),
            ("indenter.radius=10 mn", "mn is not a unit"),
            ("wear.coefficient=1 mm", "1/Pa"),
            (
                "wear.coefficient=1e-6 mm3/Nm",
                "give it as wear.coefficient_per_load",
            ),
            (
                "wear.coefficient=1e-6 mm^3/N/m",
                "give it as wear.coefficient_per_load",
            ),
            (
                "wear.coefficient_per_load=1e-6 mm3/J",
                "give it as wear.coefficient;",
            ),
            ("friction.coefficient=0.1 m", "finite number"),
        ] {
            let error = Scenario::load("li2019-fig3", &[set.into()]).expect_err(set);
            let said = error.to_string();
            assert!(
                said.contains(word) && said.contains(set.split('=').next().unwrap_or("")),
                "{said}"
            );
            assert!(!said.contains('\n'));
        }
    }
}
