//! Builds grid and integrator from the keys of a scenario.

use super::{Faults, Spec, shape};
use crate::contact::indenter::Indenter;
use crate::math::abel::{AbelMethod, MOST_DENSE_CELLS};
use crate::math::grid::RadialGrid;
use crate::scenario::spec::{GeometryWord, Passage};
use crate::scenario::value::Value;
use crate::simulation::{Integrator, Spacing};

/// Builds the grid, which ends at `domain` (m).
pub(super) fn grid(
    spec: &Spec,
    faults: &mut Faults,
    method: AbelMethod,
    indenter: &Indenter,
    domain: Option<f64>,
) -> Option<RadialGrid> {
    let numerics = &spec.numerics;
    let points = spec.or_usual(|of| of.numerics.points);
    let points = faults.need("numerics.points", points)?;
    let (most, what) = match spec.indenter.geometry {
        Some(GeometryWord::Line) => (MOST_DENSE_CELLS, "geometry = \"line\"".to_owned()),
        _ => (method.most_cells(), format!("method = \"{method}\"")),
    };
    if points > most {
        let rule = format!("must be at most {most} with {what}, which has no fast algorithm");
        return faults.refuse(spec, "numerics.points", rule);
    }
    if indenter.rim().is_some() && numerics.domain_radius.is_some() {
        let shape = indenter.name();
        let rule = format!("conflicts with shape = \"{shape}\", whose rim is the domain's edge");
        return faults.refuse(spec, "numerics.domain_radius", rule);
    }
    let Some(radius) = domain else {
        let too_large = "no contact can carry this force; must be smaller";
        return faults.refuse(spec, "motion.normal.mean", too_large);
    };
    if let Indenter::Table(measured) = indenter {
        shape::check_measured(spec, faults, measured, radius)?;
    }
    if indenter.tip_radius() >= radius {
        let edge = Value::Number(radius).literal();
        let rule = format!("must be less than the domain's edge, {edge} m");
        return faults.refuse(spec, "indenter.tip_radius", rule);
    }
    let grid = match &numerics.nodes {
        None => RadialGrid::uniform(points, radius),
        Some(nodes) if nodes.len() == points + 1 => RadialGrid::restored(nodes.clone(), None),
        Some(nodes) => {
            let (wanted, given) = (points + 1, nodes.len());
            let rule = format!("must be {wanted} numbers, one more than points, not {given}");
            return faults.refuse(spec, "numerics.nodes", rule);
        }
    };
    faults.accept(spec, "numerics", grid)
}

/// Returns the spacing of the nodes; a list of nodes takes precedence.
pub(super) fn spacing(spec: &Spec, faults: &mut Faults, default: Spacing) -> Option<Spacing> {
    let has_nodes = spec.numerics.nodes.is_some();
    let default = if has_nodes { Spacing::Given } else { default };
    let named = spec.numerics.grid.unwrap_or(default);
    let rule = match (named, has_nodes) {
        (Spacing::Given, false) => {
            "needs numerics.nodes, the list that a run with numerics.accuracy writes"
        }
        (Spacing::Graded | Spacing::Uniform, true) => {
            "conflicts with numerics.nodes; give one of them"
        }
        _ => return Some(named),
    };
    faults.refuse(spec, "numerics.grid", rule)
}

/// Returns how cycles are gone through.
pub(super) fn integrator(spec: &Spec, faults: &mut Faults) -> Option<Integrator> {
    if spec.numerics.integrator != Some(Passage::CycleJump) {
        return Some(Integrator::Direct);
    }
    let tolerance = spec.or_usual(|of| of.numerics.tolerance);
    let tolerance = faults.need("numerics.tolerance", tolerance)?;
    Some(Integrator::CycleJump { tolerance })
}
