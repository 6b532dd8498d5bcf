//! The stresses inside the half-space as colours: which of them is shown, in what range, and at which points.

use std::cell::RefCell;
use std::iter::zip;
use std::rc::Rc;
use std::sync::Arc;

use crate::math::scan::{self};
use crate::plot::colormap::ColorMap;
use crate::plot::shades;
use crate::plot::units::format_value;
use crate::reading::fatigue::StressCycle;
use crate::reading::subsurface::{SpringLoad, Stress};
use crate::tui::frame::Frame;
use crate::tui::held::Held;

/// The number of points across and down that set the range of the colours, and their extent in contact radii.
const PLACES: u32 = 14;
const REACH: f64 = 1.2;

/// The source of a shown quantity.
#[derive(Debug, Clone, Copy)]
enum Origin {
    /// From a load, Pa; over a cycle, the largest value.
    Moment(fn(&Stress) -> f64),
    /// From the loads of a whole cycle: the Smith–Watson–Topper stress amplitude.
    Cycle,
    /// Nothing is shown: the half-space is a solid body.
    Nowhere,
}

/// The quantities that the half-space can show, in the order of the key: a name, a short name, and the colours.
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

/// Returns the largest value under several loads.
fn values_of(loads: Vec<Arc<SpringLoad>>, of: fn(&Stress) -> f64) -> Values {
    Box::new(move |r, z| {
        let each = loads.iter().map(|load| load.mirrored(r, z));
        each.fold([f64::NEG_INFINITY; 2], |[a, b], [c, d]| {
            [a.max(of(&c)), b.max(of(&d))]
        })
    })
}

/// What the half-space shows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StressMap {
    /// The index of the shown quantity.
    shown: usize,
    /// Whether to show its largest value in the last cycle instead of the present one.
    over_cycle: bool,
    /// The range of the colours, Pa; `None` if nothing is shown.
    held: Option<Held>,
    /// Whether stresses were below or above that range since it was last checked.
    beyond: [bool; 2],
}

impl StressMap {
    /// Shows the next stress.
    pub fn next(&mut self) {
        self.shown = (self.shown + 1) % QUANTITIES.len();
        self.forget_range();
    }

    /// Toggles between the largest stress of a cycle and the present stress.
    pub fn toggle_cycle(&mut self) {
        self.over_cycle ^= true;
        self.forget_range();
    }

    /// Drops the range before another stress or another run is shown.
    pub fn forget_range(&mut self) {
        self.held = None;
    }

    /// Returns the range of the colours, Pa; `None` if nothing is shown.
    pub fn bounds(self) -> Option<[f64; 2]> {
        Some(self.colors().range(self.held?.bounds))
    }

    /// Returns the ends of the range as text, marked if stresses lie beyond them.
    pub fn ends(self) -> Option<[String; 2]> {
        let [low, high] = self.bounds()?.map(|end| format_value(end, "Pa", 3));
        let mark = |is_beyond, sign: &str, end| {
            if is_beyond {
                format!("{sign} {end}")
            } else {
                end
            }
        };
        let [below, above] = self.beyond;
        Some([mark(below, "≤", low), mark(above, "≥", high)])
    }

    /// Updates the range of the colours, which follows the stress as the scales of plots follow their data.
    pub fn follow(&mut self, frame: &Frame) {
        let (cycle, before) = (frame.live.observation.moment.cycle, self.held);
        // Without contact, the range stays the same.
        let Some(([low, high], range)) = self.extent(frame) else {
            return;
        };
        let held = self.held.get_or_insert_with(|| Held::new(range, cycle));
        held.include(range, cycle);
        if before.is_none_or(|before| before.since != held.since || before.bounds != held.bounds) {
            self.beyond = [false; 2];
        }
        if let Some(bounds) = self.bounds() {
            self.beyond[0] |= low < bounds[0] && self.colors() == ColorMap::Diverging;
            self.beyond[1] |= high > bounds[1];
        }
    }

    /// Returns its colours.
    pub fn colors(self) -> ColorMap {
        QUANTITIES[self.shown].1
    }

    /// Returns the title of the map, and a shorter one for little room.
    pub fn names(self) -> [String; 2] {
        let (names, _, origin) = QUANTITIES[self.shown];
        let of_cycle = if self.over_cycle && !matches!(origin, Origin::Cycle) {
            [", largest of a cycle", ", cycle"]
        } else {
            [""; 2]
        };
        [0, 1].map(|k| format!("{}{}", names[k], of_cycle[k]))
    }

    /// The loads whose stresses are shown.
    fn loads(self, frame: &Frame) -> Vec<Arc<SpringLoad>> {
        let is_of_cycle = self.over_cycle || matches!(QUANTITIES[self.shown].2, Origin::Cycle);
        let earlier = frame.cycle_loads.iter().filter(|_| is_of_cycle);
        earlier.chain(&frame.load).cloned().collect()
    }

