//! Named scalars of a session's present moment: the columns of histories and of studies.
//!
//! Every name is defined once, here, so that a column means the same in every file.

use std::cell::OnceCell;

use super::{nearest, printable, schema};
use crate::math::scan::largest;
use crate::reading::fatigue::{Limits, StressCycle};
use crate::reading::subsurface::Peak;
use crate::reading::{CycleFigures, Moment, Quantity};
use crate::scenario::session::Session;
use crate::simulation::Simulation;

/// A scalar's value, or a cell of a table: a number in the unit that its name ends with, a count, a word, or null if it
/// is undefined at this moment.
pub use serde_json::Value;

/// Returns the value as a field of a CSV file: numbers in the shortest form that reads back to the same bits, an empty
/// field for a missing value.
pub fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(word) => word.clone(),
        value if value.is_f64() => number(value.as_f64().unwrap_or(f64::NAN)),
        other => other.to_string(),
    }
}

/// Returns the shortest decimal form that reads back to the same bits.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".into()
    } else if (1e-4..1e15).contains(&size) || !value.is_finite() {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Returns a number as a field, empty if NaN.
pub fn field(value: f64) -> String {
    cell(&value.into())
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

    /// The scalar of this name; missing where there is none.
    pub fn value(&self, name: &str) -> Value {
        find(name).map_or(Value::Null, |scalar| scalar.read(self))
    }

    /// The same as a number; NaN where it is none at this moment.
    pub fn number(&self, name: &str) -> f64 {
        self.value(name).as_f64().unwrap_or(f64::NAN)
    }

    /// Returns p(r), Pa; computed once, by one transform.
    fn pressure(&self) -> &[f64] {
        self.pressure
            .get_or_init(|| self.session.simulation().pressure())
    }

    /// Returns a figure of the last complete period; after a jump, a period is stepped for it.
    fn figure(&self, of: fn(&CycleFigures) -> Option<f64>) -> Value {
        self.figures().as_ref().and_then(of).into()
    }

    fn figures(&self) -> &Option<CycleFigures> {
        self.figures.get_or_init(|| self.session.cycle_figures())
    }

    /// Returns the loads of a steady-state cycle, which is stepped once.
    fn stresses(&self) -> Option<&StressCycle> {
        let simulation = self.session.simulation();
        let stresses = self.stresses.get_or_init(|| StressCycle::of(simulation));
        stresses.as_ref()
    }

    fn limits(&self) -> Option<Limits> {
        let scenario = self.session.scenario();
        Some(Limits {
            tension: scenario.fatigue_limit()?,
            shear: schema::read(&scenario.table, "material.shear_fatigue_limit")?,
        })
    }

    /// Finds where the Smith–Watson–Topper parameter is largest.
    fn swt(&self, of: fn(&Peak) -> f64) -> Option<f64> {
        let find = || Some(self.stresses()?.largest(|at| at.swt));
        self.swt.get_or_init(find).as_ref().map(of)
    }

    /// Finds where Crossland's parameter is largest.
    fn crossland(&self, of: fn(&Peak) -> f64) -> Option<f64> {
        let find = || {
            let limits = self.limits()?;
            Some(self.stresses()?.largest(|at| at.crossland(limits)))
        };
        self.crossland.get_or_init(find).as_ref().map(of)
    }

    /// The estimated error that the headers of the run's files state.
    fn stated(&self, quantity: Quantity) -> Value {
        let mut stated = self.session.statements().iter();
        let found = stated.find(|(known, _)| known == quantity.column());
        let number = found.and_then(|(_, value)| value.parse::<f64>().ok());
        number.into()
    }

    fn worn(&self) -> &[f64] {
        self.session.simulation().worn_depth()
    }
}

/// A scalar that columns can name.
#[derive(Debug, Clone, Copy)]
pub struct Scalar {
    /// The name of the column; ends with the unit, if there is one.
    pub name: &'static str,
    /// What it is, in one line.
    pub meaning: &'static str,
    read: fn(&Reading) -> Value,
}

impl Scalar {
    /// Returns its value.
    pub fn read(&self, reading: &Reading) -> Value {
        (self.read)(reading)
    }
}

/// Finds a scalar by its name.
pub fn find(name: &str) -> Option<&'static Scalar> {
    SCALARS.iter().find(|scalar| scalar.name == name)
}

/// Finds a scalar by its name.
///
/// # Errors
///
/// In one line, the unknown name with the nearest known one.
pub fn named(name: &str) -> Result<&'static Scalar, String> {
    find(name).ok_or_else(|| {
        let hint = nearest::hint(name, SCALARS.iter().map(|scalar| scalar.name));
        format!("unknown column {}; {hint}", printable(name))
    })
}

/// Makes the list of all scalars, and of the names of those in every history.
macro_rules! scalars {
    (history { $($column:literal, $of:literal, |$row:ident| $value:expr;)* }
     further { $($name:literal, $meaning:literal, |$r:ident| $read:expr;)* }
     stated { $($quantity:ident),* }) => {
        /// All scalars; those of `history.csv` stand first, in the order of its columns.
        pub const SCALARS: &[Scalar] = &[
            $(Scalar { name: $column, meaning: $of, read: |$row| Value::from($value) },)*
            $(Scalar { name: $name, meaning: $meaning, read: |$r| Value::from($read) },)*
            $(Scalar {
                name: Quantity::$quantity.column(),
                meaning: Quantity::$quantity.meaning(),
                read: |r| r.stated(Quantity::$quantity),
            },)*
        ];

        /// The columns of `history.csv`, in order.
        pub const HISTORY: [&str; [$($column),*].len()] = [$($column),*];
    };
}

