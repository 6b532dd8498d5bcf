//! Any text as `--set`.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| mdr_tui_fuzz::set(text));
