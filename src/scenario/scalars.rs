//! Scalars of a session's present moment: the columns of histories and of studies.

use std::cell::OnceCell;

use super::{hint, printable};
use crate::math::number::exact;
use crate::math::scan::largest;
use crate::reading::column::{ColumnKind, columns};
use crate::reading::fatigue::{Limits, StressCycle};
use crate::reading::subsurface::Peak;
use crate::reading::{Column, CycleFigures, Log, Moment, Quantity, Regime, Zone};
use crate::scenario::session::Session;
use crate::simulation::{Simulation, Stats};

/// A scalar's value, or a cell of a table: a number in the unit that its name ends with, a count, a word, or null if it
/// is undefined at this moment.
pub use serde_json::Value;

/// Returns the value as a field of a CSV file: numbers in the shortest form that reads back to the same bits, an empty
/// field for a missing value.
pub fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(word) => word.clone(),
        value if value.is_f64() => exact(value.as_f64().unwrap_or(f64::NAN)),
        other => other.to_string(),
    }
}

/// Returns the word that a number of this kind stands for, if it is one.
fn word(kind: ColumnKind, number: f64) -> Option<&'static str> {
    match kind {
        ColumnKind::Number | ColumnKind::Count => None,
        ColumnKind::Regime => Some(Regime::ALL.get(number as usize)?.name()),
        ColumnKind::Zone => Some(Zone::ALL.get(number as usize)?.name()),
    }
}

/// Returns the number of a column as a value: a count as a whole number, a regime by its name, null if not finite.
pub fn value(column: Column, number: f64) -> Value {
    match column.kind() {
        _ if !number.is_finite() => Value::Null,
        ColumnKind::Number => number.into(),
        ColumnKind::Count => (number as u64).into(),
        kind => word(kind, number).into(),
    }
}

/// Returns the number of a column as a field of a CSV file, empty if NaN.
pub fn text(column: Column, number: f64) -> String {
    let word = word(column.kind(), number).filter(|_| !number.is_nan());
    word.map_or_else(|| exact(number), str::to_owned)
}

/// Reads the number of a column from a field of a file; NaN if it is none.
pub fn parse(column: Column, field: &str) -> f64 {
    match column.kind() {
        ColumnKind::Regime => field
            .parse()
            .map_or(f64::NAN, |regime: Regime| f64::from(regime as u8)),
        _ => field.parse().unwrap_or(f64::NAN),
    }
}

/// Reads scalars at the present moment of a session. Intermediate results that several scalars need are computed once,
/// and the pressure only if a scalar needs it.
#[derive(Debug)]
pub struct Reading<'a> {
    session: &'a Session,
    moment: Moment,
    pressure: OnceCell<Vec<f64>>,
    figures: OnceCell<Option<CycleFigures>>,
    stresses: OnceCell<Option<StressCycle>>,
    swt: OnceCell<Option<Peak>>,
    crossland: OnceCell<Option<Peak>>,
}

/// Makes the reader of all columns from the rows of their table.
macro_rules! make_reader {
    ($at:ident read { $($(#[$doc:meta])* $list:ident { $(
        $column:ident $name:literal $symbol:literal $meaning:literal
        $(as $kind:ident)? $(keeps $merge:ident)? = $read:expr;
    )* })* } other $others:tt) => {
        /// Returns the number of a column; `None` if it is not defined at this moment.
        fn read($at: &Reading<'_>, column: Column) -> Option<f64> {
            Some(match column {
                $($(Column::$column => $read,)*)*
                stated => return $at.stated(stated),
            })
        }
    };
}
columns!(make_reader);

impl<'a> Reading<'a> {
    /// Reads the present moment of `session`.
    pub fn new(session: &'a Session) -> Self {
        Self {
            session,
            moment: session.simulation().moment(),
            pressure: OnceCell::new(),
            figures: OnceCell::new(),
            stresses: OnceCell::new(),
            swt: OnceCell::new(),
            crossland: OnceCell::new(),
        }
    }

