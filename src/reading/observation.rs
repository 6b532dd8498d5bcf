//! Owned, read-only snapshots of one moment: everything that files and screens see of a simulation.

use std::sync::Arc;

use bitflags::bitflags;
use serde::Serialize;
use strum::IntoStaticStr;

use super::cycle_figures::sensed;
use super::subsurface::SpringLoad;
use super::{Column, Table, scar_end};
use crate::contact::tangential::SpringState;
use crate::math::abel::AbelMethod;
use crate::math::abel::dome::Dome;
use crate::math::abel::worn;
use crate::math::geometry::Geometry;
use crate::math::grid::RadialGrid;
use crate::simulation::{Simulation, stability, traction};

bitflags! {
    /// The curves that a reader shows. Others are not computed.
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
        /// Stick, slip or open at each node.
        const ZONES = 1 << 6;
        /// u_z(r) of the surface: one transform.
        const DEPRESSION = 1 << 7;
    }
}

/// The state of a node at the moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum Zone {
    /// In contact, moving with the indenter.
    Stick,
    /// In contact, sliding.
    Slip,
    /// Not in contact.
    Open,
}

impl Zone {
    /// All zones, in the order of their numbers.
    pub const ALL: [Self; 3] = [Self::Stick, Self::Slip, Self::Open];

    /// Returns the name used in files.
    pub fn name(self) -> &'static str {
        self.into()
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
    /// Displacement of the rig's actuator, m, which its sensor sees: the indenter's plus the rig's own; `None` if the
    /// rig is stiff.
    pub rig_displacement: Option<f64>,
    /// F_z, N.
    pub normal_force: f64,
    /// F_x, N; 0 without tangential motion.
    pub tangential_force: f64,
    /// a, m.
    pub contact_radius: f64,
    /// c at this moment, m; `None` without tangential motion.
    pub stick_radius: Option<f64>,
    /// The smallest c of the last period of the motion, m.
    pub permanent_stick_radius: Option<f64>,
    /// V of the profile, m³, including a scar that the run began with.
    pub wear_volume: f64,
    /// V of that scar, m³; 0 without one.
    pub initial_volume: f64,
    /// E_d, J.
    pub dissipated_energy: f64,
    /// 1 − V/∫k dE_d: the disagreement of the 3D side and the 1D side. `None` before anything has worn and under laws
    /// that do not follow energy.
    pub energy_residual: Option<f64>,
    /// The largest stiffness that the method tolerates, relative to the stiffness of the last step or its stiffest
    /// sub-step: below 1 a sawtooth grows. `None` if nothing wore in the step, and after a jump.
    pub stability_margin: Option<f64>,
}

impl Moment {
    /// Returns the state of the surface at a radius (m).
    pub fn zone_at(&self, r: f64) -> Zone {
        match self.stick_radius {
            _ if r >= self.contact_radius => Zone::Open,
            Some(stick) if r >= stick => Zone::Slip,
            _ => Zone::Stick,
        }
    }

    /// Returns V/E_d of the run, m³/J = 1/Pa: the effective wear coefficient of the whole test. `None` before any
    /// friction work.
    pub fn wear_per_energy(&self) -> Option<f64> {
        let worn = self.wear_volume - self.initial_volume;
        (self.dissipated_energy > 0.0).then(|| worn / self.dissipated_energy)
    }
}

/// The scalars and the requested curves; the other curves are empty.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// The scalars.
    pub moment: Moment,
    /// Geometry of the contact.
    pub geometry: Geometry,
    /// The transform method.
    pub method: AbelMethod,
    /// Name of the wear law; `None` without wear.
    pub law: Option<&'static str>,
    /// Nodes r = x, with the border of the permanent stick zone among them.
    pub grid: RadialGrid,
    /// The curves, in the order of `state.csv`.
    pub columns: Arc<Table>,
    /// How each load falls to zero at the end of a scar, if it does.
    pub domes: [Option<Dome>; 2],
    /// u_z(r) of the surface, m, downwards: d − f in contact, Eq. (2) of the springs outside.
    pub depression: Vec<f64>,
    /// Stick, slip or open.
    pub zones: Vec<Zone>,
}

/// Makes a reader of each curve; one that was not asked for is empty.
macro_rules! curves {
    ($($doc:literal $name:ident $column:ident;)*) => {
        impl Observation {
            $(#[doc = $doc]
            pub fn $name(&self) -> &[f64] {
                self.columns.column(Column::$column).unwrap_or_default()
            })*
        }
    };
}

