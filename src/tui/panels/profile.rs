//! The 3D profile f(r), worn and unworn, with the zones of the contact under it. The wear is drawn
//! magnified where it would be thinner than a line.

use super::{App, Frame, Panel, curve, edge_marks, ghosts, radial_plot, zones};
use crate::math::scan::largest;
use crate::plot::{Band, Plot};
use crate::tui::theme::Role;

/// How much of the height of the unworn profile the magnified wear may take.
const SHARE: f64 = 0.35;

/// The largest magnification.
const MOST: f64 = 1e6;

/// How many times the `deepest` wear (m) is drawn magnified over a profile of this `height` (m): 1, 2, 5,
/// 10, …
fn magnification(deepest: f64, height: f64) -> f64 {
    if deepest <= 0.0 || deepest.is_nan() {
        return 1.0;
    }
    let most = (SHARE * height / deepest).clamp(1.0, MOST);
    let decade = 10f64.powf(most.log10().floor());
    let fits = [5.0, 2.0].into_iter().find(|times| times * decade <= most);
    fits.unwrap_or(1.0) * decade
}

/// The height of the unworn profile over the domain, m: what lies beyond the rim of a punch is left out.
fn height(frame: &Frame) -> f64 {
    let finite = frame.observation.unworn.iter().copied();
    let height = finite.filter(|f| f.is_finite()).fold(0.0, f64::max);
    // A flat punch has no height: its wear is drawn over the depth.
    if height > 0.0 {
        height
    } else {
        frame.observation.moment.depth.abs()
    }
}

/// f₀ plus `times` the `wear` (m).
fn magnified(frame: &Frame, wear: &[f64], times: f64) -> Vec<f64> {
    let unworn = frame.observation.unworn.iter();
    unworn.zip(wear).map(|(f, worn)| f + times * worn).collect()
}

/// How many times the wear is drawn: the same from the first cycle to the planned end, so that wear that
/// grows is seen to grow. Only where there is more than was expected, the factor falls.
pub fn times(frame: &Frame) -> f64 {
    let ghosts = ghosts::ordinates(&ghosts::worn(frame, None));
    let seen = largest(&frame.observation.wear).max(frame.expected_wear);
    let deepest = ghosts.into_iter().fold(seen, f64::max);
    magnification(deepest, height(frame))
}

/// The title, with the factor.
pub fn title(frame: &Frame, ascii: bool) -> String {
    let name = Panel::Profile.title();
    match times(frame) {
        1.0 => name.to_owned(),
        times if ascii => format!("{name}, wear drawn x{times}"),
        times => format!("{name}, wear drawn ×{times}"),
    }
}

/// What the ordinate must hold.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    let seen = &frame.observation;
    if seen.profile.is_empty() {
        return Vec::new();
    }
    let times = times(frame);
    let mut values = magnified(frame, &seen.wear, times);
    values.extend_from_slice(&seen.unworn);
    values.extend(ghosts::ordinates(&ghosts::worn(frame, Some(times))));
    values
}

/// Makes the plot and hands it to `then`.
pub fn plotted<T>(frame: &Frame, app: &App, then: impl FnOnce(&Plot<'_>) -> T) -> T {
    let (seen, theme) = (&frame.observation, &app.theme);
    let zones = zones(frame, theme);
    let limit: Vec<f64> = app
        .theory_of(frame)
        .and_then(|theory| theory.limiting_profile(&seen.radii))
        .map(|limit| {
            let unworn = seen.unworn.iter();
            limit.iter().zip(unworn).map(|(f, f0)| f - f0).collect()
        })
        .unwrap_or_default();
    let times = times(frame);
    let (worn, limit) = (
        magnified(frame, &seen.wear, times),
        magnified(frame, &limit, times),
    );
    let mut plot = radial_plot(Panel::Profile, app, frame, "r", ("f", "m"))
        .curve(curve("unworn", &seen.radii, &seen.unworn, theme, Role::Unworn).dashed());
    if !limit.is_empty() {
        plot = plot.curve(curve("limit", &seen.radii, &limit, theme, Role::Limit).dashed());
    }
    let mut ghosts = ghosts::worn(frame, Some(times));
    plot = plot
        .curves(ghosts::curves(&mut ghosts, app))
        .curve(curve("worn", &seen.radii, &worn, theme, Role::Profile).fill_from(&seen.unworn))
        .band(Band { zones: &zones });
    for mark in edge_marks(frame, theme) {
        plot = plot.mark(mark);
    }
    then(&plot)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wear_thinner_than_a_line_is_magnified_by_1_2_5() {
        for (deepest, times) in [
            (0.0, 1.0),
            (f64::NAN, 1.0),
            (1.0, 1.0),
            (0.3, 1.0),
            (0.17, 2.0),
            (0.06, 5.0),
            (3e-3, 100.0),
            (1e-12, 1e6),
        ] {
            assert_eq!(magnification(deepest, 1.0), times, "{deepest}");
        }
    }
}
