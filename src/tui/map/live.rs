//! Studies that are shown while they run: `:sweep KEY A..B`, one key around the present scenario, and the table of
//! another program's, which is read again whenever it has grown.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Mutex};
use std::time::{Duration, SystemTime};
use std::{fmt, fs, thread};

use rayon::ThreadPoolBuilder;

use super::draw;
use super::view::View;
use crate::scenario::{Refusal, Scenario, schema, units};
use crate::studies::sweep::engine::{self, Check};
use crate::studies::sweep::record::Record;
use crate::studies::sweep::{Shard, Study};
use crate::tui::app::App;
use crate::tui::canvas::Canvas;
use crate::tui::command::{self, Command};
use crate::tui::event_loop::Next;
use crate::tui::keys::{Key, Named};
use crate::tui::overlays::Answer;
use crate::tui::{Event, locked};

/// The points of the study.
pub const POINTS: usize = 25;

/// What is told until a point is open.
pub const OPENING: &str = "opening the point ...";

/// How often a table is looked at.
const LOOK_INTERVAL: Duration = Duration::from_millis(300);

/// From this ratio of its ends on, the axis is logarithmic.
const DECADES: f64 = 20.0;

/// The columns of the study.
const COLUMNS: [&str; 7] = [
    "wear_volume_m3",
    "scar_depth_m",
    "dissipated_energy_J",
    "contact_radius_m",
    "permanent_stick_radius_m",
    "energy_ratio",
    "regime",
];

/// The argument of `sweep`: a key and the ends of its axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Range {
    /// The dotted path.
    pub key: String,
    /// From here.
    pub from: f64,
    /// To here.
    pub to: f64,
}

