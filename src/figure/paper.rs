//! The figures of Li, Forsbach & Benad (2019), computed at the same points.

use super::Sheet;
use crate::charts::{Run, profile, springs, stresses};
use crate::math::abel::AbelMethod;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Scale};
use crate::scenario::Refusal;
use crate::simulation::Breakdown;
use crate::studies::verify::{Problem, Task};

/// N in the paper's figures.
pub const POINTS: usize = 100;

/// Fig. 2: relative errors of methods A and B on a Hertzian contact, node by node: (a) 1D profile, (b) normal stress,
/// (c) normal deformation.
///
/// # Errors
/// If one of the methods breaks down.
pub fn errors(points: usize) -> Result<Sheet, Breakdown> {
    let titles = ["1D profile", "normal stress", "normal deformation"];
    let mut charts = titles.map(|title| {
        let y = Axis::new("relative error", "").scale(Scale::Log);
        Chart::new(title, Axis::new("r/a", "").bounds([0.0, 1.0]), y)
    });
    for (k, method) in [AbelMethod::A, AbelMethod::B].into_iter().enumerate() {
        let task = Task {
            problem: Problem::Hertz,
            method,
            points,
        };
        for (chart, errors) in charts.iter_mut().zip(task.run().errors?) {
            let name = format!("method {}", method.name().to_uppercase());
            let curve = Curve::new(name, errors.radii, errors.errors, Role::Series(k));
            chart.curves.push(curve.dashed_if(k > 0));
        }
    }
    let facts = [
        ("problem", "Hertz"),
        ("methods", "a, b"),
        ("points", &points.to_string()),
        ("error", "|result - theory|/theory at every node"),
    ];
    Ok(Sheet {
        title: "Errors on a Hertzian contact (Fig. 2 of Li, Forsbach & Benad 2019)".into(),
        facts: facts.map(|(key, value)| (key.into(), value.into())).into(),
        charts: charts.into(),
    })
}

/// Fig. 3: (a) 3D profiles and (b) 1D profiles of all states, stresses of (c) the first and (d) the last.
///
/// # Errors
/// If the run lacks the data for it.
pub fn fretting(run: &Run) -> Result<Sheet, Refusal> {
    let mut charts = vec![
        profile::RECIPE.on_paper(run)?,
        springs::RECIPE.on_paper(run)?,
    ];
    // Without states, the other charts are left out.
    let ends = [run.states.first(), run.states.last()];
    for state in ends.into_iter().flatten() {
        let one = Run {
            states: vec![state.clone()],
            ..Run::default()
        };
        charts.push(Chart {
            title: format!("stresses at {} cycles", state.cycle()),
            ..stresses::RECIPE.on_paper(&one)?
        });
    }
    Ok(Sheet {
        title: "Fretting wear (Fig. 3 of Li, Forsbach & Benad 2019)".into(),
        facts: run.facts(),
        charts,
    })
}