curves! {
    "Nodes r = x, m." radii Radius;
    "f₀, m." unworn Unworn;
    "f, m." profile Profile;
    "f − f₀, m." wear Wear;
    "g, m." profile_1d Profile1d;
    "q_z, N/m." normal_load NormalLoad;
    "q_x, N/m." tangential_load TangentialLoad;
    "u_x of the springs, m." spring SpringShift;
    "p, Pa." pressure Pressure;
    "τ, Pa." shear Shear;
    "u_x(r) of the surface, m." surface Shift;
}

impl Observation {
    /// Returns the worn depth f − f₀ at the radius `r`, m, with the interpolation of the transforms; needs
    /// [`Curves::PROFILE`].
    pub fn worn_depth_at(&self, r: f64) -> f64 {
        // Between nodes the interpolant may dip slightly below zero.
        worn::interpolate(&self.grid, self.wear(), r).max(0.0)
    }

    /// Returns the springs' load on a half-space of Poisson's ratio `poisson`, from which its stresses follow; needs
    /// [`Curves::SPRINGS`], otherwise the load is zero.
    pub fn spring_load(&self, poisson: f64) -> SpringLoad {
        let [of_normal, of_tangential] = self.domes;
        let normal = (self.normal_load(), of_normal);
        let tangential = (self.tangential_load(), of_tangential);
        let [nodes, normal, tangential] = scar_end::divided(self.radii(), [normal, tangential]);
        let radius = self.moment.contact_radius;
        SpringLoad::new(&nodes, &normal, &tangential, radius, poisson).with_geometry(self.geometry)
    }
}

impl Observation {
    /// Returns the worn depths of the indenter and of the half-space at the node `j`, m, if the indenter takes `share`
    /// of the wear. Their sum is the worn depth.
    pub fn wear_of_bodies(&self, share: f64, j: usize) -> [f64; 2] {
        let indenter = share * self.wear()[j];
        [indenter, self.wear()[j] - indenter]
    }
}

impl Simulation {
    /// Returns the scalars of the present moment.
    pub fn moment(&self) -> Moment {
        let (state, contact) = (self.state(), &self.state().contact);
        let wear_volume = self.wear_volume();
        let residual =
            1.0 - (wear_volume - state.ledger.unexplained_volume) / state.ledger.expected_volume;
        Moment {
            cycle: state.cycle,
            time: state.cycle * self.setup().drive.period(),
            depth: contact.depth,
            shift: contact.shift,
            rig_displacement: (self.setup().drive.rig_compliance() > 0.0).then(|| {
                let force = contact.tangential_force(self.model());
                sensed(self.setup(), contact.shift, force)
            }),
            normal_force: contact.normal_force(self.model()),
            tangential_force: contact.tangential_force(self.model()),
            contact_radius: contact.normal.radius,
            stick_radius: contact.stick_radius,
            permanent_stick_radius: contact
                .stick_radius
                .map(|stick| state.permanent_stick_radius().min(stick)),
            wear_volume,
            initial_volume: state.ledger.initial_volume,
            dissipated_energy: state.ledger.dissipated_energy,
            energy_residual: (state.ledger.expected_volume > 0.0).then_some(residual),
            stability_margin: (state.last.stiffness > 0.0)
                .then(|| stability::limit(self.setup().scheme) / state.last.stiffness),
        }
    }

    /// Returns 1 − ∫p dA/F_z with the `pressure` p (Pa) of the present moment: the 3D side against the springs of the
    /// 1D side. `None` without load. p is linear in r² between nodes and falls like a root towards the edge, except for
    /// a dome's pressure, which is uniform.
    pub fn force_residual(&self, pressure: &[f64]) -> Option<f64> {
        let contact = &self.state().contact.normal;
        let force = self.state().contact.normal_force(self.model());
        if force <= 0.0 || contact.nodes == 0 {
            return None;
        }
        let nodes = self.setup().grid.nodes();
        let last = contact.nodes - 1;
        let geometry = self.setup().geometry;
        let inside = geometry.area_integral(&nodes[..=last], &pressure[..=last]);
        let ring = match geometry {
            Geometry::Round => {
                let ring = (contact.radius - nodes[last]) * (contact.radius + nodes[last]);
                std::f64::consts::PI * ring
            }
            Geometry::Line { .. } => geometry.area(contact.radius - nodes[last]),
        };
        let load = &self.state().contact.load;
        let even = load.dome.map_or(0.0, |dome| dome.stress());
        let edge = ring * (even + 2.0 / 3.0 * (pressure[last] - even));
        Some(1.0 - (inside + edge) / force)
    }

