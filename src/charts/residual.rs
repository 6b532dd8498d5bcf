//! The relative difference between wear volume and friction work since the start, V/(k E_d) − 1, in thousandths. The
//! wear law predicts zero.

use super::{E_D, Recipe, Subject, V, View, cycles_shown, over_cycles, series};
use crate::charts::run::Run;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve};
use crate::reading::Column;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    title: "V against k E_d",
    has_spikes: true,
    is_calm: true,
    subject: Subject::Wear,
    history: &[Column::EnergyResidual],
    text: "V = k E_d holds exactly in theory: V comes from the 3D profile, E_d from the 1D springs. The \
           difference shows how consistent the numerics are.",
    symbols: &[V, ("k", "wear coefficient"), E_D],
    ..Recipe::new(make)
};

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    // The history has 1 − V/(k E_d); it is missing under laws that do not follow energy.
    let mut differences = series(run, view, Column::EnergyResidual, "", Role::Profile)?;
    for value in &mut differences.ys {
        *value *= -1e3;
    }
    if !differences.ys.iter().any(|value| value.is_finite()) {
        return Err("nothing to compare yet");
    }
    let ordinate = Axis::new("V/(k E_d) - 1", "1e-3");
    let zero = cycles_shown(run, view).map(|ends| Curve::new("", ends, [0.0; 2], Role::Faint));
    Ok(over_cycles(run, view, ordinate)
        .curves(zero.map(Curve::dashed))
        .curve(differences))
}
