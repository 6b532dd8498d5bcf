//! Output files: tables of states and histories, written whole or not at all. This layer runs no simulations.

pub mod autosave;
pub mod claim;
pub mod field;
pub mod file;
pub mod header;
pub mod history;
pub mod last_loop;
pub mod own_directory;
pub mod provenance;
pub mod run_folder;
pub mod safe_open;
pub mod state;
pub mod target;
