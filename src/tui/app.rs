//! The view: the focused panel, the overlays, and scales that follow the data.
//!
//! The app knows nothing of the simulation. It turns keys into orders for the worker, and frames
//! into a screen.

use std::borrow::Cow;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use ratatui::buffer::Buffer;
use ratatui::layout::{Rect, Size};

use super::command::{Act, Command};
use super::event_loop::Scene;
use super::frame::{Activity, Frame};
use super::held::Held;
use super::keys::Key;
use super::layout;
use super::line::one_line;
use super::overlays::{Answer, Form, Overlay, Palette};
use super::pace::Pace;
use super::panels::{Panel, Shown};
use super::refinement_check::RefinementCheck;
use super::snapshot;
use super::theme::Theme;
use super::tour::{self, Tour};
use super::worker::{Orders, Worker};
use super::{Event, present, screen};
use crate::charts::{Medium, View};
use crate::plot::{Chart, Scale, sticky_bounds};
use crate::reading::Curves;
use crate::scenario::Scenario;

/// The number of cursor positions over the domain, and the initial one.
const CURSOR_PLACES: i16 = 100;
const CURSOR_START: i16 = 33;

/// Columns from which on the contact is what a new user sees first, and rows from which on a tour shows it large.
const CONTACT_FROM: u16 = 100;
const CONTACT_ROWS: u16 = 22;

/// Calm panels take every third frame of a run: a third of the bytes, and of the stresses to compute.
const CALM: u32 = 3;

/// How the program is left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Leave {
    /// The terminal as it was.
    Clean,
    /// The last screen left behind.
    KeepScreen,
}

/// The state of the screen.
pub struct App {
    /// The latest frame; none before the worker's first.
    pub frame: Option<Arc<Frame>>,
    /// The frame that calm panels show while the run goes on, and how many frames it has lasted.
    calm: Option<(Arc<Frame>, u32)>,
    /// The panel with the focus.
    pub focus: Panel,
    /// Whether the focused panel is zoomed.
    pub zoomed: bool,
    /// The panel that had the focus before the contact was shown large.
    before_contact: Option<Panel>,
    /// Whether the contact and one chart are shown for a projector, and since which cycle at which pace.
    pub presents: bool,
    at_pace: (Pace, f64),
    /// The overlay on the panels.
    pub overlay: Overlay,
    /// The tour under way, if there is one.
    pub tour: Option<Tour>,
    /// The panel that had the focus before the tour.
    before_tour: Panel,
    /// A notice, shown until the next key.
    pub notice: Option<String>,
    /// Why a file that a script asked for could not be written: the first one.
    pub unwritten: Option<String>,
    /// True until the first key is pressed.
    pub is_new: bool,
    /// The theme.
    pub theme: Theme,
    /// Set to end the program.
    pub leave: Option<Leave>,
    /// Set to suspend the program to its shell.
    pub suspend: bool,
    /// Whether closed forms are drawn over the plots.
    pub with_theory: bool,
    /// The result of the refinement check; `None` until it has finished.
    pub refinement_check: Option<Result<RefinementCheck, String>>,
    /// Which stress the half-space shows.
    pub stress: Shown,
    stress_bounds: Option<[f64; 2]>,
    /// Where the cursor stands, in hundredths of the domain.
    cursor: Option<i16>,
    log_panels: Vec<Panel>,
    bounds: HashMap<(Panel, Scale), Held>,
    across: HashMap<Panel, Held>,
    charts: HashMap<Panel, Result<Chart, &'static str>>,
    /// Whether the frame is one of another run than the next: scales no longer follow it.
    is_outdated: bool,
    shown: Curves,
    /// The terminal's size.
    pub(super) area: Rect,
    /// How many panels the screen has room for.
    room: usize,
    /// Whether the last click has zoomed, or the opposite.
    pub(super) click_has_zoomed: bool,
    orders: Orders,
}

