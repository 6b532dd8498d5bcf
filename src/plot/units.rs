//! SI prefixes for axes and values.
//!
//! One axis has one prefix, chosen for the largest absolute value on it, so that all its labels share it. A prefix
//! before a power of a unit is raised with it, as SI requires: 1 µm³ is 10⁻¹⁸ m³. Where no prefix applies (pure
//! numbers, `1/Pa`, cycles) or fits, a power of a thousand is written instead: `[1e-6 1/Pa]`.

use std::borrow::Cow;

use crate::math::number::{exact, rounded, shown};
use crate::scenario::units::{SHOWN_PREFIXES, shown_in, takes_prefix};

/// Returns the prefix for values up to `max` of `unit`, and its factor: 1e-18 for µ before m³. Some units (an empty
/// one, `1/Pa`, `cycles`) have no prefixes.
fn prefix(max: f64, unit: &str) -> (&'static str, f64) {
    let size = max.abs() * (1.0 + 1e-9);
    let power = match leading_power(unit) {
        // Kiloseconds and kiloradians are not in use.
        Some(_) if matches!(unit, "s" | "rad" | "rad/s") && max.abs() >= 1.0 => return ("", 1.0),
        Some(power) if size > 0.0 && size.is_finite() => power,
        _ => return ("", 1.0),
    };
    let raised = SHOWN_PREFIXES.map(|(symbol, _, factor)| (symbol, factor.powi(power)));
    let fitting = raised.into_iter().rfind(|(_, factor)| *factor <= size);
    fitting.unwrap_or(raised[0])
}

/// Returns the power of a unit's first symbol (3 for `m³`, 1 for `N/m`); `None` if no prefix applies.
fn leading_power(unit: &str) -> Option<i32> {
    let rest = unit.trim_start_matches(char::is_alphabetic);
    // Other words (cycles, %, deg) have no prefixes.
    takes_prefix(unit.strip_suffix(rest)?).then_some(())?;
    match rest.trim_start_matches('^').chars().next() {
        Some('²' | '2') => Some(2),
        Some('³' | '3') => Some(3),
        Some('(' | '-' | '⁻' | '0'..='9' | '⁰' | '¹' | '⁴'..='⁹') => None,
        _ => Some(1),
    }
}

/// The unit of an axis' labels.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisUnit {
    /// The size of this unit in the data's unit.
    pub factor: f64,
    /// The unit with its prefix or power of ten (`MPa`, `1e-15 N`, `1e6 cycles`, or empty).
    pub text: String,
}

/// Returns the common unit of an axis whose largest absolute value is `max` (in `unit`).
pub fn axis_unit(max: f64, unit: &str) -> AxisUnit {
    let (symbol, factor) = prefix(max, unit);
    let scaled = max.abs() / factor;
    if scaled == 0.0 || !scaled.is_finite() || (0.01..1e5).contains(&scaled) {
        let text = format!("{symbol}{unit}");
        return AxisUnit { factor, text };
    }
    let power = 3 * ((max.abs() * (1.0 + 1e-9)).log10() / 3.0).floor() as i32;
    // A unit that is itself a power of ten, such as 1e-3, is combined with the power.
    let own = unit.strip_prefix("1e");
    let own = own.and_then(|own| own.parse::<i32>().ok());
    let text = match own.map(|own| power + own) {
        Some(0) => String::new(),
        Some(both) => format!("1e{both}"),
        None => format!("1e{power} {unit}").trim_end().to_owned(),
    };
    AxisUnit {
        factor: 10f64.powi(power),
        text,
    }
}

/// Formats the ends of a range (in `unit`) for its key, with `digits` significant digits each. They share one unit,
/// which the second end names, unless it has a power of ten: then each end names its own.
pub fn range_ends([low, high]: [f64; 2], unit: &str, digits: usize) -> [String; 2] {
    let AxisUnit { factor, text } = axis_unit(high.abs().max(low.abs()), unit);
    if text.starts_with("1e") {
        return [low, high].map(|end| format_value(end, unit, digits));
    }
    let [low, high] = [low, high].map(|end| shown(end / factor, digits));
    [low, format!("{high} {text}").trim_end().to_owned()]
}

