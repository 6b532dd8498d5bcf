//! Scalars of a session's present moment: the columns of histories and of studies.

use std::cell::OnceCell;

use super::{hint, printable};
use crate::math::number::exact;
use crate::math::scan::largest;
use crate::reading::column::other_columns;
use crate::reading::fatigue::{Limits, StressCycle};
use crate::reading::subsurface::Peak;
use crate::reading::{Column, CycleFigures, Moment, Quantity};
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
        value if value.is_f64() => exact(value.as_f64().unwrap_or(f64::NAN)),
        other => other.to_string(),
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

    /// The value of a scalar; missing where it is not defined at this moment, and for columns that are none.
    pub fn value(&self, scalar: Column) -> Value {
        let (session, moment) = (self.session, &self.moment);
        let (simulation, scenario) = (session.simulation(), session.scenario());
        let stats = simulation.stats();
        match scalar {
            Column::Cycle => moment.cycle.into(),
            Column::Time => moment.time.into(),
            Column::Indentation => moment.depth.into(),
            Column::Shift => moment.shift.into(),
            Column::NormalForce => moment.normal_force.into(),
            Column::TangentialForce => moment.tangential_force.into(),
            Column::ContactRadius => moment.contact_radius.into(),
            Column::StickRadius => moment.stick_radius.into(),
            Column::PermanentStickRadius => moment.permanent_stick_radius.into(),
            Column::WearVolume => moment.wear_volume.into(),
            Column::DissipatedEnergy => moment.dissipated_energy.into(),
            Column::EnergyResidual => moment.energy_residual.into(),
            Column::MaxPressure => largest(self.pressure()).into(),
            Column::PeriodEnergyResidual => session.log().period_residual().into(),
            Column::ForceResidual => simulation.force_residual(self.pressure()).into(),
            Column::Steps => simulation.steps().into(),
            Column::Transforms => stats.transforms.into(),
            Column::EvaluatedCycles => stats.evaluated_cycles.into(),
            Column::RejectedJumps => stats.rejected_jumps.into(),
            Column::StabilityMargin => moment.stability_margin.into(),
            Column::Parts => stats.parts.into(),
            Column::EnergyPerCycle => self.figure(|figures| Some(figures.energy)),
            Column::ForceRatio => self.figure(|figures| figures.force_ratio),
            Column::SlipRatio => self.figure(|figures| figures.slip_ratio),
            Column::SlidingRatio => self.figure(|figures| figures.sliding_ratio),
            Column::EnergyRatio => self.figure(|figures| figures.energy_ratio),
            Column::EnergyRatioB => self.figure(|figures| figures.energy_ratio_b),
            Column::Regime => self.figures().map(|figures| figures.regime.name()).into(),
            Column::WearPerEnergy => moment.wear_per_energy().into(),
            Column::RigDisplacement => moment.rig_displacement.into(),
            Column::ScarDepth => largest(simulation.worn_depth()).into(),
            Column::ScarRadius => scar_radius(simulation).into(),
            Column::ForceAmplitude => self.figure(|figures| Some(figures.force_amplitude)),
            Column::ShiftAmplitude => self.figure(|figures| Some(figures.displacement_amplitude)),
            Column::MeanNormalForce => self.figure(|figures| Some(figures.normal_force)),
            Column::Swt => self.swt(|peak| peak.value).into(),
            Column::SwtX => self.swt(|peak| peak.x).into(),
            Column::SwtZ => self.swt(|peak| peak.z).into(),
            Column::SwtRatio => {
                let limit = scenario.fatigue_limit();
                let ratio = limit.and_then(|limit| Some(self.swt(|peak| peak.value)? / limit));
                ratio.into()
            }
            Column::Crossland => self.crossland(|peak| peak.value).into(),
            Column::CrosslandX => self.crossland(|peak| peak.x).into(),
            Column::CrosslandZ => self.crossland(|peak| peak.z).into(),
            Column::CrosslandRatio => {
                let limits = self.limits();
                let ratio =
                    limits.and_then(|both| Some(self.crossland(|peak| peak.value)? / both.shear));
                ratio.into()
            }
            Column::WornDepthError
            | Column::DeepestError
            | Column::VolumeError
            | Column::EnergyError
            | Column::ForceError
            | Column::LoopError
            | Column::PressureError
            | Column::ContactRadiusError
            | Column::StickRadiusError => self.stated(scalar).into(),
            other_columns!() => Value::Null,
        }
    }

    /// The same as a number; NaN where it is none at this moment.
    pub fn number(&self, scalar: Column) -> f64 {
        self.value(scalar).as_f64().unwrap_or(f64::NAN)
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
        let stresses = self
            .stresses
            .get_or_init(|| StressCycle::simulate(simulation));
        stresses.as_ref()
    }

    fn limits(&self) -> Option<Limits> {
        let scenario = self.session.scenario();
        Some(Limits {
            tension: scenario.fatigue_limit()?,
            shear: scenario.spec().material.shear_fatigue_limit?,
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