/// Whether a calm panel may still show `calm` where the others show `frame`: the run goes on, and both
/// have what the panel shows.
fn may_last(calm: &Frame, frame: &Frame) -> bool {
    frame.activity == Activity::Running
        && frame.observation.moment.cycle >= calm.observation.moment.cycle
        && frame.load.is_some() == calm.load.is_some()
        && frame.comparison.is_some() == calm.comparison.is_some()
}

impl Scene for App {
    fn theme(&mut self) -> &mut Theme {
        &mut self.theme
    }

    fn resize(&mut self, size: Size) {
        self.resize(size.width, size.height);
    }

    fn draw(&self, area: Rect, buffer: &mut Buffer) {
        screen::draw(self, area, buffer);
    }

    fn handle(&mut self, event: Event) {
        match event {
            Event::Key(key) => self.press(key),
            Event::Paste(text) => self.paste(&text),
            Event::Point(gesture) => self.point(gesture),
            Event::Frame(slot) => {
                if let Some(frame) = slot.take() {
                    self.take_frame(frame);
                }
            }
            Event::Unwritten(text) => {
                self.unwritten.get_or_insert_with(|| text.clone());
                self.notice = Some(text);
            }
            Event::Notice(text) => self.notice = Some(text),
            Event::RefinementCheck(answer) => self.refinement_check = Some(answer),
            Event::Sweep(live) => self.overlay = Overlay::Sweep(live),
            _ => {}
        }
    }

    fn say(&mut self, notice: &str) {
        self.notice = Some(notice.to_owned());
    }

    fn asks_to_suspend(&mut self) -> bool {
        std::mem::take(&mut self.suspend)
    }

    fn is_left(&self) -> bool {
        self.leave.is_some()
    }
}

impl App {
    /// An app that sends its orders to a worker.
    pub fn new(theme: Theme, orders: Orders) -> Self {
        Self {
            frame: None,
            calm: None,
            focus: Panel::Profile,
            zoomed: false,
            before_contact: None,
            presents: false,
            at_pace: (Pace::Unlimited, 0.0),
            overlay: Overlay::None,
            tour: None,
            before_tour: Panel::Profile,
            notice: None,
            unwritten: None,
            is_new: true,
            theme,
            leave: None,
            suspend: false,
            with_theory: false,
            refinement_check: None,
            stress: Shown::default(),
            stress_bounds: None,
            cursor: None,
            log_panels: Vec::new(),
            bounds: HashMap::new(),
            across: HashMap::new(),
            charts: HashMap::new(),
            is_outdated: false,
            shown: Curves::all(),
            area: Rect::new(0, 0, 80, 24),
            room: layout::room(80, 24),
            click_has_zoomed: false,
            orders,
        }
    }

    /// Takes a new frame.
    pub fn take_frame(&mut self, frame: Arc<Frame>) {
        // Another scenario has another tour.
        self.tour = self.tour.take().filter(|tour| tour.is_of(&frame.origin));
        let shown = self.frame.as_ref().map(|shown| shown.origin.as_str());
        if shown != Some(frame.origin.as_str()) {
            self.log_panels = tour::logarithmic(&frame.origin);
        }
        self.follow_stress(&frame);
        // Where the contact is shown large, it is the stress of one phase of the motion.
        let begins = |frame: &Frame| frame.observation.moment.cycle.floor();
        let shows_contact = self.shows_contact();
        let may_stay = |calm: &Frame, lasted| match shows_contact {
            true => begins(calm) == begins(&frame),
            false => lasted < CALM,
        };
        self.calm = match self.calm.take() {
            Some((calm, lasted)) if may_stay(&calm, lasted) && may_last(&calm, &frame) => {
                Some((calm, lasted + 1))
            }
            _ => Some((Arc::clone(&frame), 1)),
        };
        self.hasten(&frame);
        self.frame = Some(frame);
        self.is_outdated = false;
        self.tell_what_shows();
    }

    /// For a projector, the pace rises when it has been shown for a while.
    fn hasten(&mut self, frame: &Frame) {
        let (pace, began) = self.at_pace;
        let cycle = frame.observation.moment.cycle;
        let is_running = self.presents && frame.activity == Activity::Running;
        let is_same = is_running && pace == frame.pace && cycle >= began;
        let is_due = is_same && present::is_due(frame, began);
        if is_due {
            self.order(|run| run.change_pace(1));
        }
        if is_due || !is_same {
            self.at_pace = (frame.pace, cycle);
        }
    }

