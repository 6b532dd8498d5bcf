//! A part of the screen, in the colours and characters of the terminal. Panels and overlays draw their texts, rules,
//! boxes, lists and plots with it.

use ratatui::layout::Constraint::{Fill, Length};
use ratatui::prelude::*;
use ratatui::symbols::border;
use ratatui::widgets::{Block, Borders, Clear, List, ListState, Paragraph, Wrap};

use super::line::wrapped;
use crate::plot::theme::{Role, Theme};
use crate::plot::{Chart, Plot};

/// A part of the screen.
pub struct Canvas<'a> {
    /// The look of the terminal.
    pub theme: Theme,
    /// Its area.
    pub area: Rect,
    /// The whole screen.
    pub buffer: &'a mut Buffer,
}

const ASCII_BORDER: border::Set = border::Set {
    top_left: "+",
    top_right: "+",
    bottom_left: "+",
    bottom_right: "+",
    vertical_left: "|",
    vertical_right: "|",
    horizontal_top: "-",
    horizontal_bottom: "-",
};

impl<'a> Canvas<'a> {
    /// Makes a part of the screen that is drawn in `buffer`.
    pub fn new(theme: &Theme, area: Rect, buffer: &'a mut Buffer) -> Self {
        Self {
            theme: *theme,
            area,
            buffer,
        }
    }

