//! `--present`, for a projector: the contact and one chart, large words, and a pace that begins slowly and increases by
//! itself.

use ratatui::layout::Constraint::{Fill, Length, Min};
use ratatui::prelude::*;

use super::canvas::Canvas;
use super::frame::{Activity, Frame};
use super::panels::{Panel, contact_state};
use crate::plot::Marker;
use crate::plot::theme::Role;

/// The chart shown at first.
pub const CHART: Panel = Panel::Loop;

/// Seconds at each pace before the next one, and the minimum duration of the planned run for another increase.
const SECONDS: f64 = 8.0;
const LEAST: f64 = 40.0;

/// Minimum columns for the chart next to the contact; on a narrower screen it is below.
const WIDE: u16 = 100;

/// Rows of the large words, including a blank one, and the minimum rows of the screen for them.
const WORDS: u16 = 4;
const TALL: u16 = 22;

/// Returns the areas of the contact, the chart and the large words.
pub fn areas(area: Rect) -> [Rect; 3] {
    let words = if area.height >= TALL { WORDS } else { 0 };
    let [above, words] = Layout::vertical([Min(0), Length(words)]).areas(area);
    let [contact, chart] = if area.width >= WIDE {
        Layout::horizontal([Fill(5), Fill(3)])
            .spacing(1)
            .areas(above)
    } else {
        Layout::vertical([Fill(3), Fill(2)]).areas(above)
    };
    [contact, chart, words]
}

/// The pace of the run, cycles per second, and the cycle since which it has this pace.
#[derive(Debug, Default)]
pub struct SpeedUp(Option<(f64, f64)>);

impl SpeedUp {
    /// Whether the run has had its pace long enough to increase it.
    pub fn is_due(&mut self, frame: &Frame, presents: bool) -> bool {
        let cycle = frame.live.observation.moment.cycle;
        let is_running = presents && frame.activity == Activity::Running;
        let since = self
            .0
            .filter(|(pace, began)| is_running && *pace == frame.pace && cycle >= *began);
        let planned = frame.live.scenario.run().cycles.unwrap_or(f64::INFINITY);
        let is_due = since
            .is_some_and(|(pace, began)| planned / pace > LEAST && cycle - began >= SECONDS * pace);
        if is_due || since.is_none() {
            self.0 = Some((frame.pace, cycle));
        }
        is_due
    }
}

/// Draws the state of the contact and the cycle in large letters.
pub fn draw(frame: &Frame, mut canvas: Canvas) {
    let area = canvas.area;
    if area.height < WORDS {
        return;
    }
    let below = Rect::new(area.x + 1, area.y + 1, area.width - 1, area.height - 1);
    let (_, words, role) = contact_state(&frame.live.observation.moment);
    let words = frame.live.observation.geometry.term(words);
    let used = large(&words, role, canvas.at(below));
    let cycle = format!("CYCLE {:.0}", frame.live.observation.moment.cycle.floor());
    let width = 4 * cycle.len() as u16;
    if used + width + 4 < below.width {
        let right = Rect::new(below.right() - width, below.y, width, below.height);
        large(&cycle, Role::Quiet, canvas.at(right));
    }
}

/// Letters of three by five dots. Each octal digit is a row, its dots from left to right.
const LETTERS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-,";
const DOTS: [u16; 39] = [
    0o25755, 0o65656, 0o34443, 0o65556, 0o74647, 0o74644, 0o34553, 0o55755, 0o72227, 0o11152,
    0o55655, 0o44447, 0o57755, 0o65555, 0o25552, 0o65644, 0o25563, 0o65655, 0o34216, 0o72222,
    0o55557, 0o55552, 0o55775, 0o55255, 0o55222, 0o71247, 0o75557, 0o26227, 0o61247, 0o61216,
    0o55711, 0o74616, 0o34652, 0o71222, 0o25252, 0o25316, 0o00002, 0o00700, 0o00024,
];

/// Whether a letter has a dot at a column and a row counted from the top.
fn has_dot(letter: char, column: u16, row: u16) -> bool {
    let dots = LETTERS.find(letter).map_or(0, |at| DOTS[at]);
    row < 5 && dots >> (3 * (4 - row) + 2 - column) & 1 == 1
}

/// Writes `words` in letters four cells wide and three high; returns the number of cells used.
fn large(words: &str, role: Role, canvas: Canvas) -> u16 {
    let (mut x, area, style) = (0, canvas.area, canvas.style(role));
    for letter in words.chars() {
        if x + 4 > area.width + 1 {
            break;
        }
        for (column, row) in (0..3).flat_map(|column| (0..3).map(move |row| (column, row))) {
            let halves = [2 * row, 2 * row + 1].map(|row| has_dot(letter, column, row));
            let sign = Marker::HalfBlock.glyph(u8::from(halves[0]) | u8::from(halves[1]) << 1);
            let cell = canvas.buffer.cell_mut((area.x + x + column, area.y + row));
            if let Some(cell) = cell.filter(|_| halves.contains(&true)) {
                cell.set_char(sign).set_style(style);
            }
        }
        x += 4;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_drawn_in_dots() {
        let drawn = |letter| -> Vec<String> {
            let dots = |row| {
                (0..3).map(move |column| {
                    if has_dot(letter, column, row) {
                        '#'
                    } else {
                        '.'
                    }
                })
            };
            (0..5).map(|row| dots(row).collect()).collect()
        };
        assert_eq!(drawn('A'), [".#.", "#.#", "###", "#.#", "#.#"]);
        assert_eq!(drawn('7'), ["###", "..#", ".#.", ".#.", ".#."]);
        assert_eq!(drawn(' '), ["..."; 5]);
    }
}