    /// The frame that a panel shows where the screen is that of `frame`.
    pub(super) fn frame_of<'a>(&'a self, panel: Panel, frame: &'a Frame) -> &'a Frame {
        // Large, the indenter moves with every frame.
        let is_large = panel == Panel::Section && self.shows_contact();
        match panel.recipe().is_calm && !is_large {
            true => self.calm(frame),
            false => frame,
        }
    }

    /// What a calm panel shows where the others show `frame`.
    pub(super) fn calm<'a>(&'a self, frame: &'a Frame) -> &'a Frame {
        self.calm.as_ref().map_or(frame, |(calm, _)| calm)
    }

    /// The chart of a panel: as it was made when the frame came, else of `frame`.
    pub(super) fn chart(
        &self,
        panel: Panel,
        frame: &Frame,
    ) -> Cow<'_, Result<Chart, &'static str>> {
        match self.charts.get(&panel) {
            Some(chart) => Cow::Borrowed(chart),
            None => Cow::Owned(panel.recipe().chart(&frame.run(), &self.view(panel))),
        }
    }

    /// What the user has chosen for a panel.
    fn view(&self, panel: Panel) -> View {
        View {
            medium: Medium::Screen,
            scale: self.scale(panel),
            with_theory: self.with_theory,
        }
    }

    /// Makes the charts that are seen, once for each frame and key; their scales follow their data.
    fn make_charts(&mut self) {
        self.charts.clear();
        let Some(shown) = self.frame.clone() else {
            return;
        };
        if shown.comparison.is_some() {
            return;
        }
        let (cycle, run) = (shown.observation.moment.cycle, shown.run());
        let calm = self.calm.as_ref().map(|(calm, _)| calm);
        let calm = calm
            .filter(|calm| !Arc::ptr_eq(calm, &shown))
            .map(|calm| calm.run());
        for panel in self.visible() {
            let (recipe, view) = (panel.recipe(), self.view(panel));
            let calm = calm.as_ref().filter(|_| recipe.is_calm);
            let mut chart = recipe.chart(calm.unwrap_or(&run), &view);
            let made = chart.as_ref().ok();
            let extent = panel.extent(self.frame_of(panel, &shown), made);
            if let Some(extent) = extent.filter(|_| !self.is_outdated) {
                Held::hold(self.bounds.entry((panel, view.scale)), extent, cycle);
            }
            let across = made.filter(|_| recipe.keeps_abscissa && !self.is_outdated);
            if let Some(across) = across.and_then(|chart| chart.x.bounds) {
                Held::hold(self.across.entry(panel), across, cycle);
            }
            if let Ok(chart) = &mut chart {
                chart.y.bounds = self.bounds(panel);
                let across = self.across.get(&panel).map(|held| held.bounds);
                chart.x.bounds = across.or(chart.x.bounds);
            }
            self.charts.insert(panel, chart);
        }
    }

    /// The bounds of a panel's ordinate.
    pub fn bounds(&self, panel: Panel) -> Option<[f64; 2]> {
        let held = self.bounds.get(&(panel, self.scale(panel)));
        held.map(|held| held.bounds)
    }

    /// The range of the colours of the stress in the half-space, Pa; `None` where none is shown.
    pub fn stress_bounds(&self) -> Option<[f64; 2]> {
        self.stress_bounds
    }

    /// The colours follow the stress as the scales of the plots follow their data.
    fn follow_stress(&mut self, frame: &Frame) {
        let extent = self.stress.extent(frame);
        self.stress_bounds = extent.map(|extent| {
            let [low, high] = self.stress.quantity.colors().range(extent);
            let [low, high] = sticky_bounds(self.stress_bounds, low, high);
            self.stress.quantity.colors().range([low, high])
        });
    }