scalars! {
    history {
        "cycle", "cycles since the start", |r| r.moment.cycle;
        "time_s", "time", |r| r.moment.time;
        "u_z_m", "indentation depth d", |r| r.moment.depth;
        "u_x_m", "tangential displacement", |r| r.moment.shift;
        "F_z_N", "normal force", |r| r.moment.normal_force;
        "F_x_N", "tangential force", |r| r.moment.tangential_force;
        "contact_radius_m", "contact radius a", |r| r.moment.contact_radius;
        "stick_radius_m", "stick radius c at this moment", |r| r.moment.stick_radius;
        "permanent_stick_radius_m", "smallest stick radius of the last period", |r| r.moment.permanent_stick_radius;
        "wear_volume_m3", "worn volume V", |r| r.moment.wear_volume;
        "dissipated_energy_J", "friction work E_d", |r| r.moment.dissipated_energy;
        "energy_residual", "1 - V/(k E_d)", |r| r.moment.energy_residual;
        "max_pressure_Pa", "largest pressure", |r| largest(r.pressure());
        "period_energy_residual", "1 - V/(k E_d) of the last period", |r| r.session.log().period_residual();
        "force_residual", "1 - (integral of p)/F_z",
            |r| r.session.simulation().force_residual(r.pressure());
        "steps", "steps taken", |r| r.session.simulation().steps();
        "transforms", "transforms computed", |r| r.session.simulation().stats().transforms;
        "evaluated_cycles", "cycles stepped in full for jumps", |r| r.session.simulation().stats().evaluated_cycles;
        "rejected_jumps", "jumps rejected for their error", |r| r.session.simulation().stats().rejected_jumps;
        "stability_margin", "largest stable stiffness divided by the stiffness of the last step",
            |r| r.moment.stability_margin;
        "parts", "sub-steps of stiff steps", |r| r.session.simulation().stats().parts;
        "energy_per_cycle_J", "friction work of a cycle", |r| r.figure(|figures| Some(figures.energy));
        "force_ratio", "Q*/(mu P)", |r| r.figure(|figures| figures.force_ratio);
        "slip_ratio", "1 - Q*/(2 G* a U)", |r| r.figure(|figures| figures.slip_ratio);
        "sliding_ratio", "D = delta_0/U", |r| r.figure(|figures| figures.sliding_ratio);
        "energy_ratio", "A = E_d/(4 Q* U)", |r| r.figure(|figures| figures.energy_ratio);
        "energy_ratio_B", "B = E_d/(4 Q* delta_0)", |r| r.figure(|figures| figures.energy_ratio_b);
        "regime", "stick, partial, gross or open",
            |r| r.figures().map(|figures| figures.regime.name());
        "wear_per_energy_m3_per_J", "V/E_d", |r| r.moment.wear_per_energy();
        "rig_displacement_m", "displacement of the rig's actuator", |r| r.moment.rig_displacement;
        "scar_depth_m", "largest worn depth", |r| largest(r.worn());
        "scar_radius_m", "outer radius of the wear scar", |r| scar_radius(r.session.simulation());
    }
    further {
        "F_x_amplitude_N", "half the range of F_x in a cycle", |r| r.figure(|figures| Some(figures.force_amplitude));
        "u_x_amplitude_m", "half the range of u_x in a cycle",
            |r| r.figure(|figures| Some(figures.displacement_amplitude));
        "mean_F_z_N", "mean normal force of a cycle", |r| r.figure(|figures| Some(figures.normal_force));
        "swt_Pa", "largest Smith-Watson-Topper stress", |r| r.swt(|peak| peak.value);
        "swt_x_m", "place of the largest SWT along the motion", |r| r.swt(|peak| peak.x);
        "swt_z_m", "depth of the largest SWT", |r| r.swt(|peak| peak.z);
        "swt_ratio", "SWT over the fatigue limit",
            |r| r.session.scenario().fatigue_limit().and_then(|limit| Some(r.swt(|peak| peak.value)? / limit));
        "crossland_Pa", "largest Crossland stress", |r| r.crossland(|peak| peak.value);
        "crossland_x_m", "place of the largest Crossland stress along the motion", |r| r.crossland(|peak| peak.x);
        "crossland_z_m", "depth of the largest Crossland stress", |r| r.crossland(|peak| peak.z);
        "crossland_ratio", "Crossland over the shear fatigue limit",
            |r| r.limits().and_then(|both| Some(r.crossland(|peak| peak.value)? / both.shear));
    }
    stated {
        WornDepth, Deepest, Volume, Energy, Force, Loop, Pressure, ContactRadius, StickRadius
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scalar_stands_once_and_says_what_it_is() {
        for (at, scalar) in SCALARS.iter().enumerate() {
            assert!(!scalar.meaning.is_empty(), "{}", scalar.name);
            let first = SCALARS.iter().position(|other| other.name == scalar.name);
            assert_eq!(first, Some(at), "{} twice", scalar.name);
        }
    }
}