    /// Observes the present moment with the requested `curves`.
    pub fn observe(&self, curves: Curves) -> Observation {
        let (model, contact) = (self.model(), &self.state().contact);
        let nodes = model.nodes();
        let with_springs = model.springs() > 0;
        // If the scene has no springs, they carry nothing.
        let or_zero = |values: &[f64]| {
            if with_springs {
                values.to_vec()
            } else {
                vec![0.0; nodes]
            }
        };
        let modulus = self.setup().material.tangential_modulus();
        let with_loads = curves.intersects(Curves::SPRINGS);
        let worn = || -> Vec<f64> {
            let unworn = model.unworn.iter();
            unworn.zip(&self.state().wear).map(|(f, w)| f + w).collect()
        };
        let moment = self.moment();
        let mut columns = vec![
            (Column::Radius, model.grid.nodes().to_vec()),
            (Column::Unworn, model.unworn.to_vec()),
        ];
        let mut add = |asked: Curves, column: Column, make: &dyn Fn() -> Vec<f64>| {
            if curves.intersects(asked) {
                columns.push((column, make()));
            }
        };
        add(Curves::PROFILE, Column::Profile, &worn);
        add(Curves::PROFILE_1D, Column::Profile1d, &|| self.profile_1d());
        // d − g in contact, 0 elsewhere.
        add(Curves::PROFILE_1D, Column::Compression, &|| {
            let pressed = |g: &f64| (moment.depth - g).max(0.0);
            self.profile_1d().iter().map(pressed).collect()
        });
        add(Curves::SPRINGS, Column::NormalLoad, &|| {
            contact.load.nodal.clone()
        });
        add(Curves::SPRINGS, Column::TangentialLoad, &|| {
            let springs = or_zero(&contact.spring.nodal);
            springs.iter().map(|u| modulus * u).collect()
        });
        add(Curves::PRESSURE, Column::Pressure, &|| self.pressure());
        add(Curves::SHEAR, Column::Shear, &|| {
            let mut out = vec![0.0; nodes];
            if with_springs {
                traction::shear_to_read(model, contact, &mut out);
            }
            out
        });
        add(Curves::SPRINGS, Column::SpringShift, &|| {
            or_zero(&contact.spring.nodal)
        });
        add(Curves::SURFACE, Column::Shift, &|| {
            let mut out = vec![0.0; nodes];
            if with_springs {
                contact.surface_displacement(model, &mut out);
            }
            out
        });
        add(Curves::PROFILE, Column::Wear, &|| self.state().wear.clone());
        let depression = || {
            let mut out = vec![0.0; nodes];
            contact.depression(model, &mut out);
            let (depth, inside, worn) = (contact.depth, contact.normal.nodes, worn());
            // In a line contact the surface is measured from its centre.
            let centre = if self.setup().geometry.is_line() {
                worn[0]
            } else {
                0.0
            };
            for (out, f) in out.iter_mut().zip(worn).take(inside) {
                *out = depth - (f - centre);
            }
            out
        };
        let asks = |curve| curves.contains(curve);
        let header = vec![(Column::Cycle.name().to_owned(), moment.cycle.to_string())];
        Observation {
            moment,
            geometry: self.setup().geometry,
            method: self.setup().method,
            law: self.setup().wear.map(|law| law.name()),
            grid: self.setup().grid.clone(),
            columns: Arc::new(Table::of_columns(header, columns)),
            domes: [
                contact.load.dome.filter(|_| with_loads),
                contact.spring.dome.map(|dome| dome.scaled(modulus)),
            ],
            depression: asks(Curves::DEPRESSION)
                .then(depression)
                .unwrap_or_default(),
            zones: if asks(Curves::ZONES) {
                self.zones()
            } else {
                Vec::new()
            },
        }
    }

    fn zones(&self) -> Vec<Zone> {
        let contact = &self.state().contact;
        let zone = |(j, &load): (usize, &f64)| match contact.spring_state.get(j) {
            _ if load <= 0.0 => Zone::Open,
            Some(SpringState::Forward | SpringState::Backward) => Zone::Slip,
            _ => Zone::Stick,
        };
        contact.load.nodal.iter().enumerate().map(zone).collect()
    }
}