    /// Switches the stress shown in the half-space, or to its largest value in a cycle.
    fn show_stress(&mut self, shown: Shown) {
        self.stress = shown;
        self.stress_bounds = None;
        if let Some(frame) = self.frame.clone() {
            self.follow_stress(&frame);
        }
        self.notice = Some(format!("cross-section: {}", self.stress.name()));
    }

    /// Whether a panel's ordinate is logarithmic.
    pub fn scale(&self, panel: Panel) -> Scale {
        if self.log_panels.contains(&panel) {
            Scale::Log
        } else {
            Scale::Linear
        }
    }

    /// The panels on the screen.
    pub fn visible(&self) -> Vec<Panel> {
        if self.presents {
            vec![Panel::Section, self.presented()]
        } else if self.zoomed {
            vec![self.focus]
        } else {
            self.page(self.room).to_vec()
        }
    }

    /// The panels beside the focused one where `room` of them fit.
    pub fn page(&self, room: usize) -> &[Panel] {
        let at = self.focus.index() / room.max(1) * room;
        &Panel::ALL[at..(at + room).min(Panel::ALL.len())]
    }

    /// Which page that is, counted from 1, and how many there are.
    pub fn pages(&self, room: usize) -> (usize, usize) {
        let room = room.max(1);
        (
            self.focus.index() / room + 1,
            Panel::ALL.len().div_ceil(room),
        )
    }

    /// Notes the terminal's size: hidden panels are not computed.
    pub fn resize(&mut self, columns: u16, rows: u16) {
        self.area = Rect::new(0, 0, columns, rows);
        self.room = layout::room(columns, rows);
        self.tell_what_shows();
    }

    /// The first panel of the next page gets the focus.
    pub(super) fn turn_page(&mut self) {
        let (page, pages) = self.pages(self.room);
        self.focus = Panel::ALL[page % pages * self.room];
    }

    /// Handles a key. `Ctrl-C` quits from anywhere, even while typing.
    pub fn press(&mut self, key: Key) {
        self.notice = None;
        // The answer to a key is seen at once.
        self.calm = None;
        self.is_new = false;
        if key == Key::Ctrl('c') {
            self.leave = Some(Leave::Clean);
            return;
        }
        let mut overlay = std::mem::take(&mut self.overlay);
        if overlay.press(key, self) == Answer::Stay {
            self.overlay = overlay;
        }
        self.tell_what_shows();
    }

    /// Takes pasted text where a line is typed.
    pub fn paste(&mut self, text: &str) {
        self.is_new = false;
        let fits = self.overlay.line().map(|line| line.paste(text));
        self.notice = match fits {
            Some(true) => None,
            Some(false) => Some("the pasted text is longer than one line and was cut".into()),
            None => Some("there is no line to paste into; : opens one".into()),
        };
    }

    /// Carries out a command.
    pub(super) fn run(&mut self, command: Command) {
        let row = command.row();
        match row.act {
            Act::Screen(act) => act(self),
            Act::Worker(act) => self.order(act),
            Act::Palette(_) => self.overlay = Overlay::Palette(Palette::begun(row.name)),
        }
    }

    /// Leaves the tour, the contact, or the zoomed panel.
    pub(super) fn go_back(&mut self) {
        match () {
            () if self.tour.is_some() => self.end_tour(),
            () if self.shows_contact() => self.leave_contact(),
            () => self.zoomed = false,
        }
    }

    pub(super) fn zoom_or_unzoom(&mut self) {
        match self.shows_contact() {
            true => self.leave_contact(),
            false => self.zoomed = !self.zoomed,
        }
    }

    pub(super) fn show_or_leave_contact(&mut self) {
        match self.shows_contact() {
            true => self.leave_contact(),
            false => self.show_contact(),
        }
    }

    pub(super) fn drop_ghosts(&mut self) {
        self.forget_scales();
        self.order(Worker::drop_ghosts);
    }

    /// Opens the checks of the run, and has its errors estimated.
    pub(super) fn check_accuracy(&mut self) {
        self.refinement_check = None;
        self.overlay = Overlay::Accuracy;
        self.order(|run| run.check_refinement());
    }

