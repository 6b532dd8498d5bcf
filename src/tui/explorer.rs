//! The screen below the overlays: the run, the stage and its charts, and notices to the user.
//!
//! The explorer knows nothing about the simulation: it sends orders to the worker, and shows the frames that come back.

use std::path::Path;
use std::sync::Arc;

use ratatui::prelude::*;

use super::cursor::{self, Abscissa, Cursor, abscissa};
use super::frame::Frame;
use super::line::one_line;
use super::live_charts::{Calm, LiveCharts};
use super::panels::{self, Drawn, Panel, StressMap, numbers};
use super::present::SpeedUp;
use super::recorded::Recorded;
use super::stage::Stage;
use super::undo::Way;
use super::worker::files::{self, Copied};
use super::worker::ghosts::Ghosts;
use super::worker::{Order, Orders};
use super::{clipboard, layout, readout, snapshot, timeline};
use crate::plot::theme::Theme;
use crate::reading::Curves;
use crate::scenario::Scenario;

/// What the event loop should do after a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Next {
    /// Continue.
    Stay,
    /// Suspend the program to its shell.
    Suspend,
    /// Repaint, because another program has written to the terminal.
    Repaint,
    /// Leave, and restore the terminal's previous screen.
    Leave,
    /// Leave, and keep the last screen visible.
    LeaveScreen,
}

/// The state of the screen below the overlays.
pub struct Explorer {
    /// The latest frame.
    pub frame: Arc<Frame>,
    /// The frame shown by calm panels.
    pub(super) calm: Calm,
    /// The choice and layout of panels.
    pub stage: Stage,
    /// The charts and their scales.
    pub charts: LiveCharts,
    /// The stress shown in the half-space.
    pub stress: StressMap,
    /// Its samples on the screen.
    pub drawn: Drawn,
    /// The cursor.
    pub cursor: Cursor,
    /// How the pace increases for an audience.
    speed_up: SpeedUp,
    /// A notice, shown until the next key.
    pub notice: Option<String>,
    /// The sequence that copies a text to the terminal's clipboard.
    pub to_clipboard: Option<String>,
    /// Why the first file that a script asked for and did not get could not be written.
    pub unwritten: Option<String>,
    /// True until the first key is pressed.
    pub is_new: bool,
    /// The theme.
    pub theme: Theme,
    /// Whether the user has chosen it with the key.
    pub has_chosen_theme: bool,
    /// What the event loop should do next.
    pub next: Next,
    /// The curves that the worker computes.
    computed: Curves,
    /// The channel to the worker.
    pub(super) orders: Orders,
}

impl Explorer {
    /// Makes an explorer that shows the first frame of a worker, and sends its orders to it.
    pub fn new(theme: Theme, orders: Orders, frame: Arc<Frame>) -> Self {
        let mut explorer = Self {
            frame: Arc::clone(&frame),
            calm: Calm::default(),
            stage: Stage::default(),
            charts: LiveCharts::default(),
            stress: StressMap::default(),
            drawn: Drawn::default(),
            cursor: Cursor::default(),
            speed_up: SpeedUp::default(),
            notice: None,
            to_clipboard: None,
            unwritten: None,
            is_new: true,
            theme,
            has_chosen_theme: false,
            next: Next::Stay,
            computed: Curves::all(),
            orders,
        };
        explorer.stage.area = Rect::new(0, 0, 80, 24);
        explorer.show_frame(frame);
        explorer
    }

    /// Shows a new frame.
    pub fn show_frame(&mut self, frame: Arc<Frame>) {
        let origin = frame.live.scenario.origin();
        self.charts.begin(origin);
        self.stage.happens = frame.live.subject();
        // Another scenario has another tour.
        self.stage.tour.take_if(|tour| tour.origin != origin);
        // The stress is drawn of the calm frame, so its range follows that one.
        if self.calm.update(&frame, self.stage.shows_contact()) {
            self.stress.follow(&frame);
        }
        if self.speed_up.is_due(&frame, self.stage.presents) {
            self.order(Order::Pace(1));
        }
        self.frame = frame;
        self.show();
    }

    /// Returns the preset or the file on the screen.
    pub(super) fn origin(&self) -> &str {
        self.frame.live.scenario.origin()
    }

