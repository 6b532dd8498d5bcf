//! The figures that a fretting test reports per cycle: energy, force and slip ratios, and the running condition.
//!
//! The figures describe the last complete period of the motion. Each step adds its end point to a [`LoopTally`], which
//! becomes [`CycleFigures`] at the end of the period. The [`Log`](super::Log) of a run keeps both. After a jump over
//! cycles, the figures describe the [`FinePeriod`] on the present profile.
//!
//! # Formulas
//!
//! U is the amplitude of u_x⁽⁰⁾, or of the actuator if a rig of finite stiffness moves the contact; Q* the amplitude of
//! F_x, P the mean of F_z, and δ₀ the displacement that remains where F_x passes through zero, all over one cycle:
//!
//! | figure | formula | 0 | gross slip |
//! |---|---|---|---|
//! | force ratio | Q*/(μP) | no tangential force | 1 |
//! | slip ratio | 1 − Q*/(2 G* a U) | full stick | towards 1 |
//! | sliding ratio D | δ₀/U | full stick | 0.26 at the border (sphere) |
//! | energy ratio A | E_d/(4 Q* U) | full stick | 0.2 at the border (sphere) |
//! | energy ratio B | E_d/(4 Q* δ₀) | | 0.77 at the border (sphere) |
//!
//! 2G*a is the tangential stiffness of the contact, so the slip ratio is the mean slip of its springs
//! in units of U. A, B and D: S. Fouvry, P. Kapsa, L. Vincent (1995), Wear 185, 35–46.

use serde::{Deserialize, Serialize};
use strum::{EnumString, IntoStaticStr};

use crate::math::root;
use crate::simulation::{FinePeriod, PeriodPoint, Setup, Simulation};

/// Below this energy ratio A a test rig sees the loop as a line, so the contact counts as sticking. A sphere in partial
/// slip passes it near U = 0.06 of the amplitude of gross slip.
const CLOSED_LOOP: f64 = 0.005;

/// The running condition of a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, EnumString, IntoStaticStr)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum Regime {
    /// Full stick: the loop is closed (A < 0.005).
    Stick,
    /// Partial slip: part of the contact never slips.
    Partial,
    /// Gross slip: no point sticks through the whole cycle.
    Gross,
    /// The contact opens during part of the cycle.
    Open,
}

impl Regime {
    /// All regimes, in the order of legends.
    pub const ALL: [Self; 4] = [Self::Stick, Self::Partial, Self::Gross, Self::Open];

    /// Returns the name used in files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Returns the name shown on screens.
    pub fn title(self) -> &'static str {
        match self {
            Self::Stick => "full stick",
            Self::Partial => "partial slip",
            Self::Gross => "gross slip",
            Self::Open => "lift-off",
        }
    }
}

/// The figures of one cycle; a ratio is `None` if its denominator vanishes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CycleFigures {
    /// Dissipated energy per cycle, J.
    pub energy: f64,
    /// U, half the range of u_x⁽⁰⁾, or of the rig's actuator, m.
    pub displacement_amplitude: f64,
    /// Q*, half the range of F_x, N.
    pub force_amplitude: f64,
    /// P, the mean normal force, N.
    pub normal_force: f64,
    /// δ₀, half the width of the loop at F_x = 0, m; `None` if F_x keeps its sign.
    pub opening: Option<f64>,
    /// Q*/(μP).
    pub force_ratio: Option<f64>,
    /// 1 − Q*/(2G*aU), at least 0; in a line contact 1 − Q*/(KU), with K the stiffness of the sticking contact.
    pub slip_ratio: Option<f64>,
    /// D = δ₀/U.
    pub sliding_ratio: Option<f64>,
    /// A = E_d/(4Q*U).
    pub energy_ratio: Option<f64>,
    /// B = E_d/(4Q*δ₀).
    pub energy_ratio_b: Option<f64>,
    /// The running condition.
    pub regime: Regime,
}

