//! Any bytes as keys, pastes and resizes of a session.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| mdr_tui_fuzz::session(bytes));
