//! A study on the whole screen: its map, and the point that is opened from it.

use super::Overlay;
use crate::plot::theme::Role;
use crate::tui::canvas::Canvas;
use crate::tui::command;
use crate::tui::explorer::{Explorer, Next};
use crate::tui::keys::{Keystroke, Named};
use crate::tui::map::draw;
use crate::tui::map::live::LiveStudy;
use crate::tui::overlays::answer::Answer;
use crate::tui::worker::Order;

/// The message until a point is open.
pub const OPENING: &str = "opening the point ...";

/// Handles a key. Leaving ends the study, or the explorer if it was opened for the study.
pub(super) fn press(live: &LiveStudy, key: Keystroke, explorer: &mut Explorer) -> Answer {
    match (key, command::of_key(key)) {
        (Keystroke::Char('?'), _) => return Answer::Open(Overlay::MapKeys),
        (Keystroke::Char('q'), _) if live.is_of_file() => explorer.next = Next::Leave,
        // There is nothing that Escape could close.
        (Keystroke::Named(Named::Esc), _) if live.is_of_file() => {}
        (Keystroke::Char('q') | Keystroke::Named(Named::Esc), _) => {
            live.halt();
            return Answer::Close;
        }
        (Keystroke::Named(Named::Enter), _) => {
            match live.with_view(|view| view.slice.results.study.scenario(view.point())) {
                Ok(scenario) => {
                    live.halt();
                    explorer.notice = Some(OPENING.to_owned());
                    explorer.order_with_new_scales(Order::OpenPoint(Box::new(scenario)));
                }
                Err(error) => explorer.notice = Some(error.to_string()),
            }
        }
        _ => live.with_view(|view| view.press(key)),
    }
    Answer::Stay
}

/// Draws the keys of a study.
pub(super) fn draw_keys(mut canvas: Canvas) {
    let lines = draw::ALL_KEYS.map(|[keys, help]| format!("{keys:>12}  {help}"));
    let mut inside = canvas.popup("keys of the map (Esc closes)", (72, lines.len() as u16 + 2));
    inside.write_text(&lines.join("\n"), Role::Quiet);
}

/// Draws the study, with a message for the user if there is one.
pub(super) fn draw(live: &LiveStudy, notice: Option<&str>, canvas: Canvas) {
    live.with_view(|view| draw::draw(view, notice, canvas));
}
