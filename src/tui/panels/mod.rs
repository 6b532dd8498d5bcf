//! Panels, one a file: each draws one frame into one area.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Widget};

use super::app::App;
use super::frame::Frame;
use super::plot::{Axis, Curve, Plot, Scale, VerticalMark, Zone};
use super::theme::{Role, Theme};
use super::trend::Cycle;
use crate::simulation::Curves;

pub mod compare;
mod cost;
mod depth;
mod fretting_loop;
mod numbers;
mod profile;
mod radii;
mod rate;
mod residual;
mod section;
mod springs;
mod stresses;
mod volume;

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
    /// Worn volume of a cycle over cycles.
    Rate,
    /// The energy residual of a period over cycles.
    Residual,
    /// What a step costs over cycles.
    Cost,
}

impl Panel {
    /// All panels, in reading order; the first six fill the smallest screen.
    pub const ALL: [Self; 12] = [
        Self::Profile,
        Self::Stresses,
        Self::Springs,
        Self::Loop,
        Self::Radii,
        Self::Numbers,
        Self::Section,
        Self::Depth,
        Self::Volume,
        Self::Rate,
        Self::Residual,
        Self::Cost,
    ];

    /// The panel so many places further on.
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
            Self::Volume => "worn volume",
            Self::Rate => "wear rate",
            Self::Residual => "energy residual",
            Self::Cost => "cost of a step",
        }
    }

    /// Whether a logarithmic ordinate makes sense.
    pub fn can_be_log(self) -> bool {
        matches!(
            self,
            Self::Stresses | Self::Profile | Self::Depth | Self::Volume | Self::Rate | Self::Cost
        )
    }

    /// What the panel needs computed.
    pub fn curves(self) -> Curves {
        match self {
            Self::Profile => Curves::PROFILE,
            Self::Stresses => Curves::PRESSURE | Curves::SHEAR,
            Self::Springs => Curves::PROFILE_1D,
            Self::Section => Curves::PROFILE | Curves::DEPRESSION,
            Self::Depth => Curves::PROFILE,
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
            Self::Numbers => return None,
        };
        values.retain(|value| value.is_finite() && (scale == Scale::Linear || *value > 0.0));
        let high = values.iter().copied().reduce(f64::max)?;
        let low = values.iter().copied().reduce(f64::min)?;
        // Five decades say more than the last trace of a stress at the edge of the contact.
        Some([
            if scale == Scale::Log {
                low.max(1e-5 * high)
            } else {
                low
            },
            high,
        ])
    }

    /// Draws the panel.
    pub fn draw(self, frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
        let role = if app.focus == self {
            Role::Focus
        } else {
            Role::Title
        };
        let inner = titled(self.title(), role, app, area, buffer);
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

/// The frame of a panel that is not focused; returns its inside.
fn panel_block(title: &str, app: &App, area: Rect, buffer: &mut Buffer) -> Rect {
    titled(title, Role::Title, app, area, buffer)
}

/// A rule with a title; returns what is below it.
fn titled(title: &str, role: Role, app: &App, area: Rect, buffer: &mut Buffer) -> Rect {
    let theme = &app.theme;
    let title = Line::from(vec![Span::styled(format!(" {title} "), theme.style(role))]);
    let mut block = Block::new()
        .borders(Borders::TOP)
        .border_style(theme.style(Role::Quiet))
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
}

/// A quantity of every cycle over the cycles so far.
fn over_cycles<'a>(panel: Panel, frame: &Frame, app: &App, y: Axis<'a>) -> Plot<'a> {
    let end = frame.trend.cycles().last().map_or(0.0, |entry| entry.cycle);
    plot(
        panel,
        app,
        Axis::new("cycles", "").bounds([0.0, end.max(1.0)]),
        y,
    )
}

/// One quantity of every cycle, with the cycles it belongs to.
fn series(frame: &Frame, of: impl Fn(&Cycle) -> f64) -> (Vec<f64>, Vec<f64>) {
    frame
        .trend
        .cycles()
        .map(|entry| (entry.cycle, of(entry)))
        .unzip()
}

/// A word in a panel that has nothing to plot.
fn nothing(text: &str, app: &App, area: Rect, buffer: &mut Buffer) {
    Line::styled(format!(" {text}"), app.theme.style(Role::Quiet)).render(area, buffer);
}

/// Marks at the contact radius a and at the stick radius c.
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
    if let Some(stick) = moment
        .stick_radius
        .filter(|&c| c > 0.0 && c < moment.contact_radius)
    {
        marks.push(VerticalMark {
            x: stick,
            label: "c",
            style: theme.style(Role::Stick),
        });
    }
    marks
}

/// Stick, slip and open along the radius.
fn zones(frame: &Frame, theme: &Theme) -> Vec<Zone> {
    let moment = &frame.observation.moment;
    let edge = frame.observation.radii.last().copied().unwrap_or(0.0);
    let contact = moment.contact_radius;
    let stick = moment.stick_radius.unwrap_or(contact).min(contact);
    [
        (0.0, stick, Role::Stick, 's'),
        (stick, contact, Role::Slip, '~'),
        (contact, edge, Role::Open, '.'),
    ]
    .into_iter()
    .filter(|(from, to, _, _)| to > from)
    .map(|(from, to, role, glyph)| Zone {
        from,
        to,
        style: theme.style(role),
        glyph,
    })
    .collect()
}

/// A solid curve of a role.
fn curve<'a>(name: &'a str, xs: &'a [f64], ys: &'a [f64], theme: &Theme, role: Role) -> Curve<'a> {
    Curve::new(name, xs, ys, theme.style(role))
}
