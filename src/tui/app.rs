//! The view: which panel has the focus, what lies over the panels, and how the eye follows the data.
//!
//! The app knows no simulation. It turns keys into orders for the worker and frames into a screen.

use std::collections::HashMap;
use std::sync::Arc;
use std::sync::mpsc::Sender;

use super::command::{self, Command};
use super::companion::Companion;
use super::frame::Frame;
use super::keys::Key;
use super::panels::Panel;
use super::plot::{Scale, sticky_bounds};
use super::theme::Theme;
use super::theory::Theory;
use super::worker::Order;
use crate::scenario::{Scenario, preset};
use crate::simulation::Curves;

/// What lies over the panels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Overlay {
    /// Nothing.
    None,
    /// The keys, scrolled down by so many lines.
    Help(u16),
    /// The presets, one of them selected.
    Presets(usize),
    /// Certificates and companion.
    Accuracy,
}

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
    /// The panel with the focus.
    pub focus: Panel,
    /// Whether the focused panel stands alone.
    pub zoomed: bool,
    /// What lies over the panels.
    pub overlay: Overlay,
    /// A line for the user, until the next key.
    pub notice: Option<String>,
    /// How things look.
    pub theme: Theme,
    /// Set when the program is to end.
    pub leave: Option<Leave>,
    /// Set when the program is to stop and give the terminal to its shell.
    pub suspend: bool,
    /// Whether theory lies over the plots.
    pub with_theory: bool,
    /// What the companion has shown, once it has; none while it runs or before it was asked.
    pub companion: Option<Result<Companion, String>>,
    log_panels: Vec<Panel>,
    bounds: HashMap<(Panel, Scale), [f64; 2]>,
    shown: Curves,
    orders: Sender<Order>,
}

impl App {
    /// An app that sends its orders to a worker.
    pub fn new(theme: Theme, orders: Sender<Order>) -> Self {
        Self {
            frame: None,
            focus: Panel::Profile,
            zoomed: false,
            overlay: Overlay::None,
            notice: None,
            theme,
            leave: None,
            suspend: false,
            with_theory: false,
            companion: None,
            log_panels: Vec::new(),
            bounds: HashMap::new(),
            shown: Curves::all(),
            orders,
        }
    }

    /// Takes in a new frame; the scales of the plots follow its data.
    pub fn take_frame(&mut self, frame: Arc<Frame>) {
        for panel in Panel::PLOTS {
            if let Some([low, high]) = panel.extent(&frame, self.scale(panel)) {
                let key = (panel, self.scale(panel));
                let bounds = sticky_bounds(self.bounds.get(&key).copied(), low, high);
                self.bounds.insert(key, bounds);
            }
        }
        self.frame = Some(frame);
    }

