//! Mouse handling (`--mouse`): a click focuses a panel, moves the cursor or travels along the timeline, a double click
//! zooms, the wheel scrolls overlays.

use std::time::{Duration, Instant};

use ratatui::layout::Position;

/// Maximum time between the clicks of a double click.
const TOGETHER: Duration = Duration::from_millis(400);

/// A mouse gesture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gesture {
    /// A press of the left button.
    Click(Position),
    /// A second press right after the first.
    DoubleClick(Position),
    /// The wheel turned away from the user.
    WheelUp,
    /// The wheel turned towards the user.
    WheelDown,
}

/// Distinguishes single from double clicks.
#[derive(Debug, Default)]
pub struct Mouse {
    /// Time and place of the last click, and the number of clicks that belong together with it.
    last: Option<(Instant, Position, u32)>,
}

impl Mouse {
    /// Combines a gesture at `now` with earlier ones; returns `None` for a third click.
    pub fn combine(&mut self, gesture: Gesture, now: Instant) -> Option<Gesture> {
        let Gesture::Click(at) = gesture else {
            return Some(gesture);
        };
        let before = match self.last {
            Some((then, place, count)) if place == at && now - then < TOGETHER => count,
            _ => 0,
        };
        self.last = Some((now, at, before + 1));
        match before {
            0 => Some(Gesture::Click(at)),
            1 => Some(Gesture::DoubleClick(at)),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clicks_belong_together_by_place_and_time() {
        let mut mouse = Mouse::default();
        let start = Instant::now();
        let [here, there] = [Position::new(3, 4), Position::new(5, 4)];
        for (after, place, expected) in [
            (0, here, Some(Gesture::Click(here))),
            (300, here, Some(Gesture::DoubleClick(here))),
            (500, here, None),
            (1000, here, Some(Gesture::Click(here))),
            (1100, there, Some(Gesture::Click(there))),
            (1200, there, Some(Gesture::DoubleClick(there))),
            (1250, here, Some(Gesture::Click(here))),
        ] {
            let now = start + Duration::from_millis(after);
            assert_eq!(
                mouse.combine(Gesture::Click(place), now),
                expected,
                "after {after} ms"
            );
        }
    }
}
