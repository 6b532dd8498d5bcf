//! The screen of a study.
//!
//! ```text
//! map.csv                          1432 of 1600 points   title, how far the study is
//! wear_volume_m3   1.2e-18 ▀▀▀▀▀▀▀▀▀ 3.4e-14             column and its colours
//!  2e-06 ▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀                           two points a cell
//!        ▀▀▀▀▀▀▀▀G▀▀▀▀▀▀▀▀▀▀▀▀                           G: a border in closed form
//!  5e-07 ▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀
//!        1e-08           1e-06   motion.tangential.amplitude
//! G gross slip, closed form   A = 0.2                    what the letters are
//! point 17: motion.normal.mean = 5e-7 ... regime partial what the cursor reads
//! arrows move  Enter open  Tab column  t theory  q quit
//! ```

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::ramp::{self, Shade};
use super::view::{Scaled, View};
use crate::figure::study;
use crate::plot::axis::titled;
use crate::plot::colormap::ColorMap;
use crate::plot::units::{axis_unit, format_number, format_value_in};
use crate::plot::{Axis, Plot, Point, Scale};
use crate::studies::sweep::slice::{self, REGIMES};
use crate::tui::footer;
use crate::tui::shades::{self, has_blocks, paint_halves};
use crate::tui::theme::{Role, Theme};

/// The keys of the footer, as many as fit, and the one that is always there.
const KEYS: [[&str; 2]; 7] = [
    ["arrows", "move"],
    ["Enter", "open"],
    ["Tab", "column"],
    ["L", "log"],
    ["x y", "axes"],
    ["[ ]", "other axes"],
    ["t", "theory"],
];
const QUIT: [&str; 2] = ["q", "quit"];

/// Significant digits of what is read.
const DIGITS: usize = 4;

/// Draws the whole screen.
pub fn draw(view: &View, theme: &Theme, area: Rect, buffer: &mut Buffer) {
    if area.width < 20 || area.height < 10 {
        let text = "too small: needs 20x10 or more";
        return put(buffer, area.x, area.y, text, Style::new(), theme);
    }
    let (there, failed, points) = view.count();
    let failed = match failed {
        0 => String::new(),
        failed => format!(", {failed} failed"),
    };
    let count = format!("{there} of {points} points{failed}");
    let behind = area.width.saturating_sub(count.chars().count() as u16);
    let scaled = view.scaled();
    let overlays = view.overlays();
    let names = overlays.iter();
    let names = names.map(|overlay| format!("{} {}", overlay.letter, overlay.name));
    let here = view.here();
    let here = here.map(|_| format!("{} you are here", here_sign(theme)));
    let names: Vec<String> = names.chain(here).collect();
    let (point, quiet) = (view.point(), theme.style(Role::Quiet));
    let below = area.height - 4;
    let mut write = |row: u16, column: u16, text: &str, style: Style| {
        put(buffer, area.x + column, area.y + row, text, style, theme);
    };
    write(0, 0, &view.name, theme.style(Role::Title));
    write(0, behind, &count, quiet);
    write(below, 0, &names.join("   "), quiet);
    write(below + 1, 0, &place(view, point, theme), Style::new());
    let read = reading(view, point, theme);
    write(below + 2, 0, &read, theme.style(Role::Notice));
    let row = |row: u16| Rect::new(area.x, area.y + row, area.width, 1);
    legend(view, theme, &scaled).render(row(1), buffer);
    let body = Rect::new(area.x, area.y + 2, area.width, area.height - 6);
    match view.slice.y() {
        Some(_) => map(view, theme, &scaled, &overlays, body, buffer),
        None => curve(view, theme, &scaled, body, buffer),
    }
    let (notice, last) = (view.notice.as_deref(), row(area.height - 1));
    footer::draw_line(notice, &KEYS, &[QUIT], theme, last, buffer);
}

/// A point in words: its number and its values.
fn place(view: &View, point: usize, theme: &Theme) -> String {
    let study = &view.slice.study;
    let axes = study.axes.iter().zip(study.places(point));
    let values = axes.map(|(axis, place)| match axis.number(place) {
        Some(number) => in_words(&view.in_words(axis), number, theme),
        None => format!("{} {}", axis.key, axis.text(place)),
    });
    let values: Vec<String> = values.collect();
    format!("point {point}: {}", values.join(", "))
}