    /// The bounds of a panel's ordinate.
    pub fn bounds(&self, panel: Panel) -> Option<[f64; 2]> {
        self.bounds.get(&(panel, self.scale(panel))).copied()
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
    pub fn visible(&self) -> &[Panel] {
        if self.zoomed {
            std::slice::from_ref(&self.focus)
        } else {
            &Panel::ALL
        }
    }

    /// Answers a key.
    pub fn press(&mut self, key: Key) {
        self.notice = None;
        match (command::of_key(key), self.overlay) {
            (None, _) => {}
            (Some(command), Overlay::None) => self.command(command),
            (Some(command), Overlay::Help(line)) => self.help_command(command, line),
            (Some(command), Overlay::Presets(at)) => self.presets_command(command, at),
            (Some(command), Overlay::Accuracy) => self.accuracy_command(command),
        }
        self.tell_what_shows();
    }

    fn command(&mut self, command: Command) {
        match command {
            Command::Quit => self.leave = Some(Leave::Clean),
            Command::QuitKeepingScreen => self.leave = Some(Leave::KeepScreen),
            Command::Back => self.zoomed = false,
            Command::Help => self.overlay = Overlay::Help(0),
            Command::Suspend => self.suspend = true,
            Command::RunPause => self.order(Order::RunPause),
            Command::Step => self.order(Order::Step),
            Command::Cycle => self.order(Order::Cycle),
            Command::NextMethod => self.order(Order::Method(1)),
            Command::PreviousMethod => self.order(Order::Method(-1)),
            Command::NextLaw => self.order(Order::Law(1)),
            Command::PreviousLaw => self.order(Order::Law(-1)),
            Command::Faster => self.order(Order::Pace(1)),
            Command::Slower => self.order(Order::Pace(-1)),
            Command::NextPanel | Command::Down => self.focus = self.focus.shifted(1),
            Command::PreviousPanel | Command::Up => self.focus = self.focus.shifted(-1),
            Command::Zoom | Command::Accept => self.zoomed = !self.zoomed,
            Command::Snapshot => self.order(Order::Snapshot),
            Command::Presets => self.overlay = Overlay::Presets(self.present_preset()),
            Command::Theory => self.toggle_theory(),
            Command::Compare => self.order(Order::Compare),
            Command::Accuracy => {
                self.companion = None;
                self.overlay = Overlay::Accuracy;
                self.order(Order::Companion);
            }
            Command::Restart => self.restart(),
            Command::LogScale => self.toggle_log(),
        }
    }

    fn help_command(&mut self, command: Command, line: u16) {
        self.overlay = match command {
            Command::Up => Overlay::Help(line.saturating_sub(1)),
            Command::Down => Overlay::Help((line + 1).min(command::BINDINGS.len() as u16 - 1)),
            Command::Back | Command::Help | Command::Accept => Overlay::None,
            other => return self.through(other),
        };
    }

    fn presets_command(&mut self, command: Command, at: usize) {
        let count = preset::ALL.len();
        self.overlay = match command {
            Command::Up | Command::PreviousPanel => Overlay::Presets((at + count - 1) % count),
            Command::Down | Command::NextPanel => Overlay::Presets((at + 1) % count),
            Command::Back | Command::Presets => Overlay::None,
            Command::Accept | Command::RunPause => {
                self.load(preset::ALL[at].name);
                Overlay::None
            }
            other => return self.through(other),
        };
    }

    fn accuracy_command(&mut self, command: Command) {
        match command {
            Command::Back | Command::Accuracy | Command::Accept => self.overlay = Overlay::None,
            // The run can be watched from here.
            Command::RunPause
            | Command::Step
            | Command::Cycle
            | Command::Faster
            | Command::Slower => {
                self.command(command);
            }
            other => self.through(other),
        }
    }

    fn toggle_theory(&mut self) {
        self.with_theory = !self.with_theory;
    }

    /// What theory says, if it is to be shown.
    pub fn theory_of<'a>(&self, frame: &'a Frame) -> Option<&'a Theory> {
        self.with_theory.then_some(&*frame.theory)
    }

    /// Whether the accuracy panel waits for the companion.
    pub fn awaits_companion(&self) -> bool {
        self.overlay == Overlay::Accuracy && self.companion.is_none()
    }

    /// Leaving works from anywhere; other commands close what is open first.
    fn through(&mut self, command: Command) {
        self.overlay = Overlay::None;
        self.command(command);
    }

    fn load(&mut self, name: &str) {
        match Scenario::load(name, &[]) {
            Ok(scenario) => {
                self.forget_scales();
                self.order(Order::Load(Box::new(scenario)));
            }
            Err(error) => self.notice = Some(error.to_string()),
        }
    }

    fn restart(&mut self) {
        self.forget_scales();
        self.order(Order::Restart);
    }

    fn toggle_log(&mut self) {
        let focus = self.focus;
        if !focus.can_be_log() {
            self.notice = Some(format!(
                "the {} panel has no logarithmic scale",
                focus.title()
            ));
        } else if self.log_panels.contains(&focus) {
            self.log_panels.retain(|panel| *panel != focus);
        } else {
            self.log_panels.push(focus);
        }
        if let Some(frame) = self.frame.clone() {
            self.take_frame(frame);
        }
    }

    fn forget_scales(&mut self) {
        self.bounds.clear();
    }

    fn present_preset(&self) -> usize {
        let origin = self
            .frame
            .as_ref()
            .map_or("", |frame| frame.origin.as_str());
        preset::ALL
            .iter()
            .position(|preset| preset.name == origin)
            .unwrap_or(0)
    }

    /// Hidden panels cost no transform.
    fn tell_what_shows(&mut self) {
        // A comparison needs both curves, whatever panel is zoomed.
        let shown = self
            .visible()
            .iter()
            .fold(Curves::empty(), |curves, panel| curves | panel.curves());
        if shown != self.shown {
            self.shown = shown;
            self.order(Order::Show(shown));
        }
    }

    fn order(&self, order: Order) {
        // A worker that is gone has sent its own word already.
        let _ = self.orders.send(order);
    }
}
