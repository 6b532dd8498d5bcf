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
use ratatui::widgets::Widget;

use super::ramp::{self, Shade};
use super::view::{Scaled, View};
use crate::figure::study;
use crate::plot::axis::titled;
use crate::plot::units::{axis_unit, format_number, format_value_in};
use crate::plot::{Axis, Chart, Curve, Plot, Point, Scale};
use crate::studies::sweep::slice::{Line, REGIMES};
use crate::tui::footer;
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
    for (column, row, text, style) in [
        (0, 0, view.name.clone(), theme.style(Role::Title)),
        (behind, 0, count, quiet),
        (0, below, names.join("   "), quiet),
        (0, below + 1, place(view, point, theme), Style::new()),
        (
            0,
            below + 2,
            reading(view, point, theme),
            theme.style(Role::Notice),
        ),
    ] {
        put(buffer, area.x + column, area.y + row, &text, style, theme);
    }
    legend(view, theme, &scaled, area, buffer);
    let body = Rect::new(area.x, area.y + 2, area.width, area.height - 6);
    match view.slice.y() {
        Some(_) => map(view, theme, &scaled, &overlays, body, buffer),
        None => curve(view, theme, &scaled, body, buffer),
    }
    let last = Rect {
        y: area.bottom() - 1,
        height: 1,
        ..area
    };
    footer::draw_line(view.notice.as_deref(), &KEYS, &[QUIT], theme, last, buffer);
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
fn legend(view: &View, theme: &Theme, scaled: &Scaled, area: Rect, buffer: &mut Buffer) {
    let (mut x, y) = (area.x, area.y + 1);
    let mut write = |text: &str, style: Style| {
        let room = (area.x + area.width).saturating_sub(x);
        let text: String = theme.printable(text).chars().take(room.into()).collect();
        buffer.set_string(x, y, &text, style);
        x += text.chars().count() as u16;
    };
    let quantity = &scaled.quantity;
    let name = match view.is_regime() {
        true => view.column(),
        false => &quantity.label,
    };
    write(name, theme.style(Role::Focus));
    if view.is_regime() {
        for (at, (_, title)) in REGIMES.iter().enumerate() {
            let (sign, style) = swatch(Shade::Word(at), theme);
            write("  ", Style::new());
            write(&sign.to_string(), style);
            if sign == '█' {
                write(&Shade::Word(at).sign().to_string(), Style::new());
            }
            write(&format!(" {title}"), Style::new());
        }
        return;
    }
    let Some([low, high]) = scaled.range else {
        return;
    };
    let unit = axis_unit(high.abs().max(low.abs()), quantity.unit, theme.ascii());
    let value = |value: f64| format_number(value / unit.factor, 3);
    write(&format!("  {} ", value(low)), Style::new());
    for shade in ramp::all() {
        let (sign, style) = swatch(shade, theme);
        write(&sign.to_string(), style);
    }
    write(&format!(" {} {}", value(high), unit.text), Style::new());
    if quantity.scale == Scale::Log {
        write("  log", theme.style(Role::Quiet));
    }
    for axis in view.slice.hidden() {
        let (place, axis) = (view.slice.at[axis], &view.slice.study.axes[axis]);
        let text = format!("  {} = {}", axis.key, axis.text(place));
        write(&text, theme.style(Role::Quiet));
    }
}

/// One cell of a shade.
fn swatch(shade: Shade, theme: &Theme) -> (char, Style) {
    match shade.color(theme).filter(|_| has_blocks(theme)) {
        Some(color) => ('█', Style::new().fg(color)),
        None => (shade.sign(), Style::new()),
    }
}

/// Whether half blocks and colours can be drawn.
fn has_blocks(theme: &Theme) -> bool {
    theme.colored() && !theme.ascii()
}

