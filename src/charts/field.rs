//! The stresses inside the half-space in the plane of motion, as colours.

use super::{Recipe, View};
use crate::charts::run::Run;
use crate::plot::colormap::ColorMap;
use crate::plot::{Axis, Chart, Map};
use crate::reading::Column;

const NO_FIELD: &str = "there is no field.csv; run --field writes it";

/// The von Mises stress.
pub static VON_MISES: Recipe = Recipe {
    name: "von-mises",
    title: "von Mises stress",
    needs_field: true,
    ..Recipe::new(|run, _: &View| map(run, Column::VonMises, ColorMap::Sequential))
};

/// The largest principal stress.
pub static PRINCIPAL: Recipe = Recipe {
    name: "principal",
    title: "largest principal stress",
    needs_field: true,
    ..Recipe::new(|run, _: &View| map(run, Column::MaxPrincipal, ColorMap::Diverging))
};

/// The Smith–Watson–Topper parameter over a cycle.
pub static SWT: Recipe = Recipe {
    name: "swt",
    title: "Smith-Watson-Topper stress of a cycle",
    needs_field: true,
    ..Recipe::new(|run, _: &View| map(run, Column::Swt, ColorMap::Sequential))
};

fn map(run: &Run, column: Column, colors: ColorMap) -> Result<Chart, &'static str> {
    let table = run.field.as_ref();
    let columns = |wanted| table?.column(wanted);
    let made = columns(Column::X)
        .zip(columns(Column::Z))
        .zip(columns(column));
    let ((all_x, all_z), values) = made.ok_or(NO_FIELD)?;
    let count = all_z.iter().take_while(|&&z| z == all_z[0]).count();
    let xs = all_x[..count].to_vec();
    let zs: Vec<f64> = all_z.iter().step_by(count.max(1)).copied().collect();
    if xs.len() < 2 || zs.len() < 2 || xs.len() * zs.len() != all_x.len() {
        return Err(NO_FIELD);
    }
    let mut depth = Axis::new("z", "m");
    depth.downwards = true;
    let mut chart = Chart::new("", Axis::new("x", "m"), depth);
    chart.map = Some(Map {
        quantity: Axis::new(column.symbol(), column.unit()),
        places: [xs, zs],
        values: values.to_vec(),
        colors,
        words: Vec::new(),
    });
    Ok(chart)
}
