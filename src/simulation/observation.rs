//! Pictures of one moment, owned and read-only: all that files and screens see of a simulation.

use std::sync::Arc;

use bitflags::bitflags;
use serde::Serialize;

use super::{Simulation, solve, stability, stress, volume_by_rate};
use crate::contact::tangential::Hold;
use crate::math::abel::AbelMethod;
use crate::math::abel::cone::Rest;
use crate::math::quadrature::volume_of_revolution;

bitflags! {
    /// Which curves a reader shows. What nobody shows is not computed.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct Curves: u8 {
        /// f.
        const PROFILE = 1;
        /// g.
        const PROFILE_1D = 1 << 1;
        /// q_z, q_x and u_x of the springs.
        const SPRINGS = 1 << 2;
        /// p: one transform.
        const PRESSURE = 1 << 3;
        /// τ.
        const SHEAR = 1 << 4;
        /// u_x(r) of the surface: one transform.
        const SURFACE = 1 << 5;
        /// Stick, slip or open, node by node.
        const ZONES = 1 << 6;
        /// u_z(r) of the surface: one transform.
        const DEPRESSION = 1 << 7;
    }
}

/// What a node does at the moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Zone {
    /// In contact, moving with the indenter.
    Stick,
    /// In contact, sliding.
    Slip,
    /// Not in contact.
    Open,
}

impl Zone {
    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stick => "stick",
            Self::Slip => "slip",
            Self::Open => "open",
        }
    }
}

/// The scalars of one moment: a row of the history.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Moment {
    /// Cycles since the start.
    pub cycle: f64,
    /// s.
    pub time: f64,
    /// Depth u_z, m.
    pub depth: f64,
    /// u_x⁽⁰⁾, m.
    pub shift: f64,
    /// F_z, N.
    pub normal_force: f64,
    /// F_x, N; 0 without tangential motion.
    pub tangential_force: f64,
    /// a, m.
    pub contact_radius: f64,
    /// c of this moment, m; none without tangential motion.
    pub stick_radius: Option<f64>,
    /// The smallest c of the last period of the motion, m.
    pub permanent_stick_radius: Option<f64>,
    /// V of the profile, m³.
    pub wear_volume: f64,
    /// V as the rates of wear add up to, those between the nodes at the contact's edge included, m³: it
    /// grows evenly, where that of the profile leaps when the rim of the worn zone passes a node.
    pub wear_volume_by_rate: f64,
    /// E_d, J.
    pub dissipated_energy: f64,
    /// 1 − ΔV/∫k dE_d over the last complete period of the motion, V by its rate.
    pub period_residual: Option<f64>,
    /// 1 − V/∫k dE_d: how far the 3D side and the 1D side disagree. None before anything has worn
    /// and under laws that do not follow energy.
    pub energy_residual: Option<f64>,
    /// The largest stiffness that the method bears, over that of the last step, or of its harshest part:
    /// below 1 wear grows teeth. None where nothing has worn in it, and after a jump.
    pub stability_margin: Option<f64>,
}

/// The scalars and the curves that were asked for; a curve that was not is empty.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// The scalars.
    pub moment: Moment,
    /// The transform method.
    pub method: AbelMethod,
    /// The wear law's name; none without wear.
    pub law: Option<&'static str>,
    /// Nodes r = x, m.
    pub radii: Arc<[f64]>,
    /// f₀, m.
    pub unworn: Arc<[f64]>,
    /// f, m.
    pub profile: Vec<f64>,
    /// f − f₀, m.
    pub wear: Vec<f64>,
    /// g, m.
    pub profile_1d: Vec<f64>,
    /// q_z, N/m.
    pub normal_load: Vec<f64>,
    /// q_x, N/m.
    pub tangential_load: Vec<f64>,
    /// u_x of the springs, m.
    pub spring: Vec<f64>,
    /// p, Pa.
    pub pressure: Vec<f64>,
    /// τ, Pa.
    pub shear: Vec<f64>,
    /// u_x(r) of the surface, m.
    pub surface: Vec<f64>,
    /// u_z(r) of the surface, m, downwards: d − f in contact, Eq. (2) of the springs outside.
    pub depression: Vec<f64>,
    /// Stick, slip or open.
    pub zones: Vec<Zone>,
}

impl Simulation {
    /// The scalars of the present moment.
    pub fn moment(&self) -> Moment {
        let (state, contact) = (self.state(), &self.workspace.contact);
        let wear_volume = self.wear_volume();
        let residual = 1.0 - (wear_volume - state.unexplained_volume) / state.expected_volume;
        Moment {
            cycle: state.cycle,
            time: state.cycle * self.setup().drive.period(),
            depth: contact.depth,
            shift: contact.shift,
            normal_force: solve::normal_force(&self.workspace, &self.setup().material),
            tangential_force: solve::tangential_force(&self.workspace, &self.setup().material),
            contact_radius: contact.normal.radius,
            stick_radius: contact.stick_radius,
            permanent_stick_radius: contact
                .stick_radius
                .map(|stick| state.permanent_stick_radius().min(stick)),
            wear_volume,
            wear_volume_by_rate: volume_by_rate(state, &self.workspace),
            dissipated_energy: state.dissipated_energy,
            period_residual: state.period.residual,
            energy_residual: (state.expected_volume > 0.0).then_some(residual),
            stability_margin: (state.last.stiffness > 0.0)
                .then(|| stability::limit(self.setup().scheme) / state.last.stiffness),
        }
    }

