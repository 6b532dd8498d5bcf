//! How far to trust the run.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::{Paragraph, Widget};

use super::{Answer, App, Command, popup};
use crate::tui::theme::Role;
use crate::tui::trust;

/// What a command does while the panel is open: the run can be watched from here.
pub(super) fn answer(command: Command) -> Answer {
    match command {
        Command::Back | Command::Accuracy | Command::Accept => Answer::Close,
        Command::RunPause | Command::Step | Command::Cycle | Command::Faster | Command::Slower => {
            Answer::Meanwhile(command)
        }
        other => Answer::Through(other),
    }
}

/// How far to trust the run: its certificates and the companion.
pub(super) fn draw(app: &App, area: Rect, buffer: &mut Buffer) {
    let Some(frame) = &app.frame else { return };
    let mut lines = vec![Line::styled(
        " two ways to the same number:",
        app.theme.style(Role::Title),
    )];
    let certificates = trust::certificates(frame);
    if certificates.is_empty() {
        lines.push(Line::raw(
            "   nothing to compare yet: let it run for a cycle or two",
        ));
    }
    for certificate in &certificates {
        lines.push(Line::raw(format!(
            "   {:9.1e}  {}",
            certificate.error, certificate.meaning
        )));
    }
    lines.push(Line::raw(""));
    lines.push(Line::styled(
        " the same run on half the cells:",
        app.theme.style(Role::Title),
    ));
    match &app.companion {
        None => lines.push(Line::raw("   running ...")),
        Some(Err(error)) => lines.push(Line::raw(format!("   {error}"))),
        Some(Ok(companion)) => {
            let title = format!(
                "   {} cells, to cycle {:.2}, in {:.2} s",
                companion.cells, companion.cycle, companion.seconds
            );
            lines.push(Line::raw(title));
            let [mean, largest] = companion.profile;
            lines.push(Line::raw(format!(
                "   {mean:9.1e}  rms difference of f, in depths; largest {largest:.1e}"
            )));
            if let Some(difference) = companion.stick_radius {
                lines.push(Line::raw(format!(
                    "   {difference:9.1e}  permanent stick radius"
                )));
            }
            if let Some(difference) = companion.wear_volume {
                lines.push(Line::raw(format!("   {difference:9.1e}  worn volume")));
            }
            let estimate = mean / 3.0;
            lines.push(Line::raw(format!(
                "   {estimate:9.1e}  so about this much error of f here, at second order"
            )));
        }
    }
    let size = (76, lines.len() as u16 + 2);
    let inside = popup(app, "accuracy (Esc closes)", size, area, buffer);
    Paragraph::new(lines).render(inside, buffer);
}