/// The values of a point: the column that is shown, the others and the status.
fn reading(view: &View, point: usize, theme: &Theme) -> String {
    let study = &view.slice.study;
    let Some(fields) = view.slice.row(point) else {
        return "not there yet".to_owned();
    };
    let columns = study.columns();
    let read = columns.iter().zip(fields).skip(study.axes.len());
    let (first, others): (Vec<_>, Vec<_>) = read.partition(|(name, _)| **name == view.column());
    let read = first.into_iter().chain(others);
    let read = read.map(|(name, field)| match field.parse() {
        Ok(number) => in_words(&study::quantity(name, &[]), number, theme),
        Err(_) => format!("{name} {field}"),
    });
    read.collect::<Vec<_>>().join("  ")
}

/// A number with the name and the unit of what it is.
fn in_words(of: &Axis, number: f64, theme: &Theme) -> String {
    let value = format_value_in(number, of.unit, DIGITS, theme.ascii());
    format!("{} {value}", of.label)
}

/// The column, and its range or its words in their colours.
fn legend(view: &View, theme: &Theme, scaled: &Scaled) -> Line<'static> {
    let (quantity, quiet) = (&scaled.quantity, theme.style(Role::Quiet));
    let name = match view.is_regime() {
        true => view.column(),
        false => &quantity.label,
    };
    let mut line = Line::from(Span::styled(
        theme.printable(name),
        theme.style(Role::Focus),
    ));
    if view.is_regime() {
        for (at, (_, title)) in REGIMES.iter().enumerate() {
            let shade = Shade::Word(at);
            line.push_span("  ");
            if let Some(color) = shade.color(theme).filter(|_| has_blocks(theme)) {
                line.push_span(Span::styled("█", color));
            }
            line.push_span(format!("{} {title}", shade.sign()));
        }
        return line;
    }
    let Some([low, high]) = scaled.range else {
        return line;
    };
    let unit = axis_unit(high.abs().max(low.abs()), quantity.unit, theme.ascii());
    let value = |value: f64| format_number(value / unit.factor, 3);
    line.push_span(format!("  {} ", value(low)));
    line.extend(shades::key(theme, ColorMap::Sequential, ramp::sign));
    line.push_span(theme.printable(&format!(" {} {}", value(high), unit.text)));
    if quantity.scale == Scale::Log {
        line.push_span(Span::styled("  log", quiet));
    }
    for axis in view.slice.hidden() {
        let (place, axis) = (view.slice.at[axis], &view.slice.study.axes[axis]);
        let text = theme.printable(&format!("  {} = {}", axis.key, axis.text(place)));
        line.push_span(Span::styled(text, quiet));
    }
    line
}

