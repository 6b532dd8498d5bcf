//! Shell completion of presets, scenario files, and scenario keys with their values.
//!
//! The script printed by `mdr-tui completions` asks the program itself, so it always matches the installed version.

use std::ffi::{OsStr, OsString};
use std::path::Path;

use clap_complete::engine::{CompletionCandidate, PathCompleter, ValueCompleter};

use crate::guide::{TOPICS, Topic};
use crate::scenario::key::Key;
use crate::scenario::preset::{self, Preset};

/// The variable with which a shell asks for completions.
pub const VARIABLE: &str = "MDR_TUI_COMPLETE";

/// Completes presets, directories and `.toml` files.
pub fn scenarios(typed: &OsStr) -> Vec<CompletionCandidate> {
    presets_and_files(typed, &["toml"])
}

/// Completes what can be overlaid: scenarios and tables.
pub fn overlays(typed: &OsStr) -> Vec<CompletionCandidate> {
    presets_and_files(typed, &["toml", "csv"])
}

fn presets_and_files(typed: &OsStr, endings: &'static [&'static str]) -> Vec<CompletionCandidate> {
    let is_wanted = move |path: &Path| {
        let ending = path.extension().and_then(OsStr::to_str);
        ending.is_some_and(|ending| endings.contains(&ending)) && path.is_file()
    };
    let start = typed.to_string_lossy();
    let mut found = presets();
    found.retain(|preset| preset.get_value().to_string_lossy().starts_with(&*start));
    // Directories are always offered.
    found.extend(PathCompleter::any().filter(is_wanted).complete(typed));
    found
}

/// Completes the names of the presets.
pub fn presets() -> Vec<CompletionCandidate> {
    let known = |preset: &Preset| candidate(preset.name, preset.title());
    preset::ALL.iter().map(known).collect()
}

/// Completes the topics of the guide.
pub fn topics() -> Vec<CompletionCandidate> {
    let known = |topic: &Topic| candidate(topic.name, topic.about);
    TOPICS.iter().map(known).collect()
}

fn candidate(word: impl Into<OsString>, help: &str) -> CompletionCandidate {
    CompletionCandidate::new(word).help(Some(help.to_owned().into()))
}

/// Completes `KEY=`, and then the words that the key accepts.
pub fn assignments(typed: &OsStr) -> Vec<CompletionCandidate> {
    let Some(typed) = typed.to_str() else {
        return Vec::new();
    };
    let Some((key, value)) = typed.split_once('=') else {
        let known = Key::all().filter(|known| known.section() != "changes");
        let begun = known.filter(|known| known.path.starts_with(typed));
        let offered = begun.map(|known| candidate(format!("{}=", known.path), &known.described()));
        return offered.collect();
    };
    let words = Key::find(key).and_then(|known| known.kind.words());
    let words = words.into_iter().flatten();
    let begun = words.filter(|word| word.starts_with(value));
    let offered = begun.map(|word| CompletionCandidate::new(format!("{key}={word}")));
    offered.collect()
}
