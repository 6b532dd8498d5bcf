//! A recording of the session in asciinema's format (asciicast v2): a header line, then one line for each
//! frame with its time and the bytes that a terminal is sent.
//!
//! The recording draws on its own virtual terminal, so it does not depend on the real one or the
//! speed of its line, and a key script is recorded without any terminal. Every line is written
//! whole, so that the recording of a killed session can still be played.

use std::cell::Cell;
use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::Path;
use std::rc::Rc;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use ratatui::backend::{Backend, ClearType};
use ratatui::buffer::Buffer;
use ratatui::layout::{Rect, Size};
use serde_json::json;

use super::ansi_backend::AnsiBackend;
use super::app::App;
use super::screen;

/// Maximum size of a recording, bytes: hours at ten frames per second.
const MOST: u64 = 64 << 20;

/// Time between two keys of a script.
const KEY: Duration = Duration::from_millis(500);

type Paper = AnsiBackend<Vec<u8>, Box<dyn Fn() -> io::Result<Size>>>;

/// A recording in progress.
pub struct Cast {
    file: File,
    backend: Paper,
    size: Rc<Cell<Size>>,
    /// The screen as the recording shows it; `None` before the first frame.
    shown: Option<Buffer>,
    written: u64,
    is_full: bool,
    start: Instant,
    /// The time of a script, which has no clock.
    scripted: Option<Duration>,
}

impl Cast {
    /// Begins a recording in a new file; `scripted` if a script of keys is played instead of a session.
    ///
    /// # Errors
    /// A file that exists already or cannot be made.
    pub fn create(path: &Path, scripted: bool) -> io::Result<Self> {
        let file = OpenOptions::new().write(true).create_new(true).open(path)?;
        let size = Rc::new(Cell::new(Size::default()));
        let asked = Rc::clone(&size);
        Ok(Self {
            file,
            backend: AnsiBackend::new(Vec::new(), Box::new(move || Ok(asked.get()))),
            size,
            shown: None,
            written: 0,
            is_full: false,
            start: Instant::now(),
            scripted: scripted.then_some(Duration::ZERO),
        })
    }

    /// Records the app as it is now, if it shows anything new.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn frame(&mut self, app: &App) -> io::Result<()> {
        if self.is_full {
            return Ok(());
        }
        let area = Rect::new(0, 0, app.area.width, app.area.height);
        let mut buffer = Buffer::empty(area);
        screen::draw(app, area, &mut buffer);
        self.size.set(area.into());
        if self.shown.as_ref().is_none_or(|shown| shown.area != area) {
            self.begin(area)?;
        }
        let shown = self.shown.take().unwrap_or_else(|| Buffer::empty(area));
        self.backend.draw(shown.diff(&buffer).into_iter())?;
        Backend::flush(&mut self.backend)?;
        self.shown = Some(buffer);
        let bytes = std::mem::take(self.backend.get_mut());
        let text = String::from_utf8_lossy(&bytes);
        if !text.is_empty() {
            self.event("o", &text)?;
        }
        if let Some(time) = &mut self.scripted {
            *time += KEY;
        }
        Ok(())
    }

    /// Writes the header, or that the screen has another size, and clears the screen.
    fn begin(&mut self, area: Rect) -> io::Result<()> {
        if self.shown.is_none() {
            let now = SystemTime::now().duration_since(UNIX_EPOCH);
            let mut header = json!({
                "version": 2,
                "width": area.width,
                "height": area.height,
                "idle_time_limit": 2.0,
                "title": concat!("mdr-tui ", env!("CARGO_PKG_VERSION")),
                "env": {"TERM": "xterm-256color"},
            });
            if self.scripted.is_none() {
                header["timestamp"] = now.map_or(0, |now| now.as_secs()).into();
            }
            self.line(&header.to_string())?;
        } else {
            self.event("r", &format!("{}x{}", area.width, area.height))?;
        }
        self.shown = Some(Buffer::empty(area));
        self.backend.hide_cursor()?;
        self.backend.clear_region(ClearType::All)
    }

    fn event(&mut self, kind: &str, text: &str) -> io::Result<()> {
        let time = self.scripted.unwrap_or_else(|| self.start.elapsed());
        let seconds = (time.as_secs_f64() * 1000.0).round() / 1000.0;
        let line = json!([seconds, kind, text]).to_string();
        if self.written + line.len() as u64 + 100 > MOST {
            self.is_full = true;
            let last = json!([
                seconds,
                "o",
                "\x1b[H\x1b[7m the recording ends here: 64 MB \x1b[m"
            ]);
            return self.line(&last.to_string());
        }
        self.line(&line)
    }

    fn line(&mut self, line: &str) -> io::Result<()> {
        self.file.write_all(format!("{line}\n").as_bytes())?;
        self.written += line.len() as u64 + 1;
        Ok(())
    }
}
