//! What lies over the panels: the help, the presets, the accuracy of the run.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Paragraph, Widget};

use super::app::App;
use super::command::{BINDINGS, Binding, Command};
use super::theme::Role;
use super::trust;
use crate::scenario::preset;

/// How far to trust the run: its certificates and the companion.
pub(super) fn accuracy(app: &App, area: Rect, buffer: &mut Buffer) {
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
    if let Some(residual) = frame.observation.moment.energy_residual {
        lines.push(Line::raw(format!(
            "   {residual:9.1e}  V against k E_d over the whole run"
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

/// A cleared box in the middle of `area`, with a title; returns its inside.
fn popup(app: &App, title: &str, size: (u16, u16), area: Rect, buffer: &mut Buffer) -> Rect {
    let (width, height) = (size.0.min(area.width), size.1.min(area.height));
    let place = Rect::new(
        area.x + (area.width - width) / 2,
        area.y + (area.height - height) / 2,
        width,
        height,
    );
    Clear.render(place, buffer);
    let mut block = Block::bordered()
        .border_style(app.theme.style(Role::Quiet))
        .title(format!(" {title} "));
    if app.theme.ascii() {
        block = block.border_set(ASCII_BORDER);
    }
    let inside = block.inner(place);
    block.render(place, buffer);
    inside
}

const ASCII_BORDER: ratatui::symbols::border::Set = ratatui::symbols::border::Set {
    top_left: "+",
    top_right: "+",
    bottom_left: "+",
    bottom_right: "+",
    vertical_left: "|",
    vertical_right: "|",
    horizontal_top: "-",
    horizontal_bottom: "-",
};

/// Commands that share a line of the help where the screen is short.
const PAIRS: [(Command, Command, &str); 7] = [
    (
        Command::Step,
        Command::Cycle,
        "pause and take one step; go on to the end of the cycle",
    ),
    (
        Command::Faster,
        Command::Slower,
        "more, fewer cycles a second, up to as fast as it can",
    ),
    (
        Command::NextMethod,
        Command::PreviousMethod,
        "next, previous transform method; the state is carried over",
    ),
    (
        Command::NextLaw,
        Command::PreviousLaw,
        "next, previous wear law; the state is carried over",
    ),
    (
        Command::NextPanel,
        Command::PreviousPanel,
        "focus the next, previous panel",
    ),
    (Command::Up, Command::Down, "up, down in a list"),
    (
        Command::QuitKeepingScreen,
        Command::Suspend,
        "leave, and leave the last screen behind; shell until fg",
    ),
];

/// The keys and what they do, one command a line, or pairs of commands where `rows` are few.
fn help_lines(rows: u16) -> Vec<(String, &'static str)> {
    let keys = |binding: &Binding| {
        let keys: Vec<String> = binding.keys.iter().map(ToString::to_string).collect();
        keys.join(" ")
    };
    let is_short = usize::from(rows) < BINDINGS.len();
    let of = |command| BINDINGS.iter().find(|binding| binding.command == command);
    let mut lines = Vec::new();
    for binding in BINDINGS {
        let pair = PAIRS
            .iter()
            .find(|(one, other, _)| is_short && [*one, *other].contains(&binding.command));
        match pair {
            None => lines.push((keys(binding), binding.help)),
            Some((one, other, help)) if *one == binding.command => {
                let other = of(*other).map(keys).unwrap_or_default();
                lines.push((format!("{} {other}", keys(binding)), help));
            }
            Some(_) => {}
        }
    }
    lines
}

pub(super) fn help(app: &App, first: u16, area: Rect, buffer: &mut Buffer) {
    let lines: Vec<Line> = help_lines(area.height.saturating_sub(2))
        .into_iter()
        .map(|(keys, help)| {
            Line::from(vec![
                Span::styled(format!(" {keys:>13}  "), app.theme.style(Role::Title)),
                Span::raw(help),
            ])
        })
        .collect();
    let height = lines.len() as u16 + 2;
    let title = if height > area.height {
        "keys (up and down scroll, Esc closes)"
    } else {
        "keys (Esc closes)"
    };
    let inside = popup(app, title, (76, height), area, buffer);
    let first = first.min((lines.len() as u16).saturating_sub(inside.height));
    Paragraph::new(lines)
        .scroll((first, 0))
        .render(inside, buffer);
}

pub(super) fn presets(app: &App, at: usize, area: Rect, buffer: &mut Buffer) {
    let width = preset::ALL
        .iter()
        .map(|preset| preset.name.len())
        .max()
        .unwrap_or(0);
    let lines: Vec<Line> = preset::ALL
        .iter()
        .enumerate()
        .map(|(i, preset)| {
            let text = format!(" {:width$}  {} ", preset.name, preset.title());
            if i == at {
                Line::styled(text, app.theme.style(Role::Focus))
            } else {
                Line::raw(text)
            }
        })
        .collect();
    let height = lines.len() as u16 + 2;
    let inside = popup(
        app,
        "presets (Enter starts, Esc closes)",
        (76, height),
        area,
        buffer,
    );
    let first = (at as u16 + 1).saturating_sub(inside.height);
    Paragraph::new(lines)
        .scroll((first, 0))
        .render(inside, buffer);
}
