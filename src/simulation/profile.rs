//! The 1D profile under the springs, Eq. (1), and where its scar ends.
//!
//! Where the contact slips as a whole, the scar ends with a slope, at a place t_s that lies between two nodes. The worn
//! depth falls to zero there on the line in t = r² through the last two worn nodes, and not at the next node. The tail down
//! to that node is no wear, neither in the profile nor in the worn volume.

use std::f64::consts::PI;

use super::model::Model;
use crate::math::abel::AbelMethod;
use crate::math::abel::{kink, line};
use crate::math::geometry::Geometry;

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

    /// That of a worn depth (m), whose 1D image (m) is given with it.
    pub fn of_worn(model: &Model, worn: [&[f64]; 2]) -> Self {
        let mut profile = Self::new(model);
        profile.find(model, worn);
        profile
    }

    /// Becomes that of a worn depth (m), whose 1D image (m) is given with it.
    pub fn find(&mut self, model: &Model, [wear, image]: [&[f64]; 2]) {
        model.profile(image, 0.0, &[], &mut self.g);
        self.end_scar(model, |j| wear[j]);
    }

    /// Sets the profile of a worn depth (m) and its 1D image (m),
    /// plus `ahead` times the growth of both in the last step.
    pub fn extrapolate(
        &mut self,
        model: &Model,
        [wear, image]: [&[f64]; 2],
        ahead: f64,
        [worn, growth]: [&[f64]; 2],
    ) {
        model.profile(image, ahead, growth, &mut self.g);
        self.end_scar(model, |j| wear[j] + ahead * worn[j]);
    }

    /// Ends the scar of a worn depth inside its last cell.
    fn end_scar(&mut self, model: &Model, wear: impl Fn(usize) -> f64) {
        let end = end_of_scar(model, &wear);
        self.scar = end.map(|(_, end)| end);
        let Some((last, end)) = end else { return };
        let t = model.grid.squares();
        let Some(&next) = t.get(last + 1) else { return };
        // Eq. (1) of what the line in t to the next node has too much.
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

/// The last worn node, and the t = r² (m²) in the cell behind it where the scar ends: that node itself at a rim. `None`
/// elsewhere if the wear does not reach the tip: where something sticks for ever the load falls to zero outside of what
/// is worn.
fn end_of_scar(model: &Model, wear: impl Fn(usize) -> f64) -> Option<(usize, f64)> {
    let t = model.grid.squares();
    if model.setup.method != AbelMethod::Product {
        return None;
    }
    let last = (1..t.len()).rev().find(|&j| wear(j) > 0.0)?;
    let Some(&next) = t.get(last + 1) else {
        return Some((last, t[last]));
    };
    if wear(0) <= 0.0 {
        return None;
    }
    let falls = (wear(last - 1) - wear(last)) / (t[last] - t[last - 1]);
    let is_falling = falls > 0.0;
    let end = if is_falling {
        t[last] + wear(last) / falls
    } else {
        next
    };
    Some((last, end.min(next)))
}

/// The volume of the worn depth (m) of a scar, m³.
pub(super) fn scar_volume(model: &Model, wear: &[f64]) -> f64 {
    let t = model.grid.squares();
    let tail = end_of_scar(model, |j| wear[j]).map_or(0.0, |(last, end)| {
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
