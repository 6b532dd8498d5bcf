//! The checks of the run, what each means, and the run's errors as estimated from fewer cells and steps.

use ratatui::text::Line;
use ratatui::widgets::Paragraph;

use crate::plot::theme::Role;
use crate::reading::Quantity;
use crate::studies::refinement::Level;
use crate::tui::canvas::Canvas;
use crate::tui::command::Command;
use crate::tui::following::NOTHING_YET;
use crate::tui::frame::Frame;

/// The commands that close the panel, and those that run while it stays open, so that the run can be watched.
pub(super) const CLOSING: &[Command] = &[Command::Back, Command::Accuracy, Command::Accept];
#[rustfmt::skip]
pub(super) const WATCHED: &[Command] = &[
    Command::RunPause, Command::Step, Command::Cycle, Command::Faster, Command::Slower,
];

/// Draws the checks of the run and its errors.
pub(super) fn draw(frame: &Frame, mut canvas: Canvas) {
    let [title, alarm] = [Role::Title, Role::Alarm].map(|role| canvas.style(role));
    let text = |text: &str| Line::raw(format!("   {text}"));
    let error = |value: f64, meaning: &str| text(&format!("{value:9.1e}  {meaning}"));
    let mut lines = vec![Line::styled(" two ways to the same number:", title)];
    if frame.checks.is_empty() {
        lines.push(text(NOTHING_YET));
    }
    lines.extend(frame.checks.iter().map(|check| {
        let line = error(check.error, check.subject.meaning());
        if check.holds() {
            line
        } else {
            line.style(alarm)
        }
    }));
    let estimated = " estimated from the same run on fewer cells and steps:";
    lines.extend([Line::default(), Line::styled(estimated, title)]);
    match &frame.errors {
        _ if frame.live.observation.moment.wear_volume == 0.0 => {
            lines.push(text("nothing has worn"))
        }
        Err(why) => lines.push(text(why)),
        Ok((cycle, of)) => {
            let Level { points, steps, .. } = Level::from_scenario(&frame.live.scenario);
            lines.push(text(&format!(
                "{points} cells, {steps} steps per cycle, to cycle {cycle:.2}"
            )));
            let geometry = frame.live.observation.geometry;
            lines.extend(Quantity::ALL.iter().map(|&number| {
                let name = geometry.term(number.name());
                error(of[number], &format!("error of {name}"))
            }));
        }
    }
    let (title, height) = (
        "accuracy (Esc closes, Tab explains)",
        lines.len() as u16 + 2,
    );
    let mut inside = canvas.popup(title, (76, height));
    inside.show(Paragraph::new(lines));
}

/// Draws what each check compares, what a difference means, and what lies outside the theory.
pub(super) fn draw_explanations(frame: &Frame, mut canvas: Canvas) {
    let warnings = frame.warnings.iter();
    let warnings = warnings.map(|warning| format!("! {warning}"));
    let checks = frame.checks.iter().map(|check| {
        let (name, error) = (check.subject.name(), check.error.abs());
        let verdict = if check.holds() {
            format!("{name}: holds to {error:.1e}")
        } else {
            check.complaint()
        };
        format!("{verdict}. {}", check.subject.explanation())
    });
    let mut lines: Vec<Line> = warnings.chain(checks).map(Line::raw).collect();
    if lines.is_empty() {
        lines.push(Line::raw(NOTHING_YET));
    }
    canvas.page("checks (Esc closes, Tab goes back)", 78, lines);
}