/// Formats a value with its unit, `1.23 µm`, to `digits` significant digits (digits before the point are never rounded
/// away). The prefix is chosen after rounding; beyond pico and giga the notation is scientific.
pub fn format_value(value: f64, unit: &str, digits: usize) -> String {
    let digits = digits.clamp(1, 17);
    let (mut symbol, factor) = prefix(rounded(value, digits), unit);
    let mut number = shown(value / factor, digits);
    if number.contains('e') {
        (symbol, number) = ("", shown(value, digits));
    }
    let text = format!("{number} {symbol}{unit}");
    text.trim_end().to_owned()
}

/// Most digits of a [`reading`].
const DIGITS: usize = 7;

/// Formats a value (in `unit`) as an engineer writes it, to at most seven digits. Returns the number and its unit,
/// which a scenario accepts: `230.77 GPa`, `1 µm`, `45 deg`, `100 rad/s`, `0.13 mm³/J`.
pub fn reading(value: f64, unit: &str, ascii: bool) -> (String, String) {
    let (unit, factor) = match shown_in(unit) {
        Some((unit, factor)) => (unit.to_owned(), factor),
        None => {
            let (symbol, factor) = prefix(value, unit);
            (format!("{symbol}{unit}"), factor)
        }
    };
    let unit = if ascii {
        to_ascii(&unit.replace('³', "^3")).into_owned()
    } else {
        unit
    };
    (exact(rounded(value / factor, DIGITS)), unit)
}

/// Characters common in units and labels, and their spelling in ASCII.
#[rustfmt::skip]
const SPELLED: [(&str, &str); 39] = [
    // The micro sign of the prefix, and the Greek letter mu of friction.
    ("\u{b5}", "u"), ("\u{3bc}", "mu"),
    ("⁰₀", "0"), ("¹₁", "1"), ("²₂", "2"), ("³₃", "3"), ("⁻−–—─━", "-"), ("│├┤", "|"), ("┊", ":"), ("→", "->"), ("↓", "v"),
    ("←", "<-"), ("‖", "="), ("■", "#"), ("·", "*"), ("×", "x"), ("∞", "inf"), ("τ", "tau"), ("σ", "sigma"),
    ("ω", "omega"), ("φ", "phi"), ("ν", "nu"), ("ρ", "rho"), ("ε", "eps"), ("δΔ", "d"), ("°", "deg"), ("∝", "~"),
    ("≤", "<="), ("≥", ">="), ("±", "+-"), ("●◆", "o"), ("╳", "X"), ("▶", ">"), ("◀◂", "<"), ("▲", "^"),
    // The dashes of a legend.
    ("╌", "="), ("┈", "."), ("┄", "~"), ("╴", "_"),
];

