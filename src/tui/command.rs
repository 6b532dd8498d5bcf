//! The one table of commands: it makes the keys, the footer and the help.

use super::keys::{Key, Named};

/// What a key can ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// Leave.
    Quit,
    /// Leave, and leave the last screen in the terminal.
    QuitKeepingScreen,
    /// Stop, and give the terminal back to the shell for a while.
    Suspend,
    /// Close what is open, or leave the zoomed panel.
    Back,
    /// Show or hide the help.
    Help,
    /// Run or pause.
    RunPause,
    /// One step of the simulation.
    Step,
    /// To the end of the cycle.
    Cycle,
    /// The next transform method.
    NextMethod,
    /// The transform method before.
    PreviousMethod,
    /// The next wear law.
    NextLaw,
    /// The wear law before.
    PreviousLaw,
    /// More cycles a second.
    Faster,
    /// Fewer cycles a second.
    Slower,
    /// Coarser, and cheaper.
    Coarser,
    /// Finer, and dearer.
    Finer,
    /// Focus the next panel.
    NextPanel,
    /// Focus the panel before.
    PreviousPanel,
    /// The next page of panels.
    NextPage,
    /// The focused panel alone, or all of them.
    Zoom,
    /// Write the present state to files.
    Snapshot,
    /// The same with a note.
    SnapshotNote,
    /// Edit the parameters.
    Edit,
    /// Back in time.
    TimeBack,
    /// Forth in time.
    TimeForth,
    /// Mark the state on the screen.
    Mark,
    /// Go to a marked state.
    Visit,
    /// Choose another preset.
    Presets,
    /// Start again.
    Restart,
    /// Logarithmic ordinate of the focused panel.
    LogScale,
    /// Theory over the plots.
    Theory,
    /// Other colours.
    Theme,
    /// Two methods side by side.
    Compare,
    /// How far to trust the run.
    Accuracy,
    /// Read the curves at a radius.
    Cursor,
    /// Every command by its name.
    Palette,
    /// Search in the help.
    Search,
    /// Left: the cursor, or the focus.
    Left,
    /// Right.
    Right,
    /// Up in a list.
    Up,
    /// Down in a list.
    Down,
    /// Take what is selected.
    Accept,
}

/// A command, the keys that call it, and what help says of it.
pub struct Binding {
    /// The command.
    pub command: Command,
    /// Its keys; the first is shown in the footer.
    pub keys: &'static [Key],
    /// Its name, in a word or two.
    pub name: &'static str,
    /// What it does, in a line.
    pub help: &'static str,
    /// Whether the footer shows it.
    pub in_footer: bool,
}

const fn bind(
    command: Command,
    keys: &'static [Key],
    name: &'static str,
    help: &'static str,
    in_footer: bool,
) -> Binding {
    Binding {
        command,
        keys,
        name,
        help,
        in_footer,
    }
}

use Command as C;
use Key::{Char, Ctrl};

