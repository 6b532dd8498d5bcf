//! The screen's state: the stage and its charts, the overlay on them, and what is told to the user.
//!
//! The app knows nothing of the simulation. It turns keys into orders for the worker, and frames
//! into a screen.

use std::path::Path;
use std::sync::Arc;

use ratatui::prelude::*;

use super::command::{Act, Command};
use super::event_loop::Next;
use super::frame::Frame;
use super::keys::Key;
use super::line::one_line;
use super::live_charts::{Calm, LiveCharts};
use super::map::live::{Live, OPENING};
use super::overlays::{Answer, Overlay, Palette};
use super::panels::StressMap;
use super::present::SpeedUp;
use super::readout::Cursor;
use super::snapshot;
use super::stage::Stage;
use super::theme::Theme;
use super::worker::{Orders, Worker};
use super::{Event, Input};
use crate::reading::Curves;
use crate::scenario::Scenario;

/// The state of the screen.
pub struct App {
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
    /// The overlay on the panels.
    pub overlay: Overlay,
    /// The map that the run was opened from, if it leads back there.
    pub(super) map: Option<Live>,
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
    orders: Orders,
}

impl App {
    /// Answers what is not the terminal's own; a notice is shown until the next key.
    pub(super) fn handle(&mut self, event: Event) {
        match event {
            Event::Input(Input::Key(key)) => self.press(key),
            Event::Input(Input::Paste(text)) => self.paste(&text),
            Event::Input(Input::Point(gesture)) => self.point(gesture),
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
            Event::Sweep(live) => self.overlay = Overlay::Sweep(live),
            Event::Opened => {
                self.overlay = Overlay::None;
                self.notice.take_if(|told| told == OPENING);
            }
            _ => {}
        }
    }

    /// An app that shows the first frame of a worker, and sends its orders to it.
    pub fn new(theme: Theme, orders: Orders, frame: Arc<Frame>) -> Self {
        let mut app = Self {
            frame: Arc::clone(&frame),
            calm: Calm::default(),
            stage: Stage::default(),
            charts: LiveCharts::default(),
            stress: StressMap::default(),
            cursor: Cursor::default(),
            speed_up: SpeedUp::default(),
            overlay: Overlay::None,
            map: None,
            notice: None,
            unwritten: None,
            is_new: true,
            theme,
            next: Next::Stay,
            computed: Curves::all(),
            orders,
        };
        app.stage.area = Rect::new(0, 0, 80, 24);
        app.take_frame(frame);
        app
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

    /// Handles a key. `Ctrl-C` quits from anywhere, even while typing.
    pub fn press(&mut self, key: Key) {
        self.notice = None;
        // The answer to a key is seen at once.
        self.calm = Calm::default();
        self.is_new = false;
        if key == Key::Ctrl('c') {
            self.next = Next::Leave;
            return;
        }
        let mut overlay = std::mem::take(&mut self.overlay);
        if overlay.press(key, self) == Answer::Stay {
            self.overlay = overlay;
        }
        self.show();
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
            Act::Palette(_) => {
                let begun = Palette::begun(&format!("{} ", row.name), Overlay::None);
                self.overlay = Overlay::Palette(begun);
            }
        }
    }

    /// Ends the program, or leads back to the map that the run was opened from.
    pub(super) fn quit(&mut self) {
        match self.map.take() {
            Some(map) => self.overlay = Overlay::Sweep(map),
            None => self.next = Next::Leave,
        }
    }

    /// Opens the checks of the run, and has its errors estimated.
    pub(super) fn check_accuracy(&mut self) {
        self.overlay = Overlay::Accuracy { explains: false };
        self.order(Worker::estimate_errors);
    }

    pub(super) fn change_theme(&mut self) {
        self.theme.follows_background = false;
        self.theme.look = self.theme.look.next();
        self.notice = Some(format!("theme {}", self.theme.look.name()));
    }

    /// Changes the stress in the half-space.
    pub(super) fn change_stress(&mut self, change: fn(&mut StressMap)) {
        change(&mut self.stress);
        self.stress.follow(&self.frame);
        self.notice = Some(format!("cross-section: {}", self.stress.names()[0]));
    }

    /// Opens the words of a key.
    pub(super) fn list_words(&mut self, path: &'static str) {
        let mut settings = self.frame.facts.settings.iter();
        match settings.find(|setting| setting.parameter.path == path) {
            Some(setting) => {
                let words = Palette::choosing(setting, None, Overlay::None);
                self.overlay = Overlay::Palette(words);
            }
            None => self.notice = Some(format!("this scenario has no {path}")),
        }
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
    pub(super) fn load(&mut self, name: &str) {
        let path = Path::new(name);
        let loaded = match path.is_dir() {
            true => {
                snapshot::open(path).map(|run| self.order_anew(|worker| worker.replace_run(run)))
            }
            false => {
                let scenario = Scenario::load(name, &[]);
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
        // The checks of the status line need the pressure, whatever panel shows it.
        let mut needed = needs.fold(Curves::PRESSURE, Curves::union);
        // A comparison covers all panels, and a cursor reads all curves.
        if self.compares() {
            needed |= Curves::PROFILE;
        }
        if self.cursor.is_shown() {
            needed |= Curves::PROFILE | Curves::SHEAR | Curves::PROFILE_1D;
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
