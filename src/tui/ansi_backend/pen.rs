//! How cells are written, and the shortest sequence that changes it.

use ratatui::buffer::Cell;
use ratatui::style::{Color, Modifier};

use super::sink::{Sink, bytes_of};

/// Modifiers that the screen uses, with the numbers that set and unset them.
const MODIFIERS: [(Modifier, u16, u16); 5] = [
    (Modifier::BOLD, 1, 22),
    (Modifier::DIM, 2, 22),
    (Modifier::ITALIC, 3, 23),
    (Modifier::UNDERLINED, 4, 24),
    (Modifier::REVERSED, 7, 27),
];

/// Colours and modifiers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Pen {
    pub fg: Color,
    pub bg: Color,
    pub modifier: Modifier,
}

impl Pen {
    /// The pen of a cell.
    pub fn of(cell: &Cell) -> Self {
        Self {
            fg: cell.fg,
            bg: cell.bg,
            modifier: cell.modifier,
        }
    }

    /// Whether a blank written with this pen shows its foreground.
    pub fn inks_blanks(self) -> bool {
        self.modifier
            .intersects(Modifier::REVERSED | Modifier::UNDERLINED)
    }

    /// Whether blanks look the same with both pens.
    pub fn fills_like(self, other: Self) -> bool {
        self.bg == other.bg && !self.inks_blanks() && !other.inks_blanks()
    }

    /// Changes the pen `now`, if that is known, to this one.
    pub fn take(self, now: Option<Self>, sink: &mut impl Sink) {
        if now == Some(self) {
            return;
        }
        let anew = |sink: &mut dyn FnMut(u16)| self.numbers(Self::default(), sink);
        let fresh = bytes_of(|count| sequence(true, &anew, count));
        if let Some(now) = now {
            let change = |sink: &mut dyn FnMut(u16)| self.numbers(now, sink);
            let mut is_empty = true;
            change(&mut |_| is_empty = false);
            // No number at all would be read as a reset.
            if !is_empty && bytes_of(|count| sequence(false, &change, count)) <= fresh {
                return sequence(false, &change, sink);
            }
        }
        sequence(true, &anew, sink);
    }

    /// Passes `tell` the numbers that lead from the pen `now` to this one.
    fn numbers(self, now: Self, tell: &mut dyn FnMut(u16)) {
        let removed = now.modifier - self.modifier;
        let mut added = self.modifier - now.modifier;
        let mut last = 0;
        for (modifier, _, unset) in MODIFIERS {
            if removed.contains(modifier) && last != unset {
                tell(unset);
                last = unset;
            }
        }
        // Bold and dim are unset together: what stays of them is set again.
        let weights = Modifier::BOLD | Modifier::DIM;
        if removed.intersects(weights) {
            added |= self.modifier & weights;
        }
        for (modifier, set, _) in MODIFIERS {
            if added.contains(modifier) {
                tell(set);
            }
        }
        if now.fg != self.fg {
            color(self.fg, 30, tell);
        }
        if now.bg != self.bg {
            color(self.bg, 40, tell);
        }
    }
}

/// Writes the numbers that `tell` passes on as a sequence, with or without a reset first.
fn sequence(reset: bool, tell: &impl Fn(&mut dyn FnMut(u16)), sink: &mut impl Sink) {
    sink.text("\x1b[");
    let mut separator = if reset { ";" } else { "" };
    tell(&mut |number| {
        sink.text(separator);
        sink.number(number);
        separator = ";";
    });
    sink.text("m");
}

/// Passes `tell` the numbers of a colour, `base` being that of black: 30 for ink, 40 for ground.
fn color(color: Color, base: u16, tell: &mut dyn FnMut(u16)) {
    let bright = base + 60;
    tell(match color {
        Color::Reset => base + 9,
        Color::Black => base,
        Color::Red => base + 1,
        Color::Green => base + 2,
        Color::Yellow => base + 3,
        Color::Blue => base + 4,
        Color::Magenta => base + 5,
        Color::Cyan => base + 6,
        Color::Gray => base + 7,
        Color::DarkGray => bright,
        Color::LightRed => bright + 1,
        Color::LightGreen => bright + 2,
        Color::LightYellow => bright + 3,
        Color::LightBlue => bright + 4,
        Color::LightMagenta => bright + 5,
        Color::LightCyan => bright + 6,
        Color::White => bright + 7,
        Color::Indexed(index) => {
            return [base + 8, 5, u16::from(index)].into_iter().for_each(tell);
        }
        Color::Rgb(red, green, blue) => {
            let parts = [red, green, blue].map(u16::from);
            return [base + 8, 2].into_iter().chain(parts).for_each(tell);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_difference_is_written_unless_a_reset_is_shorter() {
        let pen = |fg, modifier| Pen {
            fg,
            modifier,
            ..Pen::default()
        };
        let (none, bold) = (Modifier::empty(), Modifier::BOLD);
        for (now, next, expected) in [
            (None, Pen::default(), "\x1b[m"),
            (None, pen(Color::Red, bold), "\x1b[;1;31m"),
            (Some(pen(Color::Red, none)), pen(Color::Red, none), ""),
            (
                Some(pen(Color::Red, none)),
                pen(Color::Green, none),
                "\x1b[32m",
            ),
            (Some(pen(Color::Red, none)), Pen::default(), "\x1b[m"),
            (
                Some(pen(Color::Red, bold)),
                pen(Color::Indexed(178), bold),
                "\x1b[38;5;178m",
            ),
            (
                Some(pen(Color::Red, bold | Modifier::DIM)),
                pen(Color::Red, bold),
                "\x1b[22;1m",
            ),
        ] {
            let mut sequence = String::new();
            next.take(now, &mut sequence);
            assert_eq!(sequence, expected, "{now:?} {next:?}");
        }
    }
}
