//! Shell completion of presets, scenario files, and scenario keys with their values.
//!
//! The script that `mdr-tui completions` prints asks the program itself, so it knows what this
//! version knows.

use std::ffi::OsStr;
use std::fs;

use clap_complete::engine::CompletionCandidate;

use crate::guide::TOPICS;
use crate::scenario::keys::PARAMETERS;
use crate::scenario::preset;
use crate::scenario::schema::{Kind, Parameter, find};

/// The variable by which a shell asks for completions.
pub const VARIABLE: &str = "MDR_TUI_COMPLETE";

/// Presets, and the directories and `.toml` files that continue what was typed.
pub fn scenarios(typed: &OsStr) -> Vec<CompletionCandidate> {
    presets_and_files(typed, &["toml"])
}

/// What can be laid over plots: as for a scenario, and tables.
pub fn overlays(typed: &OsStr) -> Vec<CompletionCandidate> {
    presets_and_files(typed, &["toml", "csv"])
}

fn presets_and_files(typed: &OsStr, endings: &[&str]) -> Vec<CompletionCandidate> {
    let Some(typed) = typed.to_str() else {
        return Vec::new();
    };
    let presets = preset::ALL
        .iter()
        .filter(|preset| preset.name.starts_with(typed))
        .map(|preset| CompletionCandidate::new(preset.name).help(Some(preset.title().into())));
    presets.chain(files(typed, endings)).collect()
}

/// The names of the presets.
pub fn presets() -> Vec<CompletionCandidate> {
    let candidate = |preset: &preset::Preset| {
        CompletionCandidate::new(preset.name).help(Some(preset.title().into()))
    };
    preset::ALL.iter().map(candidate).collect()
}

/// The topics of the guide.
pub fn topics() -> Vec<CompletionCandidate> {
    let candidate = |topic: &crate::guide::Topic| {
        CompletionCandidate::new(topic.name).help(Some(topic.about.into()))
    };
    TOPICS.iter().map(candidate).collect()
}

/// `KEY=`, and behind it the words that the key takes.
pub fn assignments(typed: &OsStr) -> Vec<CompletionCandidate> {
    let Some(typed) = typed.to_str() else {
        return Vec::new();
    };
    let Some((key, value)) = typed.split_once('=') else {
        return PARAMETERS
            .iter()
            .filter(|known| known.path.starts_with(typed) && known.section() != "changes")
            .map(|known| {
                CompletionCandidate::new(format!("{}=", known.path))
                    .help(Some(known.described().into()))
            })
            .collect();
    };
    find(key)
        .into_iter()
        .flat_map(words)
        .filter(|word| word.starts_with(value))
        .map(|word| CompletionCandidate::new(format!("{key}={word}")))
        .collect()
}

fn words(parameter: &'static Parameter) -> &'static [&'static str] {
    match parameter.kind {
        Kind::Choice(words) => words,
        Kind::Flag => &["true", "false"],
        _ => &[],
    }
}

/// Directories, and files with one of `endings`, whose path begins with `typed`.
fn files(typed: &str, endings: &[&str]) -> Vec<CompletionCandidate> {
    let (folder, start) = match typed.rsplit_once('/') {
        Some((folder, start)) => (format!("{folder}/"), start),
        None => (String::new(), typed),
    };
    let place = if folder.is_empty() { "." } else { &folder };
    let has_ending = |name: &str| {
        let ending = name.rsplit_once('.').map(|(_, ending)| ending);
        ending.is_some_and(|ending| endings.contains(&ending))
    };
    let entries = fs::read_dir(place).into_iter().flatten().flatten();
    let mut found: Vec<String> = entries
        .filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            let is_folder = entry.path().is_dir();
            let wanted = name.starts_with(start) && (is_folder || has_ending(&name));
            let hidden = name.starts_with('.') && start.is_empty();
            let end = if is_folder { "/" } else { "" };
            (wanted && !hidden).then(|| format!("{folder}{name}{end}"))
        })
        .collect();
    found.sort();
    found.into_iter().map(CompletionCandidate::new).collect()
}