    /// Returns the values of the map at (r, z) and at (−r, z), Pa; `None` without contact or without a map.
    fn values(self, loads: Vec<Arc<SpringLoad>>) -> Option<Values> {
        match QUANTITIES[self.shown].2 {
            _ if loads.is_empty() => None,
            Origin::Moment(of) => Some(values_of(loads, of)),
            Origin::Cycle => {
                let cycle = StressCycle::new(loads);
                Some(Box::new(move |r, z| cycle.mirrored(r, z).map(|at| at.swt)))
            }
            Origin::Nowhere => None,
        }
    }

    /// Returns the smallest and the largest stress, Pa, and the range that the colours must cover. Larger values in a
    /// small part of the picture, under an edge or at a border of stick, do not count.
    fn extent(self, frame: &Frame) -> Option<([f64; 2], [f64; 2])> {
        let load = frame.load.as_deref()?;
        let (values, mut largest) = match QUANTITIES[self.shown].2 {
            Origin::Nowhere => return None,
            Origin::Cycle => (self.values(self.loads(frame))?, 0.0),
            Origin::Moment(of) => (
                values_of(vec![frame.load.clone()?], of),
                load.largest(of).value,
            ),
        };
        let step = REACH * load.contact_radius() / f64::from(PLACES);
        let places = (0..PLACES * PLACES).map(|k| [k % PLACES, k / PLACES]);
        let places = places.map(|place| place.map(|at| (f64::from(at) + 0.5) * step));
        let seen: Vec<f64> = places.flat_map(|[r, z]| values(r, z)).collect();
        let lowest = seen.iter().copied().fold(0.0, f64::min);
        largest = seen.iter().copied().fold(largest, f64::max);
        let sizes = seen.iter().map(|value| [value.abs(), 1.0]);
        let top = scan::robust_top(sizes.chain([[largest, 0.1]]));
        // Nothing is in tension, or there has been no complete cycle yet.
        let low = match self.colors() {
            ColorMap::Diverging => -top,
            ColorMap::Sequential => 0.0,
        };
        (top > 0.0).then_some(([lowest, largest], [low, top]))
    }

    /// Returns shares of the range on samples: `columns` over x symmetrical about the axis, `rows` downwards from the
    /// surface, both `size` apart (m). `None` without contact, and where no stress is shown.
    fn samples(
        self,
        loads: Vec<Arc<SpringLoad>>,
        [columns, rows]: [usize; 2],
        size: f64,
    ) -> Option<Vec<f64>> {
        let of = self.values(loads).filter(|_| columns > 0)?;
        let range = self.bounds()?;
        let mut shares = vec![0.0; columns * rows];
        for (row, shares) in shares.chunks_mut(columns).enumerate() {
            let z = (row as f64 + 0.5) * size;
            for column in columns / 2..columns {
                let r = (column as f64 + 0.5 - columns as f64 / 2.0) * size;
                let [right, left] = of(r, z).map(|value| shades::share(value, range));
                (shares[column], shares[columns - 1 - column]) = (right, left);
            }
        }
        Some(shares)
    }
}

/// The samples that were drawn last: they are computed again only for another stress, load or size.
#[derive(Debug, Default)]
pub struct Drawn(RefCell<Option<(SampleInputs, Rc<[f64]>)>>);

/// What samples depend on.
#[derive(Debug)]
struct SampleInputs {
    shown: usize,
    bounds: Option<[f64; 2]>,
    loads: Vec<Arc<SpringLoad>>,
    room: [usize; 2],
    size: f64,
}

impl PartialEq for SampleInputs {
    fn eq(&self, other: &Self) -> bool {
        let [ours, theirs] =
            [self, other].map(|key| (key.shown, key.bounds, key.room, key.size, key.loads.len()));
        ours == theirs && zip(&self.loads, &other.loads).all(|(a, b)| Arc::ptr_eq(a, b))
    }
}

impl Drawn {
    /// Returns the shares of the range that `map` has in a frame, in `[columns, rows]` of samples `size` apart (m). `None`
    /// without contact, and where no stress is shown.
    pub fn shares(
        &self,
        map: StressMap,
        frame: &Frame,
        room: [usize; 2],
        size: f64,
    ) -> Option<Shares> {
        let key = SampleInputs {
            shown: map.shown,
            bounds: map.bounds(),
            loads: map.loads(frame),
            room,
            size,
        };
        let mut drawn = self.0.borrow_mut();
        if drawn.as_ref().is_none_or(|(known, _)| *known != key) {
            *drawn = None;
            let shares = map.samples(key.loads.clone(), room, size)?;
            *drawn = Some((key, shares.into()));
        }
        let (_, shares) = drawn.as_ref()?;
        let (shares, [columns, rows]) = (Rc::clone(shares), room);
        Some(Box::new(move |column, below| {
            shares[below.min(rows - 1) * columns + column]
        }))
    }
}

/// Returns the stress at a column and a row of samples below the surface, as a share of its range; the last row also
/// stands for all below it.
pub type Shares = Box<dyn Fn(usize, usize) -> f64>;
