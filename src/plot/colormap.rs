//! Colours of a map: shares of a range as red, green and blue.

use ratatui::style::Color;

/// A colour, red, green and blue.
pub type Rgb = [u8; 3];

/// The terminal's named colours, by number, with their usual RGB values for when the real ones are unknown.
pub const NAMED: [(Color, Rgb); 16] = [
    (Color::Black, [0, 0, 0]),
    (Color::Red, [0xcd, 0x31, 0x31]),
    (Color::Green, [0x0d, 0xbc, 0x79]),
    (Color::Yellow, [0xe5, 0xe5, 0x10]),
    (Color::Blue, [0x24, 0x72, 0xc8]),
    (Color::Magenta, [0xbc, 0x3f, 0xbc]),
    (Color::Cyan, [0x11, 0xa8, 0xcd]),
    (Color::Gray, [0xe5, 0xe5, 0xe5]),
    (Color::DarkGray, [0x66, 0x66, 0x66]),
    (Color::LightRed, [0xf1, 0x4c, 0x4c]),
    (Color::LightGreen, [0x23, 0xd1, 0x8b]),
    (Color::LightYellow, [0xf5, 0xf5, 0x43]),
    (Color::LightBlue, [0x3b, 0x8e, 0xea]),
    (Color::LightMagenta, [0xd6, 0x70, 0xd6]),
    (Color::LightCyan, [0x29, 0xb8, 0xdb]),
    (Color::White, [0xff, 0xff, 0xff]),
];

/// What a terminal of 256 colours shows for an index: the named ones, a cube of 6×6×6, then 24 greys.
pub fn indexed(index: u8) -> Rgb {
    match index {
        0..=15 => NAMED[usize::from(index)].1,
        16..=231 => [36, 6, 1]
            .map(|place| [0, 95, 135, 175, 215, 255][usize::from((index - 16) / place % 6)]),
        232.. => [8 + 10 * (index - 232); 3],
    }
}

/// Which colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColorMap {
    /// Dark to bright, for values that begin at zero.
    Sequential,
    /// Blue through white to red, for values of both signs.
    Diverging,
}

/// The colours of viridis at nine shares.
const SEQUENTIAL: [Rgb; 9] = [
    [68, 1, 84],
    [71, 44, 122],
    [59, 81, 139],
    [44, 113, 142],
    [33, 144, 141],
    [39, 173, 129],
    [92, 200, 99],
    [170, 220, 50],
    [253, 231, 37],
];

/// Blue through white to red at seven shares.
const DIVERGING: [Rgb; 7] = [
    [33, 102, 172],
    [103, 169, 207],
    [209, 229, 240],
    [247, 247, 247],
    [253, 219, 199],
    [239, 138, 98],
    [178, 24, 43],
];

/// The colour at a share of the way, 0 to 1, through `stops` at equal distances.
pub(super) fn between(stops: &[Rgb], share: f64) -> Rgb {
    let last = stops.len() - 1;
    let at = share.clamp(0.0, 1.0) * last as f64;
    let before = (at as usize).min(last - 1);
    mixed(stops[before], stops[before + 1], at - before as f64)
}

/// The colour at a `share` of the way from one to another.
pub fn mixed(from: Rgb, to: Rgb, share: f64) -> Rgb {
    [0, 1, 2].map(|k| {
        let [from, to] = [from[k], to[k]].map(f64::from);
        (from + share * (to - from)).round() as u8
    })
}

impl ColorMap {
    /// Returns the colour at a share of the range, 0 to 1.
    pub fn color(self, share: f64) -> Rgb {
        match self {
            Self::Sequential => between(&SEQUENTIAL, share),
            Self::Diverging => between(&DIVERGING, share),
        }
    }

    /// Returns the range of colours for values from `low` to `high`; diverging colours have white at zero.
    pub fn range(self, [low, high]: [f64; 2]) -> [f64; 2] {
        let size = low.abs().max(high.abs());
        match self {
            _ if !(size > 0.0 && size.is_finite()) => [-1.0, 1.0],
            Self::Diverging => [-size, size],
            Self::Sequential => [low, high],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_zero_have_their_colours() {
        assert_eq!(ColorMap::Sequential.color(0.0), SEQUENTIAL[0]);
        assert_eq!(ColorMap::Sequential.color(2.0), SEQUENTIAL[8]);
        assert_eq!(ColorMap::Diverging.color(0.5), [247, 247, 247]);
        assert_eq!(ColorMap::Diverging.range([-3.0, 1.0]), [-3.0, 3.0]);
        // Brightness rises with the share.
        let light = |share| {
            ColorMap::Sequential
                .color(share)
                .map(u32::from)
                .iter()
                .sum::<u32>()
        };
        assert!((1..=20).all(|k| light(f64::from(k) / 20.0) >= light(f64::from(k - 1) / 20.0)));
    }
}
