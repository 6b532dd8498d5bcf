//! Messages of the explorer's threads to its main thread.

use std::sync::Arc;

use super::frame::Slot;
use super::map::live::LiveStudy;
use super::reader::Input;

/// An event for the main thread.
#[derive(Debug)]
pub enum Event {
    /// Input from the user, or an answer of the terminal.
    Input(Input),
    /// A frame was written.
    Written,
    /// The size of the terminal has changed.
    Resize,
    /// A new frame is in the slot.
    Frame(Arc<Slot>),
    /// A comparison run or a study may have something new to show.
    News,
    /// A text for the clipboard, and its name.
    Copied(String, &'static str),
    /// A notice for the user.
    Notice(String),
    /// A requested file could not be written, and why: a notice, and a failure of a script.
    Unwritten(String),
    /// A study has begun.
    Sweep(LiveStudy),
    /// A point of the study has been opened.
    Opened,
    /// The process should be suspended.
    Suspend,
    /// The process continues after a suspension.
    Continue,
    /// The terminal has closed, the process was asked to end, or the worker has ended.
    HangUp,
}
