//! Builds the indenter from the keys of a scenario, and checks a measured one against the domain.

use super::{HARDLY_SAME, INDENTER, Noted, Parts};
use crate::contact::indenter::Indenter;
use crate::contact::measured::MeasuredProfile;
use crate::scenario::schema::{self, Parameter};
use crate::scenario::spec::Shape;
use crate::scenario::values::length;

/// Allowed slopes a/R of a table at the contact's edge: beyond the steepest and the shallowest, one of its columns is
/// in another unit.
const STEEPEST: f64 = 1.0;
const SHALLOWEST: f64 = 1e-5;

/// Minimum number of points of a table within the domain.
const FEWEST_IN_CONTACT: usize = 4;

impl Parts<'_> {
    /// Builds the unworn shape.
    pub(super) fn indenter(&self) -> Result<Indenter, Noted> {
        let (at, given) = (self.at(INDENTER), &self.spec.indenter);
        let shape = at.need("shape", given.shape)?;
        self.refuse_keys_of_other_shapes(shape.into())?;
        let radius = || at.need("radius", given.radius);
        let angle = || at.need("angle", given.angle);
        let tip = || at.need("tip_radius", given.tip_radius);
        match shape {
            Shape::Paraboloid => Indenter::paraboloid(radius()?),
            Shape::Cone => Indenter::cone(angle()?),
            Shape::Power => {
                let coefficient = at.need("coefficient", given.coefficient);
                let exponent = at.need("exponent", given.exponent);
                Indenter::power(coefficient?, exponent?)
            }
            Shape::FlatPunch => Indenter::flat_punch(radius()?),
            Shape::TruncatedParaboloid => {
                let (radius, tip) = (radius(), tip());
                Indenter::truncated_paraboloid(radius?, tip?)
            }
            Shape::TruncatedCone => {
                let (angle, tip) = (angle(), tip());
                Indenter::truncated_cone(angle?, tip?)
            }
            Shape::RoundedPunch => {
                let (radius, tip) = (radius(), tip());
                Indenter::rounded_punch(radius?, tip?)
            }
            Shape::Table => {
                let radii = at.need_list("radii", &given.radii, "file");
                let heights = at.need_list("heights", &given.heights, "file");
                let smoothing = given.smoothing.or(self.usual.indenter.smoothing);
                let smoothing = at.need("smoothing", smoothing);
                Indenter::table(radii?, heights?, smoothing?)
            }
        }
        .map_err(|invalid| at.refused(invalid))
    }

    fn refuse_keys_of_other_shapes(&self, shape: &str) -> Result<(), Noted> {
        let is_foreign = |key: &&Parameter| self.spec.get(key).is_some() && !key.belongs_to(shape);
        let Some(foreign) = schema::parameters().find(is_foreign) else {
            return Ok(());
        };
        let takes = schema::parameters().filter(|key| key.shapes.contains(&shape));
        let takes: Vec<&str> = takes.map(Parameter::key).collect();
        let rule = format!(
            "shape = \"{shape}\" has no such key; it takes {}",
            takes.join(", ")
        );
        Err(self.at(INDENTER).refuse(foreign.key(), rule))
    }

    /// Refuses a table that ends inside the domain, has hardly a point in the contact, or has slopes too steep for a
    /// half-space: most often because its lengths are in another unit.
    pub(super) fn check_measured(
        &self,
        measured: &MeasuredProfile,
        domain: f64,
    ) -> Result<(), Noted> {
        let last = measured.last_radius();
        let points = measured.points_within(domain);
        let slope = 2.0 * measured.profile(domain.min(last)) / domain.min(last);
        let unit = "are r and f in m? columns r_mm and f_um are converted";
        let [edge, end] = [domain, last].map(length);
        let rule = if slope > STEEPEST {
            format!("a/R = {slope:.1e} at the contact's edge, where slopes must be small: {unit}")
        } else if domain > last {
            let hint = if domain > HARDLY_SAME * last || slope < SHALLOWEST {
                format!(": {unit}")
            } else {
                "; a longer trace, or a smaller depth".into()
            };
            format!("the table ends at r = {end} m, but the contact can reach {edge} m{hint}")
        } else if points < FEWEST_IN_CONTACT || slope < SHALLOWEST {
            format!(
                "only {points} points lie within {edge} m, where contact is possible, \
                 and a/R is {slope:.1e}: {unit}"
            )
        } else {
            return Ok(());
        };
        Err(self.at(INDENTER).refuse("radii", rule))
    }
}
