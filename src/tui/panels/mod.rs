//! Panels, one per file: each draws one frame into one area.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::Modifier;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Widget};

use super::app::App;
use super::frame::Frame;
use super::theme::{Role, Theme};
use super::trend::Cycle;
use crate::plot::{Axis, Curve, Plot, Scale, VerticalMark, Zone};
use crate::simulation::Curves;

pub mod compare;
mod condition;
mod cost;
mod depth;
mod fretting_log;
mod fretting_loop;
mod ghosts;
mod numbers;
mod profile;
mod radii;
mod rate;
mod residual;
mod scar;
mod scar_depth;
mod section;
mod springs;
mod stress_map;
mod stresses;
mod volume;
mod words;

pub use stress_map::{SHADES, Shown, color as map_color};
pub use words::COMPARISON;

/// The panels of the explorer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Panel {
    /// The 3D profile.
    Profile,
    /// p and τ.
    Stresses,
    /// The 1D profile.
    Springs,
    /// F_x over u_x.
    Loop,
    /// Radii over cycles.
    Radii,
    /// The numbers of the moment.
    Numbers,
    /// A cut through indenter and half-space.
    Section,
    /// Worn depth over the radius.
    Depth,
    /// Worn volume and work of friction over cycles.
    Volume,
    /// Worn volume per cycle, over cycles.
    Rate,
    /// The energy residual of a period over cycles.
    Residual,
    /// Time per step over cycles.
    Cost,
    /// The scar from above.
    Scar,
    /// The loops of earlier cycles.
    Log,
    /// Normal load over displacement amplitude.
    Condition,
    /// Largest worn depth over cycles.
    ScarDepth,
}

impl Panel {
    /// All panels, in reading order; the first four fill a small screen.
    pub const ALL: [Self; 16] = [
        Self::Profile,
        Self::Stresses,
        Self::Loop,
        Self::Radii,
        Self::Section,
        Self::Numbers,
        Self::Springs,
        Self::Depth,
        Self::Volume,
        Self::Rate,
        Self::Residual,
        Self::Cost,
        Self::Scar,
        Self::Log,
        Self::Condition,
        Self::ScarDepth,
    ];

    /// The panel this many places on.
    pub fn shifted(self, places: isize) -> Self {
        let at = self.index() as isize;
        Self::ALL[(at + places).rem_euclid(Self::ALL.len() as isize) as usize]
    }

    /// Its place in reading order.
    pub fn index(self) -> usize {
        let at = Self::ALL.iter().position(|panel| *panel == self);
        at.unwrap_or(0)
    }

