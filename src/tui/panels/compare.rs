//! Two runs in lockstep from one state: both profiles, both pressures, and the difference below. Ghosts are drawn over
//! each plot; in the difference, by how much they differ from this run.

use ratatui::layout::Constraint::{Fill, Length};
use ratatui::layout::{Layout, Rect};

use super::spread_top;
use crate::charts::{A, C, Live, Recipe, ghosts};
use crate::math::scan::rms;
use crate::plot::theme::Role;
use crate::plot::units::{format_number, format_value};
use crate::plot::{Axis, Chart, Curve, Scale, nice_bounds};
use crate::reading::Moment;
use crate::traces::Axes;
use crate::tui::beside::{Comparison, name_of};
use crate::tui::canvas::Canvas;
use crate::tui::frame::Frame;

/// Minimum width of a column of numbers, in cells.
const COLUMN: usize = 11;

/// Minimum width of the difference, in cells; a narrower one is not drawn.
const NARROWEST: u16 = 17;

/// The title of the difference.
const DIFFERENCE: &str = "difference of f";

/// The explanation of a comparison, which takes the place of all panels.
pub static RECIPE: Recipe<()> = Recipe {
    title: "comparison",
    text: "Two methods run side by side from one state: both profiles, both pressures, and below them the size \
           of the difference of the profiles, which is logarithmic. m and M change the second method, C begins \
           at the start of the scenario, c ends the comparison.",
    symbols: &[A, C, ("side by side", "the same numbers of both runs")],
    ..Recipe::new(())
};

/// Draws the comparison over the whole area of the panels, with a cursor at a radius, m, if there is one.
pub fn draw(frame: &Frame, comparison: &Comparison, cursor: Option<f64>, mut canvas: Canvas) {
    let parts = Layout::vertical([Fill(3), Fill(2)]);
    let [top, bottom] = parts.areas(canvas.area);
    let halves = Layout::horizontal([Fill(1); 2]);
    let [left, right] = halves.spacing(1).areas(top);
    let (seen, other) = (&frame.observation, &comparison.observation);
    let run = &frame.run;
    // The worn depth of the second run and of ghosts, minus the worn depth of this run.
    let mut differences = ghosts::worn(run, None);
    differences.push(Curve::new("", other.radii(), other.wear(), Role::Slip));
    for curve in &mut differences {
        let points = curve.xs.iter().zip(&mut curve.ys);
        points.for_each(|(&r, worn)| *worn = (*worn - seen.worn_depth_at(r)).abs());
        curve.errors.clear();
    }
    let names = [seen, other].map(|seen| name_of(seen.method, &seen.grid));
    let difference = &differences[differences.len() - 1].ys;
    let rows = rows(frame, comparison, &names, difference);
    let cells = rows.iter().flat_map(|(_, cells)| cells);
    let widths = cells.map(|cell| cell.chars().count());
    let column = widths.fold(COLUMN, usize::max);
    // The numbers must not be cut; the difference gets the rest, if it is wide enough.
    let table = 17 + 2 * column as u16;
    let left_over = bottom.width.saturating_sub(table + 1);
    let columns = Layout::horizontal([Fill(1), Length(table)]);
    let [below, numbers] = match left_over < NARROWEST {
        true => [Rect::ZERO, bottom],
        false => columns.spacing(1).areas(bottom),
    };
    let mut render = |chart: &Chart, place| canvas.at(place).plot(chart, Role::Title, cursor);
    let pair = |there: &[f64], here: &[f64], role| {
        [
            Curve::new(&*names[0], seen.radii(), here, role),
            Curve::new(&*names[1], other.radii(), there, Role::Slip).dashed(),
        ]
    };
    let mut profiles = Chart::new("3D profile", Axis::new("r", "m"), Axis::new("f", "m"))
        .curves(ghosts::worn(run, Some(1.0)))
        .curves(pair(other.profile(), seen.profile(), Role::Profile));
    profiles.marks = run.live.as_ref().map(Live::edge_marks).unwrap_or_default();
    render(&profiles, left);
    let pair_of_pressures = pair(other.pressure(), seen.pressure(), Role::Pressure);
    let highest = pair_of_pressures.iter().map(spread_top).fold(0.0, f64::max);
    let mut ordinate = Axis::new("p", "Pa");
    ordinate.bounds = (highest > 0.0).then(|| nice_bounds(0.0, highest));
    let pressures = Chart::new("pressure", Axis::new("r", "m"), ordinate)
        .curves(ghosts::on(run, Axes::PRESSURE))
        .curves(pair_of_pressures);
    render(&pressures, right);
    let highest = differences.iter().map(Curve::highest).fold(0.0, f64::max);
    // Interpolation exactly at the nodes leaves rounding errors.
    let deepest = seen.wear().iter().copied().fold(0.0, f64::max);
    if highest <= 1e-12 * deepest {
        let mut canvas = canvas.at(below);
        let mut inside = canvas.titled(DIFFERENCE, Role::Title);
        inside.say("equal so far\nC: from the start", Role::Quiet);
    } else {
        // Six decades: anything smaller is rounding error.
        let decade = highest.log10().ceil();
        let bounds = [10f64.powf(decade - 6.0), 10f64.powf(decade)];
        let ordinate = Axis::new("|difference|", "m").scale(Scale::Log);
        let abscissa = Axis::new("r", "m").bounds([0.0, run.edge()]);
        let ordinate = ordinate.bounds(bounds);
        let chart = Chart::new(DIFFERENCE, abscissa, ordinate).curves(differences);
        render(&chart, below);
    }
    let mut canvas = canvas.at(numbers);
    let mut inside = canvas.titled("side by side", Role::Title);
    let lines = rows
        .iter()
        .map(|(name, [here, there])| format!("{name:14} {here:>column$} {there:>column$}"));
    let lines: Vec<String> = lines.chain(comparison.stopped.clone()).collect();
    inside.say(&lines.join("\n"), Role::Quiet);
}

/// Returns the numbers of both runs: a name and two values per row.
fn rows(
    frame: &Frame,
    comparison: &Comparison,
    names: &[String; 2],
    difference: &[f64],
) -> [(&'static str, [String; 2]); 7] {
    let moments = [&frame.observation.moment, &comparison.observation.moment];
    let value = |value: Option<f64>, unit| Some(format_value(value?, unit, 4));
    let both = |of: fn(&Moment) -> Option<f64>, unit| moments.map(|at| value(of(at), unit));
    let residual = |moment: &Moment| Some(format_number(moment.energy_residual?, 2));
    let costs = [frame.step_cost, comparison.step_cost];
    let rms = value(Some(rms(difference)), "m");
    let rows = [
        ("", names.clone().map(Some)),
        ("stick c", both(|moment| moment.permanent_stick_radius, "m")),
        ("contact a", both(|moment| Some(moment.contact_radius), "m")),
        ("wear volume", both(|moment| Some(moment.wear_volume), "m³")),
        ("1 - V/(k E_d)", moments.map(residual)),
        ("time per step", costs.map(|cost| value(cost, "s"))),
        ("rms difference", [rms, Some(String::new())]),
    ];
    let cell = |value: Option<String>| value.unwrap_or_else(|| "-".into());
    rows.map(|(name, values)| (name, values.map(cell)))
}