    /// Returns the number of a scalar: a regime counts as its place in [`Regime::ALL`]. NaN if it is not defined at this
    /// moment, and for columns that are no scalars.
    pub fn number(&self, scalar: Column) -> f64 {
        read(self, scalar)
            .filter(|number| number.is_finite())
            .unwrap_or(f64::NAN)
    }

    /// Returns the same in its written form.
    pub fn value(&self, scalar: Column) -> Value {
        value(scalar, self.number(scalar))
    }

    fn simulation(&self) -> &Simulation {
        self.session.simulation()
    }

    fn stats(&self) -> Stats {
        self.simulation().stats()
    }

    fn log(&self) -> &Log {
        self.session.log()
    }

    /// Returns p(r), Pa; computed once, by one transform.
    fn pressure(&self) -> &[f64] {
        self.pressure.get_or_init(|| self.simulation().pressure())
    }

    /// Returns the figures of the last complete period; after a jump, a period is stepped for them.
    fn figures(&self) -> Option<&CycleFigures> {
        let figures = self.figures.get_or_init(|| self.session.cycle_figures());
        figures.as_ref()
    }

    /// Returns the loads of a steady-state cycle, which is stepped once.
    fn stresses(&self) -> Option<&StressCycle> {
        let step = || StressCycle::simulate(self.simulation());
        self.stresses.get_or_init(step).as_ref()
    }

    fn limits(&self) -> Option<Limits> {
        let scenario = self.session.scenario();
        Some(Limits {
            tension: scenario.fatigue_limit()?,
            shear: scenario.spec().material.shear_fatigue_limit?,
        })
    }

    /// Finds where the Smith–Watson–Topper parameter is largest.
    fn swt(&self) -> Option<&Peak> {
        let find = || Some(self.stresses()?.largest(|at| at.swt));
        self.swt.get_or_init(find).as_ref()
    }

    fn swt_ratio(&self) -> Option<f64> {
        let limit = self.session.scenario().fatigue_limit()?;
        Some(self.swt()?.value / limit)
    }

    /// Finds where Crossland's parameter is largest.
    fn crossland(&self) -> Option<&Peak> {
        let find = || {
            let limits = self.limits()?;
            Some(self.stresses()?.largest(|at| at.crossland(limits)))
        };
        self.crossland.get_or_init(find).as_ref()
    }

    /// The estimated error that the headers of the run's files state.
    fn stated(&self, error: Column) -> Option<f64> {
        let of = Quantity::ALL.iter().find(|of| of.column() == error)?;
        self.session.errors().get(*of)
    }
}

/// The columns that are scalars, beginning with the columns of `history.csv` in their order.
pub fn all() -> impl Iterator<Item = Column> + Clone {
    let history = Column::HISTORY.into_iter();
    history.chain(Column::FURTHER).chain(Column::ERRORS)
}

/// Finds a scalar by its name.
///
/// # Errors
///
/// In one line, the unknown name with the nearest known one.
pub fn find_scalar(name: &str) -> Result<Column, String> {
    all().find(|scalar| scalar.name() == name).ok_or_else(|| {
        let hint = hint::hint(name, all().map(Column::name));
        format!("unknown column {}; {hint}", printable(name))
    })
}

/// The outermost radius (m) at which the worn depth is at least a thousandth of the largest one.
pub fn scar_radius(simulation: &Simulation) -> Option<f64> {
    let worn = simulation.worn_depth();
    let edge = 1e-3 * largest(worn);
    let outermost = worn.iter().rposition(|&worn| worn >= edge && worn > 0.0)?;
    let nodes = simulation.setup().grid.nodes();
    let Some(next) = nodes.get(outermost + 1) else {
        return Some(nodes[outermost]);
    };
    // Interpolates: the depth crosses the threshold between this node and the next.
    let share = (worn[outermost] - edge) / (worn[outermost] - worn[outermost + 1]);
    Some(nodes[outermost] + share * (next - nodes[outermost]))
}