    pub(super) fn toggle_cursor(&mut self) {
        self.cursor = match self.cursor {
            None => Some(CURSOR_START),
            Some(_) => None,
        }
    }

    pub(super) fn change_theme(&mut self) {
        self.theme.follows_background = false;
        self.theme.look = self.theme.look.next();
        self.notice = Some(format!("theme {}", self.theme.look.name()));
    }

    pub(super) fn show_next_stress(&mut self) {
        let quantity = self.stress.quantity.next();
        self.show_stress(Shown {
            quantity,
            ..self.stress
        });
    }

    pub(super) fn show_stress_of_cycle_or_moment(&mut self) {
        let over_cycle = !self.stress.over_cycle;
        self.show_stress(Shown {
            over_cycle,
            ..self.stress
        });
    }

    /// Whether the contact is shown large: the cross-section alone.
    pub fn shows_contact(&self) -> bool {
        self.presents || self.zoomed && self.focus == Panel::Section
    }

    /// Shows the contact itself, large.
    pub fn show_contact(&mut self) {
        self.before_contact = Some(std::mem::replace(&mut self.focus, Panel::Section));
        self.zoomed = true;
    }

    /// Shows the contact and one chart for a projector, at a pace that rises by itself.
    pub fn present(&mut self) {
        self.presents = true;
        self.focus = present::CHART;
    }

    /// The chart beside the contact.
    pub fn presented(&self) -> Panel {
        match self.focus {
            Panel::Section => present::CHART,
            panel => panel,
        }
    }

    /// All panels again, and the focus where it was before.
    fn leave_contact(&mut self) {
        (self.zoomed, self.presents) = (false, false);
        self.focus = self.before_contact.take().unwrap_or(self.focus);
    }

    /// Opens the words of a key.
    pub(super) fn list_words(&mut self, path: &'static str) {
        let settings = self.frame.as_ref().map(|frame| Arc::clone(&frame.settings));
        let mut known = settings.iter().flat_map(|settings| settings.iter());
        if known.any(|setting| setting.parameter.path == path) {
            self.overlay = Overlay::Form(Form::choosing(path));
        } else {
            self.notice = Some(format!("this scenario has no {path}"));
        }
    }

    /// Shows a new user the contact where there is room for it, and begins the tour of the default preset.
    pub fn welcome(&mut self, origin: &str) {
        if origin == super::FIRST {
            self.begin_tour(origin);
        } else if self.has_room_for_contact() {
            self.show_contact();
        }
    }

    /// Begins the tour of the scenario, whatever is on the screen.
    pub fn begin_tour(&mut self, origin: &str) {
        self.tour = Tour::of(origin);
        self.before_tour = self.focus;
        self.follow_tour();
    }

    /// Begins the tour, or shows its next caption.
    pub(super) fn continue_tour(&mut self) {
        if let Some(tour) = self.tour.take() {
            self.tour = tour.next();
            if self.tour.is_none() {
                self.return_from_tour();
                self.notice =
                    Some("end of the tour; Enter explains a panel, p has more presets".into());
            }
        } else if let Some(frame) = self.frame.clone() {
            self.begin_tour(&frame.origin);
            if self.tour.is_none() {
                self.notice = Some("only presets have tours; p lists them".into());
            }
        }
        self.follow_tour();
    }

    /// The tour is over: the focus is where it was before.
    fn end_tour(&mut self) {
        if self.tour.take().is_some() {
            self.return_from_tour();
        }
    }

    /// A contact that is shown large stays, and leads back to where the tour began.
    fn return_from_tour(&mut self) {
        match self.shows_contact() {
            true => self.before_contact = Some(self.before_tour),
            false => self.focus = self.before_tour,
        }
    }

    /// The panel that the caption is about gets the focus; the contact is shown large where there is room.
    fn follow_tour(&mut self) {
        let caption = self.tour.as_ref().and_then(Tour::caption);
        let Some(panel) = caption.and_then(|caption| caption.panel()) else {
            return;
        };
        if self.shows_contact() {
            self.leave_contact();
        }
        match panel {
            Panel::Section if self.area.height >= CONTACT_ROWS => self.show_contact(),
            panel => self.focus = panel,
        }
    }

