//! What the threads of the explorer tell its main thread.

use std::sync::Arc;

use super::frame::Slot;
use super::map::live::Live;
use super::reader::Input;

/// An event for the main thread.
#[derive(Debug)]
pub enum Event {
    /// The terminal has sent what its user did, or an answer.
    Input(Input),
    /// A frame was written.
    Written,
    /// The terminal has another size.
    Resize,
    /// A frame waits in the slot.
    Frame(Arc<Slot>),
    /// There may be something new to see in what is shown beside.
    News,
    /// A text for the clipboard, and what it is.
    Copied(String, &'static str),
    /// A notice for the user.
    Notice(String),
    /// A file that was asked for could not be written, and why: a notice, and a failure of a script.
    Unwritten(String),
    /// A study has begun.
    Sweep(Live),
    /// A point of it has been opened.
    Opened,
    /// The process is asked to suspend.
    Suspend,
    /// The process continues after a suspension.
    Continue,
    /// The terminal has closed, the process was asked to end, or the worker has ended.
    HangUp,
}
