//! The text of the cross-section: the phase of the cycle in a plain sentence, what has worn, a and c, and the meaning
//! of the colours. A small picture has no captions below; the smallest has only the load and the scale of the stress.

use ratatui::buffer::Cell;
use ratatui::layout::Constraint::{Length, Min};
use ratatui::layout::{Layout, Rect};
use ratatui::style::{Color, Modifier, Style};
use ratatui::text::{Line, Span};

use super::cut::ContactSection;
use crate::math::scan::largest;
use crate::plot::shades::{self, has_blocks};
use crate::plot::theme::{Depth, Look, Role, Theme};
use crate::plot::units::format_value;
use crate::reading::Moment;
use crate::tui::canvas::Canvas;
use crate::tui::frame::Frame;

/// The minimum size of a picture with captions below it, and their rows.
const ROOMY: [u16; 2] = [60, 16];
const ROWS: u16 = 2;

/// Below this fraction of its fastest motion in a cycle, the indenter is said to turn round.
const TURNS: f64 = 0.2;

/// Below this fraction of a, a zone is too small to see.
const NOTHING: f64 = 0.02;

/// The width of the longest phase, "The outer ring slips, the middle sticks: sliding right", and the minimum rows of a
/// picture with room for it.
const LONGEST: u16 = 54;
const TELLING: u16 = 9;

/// Returns the areas of the picture and of its captions.
pub fn split(area: Rect) -> [Rect; 2] {
    let is_roomy = area.width >= ROOMY[0] && area.height >= ROOMY[1];
    let rows = ROWS * u16::from(is_roomy);
    Layout::vertical([Min(0), Length(rows)]).areas(area)
}

/// Returns the speed of the indenter to the right, relative to the fastest in the last cycle; `None` if no motion is
/// visible, as after a jump over cycles.
fn speed(frame: &Frame) -> Option<f64> {
    let shifts = &frame.run.loops.last()?.shifts;
    let mut steps = shifts.windows(2).map(|pair| pair[1] - pair[0]);
    let fastest = steps.clone().map(f64::abs).fold(0.0, f64::max);
    // Ignores motion due to rounding.
    let is_seen = fastest > 1e-12 * frame.live.observation.moment.contact_radius;
    let last = steps.next_back().filter(|_| is_seen)?;
    Some(last / fastest)
}

/// Describes the present state of the contact for someone who has never heard of fretting, then in capitals for large
/// letters, with the colour of the state.
pub fn contact_state(moment: &Moment) -> (&'static str, &'static str, Role) {
    let a = moment.contact_radius;
    match moment.stick_radius.map(|stick| stick / a) {
        _ if a <= 0.0 => ("Nothing touches: lifted off", "LIFTED OFF", Role::Quiet),
        None => ("Nothing slides: pressed together", "PRESSED", Role::Stick),
        Some(share) if share >= 1.0 - NOTHING => ("All of it sticks", "ALL STICKS", Role::Stick),
        Some(share) if share <= NOTHING => ("All of it slips", "ALL SLIPS", Role::Slip),
        Some(_) => {
            let what = "The outer ring slips, the middle sticks";
            (what, "RING SLIPS", Role::Slip)
        }
    }
}

/// Describes the state and the motion.
fn phase(moment: &Moment, speed: Option<f64>) -> String {
    let (what, _, role) = contact_state(moment);
    let is_in_contact = moment.contact_radius > 0.0 && moment.stick_radius.is_some();
    let slips = role == Role::Slip;
    let verb = if slips { "sliding" } else { "pushed" };
    match speed.filter(|_| is_in_contact) {
        None => what.to_owned(),
        Some(speed) if speed.abs() < TURNS => format!("{what}: turning round"),
        Some(speed) if speed > 0.0 => format!("{what}: {verb} right"),
        Some(_) => format!("{what}: {verb} left"),
    }
}