    /// Stores the terminal's size; hidden panels are not computed.
    pub fn resize(&mut self, size: Size) {
        self.stage.area = size.into();
        self.show();
    }

    /// Begins the answer to a key or a click: clears the notice, and lets the answer show at once.
    pub(super) fn begin_answer(&mut self) {
        self.notice = None;
        self.calm = Calm::default();
        self.is_new = false;
    }

    /// Handles a click: on the timeline it travels in time, in a chart it moves the cursor, else it goes to the stage.
    pub(super) fn click(&mut self, at: Position, is_second: bool) {
        self.begin_answer();
        let frame = Arc::clone(&self.frame);
        let Some([_, line, area, _]) = layout::bands(self.stage.area) else {
            return;
        };
        if let Some(cycle) = timeline::cycle_at(&frame, line, at) {
            return self.order(Order::Travel(Way::Near(cycle)));
        }
        let [area, _] = self.stage.with_list(area);
        let mut places = self.stage.places(area).into_iter();
        let Some((panel, place)) = places.find(|(_, place)| place.contains(at)) else {
            return;
        };
        let recipe = panel.chart();
        let chart = recipe.map(|recipe| self.charts.get(panel, recipe, &frame));
        let chart = chart.as_deref().and_then(|made| made.as_ref().ok());
        let place = chart.and_then(|chart| panels::abscissa_at(chart, &self.theme, place, at));
        let place = place.filter(|_| self.cursor.is_shown() && !is_second);
        if let Some((place, whole)) = place.zip(self.charts.whole_range(panel)) {
            self.cursor.put(abscissa(panel), whole, place);
        }
        self.stage.click(panel, is_second, place.is_some());
        self.show();
    }

    pub(super) fn change_theme(&mut self) {
        (self.theme.follows_background, self.has_chosen_theme) = (false, true);
        self.theme.look = self.theme.look.next();
        self.notice = Some(format!("theme {}", self.theme.look));
    }

    /// Changes the stress shown in the half-space.
    pub(super) fn change_stress(&mut self, change: fn(&mut StressMap)) {
        change(&mut self.stress);
        self.stress.follow(&self.frame);
        self.notice = Some(format!("cross-section: {}", self.stress.names()[0]));
    }

    /// Begins the tour, or shows its next caption.
    pub(super) fn continue_tour(&mut self) {
        let origin = self.origin().to_owned();
        self.notice = self.stage.continue_tour(&origin).map(str::to_owned);
    }

    /// Returns the abscissa of the focused panel, along which the cursor moves, and its ends.
    fn focused_axis(&self) -> Option<(Abscissa, [f64; 2])> {
        let of = abscissa(self.stage.focus);
        let whole = match of {
            cursor::RADIUS => Some([0.0, self.frame.run.edge()]),
            _ => self.charts.whole_range(self.stage.focus),
        };
        Some((of, whole?))
    }

    /// Returns the cursor's position in a panel: on r in all panels, else only in panels with the focused one's
    /// abscissa.
    pub(super) fn cursor_in(&self, panel: Panel) -> Option<f64> {
        let of = abscissa(panel);
        match of {
            cursor::RADIUS => self.cursor.place(of, [0.0, self.frame.run.edge()]),
            _ => {
                let (focused, whole) = self.focused_axis()?;
                self.cursor.place(of, whole).filter(|_| of == focused)
            }
        }
    }

    /// Moves the cursor by a hundredth of the shown part, or the focus if there is no cursor.
    pub(super) fn move_sideways(&mut self, places: i16) {
        match self.focused_axis().filter(|_| self.cursor.is_shown()) {
            Some((of, whole)) => self.cursor.shift(of, whole, places),
            None => self.stage.shift_focus(isize::from(places)),
        }
    }

    /// Zooms around the cursor, or moves the focus if there is no cursor.
    pub(super) fn move_upwards(&mut self, is_up: bool) {
        match self.focused_axis().filter(|_| self.cursor.is_shown()) {
            Some((of, whole)) => self.cursor.zoom(of, whole, is_up),
            None => self.stage.shift_focus(if is_up { -1 } else { 1 }),
        }
    }

