//! The modes of the terminal: echo, line editing, signals from keys.

use std::io;

use nix::sys::termios::{SetArg, Termios, cfmakeraw, tcgetattr, tcsetattr};

/// The modes that the terminal had at first.
pub struct Modes(Termios);

impl Modes {
    /// Stores the modes of the terminal at standard input.
    ///
    /// # Errors
    ///
    /// If standard input is not a terminal.
    pub fn note() -> io::Result<Self> {
        Ok(Self(tcgetattr(io::stdin())?))
    }

    /// Makes the terminal pass on every key at once and without echo, whatever its present modes: a shell sets its own
    /// while the program is stopped.
    ///
    /// # Errors
    ///
    /// If the terminal is gone.
    pub fn set_raw(&self) -> io::Result<()> {
        let mut raw = self.0.clone();
        cfmakeraw(&mut raw);
        Ok(tcsetattr(io::stdin(), SetArg::TCSANOW, &raw)?)
    }

    /// Restores the first modes. In the background, this stops the process.
    pub fn restore(&self) {
        let _ = tcsetattr(io::stdin(), SetArg::TCSANOW, &self.0);
    }
}
