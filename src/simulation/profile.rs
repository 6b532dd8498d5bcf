//! The 1D profile under the springs, Eq. (1), and where its scar ends.
//!
//! Where the contact slips as a whole, the scar ends with a slope, at a place t_s that lies between two nodes. The worn
//! depth falls to zero there on the line in t = r² through the last two worn nodes, and not at the next node. The tail down
//! to that node is no wear, neither in the profile nor in the worn volume. Under a pressure that is even up to the edge
//! the scar is [curved](EdgeCurve) besides.

use std::f64::consts::PI;

use super::model::Model;
use crate::math::abel::dome::Dome;
use crate::math::abel::edge_curve::EdgeCurve;
use crate::math::abel::field::Field;
use crate::math::abel::{kink, line};
use crate::math::geometry::Geometry;

/// The end of a curved scar is found in as many rounds, to 1e-4 of it.
const ROUNDS: usize = 2;

/// g, and where the scar in it ends.
#[derive(Debug, Clone)]
pub(super) struct Profile {
    /// g at the nodes, m.
    pub g: Vec<f64>,
    /// The end t_s of the scar, m²; `None` unless there is a scar that ends with a slope.
    pub scar: Option<f64>,
}

impl Profile {
    /// Returns a zero profile on the grid of `model`.
    pub fn new(model: &Model) -> Self {
        Self {
            g: vec![0.0; model.nodes()],
            scar: None,
        }
    }

    /// Makes the profile of a worn depth (m), given with its 1D image (m), under a load that ends [evenly](even_end).
    pub fn of_worn(model: &Model, worn: [&[f64]; 2], even: Option<f64>) -> Self {
        let mut profile = Self::new(model);
        profile.find(model, worn, even);
        profile
    }

    /// Sets the profile of a worn depth (m), given with its 1D image (m), under a load that ends [evenly](even_end).
    pub fn find(&mut self, model: &Model, [wear, image]: [&[f64]; 2], even: Option<f64>) {
        model.profile(image, 0.0, &[], &mut self.g);
        self.end_scar(model, |j| wear[j], even);
    }

    /// Sets the profile of a worn depth (m) and its 1D image (m),
    /// plus `ahead` times the growth of both in the last step.
    pub fn extrapolate(
        &mut self,
        model: &Model,
        [wear, image]: [&[f64]; 2],
        (ahead, [worn, growth]): (f64, [&[f64]; 2]),
        even: Option<f64>,
    ) {
        model.profile(image, ahead, growth, &mut self.g);
        self.end_scar(model, |j| wear[j] + ahead * worn[j], even);
    }

    /// Ends the scar of a worn depth inside its last cell.
    fn end_scar(&mut self, model: &Model, wear: impl Fn(usize) -> f64, even: Option<f64>) {
        let end = end_of_scar(model, &wear, even);
        self.scar = end.map(|(_, end)| end);
        let Some((last, end)) = end else { return };
        let t = model.grid.squares();
        let Some(&next) = t.get(last + 1) else { return };
        if let Some(even) = even {
            EdgeCurve::new(even, end).add_to_profile(t, last, &mut self.g);
        }
        // Subtracts the image, Eq. (1), of the tail beyond the scar's end.
        let kinks = kink::hat([t[last], next], wear(last), end);
        for (g, &t) in self.g.iter_mut().zip(t).skip(last + 1) {
            if model.setup.geometry.is_line() {
                *g += kinks
                    .iter()
                    .map(|kink| line::image_of_kink(kink, t))
                    .sum::<f64>();
                continue;
            }
            let roots = kinks
                .iter()
                .map(|kink| kink.jump * (t - kink.at).max(0.0).sqrt());
            *g += 2.0 * t.sqrt() * roots.sum::<f64>();
        }
    }
}

/// The height over E* of the dome as which a load ends, if it does: what the springs but the outermost tell, whose own load
/// depends on the scar within its cell.
pub(super) fn even_end(model: &Model, load: &Field) -> Option<f64> {
    let Dome { last, edge, .. } = load.dome?;
    let is_inside = load.nodal.get(last + 1) == Some(&0.0);
    let inner = load.nodal.get(..last).filter(|_| is_inside)?;
    let dome = Dome::fit(inner, model.grid.squares(), edge)?;
    Some(dome.height / model.setup.material.normal_modulus())
}

/// The last worn node, and the t = r² (m²) in the cell behind it where the scar ends: that node itself at a rim. `None`
/// elsewhere if the wear does not reach the tip: where something sticks for ever the load falls to zero outside of what
/// is worn.
fn end_of_scar(
    model: &Model,
    wear: impl Fn(usize) -> f64,
    even: Option<f64>,
) -> Option<(usize, f64)> {
    let t = model.grid.squares();
    if !model.setup.method.traits().follows_kinks {
        return None;
    }
    let last = (1..t.len()).rev().find(|&j| wear(j) > 0.0)?;
    let Some(&next) = t.get(last + 1) else {
        return Some((last, t[last]));
    };
    if wear(0) <= 0.0 {
        return None;
    }
    // Where the line through two depths ends.
    let line = |[inner, outer]: [f64; 2]| {
        let falls = (inner - outer) / (t[last] - t[last - 1]);
        if falls > 0.0 {
            (t[last] + outer / falls).min(next)
        } else {
            next
        }
    };
    let depths = [last - 1, last].map(&wear);
    let mut end = line(depths);
    if let Some(height) = even {
        for _ in 0..ROUNDS {
            let curve = EdgeCurve::new(height, end);
            end = line([0, 1].map(|k| depths[k] + curve.at(t[last - 1 + k])));
        }
    }
    Some((last, end))
}

/// The volume of the worn depth (m) of a scar, m³, under a load that ends [evenly](even_end).
pub(super) fn scar_volume(model: &Model, wear: &[f64], even: Option<f64>) -> f64 {
    let t = model.grid.squares();
    let tail = end_of_scar(model, |j| wear[j], even).map_or(0.0, |(last, end)| {
        let next = t.get(last + 1).copied().unwrap_or(end);
        match model.setup.geometry {
            Geometry::Round => 0.5 * PI * wear[last] * (next - end),
            Geometry::Line { .. } if next <= end => 0.0,
            Geometry::Line { length } => {
                let hat = kink::hat([t[last], next], wear[last], end);
                -2.0 * length * kink::line_integral(&hat, model.grid.radius())
            }
        }
    });
    model.volume(wear) - tail
}