/// Describes what has worn since the start.
fn worn(frame: &Frame, value: impl Fn(f64) -> String) -> String {
    let seen = &frame.live.observation;
    let deepest = largest(seen.wear());
    if seen.law.is_none() {
        return "Nothing wears in this scenario: both bodies keep their shape.".into();
    }
    if deepest <= 0.0 {
        return "Nothing has worn yet: wear needs pressure and sliding.".into();
    }
    let depth = value(deepest);
    let bodies = frame.live.scenario.wear_share().map(|share| {
        let [indenter, half_space] = [share, 1.0 - share].map(|part| value(part * deepest));
        format!(" (indenter {indenter}, half-space {half_space})")
    });
    let bodies = bodies.unwrap_or_default();
    let (radius, c) = (seen.moment.contact_radius, sticking(&seen.moment));
    let a = value(radius);
    match c.map(&value) {
        _ if radius <= 0.0 => format!("Worn {depth} deep{bodies}."),
        Some(c) => {
            format!(
                "Worn {depth} deep{bodies} in the ring from c ({c}) to a ({a}), nothing inside c."
            )
        }
        None => {
            format!("Worn {depth} deep{bodies}; all of the contact (a {a}) slips in each cycle.")
        }
    }
}

/// Returns the permanent stick radius, m, if it is visible.
fn sticking(moment: &Moment) -> Option<f64> {
    let (a, c) = (moment.contact_radius, moment.permanent_stick_radius);
    c.filter(|c| *c > NOTHING * a && *c < (1.0 - NOTHING) * a)
}

/// Returns the ink of text and lines on the bodies.
pub fn ink(theme: &Theme) -> Style {
    let color = match (theme.depth, theme.look) {
        (Depth::Sixteen, _) | (_, Look::Light) => Color::Black,
        _ => Color::Indexed(255),
    };
    Style::new().fg(color)
}

/// Sets the background of a character written over a block to the colour that fills most of the cell.
pub fn fill_background(cell: &mut Cell) {
    if ("▅"..="█").contains(&cell.symbol()) && !cell.modifier.contains(Modifier::REVERSED) {
        cell.bg = cell.fg;
    }
}

/// Writes over what is already drawn, keeping its background.
fn write_over(canvas: &mut Canvas, x: u16, y: u16, text: &str) {
    let (text, buffer) = (&*canvas.theme.printable(text), &mut *canvas.buffer);
    let style = if has_blocks(&canvas.theme) {
        ink(&canvas.theme).remove_modifier(Modifier::REVERSED)
    } else {
        Style::reset()
    };
    let room = buffer.area.right().saturating_sub(x);
    for x in x..x + room.min(Line::raw(text).width() as u16) {
        fill_background(&mut buffer[(x, y)]);
    }
    buffer.set_stringn(x, y, text, usize::from(room), style);
}

/// Draws the text on the picture and below it.
pub fn draw(section: &ContactSection, mut canvas: Canvas, below: Rect) {
    let (frame, area) = (section.of.frame, canvas.area);
    let (seen, moment) = (section.of.calm, &frame.live.observation.moment);
    let value = |value, unit| format_value(value, unit, 3);
    if area.height < 5 || area.width < 30 {
        return;
    }
    let is_brief = below.is_empty();
    let [load, shift] = if is_brief {
        ["", ""]
    } else {
        ["load ", "shift "]
    };
    let mut forces = format!("{load}F_z {}", value(moment.normal_force, "N"));
    if moment.stick_radius.is_some() {
        // Ignores motion due to rounding.
        let moved = moment.shift * f64::from(moment.shift.abs() > 1e-12 * moment.contact_radius);
        forces.push_str(&format!(", {shift}u_x {}", value(moved, "m")));
    }
    let tells = area.width > LONGEST && area.height >= TELLING;
    if tells {
        write_phase(frame, &forces, &mut canvas);
    }
    if is_brief {
        let forces = format!(" {forces} ");
        let spare = area.width.checked_sub(Line::raw(&forces).width() as u16);
        if let Some(spare) = spare.filter(|_| !tells) {
            write_over(&mut canvas, area.x + spare / 2, area.y, &forces);
        }
        // A wide picture has room for the meaning of all colours.
        let mut key = if area.width >= ROOMY[0] {
            body_key(&canvas.theme)
        } else {
            Line::default()
        };
        let room = area.width.saturating_sub(key.width() as u16);
        key.extend(stress_key(section, room));
        let scale = key.style(Style::reset());
        let width = scale.width() as u16;
        let left = area.x + area.width.saturating_sub(width) / 2;
        let place = Rect::new(left, area.bottom() - 1, width, 1);
        return canvas.at(place).show(scale);
    }
    radii(section, &mut canvas);
    let [first, second] = Layout::vertical([Length(1); ROWS as usize]).areas(below);
    let geometry = frame.live.observation.geometry;
    let text = geometry.term(&worn(seen, |depth| value(depth, "m")));
    let text = canvas.printable(&text);
    // What is obvious from the rest is said where there is room for it.
    let room = usize::from(first.width.saturating_sub(1));
    let worn = match text.rsplit_once(", ") {
        Some((brief, _)) if Line::raw(text.as_str()).width() > room => brief,
        _ => text.as_str(),
    };
    canvas.at(first).show(Line::raw(format!(" {worn}")));
    let mut key = body_key(&canvas.theme);
    let room = second.width.saturating_sub(key.width() as u16);
    key.extend(stress_key(section, room));
    canvas.at(second).show(key);
}

