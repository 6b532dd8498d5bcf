//! Any bytes as a checkpoint, as they are and with the length and the checksum put right.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| mdr_tui_fuzz::checkpoint(bytes));
