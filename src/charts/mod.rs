//! The charts of a run, one per file. Each declares its name, what it needs, its explanation and how it is made; the
//! terminal, the paper figures, the cursor line and the help all read this declaration.

use crate::plot::step::Step;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Mark};
use crate::reading::{Column, Curves};
use crate::scenario::Refusal;
use crate::studies::ghost::Ghost;
use crate::studies::theory::Theory;
use crate::traces::{Axes, Table};

pub mod condition;
pub mod cost;
pub mod depth;
pub mod field;
pub mod fretting_log;
pub mod fretting_loop;
pub mod ghosts;
pub mod profile;
pub mod radii;
pub mod rate;
pub mod residual;
pub mod run;
pub mod scar_depth;
pub mod scar_growth;
mod simulated;
pub mod springs;
pub mod stresses;
pub mod study;
mod view;
pub mod volume;

pub use run::Run;
pub use view::{Live, Medium, View};

/// Symbols with their meaning, for a reader who knows only Hertz.
pub type Symbols = &'static [(&'static str, &'static str)];

/// The contact radius, explained.
pub const A: (&str, &str) = ("a", "contact radius: the bodies touch inside it");
/// The stick radius, explained.
pub const C: (&str, &str) = ("c", "stick radius: nothing slips inside it in a cycle");
/// The displacement of the indenter, explained.
pub const U_X: (&str, &str) = ("u_x", "tangential displacement of the indenter");
const F_X: (&str, &str) = ("F_x", "tangential force (Q in fretting tests)");
const V: (&str, &str) = ("V", "wear volume");
const E_D: (&str, &str) = ("E_d", "energy lost to friction since the start");
const BAND: (&str, &str) = ("band", "stick, slip and open zones along the radius");

/// Messages of charts that have nothing to show.
const NO_MOTION: &str = "no tangential motion in this scenario";
const NO_WEAR: &str = "no wear in this scenario";
const NO_CYCLE: &str = "no cycle is complete yet";
const NO_STATE: &str = "there is no state.csv";
const NO_HISTORY: &str = "there is no history.csv";

/// Makes a chart of a run, or returns why there is nothing to show.
pub type Make = fn(&Run, &View) -> Result<Chart, &'static str>;

/// What happens in a scenario; each needs the one before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Subject {
    /// Two bodies touch.
    #[default]
    Contact,
    /// They move against each other.
    Motion,
    /// They wear.
    Wear,
}

/// Everything about a chart or another panel, except its data.
#[derive(Debug, Clone, Copy)]
pub struct Recipe<M: ?Sized = Make> {
    /// The name on the command line, for charts that a paper can have.
    pub name: &'static str,
    /// The title.
    pub title: &'static str,
    /// Whether a logarithmic ordinate makes sense.
    pub can_be_log: bool,
    /// The curves that it needs.
    pub needs: Curves,
    /// The columns of the history that it shows.
    pub history: &'static [Column],
    /// Whether it needs the stress field inside the half-space.
    pub needs_field: bool,
    /// Whether the range of the abscissa is kept between frames like the ordinate's, so that a loop's axes do not move.
    pub keeps_abscissa: bool,
    /// Whether a few values may lie far above the rest, such as a stress singularity at a border or a slow step.
    pub has_spikes: bool,
    /// Whether it may be redrawn only every second frame: for numbers, which cannot be read ten times a second, for
    /// still pictures, and for curves that grow from cycle to cycle. Charts over r are never calm, so that a and c are
    /// at the same place in all of them.
    pub is_calm: bool,
    /// What must happen for it to show anything.
    pub subject: Subject,
    /// The data of other sources that it shows; the cursor line compares the first.
    pub overlays: &'static [Axes],
    /// The explanation: a few sentences.
    pub text: &'static str,
    /// The symbols in the chart, with their meaning.
    pub symbols: Symbols,
    /// How it is made.
    pub make: M,
}

impl<M> Recipe<M> {
    /// A recipe that is nothing but made.
    pub const fn new(make: M) -> Self {
        Self {
            name: "",
            title: "",
            can_be_log: false,
            needs: Curves::empty(),
            history: &[],
            needs_field: false,
            keeps_abscissa: false,
            has_spikes: false,
            is_calm: false,
            subject: Subject::Contact,
            overlays: &[],
            text: "",
            symbols: &[],
            make,
        }
    }
}

/// The description of a panel, whatever it shows: a chart or a picture.
pub type About = Recipe<dyn Sync>;

