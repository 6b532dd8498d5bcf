//! Studies that are shown while they run: `:sweep KEY A..B`, one key around the present scenario, and the table of
//! another program's, which is read again whenever it has grown.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, SystemTime};
use std::{fs, thread};

use rayon::ThreadPoolBuilder;

use super::range::Range;
use super::view::View;
use crate::panics::locked;
use crate::scenario::{Refusal, Scenario};
use crate::studies::sweep::Shard;
use crate::studies::sweep::engine;
use crate::studies::sweep::record::Record;

/// How often a table is looked at.
const LOOK_INTERVAL: Duration = Duration::from_millis(300);

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
        let (record, name) = (Record::of_file(file)?, file.display().to_string());
        let mut view = View::new(record.study()?, &name)?;
        view.slice.renew(record, &name)?;
        Ok(Self::new(view, Some(file.into())))
    }

    fn new(view: View, file: Option<Arc<Path>>) -> Self {
        Self {
            view: Arc::new(Mutex::new(view)),
            halt: Arc::default(),
            done: Arc::new(file.is_some().into()),
            file,
        }
    }

    /// Reads the table again whenever it has grown, and tells that there is something new to see, until nobody hears it.
    pub fn watch(&self, tell: impl Fn() -> bool + Send + 'static) {
        let Some(file) = self.file.clone() else {
            return;
        };
        let shared = self.clone();
        thread::spawn(move || {
            let mut seen = None;
            loop {
                thread::sleep(LOOK_INTERVAL);
                let now = changed(&file);
                if std::mem::replace(&mut seen, now) == now {
                    continue;
                }
                // A file that is being replaced is read again the next time.
                let _ = Record::of_file(&file)
                    .map(|rows| shared.with(|view| view.slice.renew(rows, &view.name)));
                if !tell() {
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
        engine::check(&study, Shard::WHOLE, &pool, |_| true)?;
        let live = Self::new(View::new(study.clone(), &title)?, None);
        let shared = live.clone();
        thread::spawn(move || {
            let todo = 0..study.points();
            // Every point is checked already.
            let go_on = || !shared.halt.load(Ordering::Relaxed);
            engine::run(&study, todo, &pool, &go_on, |point, row| {
                shared.with(|view| view.slice.rows[point] = Some(row));
                tell();
                true
            });
            shared.done.store(true, Ordering::Release);
            tell();
        });
        Ok(live)
    }

    /// Reads or changes what of it is shown.
    pub fn with<T>(&self, act: impl FnOnce(&mut View) -> T) -> T {
        act(&mut locked(&self.view))
    }

    /// Ends it: no further point begins.
    pub fn halt(&self) {
        self.halt.store(true, Ordering::Relaxed);
    }

    /// Whether it is that of a table, which the explorer was opened for.
    pub fn is_of_file(&self) -> bool {
        self.file.is_some()
    }

    /// Waits for the last point.
    pub fn finish(&self) {
        while !self.done.load(Ordering::Acquire) {
            thread::sleep(Duration::from_millis(2));
        }
    }
}
