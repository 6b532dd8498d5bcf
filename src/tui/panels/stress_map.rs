//! The stresses inside the half-space as colours: which one is shown, on which samples, in what shades.

use std::sync::Arc;

use ratatui::style::Color;

use super::Frame;
use crate::plot::colormap::ColorMap;
use crate::plot::sticky_bounds;
use crate::reading::fatigue::StressCycle;
use crate::reading::subsurface::{SpringLoad, Stress};
use crate::tui::theme::{Depth, Look, Theme};

/// Shades of a map: few, so that only the lines between them change from frame to frame.
pub const SHADES: usize = 12;

/// Places below the contact, and their depth in contact radii, that set the range of SWT.
const SPANS: u32 = 24;
const SKIN: f64 = 0.03;

/// Signs for shades where there are no colours, from low to high.
const SIGNS: [char; SHADES] = [' ', ' ', '.', '.', ':', '-', '=', '+', '*', '#', '%', '@'];

/// Which stress the half-space shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Quantity {
    /// The equivalent stress of von Mises.
    #[default]
    VonMises,
    /// The largest principal stress; positive is tension.
    Principal,
    /// The largest shear stress.
    Shear,
    /// The hydrostatic pressure.
    Pressure,
    /// The Smith–Watson–Topper stress amplitude of the last cycle.
    Swt,
    /// None: the half-space is a solid body.
    Off,
}

impl Quantity {
    /// The one that a key leads to.
    pub fn next(self) -> Self {
        match self {
            Self::VonMises => Self::Principal,
            Self::Principal => Self::Shear,
            Self::Shear => Self::Pressure,
            Self::Pressure => Self::Swt,
            Self::Swt => Self::Off,
            Self::Off => Self::VonMises,
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::VonMises => "von Mises stress",
            Self::Principal => "largest principal stress",
            Self::Shear => "largest shear stress",
            Self::Pressure => "hydrostatic pressure",
            Self::Swt => "crack parameter SWT of a cycle",
            Self::Off => "no stress",
        }
    }

    /// A name for little room.
    pub fn short(self) -> &'static str {
        match self {
            Self::VonMises => "von Mises",
            Self::Principal => "principal",
            Self::Shear => "shear",
            Self::Pressure => "pressure",
            Self::Swt => "SWT, cycle",
            Self::Off => "",
        }
    }

    /// Its value, Pa; 0 for what belongs to no single moment.
    pub fn of(self, stress: &Stress) -> f64 {
        match self {
            Self::VonMises => stress.von_mises(),
            Self::Principal => stress.max_principal(),
            Self::Shear => stress.max_shear(),
            Self::Pressure => stress.pressure(),
            Self::Swt | Self::Off => 0.0,
        }
    }

    /// Its colours.
    pub fn colors(self) -> ColorMap {
        match self {
            Self::Principal => ColorMap::Diverging,
            _ => ColorMap::Sequential,
        }
    }
}

/// Values at (r, z) and at (−r, z), Pa.
type Values = Box<dyn Fn(f64, f64) -> [f64; 2]>;

/// What the half-space shows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StressMap {
    /// Which stress.
    pub quantity: Quantity,
    /// Its largest value in the last cycle instead of the present one.
    pub over_cycle: bool,
    /// The range of the colours, Pa; `None` where nothing is shown.
    pub bounds: Option<[f64; 2]>,
}

impl StressMap {
    /// Shows the next stress.
    pub fn next(&mut self) {
        (self.quantity, self.bounds) = (self.quantity.next(), None);
    }

    /// Shows the largest stress of a cycle, or that of the moment.
    pub fn toggle_cycle(&mut self) {
        (self.over_cycle, self.bounds) = (!self.over_cycle, None);
    }

    /// The colours follow the stress as the scales of the plots follow their data.
    pub fn follow(&mut self, frame: &Frame) {
        let colors = self.quantity.colors();
        self.bounds = self.extent(frame).map(|extent| {
            let [low, high] = colors.range(extent);
            colors.range(sticky_bounds(self.bounds, low, high))
        });
    }

    /// Whether the map is the largest value of a cycle of what each moment has.
    pub fn is_largest_of_cycle(self) -> bool {
        self.over_cycle && self.quantity != Quantity::Swt
    }

