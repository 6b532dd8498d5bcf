//! Panels, one per file: each declares what it is called, what it needs computed, how it is explained, and the
//! chart or the picture that it makes of a frame.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::Modifier;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Borders, Widget};

use super::app::App;
use super::frame::Frame;
use super::theme::Role;
use super::trend::Cycle;
use crate::plot::{Axis, Chart, Curve, Mark, Plot, Scale, Zone};
use crate::simulation::Curves;
use crate::studies::ghost::Axes;
use crate::studies::theory::Theory;

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

pub use stress_map::{SHADES, Shown, color as map_color};

/// An explanation, for a reader who knows Hertz and nothing else.
#[derive(Debug, Clone, Copy)]
pub struct Words {
    /// A few sentences.
    pub text: &'static str,
    /// The symbols in the panel with their meaning.
    pub symbols: &'static [(&'static str, &'static str)],
}

const A: (&str, &str) = ("a", "contact radius: the bodies touch inside it");
const C: (&str, &str) = ("c", "stick radius: nothing slips inside it in a cycle");
const BAND: (&str, &str) = ("band", "stick, slip and open zones along the radius");

/// What panels say that have nothing to show.
const NO_MOTION: &str = "no tangential motion in this scenario";
const NO_WEAR: &str = "no wear in this scenario";
const NO_CYCLE: &str = "no cycle is complete yet";

/// Everything that the explorer knows of a panel.
pub struct Declared {
    /// The title.
    pub title: &'static str,
    /// Whether a logarithmic ordinate makes sense.
    pub can_be_log: bool,
    /// What it needs computed.
    pub needs: Curves,
    /// Whether it is a chart over the radius, which has the cursor.
    pub over_r: bool,
    /// Whether the range of the abscissa is kept as that of the ordinate is: a loop is drawn on axes that hold.
    pub keeps_abscissa: bool,
    /// Whether a few values may be far above all others: a stress that is singular at a border, or a slow step.
    pub has_spikes: bool,
    /// Whether a run may leave the panel as it is for two frames: numbers that nobody reads ten times a second,
    /// pictures that are looked at rather than followed, and what grows from cycle to cycle. Marks of a and c,
    /// though, are at the same places in all plots over r.
    pub is_calm: bool,
    /// What the line of the cursor compares with other sources.
    pub compared: Axes,
    /// The explanation.
    pub words: Words,
    /// What it shows.
    content: Content,
}

/// Makes a chart of a frame, or says why there is nothing to show.
type MakeChart = fn(&Frame, &View) -> Result<Chart, &'static str>;

/// The values that a picture must hold.
type Extent = fn(&Frame) -> Option<[f64; 2]>;

/// Draws a picture of a frame.
type Draw = fn(&Frame, &App, Rect, &mut Buffer);

enum Content {
    Chart(MakeChart),
    Picture(Draw, Extent),
}

impl Declared {
    const fn new(content: Content) -> Self {
        Self {
            title: "",
            can_be_log: false,
            needs: Curves::empty(),
            over_r: false,
            keeps_abscissa: false,
            has_spikes: false,
            is_calm: false,
            compared: Axes::Wear,
            words: Words {
                text: "",
                symbols: &[],
            },
            content,
        }
    }

    /// A chart.
    const fn chart(make: MakeChart) -> Self {
        Self::new(Content::Chart(make))
    }

    /// A picture of cells.
    const fn picture(draw: Draw, extent: Extent) -> Self {
        Self::new(Content::Picture(draw, extent))
    }
}

/// The names of all panels, in reading order; the first four fill a small screen.
macro_rules! panels {
    ($($name:ident in $file:ident: $what:literal;)*) => {
        /// The panels of the explorer.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Panel {
            $(#[doc = $what] $name,)*
        }

        impl Panel {
            /// All panels, in reading order.
            pub const ALL: [Self; [$(stringify!($name)),*].len()] = [$(Self::$name),*];

            /// What its file declares.
            pub fn declared(self) -> &'static Declared {
                match self {
                    $(Self::$name => &$file::PANEL,)*
                }
            }
        }
    };
}

panels! {
    Profile in profile: "The 3D profile.";
    Stresses in stresses: "p and τ.";
    Loop in fretting_loop: "F_x over u_x.";
    Radii in radii: "Radii over cycles.";
    Section in section: "A cut through indenter and half-space.";
    Numbers in numbers: "The numbers of the moment.";
    Springs in springs: "The 1D profile.";
    Depth in depth: "Worn depth over the radius.";
    Volume in volume: "Worn volume and work of friction over cycles.";
    Rate in rate: "Worn volume per cycle, over cycles.";
    Residual in residual: "The energy residual of a period over cycles.";
    Cost in cost: "Time per step over cycles.";
    Scar in scar: "The scar from above.";
    Log in fretting_log: "The loops of earlier cycles.";
    Condition in condition: "Normal load over displacement amplitude.";
    ScarDepth in scar_depth: "Largest worn depth over cycles.";
}

