//! What the focused panel shows: a few sentences, its symbols, and what to look for in this scenario.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget, Wrap};

use super::{Answer, App, Command, popup};
use crate::plot::units::to_ascii;
use crate::tui::theme::Role;
use crate::tui::tour;

/// Handles a command while the explanation is open: it follows the focus, and the run can continue.
pub(super) fn answer(command: Command) -> Answer {
    match command {
        Command::Accept | Command::Back => Answer::Close,
        Command::NextPanel
        | Command::PreviousPanel
        | Command::NextPage
        | Command::Left
        | Command::Right
        | Command::Up
        | Command::Down
        | Command::RunPause
        | Command::Step
        | Command::Cycle => Answer::Meanwhile(command),
        other => Answer::Through(other),
    }
}

pub(super) fn draw(app: &App, area: Rect, buffer: &mut Buffer) {
    let words = app.focus.words();
    let theme = &app.theme;
    let spelled = |text: &str| match theme.ascii() {
        true => to_ascii(text).into_owned(),
        false => text.to_owned(),
    };
    let mut lines = vec![Line::raw(spelled(words.text)), Line::default()];
    lines.extend(words.symbols.iter().map(|(symbol, meaning)| {
        Line::from(vec![
            Span::styled(format!("{:<12}", spelled(symbol)), theme.style(Role::Title)),
            Span::raw(spelled(meaning)),
        ])
    }));
    let origin = app.frame.as_ref().map_or("", |frame| frame.origin.as_str());
    let captions = tour::captions(origin).iter();
    let here: Vec<&str> = captions
        .filter(|caption| caption.panel() == Some(app.focus))
        .map(|caption| caption.text.as_str())
        .collect();
    if !here.is_empty() {
        lines.push(Line::default());
        lines.push(Line::styled("In this scenario", theme.style(Role::Title)));
        lines.extend(here.iter().map(|text| Line::raw(spelled(text))));
    }
    let width = area.width.min(80);
    let inner = usize::from(width.saturating_sub(4).max(1));
    let rows: usize = lines
        .iter()
        .map(|line| line.width().div_ceil(inner.saturating_sub(6).max(1)).max(1))
        .sum();
    let title = format!("{} (Tab: next panel, Esc closes)", app.focus.title());
    let inside = popup(app, &title, (width, rows as u16 + 2), area, buffer);
    let inside = Rect {
        x: inside.x + 1,
        width: inside.width.saturating_sub(2),
        ..inside
    };
    Paragraph::new(lines)
        .wrap(Wrap { trim: false })
        .render(inside, buffer);
}