    /// The title of the map.
    pub fn name(self) -> String {
        match self.is_largest_of_cycle() {
            true => format!("{}, largest of a cycle", self.quantity.name()),
            false => self.quantity.name().to_owned(),
        }
    }

    /// The loads that the map is made of.
    fn loads(self, frame: &Frame) -> Vec<Arc<SpringLoad>> {
        let present = frame.load.iter();
        match self.over_cycle || self.quantity == Quantity::Swt {
            true => frame.cycle_loads.iter().chain(present).cloned().collect(),
            false => present.cloned().collect(),
        }
    }

    /// Returns the values of the map at (r, z) and at (−r, z), Pa; `None` without contact or without a map.
    fn values(self, frame: &Frame) -> Option<Values> {
        let loads = self.loads(frame);
        match self.quantity {
            _ if loads.is_empty() => None,
            Quantity::Off => None,
            Quantity::Swt => {
                let cycle = StressCycle::new(loads);
                Some(Box::new(move |r, z| cycle.mirrored(r, z).map(|at| at.swt)))
            }
            quantity => Some(Box::new(move |r, z| {
                let each = loads.iter();
                let each = each.map(|load| load.mirrored(r, z).map(|stress| quantity.of(&stress)));
                each.fold([f64::NEG_INFINITY; 2], |[a, b], [c, d]| {
                    [a.max(c), b.max(d)]
                })
            })),
        }
    }

    /// What the colours must reach, Pa: the largest present value, and for signed stresses that of the
    /// other sign on the axis.
    fn extent(self, frame: &Frame) -> Option<[f64; 2]> {
        let load = frame.load.as_deref()?;
        match self.quantity {
            Quantity::Off => return None,
            Quantity::Swt => {
                // The largest value is a spike at the surface; colours are for what lies below it.
                let cycle = StressCycle::new(self.loads(frame));
                let a = load.contact_radius();
                let below = (0..=SPANS).map(|k| 1.2 * a * f64::from(k) / f64::from(SPANS));
                let below = below.flat_map(|r| cycle.mirrored(r, SKIN * a));
                let top = below.map(|at| at.swt).fold(0.0, f64::max);
                // Nothing is in tension, or no cycle has been seen yet.
                return (top > 0.0).then_some([0.0, top]);
            }
            _ => {}
        }
        let peak = load.largest(|stress| self.quantity.of(stress)).value;
        let top = self
            .quantity
            .of(&load.stress(0.0, 0.05 * load.contact_radius()));
        Some([top.min(0.0), peak.max(top.abs())])
    }
}

/// Values on samples: `columns` over x symmetrical about the axis, rows downwards from the surface, both
/// `size` apart (m).
pub struct Samples {
    columns: usize,
    values: Vec<f64>,
}

impl Samples {
    /// Computes them; `None` without contact, or if nothing is to be shown.
    pub fn new(
        shown: StressMap,
        frame: &Frame,
        columns: usize,
        rows: usize,
        size: f64,
    ) -> Option<Self> {
        let of = shown.values(frame).filter(|_| columns > 0)?;
        let mut values = vec![0.0; columns * rows];
        for row in 0..rows {
            let z = (row as f64 + 0.5) * size;
            for column in columns / 2..columns {
                let r = (column as f64 + 0.5 - columns as f64 / 2.0) * size;
                let mirror = columns - 1 - column;
                let [right, left] = of(r, z);
                (
                    values[row * columns + column],
                    values[row * columns + mirror],
                ) = (right, left);
            }
        }
        Some(Self { columns, values })
    }

    /// The value of a column this many samples below the surface; the last row continues downwards.
    pub fn value(&self, column: usize, below: usize) -> f64 {
        let rows = self.values.len() / self.columns;
        self.values[below.min(rows - 1) * self.columns + column]
    }
}

/// The shade of a value between `low` and `high`, from 0.
pub fn shade(value: f64, [low, high]: [f64; 2]) -> usize {
    let share = ((value - low) / (high - low)).clamp(0.0, 1.0);
    ((share * SHADES as f64) as usize).min(SHADES - 1)
}

/// The shades of values that begin at zero, among the colours of a terminal, from the darkest to the brightest:
/// blues, so that the colours of stick, slip and wear stand out, and any kind of colour vision tells them apart.
/// On a light background they begin at the other end.
const SEQUENTIAL: [u8; SHADES] = [17, 18, 24, 25, 31, 32, 38, 74, 80, 116, 152, 195];