    /// Whether the contact is worth seeing at first.
    pub fn has_room_for_contact(&self) -> bool {
        self.area.width >= CONTACT_FROM
    }

    /// Moves the cursor by a hundredth of the domain, or the focus where there is no cursor.
    pub(super) fn move_sideways(&mut self, places: i16) {
        match &mut self.cursor {
            Some(place) => *place = (*place + places).clamp(0, CURSOR_PLACES),
            None => self.focus = self.focus.shifted(isize::from(places)),
        }
    }

    /// The radius at the cursor, m, if there is one.
    pub fn cursor_radius(&self, frame: &Frame) -> Option<f64> {
        let edge = frame.observation.radii.last()?;
        let place = self.cursor?;
        Some(edge * f64::from(place) / f64::from(CURSOR_PLACES))
    }

    /// Whether there is a cursor.
    pub(super) fn has_cursor(&self) -> bool {
        self.cursor.is_some()
    }

    /// Puts the cursor to the place nearest to a radius, m.
    pub(super) fn put_cursor(&mut self, frame: &Frame, radius: f64) {
        if let Some(edge) = frame.observation.radii.last() {
            let place = (radius / edge * f64::from(CURSOR_PLACES)).round();
            self.cursor = Some((place as i16).clamp(0, CURSOR_PLACES));
        }
    }

    /// Whether the accuracy panel waits for the refinement_check.
    pub fn awaits_companion(&self) -> bool {
        self.overlay == Overlay::Accuracy && self.refinement_check.is_none()
    }

    /// Loads a scenario, or the state in a directory.
    pub(super) fn load(&mut self, name: &str) {
        let path = Path::new(name);
        if path.is_dir() {
            match snapshot::open(path) {
                Ok(opened) => {
                    self.forget_scales();
                    self.order(|run| run.open(opened));
                }
                Err(error) => self.notice = Some(error),
            }
            return;
        }
        match Scenario::load(name, &[]) {
            Ok(scenario) => {
                self.forget_scales();
                self.order(|run| run.load(scenario));
            }
            Err(error) => self.notice = Some(one_line(&error.to_string())),
        }
    }

    pub(super) fn restart(&mut self) {
        self.forget_scales();
        self.order(Worker::restart);
    }

    pub(super) fn toggle_log(&mut self) {
        let focus = self.focus;
        if !focus.recipe().can_be_log {
            self.notice = Some(format!(
                "the {} panel has no logarithmic scale",
                focus.title()
            ));
        } else if self.log_panels.contains(&focus) {
            self.log_panels.retain(|panel| *panel != focus);
        } else {
            self.log_panels.push(focus);
        }
    }

    fn forget_scales(&mut self) {
        self.bounds.clear();
        self.across.clear();
        self.is_outdated = true;
        self.stress_bounds = None;
    }

    /// Makes what shows, and tells the worker: hidden panels cost neither a chart nor a transform.
    pub(super) fn tell_what_shows(&mut self) {
        self.make_charts();
        // The checks of the status line need the pressure, whatever panel shows it.
        let mut shown = Curves::PRESSURE;
        for panel in self.visible() {
            shown |= panel.recipe().needs;
        }
        // A comparison covers all panels, and a cursor reads all curves.
        if self
            .frame
            .as_ref()
            .is_some_and(|frame| frame.comparison.is_some())
        {
            shown |= Curves::PROFILE;
        }
        if self.cursor.is_some() {
            shown |= Curves::PROFILE | Curves::SHEAR | Curves::PROFILE_1D;
        }
        if shown != self.shown {
            self.shown = shown;
            self.order(move |run| run.compute(shown));
        }
    }

    /// Has the worker do something.
    pub(super) fn order(&self, order: impl FnOnce(&mut Worker) + Send + 'static) {
        self.orders.send(order);
    }
}
