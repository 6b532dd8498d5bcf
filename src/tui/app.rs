//! The explorer and its overlays: which of them handles a key, and what follows.

use std::sync::Arc;

use super::command::{self, Act, Command};
use super::event::Event;
use super::explorer::{Explorer, Next};
use super::frame::Frame;
use super::keys::{Keystroke, Named};
use super::map::live::LiveStudy;
use super::mouse::Gesture;
use super::overlays::{Answer, Form, Help, Library, OPENING, Overlay, Palette};
use super::reader::Input;
use super::worker::ghosts::Ghosts;
use super::worker::{Order, Orders};
use crate::plot::theme::Theme;

/// The state of the screen.
pub struct App {
    /// The explorer below the overlays.
    pub explorer: Explorer,
    /// The stack of overlays: the last is drawn, and handles the keys.
    pub overlays: Vec<Overlay>,
    /// The map from which the run was opened, to which the user can return.
    map: Option<LiveStudy>,
}

impl App {
    /// Makes an app that shows the first frame of a worker, and sends its orders to it.
    pub fn new(theme: Theme, orders: Orders, frame: Arc<Frame>) -> Self {
        Self {
            explorer: Explorer::new(theme, orders, frame),
            overlays: Vec::new(),
            map: None,
        }
    }

    /// Handles an event, except those that concern the terminal itself.
    pub(super) fn handle(&mut self, event: Event) {
        let explorer = &mut self.explorer;
        match event {
            Event::Input(Input::Key(key)) => self.press(key),
            Event::Input(Input::Paste(text)) => self.paste(&text),
            Event::Input(Input::Point(gesture)) => self.point(gesture),
            Event::Frame(slot) => {
                if let Some(frame) = slot.take() {
                    explorer.show_frame(frame);
                }
            }
            Event::Unwritten(text) => {
                explorer.unwritten.get_or_insert_with(|| text.clone());
                explorer.notice = Some(text);
            }
            Event::Copied(text, what) => explorer.copy_to_clipboard(&text, what),
            Event::Notice(text) => explorer.notice = Some(text),
            Event::Sweep(live) => {
                self.overlays = vec![Overlay::Sweep(live)];
                self.make_room();
            }
            Event::Opened => {
                explorer.notice.take_if(|text| text == OPENING);
                for overlay in self.overlays.drain(..) {
                    if let Overlay::Sweep(live) = overlay {
                        self.map = Some(live).filter(LiveStudy::is_of_file);
                    }
                }
                self.make_room();
            }
            _ => {}
        }
    }

    /// Handles a key. Ctrl-C quits and Ctrl-L repaints from anywhere, even while typing.
    pub fn press(&mut self, key: Keystroke) {
        let explorer = &mut self.explorer;
        explorer.begin_answer();
        match key {
            Keystroke::Ctrl('c') => explorer.next = Next::Leave,
            Keystroke::Ctrl('l') => explorer.next = Next::Repaint,
            key => self.press_here(key),
        }
    }

    /// Handles a key in the topmost overlay or the explorer.
    fn press_here(&mut self, key: Keystroke) {
        let explorer = &mut self.explorer;
        let is_of_program = |command: &Command| *command == Command::Suspend;
        if let Some(command) = command::of_key(key).filter(is_of_program) {
            return self.run(command);
        }
        let answer = match self.overlays.last_mut() {
            Some(overlay) => overlay.press(key, explorer),
            None => match (command::of_key(key), key) {
                (Some(Command::Focus), Keystroke::Char(digit @ '1'..='9')) => {
                    explorer.stage.focus_at(digit as usize - '1' as usize);
                    Answer::Stay
                }
                (command, _) => command.map_or(Answer::Stay, Answer::Run),
            },
        };
        match answer {
            Answer::Stay => {}
            Answer::Close => _ = self.overlays.pop(),
            Answer::Done => {
                self.overlays.pop();
                self.overlays
                    .retain(|below| matches!(below, Overlay::Form(_)));
            }
            Answer::Open(overlay) => self.overlays.push(overlay),
            Answer::Watch(command) => self.run(command),
            Answer::Run(command) => {
                self.overlays.clear();
                self.run(command);
            }
        }
        self.make_room();
        self.explorer.show();
    }

    /// Makes room for the list of parameters next to the panels; when it closes, drops the run that it compared with.
    fn make_room(&mut self) {
        let is_form = |overlay: &Overlay| matches!(overlay, Overlay::Form(_));
        let has_list = self.overlays.iter().any(is_form);
        let stage = &mut self.explorer.stage;
        if std::mem::replace(&mut stage.has_list, has_list) && !has_list {
            let order = Order::Ghosts(Box::new(Ghosts::drop_before));
            self.explorer.order(order);
        }
    }

    /// Carries out a command.
    fn run(&mut self, command: Command) {
        let row = command.row();
        match row.act {
            Act::Screen(act) => act(&mut self.explorer),
            Act::Worker(order) => self.explorer.order(order()),
            Act::Open => self.open(command),
            Act::Words(key) => match self.explorer.frame.setting(key) {
                Some(setting) => self
                    .overlays
                    .push(Overlay::Palette(Palette::choosing(&setting))),
                None => self.explorer.notice = Some(format!("this scenario has no {key}")),
            },
            Act::Argument(_) => {
                let begun = Palette::begun(&format!("{} ", row.name));
                self.overlays.push(Overlay::Palette(begun));
            }
            Act::Quit => match self.map.take() {
                Some(map) => self.overlays.push(Overlay::Sweep(map)),
                None => self.explorer.next = Next::Leave,
            },
        }
    }

    /// Opens the overlay of a command on top of the others.
    fn open(&mut self, command: Command) {
        let explorer = &mut self.explorer;
        self.overlays.push(match command {
            Command::Help => Overlay::Help(Help::default()),
            Command::Presets => Overlay::Library(Library::open(explorer.origin())),
            Command::Accept => Overlay::Explain,
            Command::Edit => Overlay::Form(Form::default()),
            Command::Accuracy => {
                explorer.order(Order::EstimateErrors);
                Overlay::Accuracy { explains: false }
            }
            _ => Overlay::Palette(Palette::default()),
        });
    }

    /// Inserts pasted text into the line being typed.
    pub fn paste(&mut self, text: &str) {
        self.explorer.is_new = false;
        let line = self.overlays.last_mut().and_then(Overlay::line);
        let fits = line.map(|line| line.paste(text));
        self.explorer.notice = match fits {
            Some(true) => None,
            Some(false) => Some("the pasted text is longer than one line and was cut".into()),
            None => Some("there is no line to paste into; : opens one".into()),
        };
    }

    /// Handles the mouse: it scrolls lists, and points where there is no overlay.
    pub fn point(&mut self, gesture: Gesture) {
        match (gesture, self.overlays.last()) {
            (Gesture::WheelUp | Gesture::WheelDown, Some(Overlay::Accuracy { .. })) => {}
            (Gesture::WheelUp, None) => self.explorer.wheel(true),
            (Gesture::WheelDown, None) => self.explorer.wheel(false),
            (Gesture::WheelUp, _) => self.press(Keystroke::Named(Named::Up)),
            (Gesture::WheelDown, _) => self.press(Keystroke::Named(Named::Down)),
            (Gesture::Click(at), None) => self.explorer.click(at, false),
            (Gesture::DoubleClick(at), None) => self.explorer.click(at, true),
            (Gesture::Click(_) | Gesture::DoubleClick(_), Some(_)) => {}
        }
    }
}