/// Two axes: each point a block of cells, upwards in half cells where there are colours.
fn map(
    view: &View,
    theme: &Theme,
    scaled: &Scaled,
    overlays: &[slice::Line],
    area: Rect,
    buffer: &mut Buffer,
) {
    let (Some(y_axis), x_axis) = (view.slice.y(), view.slice.x()) else {
        return;
    };
    let (last_x, last_y) = (x_axis.count() - 1, y_axis.count() - 1);
    let (y_title, y_labels) = labels(view, y_axis, theme);
    let (x_title, x_labels) = labels(view, x_axis, theme);
    let width = |text: &String| text.chars().count() as u16;
    let margin = y_labels.iter().map(width).max().unwrap_or(0) + 1;
    let plot = Rect::new(
        area.x + margin,
        area.y + 1,
        area.width.saturating_sub(margin + 1),
        area.height.saturating_sub(2),
    );
    if plot.width == 0 || plot.height == 0 {
        return;
    }
    let quiet = theme.style(Role::Quiet);
    let parts = 1 + usize::from(has_blocks(theme));
    let wide = Cells::new(plot.width.into(), last_x + 1);
    let high = Cells::new(usize::from(plot.height) * parts, last_y + 1);
    let rows = high.used.div_ceil(parts);
    // The map stands on its lower edge.
    let floor = plot.y + plot.height;
    let shade = |column: usize, half: usize| {
        let (x, y) = (wide.place(column), high.place(half));
        view.shade(view.slice.point_at(x, y), scaled)
    };
    let at = |column: usize, row: usize| (plot.x + column as u16, floor - 1 - row as u16);
    for row in 0..rows {
        for column in 0..wide.used {
            let cell = &mut buffer[at(column, row)];
            if parts == 1 {
                cell.set_char(shade(column, row).sign());
                continue;
            }
            // Half a cell without a row stays as dark as the terminal.
            let halves = [2 * row + 1, 2 * row].map(|half| {
                let is_there = half < high.used;
                is_there.then(|| shade(column, half).color(theme))?
            });
            paint_halves(cell, halves);
        }
    }
    let mut sign = |place: (u16, u16), sign: char| {
        let cell = &mut buffer[place];
        cell.set_char(sign);
        let style = theme.style(Role::Title);
        cell.set_style(if theme.colored() {
            style.fg(ink_on(cell.bg))
        } else {
            style
        });
    };
    if view.is_regime() && parts == 2 {
        letters(&shade, [&wide, &high], |column, half, letter| {
            sign(at(column, half / parts), letter);
        });
    }
    let dot = if theme.ascii() { '*' } else { '•' };
    let spot = |[x, y]: [f64; 2]| at(wide.middle(x), high.middle(y) / parts);
    for overlay in overlays {
        // A line from crossing to crossing, and its letter at the end.
        for [from, to] in overlay.pieces() {
            let (a, b) = (spot(from), spot(to));
            let steps = a.0.abs_diff(b.0).max(a.1.abs_diff(b.1)).max(1);
            for k in 0..=steps {
                let share = f64::from(k) / f64::from(steps);
                let between = [0, 1].map(|i| from[i] + (to[i] - from[i]) * share);
                sign(spot(between), dot);
            }
        }
        if let Some(&end) = overlay.at.last() {
            sign(spot(end), overlay.letter);
        }
    }
    if let Some((x, y)) = view.here() {
        sign(spot([x, y]), here_sign(theme));
    }
    let (x, y) = view.cursor();
    let cell = &mut buffer[spot([x as f64, y as f64])];
    cell.set_char(if theme.ascii() { 'X' } else { '╳' });
    cell.set_style(Style::reset().add_modifier(Modifier::REVERSED | Modifier::BOLD));
    // The ticks' row is theirs to the last one.
    let x_title = format!("{x_title} {}", if theme.ascii() { '>' } else { '→' });
    let right = plot.right().saturating_sub(width(&x_title));
    let after = area.x + width(&y_title) + 2;
    put(buffer, area.x, area.y, &y_title, quiet, theme);
    put(buffer, right.max(after), area.y, &x_title, quiet, theme);
    let mut below = None;
    for (place, label) in y_labels.iter().enumerate() {
        let row = high.middle(place as f64) / parts;
        if below.is_none_or(|below| row >= below + 2) {
            let x = area.x + margin - 1 - width(label);
            put(buffer, x, floor - 1 - row as u16, label, quiet, theme);
            below = Some(row);
        }
    }
    let mut end = area.x;
    for (place, label) in x_labels.iter().enumerate() {
        let column = plot.x + wide.middle(place as f64) as u16;
        let start = column.saturating_sub(width(label) / 2).max(area.x);
        if start >= end && start + width(label) <= area.right() {
            put(buffer, start, floor, label, quiet, theme);
            end = start + width(label) + 2;
        }
    }
}

/// The colour of signs on a ground: the dark blues of the cube, with which maps begin, hide what is black.
fn ink_on(ground: Color) -> Color {
    match ground {
        Color::Indexed(16..=28) => Color::Indexed(231),
        Color::Blue => Color::White,
        _ => Color::Black,
    }
}

/// The sign of the base scenario.
fn here_sign(theme: &Theme) -> char {
    if theme.ascii() { 'o' } else { '◆' }
}

/// The title of an axis with its unit, and the labels of its places.
fn labels(view: &View, axis: &crate::studies::sweep::Axis, theme: &Theme) -> (String, Vec<String>) {
    let words = view.in_words(axis);
    let numbers: Vec<Option<f64>> = (0..axis.count()).map(|place| axis.number(place)).collect();
    let most = numbers
        .iter()
        .flatten()
        .fold(0.0, |most: f64, value| most.max(value.abs()));
    let unit = axis_unit(most, words.unit, theme.ascii());
    let title = titled(&words.label, &unit.text, ['[', ']']);
    let label = |(place, number): (usize, &Option<f64>)| match number {
        Some(number) => format_number(number / unit.factor, 3),
        None => axis.text(place),
    };
    (title, numbers.iter().enumerate().map(label).collect())
}

