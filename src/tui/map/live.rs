//! Studies that are shown while they run: `:sweep KEY A..B`, which varies one key of the present scenario, and the
//! table of another program, which is read again whenever it has grown.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, SystemTime};
use std::{fs, thread};

use super::range::SweepRange;
use super::view::MapView;
use crate::panics::locked;
use crate::scenario::{Refusal, Scenario};
use crate::studies::sweep::record::StudyFile;
use crate::studies::sweep::{Results, Shard, engine};

/// Interval for checking the table.
const LOOK_INTERVAL: Duration = Duration::from_millis(300);

/// A study under way, shared by the screen and the worker threads.
#[derive(Debug, Clone)]
pub struct LiveStudy {
    view: Arc<Mutex<MapView>>,
    halt: Arc<AtomicBool>,
    done: Arc<AtomicBool>,
    /// The table that is read, for which the explorer was opened; `None` if the study runs here.
    file: Option<Arc<Path>>,
}

/// Returns when a file was last changed, and its length.
fn changed(file: &Path) -> Option<(SystemTime, u64)> {
    let about = fs::metadata(file).ok()?;
    Some((about.modified().ok()?, about.len()))
}

impl LiveStudy {
    /// Opens the study in a table, as far as it has been computed.
    ///
    /// # Errors
    ///
    /// In one line: the file cannot be read, or is not the table of a study.
    pub fn of_file(file: &Path) -> Result<Self, Refusal> {
        let record = StudyFile::of_file(file)?;
        let (results, _) = Results::read(record.study()?, Shard::WHOLE, &[record])?;
        let view = MapView::new(results, &file.display().to_string());
        Ok(Self::new(view, Some(file.into())))
    }

    fn new(view: MapView, file: Option<Arc<Path>>) -> Self {
        Self {
            view: Arc::new(Mutex::new(view)),
            halt: Arc::default(),
            done: Arc::new(file.is_some().into()),
            file,
        }
    }

    /// Reads the table again whenever it has grown and calls `tell`, until that returns false because the screen is
    /// gone.
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
                // A file that is just being replaced is read again the next time.
                let study = shared.with_view(|view| Arc::clone(&view.slice.results.study));
                let read = StudyFile::of_file(&file)
                    .and_then(|record| Results::read(study, Shard::WHOLE, &[record]));
                let _ =
                    read.map(|(results, _)| shared.with_view(|view| view.slice.results = results));
                if !tell() {
                    return;
                }
            }
        });
    }

    /// Starts the study in separate threads; `tell` is called when there is something new to show.
    ///
    /// # Errors
    ///
    /// Returns the reason if the range does not make a study or one of its points is invalid.
    pub fn start(
        range: &SweepRange,
        scenario: &Scenario,
        cycles: f64,
        tell: impl Fn() + Send + 'static,
    ) -> Result<Self, Refusal> {
        let results = Results::new(range.study(scenario, cycles)?);
        let study = Arc::clone(&results.study);
        engine::check(&study, Shard::WHOLE)?;
        let title = format!("{} at {cycles} cycles", scenario.title());
        let live = Self::new(MapView::new(results, &title), None);
        let shared = live.clone();
        thread::spawn(move || {
            let todo = Vec::from_iter(0..study.points());
            let threads = thread::available_parallelism().map_or(1, usize::from);
            let go_on = || !shared.halt.load(Ordering::Relaxed);
            // Without threads, the map stays empty.
            let _ = engine::run(&study, &todo, threads, &go_on, |row| {
                shared.with_view(|view| view.slice.results.add(row));
                tell();
                true
            });
            shared.done.store(true, Ordering::Release);
            tell();
        });
        Ok(live)
    }

    /// Reads or changes the view.
    pub fn with_view<T>(&self, act: impl FnOnce(&mut MapView) -> T) -> T {
        act(&mut locked(&self.view))
    }

    /// Stops the study: no further points begin.
    pub fn halt(&self) {
        self.halt.store(true, Ordering::Relaxed);
    }

    /// Whether it shows a table from the command line, not a study that runs here.
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