/// Two axes: each point a block of cells, upwards in half cells where there are colours.
fn map(
    view: &View,
    theme: &Theme,
    scaled: &Scaled,
    overlays: &[Line],
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
    let parts = if has_blocks(theme) { 2 } else { 1 };
    let wide = Cells::new(plot.width.into(), last_x + 1);
    let high = Cells::new(usize::from(plot.height) * parts, last_y + 1);
    let rows = high.used.div_ceil(parts);
    // The map stands on its lower edge.
    let floor = plot.y + plot.height;
    let shade = |column: usize, half: usize| {
        let (x, y) = (wide.place(column), high.place(half));
        view.shade(view.slice.point_at(x, y), scaled)
    };
    for row in 0..rows {
        for column in 0..wide.used {
            let cell = &mut buffer[(plot.x + column as u16, floor - 1 - row as u16)];
            let lower = shade(column, (row * parts).min(high.used - 1));
            if parts == 1 {
                cell.set_char(lower.sign());
                continue;
            }
            let upper = row * parts + 1;
            let upper = (upper < high.used).then(|| shade(column, upper));
            let mut style = Style::new();
            if let Some(color) = lower.color(theme) {
                style = style.bg(color);
            }
            if let Some(color) = upper.and_then(|shade| shade.color(theme)) {
                cell.set_char('▀');
                style = style.fg(color);
            } else if upper.is_none() || lower.color(theme).is_some() {
                cell.set_char(' ');
            }
            // Half a cell without a row stays as dark as the terminal.
            if upper.is_none() || upper == Some(Shade::Waiting) {
                style = lower
                    .color(theme)
                    .map_or(Style::new(), |color| Style::new().fg(color));
                cell.set_char(if lower == Shade::Waiting { ' ' } else { '▄' });
            }
            cell.set_style(style);
        }
    }
    let at = |column: usize, row: usize| (plot.x + column as u16, floor - 1 - row as u16);
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
        letters(&shade, [&wide, &high], parts, |column, row, letter| {
            sign(at(column, row), letter)
        });
    }
    let dot = if theme.ascii() { '*' } else { '•' };
    for overlay in overlays {
        // A line from crossing to crossing, and its letter at the end.
        let cell = |[x, y]: [f64; 2]| [wide.middle(x), high.middle(y) / parts];
        for [from, to] in overlay.pieces() {
            let (a, b) = (cell(from), cell(to));
            let steps = a[0].abs_diff(b[0]).max(a[1].abs_diff(b[1])).max(1);
            for k in 0..=steps {
                let share = k as f64 / steps as f64;
                let between = |i: usize| from[i] + (to[i] - from[i]) * share;
                let [column, row] = cell([between(0), between(1)]);
                sign(at(column, row), dot);
            }
        }
        if let Some(&end) = overlay.at.last() {
            let [column, row] = cell(end);
            sign(at(column, row), overlay.letter);
        }
    }
    if let Some((x, y)) = view.here() {
        sign(at(wide.middle(x), high.middle(y) / parts), here_sign(theme));
    }
    let (x, y) = view.cursor();
    let cell = &mut buffer[at(wide.middle(x as f64), high.middle(y as f64) / parts)];
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
    parts: usize,
    mut put: impl FnMut(usize, usize, char),
) {
    for word in 0..REGIMES.len() {
        let cells =
            (0..wide.used).flat_map(|column| (0..high.used).map(move |half| (column, half)));
        let of: Vec<(usize, usize)> = cells
            .filter(|&(column, half)| shade(column, half) == Shade::Word(word))
            .collect();
        let count = of.len().max(1);
        let [column, half] = [
            of.iter().map(|at| at.0).sum::<usize>() / count,
            of.iter().map(|at| at.1).sum::<usize>() / count,
        ];
        // The middle of a bent region can lie outside of it.
        let nearest = of
            .iter()
            .min_by_key(|at| at.0.abs_diff(column) + at.1.abs_diff(half));
        if let Some(&(column, half)) = nearest {
            put(column, half / parts, Shade::Word(word).sign());
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
    let axis = view.slice.x();
    let mut points: Vec<(f64, f64)> = (0..axis.count())
        .filter_map(|x| {
            let number = view
                .slice
                .number(view.slice.point_at(x, 0), view.column())?;
            Some((axis.number(x).unwrap_or(x as f64), number))
        })
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (xs, ys): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
    let here = view.cursor().0;
    let here = axis.number(here).unwrap_or(here as f64);
    let curve = Curve::new("", xs, ys, Role::Profile);
    let base = view.here().and_then(|(place, _)| axis.value_at(place));
    let base = base.and_then(|x| Some([x, curve.value_at(x)?]));
    let mut chart = Chart::new("", view.in_words(axis), scaled.quantity.clone()).curve(curve);
    chart.points.extend(base.map(|at| Point {
        at,
        sign: here_sign(theme),
        role: Role::Alarm,
    }));
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