impl Recipe {
    /// The chart of a run.
    ///
    /// # Errors
    /// Says why there is nothing to show.
    pub fn chart(&self, run: &Run, view: &View) -> Result<Chart, &'static str> {
        let mut chart = (self.make)(run, view)?;
        chart.y.scale = view.scale;
        if chart.title.is_empty() {
            chart.title = self.title.to_owned();
        }
        if run.geometry.is_line() {
            let named = |name: &str| run.geometry.term(name);
            chart.title = named(&chart.title);
            for axis in [&mut chart.x, &mut chart.y] {
                axis.label = named(&axis.label).into();
            }
            for curve in &mut chart.curves {
                curve.name = named(&curve.name);
            }
        }
        chart.curves.sort_by_key(|curve| match curve.role {
            // On paper, curves of other sources lie over the run's.
            Role::Ghost(k) if !view.is_on_screen() => k + 1,
            // On a screen, closed forms lie below what they explain.
            _ => usize::from(view.is_on_screen() && !curve.is_theory),
        });
        Ok(chart)
    }

    /// Makes the chart for paper.
    ///
    /// # Errors
    /// If the run has no data for it.
    pub fn on_paper(&self, run: &Run) -> Result<Chart, Refusal> {
        let chart = self.chart(run, &View::default());
        chart.map_err(|why| Refusal::new(format_args!("no chart {}", self.name), why))
    }

    /// Whether the chart has a place for what `ghost` holds.
    pub fn shows(&self, ghost: &Ghost) -> bool {
        let mut overlays = self.overlays.iter();
        overlays.any(|axes| ghost.trace(*axes).is_some())
    }
}

/// All charts, in the order of lists.
pub static ALL: &[&Recipe] = &[
    &profile::RECIPE,
    &stresses::RECIPE,
    &fretting_loop::RECIPE,
    &radii::RECIPE,
    &springs::RECIPE,
    &depth::RECIPE,
    &volume::RECIPE,
    &rate::RECIPE,
    &residual::RECIPE,
    &cost::RECIPE,
    &fretting_log::RECIPE,
    &condition::RECIPE,
    &scar_depth::RECIPE,
    &scar_growth::RECIPE,
    &field::VON_MISES,
    &field::PRINCIPAL,
    &field::SWT,
];

/// Returns the charts that a paper can have.
pub fn on_paper() -> impl Iterator<Item = &'static Recipe> {
    let all = ALL.iter().copied();
    all.filter(|recipe| !recipe.name.is_empty())
}

/// Returns the columns of the history that `charts` show, after the cycle; each once.
pub fn history_columns(charts: impl IntoIterator<Item = &'static Recipe>) -> Vec<Column> {
    let mut columns = vec![Column::Cycle];
    for column in charts.into_iter().flat_map(|chart| chart.history) {
        if !columns.contains(column) {
            columns.push(*column);
        }
    }
    columns
}

/// Default charts; those without data are skipped.
pub static USUAL: [&Recipe; 4] = [
    &profile::RECIPE,
    &springs::RECIPE,
    &stresses::RECIPE,
    &fretting_loop::RECIPE,
];

/// Returns an empty chart over the radius, with marks at a and c on a screen. The ordinate is given as label and unit.
fn over_r(
    view: &View,
    abscissa: &'static str,
    (label, unit): (&'static str, &'static str),
) -> Chart {
    Chart {
        marks: view.live().map(Live::edge_marks).unwrap_or_default(),
        ..Chart::new("", Axis::new(abscissa, "m"), Axis::new(label, unit))
    }
}

/// Returns a column over the radius, one curve per state; a single state is called `alone`, several by their cycles.
fn of_states(run: &Run, column: Column, alone: &str, role: Role) -> Vec<Curve> {
    let count = run.states.len();
    let states = run.states.iter().enumerate();
    let curves = states.filter_map(|(k, state)| {
        let (radii, values) = (state.column(Column::Radius)?, state.column(column)?);
        let (name, role) = state_name(k, count, state.cycle(), (alone, role));
        Some(Curve::new(name, radii, values, role))
    });
    curves.collect()
}

/// Returns the name and the role of the `k`th of `count` states, which ends at `cycle`; a single state gets `alone`.
fn state_name(k: usize, count: usize, cycle: f64, alone: (&str, Role)) -> (String, Role) {
    match count {
        1 => (alone.0.to_owned(), alone.1),
        // The last state always has the same, darkest ink, whatever the number of states.
        _ => (format!("{cycle} cycles"), Role::Series(count - 1 - k)),
    }
}

