//! The command table as text: help, README table and manual page.

use super::command::{BINDINGS, Binding, Command};

/// One line: the keys, and what they do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// The keys by name.
    pub keys: Vec<String>,
    /// What they do.
    pub help: &'static str,
}

impl Entry {
    /// The line of one command.
    pub fn of(binding: &Binding) -> Self {
        Self {
            keys: keys(binding),
            help: binding.help,
        }
    }
}

/// The groups of the help and of the manual page, in their order.
const GROUPS: &[(&str, &[Command])] = &[
    (
        "run",
        &[
            Command::RunPause,
            Command::Step,
            Command::Cycle,
            Command::Faster,
            Command::Slower,
            Command::HoldPhase,
            Command::Restart,
        ],
    ),
    (
        "look",
        &[
            Command::Accept,
            Command::Tour,
            Command::NextPanel,
            Command::PreviousPanel,
            Command::NextPage,
            Command::Zoom,
            Command::Contact,
            Command::LogScale,
            Command::Cursor,
            Command::Left,
            Command::Right,
            Command::Up,
            Command::Down,
            Command::Theory,
            Command::Stress,
            Command::StressOfCycle,
            Command::Theme,
            Command::Back,
        ],
    ),
    (
        "change",
        &[
            Command::Presets,
            Command::Edit,
            Command::NextMethod,
            Command::PreviousMethod,
            Command::Methods,
            Command::NextLaw,
            Command::PreviousLaw,
            Command::Laws,
            Command::Coarser,
            Command::Finer,
        ],
    ),
    (
        "compare and check",
        &[
            Command::Compare,
            Command::CompareFromStart,
            Command::Freeze,
            Command::DropGhosts,
            Command::Accuracy,
        ],
    ),
    (
        "time and files",
        &[
            Command::TimeBack,
            Command::TimeForth,
            Command::Snapshot,
            Command::SnapshotNote,
        ],
    ),
];

/// The group of all remaining commands.
const OTHERS: &str = "program";

/// Every group with its commands: each command once, those of no group in the last.
pub fn groups() -> Vec<(&'static str, Vec<&'static Binding>)> {
    let of = |command: &Command| BINDINGS.iter().find(|binding| binding.command == *command);
    let mut groups: Vec<(&str, Vec<&Binding>)> = GROUPS
        .iter()
        .map(|(name, commands)| (*name, commands.iter().filter_map(of).collect()))
        .collect();
    let others = BINDINGS.iter().filter(|binding| {
        let command = &binding.command;
        !GROUPS
            .iter()
            .any(|(_, commands)| commands.contains(command))
    });
    groups.push((OTHERS, others.collect()));
    groups
}

/// The names of a command's keys.
pub fn keys(binding: &Binding) -> Vec<String> {
    binding.keys.iter().map(ToString::to_string).collect()
}

/// The table of keys for the README.
pub fn markdown() -> String {
    let rows = groups().into_iter().flat_map(|(group, bindings)| {
        bindings.into_iter().enumerate().map(move |(i, binding)| {
            let Entry { keys, help } = Entry::of(binding);
            let keys: Vec<String> = keys.iter().map(|key| format!("`{key}`")).collect();
            let group = if i == 0 { group } else { "" };
            format!("| {group} | {} | {help} |\n", keys.join(" "))
        })
    });
    let rows: String = rows.collect();
    format!("| | key | does |\n|---|---|---|\n{rows}")
}

/// The section on keys of the manual page, in roff.
pub fn roff() -> String {
    let plain = |text: &str| text.replace('\\', "\\e").replace('-', "\\-");
    let mut text = ".SH KEYS\nThe keys of the explorer.\n".to_owned();
    for (group, bindings) in groups() {
        text.push_str(&format!(".SS {group}\n"));
        for Entry { keys, help } in bindings.into_iter().map(Entry::of) {
            let keys: Vec<String> = keys
                .iter()
                .map(|key| format!("\\fB{}\\fR", plain(key)))
                .collect();
            // A line that begins with a dot would be a request.
            text.push_str(&format!(".TP\n\\&{}\n\\&{}\n", keys.join(" "), plain(help)));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_stands_in_one_group_and_is_not_cut() {
        let mut seen = 0;
        for (_, bindings) in groups() {
            for entry in bindings.into_iter().map(Entry::of) {
                assert!(entry.keys.join(" ").chars().count() <= 15, "{entry:?}");
                assert!(entry.help.chars().count() <= 58, "{entry:?}");
                seen += 1;
            }
        }
        assert_eq!(seen, BINDINGS.len());
    }

    #[test]
    fn every_key_stands_in_every_text() {
        let (markdown, roff) = (markdown(), roff());
        for key in BINDINGS.iter().flat_map(keys) {
            assert!(markdown.contains(&format!("`{key}`")), "{key}");
            let key = key.replace('-', "\\-");
            assert!(roff.contains(&format!("\\fB{key}\\fR")), "{key}");
        }
    }
}
