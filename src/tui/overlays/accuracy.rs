//! The checks of the run, what each means, and the same run on half the cells.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::{Paragraph, Widget};

use super::{App, Command, popup};
use crate::tui::theme::Role;

/// What closes the panel, and what is done while it is open: the run can be watched from here.
pub(super) const CLOSING: &[Command] = &[Command::Back, Command::Accuracy, Command::Accept];
#[rustfmt::skip]
pub(super) const WATCHED: &[Command] = &[
    Command::RunPause, Command::Step, Command::Cycle, Command::Faster, Command::Slower,
];

/// The checks of the run and the refinement check.
pub(super) fn draw(app: &App, area: Rect, buffer: &mut Buffer) {
    let Some(frame) = &app.frame else { return };
    let mut lines = vec![Line::styled(
        " two ways to the same number:",
        app.theme.style(Role::Title),
    )];
    if frame.checks.is_empty() {
        lines.push(Line::raw(
            "   nothing to compare yet: let it run for a cycle",
        ));
    }
    for check in &frame.checks {
        let meaning = check.subject.meaning();
        let line = Line::raw(format!("   {:9.1e}  {meaning}", check.error));
        lines.push(if check.holds() {
            line
        } else {
            line.style(app.theme.style(Role::Alarm))
        });
    }
    lines.push(Line::raw(""));
    lines.push(Line::styled(
        " estimated from the same run on fewer cells and steps:",
        app.theme.style(Role::Title),
    ));
    match &app.refinement_check {
        None => lines.push(Line::raw("   running ...")),
        Some(Err(error)) => lines.push(Line::raw(format!("   {error}"))),
        Some(Ok(check)) => {
            lines.push(Line::raw(format!(
                "   {} cells, {} steps per cycle, to cycle {:.2}, in {:.2} s",
                check.level.points, check.level.steps, check.cycle, check.seconds
            )));
            match &check.error {
                None => lines.push(Line::raw("   nothing has worn")),
                Some(error) => lines.extend(
                    [
                        (
                            error.worn_depth,
                            "error of the worn depth, rms, of its largest",
                        ),
                        (error.volume, "error of the worn volume"),
                        (error.force, "error of F_x"),
                        (error.pressure, "error of p away from borders, rms"),
                    ]
                    .map(|(value, meaning)| Line::raw(format!("   {value:9.1e}  {meaning}"))),
                ),
            }
        }
    }
    let size = (76, lines.len() as u16 + 2);
    let title = "accuracy (Esc closes, Tab explains)";
    let inside = popup(&app.theme, title, size, area, buffer);
    Paragraph::new(lines).render(inside, buffer);
}

/// What each check of the moment compares, and what a difference means; what lies outside the
/// theory.
pub(super) fn draw_explanations(app: &App, area: Rect, buffer: &mut Buffer) {
    let Some(frame) = &app.frame else { return };
    let width = WIDTH - 4;
    let mut lines = Vec::new();
    let mut paragraph = |text: &str| {
        lines.extend(wrapped(text, width).into_iter().map(Line::raw));
    };
    for warning in frame.facts.warnings.iter() {
        paragraph(&format!("! {warning}"));
    }
    for check in &frame.checks {
        let verdict = if check.holds() {
            format!(
                "{}: holds to {:.1e}",
                check.subject.name(),
                check.error.abs()
            )
        } else {
            check.complaint()
        };
        paragraph(&format!("{verdict}. {}", check.subject.explanation()));
    }
    if lines.is_empty() {
        lines.push(Line::raw("nothing to compare yet: let it run for a cycle"));
    }
    let size = (WIDTH as u16, lines.len() as u16 + 2);
    let inside = popup(
        &app.theme,
        "checks (Esc closes, Tab goes back)",
        size,
        area,
        buffer,
    );
    Paragraph::new(lines).render(inside, buffer);
}

/// The width of the page that explains, cells.
const WIDTH: usize = 78;

/// A text in lines of at most `width` characters, those behind the first one indented.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::from(" ")];
    for word in text.split_whitespace() {
        let line = lines.last().map_or(0, |line| line.chars().count());
        if line + word.chars().count() + 1 > width {
            lines.push(String::from("   "));
        }
        if let Some(line) = lines.last_mut() {
            if !line.ends_with(' ') {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines
}
