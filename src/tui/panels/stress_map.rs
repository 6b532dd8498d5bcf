//! The stresses inside the half-space as colours: which one is shown, in what range, and on which samples.

use std::sync::Arc;

use strum::VariantArray;

use super::*;
use crate::plot::{shades, sticky_bounds};
use crate::reading::fatigue::StressCycle;
use crate::reading::subsurface::{SpringLoad, Stress};

/// Places below the contact, and their depth in contact radii, that set the range of SWT.
const SPANS: u32 = 24;
const SKIN: f64 = 0.03;

/// A stress that the half-space can show, in the order in which a key leads to them.
#[derive(Debug, Clone, Copy, PartialEq, Default, VariantArray)]
enum Quantity {
    #[default]
    Mises,
    Principal,
    Shear,
    Pressure,
    /// The Smith–Watson–Topper stress amplitude of a cycle, which no single moment has.
    Swt,
    /// None: the half-space is a solid body.
    Off,
}

impl Quantity {
    /// Its name, and one for little room.
    fn names(self) -> [&'static str; 2] {
        match self {
            Self::Mises => ["von Mises stress", "von Mises"],
            Self::Principal => ["largest principal stress", "principal"],
            Self::Shear => ["largest shear stress", "shear"],
            Self::Pressure => ["hydrostatic pressure", "pressure"],
            Self::Swt => ["crack parameter SWT of a cycle", "SWT, cycle"],
            Self::Off => ["no stress", ""],
        }
    }

    /// Its value in a moment, Pa, if a moment has one.
    fn of_moment(self) -> Option<fn(&Stress) -> f64> {
        match self {
            Self::Mises => Some(Stress::von_mises),
            Self::Principal => Some(Stress::max_principal),
            Self::Shear => Some(Stress::max_shear),
            Self::Pressure => Some(Stress::pressure),
            Self::Swt | Self::Off => None,
        }
    }
}

/// Values at (r, z) and at (−r, z), Pa.
type Values = Box<dyn Fn(f64, f64) -> [f64; 2]>;

/// What the half-space shows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StressMap {
    /// Which of the quantities.
    shown: Quantity,
    /// Its largest value in the last cycle instead of the present one.
    over_cycle: bool,
    /// The range of the colours, Pa; `None` where nothing is shown.
    pub bounds: Option<[f64; 2]>,
}

impl StressMap {
    /// Shows the next stress.
    pub fn next(&mut self) {
        (self.shown, self.bounds) = (shifted(Quantity::VARIANTS, self.shown, 1), None);
    }

    /// Shows the largest stress of a cycle, or that of the moment.
    pub fn toggle_cycle(&mut self) {
        (self.over_cycle, self.bounds) = (!self.over_cycle, None);
    }

    /// The colours follow the stress as the scales of the plots follow their data.
    pub fn follow(&mut self, frame: &Frame) {
        let colors = self.colors();
        self.bounds = self.extent(frame).map(|extent| {
            let [low, high] = colors.range(extent);
            colors.range(sticky_bounds(self.bounds, low, high))
        });
    }

    /// Its colours.
    pub fn colors(self) -> ColorMap {
        match self.shown {
            Quantity::Principal => ColorMap::Diverging,
            _ => ColorMap::Sequential,
        }
    }

    /// The title of the map, and one for little room.
    pub fn names(self) -> [String; 2] {
        let of_cycle = match self.over_cycle && self.shown != Quantity::Swt {
            true => [", largest of a cycle", ", cycle"],
            false => [""; 2],
        };
        [0, 1].map(|k| format!("{}{}", self.shown.names()[k], of_cycle[k]))
    }

    /// The loads that the map is made of.
    fn loads(self, frame: &Frame) -> Vec<Arc<SpringLoad>> {
        let is_of_cycle = self.over_cycle || self.shown == Quantity::Swt;
        let earlier = frame.cycle_loads.iter().filter(|_| is_of_cycle);
        earlier.chain(&frame.load).cloned().collect()
    }

    /// Returns the values of the map at (r, z) and at (−r, z), Pa; `None` without contact or without a map.
    fn values(self, frame: &Frame) -> Option<Values> {
        let loads = self.loads(frame);
        if loads.is_empty() || self.shown == Quantity::Off {
            return None;
        }
        let Some(of) = self.shown.of_moment() else {
            let cycle = StressCycle::new(loads);
            return Some(Box::new(move |r, z| cycle.mirrored(r, z).map(|at| at.swt)));
        };
        Some(Box::new(move |r, z| {
            let each = loads.iter().map(|load| load.mirrored(r, z));
            each.fold([f64::NEG_INFINITY; 2], |[a, b], [c, d]| {
                [a.max(of(&c)), b.max(of(&d))]
            })
        }))
    }

    /// What the colours must reach, Pa: the largest present value, and for signed stresses that of the
    /// other sign on the axis.
    fn extent(self, frame: &Frame) -> Option<[f64; 2]> {
        let load = frame.load.as_deref()?;
        let a = load.contact_radius();
        if let Some(of) = self.shown.of_moment() {
            let (peak, top) = (load.largest(of).value, of(&load.stress(0.0, 0.05 * a)));
            return Some([top.min(0.0), peak.max(top.abs())]);
        }
        // The largest value is a spike at the surface; colours are for what lies below it.
        let values = self.values(frame)?;
        let below = (0..=SPANS).map(|k| 1.2 * a * f64::from(k) / f64::from(SPANS));
        let top = below.flat_map(|r| values(r, SKIN * a)).fold(0.0, f64::max);
        // Nothing is in tension, or no cycle has been seen yet.
        (top > 0.0).then_some([0.0, top])
    }

    /// Returns the shades on samples: `columns` over x symmetrical about the axis, `rows` downwards from the surface,
    /// both `size` apart (m). `None` without contact, and where no stress is shown.
    pub fn samples(self, frame: &Frame, columns: usize, rows: usize, size: f64) -> Option<Shades> {
        let of = self.values(frame).filter(|_| columns > 0)?;
        let range = self.bounds?;
        let mut shades = vec![0; columns * rows];
        for (row, shades) in shades.chunks_mut(columns).enumerate() {
            let z = (row as f64 + 0.5) * size;
            for column in columns / 2..columns {
                let r = (column as f64 + 0.5 - columns as f64 / 2.0) * size;
                let [right, left] = of(r, z).map(|value| shades::shade(value, range));
                (shades[column], shades[columns - 1 - column]) = (right, left);
            }
        }
        Some(Box::new(move |column, below| {
            shades[below.min(rows - 1) * columns + column]
        }))
    }
}

/// The shade of a stress in a column, this many samples below the surface; the last row continues downwards.
pub type Shades = Box<dyn Fn(usize, usize) -> usize>;
