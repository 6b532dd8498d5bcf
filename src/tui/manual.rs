//! The command table as text: the lines of the help, the table of the README, the manual page.

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

/// Commands that share a line of the help where space is short.
const GROUPS: &[(&[Command], &str)] = &[
    (
        &[Command::Step, Command::Cycle],
        "pause and take one step; go on to the end of the cycle",
    ),
    (
        &[Command::Faster, Command::Slower],
        "more, fewer cycles a second, up to as fast as it can",
    ),
    (
        &[Command::Coarser, Command::Finer],
        "faster, more accurate: fewer, more cells and steps",
    ),
    (
        &[Command::NextMethod, Command::PreviousMethod],
        "next, previous transform method; the state stays",
    ),
    (
        &[Command::NextLaw, Command::PreviousLaw],
        "next, previous wear law; the state stays",
    ),
    (
        &[
            Command::NextPage,
            Command::NextPanel,
            Command::PreviousPanel,
        ],
        "more panels; focus the next, previous panel",
    ),
    (
        &[Command::Zoom, Command::LogScale, Command::Theme],
        "the focused panel alone; its log scale; colours",
    ),
    (
        &[Command::Snapshot, Command::SnapshotNote],
        "state and scenario to a new directory; with a note",
    ),
    (
        &[
            Command::TimeBack,
            Command::TimeForth,
            Command::Mark,
            Command::Visit,
        ],
        "back and forth in time; mark a state, go to a mark",
    ),
    (
        &[Command::Presets, Command::Restart],
        "choose another scenario; start this one again",
    ),
    (
        &[Command::Theory, Command::Accuracy, Command::Compare],
        "closed forms; how far to trust; a second method (m M)",
    ),
    (
        &[Command::Cursor, Command::Left, Command::Right],
        "a cursor that reads all curves at r; it moves",
    ),
    (
        &[Command::Up, Command::Down, Command::Accept, Command::Back],
        "up, down; take what is selected; close what is open",
    ),
    (
        &[Command::Help, Command::Search],
        "show or hide this help; search in it",
    ),
];

/// The names of a command's keys.
pub fn keys(binding: &Binding) -> Vec<String> {
    binding.keys.iter().map(ToString::to_string).collect()
}

/// Every command, one a line.
pub fn long() -> Vec<Entry> {
    BINDINGS.iter().map(Entry::of).collect()
}

/// Every command, those that belong together in one line.
pub fn short() -> Vec<Entry> {
    let mut lines = Vec::new();
    for binding in BINDINGS {
        let mut groups = GROUPS.iter();
        match groups.find(|(group, _)| group.contains(&binding.command)) {
            None => lines.push(Entry::of(binding)),
            Some((group, help)) if group[0] == binding.command => {
                let members = group
                    .iter()
                    .filter_map(|command| BINDINGS.iter().find(|other| other.command == *command));
                let keys = members.flat_map(keys).collect();
                lines.push(Entry { keys, help });
            }
            Some(_) => {}
        }
    }
    lines
}

/// The table of keys for the README.
pub fn markdown() -> String {
    let rows = short().into_iter().map(|entry| {
        let keys: Vec<String> = entry.keys.iter().map(|key| format!("`{key}`")).collect();
        format!("| {} | {} |\n", keys.join(" "), entry.help)
    });
    let rows: String = rows.collect();
    format!("| key | does |\n|---|---|\n{rows}")
}

/// The section on keys of the manual page, in roff.
pub fn roff() -> String {
    let plain = |text: &str| text.replace('\\', "\\e").replace('-', "\\-");
    let rows = long().into_iter().map(|entry| {
        let keys: Vec<String> = entry
            .keys
            .iter()
            .map(|key| format!("\\fB{}\\fR", plain(key)))
            .collect();
        // A line that begins with a dot would be a request.
        format!(".TP\n\\&{}\n\\&{}\n", keys.join(" "), plain(entry.help))
    });
    let rows: String = rows.collect();
    format!(".SH KEYS\nThe explorer obeys these keys.\n{rows}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_cut_in_the_help() {
        for entry in long().into_iter().chain(short()) {
            assert!(entry.keys.join(" ").chars().count() <= 21, "{entry:?}");
            assert!(entry.help.chars().count() <= 54, "{entry:?}");
        }
        assert!(short().len() <= 20);
    }

    #[test]
    fn every_key_stands_in_every_text() {
        let (short, markdown, roff) = (short(), markdown(), roff());
        for key in BINDINGS.iter().flat_map(keys) {
            assert!(short.iter().any(|entry| entry.keys.contains(&key)), "{key}");
            assert!(markdown.contains(&format!("`{key}`")), "{key}");
            let key = key.replace('-', "\\-");
            assert!(roff.contains(&format!("\\fB{key}\\fR")), "{key}");
        }
    }
}