/// Spells characters common in units and labels in ASCII (`µm` as `um`, `τ` as `tau`); any other non-ASCII character
/// becomes `?`.
pub fn to_ascii(text: &str) -> Cow<'_, str> {
    if text.is_ascii() {
        return Cow::Borrowed(text);
    }
    let mut folded = String::with_capacity(text.len());
    for c in text.chars() {
        match SPELLED.iter().find(|(signs, _)| signs.contains(c)) {
            _ if c.is_ascii() => folded.push(c),
            Some((_, spelled)) => folded.push_str(spelled),
            None => folded.push('?'),
        }
    }
    Cow::Owned(folded)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::key::Key;
    use crate::scenario::units::quantity;

    #[test]
    fn the_prefix_follows_the_largest_value() {
        let cases = [
            (1e-15, "p"),
            (3e-12, "p"),
            (1e-9, "n"),
            (999e-9, "n"),
            (1e-6, "µ"),
            (0.02, "m"),
            (1.0, ""),
            (999.0, ""),
            (1e3, "k"),
            (-2e6, "M"),
            (1e12, "G"),
            (0.0, ""),
            (f64::NAN, ""),
            (f64::INFINITY, ""),
        ];
        for (max, symbol) in cases {
            assert_eq!(prefix(max, "m").0, symbol, "{max}");
        }
    }

    #[test]
    fn a_power_of_a_unit_raises_its_prefix() {
        let volume = prefix(3e-17, "m³");
        assert_eq!(volume.0, "µ");
        assert!((volume.1 / 1e-18 - 1.0).abs() < 1e-12);
        assert_eq!(format_value(3e-17, "m³", 3), "30.0 µm³");
        assert_eq!(format_value(2e-10, "m^2", 2), "200 µm^2");
        assert_eq!(prefix(1e-10, "1/Pa"), ("", 1.0));
        assert_eq!(prefix(1e6, "cycles"), ("", 1.0));
        assert_eq!(prefix(2e4, "N/m").0, "k");
        assert_eq!(prefix(2e4, "s"), ("", 1.0));
        assert_eq!(prefix(2e-4, "s").0, "µ");
    }

    #[test]
    fn readings() {
        assert_eq!(format_value(1.234e-6, "m", 3), "1.23 µm");
        assert_eq!(format_value(999.96e-6, "m", 3), "1.00 mm");
        assert_eq!(format_value(-2.3077e11, "Pa", 4), "-230.8 GPa");
        assert_eq!(format_value(0.0, "Pa", 4), "0 Pa");
        assert_eq!(format_value(199.24, "cycles", 5), "199.24 cycles");
        assert_eq!(format_value(12345.0, "", 3), "12345");
        assert_eq!(format_value(1.3e-10, "1/Pa", 2), "1.3e-10 1/Pa");
        assert_eq!(format_value(1.2e-17, "m", 3), "1.20e-17 m");
        assert_eq!(format_value(1e300, "m", 3), "1.00e300 m");
        assert_eq!(format_value(f64::NAN, "m", 3), "NaN m");
        assert_eq!(format_value(f64::MAX, "m", 2), "1.8e308 m");
    }

    #[test]
    fn axis_units_keep_labels_short() {
        let text = |max, unit| axis_unit(max, unit).text;
        assert_eq!(text(1.5e-4, "m"), "µm");
        assert_eq!(text(3e9, "Pa"), "GPa");
        assert_eq!(text(4e-7, ""), "1e-9");
        assert_eq!(text(1e6, "cycles"), "1e6 cycles");
        assert_eq!(text(200.0, "cycles"), "cycles");
        assert_eq!(text(1e-300, "N"), "1e-300 N");
        assert_eq!(text(1e-3, "m³"), "1e-3 m³");
        for exponent in -300..=300 {
            let max = 10f64.powi(exponent);
            for unit in ["", "m", "m²", "m³", "cycles"] {
                let scaled = max / axis_unit(max, unit).factor;
                assert!((0.009..1.1e5).contains(&scaled), "{max} {unit}: {scaled}");
            }
        }
    }

    #[test]
    fn readings_are_read_back() {
        for (value, unit, shown) in [
            (2.3077e11, "Pa", "230.77 GPa"),
            (1e-6, "m", "1 µm"),
            (0.01, "m", "10 mm"),
            (std::f64::consts::FRAC_PI_4, "rad", "45 deg"),
            (1.3e-10, "1/Pa", "0.13 mm³/J"),
            (1.3e-14, "m^3/(N*m)", "1.3e-5 mm³/(N·m)"),
            (100.0, "rad/s", "100 rad/s"),
            (0.3, "", "0.3"),
            (0.0, "m", "0 m"),
            (5e-15, "m", "0.005 pm"),
            (0.7, "m^(1-exponent)", "0.7 m^(1-exponent)"),
        ] {
            let (number, of) = reading(value, unit, false);
            assert_eq!(format!("{number} {of}").trim_end(), shown);
            for ascii in [true, false] {
                let (number, of) = reading(value, unit, ascii);
                assert!(!ascii || of.is_ascii());
                let known = Key::all().find(|known| known.unit == unit);
                let read = quantity(&format!("{number} {of}"), &known.expect("a key"), false);
                if let Some(Ok(read)) = read {
                    assert!(
                        (read - value).abs() <= 1e-6 * value.abs(),
                        "{shown}: {read}"
                    );
                }
            }
        }
    }

    /// A key reads 151000 µm³, not 151 1e3 µm³.
    #[test]
    fn a_number_of_a_range_has_a_prefix_or_a_power_of_ten_and_never_both() {
        for (range, unit, ends) in [
            ([0.0, 1.51e-13], "m³", ["0 m³", "151000 µm³"]),
            ([2e-16, 3e-15], "m³", ["200", "3000 µm³"]),
            ([2e-7, 3e-6], "m", ["0.200", "3.00 µm"]),
            ([0.0, 3e-9], "1/Pa", ["0 1/Pa", "3.00e-9 1/Pa"]),
            ([0.1, 0.7], "", ["0.100", "0.700"]),
        ] {
            assert_eq!(range_ends(range, unit, 3), ends);
        }
    }

    #[test]
    fn ascii_has_no_other_character() {
        assert_eq!(to_ascii("τ [µm²]"), "tau [um2]");
        assert_eq!(to_ascii("1e-3 m³"), "1e-3 m3");
        assert!(to_ascii("∂ ⌀ 漢").is_ascii());
    }
}