/// The current period of the motion so far.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct LoopTally {
    /// Its beginning in cycles, and E_d there, J.
    start: [f64; 2],
    /// Cycle, u_x⁽⁰⁾ (m) and F_x (N) of the last step.
    last: [f64; 3],
    /// Smallest and largest u_x⁽⁰⁾, m.
    shift: [f64; 2],
    /// Smallest and largest F_x, N.
    force: [f64; 2],
    /// ∫F_z dn and ∫a dn over the cycles n, N and m.
    normal_force: f64,
    contact_radius: f64,
    /// Whether the contact was open at some moment.
    opened: bool,
    /// Sum and number of the u_x⁽⁰⁾ at which F_x falls, or rises, through zero.
    falling: [f64; 2],
    rising: [f64; 2],
}

impl LoopTally {
    /// Begins a tally at the present moment of a simulation.
    pub fn begin(simulation: &Simulation) -> Self {
        let [cycle, shift, force] = moment(simulation);
        Self {
            start: [cycle, simulation.state().ledger.dissipated_energy],
            last: [cycle, shift, force],
            shift: [shift; 2],
            force: [force; 2],
            ..Self::default()
        }
    }

    /// Returns the end of the last step, in cycles.
    pub fn cycle(&self) -> f64 {
        self.last[0]
    }

    /// Adds the end of the last step of a simulation.
    pub fn add(&mut self, simulation: &Simulation) {
        let contact = &simulation.state().contact;
        let (normal_force, contact_radius) = (
            contact.normal_force(simulation.model()),
            contact.normal.radius,
        );
        let moment = moment(simulation);
        let [cycle, shift, force] = moment;
        let [before, shift_before, force_before] = self.last;
        self.shift = [self.shift[0].min(shift), self.shift[1].max(shift)];
        self.force = [self.force[0].min(force), self.force[1].max(force)];
        self.normal_force += normal_force * (cycle - before);
        self.contact_radius += contact_radius * (cycle - before);
        self.opened |= contact_radius == 0.0;
        let crossing = || {
            let share = force_before / (force_before - force);
            unloaded(simulation, [force_before, force])
                .unwrap_or(shift_before + share * (shift - shift_before))
        };
        let into = if force_before > 0.0 && force <= 0.0 {
            &mut self.falling
        } else if force_before < 0.0 && force >= 0.0 {
            &mut self.rising
        } else {
            self.last = moment;
            return;
        };
        *into = [into[0] + crossing(), into[1] + 1.0];
        self.last = moment;
    }

    /// Returns the figures of the period that ends at the present moment of a simulation; `None` if the tally began
    /// within the period, or without tangential motion.
    pub fn close(&self, simulation: &Simulation, period: f64) -> Option<CycleFigures> {
        let [start, energy] = self.start;
        let cycles = self.last[0] - start;
        if start % period != 0.0 || cycles <= 0.0 || simulation.setup().springs() == 0 {
            return None;
        }
        let state = simulation.state();
        let extent = |[low, high]: [f64; 2]| 0.5 * (high - low);
        let measured = PeriodMeans {
            energy: (state.ledger.dissipated_energy - energy) / cycles,
            shift: extent(self.shift),
            force: extent(self.force),
            normal_force: self.normal_force / cycles,
            contact_radius: self.contact_radius / cycles,
            stick_radius: state.permanent_stick_radius(),
            opened: self.opened,
            opening: opening(self.falling, self.rising),
        };
        Some(measured.figures(&simulation.model_of_last_step().setup))
    }
}

/// Returns δ₀, m, from the sums and numbers of the displacements at which F_x falls and rises through zero.
fn opening(falling: [f64; 2], rising: [f64; 2]) -> Option<f64> {
    let mean = |[sum, count]: [f64; 2]| sum / count;
    let crosses = falling[1] > 0.0 && rising[1] > 0.0;
    crosses.then(|| 0.5 * (mean(falling) - mean(rising)).abs())
}

/// Measured values of a period: per cycle, or averaged over it.
struct PeriodMeans {
    /// E_d, J.
    energy: f64,
    /// U, m, and Q*, N.
    shift: f64,
    force: f64,
    /// P, N, and a, m.
    normal_force: f64,
    contact_radius: f64,
    /// The smallest stick radius, m.
    stick_radius: f64,
    /// Whether the contact was open at some moment.
    opened: bool,
    /// δ₀, m.
    opening: Option<f64>,
}

