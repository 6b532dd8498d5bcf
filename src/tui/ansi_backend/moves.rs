//! The shortest sequence that moves the cursor.

use ratatui::layout::Position;

use super::sink::{Sink, bytes_of};

/// Moves the cursor from `at`, if that is known, to `goal`.
pub(super) fn move_to(at: Option<Position>, goal: Position, sink: &mut impl Sink) {
    match at {
        Some(at) if at == goal => {}
        Some(at)
            if bytes_of(|count| relative(at, goal, count))
                < bytes_of(|count| absolute(goal, count)) =>
        {
            relative(at, goal, sink);
        }
        _ => absolute(goal, sink),
    }
}

/// The sequence for an absolute position.
fn absolute(goal: Position, sink: &mut impl Sink) {
    sink.text("\x1b[");
    if goal != Position::ORIGIN {
        sink.number(goal.y + 1);
    }
    if goal.x > 0 {
        sink.text(";");
        sink.number(goal.x + 1);
    }
    sink.text("H");
}

/// The way from a known position: down by line feeds (which do not return in raw mode) or up, then
/// along the row.
fn relative(at: Position, goal: Position, sink: &mut impl Sink) {
    match (goal.y.saturating_sub(at.y), at.y.saturating_sub(goal.y)) {
        (down @ 0..=3, 0) => (0..down).for_each(|_| sink.text("\n")),
        (down, 0) => numbered(down, "B", sink),
        // A reverse line feed, which scrolls in the top row only, where it is never sent.
        (_, 1) => sink.text("\x1bM"),
        (_, up) => numbered(up, "A", sink),
    }
    match (goal.x.saturating_sub(at.x), at.x.saturating_sub(goal.x)) {
        (0, 0) => {}
        (0, _) if goal.x == 0 => sink.text("\r"),
        (0, back @ 1..=4) => (0..back).for_each(|_| sink.text("\x08")),
        (0, back) => numbered(back, "D", sink),
        (1, _) => sink.text("\x1b[C"),
        (right, _) => numbered(right, "C", sink),
    }
}

fn numbered(number: u16, end: &str, sink: &mut impl Sink) {
    sink.text("\x1b[");
    sink.number(number);
    sink.text(end);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_way_is_taken() {
        let at = Position::new(40, 12);
        for (goal, expected) in [
            ((40, 12), ""),
            ((41, 12), "\x1b[C"),
            ((45, 12), "\x1b[5C"),
            ((39, 12), "\x08"),
            ((39, 13), "\n\x08"),
            ((39, 11), "\x1bM\x08"),
            ((30, 12), "\x1b[10D"),
            ((0, 13), "\n\r"),
            ((0, 3), "\x1b[4H"),
            ((40, 2), "\x1b[10A"),
            ((0, 0), "\x1b[H"),
            ((70, 30), "\x1b[31;71H"),
        ] {
            let mut way = String::new();
            move_to(Some(at), goal.into(), &mut way);
            assert_eq!(way, expected, "{goal:?}");
        }
        let mut way = String::new();
        move_to(None, at, &mut way);
        assert_eq!(way, "\x1b[13;41H");
    }
}
