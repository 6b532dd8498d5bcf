//! The 3D profile f(r), worn and unworn, with the zones of the contact under it. The wear is drawn
//! magnified where it would be thinner than a line.

use super::{A, BAND, C, Declared, Frame, View, Words, ghosts, limit, over_r, zones};
use crate::math::scan::largest;
use crate::plot::theme::Role;
use crate::plot::{Chart, Curve, Fill};
use crate::simulation::Curves;

/// The panel.
pub const PANEL: Declared = Declared {
    title: "3D profile",
    can_be_log: true,
    needs: Curves::PROFILE,
    over_r: true,
    words: Words {
        text: "The shape of the indenter against the radius, unworn and worn. Wear thinner than a \
                 line is drawn magnified, by one factor for the whole run that the title tells. It begins \
                 where surfaces slide under pressure: in the ring between c and a. A faint line ends what \
                 sticks at the moment: all, whenever the motion reverses.",
        symbols: &[("f", "height of the profile over its tip"), A, C, BAND],
    },
    ..Declared::chart(draw)
};

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

/// How many times the wear is drawn: the same from the first cycle to the planned end, so that wear that
/// grows is seen to grow. Only where there is more than was expected, the factor falls.
fn times(frame: &Frame) -> f64 {
    let ghosts = ghosts::worn(frame, None);
    let seen = largest(&frame.observation.wear).max(frame.expected_wear);
    let deepest = ghosts.iter().map(Curve::highest).fold(seen, f64::max);
    magnification(deepest, height(frame))
}

fn draw(frame: &Frame, view: &View) -> Result<Chart, &'static str> {
    let (seen, times) = (&frame.observation, times(frame));
    let worn = seen.unworn.iter().zip(&seen.wear);
    let worn: Vec<f64> = worn.map(|(f0, wear)| f0 + times * wear).collect();
    let mut chart = over_r(frame, "r", ("f", "m"));
    if times > 1.0 {
        chart.title = format!("{}, wear drawn ×{times}", PANEL.title);
    }
    chart.band = zones(frame);
    let unworn = Curve::new("unworn", &seen.radii[..], &seen.unworn[..], Role::Unworn);
    let worn = Curve::new("worn", &seen.radii[..], worn, Role::Profile);
    Ok(chart
        .curve(unworn.dashed())
        .curves(limit(frame, view, Some(times)))
        .curves(ghosts::worn(frame, Some(times)))
        .curve(worn.filled(Fill::From(seen.unworn.to_vec()))))
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