impl PeriodMeans {
    fn figures(self, setup: &Setup) -> CycleFigures {
        let Self {
            energy,
            shift,
            force,
            normal_force,
            opening,
            ..
        } = self;
        let material = &setup.material;
        let ratio = |over: f64, under: f64| (under > 0.0).then(|| over / under);
        let energy_ratio = ratio(energy, 4.0 * force * shift);
        // The slip ratio describes the contact without the rig.
        let of_contact = shift - setup.drive.rig_compliance() * force;
        let elastic = setup.drive.stiffness(material, self.contact_radius) * of_contact;
        let regime = if self.opened {
            Regime::Open
        } else if self.stick_radius <= 0.0 && energy > 0.0 {
            Regime::Gross
        } else if energy_ratio.is_none_or(|ratio| ratio < CLOSED_LOOP) {
            Regime::Stick
        } else {
            Regime::Partial
        };
        CycleFigures {
            energy,
            displacement_amplitude: shift,
            force_amplitude: force,
            normal_force,
            opening,
            force_ratio: ratio(force, material.friction() * normal_force),
            slip_ratio: ratio(force, elastic).map(|stuck| (1.0 - stuck).max(0.0)),
            sliding_ratio: opening.and_then(|opening| ratio(opening, shift)),
            energy_ratio,
            energy_ratio_b: opening.and_then(|opening| ratio(energy, 4.0 * force * opening)),
            regime,
        }
    }
}

impl CycleFigures {
    /// Computes the figures of a finely stepped period with the parts of `setup`.
    pub fn from_period(period: &FinePeriod, setup: &Setup) -> Self {
        let points = &period.points;
        let length = period.cycles;
        let mean = |of: fn(&PeriodPoint) -> f64| {
            let steps = points.windows(2);
            let parts =
                steps.map(|step| (of(&step[1]) + of(&step[0])) * (step[1].cycle - step[0].cycle));
            0.5 * parts.sum::<f64>() / length
        };
        let mut crossings = [[0.0; 2]; 2];
        for step in points.windows(2) {
            let [before, after] = [step[0].tangential_force, step[1].tangential_force];
            let rises = before < 0.0 && after >= 0.0;
            if rises || before > 0.0 && after <= 0.0 {
                let share = before / (before - after);
                let [sum, count] = &mut crossings[usize::from(rises)];
                *sum += step[0].sensed + share * (step[1].sensed - step[0].sensed);
                *count += 1.0;
            }
        }
        let measured = PeriodMeans {
            energy: period.energy_per_cycle(),
            shift: period.amplitude(|point| point.sensed),
            force: period.amplitude(|point| point.tangential_force),
            normal_force: mean(|point| point.normal_force),
            contact_radius: mean(|point| point.contact_radius),
            stick_radius: period.permanent_stick_radius(),
            opened: points.iter().any(|point| point.contact_radius == 0.0),
            opening: opening(crossings[0], crossings[1]),
        };
        measured.figures(setup)
    }
}

/// Returns the present cycle, the displacement that the rig's sensor sees, m, and F_x, N.
fn moment(simulation: &Simulation) -> [f64; 3] {
    let contact = &simulation.state().contact;
    let force = contact.tangential_force(simulation.model());
    let shift = sensed(simulation.setup(), contact.shift, force);
    [simulation.cycle(), shift, force]
}

/// Returns the displacement at which F_x passes through zero in the last step, m. In the longest steps F_x curves so
/// much that a straight line misses it by 6 %. The force is known at the step's `ends`, N. `None` if the contact cannot
/// be solved between them.
fn unloaded(simulation: &Simulation, ends: [f64; 2]) -> Option<f64> {
    let model = simulation.model_of_last_step();
    let mut found = None;
    let force = |share: f64| match share {
        0.0 => ends[0],
        1.0 => ends[1],
        between => {
            let contact = simulation.within_last_step(&model, between);
            contact.map_or(f64::NAN, |contact| {
                let force = contact.tangential_force(&model);
                found = Some(sensed(&model.setup, contact.shift, force));
                force
            })
        }
    };
    root::bracketed(force, 0.0, 1.0, 1e-4)?;
    found
}

/// Returns the displacement of the actuator, m, which the rig's sensor sees, if the contact is shifted by `shift` under
/// `force` (N).
pub(super) fn sensed(setup: &Setup, shift: f64, force: f64) -> f64 {
    shift + setup.drive.rig_compliance() * force
}
