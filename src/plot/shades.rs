//! Values as shades: colours of the terminal, or characters if it has none.

use ratatui::buffer::Cell;
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Span};

use super::colormap::{ColorMap, NAMED, between, indexed};
use super::theme::{Depth, Look, Theme};

/// The number of shades of 256 colours and of signs: few, so that only the lines between them change from frame to
/// frame.
pub const SHADES: usize = 12;

/// The number of shades where a terminal mixes its colours. More look the same, and take more bytes a frame.
const FINE_SHADES: f64 = 36.0;

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

/// The share of the range from `low` to `high` below a value, 0 to 1.
pub fn share(value: f64, [low, high]: [f64; 2]) -> f64 {
    ((value - low) / (high - low)).clamp(0.0, 1.0)
}

/// Returns the index of the shade for a `share` of the range, 0 to 1.
pub fn shade(share: f64) -> usize {
    ((share * SHADES as f64) as usize).min(SHADES - 1)
}

/// The colour at a share of the range; `None` where the terminal has none.
pub fn color(theme: &Theme, map: ColorMap, share: f64) -> Option<Color> {
    let mut shades = match (theme.depth, theme.look, map) {
        (Depth::Sixteen, _, ColorMap::Sequential) => SIXTEEN,
        (Depth::Sixteen, _, ColorMap::Diverging) => SIXTEEN_DIVERGING,
        (_, _, ColorMap::Sequential) => SEQUENTIAL,
        (_, Look::Light, ColorMap::Diverging) => DIVERGING_ON_LIGHT,
        (_, _, ColorMap::Diverging) => DIVERGING,
    };
    if (theme.look, map) == (Look::Light, ColorMap::Sequential) && theme.depth != Depth::Sixteen {
        shades.reverse();
    }
    let number = shades[shade(share)];
    let color = match theme.depth {
        Depth::Sixteen => NAMED[usize::from(number)].0,
        Depth::Indexed => Color::Indexed(number),
        Depth::True => {
            let share = (share * FINE_SHADES).floor() / (FINE_SHADES - 1.0);
            let [red, green, blue] = match (theme.look, map) {
                (Look::Light, ColorMap::Diverging) => map.color(share),
                _ => between(&shades.map(indexed), share),
            };
            Color::Rgb(red, green, blue)
        }
    };
    has_blocks(theme).then_some(color)
}

/// The sign that stands for a share of the range.
pub fn sign(signs: [char; SHADES], share: f64) -> char {
    signs[shade(share)]
}

/// All shades for a key between its ends, or the `signs` that stand for them where there are no colours.
pub fn key(
    theme: &Theme,
    map: ColorMap,
    signs: [char; SHADES],
    [from, to]: [String; 2],
) -> Line<'static> {
    let middles = (0..SHADES).map(|shade| (shade as f64 + 0.5) / SHADES as f64);
    let shades = middles.map(|share| match color(theme, map, share) {
        Some(color) => Span::styled(" ", Style::new().bg(color)),
        None => Span::raw(sign(signs, share).to_string()),
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

    #[test]
    fn shades_on_light_are_the_nearest_to_the_colours_of_the_map() {
        for (shade, &index) in DIVERGING_ON_LIGHT.iter().enumerate() {
            let wanted = ColorMap::Diverging.color((shade as f64 + 0.5) / SHADES as f64);
            let distance = |index: u8| -> u32 {
                let parts = indexed(index).into_iter().zip(wanted);
                parts.map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
            };
            let nearest = (16..=255).map(distance).min();
            assert_eq!(Some(distance(index)), nearest, "shade {shade}");
        }
    }

    #[test]
    fn shades_fill_the_range() {
        let shade_of = |value, range| shade(share(value, range));
        assert_eq!(shade_of(-1.0, [0.0, 1.0]), 0);
        assert_eq!(shade_of(0.5, [0.0, 1.0]), SHADES / 2);
        assert_eq!(shade_of(1.0, [0.0, 1.0]), SHADES - 1);
        assert_eq!(shade_of(0.0, [0.0, 0.0]), 0);
        for map in [ColorMap::Sequential, ColorMap::Diverging] {
            for look in [Look::Dark, Look::Light] {
                let theme = Theme::new(look, Marker::Braille).with_depth(Depth::Indexed);
                let share = |shade: usize| (shade as f64 + 0.5) / SHADES as f64;
                let shades = (0..SHADES).map(|shade| color(&theme, map, share(shade)));
                let mut distinct: Vec<_> = shades.collect();
                distinct.dedup();
                // The two shades next to zero in a diverging map share a grey.
                let shared = usize::from(map == ColorMap::Diverging);
                assert_eq!(distinct.len(), SHADES - shared, "{distinct:?}");
            }
        }
    }

    #[test]
    fn mixed_colours_flow_between_those_of_256() {
        for look in [Look::Dark, Look::Light] {
            let theme = Theme::new(look, Marker::Braille).with_depth(Depth::True);
            let shares = (0..1000).map(|k| f64::from(k) / 999.0);
            let shown = |share| color(&theme, ColorMap::Sequential, share);
            let mut distinct: Vec<_> = shares.map(shown).collect();
            let [Some(&Some(Color::Rgb(r, g, b))), Some(&Some(last))] =
                [distinct.first(), distinct.last()]
            else {
                panic!("no mixed colours");
            };
            let ends = [SEQUENTIAL[0], SEQUENTIAL[SHADES - 1]].map(indexed);
            assert!(ends.contains(&[r, g, b]), "{:?}", distinct[0]);
            assert_ne!(distinct[0], Some(last));
            distinct.dedup();
            assert_eq!(distinct.len(), FINE_SHADES as usize);
        }
    }
}
