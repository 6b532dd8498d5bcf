//! Builds the indenter from the keys of a scenario, and checks a measured one against the domain.

use super::{HARDLY_SAME, Parts};
use crate::contact::indenter::Indenter;
use crate::contact::measured::MeasuredProfile;
use crate::scenario::check::length;
use crate::scenario::error::Refusal;
use crate::scenario::schema::{self, Parameter};
use crate::scenario::values::join;

/// Allowed slopes a/R of a table at the contact's edge: beyond the steepest and the shallowest, one of its columns is
/// in another unit.
const STEEPEST: f64 = 1.0;
const SHALLOWEST: f64 = 1e-5;

/// Minimum number of points of a table within the domain.
const FEWEST_IN_CONTACT: usize = 4;

impl Parts<'_> {
    /// Builds the unworn shape.
    pub(super) fn indenter(&self) -> Result<Indenter, Refusal> {
        let shape: String = self.require("indenter.shape")?;
        self.refuse_keys_of_other_shapes(&shape)?;
        let of = |key: &str| self.require::<f64>(&join("indenter", key));
        match shape.as_str() {
            "cone" => Indenter::cone(of("angle")?),
            "power" => Indenter::power(of("coefficient")?, of("exponent")?),
            "flat-punch" => Indenter::flat_punch(of("radius")?),
            "truncated-paraboloid" => {
                Indenter::truncated_paraboloid(of("radius")?, of("tip_radius")?)
            }
            "truncated-cone" => Indenter::truncated_cone(of("angle")?, of("tip_radius")?),
            "rounded-punch" => Indenter::rounded_punch(of("radius")?, of("tip_radius")?),
            "table" => {
                let list = |key| self.list(key, "indenter.file");
                let (radii, heights) = (list("indenter.radii")?, list("indenter.heights")?);
                Indenter::table(&radii, &heights, of("smoothing")?)
            }
            _ => Indenter::paraboloid(of("radius")?),
        }
        .map_err(self.refused("indenter"))
    }

    fn refuse_keys_of_other_shapes(&self, shape: &str) -> Result<(), Refusal> {
        let is_foreign = |key: &&Parameter| self.has(key.path) && !key.belongs_to(shape);
        let Some(foreign) = schema::parameters().find(is_foreign) else {
            return Ok(());
        };
        let takes = schema::parameters().filter(|key| key.shapes.contains(&shape));
        let takes: Vec<&str> = takes.map(Parameter::key).collect();
        let rule = format!(
            "shape = \"{shape}\" has no such key; it takes {}",
            takes.join(", ")
        );
        Err(self.refuse(foreign.path, rule))
    }

    /// Refuses a table that ends inside the domain, has hardly a point in the contact, or has slopes too steep for a
    /// half-space: most often because its lengths are in another unit.
    pub(super) fn check_measured(
        &self,
        measured: &MeasuredProfile,
        domain: f64,
    ) -> Result<(), Refusal> {
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
        Err(self.refuse("indenter.radii", rule))
    }
}