/// What the user has chosen for a chart.
#[derive(Debug, Clone, Copy)]
pub struct View {
    /// The scale of the ordinate.
    pub scale: Scale,
    /// Whether closed forms are drawn.
    pub with_theory: bool,
}

impl View {
    /// The closed forms, if they are shown.
    fn theory(self, frame: &Frame) -> Option<&Theory> {
        self.with_theory.then_some(&*frame.theory)
    }
}

/// What a panel shows of a frame.
#[derive(Debug)]
pub struct Shot {
    /// The chart, or why there is nothing to show; `None` for a picture.
    pub chart: Option<Result<Chart, &'static str>>,
    /// The smallest and largest ordinate.
    pub extent: Option<[f64; 2]>,
    /// Those of the abscissa, where its range is kept.
    pub across: Option<[f64; 2]>,
}

impl Panel {
    /// The panel this many places on.
    pub fn shifted(self, places: isize) -> Self {
        let at = self.index() as isize;
        Self::ALL[(at + places).rem_euclid(Self::ALL.len() as isize) as usize]
    }

    /// Its place in reading order.
    pub fn index(self) -> usize {
        self as usize
    }

    /// The title.
    pub fn title(self) -> &'static str {
        self.declared().title
    }

    /// The explanation of the panel.
    pub fn words(self) -> Words {
        self.declared().words
    }

    /// What the panel shows of a frame.
    pub fn shot(self, frame: &Frame, view: &View) -> Shot {
        let declared = self.declared();
        match declared.content {
            Content::Picture(_, extent) => Shot {
                chart: None,
                extent: extent(frame),
                across: None,
            },
            Content::Chart(make) => {
                let chart = make(frame, view).map(|mut chart| {
                    chart.y.scale = view.scale;
                    if chart.title.is_empty() {
                        chart.title = declared.title.to_owned();
                    }
                    chart
                });
                let made = chart.as_ref().ok();
                let across = made.filter(|_| declared.keeps_abscissa);
                Shot {
                    extent: made.and_then(|chart| extent(chart, declared.has_spikes)),
                    across: across.and_then(|chart| chart.x.bounds),
                    chart: Some(chart),
                }
            }
        }
    }

    /// Draws the panel.
    pub fn draw(self, frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
        let (declared, frame) = (self.declared(), app.frame_of(self, frame));
        let role = if app.focus == self {
            Role::Focus
        } else {
            Role::Title
        };
        if let Content::Picture(draw, _) = declared.content {
            let inner = titled(declared.title, role, app, area, buffer);
            return draw(frame, app, inner, buffer);
        }
        match &*app.chart(self, frame) {
            Ok(chart) => {
                let inner = titled(&chart.title, role, app, area, buffer);
                let cursor = app.cursor_radius(frame).filter(|_| declared.over_r);
                Plot::new(chart, &app.theme)
                    .cursor(cursor)
                    .render(inner, buffer);
            }
            Err(why) => {
                let inner = titled(declared.title, role, app, area, buffer);
                nothing(why, app, inner, buffer);
            }
        }
    }

    /// The radius under a place of the screen, m, where the panel in `area` has a chart over r there.
    pub fn radius_at(self, frame: &Frame, app: &App, area: Rect, at: Position) -> Option<f64> {
        // The first row is the title's.
        let inner = Rect {
            y: area.y.saturating_add(1),
            height: area.height.saturating_sub(1),
            ..area
        };
        let chart = app.chart(self, frame);
        let chart = chart.as_ref().as_ref().ok()?;
        let plot = Plot::new(chart, &app.theme);
        let radius = plot.abscissa_at(inner, at);
        radius.filter(|_| self.declared().over_r)
    }
}

