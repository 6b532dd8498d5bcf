//! The stresses inside the half-space as colours: which one is shown, in what range, and on which samples.

use std::sync::Arc;

use super::*;
use crate::plot::{shades, sticky_bounds};
use crate::reading::fatigue::StressCycle;
use crate::reading::subsurface::{SpringLoad, Stress};

/// Places below the contact, and their depth in contact radii, that set the range of SWT.
const SPANS: u32 = 24;
const SKIN: f64 = 0.03;

/// Where a shown quantity comes from.
#[derive(Debug, Clone, Copy)]
enum Origin {
    /// From a load, Pa; over a cycle its largest value.
    Moment(fn(&Stress) -> f64),
    /// From the loads of a whole cycle: the Smith–Watson–Topper stress amplitude.
    Cycle,
    /// Nothing is shown: the half-space is a solid body.
    Nowhere,
}

/// What the half-space can show, in the order in which a key leads to it: a name, one for little room, the colours.
#[rustfmt::skip]
const QUANTITIES: [([&str; 2], ColorMap, Origin); 6] = [
    (["von Mises stress", "von Mises"], ColorMap::Sequential, Origin::Moment(Stress::von_mises)),
    (["largest principal stress", "principal"], ColorMap::Diverging, Origin::Moment(Stress::max_principal)),
    (["largest shear stress", "shear"], ColorMap::Sequential, Origin::Moment(Stress::max_shear)),
    (["hydrostatic pressure", "pressure"], ColorMap::Sequential, Origin::Moment(Stress::pressure)),
    (["crack parameter SWT of a cycle", "SWT, cycle"], ColorMap::Sequential, Origin::Cycle),
    (["no stress", ""], ColorMap::Sequential, Origin::Nowhere),
];

/// Values at (r, z) and at (−r, z), Pa.
type Values = Box<dyn Fn(f64, f64) -> [f64; 2]>;

/// What the half-space shows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StressMap {
    /// Which of the quantities.
    shown: usize,
    /// Its largest value in the last cycle instead of the present one.
    over_cycle: bool,
    /// The range of the colours, Pa; `None` where nothing is shown.
    pub bounds: Option<[f64; 2]>,
}

impl StressMap {
    /// Shows the next stress.
    pub fn next(&mut self) {
        (self.shown, self.bounds) = ((self.shown + 1) % QUANTITIES.len(), None);
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
        QUANTITIES[self.shown].1
    }

    /// The title of the map, and one for little room.
    pub fn names(self) -> [String; 2] {
        let (names, _, origin) = QUANTITIES[self.shown];
        let of_cycle = match self.over_cycle && !matches!(origin, Origin::Cycle) {
            true => [", largest of a cycle", ", cycle"],
            false => [""; 2],
        };
        [0, 1].map(|k| format!("{}{}", names[k], of_cycle[k]))
    }

    /// Returns the values of the map at (r, z) and at (−r, z), Pa; `None` without contact or without a map.
    fn values(self, frame: &Frame) -> Option<Values> {
        let (_, _, origin) = QUANTITIES[self.shown];
        let is_of_cycle = self.over_cycle || matches!(origin, Origin::Cycle);
        let earlier = frame.cycle_loads.iter().filter(|_| is_of_cycle);
        let loads: Vec<Arc<SpringLoad>> = earlier.chain(&frame.load).cloned().collect();
        match origin {
            _ if loads.is_empty() => None,
            Origin::Moment(of) => Some(Box::new(move |r, z| {
                let each = loads.iter().map(|load| load.mirrored(r, z));
                each.fold([f64::NEG_INFINITY; 2], |[a, b], [c, d]| {
                    [a.max(of(&c)), b.max(of(&d))]
                })
            })),
            Origin::Cycle => {
                let cycle = StressCycle::new(loads);
                Some(Box::new(move |r, z| cycle.mirrored(r, z).map(|at| at.swt)))
            }
            Origin::Nowhere => None,
        }
    }

    /// What the colours must reach, Pa: the largest present value, and for signed stresses that of the
    /// other sign on the axis.
    fn extent(self, frame: &Frame) -> Option<[f64; 2]> {
        let load = frame.load.as_deref()?;
        let a = load.contact_radius();
        if let (_, _, Origin::Moment(of)) = QUANTITIES[self.shown] {
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
