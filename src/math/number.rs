//! Numbers as text: exact for files, rounded for people.

/// Returns the shortest decimal form that reads back to the same bits: 0 for both zeros, empty for NaN.
pub fn exact(value: f64) -> String {
    let size = value.abs();
    if value.is_nan() {
        String::new()
    } else if value == 0.0 {
        "0".into()
    } else if (1e-4..1e15).contains(&size) || !value.is_finite() {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Formats a number to `digits` significant digits (digits before the point are never rounded away); in scientific
/// notation outside 1e-3..1e6.
pub fn shown(value: f64, digits: usize) -> String {
    let digits = digits.clamp(1, 17);
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    let rounded = rounded(value, digits);
    let size = rounded.abs();
    if (1e-3..1e6).contains(&size) {
        let decimals = digits as i32 - 1 - (size * (1.0 + 1e-12)).log10().floor() as i32;
        let shown = if decimals < 0 { value } else { rounded };
        format!("{shown:.*}", decimals.max(0) as usize)
    } else {
        format!("{rounded:.*e}", digits - 1)
    }
}

/// Rounds `value` to `digits` significant decimal digits.
pub fn rounded(value: f64, digits: usize) -> f64 {
    let rounded = format!("{value:.*e}", digits - 1).parse();
    // Rounding may overflow next to f64::MAX; the value itself is then good enough.
    match rounded {
        Ok(number) if f64::is_finite(number) => number,
        _ => value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_numbers_read_back_to_the_same_bits() {
        let values = [
            0.1 + 0.2,
            1e-300,
            -1.5e-7,
            199.24,
            5e-324,
            f64::MAX,
            1e22,
            2.0 / 3.0,
            0.0001,
        ];
        for value in values {
            let text = exact(value);
            let read = text.parse::<f64>().map(f64::to_bits);
            assert_eq!(read, Ok(value.to_bits()), "{text}");
        }
        assert_eq!(exact(-0.0), "0");
        assert_eq!(exact(f64::NAN), "");
        assert_eq!(exact(2.5e-5), "2.5e-5");
    }

    #[test]
    fn shown_numbers_have_their_digits() {
        for (value, digits, text) in [
            (199.24, 5, "199.24"),
            (12345.0, 3, "12345"),
            (0.5, 2, "0.50"),
            (9.996, 3, "10.0"),
            (1.3e-10, 2, "1.3e-10"),
            (-2.3077e11, 3, "-2.31e11"),
            (0.0, 4, "0"),
            (f64::MAX, 2, "1.8e308"),
            (f64::NAN, 2, "NaN"),
        ] {
            assert_eq!(shown(value, digits), text);
        }
        assert_eq!(rounded(230.769_999_999, 7), 230.77);
    }
}
