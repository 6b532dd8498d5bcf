//! Builds a line contact from the keys of a scenario: its length,
//! its motion, and checks of what a line does not support.

use super::Parts;
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::math::abel::AbelMethod;
use crate::math::geometry::Geometry;
use crate::scenario::check::length;
use crate::scenario::error::Refusal;
use crate::simulation::Unworn;
use crate::simulation::drive::{Control, Drive};

/// Default length of a line contact, m: every force and volume is then per metre.
const PER_METRE: f64 = 1.0;

/// Default depth of the reference point for displacements, in unworn half-widths.
const USUAL_GAUGE: f64 = 10.0;

impl Parts<'_> {
    /// Whether the contact is a line.
    pub(super) fn is_line(&self) -> bool {
        self.get::<String>("indenter.geometry").as_deref() == Some("line")
    }

    /// Builds the geometry: round, or a line of some length.
    ///
    /// # Errors
    ///
    /// If there is a key of the other geometry, a method without a line kernel, or a measured section whose contact
    /// would be more than one strip.
    pub(super) fn geometry(&self, indenter: &Indenter) -> Result<Geometry, Refusal> {
        if !self.is_line() {
            let of_lines = ["indenter.length", "motion.tangential.gauge_length"];
            return match of_lines.iter().find(|key| self.has(key)) {
                Some(key) => Err(self.refuse(key, "needs geometry = \"line\" in [indenter]")),
                None => Ok(Geometry::Round),
            };
        }
        let method: AbelMethod = self.choice("numerics.method")?;
        if method != AbelMethod::Product {
            let rule = "must be \"product\" with geometry = \"line\": the other methods are of round contacts";
            return Err(self.refuse("numerics.method", rule));
        }
        if let Indenter::Table(measured) = indenter {
            let refused = |invalid| self.refused("indenter")(invalid);
            measured.check_strip().map_err(refused)?;
        }
        let length = self.get("indenter.length").unwrap_or(PER_METRE);
        Ok(Geometry::Line { length })
    }

    /// Adapts motion and material to a line contact in plane strain.
    ///
    /// # Errors
    ///
    /// If a displacement of a line contact has no reference point: in plane strain it is infinite.
    pub(super) fn in_plane(
        &self,
        geometry: Geometry,
        indenter: &Indenter,
    ) -> Result<(Drive, Material), Refusal> {
        let (drive, material) = (self.drive()?, self.material()?);
        if !geometry.is_line() {
            return Ok((drive, material));
        }
        if drive.normal().displacement().is_some() {
            let rule = "a line contact has no depth of indentation, which is infinite in the plane; \
                        give motion.normal.control = \"force\", with mean and amplitude in N";
            return Err(self.refuse("motion.normal.control", rule));
        }
        let gauge: Option<f64> = self.get("motion.tangential.gauge_length");
        if gauge.is_none() && matches!(drive.tangential(), Some(Control::Displacement(_))) {
            let meaning = "depth of the point that the displacement of a line contact is told against, m; \
                           or give motion.tangential.control = \"force\"";
            return Err(self.missing("motion.tangential.gauge_length", meaning));
        }
        let material = material.in_plane_strain();
        let unworn = Unworn {
            geometry,
            indenter,
            material: &material,
            drive: &drive,
        };
        let usual = || USUAL_GAUGE * unworn.radius(unworn.deepest());
        let gauge = gauge.unwrap_or_else(usual);
        Ok((drive.in_geometry(geometry, &material, gauge), material))
    }

    /// Refuses a gauge length inside the domain, which ends at `domain` (m).
    pub(super) fn check_gauge(&self, drive: &Drive, domain: f64) -> Result<(), Refusal> {
        let is_given = self.has("motion.tangential.gauge_length");
        match drive.gauge_length().filter(|&gauge| gauge <= domain) {
            Some(_) if is_given => {
                let least = length(domain);
                let rule = format!("must be greater than the contact can become wide, {least} m");
                Err(self.refuse("motion.tangential.gauge_length", rule))
            }
            _ => Ok(()),
        }
    }
}