    /// Undoes all zooms.
    pub(super) fn show_all(&mut self) {
        if !self.cursor.show_all() {
            self.notice =
                Some("all is shown; with a cursor (x) the arrows up and down zoom".into());
        }
    }

    /// Zooms around the cursor with the wheel; shows the cursor first if necessary.
    pub(super) fn wheel(&mut self, is_up: bool) {
        self.begin_answer();
        if !self.cursor.is_shown() {
            self.cursor.toggle();
        }
        self.move_upwards(is_up);
        self.show();
    }

    /// Copies something to the clipboard; asks the worker for what concerns the run.
    pub(super) fn copy(&mut self, what: Copied) {
        if what != Copied::Readings {
            return self.order(files::copy(what));
        }
        let mut text = numbers::text(&self.frame);
        if let Some(place) = self.cursor_in(self.stage.focus) {
            let (frame, focus) = (&self.frame, self.stage.focus);
            text += &readout::line_at(frame, &self.charts, focus, place, usize::MAX, &self.theme);
        }
        self.copy_to_clipboard(&text, "the readings are");
    }

    /// Copies a text to the terminal's clipboard; the notice names it as `what`.
    pub(super) fn copy_to_clipboard(&mut self, text: &str, what: &str) {
        self.to_clipboard = clipboard::request(text);
        self.notice = Some(match self.to_clipboard {
            Some(_) => format!("{what} copied, if the terminal allows it"),
            None => format!("{what} too long for the clipboard of a terminal; s writes files"),
        });
    }

    /// Closes one thing at a time: the tour, the cursor, what is shown large, the closed forms.
    pub(super) fn go_back(&mut self) {
        if self.stage.tour.is_some() {
            self.stage.go_back();
        } else if self.cursor.is_shown() {
            self.cursor.toggle();
        } else if !self.stage.go_back() {
            self.charts.with_theory = false;
        }
    }

    pub(super) fn toggle_log(&mut self) {
        let focus = self.stage.focus;
        if focus.recipe().can_be_log {
            self.charts.toggle_log(focus)
        } else {
            let title = focus.recipe().title;
            self.notice = Some(format!("the {title} panel has no logarithmic scale"));
        }
    }

    /// Loads a scenario, or the state in a directory.
    pub(super) fn load(&mut self, path: &Path) {
        let loaded = if path.is_dir() {
            snapshot::open(path).map(|run| Order::Continue(Box::new(run)))
        } else {
            let scenario = Scenario::load(path, &[]);
            let scenario = scenario.map_err(|error| one_line(&error.to_string()));
            scenario.map(|scenario| Order::Load(Box::new(scenario)))
        };
        match loaded {
            Ok(order) => self.order_with_new_scales(order),
            Err(error) => self.notice = Some(error),
        }
    }

    /// Begins or ends a comparison; shows the panels, since the large contact has no curves.
    pub(super) fn compare(&mut self, compare: fn(&mut Ghosts, &Recorded) -> Option<String>) {
        self.stage.leave_contact();
        self.order(Order::Ghosts(Box::new(compare)));
    }

    /// Orders something for which the scales start afresh.
    pub(super) fn order_with_new_scales(&mut self, order: Order) {
        self.charts.forget_scales();
        self.stress.forget_range();
        self.order(order);
    }

    /// Makes the visible charts, and tells the worker what they need: hidden panels cost neither a chart nor a
    /// transform.
    pub(super) fn show(&mut self) {
        let visible = self.stage.visible();
        let shown = |panel| self.calm.shown(panel, &self.stage, &self.frame);
        self.charts.make(&visible, &self.frame, shown, &self.cursor);
        let needs = visible.iter().map(|panel| panel.recipe().needs);
        let mut needed = needs.fold(Curves::empty(), Curves::union);
        // The cursor reads all curves.
        if self.cursor.is_shown() {
            needed |= Curves::PROFILE | Curves::PRESSURE | Curves::SHEAR | Curves::PROFILE_1D;
        }
        if needed != self.computed {
            self.computed = needed;
            self.order(Order::Show(needed));
        }
    }

    /// Sends an order to the worker.
    pub(super) fn order(&self, order: Order) {
        self.orders.send(order);
    }
}