    /// p(r), Pa, of the present moment: one transform.
    pub fn pressure(&self) -> Vec<f64> {
        let mut pressure = vec![0.0; self.setup().grid.len()];
        stress::pressure(
            &self.workspace,
            &self.setup().material,
            self.state.core_radius(),
            &mut Rest::default(),
            &mut pressure,
        );
        pressure
    }

    /// 1 − ∫p dA/F_z with the `pressure` p (Pa) of the present moment: the 3D side against the springs
    /// of the 1D side. None without load. Between nodes p is linear in r², and a root towards the edge.
    pub fn force_residual(&self, pressure: &[f64]) -> Option<f64> {
        let contact = &self.workspace.contact.normal;
        let force = solve::normal_force(&self.workspace, &self.setup().material);
        if force <= 0.0 || contact.nodes == 0 {
            return None;
        }
        let nodes = self.setup().grid.nodes();
        let last = contact.nodes - 1;
        let inside = volume_of_revolution(&nodes[..=last], &pressure[..=last]);
        let ring = (contact.radius - nodes[last]) * (contact.radius + nodes[last]);
        let edge = std::f64::consts::PI * ring * 2.0 / 3.0 * pressure[last];
        Some(1.0 - (inside + edge) / force)
    }

    /// The present moment with the curves of `curves`.
    pub fn observe(&self, curves: Curves) -> Observation {
        let work = &self.workspace;
        let nodes = self.setup().grid.len();
        let with_springs = self.setup().drive.tangential().is_some();
        // Springs that the scene does not have carry nothing.
        let or_zero = |values: &[f64]| {
            if with_springs {
                values.to_vec()
            } else {
                vec![0.0; nodes]
            }
        };
        let when = |curve: Curves, make: &dyn Fn() -> Vec<f64>| {
            if curves.intersects(curve) {
                make()
            } else {
                Vec::new()
            }
        };
        let transformed = |transform: &dyn Fn(&mut [f64])| {
            let mut out = vec![0.0; nodes];
            if with_springs {
                transform(&mut out);
            }
            out
        };
        let modulus = self.setup().material.tangential_modulus();
        let worn = || -> Vec<f64> {
            let unworn = work.planned.unworn.iter();
            unworn.zip(&self.state().wear).map(|(f, w)| f + w).collect()
        };
        Observation {
            moment: self.moment(),
            method: self.setup().method,
            law: self.setup().wear.map(|law| law.name()),
            radii: self.setup().grid.nodes().into(),
            unworn: Arc::clone(&work.planned.unworn),
            profile: when(Curves::PROFILE, &worn),
            wear: when(Curves::PROFILE, &|| self.state().wear.clone()),
            profile_1d: when(Curves::PROFILE_1D, &|| work.g.clone()),
            normal_load: when(Curves::SPRINGS, &|| work.normal_load.clone()),
            tangential_load: when(Curves::SPRINGS, &|| {
                let springs = or_zero(&work.spring);
                springs.iter().map(|u| modulus * u).collect()
            }),
            spring: when(Curves::SPRINGS, &|| or_zero(&work.spring)),
            pressure: when(Curves::PRESSURE, &|| self.pressure()),
            shear: when(Curves::SHEAR, &|| {
                let material = &self.setup().material;
                let core = self.state.core_radius();
                transformed(&|out| stress::shear(work, material, core, &mut Rest::default(), out))
            }),
            surface: when(Curves::SURFACE, &|| {
                transformed(&|out| solve::surface_displacement(work, out))
            }),
            depression: when(Curves::DEPRESSION, &|| {
                let mut out = vec![0.0; nodes];
                let modulus = self.setup().material.normal_modulus();
                solve::depression(work, modulus, &mut out);
                let (depth, inside) = (work.contact.depth, work.contact.normal.nodes);
                for (out, f) in out.iter_mut().zip(worn()).take(inside) {
                    *out = depth - f;
                }
                out
            }),
            zones: if curves.contains(Curves::ZONES) {
                self.zones()
            } else {
                Vec::new()
            },
        }
    }

    fn zones(&self) -> Vec<Zone> {
        let work = &self.workspace;
        let zone = |(j, &load): (usize, &f64)| match work.hold.get(j) {
            _ if load <= 0.0 => Zone::Open,
            Some(Hold::Forward | Hold::Backward) => Zone::Slip,
            _ => Zone::Stick,
        };
        work.normal_load.iter().enumerate().map(zone).collect()
    }
}
