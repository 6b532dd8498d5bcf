//! Files: tables of observations and of histories, written whole or not at all. Nothing here runs anything.

pub mod file;
pub mod header;
pub mod history;
pub mod keep;
pub mod state;
