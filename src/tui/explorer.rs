//! What is on the screen under the overlays: the run, the stage and its charts, and what is told to the user.
//!
//! The explorer knows nothing of the simulation: it sends orders to the worker, and shows the frames that come back.

use std::path::Path;
use std::sync::Arc;

use ratatui::prelude::*;

use super::frame::Frame;
use super::line::one_line;
use super::live_charts::{Calm, LiveCharts};
use super::panels::StressMap;
use super::present::SpeedUp;
use super::readout::Cursor;
use super::stage::Stage;
use super::undo::Past;
use super::worker::{Orders, Worker};
use super::{layout, snapshot, timeline};
use crate::plot::theme::Theme;
use crate::reading::Curves;
use crate::scenario::Scenario;

/// What follows a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Next {
    /// The explorer goes on.
    Stay,
    /// The user asks for the shell.
    Suspend,
    /// The user sees that another program has written to the terminal.
    Repaint,
    /// The user leaves, and the terminal is as it was.
    Leave,
    /// The user leaves, and the last screen stays.
    LeaveScreen,
}

/// What the overlays lie on.
pub struct Explorer {
    /// The latest frame.
    pub frame: Arc<Frame>,
    /// The frame of calm panels.
    pub(super) calm: Calm,
    /// Which panels there are.
    pub stage: Stage,
    /// Their charts and scales.
    pub charts: LiveCharts,
    /// The stress in the half-space.
    pub stress: StressMap,
    /// The cursor over r.
    pub cursor: Cursor,
    /// How a lecture speeds up.
    speed_up: SpeedUp,
    /// A notice, shown until the next key.
    pub notice: Option<String>,
    /// Why a file that a script asked for could not be written: the first one.
    pub unwritten: Option<String>,
    /// True until the first key is pressed.
    pub is_new: bool,
    /// The theme.
    pub theme: Theme,
    /// Set to end the program, or to suspend it to its shell.
    pub next: Next,
    /// What the worker computes.
    computed: Curves,
    /// The way to the worker.
    pub(super) orders: Orders,
}

impl Explorer {
    /// An explorer that shows the first frame of a worker, and sends its orders to it.
    pub fn new(theme: Theme, orders: Orders, frame: Arc<Frame>) -> Self {
        let mut explorer = Self {
            frame: Arc::clone(&frame),
            calm: Calm::default(),
            stage: Stage::default(),
            charts: LiveCharts::default(),
            stress: StressMap::default(),
            cursor: Cursor::default(),
            speed_up: SpeedUp::default(),
            notice: None,
            unwritten: None,
            is_new: true,
            theme,
            next: Next::Stay,
            computed: Curves::all(),
            orders,
        };
        explorer.stage.area = Rect::new(0, 0, 80, 24);
        explorer.take_frame(frame);
        explorer
    }

    /// Takes a new frame.
    pub fn take_frame(&mut self, frame: Arc<Frame>) {
        let origin = frame.facts.scenario.origin();
        self.charts.begin(origin);
        // Another scenario has another tour.
        self.stage.tour.take_if(|tour| tour.origin != origin);
        self.stress.follow(&frame);
        self.calm.take(&frame, self.stage.shows_contact());
        if self.speed_up.is_due(&frame, self.stage.presents) {
            self.order(|run| run.change_pace(1));
        }
        self.frame = frame;
        self.show();
    }

    /// The preset or the file on the screen.
    pub(super) fn origin(&self) -> &str {
        self.frame.facts.scenario.origin()
    }

    /// Whether a second run takes the place of all panels.
    pub(super) fn compares(&self) -> bool {
        self.frame.comparison.is_some()
    }

    /// Notes the terminal's size: hidden panels are not computed.
    pub fn resize(&mut self, size: Size) {
        self.stage.area = size.into();
        self.show();
    }

    /// The user has pressed a key or a button: a notice has been read, and the answer is seen at once.
    pub(super) fn begin_answer(&mut self) {
        self.notice = None;
        self.calm = Calm::default();
        self.is_new = false;
    }