/// Gives each regime its letter, in the middle of where it is.
fn letters(
    shade: &impl Fn(usize, usize) -> Shade,
    [wide, high]: [&Cells; 2],
    mut put: impl FnMut(usize, usize, char),
) {
    for word in (0..REGIMES.len()).map(Shade::Word) {
        let columns = 0..wide.used;
        let cells = columns.flat_map(|column| (0..high.used).map(move |half| [column, half]));
        let of: Vec<[usize; 2]> = cells.filter(|at| shade(at[0], at[1]) == word).collect();
        let middle = [0, 1].map(|k| of.iter().map(|at| at[k]).sum::<usize>() / of.len().max(1));
        // The middle of a bent region can lie outside of it.
        let distance = |at: &&[usize; 2]| at[0].abs_diff(middle[0]) + at[1].abs_diff(middle[1]);
        if let Some(&[column, half]) = of.iter().min_by_key(distance) {
            put(column, half, word.sign());
        }
    }
}

/// Places of an axis over a number of cells: each place as many cells as fit, or some cells for
/// several places where they do not.
struct Cells {
    places: usize,
    used: usize,
}

impl Cells {
    fn new(cells: usize, places: usize) -> Self {
        let used = match cells / places {
            0 => cells,
            each => each * places,
        };
        Self { places, used }
    }

    /// The place that a cell shows.
    fn place(&self, cell: usize) -> usize {
        cell * self.places / self.used
    }

    /// The cell in the middle of a place.
    fn middle(&self, place: f64) -> usize {
        let cell = (place + 0.5) / self.places as f64 * self.used as f64;
        (cell as usize).min(self.used - 1)
    }
}

/// One axis, or no grid: the column over the axis.
fn curve(view: &View, theme: &Theme, scaled: &Scaled, area: Rect, buffer: &mut Buffer) {
    let mut chart = study::points(&view.slice, view.column());
    chart.y = scaled.quantity.clone();
    let base = view.here();
    let base = base.and_then(|(place, _)| view.slice.x().value_at(place));
    let base = base.and_then(|x| Some([x, chart.curves.first()?.value_at(x)?]));
    chart.points.extend(base.map(|at| Point {
        at,
        sign: here_sign(theme),
        role: Role::Alarm,
    }));
    let place = view.cursor().0;
    let here = view.slice.x().number(place).unwrap_or(place as f64);
    Plot::new(&chart, theme)
        .cursor(Some(here))
        .render(area, buffer);
}

/// A text, cut where the screen ends.
fn put(buffer: &mut Buffer, x: u16, y: u16, text: &str, style: Style, theme: &Theme) {
    let room = buffer.area.right().saturating_sub(x);
    if y < buffer.area.bottom() {
        buffer.set_stringn(x, y, theme.printable(text), room.into(), style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Marker;
    use crate::tui::theme::{Depth, Look};

    #[test]
    fn signs_are_seen_on_both_ends_of_the_colours() {
        let theme = Theme::new(Look::Dark, Marker::Braille).with_depth(Depth::Indexed);
        let ground = |share| Shade::Share(share).color(&theme).expect("a colour");
        let inks = [0.0, 0.2, 0.6, 1.0].map(|share| ink_on(ground(share)));
        let [white, black] = [Color::Indexed(231), Color::Black];
        assert_eq!(inks, [white, white, black, black]);
    }

    #[test]
    fn every_place_has_its_cells_and_every_cell_a_place() {
        for (cells, places) in [(40, 40), (79, 40), (80, 40), (10, 40), (7, 3)] {
            let map = Cells::new(cells, places);
            assert!(map.used <= cells && map.used > 0);
            for place in 0..places {
                let cell = map.middle(place as f64);
                assert!(cell < map.used);
                if cells >= places {
                    assert_eq!(map.place(cell), place, "{cells} {places}");
                }
            }
        }
    }
}