/// The shades of values of both signs on a dark background: brighter with the size, and grey at zero, where white
/// would be the brightest of all.
const DIVERGING: [u8; SHADES] = [117, 75, 33, 26, 24, 237, 237, 88, 124, 160, 203, 217];

/// Shades of terminals that have sixteen colours: neighbours share one.
const SIXTEEN: [Color; SHADES] = [
    Color::Blue,
    Color::Blue,
    Color::LightBlue,
    Color::LightBlue,
    Color::Cyan,
    Color::Cyan,
    Color::LightCyan,
    Color::Green,
    Color::LightGreen,
    Color::LightGreen,
    Color::Yellow,
    Color::LightYellow,
];
const SIXTEEN_DIVERGING: [Color; SHADES] = [
    Color::Blue,
    Color::Blue,
    Color::LightBlue,
    Color::LightBlue,
    Color::LightCyan,
    Color::Gray,
    Color::Gray,
    Color::LightYellow,
    Color::LightRed,
    Color::LightRed,
    Color::Red,
    Color::Red,
];

/// The colour of a shade; `None` where the terminal has none.
pub fn color(theme: &Theme, map: ColorMap, shade: usize) -> Option<Color> {
    let shade = shade.min(SHADES - 1);
    let share = (shade as f64 + 0.5) / SHADES as f64;
    let index = match map {
        ColorMap::Sequential if theme.look == Look::Light => SEQUENTIAL[SHADES - 1 - shade],
        ColorMap::Sequential => SEQUENTIAL[shade],
        ColorMap::Diverging if theme.look == Look::Light => indexed(map.color(share)),
        ColorMap::Diverging => DIVERGING[shade],
    };
    let color = match (theme.depth, map) {
        (Depth::Sixteen, ColorMap::Sequential) => SIXTEEN[shade],
        (Depth::Sixteen, ColorMap::Diverging) => SIXTEEN_DIVERGING[shade],
        _ => Color::Indexed(index),
    };
    theme.colored().then_some(color)
}

/// The sign of a shade.
pub fn sign(shade: usize) -> char {
    SIGNS[shade.min(SHADES - 1)]
}

/// The nearest of the 6×6×6 colours and the greys that terminals of 256 colours have.
fn indexed(rgb: [u8; 3]) -> u8 {
    const STEPS: [u8; 6] = [0, 95, 135, 175, 215, 255];
    let distance = |a: [u8; 3]| -> u32 {
        let parts = a.iter().zip(rgb);
        parts.map(|(&a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    let nearest = rgb.map(|part| {
        let steps = 0..STEPS.len();
        steps.min_by_key(|&k| STEPS[k].abs_diff(part)).unwrap_or(0)
    });
    let cube = nearest.map(|k| STEPS[k]);
    let level = rgb.iter().map(|&part| u32::from(part)).sum::<u32>() / 3;
    let step = (level.saturating_sub(3) / 10).min(23) as u8;
    let grey = [8 + 10 * step; 3];
    if distance(grey) < distance(cube) {
        232 + step
    } else {
        let [red, green, blue] = nearest.map(|k| k as u8);
        16 + 36 * red + 6 * green + blue
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Marker;

    #[test]
    fn colours_are_the_nearest_of_the_terminal() {
        assert_eq!(indexed([0, 0, 0]), 16);
        assert_eq!(indexed([255, 255, 255]), 231);
        assert_eq!(indexed([253, 10, 2]), 196);
        assert_eq!(indexed([129, 127, 128]), 244);
    }

    #[test]
    fn shades_fill_the_range() {
        assert_eq!(shade(-1.0, [0.0, 1.0]), 0);
        assert_eq!(shade(0.5, [0.0, 1.0]), SHADES / 2);
        assert_eq!(shade(1.0, [0.0, 1.0]), SHADES - 1);
        for map in [ColorMap::Sequential, ColorMap::Diverging] {
            let theme = Theme::new(Look::Dark, Marker::Braille).with_depth(Depth::Indexed);
            let mut told: Vec<_> = (0..SHADES).map(|k| color(&theme, map, k)).collect();
            told.dedup();
            // The two beside zero of a diverging map share their grey.
            let shared = usize::from(map == ColorMap::Diverging);
            assert_eq!(told.len(), SHADES - shared, "{told:?}");
        }
    }
}