    /// The title.
    pub fn title(self) -> &'static str {
        match self {
            Self::Profile => "3D profile",
            Self::Stresses => "stresses",
            Self::Springs => "1D profile",
            Self::Loop => "fretting loop",
            Self::Radii => "radii over cycles",
            Self::Numbers => "numbers",
            Self::Section => "cross-section",
            Self::Depth => "worn depth",
            Self::Volume => "wear volume",
            Self::Rate => "wear rate",
            Self::Residual => "V against k E_d",
            Self::Cost => "time per step",
            Self::Scar => "scar from above",
            Self::Log => "fretting log",
            Self::Condition => "running-condition map",
            Self::ScarDepth => "depth over cycles",
        }
    }

    /// Whether a logarithmic ordinate makes sense.
    pub fn can_be_log(self) -> bool {
        matches!(
            self,
            Self::Stresses
                | Self::Profile
                | Self::Depth
                | Self::Volume
                | Self::Rate
                | Self::Cost
                | Self::ScarDepth
        )
    }

    /// What the panel needs computed.
    pub fn curves(self) -> Curves {
        match self {
            Self::Profile => Curves::PROFILE,
            Self::Stresses => Curves::PRESSURE | Curves::SHEAR,
            Self::Springs => Curves::PROFILE_1D,
            Self::Section => Curves::PROFILE | Curves::DEPRESSION | Curves::SPRINGS,
            Self::Depth => Curves::PROFILE,
            Self::Scar => Curves::PROFILE | Curves::SPRINGS,
            Self::Condition => Curves::SPRINGS,
            _ => Curves::empty(),
        }
    }

    /// The smallest and largest ordinate that the panel shows of a frame.
    pub fn extent(self, frame: &Frame, scale: Scale) -> Option<[f64; 2]> {
        let mut values: Vec<f64> = match self {
            Self::Profile => profile::ordinates(frame),
            Self::Stresses => stresses::ordinates(frame),
            Self::Springs => springs::ordinates(frame),
            Self::Loop => fretting_loop::ordinates(frame),
            Self::Radii => radii::ordinates(frame),
            Self::Section => section::ordinates(frame),
            Self::Depth => depth::ordinates(frame),
            Self::Volume => volume::ordinates(frame),
            Self::Rate => rate::ordinates(frame),
            Self::Residual => residual::ordinates(frame),
            Self::Cost => cost::ordinates(frame),
            Self::Scar => scar::ordinates(frame),
            Self::Log => fretting_log::ordinates(frame),
            Self::Condition => condition::ordinates(frame),
            Self::ScarDepth => scar_depth::ordinates(frame),
            Self::Numbers => return None,
        };
        values.retain(|value| value.is_finite() && (scale == Scale::Linear || *value > 0.0));
        if self.has_spikes() && scale == Scale::Linear {
            clip_spikes(&mut values);
        }
        let high = values.iter().copied().reduce(f64::max)?;
        let low = values.iter().copied().reduce(f64::min)?;
        // Five decades show more than the last trace of stress at the contact edge.
        Some([
            if scale == Scale::Log {
                low.max(1e-5 * high)
            } else {
                low
            },
            high,
        ])
    }

    /// The range of the abscissa where it is kept as that of the ordinate is: a loop is drawn on axes that
    /// hold.
    pub fn extent_across(self, frame: &Frame) -> Option<[f64; 2]> {
        (self == Self::Loop).then(|| fretting_loop::abscissae(frame))?
    }

    /// Whether a few values may be far above all others: a stress that is singular at a border, or
    /// a slow step.
    fn has_spikes(self) -> bool {
        matches!(
            self,
            Self::Stresses | Self::Rate | Self::Residual | Self::Cost
        )
    }

    /// Whether a run may leave the panel as it is for two frames: numbers that nobody reads ten times a
    /// second, pictures that are looked at rather than followed, and what grows from cycle to cycle.
    fn is_calm(self) -> bool {
        match self {
            Self::Numbers | Self::Section => true,
            Self::Radii | Self::Volume | Self::Rate | Self::Residual => true,
            Self::Cost | Self::ScarDepth | Self::Log => true,
            // Marks of a and c are at the same places in all plots over r.
            Self::Profile | Self::Stresses | Self::Springs | Self::Depth => false,
            Self::Loop | Self::Scar | Self::Condition => false,
        }
    }

    /// Draws the panel.
    pub fn draw(self, frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
        let frame = if self.is_calm() {
            app.calm(frame)
        } else {
            frame
        };
        let role = if app.focus == self {
            Role::Focus
        } else {
            Role::Title
        };
        let title = match self {
            Self::Profile => profile::title(frame, app.theme.ascii()),
            _ => self.title().to_owned(),
        };
        let inner = titled(&title, role, app, area, buffer);
        match self {
            Self::Profile => profile::plotted(frame, app, |plot| plot.render(inner, buffer)),
            Self::Stresses => stresses::plotted(frame, app, |plot| plot.render(inner, buffer)),
            Self::Springs => springs::plotted(frame, app, |plot| plot.render(inner, buffer)),
            Self::Loop => fretting_loop::draw(frame, app, inner, buffer),
            Self::Radii => radii::draw(frame, app, inner, buffer),
            Self::Numbers => numbers::draw(frame, app, inner, buffer),
            Self::Section => section::draw(frame, app, inner, buffer),
            Self::Depth => depth::plotted(frame, app, |plot| plot.render(inner, buffer)),
            Self::Volume => volume::draw(frame, app, inner, buffer),
            Self::Rate => rate::draw(frame, app, inner, buffer),
            Self::Residual => residual::draw(frame, app, inner, buffer),
            Self::Cost => cost::draw(frame, app, inner, buffer),
            Self::Scar => scar::draw(frame, app, inner, buffer),
            Self::Log => fretting_log::draw(frame, app, inner, buffer),
            Self::Condition => condition::draw(frame, app, inner, buffer),
            Self::ScarDepth => scar_depth::draw(frame, app, inner, buffer),
        }
    }

    /// The radius under a place of the screen, m, where the panel in `area` has a plot over r there.
    pub fn radius_at(self, frame: &Frame, app: &App, area: Rect, at: Position) -> Option<f64> {
        // The first row is the title's.
        let inner = Rect {
            y: area.y.saturating_add(1),
            height: area.height.saturating_sub(1),
            ..area
        };
        let radius = |plot: &Plot<'_>| plot.abscissa_at(inner, at);
        match self {
            Self::Profile => profile::plotted(frame, app, radius),
            Self::Stresses => stresses::plotted(frame, app, radius),
            Self::Springs => springs::plotted(frame, app, radius),
            Self::Depth => depth::plotted(frame, app, radius),
            _ => None,
        }
    }
}