/// Every command of the explorer, in the order of the help.
pub static BINDINGS: &[Binding] = &[
    bind(
        C::RunPause,
        &[Char(' ')],
        "run/pause",
        "run or pause the simulation",
        true,
    ),
    bind(
        C::Step,
        &[Char('.')],
        "step",
        "pause and take one step",
        true,
    ),
    bind(
        C::Cycle,
        &[Char(',')],
        "cycle",
        "pause and go on to the end of the cycle",
        true,
    ),
    bind(
        C::Faster,
        &[Char('+'), Char('=')],
        "faster",
        "more cycles a second, up to as fast as it can",
        false,
    ),
    bind(
        C::Slower,
        &[Char('-')],
        "slower",
        "fewer cycles a second",
        false,
    ),
    bind(
        C::Coarser,
        &[Char('<')],
        "coarser",
        "faster and less accurate: fewer cells and steps",
        false,
    ),
    bind(
        C::Finer,
        &[Char('>')],
        "finer",
        "more accurate and slower: more cells and steps",
        false,
    ),
    bind(
        C::NextMethod,
        &[Char('m')],
        "method",
        "next transform method; the state is carried over",
        true,
    ),
    bind(
        C::PreviousMethod,
        &[Char('M')],
        "method back",
        "previous transform method",
        false,
    ),
    bind(
        C::NextLaw,
        &[Char('w')],
        "wear law",
        "next wear law; the state is carried over",
        true,
    ),
    bind(
        C::PreviousLaw,
        &[Char('W')],
        "law back",
        "previous wear law",
        false,
    ),
    bind(
        C::NextPage,
        &[Char('v')],
        "view",
        "more panels: cross-section, wear, rates, cost",
        true,
    ),
    bind(
        C::NextPanel,
        &[Key::Named(Named::Tab)],
        "panel",
        "focus the next panel",
        true,
    ),
    bind(
        C::PreviousPanel,
        &[Key::Named(Named::BackTab)],
        "panel back",
        "focus the previous panel",
        false,
    ),
    bind(
        C::Zoom,
        &[Char('z')],
        "zoom",
        "show the focused panel alone, or all again",
        true,
    ),
    bind(
        C::LogScale,
        &[Char('L')],
        "log",
        "logarithmic scale in the focused panel",
        false,
    ),
    bind(
        C::Snapshot,
        &[Char('s')],
        "snapshot",
        "write state.csv and scenario.toml to a new directory",
        true,
    ),
    bind(
        C::SnapshotNote,
        &[Char('S')],
        "snapshot, note",
        "the same with a note, kept in both files",
        false,
    ),
    bind(
        C::Edit,
        &[Char('e')],
        "edit",
        "edit any parameter while it runs; changes are recorded",
        true,
    ),
    bind(
        C::TimeBack,
        &[Char('[')],
        "back in time",
        "back in time; running or editing branches from there",
        false,
    ),
    bind(
        C::TimeForth,
        &[Char(']')],
        "forth in time",
        "forth in time, up to the present",
        false,
    ),
    bind(
        C::Mark,
        &[Char('b')],
        "bookmark",
        "mark the state on the screen",
        false,
    ),
    bind(
        C::Visit,
        &[Char('B')],
        "go to bookmark",
        "go to the marked state before this one",
        false,
    ),
    bind(
        C::Presets,
        &[Char('p')],
        "presets",
        "another preset, or a file of your own",
        true,
    ),
    bind(
        C::Restart,
        &[Char('r')],
        "restart",
        "start the scenario again, as it was loaded",
        false,
    ),
    bind(
        C::Theory,
        &[Char('t')],
        "theory",
        "closed forms over the plots, or not",
        false,
    ),
    bind(
        C::Theme,
        &[Char('T')],
        "theme",
        "colours for a dark or a light background, or none",
        false,
    ),
    bind(
        C::Compare,
        &[Char('c')],
        "compare",
        "a second method beside this one; m and M change it",
        true,
    ),
    bind(
        C::Accuracy,
        &[Char('a')],
        "accuracy",
        "how far to trust the run: certificates, half the cells",
        false,
    ),
    bind(
        C::Cursor,
        &[Char('x')],
        "cursor",
        "a cursor that reads all curves at r; arrows move it",
        false,
    ),
    bind(
        C::Palette,
        &[Char(':')],
        "commands",
        "every command by its name, and set KEY=VALUE",
        true,
    ),
    bind(
        C::Left,
        &[Key::Named(Named::Left), Char('h')],
        "left",
        "move the cursor inwards, or the focus back",
        false,
    ),
    bind(
        C::Right,
        &[Key::Named(Named::Right), Char('l')],
        "right",
        "move the cursor outwards, or the focus on",
        false,
    ),
    bind(
        C::Up,
        &[Key::Named(Named::Up), Char('k')],
        "up",
        "up in a list",
        false,
    ),
    bind(
        C::Down,
        &[Key::Named(Named::Down), Char('j')],
        "down",
        "down in a list",
        false,
    ),
    bind(
        C::Accept,
        &[Key::Named(Named::Enter)],
        "accept",
        "take what is selected",
        false,
    ),
    bind(
        C::Back,
        &[Key::Named(Named::Esc)],
        "back",
        "close what is open, leave the zoomed panel",
        false,
    ),
    bind(
        C::Help,
        &[Char('?')],
        "help",
        "show or hide this help",
        true,
    ),
    bind(
        C::Search,
        &[Char('/')],
        "search",
        "search in the help",
        false,
    ),
    bind(
        C::Quit,
        &[Char('q'), Ctrl('c')],
        "quit",
        "leave; Ctrl-C leaves from anywhere",
        true,
    ),
    bind(
        C::QuitKeepingScreen,
        &[Char('Q')],
        "quit, keep",
        "leave, and leave the last screen behind",
        false,
    ),
    bind(
        C::Suspend,
        &[Ctrl('z')],
        "suspend",
        "back to the shell for a while; fg returns",
        false,
    ),
];

/// The command of a key.
pub fn of_key(key: Key) -> Option<Command> {
    BINDINGS
        .iter()
        .find(|binding| binding.keys.contains(&key))
        .map(|binding| binding.command)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_has_two_commands() {
        let keys: Vec<Key> = BINDINGS
            .iter()
            .flat_map(|binding| binding.keys)
            .copied()
            .collect();
        for (i, key) in keys.iter().enumerate() {
            assert!(!keys[..i].contains(key), "{key} is bound twice");
        }
    }

    #[test]
    fn every_command_says_what_it_does() {
        for binding in BINDINGS {
            assert!(
                !binding.keys.is_empty() && !binding.help.is_empty() && binding.help.len() < 60
            );
        }
    }
}