    /// Returns another part of the same screen.
    pub fn at(&mut self, area: Rect) -> Canvas<'_> {
        Canvas::new(&self.theme, area, self.buffer)
    }

    /// Returns everything except the first and the last column.
    pub fn indented(&mut self) -> Canvas<'_> {
        self.at(self.area.inner(Margin::new(1, 0)))
    }

    /// Returns the style of a role.
    pub fn style(&self, role: Role) -> Style {
        self.theme.style(role)
    }

    /// Returns a text that this terminal can show.
    pub fn printable(&self, text: &str) -> String {
        self.theme.printable(text)
    }

    /// Draws a widget over the whole area.
    pub fn show(&mut self, widget: impl Widget) {
        widget.render(self.area, self.buffer);
    }

    /// Writes lines, each after a blank.
    pub fn write_text(&mut self, text: &str, role: Role) {
        let line = |line| Line::styled(format!(" {}", self.printable(line)), self.style(role));
        let lines: Text<'static> = text.lines().map(line).collect();
        self.show(lines);
    }

    /// Writes a text in as many rows as it needs; more than one extend upwards.
    fn write_upwards(&mut self, text: &str, role: Role) {
        let text = self.printable(&text.replace('\n', " "));
        let lines = wrapped(&text, usize::from(self.area.width.saturating_sub(2)));
        let more = (lines.len().saturating_sub(1) as u16).min(self.area.y - self.buffer.area.y);
        let (area, style) = (self.area, self.style(role));
        let mut canvas = self.at(Rect::new(
            area.x,
            area.y - more,
            area.width,
            area.height + more,
        ));
        canvas.show(Clear);
        let lines = lines
            .into_iter()
            .map(|line| Line::styled(format!(" {line}"), style));
        canvas.show(Text::from_iter(lines));
    }

    /// Writes the text if there is one, or else keys and what they do: as many of `keys` as fit, and all of `always`.
    pub fn keys<S: AsRef<str>>(
        &mut self,
        message: Option<(&str, Role)>,
        keys: &[[S; 2]],
        always: &[[S; 2]],
    ) {
        if let Some((text, role)) = message {
            return self.write_upwards(text, role);
        }
        let width = |texts: &[S; 2]| -> usize {
            let widths = texts.iter().map(|text| text.as_ref().chars().count() + 1);
            widths.sum()
        };
        let mut left = usize::from(self.area.width).saturating_sub(always.iter().map(width).sum());
        let shown = keys.iter().filter(|texts| {
            let fits = width(texts) <= left;
            left -= if fits { width(texts) } else { 0 };
            fits
        });
        let styles = [Role::Title, Role::Quiet].map(|role| self.style(role));
        let spans = shown.chain(always).flat_map(|texts| {
            let parts = texts.iter().zip(styles);
            parts.map(|(text, style)| Span::styled(format!(" {}", text.as_ref()), style))
        });
        self.show(Line::from_iter(spans));
    }

    /// Writes wrapped text.
    pub fn write<'t>(&mut self, text: impl Into<Text<'t>>) {
        self.show(Paragraph::new(text).wrap(Wrap { trim: true }));
    }

    /// Draws some borders, with a title in the upper one; returns the inside.
    fn framed(&mut self, title: &str, role: Role, borders: Borders) -> Canvas<'_> {
        // Rules are dim; their titles are not.
        let style = self.style(role).remove_modifier(Modifier::DIM);
        let title = format!(" {} ", self.printable(title));
        let mut block = Block::new()
            .borders(borders)
            .border_style(self.style(Role::Faint))
            .title(Span::styled(title, style));
        if self.theme.ascii() {
            block = block.border_set(ASCII_BORDER);
        }
        let inner = block.inner(self.area);
        self.show(block);
        self.at(inner)
    }

    /// Draws a rule with a title; returns the area below it.
    pub fn titled(&mut self, title: &str, role: Role) -> Canvas<'_> {
        self.framed(title, role, Borders::TOP)
    }

    /// Draws a cleared box in the middle, with a title; returns its inside.
    pub fn popup(&mut self, title: &str, size: (u16, u16)) -> Canvas<'_> {
        let area = self.area;
        let (width, height) = (size.0.min(area.width), size.1.min(area.height));
        let (left, top) = ((area.width - width) / 2, (area.height - height) / 2);
        self.area = Rect::new(area.x + left, area.y + top, width, height);
        self.show(Clear);
        self.framed(title, Role::Title, Borders::ALL)
    }

    /// Draws a box at the lower end, so that the part above stays visible.
    pub fn docked(&mut self, title: &str, rows: u16) -> Canvas<'_> {
        let [_, below] = Layout::vertical([Fill(1), Length(rows)]).areas(self.area);
        self.area = below;
        self.popup(title, (100, rows))
    }

    /// Draws a box of wrapped text in the middle, about as high as the text.
    pub fn page(&mut self, title: &str, width: u16, lines: Vec<Line>) {
        let size = (width, rows(&lines, width));
        self.popup(title, size).indented().write(lines);
    }

    /// Writes at the right end of the last row how many entries below are hidden, if any.
    pub fn write_more_below(&mut self, below: usize) {
        if below > 0 && !self.area.is_empty() {
            let text = self.printable(&format!(" {below} more ↓ "));
            let style = self.style(Role::Title);
            let line = Line::styled(text, style);
            let width = (line.width() as u16).min(self.area.width);
            let last = self.area.bottom() - 1;
            self.at(Rect::new(self.area.right() - width, last, width, 1))
                .show(line);
        }
    }

    /// Draws the entries around the one `at`, which has a different style, and a few that follow it.
    pub fn list<'t>(
        &mut self,
        entries: impl IntoIterator<Item = Line<'t>>,
        at: usize,
        style: Style,
    ) {
        let list = List::new(entries).highlight_style(style);
        let rows = usize::from(self.area.height);
        let first = (at + 1 + rows / 3).min(list.len()).saturating_sub(rows);
        let selected = ListState::default().with_selected(Some(at));
        let mut state = selected.with_offset(first);
        let below = list.len().saturating_sub(first + rows);
        StatefulWidget::render(list, self.area, self.buffer, &mut state);
        self.write_more_below(below);
    }

    /// Draws a chart below a rule with its title, with a cursor if there is one.
    pub fn plot(&mut self, chart: &Chart, role: Role, cursor: Option<f64>) {
        let (theme, taken) = (self.theme, self.printable(&chart.title).chars().count());
        let lengths = [Length(taken as u16 + 2), Fill(1)];
        let [_, behind] = Layout::horizontal(lengths).areas(self.area);
        let rule = Rect::new(behind.x, behind.y, behind.width, 1);
        let plot = Plot::new(chart, &theme).cursor(cursor).rule(rule);
        self.titled(&chart.title, role).show(plot);
    }
}

/// Estimates the rows that a box of this width needs for wrapped text.
pub fn rows(lines: &[Line], width: u16) -> u16 {
    let inner = usize::from(width.saturating_sub(10).max(1));
    let rows = lines.iter().map(|line| line.width().div_ceil(inner).max(1));
    2 + rows.sum::<usize>() as u16
}