/// Values beyond three times the 95 % quantile of the sizes are spikes: they do not count for the bounds,
/// and the plot marks where they are clipped.
fn clip_spikes(values: &mut [f64]) {
    let mut sizes: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    sizes.retain(|size| *size > 0.0);
    if sizes.len() < 20 {
        return;
    }
    let at = sizes.len() * 95 / 100;
    let (_, quantile, _) = sizes.select_nth_unstable_by(at, f64::total_cmp);
    let most = 3.0 * *quantile;
    for value in values {
        if value.abs() > most {
            *value = 0.5 * most.copysign(*value);
        }
    }
}

/// The frame of a panel that is not focused; returns its inside.
fn panel_block(title: &str, app: &App, area: Rect, buffer: &mut Buffer) -> Rect {
    titled(title, Role::Title, app, area, buffer)
}

/// A rule with a title; returns what is below it.
pub(super) fn titled(title: &str, role: Role, app: &App, area: Rect, buffer: &mut Buffer) -> Rect {
    let theme = &app.theme;
    // The rule is dim; its title is not.
    let style = theme.style(role).remove_modifier(Modifier::DIM);
    let title = Line::from(vec![Span::styled(format!(" {title} "), style)]);
    let mut block = Block::new()
        .borders(Borders::TOP)
        .border_style(theme.style(Role::Faint))
        .title(title);
    if theme.ascii() {
        block = block.border_set(ratatui::symbols::border::Set {
            horizontal_top: "-",
            ..ratatui::symbols::border::PLAIN
        });
    }
    let inner = block.inner(area);
    block.render(area, buffer);
    inner
}

/// A plot of nodal values over the radius, with the bounds that the app keeps for the panel and the
/// cursor. The ordinate is a label and a unit.
fn radial_plot<'a>(
    panel: Panel,
    app: &App,
    frame: &Frame,
    abscissa: &'a str,
    ordinate: (&'a str, &'a str),
) -> Plot<'a> {
    let (label, unit) = ordinate;
    plot(panel, app, Axis::new(abscissa, "m"), Axis::new(label, unit))
        .cursor(app.cursor_radius(frame))
}

fn plot<'a>(panel: Panel, app: &App, x: Axis<'a>, y: Axis<'a>) -> Plot<'a> {
    let mut y = y.scale(app.scale(panel));
    if let Some(bounds) = app.bounds(panel) {
        y = y.bounds(bounds);
    }
    bare_plot(app, x, y)
}

/// A plot in the app's look, without the bounds and the scale of a panel.
fn bare_plot<'a>(app: &App, x: Axis<'a>, y: Axis<'a>) -> Plot<'a> {
    Plot::new(x, y)
        .marker(app.theme.marker)
        .axis_style(app.theme.style(Role::Quiet))
        .rule_style(app.theme.style(Role::Faint))
}

/// A quantity of every cycle over the cycles so far.
fn over_cycles<'a>(panel: Panel, frame: &Frame, app: &App, y: Axis<'a>) -> Plot<'a> {
    let ends = cycles_shown(frame);
    plot(panel, app, Axis::new("cycles", "").bounds(ends), y)
}

/// The cycles that the panels over cycles show: all that are planned, from the first one on.
fn cycles_shown(frame: &Frame) -> [f64; 2] {
    let end = frame.trend.cycles().last().map_or(0.0, |entry| entry.cycle);
    let end = end.max(frame.planned_cycles.unwrap_or(0.0));
    [0.0, round_end(end.max(ghosts::end(frame)))]
}

/// The round number of cycles, at least one, that `end` does not exceed: an axis that ended at the
/// present would squeeze the whole past with every frame.
fn round_end(end: f64) -> f64 {
    const ROUND: [f64; 11] = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    let decade = 10f64.powf(end.max(1.0).log10().floor());
    ROUND
        .into_iter()
        .map(|round| round * decade)
        // A part of a cycle is no round number.
        .filter(|round| round.fract() == 0.0)
        .find(|round| end <= round * (1.0 + 1e-9))
        .unwrap_or(10.0 * decade)
}

