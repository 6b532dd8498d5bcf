//! The data of a run, or of another source, as named columns in SI units: over the radius, over cycles, over a loop. A
//! column has the same name in a file, in memory and on an axis.

use crate::scenario::columns::{Columns, OWN};

/// Two columns that make a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Axes {
    /// The abscissa's column.
    pub x: &'static str,
    /// The ordinate's.
    pub y: &'static str,
    /// The ordinate's symbol.
    pub symbol: &'static str,
}

impl Axes {
    /// f over r.
    pub const PROFILE: Self = Self::new("r_m", "f_m", "f");
    /// f − f₀ over r.
    pub const WEAR: Self = Self::new("r_m", "wear_m", "worn");
    /// g over x.
    pub const SPRINGS: Self = Self::new("r_m", "g_m", "g");
    /// p over r.
    pub const PRESSURE: Self = Self::new("r_m", "p_Pa", "p");
    /// τ over r.
    pub const SHEAR: Self = Self::new("r_m", "tau_Pa", "τ");
    /// F_x over u_x, in tables of one cycle.
    pub const LOOP: Self = Self::new("u_m", "F_N", "F_x");
    /// V over cycles.
    pub const VOLUME: Self = Self::new("cycle", "wear_volume_m3", "V");
    /// The largest f − f₀ over cycles.
    pub const DEPTH: Self = Self::new("cycle", "scar_depth_m", "depth");
    /// a over cycles.
    pub const CONTACT: Self = Self::new("cycle", "contact_radius_m", "a");
    /// The smallest c in each cycle, over cycles.
    pub const STICK: Self = Self::new("cycle", "permanent_stick_radius_m", "c");

    /// These columns.
    pub const fn new(x: &'static str, y: &'static str, symbol: &'static str) -> Self {
        Self { x, y, symbol }
    }

    /// The unit of the ordinate.
    pub fn unit(self) -> &'static str {
        unit_of(self.y)
    }

    /// Whether the abscissa is the radius.
    pub fn over_r(self) -> bool {
        self.x == "r_m"
    }
}

/// The unit that ends the name of a column.
pub fn unit_of(column: &str) -> &'static str {
    let ends_with = |unit: &str| column.strip_suffix(unit)?.strip_suffix('_');
    let found = OWN.iter().find(|(unit, _)| ends_with(unit).is_some());
    found.map_or("", |(_, unit)| unit)
}

/// A table of this program: header lines and columns of numbers, each named with its unit at the end.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// The `# key: value` lines.
    pub header: Vec<(String, String)>,
    columns: Vec<(String, Vec<f64>)>,
}

impl Table {
    /// A table from memory: its header and named columns of one length.
    pub fn of_columns<N: Into<String>>(
        header: Vec<(String, String)>,
        columns: impl IntoIterator<Item = (N, Vec<f64>)>,
    ) -> Self {
        let columns = columns.into_iter();
        let columns = columns.map(|(name, values)| (name.into(), values));
        Self {
            header,
            columns: columns.collect(),
        }
    }

    /// Makes a table from its header, column names, and rows.
    pub fn of_rows<const N: usize>(
        header: Vec<(String, String)>,
        names: [&str; N],
        rows: &[impl AsRef<[f64]>],
    ) -> Self {
        let columns = names.into_iter().enumerate();
        let columns =
            columns.map(|(k, name)| (name, rows.iter().map(|row| row.as_ref()[k]).collect()));
        Self::of_columns(header, columns)
    }

    /// A column, if there is one of that name.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let (_, values) = self.columns.iter().find(|(column, _)| column == name)?;
        Some(values)
    }

    /// Whether it has all of these columns.
    pub fn has(&self, names: &[&str]) -> bool {
        names.iter().all(|name| self.column(name).is_some())
    }

    /// Returns the value of a header line.
    pub fn fact(&self, key: &str) -> Option<&str> {
        let found = self.header.iter().find(|(name, _)| name == key);
        found.map(|(_, value)| value.as_str())
    }

    /// Returns the cycle given in the header; NaN without one.
    pub fn cycle(&self) -> f64 {
        let cycle = self.fact("cycle").and_then(|cycle| cycle.parse().ok());
        cycle.unwrap_or(f64::NAN)
    }

    /// Returns the last cycle of a table over cycles.
    pub fn last_cycle(&self) -> Option<f64> {
        self.column("cycle")?.last().copied()
    }

    /// The columns of a file, in SI units; fields that are no numbers become NaN.
    pub fn of_file(columns: &Columns) -> Self {
        Self::of_columns(columns.header.clone(), columns.all())
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |(_, values)| values.len())
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
    pub fn of(table: &Table, end: Option<f64>) -> Option<Self> {
        let cycles = table.column("cycle")?;
        let pairs = [["u_x_m", "F_x_N"], ["u_m", "F_N"]];
        let [shift, force] = pairs.into_iter().find(|pair| table.has(pair))?;
        let within =
            |cycle: f64| end.is_none_or(|end| cycle > end - 1.0 - 1e-9 && cycle < end + 1e-9);
        let end = end.or(table.last_cycle())?;
        let rows = || (0..cycles.len()).filter(|&row| within(cycles[row]));
        let column = |name| {
            let values = table.column(name);
            let value = |row: usize| values.map_or(f64::NAN, |values| values[row]);
            rows().map(value).collect()
        };
        Some(Self {
            end,
            shifts: column(shift),
            forces: column(force),
            sensed: column("rig_displacement_m"),
        })
    }

    /// Makes a loop from steps: cycle, u_x⁽⁰⁾, F_x and the actuator's displacement.
    pub fn of_rows<'a>(end: f64, rows: impl Iterator<Item = &'a [f64; 4]> + Clone) -> Self {
        let column = |k: usize| rows.clone().map(|row| row[k]).collect();
        Self {
            end,
            shifts: column(1),
            forces: column(2),
            sensed: column(3),
        }
    }
}
