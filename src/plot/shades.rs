//! Values as shades: colours of the terminal, or characters if it has none.

use ratatui::buffer::Cell;
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Span};

use super::colormap::{ColorMap, NAMED};
use super::theme::{Depth, Look, Theme};

/// How many there are: few, so that only the lines between them change from frame to frame.
pub const SHADES: usize = 12;

/// Signs from low to high: of values that begin with nothing.
pub const SIGNS: [char; SHADES] = [' ', ' ', '.', '.', ':', '-', '=', '+', '*', '#', '%', '@'];

/// The shades of values that begin at zero, among the colours of a terminal, from the darkest to the brightest. They
/// are blues, so that the colours of stick, slip and wear stand out and people with any kind of colour vision can tell
/// them apart. On a light background their order is reversed.
const SEQUENTIAL: [u8; SHADES] = [17, 18, 24, 25, 31, 32, 38, 74, 80, 116, 152, 195];

/// The shades of values of both signs on a dark background: brighter for larger sizes, and grey at zero, where white
/// would be the brightest of all.
const DIVERGING: [u8; SHADES] = [117, 75, 33, 26, 24, 237, 237, 88, 124, 160, 203, 217];

/// The same on a light background: the colours nearest to [`ColorMap::Diverging`].
const DIVERGING_ON_LIGHT: [u8; SHADES] = [67, 68, 110, 152, 254, 255, 255, 224, 223, 216, 167, 131];

/// Shades for terminals with sixteen colours, by number; some neighbours share one.
const SIXTEEN: [u8; SHADES] = [4, 4, 12, 12, 6, 6, 14, 2, 10, 10, 3, 11];
const SIXTEEN_DIVERGING: [u8; SHADES] = [4, 4, 12, 12, 14, 7, 7, 11, 9, 9, 1, 1];

/// Whether the terminal can show blocks and colours.
pub fn has_blocks(theme: &Theme) -> bool {
    theme.colored() && !theme.ascii()
}

/// The shade of a value between `low` and `high`, from 0.
pub fn shade(value: f64, [low, high]: [f64; 2]) -> usize {
    let share = ((value - low) / (high - low)).clamp(0.0, 1.0);
    ((share * SHADES as f64) as usize).min(SHADES - 1)
}

/// The colour of a shade; `None` where the terminal has none.
pub fn color(theme: &Theme, map: ColorMap, shade: usize) -> Option<Color> {
    let is_light = theme.look == Look::Light;
    let number = match (theme.depth, map) {
        (Depth::Sixteen, ColorMap::Sequential) => SIXTEEN[shade],
        (Depth::Sixteen, ColorMap::Diverging) => SIXTEEN_DIVERGING[shade],
        (_, ColorMap::Sequential) if is_light => SEQUENTIAL[SHADES - 1 - shade],
        (_, ColorMap::Sequential) => SEQUENTIAL[shade],
        (_, ColorMap::Diverging) if is_light => DIVERGING_ON_LIGHT[shade],
        (_, ColorMap::Diverging) => DIVERGING[shade],
    };
    let color = match theme.depth {
        Depth::Sixteen => NAMED[usize::from(number)].0,
        Depth::Indexed => Color::Indexed(number),
    };
    has_blocks(theme).then_some(color)
}

/// All shades for a key between its ends, or the `signs` that stand for them where there are no colours.
pub fn key(
    theme: &Theme,
    map: ColorMap,
    signs: [char; SHADES],
    [from, to]: [String; 2],
) -> Line<'static> {
    let shades = (0..SHADES).map(|shade| match color(theme, map, shade) {
        Some(color) => Span::styled(" ", Style::new().bg(color)),
        None => Span::raw(signs[shade].to_string()),
    });
    let from = std::iter::once(Span::raw(from));
    from.chain(shades).chain([Span::raw(to)]).collect()
}

/// Colours the upper and the lower half of a cell; a half without a colour stays unchanged.
pub fn paint_halves(cell: &mut Cell, halves: [Option<Color>; 2]) {
    match halves {
        [None, None] => return,
        [Some(above), None] => cell.set_char('▀').set_fg(above),
        [None, Some(below)] => cell.set_char('▄').set_fg(below),
        [Some(above), Some(below)] => cell.set_char('▀').set_fg(above).set_bg(below),
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Marker;

    /// What a terminal of 256 colours shows: a cube of 6×6×6 colours, then 24 greys.
    fn rgb(index: u8) -> [u8; 3] {
        match index {
            232.. => [8 + 10 * (index - 232); 3],
            _ => [36, 6, 1]
                .map(|place| [0, 95, 135, 175, 215, 255][usize::from((index - 16) / place % 6)]),
        }
    }

    #[test]
    fn shades_on_light_are_the_nearest_to_the_colours_of_the_map() {
        for (shade, &index) in DIVERGING_ON_LIGHT.iter().enumerate() {
            let wanted = ColorMap::Diverging.color((shade as f64 + 0.5) / SHADES as f64);
            let distance = |index: u8| -> u32 {
                let parts = rgb(index).into_iter().zip(wanted);
                parts.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
            };
            let nearest = (16..=255).map(distance).min();
            assert_eq!(Some(distance(index)), nearest, "shade {shade}");
        }
    }

    #[test]
    fn shades_fill_the_range() {
        assert_eq!(shade(-1.0, [0.0, 1.0]), 0);
        assert_eq!(shade(0.5, [0.0, 1.0]), SHADES / 2);
        assert_eq!(shade(1.0, [0.0, 1.0]), SHADES - 1);
        assert_eq!(shade(0.0, [0.0, 0.0]), 0);
        for map in [ColorMap::Sequential, ColorMap::Diverging] {
            for look in [Look::Dark, Look::Light] {
                let theme = Theme::new(look, Marker::Braille).with_depth(Depth::Indexed);
                let mut told: Vec<_> = (0..SHADES).map(|k| color(&theme, map, k)).collect();
                told.dedup();
                // The two shades beside zero in a diverging map share a grey.
                let shared = usize::from(map == ColorMap::Diverging);
                assert_eq!(told.len(), SHADES - shared, "{told:?}");
            }
        }
    }
}
