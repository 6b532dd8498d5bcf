//! The data of a run, or of another source, as named columns in SI units: over the radius, over cycles, over a loop. A
//! column has the same name in a file, in memory and on an axis.

pub use crate::reading::Table;
use crate::reading::{Column, Recorder};
use crate::scenario::columns::Columns;
use crate::scenario::scalars;

/// Two columns that make a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Axes {
    /// The abscissa's column.
    pub x: Column,
    /// The ordinate's.
    pub y: Column,
}

impl Axes {
    /// f over r.
    pub const PROFILE: Self = Self::new(Column::Radius, Column::Profile);
    /// f − f₀ over r.
    pub const WEAR: Self = Self::new(Column::Radius, Column::Wear);
    /// g over x.
    pub const SPRINGS: Self = Self::new(Column::Radius, Column::Profile1d);
    /// p over r.
    pub const PRESSURE: Self = Self::new(Column::Radius, Column::Pressure);
    /// τ over r.
    pub const SHEAR: Self = Self::new(Column::Radius, Column::Shear);
    /// F_x over u_x, in tables of one cycle.
    pub const LOOP: Self = Self::new(Column::LoopShift, Column::LoopForce);
    /// V over cycles.
    pub const VOLUME: Self = Self::new(Column::Cycle, Column::WearVolume);
    /// The largest f − f₀ over cycles.
    pub const DEPTH: Self = Self::new(Column::Cycle, Column::ScarDepth);
    /// a over cycles.
    pub const CONTACT: Self = Self::new(Column::Cycle, Column::ContactRadius);
    /// The smallest c in each cycle, over cycles.
    pub const STICK: Self = Self::new(Column::Cycle, Column::PermanentStickRadius);

    /// These columns.
    pub const fn new(x: Column, y: Column) -> Self {
        Self { x, y }
    }

    /// Whether the abscissa is the radius.
    pub fn over_r(self) -> bool {
        self.x == Column::Radius
    }
}

impl Table {
    /// The known columns of a file, in SI units; fields that are no numbers become NaN, and regimes their numbers.
    pub fn of_file(file: &Columns) -> Self {
        let regime = Column::Regime;
        let regimes = || {
            file.words(regime.name())
                .map(|word| scalars::parse(regime, word))
        };
        let columns = file.all().into_iter();
        let columns = columns.filter_map(|(name, values)| match Column::find(&name)? {
            column if column == regime => Some((column, regimes().collect())),
            column => Some((column, values)),
        });
        Self::of_columns(file.header.clone(), columns)
    }
}

/// The loop of one cycle.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Loop {
    /// The end of the cycle.
    pub end: f64,
    /// u_x⁽⁰⁾, m.
    pub shifts: Vec<f64>,
    /// F_x, N.
    pub forces: Vec<f64>,
    /// The displacement of the rig's actuator, m; NaN where unknown.
    pub sensed: Vec<f64>,
}

impl Loop {
    /// Minimum number of points of a loop worth showing.
    pub const SHORTEST: usize = 9;

    /// Whether the indenter moves to the right at the loop's end.
    pub fn rises(&self) -> bool {
        !matches!(self.shifts[..], [.., before, now] if before > now)
    }

    /// Reads the cycle that ends at `end`, or all rows, of a table; `None` if the table holds no loop.
    pub fn from_table(table: &Table, end: Option<f64>) -> Option<Self> {
        let cycles = table.column(Column::Cycle)?;
        let pairs = [
            [Column::Shift, Column::TangentialForce],
            [Column::LoopShift, Column::LoopForce],
        ];
        let [shift, force] = pairs.into_iter().find(|pair| table.has(pair))?;
        let within =
            |cycle: f64| end.is_none_or(|end| cycle > end - 1.0 - 1e-9 && cycle < end + 1e-9);
        let end = end.or(table.last_cycle())?;
        let rows = || (0..cycles.len()).filter(|&row| within(cycles[row]));
        let column = |of| {
            let values = table.column(of);
            let value = |row: usize| values.map_or(f64::NAN, |values| values[row]);
            rows().map(value).collect()
        };
        Some(Self {
            end,
            shifts: column(shift),
            forces: column(force),
            sensed: column(Column::RigDisplacement),
        })
    }

    /// Makes the loop of recorded moments; `None` if there are none, or without its columns.
    pub fn recorded(moments: &Recorder) -> Option<Self> {
        Self::from_table(&moments.table(moments.columns()), None)
    }
}
