//! Turns a [`Spec`] into parts that can be run. The table of keys and the parts' constructors check the values; these
//! modules note where in the scenario a refused value is.
//!
//! Each section of a scenario has its own file. A function returns `None` if it has noted an error; parts that do not
//! depend on each other are all made before the first that failed ends it, so that all errors are noted at once.

use super::error::Refusal;
use super::fault::Faults;
use super::spec::{NORMAL, Spec, TANGENTIAL};
use crate::contact::scar::Scar;
use crate::simulation::{Setup, Unworn};

mod bodies;
mod derive;
mod line;
mod motion;
mod numerics;
mod running_in;
mod scar;
mod shape;
mod wear;

pub use derive::choices;

/// Ratio beyond which a length is probably in the wrong unit.
const HARDLY_SAME: f64 = 20.0;

/// Makes the parts that have all their keys.
impl TryFrom<&Spec> for Setup {
    type Error = Refusal;

    fn try_from(spec: &Spec) -> Result<Self, Refusal> {
        let mut faults = Faults::new("scenario");
        let setup = setup(spec, &mut faults);
        faults.result(setup)
    }
}

/// Makes the parts of a scenario.
pub(super) fn setup(spec: &Spec, faults: &mut Faults) -> Option<Setup> {
    let (indenter, drive) = (shape::indenter(spec, faults), motion::drive(spec, faults));
    let (material, k) = (
        bodies::material(spec, faults),
        wear::coefficient(spec, faults),
    );
    let (running_in, scar) = (
        running_in::running_in(spec, faults),
        scar::scar(spec, faults),
    );
    let indenter = indenter?;
    let geometry = line::geometry(spec, faults, &indenter)?;
    let (drive, material) = line::in_plane(spec, faults, geometry, &indenter, (drive?, material?))?;
    let contact = Unworn {
        geometry,
        indenter: &indenter,
        material: &material,
        drive: &drive,
    };
    let wear = match &spec.wear {
        Some(given) => Some(wear::law(spec, faults, given, k?, &contact)?),
        None => None,
    };
    let (running_in, scar) = (running_in?, scar?);
    let domain = spec.numerics.domain_radius.or_else(|| {
        let runs_in = running_in.as_ref().is_some_and(|of| of.friction.is_some());
        contact.domain_radius(!runs_in, scar.as_ref().map_or(0.0, Scar::deepest))
    });
    let method = faults.need("numerics.method", spec.numerics.method)?;
    let grid = numerics::grid(spec, faults, method, &indenter, domain)?;
    line::check_gauge(spec, faults, &drive, grid.radius())?;
    if let Some(scar) = &scar {
        scar::check(spec, faults, scar, &indenter, grid.radius())?;
    }
    let (spacing, scheme) = choices(method);
    let steps = spec.or_usual(|of| of.numerics.steps_per_cycle);
    Some(Setup {
        scar,
        grid,
        geometry,
        hardness: bodies::hardness(&spec.material),
        material,
        indenter,
        drive,
        wear,
        running_in,
        method,
        spacing: numerics::spacing(spec, faults, spacing)?,
        scheme: spec.numerics.scheme.unwrap_or(scheme),
        stability: faults.need("numerics.stability", spec.numerics.stability)?,
        steps_per_cycle: faults.need("numerics.steps_per_cycle", steps)?,
        integrator: numerics::integrator(spec, faults)?,
    })
}