/// The smallest and largest ordinate of a live chart: given ones, or those of the run's own curves and of other
/// sources.
fn extent(chart: &Chart, has_spikes: bool) -> Option<[f64; 2]> {
    if chart.y.bounds.is_some() {
        return chart.y.bounds;
    }
    let [_, range] = chart.extent(|curve| !curve.is_theory);
    let [low, high] = range?;
    match chart.y.scale {
        // Five decades show more than the last trace of stress at the contact edge.
        Scale::Log => Some([low.max(1e-5 * high), high]),
        Scale::Linear if has_spikes => {
            let curves = chart.curves.iter().filter(|curve| !curve.is_theory);
            let values = curves.flat_map(|curve| &curve.ys).chain(&chart.y.holds);
            let mut values: Vec<f64> = values.copied().filter(|value| value.is_finite()).collect();
            clip_spikes(&mut values);
            let low = values.iter().copied().reduce(f64::min)?;
            Some([low, values.into_iter().fold(low, f64::max)])
        }
        Scale::Linear => Some([low, high]),
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

/// A rule with a title; returns what is below it.
pub(super) fn titled(title: &str, role: Role, app: &App, area: Rect, buffer: &mut Buffer) -> Rect {
    let theme = &app.theme;
    // The rule is dim; its title is not.
    let style = theme.style(role).remove_modifier(Modifier::DIM);
    let title = format!(" {} ", theme.printable(title));
    let title = Line::from(vec![Span::styled(title, style)]);
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

/// A chart of nodal values over the radius, with marks at the radii of contact and stick. The ordinate is a
/// label and a unit.
fn over_r(
    frame: &Frame,
    abscissa: &'static str,
    (label, unit): (&'static str, &'static str),
) -> Chart {
    Chart {
        marks: edge_marks(frame),
        ..Chart::new("", Axis::new(abscissa, "m"), Axis::new(label, unit))
    }
}

/// A chart of a quantity of every cycle over the cycles so far.
fn over_cycles(frame: &Frame, y: Axis) -> Chart {
    let cycles = Axis::new("cycles", "").bounds(cycles_shown(frame));
    Chart::new("", cycles, y)
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

/// One quantity of every cycle, over the cycles it belongs to.
fn series(frame: &Frame, name: &str, role: Role, of: impl Fn(&Cycle) -> f64) -> Curve {
    let cycles = frame.trend.cycles();
    let (cycles, values): (Vec<f64>, Vec<f64>) =
        cycles.map(|entry| (entry.cycle, of(entry))).unzip();
    Curve::new(name, cycles, values, role)
}

/// One quantity of every finished cycle, over the cycles it belongs to.
fn finished_series(frame: &Frame, role: Role, of: impl Fn(&Cycle) -> f64) -> Curve {
    let cycles = frame.trend.finished_cycles();
    let (cycles, values): (Vec<f64>, Vec<f64>) =
        cycles.map(|entry| (entry.cycle, of(entry))).unzip();
    Curve::new("", cycles, values, role)
}

/// Writes a message in a panel that has nothing to plot.
fn nothing(text: &str, app: &App, area: Rect, buffer: &mut Buffer) {
    Line::styled(format!(" {text}"), app.theme.style(Role::Quiet)).render(area, buffer);
}

/// The radius of the outermost node, m.
fn edge(frame: &Frame) -> f64 {
    frame.observation.radii.last().copied().unwrap_or(0.0)
}

/// The shape that ends all wear at this depth, if closed forms are shown: its worn depth, or that magnified by
/// `times` on top of the unworn profile.
fn limit(frame: &Frame, view: &View, times: Option<f64>) -> Option<Curve> {
    let (radii, unworn) = (&frame.observation.radii[..], &frame.observation.unworn);
    let limit = view.theory(frame)?.limiting_profile(radii)?;
    let worn = limit.iter().zip(&unworn[..]);
    let worn = worn.map(|(f, f0)| times.map_or(f - f0, |times| f0 + times * (f - f0)));
    let worn: Vec<f64> = worn.collect();
    Some(
        Curve::new("limit", radii, worn, Role::Limit)
            .dashed()
            .theory(),
    )
}

/// Marks at the contact radius a and at the permanent stick radius c; where more sticks at the moment, a
/// faint one there.
fn edge_marks(frame: &Frame) -> Vec<Mark> {
    let moment = &frame.observation.moment;
    let mark = |x, label, role| Mark { x, label, role };
    let mut marks = Vec::new();
    if moment.contact_radius > 0.0 {
        marks.push(mark(moment.contact_radius, "a", Role::Contact));
    }
    let within = |c: &f64| *c > 0.0 && *c < moment.contact_radius;
    let permanent = moment.permanent_stick_radius.filter(within);
    let now = moment.stick_radius.filter(within);
    let is_more = |now: &f64| permanent.is_none_or(|c| *now > c * (1.0 + 1e-9));
    marks.extend(now.filter(is_more).map(|now| mark(now, "", Role::Faint)));
    marks.extend(permanent.map(|c| mark(c, "c", Role::Stick)));
    marks
}

/// Stick, slip and open along the radius.
fn zones(frame: &Frame) -> Vec<Zone> {
    let moment = &frame.observation.moment;
    let contact = moment.contact_radius;
    let stick = moment.stick_radius.unwrap_or(contact).min(contact);
    [
        (0.0, stick, Role::Stick, 's', "stick"),
        (stick, contact, Role::Slip, '~', "slip"),
        (contact, edge(frame), Role::Open, '.', "open"),
    ]
    .into_iter()
    .filter(|(from, to, ..)| to > from)
    .map(|(from, to, role, glyph, name)| Zone {
        from,
        to,
        role,
        glyph,
        name,
    })
    .collect()
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

    #[test]
    fn every_panel_is_explained_in_a_box_of_a_small_screen() {
        for panel in Panel::ALL {
            let Words { text, symbols } = panel.words();
            assert!((50..=330).contains(&text.chars().count()), "{panel:?}");
            assert!(!text.contains("  ") && text.ends_with('.'), "{panel:?}");
            assert!((1..=5).contains(&symbols.len()), "{panel:?}");
            for (symbol, meaning) in symbols {
                assert!(
                    symbol.chars().count() <= 11 && meaning.chars().count() <= 60,
                    "{symbol}"
                );
            }
        }
    }
}
