//! The modes of the terminal: echo, lines, signals from keys.

use std::io;

use nix::sys::termios::{SetArg, Termios, cfmakeraw, tcgetattr, tcsetattr};

/// The modes that the terminal had at first.
pub struct Modes(Termios);

impl Modes {
    /// Notes the modes of the terminal at the standard input.
    ///
    /// # Errors
    ///
    /// If that is no terminal.
    pub fn note() -> io::Result<Self> {
        Ok(Self(tcgetattr(io::stdin())?))
    }

    /// Has every key passed on at once and unseen, whatever the modes are by now: a shell sets its own while the
    /// program is stopped.
    ///
    /// # Errors
    ///
    /// If the terminal is gone.
    pub fn set_raw(&self) -> io::Result<()> {
        let mut raw = self.0.clone();
        cfmakeraw(&mut raw);
        Ok(tcsetattr(io::stdin(), SetArg::TCSANOW, &raw)?)
    }

    /// Sets the first modes again. In the background that stops the process.
    pub fn restore(&self) {
        let _ = tcsetattr(io::stdin(), SetArg::TCSANOW, &self.0);
    }
}
