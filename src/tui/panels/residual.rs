//! The difference between wear volume and friction work: V/(k E_d) − 1 since the start, in
//! thousandths. The wear law says zero.

use super::{Declared, Frame, View, Words, cycles_shown, over_cycles, series};
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve};
use crate::tui::trend::Cycle;

/// The panel.
pub const PANEL: Declared = Declared {
    title: "V against k E_d",
    has_spikes: true,
    is_calm: true,
    words: Words {
        text: "V = k E_d holds exactly in theory: V comes from the 3D profile, E_d from the 1D springs. The \
                 difference shows how consistent the numerics are.",
        symbols: &[
            ("V", "wear volume"),
            ("k", "wear coefficient"),
            ("E_d", "friction work"),
        ],
    },
    ..Declared::chart(draw)
};

/// V/(k E_d) − 1 at the end of an entry, in ‰; NaN under laws that do not follow energy.
fn difference(entry: &Cycle) -> f64 {
    1e3 * (entry.wear_volume / entry.expected_volume - 1.0)
}

fn draw(frame: &Frame, _: &View) -> Result<Chart, &'static str> {
    let differences = series(frame, "", Role::Profile, difference);
    if !differences.ys.iter().any(|value| value.is_finite()) {
        return Err("nothing to compare yet");
    }
    let zero = Curve::new("", cycles_shown(frame), [0.0; 2], Role::Faint);
    let ordinate = Axis::new("V/(k E_d) - 1", "1e-3");
    Ok(over_cycles(frame, ordinate)
        .curve(zero.dashed())
        .curve(differences))
}