/// One quantity of every cycle, with the cycles it belongs to.
fn series(frame: &Frame, of: impl Fn(&Cycle) -> f64) -> (Vec<f64>, Vec<f64>) {
    frame
        .trend
        .cycles()
        .map(|entry| (entry.cycle, of(entry)))
        .unzip()
}

/// One quantity of every finished cycle, with the cycles it belongs to.
fn finished_series(frame: &Frame, of: impl Fn(&Cycle) -> f64) -> (Vec<f64>, Vec<f64>) {
    let cycles = frame.trend.finished_cycles();
    cycles.map(|entry| (entry.cycle, of(entry))).unzip()
}

/// Writes a message in a panel that has nothing to plot.
fn nothing(text: &str, app: &App, area: Rect, buffer: &mut Buffer) {
    Line::styled(format!(" {text}"), app.theme.style(Role::Quiet)).render(area, buffer);
}

/// Marks at the contact radius a and at the permanent stick radius c; where more sticks at the moment, a
/// faint one there.
fn edge_marks(frame: &Frame, theme: &Theme) -> Vec<VerticalMark<'static>> {
    let moment = &frame.observation.moment;
    let mut marks = Vec::new();
    if moment.contact_radius > 0.0 {
        marks.push(VerticalMark {
            x: moment.contact_radius,
            label: "a",
            style: theme.style(Role::Contact),
        });
    }
    let within = |c: &f64| *c > 0.0 && *c < moment.contact_radius;
    let permanent = moment.permanent_stick_radius.filter(within);
    let now = moment.stick_radius.filter(within);
    if let Some(stick) = now.filter(|now| permanent.is_none_or(|c| *now > c * (1.0 + 1e-9))) {
        marks.push(VerticalMark {
            x: stick,
            label: "",
            style: theme.style(Role::Faint),
        });
    }
    if let Some(c) = permanent {
        marks.push(VerticalMark {
            x: c,
            label: "c",
            style: theme.style(Role::Stick),
        });
    }
    marks
}

/// Stick, slip and open along the radius.
fn zones(frame: &Frame, theme: &Theme) -> Vec<Zone<'static>> {
    let moment = &frame.observation.moment;
    let edge = frame.observation.radii.last().copied().unwrap_or(0.0);
    let contact = moment.contact_radius;
    let stick = moment.stick_radius.unwrap_or(contact).min(contact);
    [
        (0.0, stick, Role::Stick, 's', "stick"),
        (stick, contact, Role::Slip, '~', "slip"),
        (contact, edge, Role::Open, '.', "open"),
    ]
    .into_iter()
    .filter(|(from, to, ..)| to > from)
    .map(|(from, to, role, glyph, name)| Zone {
        from,
        to,
        style: theme.style(role),
        glyph,
        name,
    })
    .collect()
}

/// A solid curve of a role.
fn curve<'a>(name: &'a str, xs: &'a [f64], ys: &'a [f64], theme: &Theme, role: Role) -> Curve<'a> {
    Curve::new(name, xs, ys, theme.style(role))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_of_cycles_ends_at_a_round_number() {
        for (end, expected) in [
            (0.0, 1.0),
            (1.0, 1.0),
            (1.01, 2.0),
            (2.5, 3.0),
            (6.5, 8.0),
            (9.0, 10.0),
            (10.5, 12.0),
            (24.0, 25.0),
            (99.0, 100.0),
            (199.24, 200.0),
            (8.1e5, 1e6),
        ] {
            assert_eq!(round_end(end), expected, "{end}");
        }
    }

    #[test]
    fn a_spike_does_not_flatten_the_rest_and_a_smooth_curve_is_whole() {
        let mut smooth: Vec<f64> = (0..100).map(|i| f64::from(i).sqrt()).collect();
        let whole = smooth.clone();
        clip_spikes(&mut smooth);
        assert_eq!(smooth, whole);
        let mut spiked = whole.clone();
        spiked[50] = 1e6;
        clip_spikes(&mut spiked);
        let high = spiked.iter().copied().fold(0.0, f64::max);
        assert!((10.0..30.0).contains(&high), "{high}");
    }
}
