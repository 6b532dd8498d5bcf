//! The terminal's life: taken over on start, given back on every way out.

use std::io::{self, BufWriter, Stdout, stdout};
use std::mem::ManuallyDrop;

use crossterm::cursor::Show;
use crossterm::execute;
use crossterm::style::{Attribute, SetAttribute};
use crossterm::terminal::{
    Clear, ClearType, EndSynchronizedUpdate, EnterAlternateScreen, LeaveAlternateScreen,
    disable_raw_mode, enable_raw_mode,
};
use ratatui::Terminal;

use super::app::App;
use super::screen;
use super::wire::Wire;

/// Output is collected so that a frame goes out in one write.
const OUTPUT_BUFFER: usize = 64 * 1024;

type Backend = Wire<BufWriter<Stdout>>;

/// The terminal in raw mode on its alternate screen, until dropped.
pub struct Screen {
    /// Never dropped: that would write the rest of a frame behind the restored screen, and panic
    /// where the terminal is gone.
    terminal: ManuallyDrop<Terminal<Backend>>,
}

impl Screen {
    /// Takes the terminal over.
    pub fn open() -> io::Result<Self> {
        let restore = take_over()?;
        let terminal = fresh()?;
        std::mem::forget(restore);
        Ok(Self {
            terminal: ManuallyDrop::new(terminal),
        })
    }

    /// Starts from an empty screen of the present size. Between two drawings a terminal can have
    /// become smaller and large again, so that its size says nothing of what is left on it.
    pub fn start_afresh(&mut self) -> io::Result<()> {
        let size = self.terminal.size()?;
        self.terminal.resize(size.into())
    }

    /// Gives the terminal back for a while.
    pub fn give_back(&mut self) {
        restore();
    }

    /// Takes the terminal over again, as it may be anything by now.
    pub fn take_back(&mut self) -> io::Result<()> {
        std::mem::forget(take_over()?);
        // What the backend knew of the terminal holds no more.
        self.terminal = ManuallyDrop::new(fresh()?);
        Ok(())
    }

    /// Draws the app: only what changed goes over the wire.
    pub fn draw(&mut self, app: &App) -> io::Result<()> {
        self.terminal
            .draw(|frame| screen::draw(app, frame.area(), frame.buffer_mut()))?;
        Ok(())
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        restore();
    }
}

/// A terminal of which nothing is known.
fn fresh() -> io::Result<Terminal<Backend>> {
    let out = BufWriter::with_capacity(OUTPUT_BUFFER, stdout());
    Terminal::new(Wire::new(out, || Ok(crossterm::terminal::size()?.into())))
}

fn take_over() -> io::Result<RestoreOnFailure> {
    enable_raw_mode()?;
    let restore = RestoreOnFailure;
    // Not the clear of ratatui: it asks where the cursor is, and not every terminal answers.
    execute!(stdout(), EnterAlternateScreen, Clear(ClearType::All))?;
    Ok(restore)
}

struct RestoreOnFailure;

impl Drop for RestoreOnFailure {
    fn drop(&mut self) {
        restore();
    }
}

/// Gives the terminal back. A terminal that is gone cannot be restored; nothing is to be done then.
fn restore() {
    let _ = execute!(
        stdout(),
        EndSynchronizedUpdate,
        SetAttribute(Attribute::Reset),
        LeaveAlternateScreen,
        Show
    );
    let _ = disable_raw_mode();
}
