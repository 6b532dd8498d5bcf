//! Any text as a scenario: refused in one printable line, or read back from what it writes.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| mdr_tui_fuzz::scenario(text));