    /// A click travels along the timeline, moves the cursor in a chart, or is the stage's.
    pub(super) fn click(&mut self, at: Position, is_second: bool) {
        self.begin_answer();
        let frame = Arc::clone(&self.frame);
        let bands = layout::bands(self.stage.area).filter(|_| !self.compares());
        let Some([_, line, area, _]) = bands else {
            return;
        };
        if let Some(cycle) = timeline::cycle_at(&frame, line, at) {
            let visit = move |past: &mut Past| past.visit(cycle);
            return self.order(move |run| run.travel(visit, "no state is stored"));
        }
        let mut places = self.stage.places(area).into_iter();
        let Some((panel, place)) = places.find(|(_, place)| place.contains(at)) else {
            return;
        };
        let chart = self.charts.get(panel, &frame);
        let chart = chart.as_ref().as_ref().ok();
        let radius = chart.and_then(|chart| panel.radius_at(chart, &self.theme, place, at));
        let radius = radius.filter(|_| self.cursor.is_shown() && !is_second);
        if let Some(radius) = radius {
            self.cursor.put(&frame, radius);
        }
        self.stage.click(panel, is_second, radius.is_some());
        self.show();
    }

    pub(super) fn change_theme(&mut self) {
        self.theme.follows_background = false;
        self.theme.look = self.theme.look.next();
        self.notice = Some(format!("theme {}", self.theme.look));
    }

    /// Changes the stress in the half-space.
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

    /// Moves the cursor by a hundredth of the domain, or the focus where there is no cursor.
    pub(super) fn move_sideways(&mut self, places: i16) {
        match self.cursor.is_shown() {
            true => self.cursor.shift(places),
            false => self.stage.shift_focus(isize::from(places)),
        }
    }

    pub(super) fn toggle_log(&mut self) {
        let focus = self.stage.focus;
        match focus.recipe().can_be_log {
            true => self.charts.toggle_log(focus),
            false => {
                let title = focus.recipe().title;
                self.notice = Some(format!("the {title} panel has no logarithmic scale"));
            }
        }
    }

    /// Loads a scenario, or the state in a directory.
    pub(super) fn load(&mut self, path: &Path) {
        let loaded = match path.is_dir() {
            true => {
                snapshot::open(path).map(|run| self.order_anew(|worker| worker.replace_run(run)))
            }
            false => {
                let scenario = Scenario::load(path, &[]);
                let scenario = scenario.map_err(|error| one_line(&error.to_string()));
                scenario.map(|scenario| self.order_anew(|run| _ = run.load(scenario)))
            }
        };
        self.notice = loaded.err();
    }

    /// Has the worker show something else, for which the scales begin anew.
    pub(super) fn order_anew(&mut self, order: impl FnOnce(&mut Worker) + Send + 'static) {
        self.charts.forget_scales();
        self.stress.bounds = None;
        self.order(order);
    }

    /// Makes what shows, and tells the worker: hidden panels cost neither a chart nor a transform.
    pub(super) fn show(&mut self) {
        let visible = self.stage.visible();
        let shown = |panel| self.calm.shown(panel, &self.stage, &self.frame);
        self.charts.make(&visible, &self.frame, shown);
        let needs = visible.iter().map(|panel| panel.recipe().needs);
        let mut needed = needs.fold(Curves::empty(), Curves::union);
        // A cursor reads all curves.
        if self.cursor.is_shown() {
            needed |= Curves::PROFILE | Curves::PRESSURE | Curves::SHEAR | Curves::PROFILE_1D;
        }
        if needed != self.computed {
            self.computed = needed;
            self.order(move |run| run.curves = needed);
        }
    }

    /// Has the worker do something.
    pub(super) fn order(&self, order: impl FnOnce(&mut Worker) + Send + 'static) {
        self.orders.send(order);
    }
}
