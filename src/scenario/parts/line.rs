//! Builds a line contact from the keys of a scenario: its length,
//! its motion, and checks of what a line does not support.

use super::{INDENTER, NORMAL, NUMERICS, Noted, Parts, TANGENTIAL};
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::math::abel::AbelMethod;
use crate::math::geometry::Geometry;
use crate::scenario::spec;
use crate::scenario::values::length;
use crate::simulation::Unworn;
use crate::simulation::drive::{Control, Drive};

/// Default length of a line contact, m: every force and volume is then per metre.
const PER_METRE: f64 = 1.0;

/// Default depth of the reference point for displacements, in unworn half-widths.
const USUAL_GAUGE: f64 = 10.0;

impl Parts<'_> {
    /// Returns the depth of the reference point for displacements, m, if given.
    fn gauge(&self) -> Option<f64> {
        self.spec.motion.tangential.as_ref()?.gauge_length
    }

    /// Builds the geometry: round, or a line of some length.
    ///
    /// # Errors
    ///
    /// If there is a key of the other geometry, a method without a line kernel, or a measured section whose contact
    /// would be more than one strip.
    pub(super) fn geometry(&self, indenter: &Indenter) -> Result<Geometry, Noted> {
        let (at, given) = (self.at(INDENTER), &self.spec.indenter);
        if given.geometry != Some(spec::Geometry::Line) {
            let rule = "needs geometry = \"line\" in [indenter]";
            return match (given.length, self.gauge()) {
                (Some(_), _) => Err(at.refuse("length", rule)),
                (None, Some(_)) => Err(self.at(TANGENTIAL).refuse("gauge_length", rule)),
                (None, None) => Ok(Geometry::Round),
            };
        }
        if self.spec.numerics.method != Some(AbelMethod::Product) {
            let rule = "must be \"product\" with geometry = \"line\": the other methods are of round contacts";
            return Err(self.at(NUMERICS).refuse("method", rule));
        }
        if let Indenter::Table(measured) = indenter {
            let refused = |invalid| at.refused(invalid);
            measured.check_strip().map_err(refused)?;
        }
        let length = given.length.unwrap_or(PER_METRE);
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
        drive: Drive,
        material: Material,
    ) -> Result<(Drive, Material), Noted> {
        if !geometry.is_line() {
            return Ok((drive, material));
        }
        if drive.normal().displacement().is_some() {
            let rule = "a line contact has no depth of indentation, which is infinite in the plane; \
                        give motion.normal.control = \"force\", with mean and amplitude in N";
            return Err(self.at(NORMAL).refuse("control", rule));
        }
        let gauge = self.gauge();
        if gauge.is_none() && matches!(drive.tangential(), Some(Control::Displacement(_))) {
            let meaning = "depth of the point that the displacement of a line contact is told against, m; \
                           or give motion.tangential.control = \"force\"";
            return Err(self.at(TANGENTIAL).missing("gauge_length", meaning));
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
    pub(super) fn check_gauge(&self, drive: &Drive, domain: f64) -> Result<(), Noted> {
        match drive.gauge_length().filter(|&gauge| gauge <= domain) {
            Some(_) if self.gauge().is_some() => {
                let least = length(domain);
                let rule = format!("must be greater than the contact can become wide, {least} m");
                Err(self.at(TANGENTIAL).refuse("gauge_length", rule))
            }
            _ => Ok(()),
        }
    }
}
