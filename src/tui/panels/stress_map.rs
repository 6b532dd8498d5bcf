//! The stresses inside the half-space as colours: which one is shown, on which samples, in what shades.

use ratatui::style::Color;

use super::Frame;
use crate::contact::subsurface::{SpringLoad, Stress};
use crate::plot::colormap::ColorMap;
use crate::tui::theme::{Depth, Theme};

/// Shades of a map: few, so that only the lines between them change from frame to frame.
pub const SHADES: usize = 12;

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
            Self::Pressure => Self::Off,
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
            Self::Off => "",
        }
    }

    /// Its value, Pa.
    pub fn of(self, stress: &Stress) -> f64 {
        match self {
            Self::VonMises => stress.von_mises(),
            Self::Principal => stress.max_principal(),
            Self::Shear => stress.max_shear(),
            Self::Pressure => stress.pressure(),
            Self::Off => 0.0,
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

/// What the half-space shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Shown {
    /// Which stress.
    pub quantity: Quantity,
    /// Its largest value in the last cycle instead of the present one.
    pub over_cycle: bool,
}

impl Shown {
    /// The title of the map.
    pub fn name(self) -> String {
        match self.over_cycle {
            true => format!("{}, largest of a cycle", self.quantity.name()),
            false => self.quantity.name().to_owned(),
        }
    }

    /// The loads that the map is made of.
    fn loads(self, frame: &Frame) -> Vec<&SpringLoad> {
        let present = frame.load.as_deref();
        let before = frame.cycle_loads.iter().map(|load| &**load);
        match self.over_cycle {
            true => before.chain(present).collect(),
            false => present.into_iter().collect(),
        }
    }

    /// What the colours must reach, Pa: the largest present value, and for signed stresses that of the
    /// other sign on the axis.
    pub fn extent(self, frame: &Frame) -> Option<[f64; 2]> {
        if self.quantity == Quantity::Off {
            return None;
        }
        let load = frame.load.as_deref()?;
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
        shown: Shown,
        frame: &Frame,
        columns: usize,
        rows: usize,
        size: f64,
    ) -> Option<Self> {
        let loads = shown.loads(frame);
        if shown.quantity == Quantity::Off || loads.is_empty() || columns == 0 {
            return None;
        }
        let mut values = vec![f64::NEG_INFINITY; columns * rows];
        for row in 0..rows {
            let z = (row as f64 + 0.5) * size;
            for column in columns / 2..columns {
                let r = (column as f64 + 0.5 - columns as f64 / 2.0) * size;
                let mirror = columns - 1 - column;
                for load in &loads {
                    let pair = load.mirrored(r, z);
                    for (place, stress) in [column, mirror].into_iter().zip(pair) {
                        let value = &mut values[row * columns + place];
                        *value = value.max(shown.quantity.of(&stress));
                    }
                }
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

/// The shades of values that begin at zero, among the colours of a terminal: its cube has few dark ones, so
/// that the nearest to neighbouring shades would be the same.
const SEQUENTIAL: [u8; SHADES] = [53, 54, 60, 24, 31, 30, 36, 71, 77, 113, 149, 184];

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
        ColorMap::Sequential => SEQUENTIAL[shade],
        ColorMap::Diverging => indexed(map.color(share)),
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
    use crate::tui::theme::Look;

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
            // The two beside zero of a diverging map may share their white.
            let whites = usize::from(map == ColorMap::Diverging);
            assert!(told.len() >= SHADES - whites, "{told:?}");
        }
    }
}