/// Writes at the top of the picture what the contact does, and below it the `forces`.
fn write_phase(frame: &Frame, forces: &str, canvas: &mut Canvas) {
    let (area, speed) = (canvas.area, speed(frame));
    let seen = &frame.live.observation;
    let said = seen.geometry.term(&phase(&seen.moment, speed));
    // The words stay where they are when the motion turns.
    let start = area.x + (area.width - LONGEST) / 2;
    write_over(canvas, start, area.y, &said);
    match speed {
        _ if area.width < LONGEST + 10 => {}
        Some(speed) if speed >= TURNS => write_over(canvas, start + LONGEST + 2, area.y, "━━▶"),
        Some(speed) if speed <= -TURNS => write_over(canvas, start - 5, area.y, "◀━━"),
        _ => {}
    }
    write_over(canvas, start, area.y + 1, forces);
}

/// Draws c and a: a short line over each border, and its name.
fn radii(section: &ContactSection, canvas: &mut Canvas) {
    let moment = &section.of.calm.live.observation.moment;
    let a = Some(moment.contact_radius).filter(|a| *a > 0.0);
    let marks = [("c", sticking(moment)), ("a", a)];
    for (name, r) in marks.into_iter().filter_map(|(name, r)| Some((name, r?))) {
        for x in [-r, r] {
            if let (Some(column), Some([row, _])) = (section.column(x), section.rows_above(x)) {
                let above = row.saturating_sub(1).max(section.area.y);
                write_over(canvas, column, above, name);
                write_over(canvas, column, row, "┊");
            }
        }
    }
}

/// Returns the meaning of the bodies' colours.
fn body_key(theme: &Theme) -> Line<'static> {
    let [blocks, lines] = [has_blocks(theme), !theme.ascii()].map(usize::from);
    let parts = [
        (["s", "▀▀"][blocks], Role::Stick, "sticks"),
        (["~", "▀▀"][blocks], Role::Slip, "slips"),
        (["/", "╱╱"][lines], Role::Profile, "worn away"),
    ];
    let spans = parts.into_iter().flat_map(|(sign, role, name)| {
        let sign = Span::styled(format!(" {sign}"), theme.style(role));
        [sign, format!(" {name} ").into()]
    });
    spans.collect()
}

/// Returns the scale of the stress in as many words as fit into `width` cells; empty without a stress.
fn stress_key(section: &ContactSection, width: u16) -> Line<'static> {
    let (theme, stress) = (&section.theme, section.of.stress);
    // A scale of no more than 1 Pa means that nothing is loaded yet.
    let Some(bounds) = stress.bounds().filter(|bounds| bounds[1] > 1.0) else {
        return Line::default();
    };
    let name = format!(" {} ", stress.names()[1]);
    let ends = stress.ends().unwrap_or_default();
    let [low, high] = ends.map(|end| theme.printable(&end));
    // If there is little room, the number at one end stands for both.
    let short = match bounds {
        [0.0, _] => "0 ",
        [low, high] if low == -high => "- ",
        _ => "",
    };
    let words = [
        [format!("{name}{low} "), format!(" {high} ")],
        [format!("{name}{short}"), format!(" {high} ")],
        [name, format!(" {high}")],
        [" ".into(), format!(" {high}")],
    ];
    let key = |ends| shades::key(theme, stress.colors(), shades::SIGNS, ends);
    let mut keys = words.into_iter().map(key);
    let fitting = keys.find(|key| key.width() <= usize::from(width));
    fitting.unwrap_or_default()
}