/// Returns the limiting profile at this depth, at which wear ends: its worn depth, or the worn depth magnified by
/// `times` on top of the unworn profile.
fn limit(run: &Run, theory: Option<&Theory>, times: Option<f64>) -> Option<Curve> {
    let state = run.states.last()?;
    let (radii, unworn) = (state.column(Column::Radius)?, state.column(Column::Unworn)?);
    let limit = theory?.limiting_profile(radii)?;
    let worn = limit.iter().zip(unworn);
    let worn = worn.map(|(f, f0)| match times {
        None => f - f0,
        Some(1.0) => *f,
        Some(times) => f0 + times * (f - f0),
    });
    let curve = Curve::new("limit", radii, worn.collect::<Vec<_>>(), Role::Limit);
    Some(curve.theory().magnified(times.unwrap_or(1.0), limit))
}

/// Returns an empty chart over cycles. On a screen its axis grows through 10, 20, 50, 100, … to the planned end.
fn over_cycles(run: &Run, view: &View, y: Axis) -> Chart {
    let mut cycles = Axis::new("cycles", "");
    cycles.bounds = cycles_shown(run, view);
    Chart::new("", cycles, y)
}

/// A column of the history over its cycles.
fn series(
    run: &Run,
    view: &View,
    column: Column,
    name: &str,
    role: Role,
) -> Result<Curve, &'static str> {
    let columns = view.over_cycles(run, [Column::Cycle, column]);
    let [cycles, values] = columns.ok_or(NO_HISTORY)?;
    Ok(Curve::new(name, cycles, values, role))
}

/// A column of the history over its finished cycles: the unfinished one only if there is no other.
fn finished_series(
    run: &Run,
    view: &View,
    column: Column,
    role: Role,
) -> Result<Curve, &'static str> {
    let mut curve = series(run, view, column, "", role)?;
    let is_open = view.live().is_some_and(|live| live.is_within_a_cycle);
    if is_open && curve.xs.len() > 1 {
        curve.xs.pop();
        curve.ys.pop();
    }
    Ok(curve)
}

/// Returns the range of cycles on a live chart: well filled by the cycles so far, and seldom changed.
fn cycles_shown(run: &Run, view: &View) -> Option<[f64; 2]> {
    let live = view.live()?;
    let seen = run.history.as_deref().and_then(Table::last_cycle);
    let of_ghosts = run.ghosts.iter().map(|ghost| ghost.end());
    let seen = of_ghosts.fold(seen.unwrap_or(0.0), f64::max);
    let planned = live.planned_cycles().filter(|planned| seen <= *planned);
    let grown = Step::above(seen.max(10.0) * (1.0 - 1e-6)).value();
    Some([
        0.0,
        planned.map_or(grown, |planned| grown.min(round_end(planned))),
    ])
}

/// Returns the magnification 1, 2, 5, 10, … (at most a million) at which a depth of at most `deepest` takes no more
/// than `height`.
pub fn magnification(deepest: f64, height: f64) -> f64 {
    if deepest <= 0.0 || deepest.is_nan() {
        return 1.0;
    }
    Step::at_most((height / deepest).clamp(1.0, 1e6)).value()
}

/// Returns the next round number of cycles from `end` up, at least one. An axis that ended at the present moment would
/// compress the whole past in every frame.
pub fn round_end(end: f64) -> f64 {
    const ROUND: [f64; 11] = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    let decade = 10f64.powf(end.max(1.0).log10().floor());
    ROUND
        .into_iter()
        .map(|round| round * decade)
        // Fractions of a cycle are not round.
        .filter(|round| round.fract() == 0.0)
        .find(|round| end <= round * (1.0 + 1e-9))
        .unwrap_or(10.0 * decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wear_thinner_than_a_line_is_magnified_by_1_2_5() {
        for (deepest, times) in [
            (0.0, 1.0),
            (f64::NAN, 1.0),
            (1.0, 1.0),
            (0.3, 1.0),
            (0.17, 2.0),
            (0.06, 5.0),
            (3e-3, 100.0),
            (1e-12, 1e6),
        ] {
            assert_eq!(magnification(deepest, 0.35), times, "{deepest}");
        }
    }

    #[test]
    fn an_axis_of_cycles_ends_at_a_round_number() {
        for (end, expected) in [
            (0.0, 1.0),
            (1.0, 1.0),
            (1.01, 2.0),
            (2.5, 3.0),
            (6.5, 8.0),
            (9.0, 10.0),
            (10.5, 12.0),
            (24.0, 25.0),
            (99.0, 100.0),
            (199.24, 200.0),
            (8.1e5, 1e6),
        ] {
            assert_eq!(round_end(end), expected, "{end}");
        }
    }
}
