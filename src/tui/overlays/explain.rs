//! Explains the focused panel: a few sentences, its symbols, and what to look for in this scenario.

use ratatui::layout::Constraint::{Fill, Length};
use ratatui::layout::{Layout, Rect};
use ratatui::text::{Line, Span};

use crate::charts::About;
use crate::plot::theme::Role;
use crate::tui::canvas::{Canvas, rows};
use crate::tui::command::Command;
use crate::tui::explorer::Explorer;
use crate::tui::stage::Stage;
use crate::tui::tour;

/// The commands that close the explanation, and those that run while it is open: it follows the focus, and the run can
/// continue.
pub(super) const CLOSING: &[Command] = &[Command::Accept, Command::Back];
#[rustfmt::skip]
pub(super) const WATCHED: &[Command] = &[
    Command::NextPanel, Command::PreviousPanel, Command::NextPage, Command::Left, Command::Right, Command::Up,
    Command::Down, Command::RunPause, Command::Step, Command::Cycle,
];

/// Returns the larger area above or below the focused panel; the whole area if the panel is zoomed.
fn free_area(stage: &Stage, area: Rect) -> Rect {
    let mut places = stage.places(area).into_iter();
    let focused = places.find(|(panel, _)| *panel == stage.focus && !stage.zoomed);
    let Some((_, place)) = focused else {
        return area;
    };
    let rows = [Length(place.y - area.y), Length(place.height), Fill(1)];
    let [above, _, below] = Layout::vertical(rows).areas(area);
    let larger = [above, below].into_iter().max_by_key(|part| part.height);
    larger.filter(|part| !part.is_empty()).unwrap_or(area)
}

pub(super) fn draw(explorer: &Explorer, mut canvas: Canvas) {
    let (theme, area) = (canvas.theme, canvas.area);
    let focus = explorer.stage.focus;
    let About {
        title,
        text,
        symbols,
        ..
    } = *focus.recipe();
    let geometry = explorer.frame.live.observation.geometry;
    let spelled = |text: &str| theme.printable(&geometry.term(text));
    let mut lines = vec![Line::raw(spelled(text)), Line::default()];
    lines.extend(symbols.iter().map(|(symbol, meaning)| {
        Line::from(vec![
            Span::styled(
                format!("{:<11} ", spelled(symbol)),
                theme.style(Role::Title),
            ),
            Span::raw(spelled(meaning)),
        ])
    }));
    let captions = tour::captions(explorer.origin()).iter();
    let mut here = captions.filter(|caption| caption.panel() == Some(focus));
    if let Some(first) = here.next() {
        let heading = Line::styled("In this scenario", theme.style(Role::Title));
        lines.extend([Line::default(), heading, Line::raw(spelled(&first.text))]);
        lines.extend(here.map(|caption| Line::raw(spelled(&caption.text))));
    }
    let width = area.width.min(80);
    // If the full text would cover the panel, it is shortened to running text without the captions.
    let mut place = free_area(&explorer.stage, area);
    if rows(&lines, width) > place.height {
        let symbols = symbols
            .iter()
            .map(|(symbol, meaning)| format!("{symbol}: {meaning}"));
        let symbols = symbols.collect::<Vec<_>>().join("; ");
        let brief = vec![Line::raw(spelled(text)), Line::raw(spelled(&symbols))];
        if rows(&brief, width) <= place.height {
            lines = brief
        } else {
            place = area
        }
    }
    let title = format!("{} (Tab: next panel, Esc closes)", spelled(title));
    canvas.at(place).page(&title, width, lines);
}
