//! The ticks of an axis on paper, with its title and numbers as printed.

use crate::plot::axis::titled;
use crate::plot::ticks::{Labels, Ruler};
use crate::plot::units::AxisUnit;
use crate::plot::window::Window;
use crate::plot::{Axis, Scale};

/// Logarithmic axes with a smaller ratio of their ends have one unit prefix instead of powers of ten.
const ONE_PREFIX: f64 = 1.1e4;

/// Lays out an axis with room for this many labels.
pub(super) fn ruler(axis: &Axis, bounds: [f64; 2], cells: f64, labels: Labels) -> Ruler {
    let cells = cells.clamp(2.0, 400.0) as u16;
    let window = Window::new(bounds, axis.scale, cells, 16);
    Ruler::new(window, unit_of(axis, bounds), labels)
}

/// Lays out an axis of this height, mm.
pub(super) fn column(axis: &Axis, bounds: [f64; 2], height: f64, font: f64) -> Ruler {
    ruler(axis, bounds, height / (1.2 * font), Labels::Column)
}

/// Returns the title of an axis, with the unit of its labels.
pub(super) fn title(axis: &Axis, unit: &AxisUnit) -> String {
    titled(&axis.label, &numeral(&unit.text), ['(', ')'])
}

/// Returns the unit of an axis' labels; logarithmic axes over many decades keep the data's unit.
fn unit_of(axis: &Axis, bounds: [f64; 2]) -> AxisUnit {
    let is_narrow = !axis.unit.is_empty() && bounds[1] / bounds[0] < ONE_PREFIX;
    match axis.scale {
        Scale::Log if !is_narrow => AxisUnit {
            factor: 1.0,
            text: axis.unit.to_owned(),
        },
        _ => axis.unit_for(bounds),
    }
}

/// Formats a number, alone or before a unit, for print: with a true minus sign, and 2e-8 as 2·10^−8.
pub(super) fn numeral(text: &str) -> String {
    let (number, unit) = text.split_once(' ').unwrap_or((text, ""));
    if number.parse::<f64>().is_err() {
        return text.to_owned();
    }
    let number = number.replace('-', "−");
    let number = match number.split_once('e') {
        None => number,
        Some(("1", exponent)) => format!("10^{exponent}"),
        Some((mantissa, exponent)) => format!("{mantissa}·10^{exponent}"),
    };
    format!("{number} {unit}").trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_set_as_print_has_them() {
        for (text, set) in [
            ("0.5", "0.5"),
            ("-20", "−20"),
            ("1e-4", "10^−4"),
            ("2e8", "2·10^8"),
            ("1e-9 m", "10^−9 m"),
            ("µm", "µm"),
            ("cycles", "cycles"),
            ("1/Pa", "1/Pa"),
        ] {
            assert_eq!(numeral(text), set);
        }
    }
}