impl Range {
    /// Reads `KEY A..B`, and what else it may be written like: `KEY = A .. B`, `KEY A to B`, `KEY A B`,
    /// each end with a unit if it has one. A part of a key does where one of `keys` alone has it.
    pub fn parse(text: &str, keys: &[(&str, &'static str)]) -> Option<Self> {
        let (key, ends) = text
            .trim()
            .split_once(|c: char| c.is_whitespace() || c == '=')?;
        let ends = ends.trim_start_matches([' ', '=']).trim();
        let mut signs = ["..", " to ", ",", ";"].into_iter();
        let (from, to) = signs
            .find_map(|sign| ends.split_once(sign))
            .or_else(|| ends.split_once(' '))?;
        let mut of = keys.iter().filter(|(path, _)| path.contains(key));
        let exact = keys.iter().find(|(path, _)| *path == key);
        let (key, unit) = match (exact, of.next(), of.next()) {
            (Some((path, unit)), ..) | (None, Some((path, unit)), None) => (*path, *unit),
            _ => (key, ""),
        };
        let known = schema::find(key);
        let number = |text: &str| -> Option<f64> {
            let text = text.trim().trim_start_matches('.');
            let with_unit = || units::quantity(text, known?, unit == "N")?.ok();
            let end = text.parse().ok().or_else(with_unit);
            end.filter(|end: &f64| end.is_finite())
        };
        Some(Self {
            key: key.to_owned(),
            from: number(from)?,
            to: number(to)?,
        })
    }

    /// The study of a scenario over this range, each point run for this many cycles.
    fn study(&self, scenario: &Scenario, cycles: f64) -> Result<Study, Refusal> {
        let broken = |error: &dyn fmt::Display| Refusal::from(error.to_string());
        let base = scenario
            .with_changes(Vec::new())
            .with("run.cycles", &cycles.to_string())
            .map_err(|error| broken(&error))?;
        let ratio = self.to / self.from;
        let spread = match self.from > 0.0 && (ratio >= DECADES || ratio <= 1.0 / DECADES) {
            true => "logspace",
            false => "linspace",
        };
        let Self { key, from, to } = self;
        let text = format!(
            "base = \"present\"\ncolumns = {COLUMNS:?}\n[[axis]]\nkey = {key:?}\n\
             {spread} = [{from:?}, {to:?}, {POINTS}]\n"
        );
        Study::read_with_base(&text, "sweep", &base.to_toml())
    }
}

/// A study under way, shared by the screen and the worker threads.
#[derive(Debug, Clone)]
pub struct Live {
    view: Arc<Mutex<View>>,
    halt: Arc<AtomicBool>,
    done: Arc<AtomicBool>,
    /// The table that it is read from, which the explorer was opened for; `None` if it runs here.
    file: Option<Arc<Path>>,
}

/// When a file was changed last, and its length.
fn changed(file: &Path) -> Option<(SystemTime, u64)> {
    let about = fs::metadata(file).ok()?;
    Some((about.modified().ok()?, about.len()))
}

impl Live {
    /// The study in a table, as far as that goes.
    ///
    /// # Errors
    ///
    /// One line: a file that cannot be read, or is no table of a study.
    pub fn of_file(file: &Path) -> Result<Self, Refusal> {
        let view = View::new(Record::of_file(file)?, &file.display().to_string())?;
        Ok(Self {
            view: Arc::new(Mutex::new(view)),
            halt: Arc::default(),
            done: Arc::new(true.into()),
            file: Some(file.into()),
        })
    }

    /// Reads the table again whenever it has grown, and tells that there is something new to see.
    pub fn watch(&self, events: Sender<Event>) {
        let Some(file) = self.file.clone() else {
            return;
        };
        let shared = self.clone();
        thread::spawn(move || {
            let mut seen = None;
            loop {
                thread::sleep(LOOK_INTERVAL);
                let now = changed(&file);
                if now == seen {
                    continue;
                }
                seen = now;
                // A file that is being replaced is read again the next time.
                let _ = Record::of_file(&file).map(|rows| shared.with(|view| view.renew(rows)));
                if events.send(Event::News).is_err() {
                    return;
                }
            }
        });
    }

    /// Starts the study in threads of its own; `tell` is called when there is something new to see.
    ///
    /// # Errors
    ///
    /// Returns the reason if the range is not a study or one of its points is invalid.
    pub fn start(
        range: &Range,
        scenario: &Scenario,
        cycles: f64,
        tell: impl Fn() + Send + 'static,
    ) -> Result<Self, Refusal> {
        let study = range.study(scenario, cycles)?;
        let title = format!("{} at {cycles} cycles", scenario.title());
        let pool = ThreadPoolBuilder::new()
            .build()
            .map_err(|error| Refusal::from(error.to_string()))?;
        Check::new(&study, Shard::WHOLE).advance(&pool, |_| true)?;
        let live = Self {
            view: Arc::new(Mutex::new(View::of(study.clone(), &title)?)),
            halt: Arc::default(),
            done: Arc::default(),
            file: None,
        };
        let shared = live.clone();
        thread::spawn(move || {
            let todo = 0..study.points();
            // Every point is checked already.
            let go_on = || !shared.halt.load(Ordering::Relaxed);
            let _ = engine::run(&study, todo, None, &pool, &go_on, |point, row| {
                shared.with(|view| view.slice.rows[point] = Some(row));
                tell();
                true
            });
            shared.done.store(true, Ordering::Release);
            tell();
        });
        Ok(live)
    }

    fn with<T>(&self, act: impl FnOnce(&mut View) -> T) -> T {
        act(&mut locked(&self.view))
    }

    /// Answers a key; leaving ends the study, or the explorer that was opened for it.
    pub fn press(&self, key: Key, app: &mut App) -> Answer {
        match (key, command::of_key(key)) {
            (_, Some(Command::Suspend)) => app.run(Command::Suspend),
            (Key::Char('q') | Key::Named(Named::Esc), _) if self.file.is_some() => {
                app.next = Next::Leave;
            }
            (Key::Char('q') | Key::Named(Named::Esc), _) => {
                self.halt.store(true, Ordering::Relaxed);
                return Answer::Close;
            }
            (Key::Named(Named::Enter), _) => {
                match self.with(|view| view.slice.study.scenario(view.point())) {
                    Ok(scenario) => {
                        self.halt.store(true, Ordering::Relaxed);
                        app.map = Some(self.clone()).filter(|_| self.file.is_some());
                        app.notice = Some(OPENING.to_owned());
                        app.order_anew(|run| run.open_point(scenario));
                    }
                    Err(error) => app.notice = Some(error.to_string()),
                }
            }
            _ => self.with(|view| view.press(key)),
        }
        Answer::Stay
    }

    /// Draws it on the whole screen, and what the user is told.
    pub fn draw(&self, told: Option<&str>, canvas: Canvas) {
        self.with(|view| draw::draw(view, told, canvas));
    }

    /// Waits for the last point.
    pub fn finish(&self) {
        while !self.done.load(Ordering::Acquire) {
            thread::sleep(Duration::from_millis(2));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEYS: &[(&str, &str)] = &[
        ("friction.coefficient", ""),
        ("wear.coefficient", "1/Pa"),
        ("motion.tangential.amplitude", "m"),
    ];

    #[test]
    fn a_range_is_a_key_and_two_ends() {
        let range = Range::parse(" friction.coefficient 0.1..0.5 ", KEYS).expect("a range");
        assert_eq!(
            (range.key.as_str(), range.from, range.to),
            ("friction.coefficient", 0.1, 0.5)
        );
        assert_eq!(
            Range::parse("wear.coefficient 1e-12 .. 1e-9", KEYS).map(|r| r.to),
            Some(1e-9)
        );
        for text in [
            "friction 0.1..0.5",
            "friction.coefficient = 0.1 .. 0.5",
            "friction 0.1 to 0.5",
            "friction 0.1 0.5",
        ] {
            assert_eq!(Range::parse(text, KEYS), Some(range.clone()), "{text}");
        }
        let range = Range::parse("tangential.amplitude 50 nm..0.2 um", KEYS).expect("units");
        assert_eq!((range.from, range.to), (5e-8, 2e-7));
        for wrong in [
            "",
            "friction.coefficient",
            "friction.coefficient 1",
            "a 1..x",
            "a ..2",
        ] {
            assert_eq!(Range::parse(wrong, KEYS), None, "{wrong}");
        }
    }
}
