//! The terminal's life: taken over on start, given back on every way out.

use std::io::{self, BufWriter, Stdout, stdout};
use std::mem::ManuallyDrop;

use crossterm::cursor::Show;
use crossterm::execute;
use crossterm::style::{Attribute, Print, SetAttribute};
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

/// Asks for presses, releases and the wheel (mode 1000), in numbers that hold on any screen (1006).
/// The terminal is not asked for the mouse's movements: each would be bytes on the wire.
const MOUSE_ON: &str = "\x1b[?1000h\x1b[?1006h";

/// Takes that back.
const MOUSE_OFF: &str = "\x1b[?1006l\x1b[?1000l";

/// Whom the mouse belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Capture {
    /// The terminal, which selects text with it.
    None,
    /// The explorer, which is told of clicks and the wheel.
    Clicks,
}

type Backend = Wire<BufWriter<Stdout>>;

/// The terminal in raw mode on its alternate screen, until dropped.
pub struct Screen {
    /// Never dropped: that would write the rest of a frame behind the restored screen, and panic
    /// where the terminal is gone.
    terminal: ManuallyDrop<Terminal<Backend>>,
    mouse: Capture,
}

impl Screen {
    /// Takes the terminal over, and the mouse as well if it was asked for.
    pub fn open(mouse: Capture) -> io::Result<Self> {
        let restore = take_over(mouse)?;
        let terminal = fresh()?;
        std::mem::forget(restore);
        Ok(Self {
            terminal: ManuallyDrop::new(terminal),
            mouse,
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
        restore(self.mouse);
    }

    /// Takes the terminal over again, as it may be anything by now.
    pub fn take_back(&mut self) -> io::Result<()> {
        std::mem::forget(take_over(self.mouse)?);
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
        restore(self.mouse);
    }
}

/// A terminal of which nothing is known.
fn fresh() -> io::Result<Terminal<Backend>> {
    let out = BufWriter::with_capacity(OUTPUT_BUFFER, stdout());
    Terminal::new(Wire::new(out, || Ok(crossterm::terminal::size()?.into())))
}

fn take_over(mouse: Capture) -> io::Result<RestoreOnFailure> {
    enable_raw_mode()?;
    let restore = RestoreOnFailure(mouse);
    // Not the clear of ratatui: it asks where the cursor is, and not every terminal answers.
    execute!(stdout(), EnterAlternateScreen, Clear(ClearType::All))?;
    if mouse == Capture::Clicks {
        execute!(stdout(), Print(MOUSE_ON))?;
    }
    Ok(restore)
}

struct RestoreOnFailure(Capture);

impl Drop for RestoreOnFailure {
    fn drop(&mut self) {
        restore(self.0);
    }
}

/// Gives the terminal back. A terminal that is gone cannot be restored; nothing is to be done then.
fn restore(mouse: Capture) {
    if mouse == Capture::Clicks {
        let _ = execute!(stdout(), Print(MOUSE_OFF));
    }
    let _ = execute!(
        stdout(),
        EndSynchronizedUpdate,
        SetAttribute(Attribute::Reset),
        LeaveAlternateScreen,
        Show
    );
    let _ = disable_raw_mode();
}
