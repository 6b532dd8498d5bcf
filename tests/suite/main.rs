//! One program of tests, a module for each kind of evidence.
//!
//! `cargo test NAME` runs the tests whose path holds NAME, e.g. `oracles::` for the
//! closed forms or `screens::` for the pinned screens.

mod closed_forms;
// Its lines of bash need the tools of Linux.
#[cfg(target_os = "linux")]
mod command_table;
mod common;
mod judge;
#[cfg(unix)]
mod pty;
mod random;
mod random_kinds;
mod random_scenarios;
mod screen_table;
mod tables;
mod test_dir;

mod accuracy_claims;
mod accuracy_targets;
mod allocations;
mod ansi_writer;
mod changes;
mod checkpoint;
mod circles;
mod cli;
mod conformance;
mod convergence;
mod coverage;
mod cycle_figures;
mod cycle_jump;
mod fatigue;
mod figures;
mod fine_period;
mod fit;
mod flow;
mod ghosts;
mod growth;
mod guide;
mod half_space;
#[cfg(target_os = "linux")]
mod hangup;
mod hostile;
mod key_fuzz;
mod keyboard;
#[cfg(target_os = "linux")]
mod layers;
mod limits;
mod line;
mod measured_shapes;
#[cfg(unix)]
mod mouse;
mod new;
mod oracles;
#[cfg(unix)]
mod outputs;
#[cfg(target_os = "linux")]
mod packages;
mod pictures;
mod properties;
mod published_cases;
mod published_methods;
mod readme;
mod real_scars;
mod refinement;
mod regressions;
#[cfg(unix)]
mod resume;
mod rigs;
mod ring_code;
mod scenarios;
mod screens;
mod second_code;
#[cfg(unix)]
mod signals;
#[cfg(target_os = "linux")]
mod slow_terminal;
#[cfg(unix)]
mod small_disk;
mod stability;
mod sweep;
#[cfg(unix)]
mod terminal;
mod theory;
mod trade;
mod truth;
mod two_at_once;
mod verify;
mod waveforms;
mod within_steps;
