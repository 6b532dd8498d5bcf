//! Files: tables of observations and of histories, written whole or not at all. Nothing here runs anything.

pub mod autosave;
pub mod claim;
pub mod field;
pub mod file;
pub mod header;
pub mod history;
pub mod state;
