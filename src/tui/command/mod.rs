//! Commands that a key, the palette or a click can trigger, and the map from keys to commands.

use std::sync::OnceLock;

use super::keys::Key;

mod table;

pub use table::BINDINGS;

/// A command of the explorer.
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
    /// All transform methods, and what each is.
    Methods,
    /// All wear laws, and what each is.
    Laws,
    /// The next wear law.
    NextLaw,
    /// The wear law before.
    PreviousLaw,
    /// More cycles per second.
    Faster,
    /// Fewer cycles per second.
    Slower,
    /// Coarser and cheaper.
    Coarser,
    /// Finer and more expensive.
    Finer,
    /// Focus the next panel.
    NextPanel,
    /// Focus the panel before.
    PreviousPanel,
    /// The next page of panels.
    NextPage,
    /// The focused panel alone, or all of them.
    Zoom,
    /// The contact alone, in motion, or all panels.
    Contact,
    /// Write the present state to files.
    Snapshot,
    /// The same with a note.
    SnapshotNote,
    /// Edit the parameters.
    Edit,
    /// Back in time.
    TimeBack,
    /// Forward in time.
    TimeForth,
    /// Choose another preset.
    Presets,
    /// Start again.
    Restart,
    /// Logarithmic ordinate of the focused panel.
    LogScale,
    /// The next stress in the half-space.
    Stress,
    /// Its largest value in a cycle, or the present one.
    StressOfCycle,
    /// Theory over the plots.
    Theory,
    /// Other colours.
    Theme,
    /// Two methods side by side.
    Compare,
    /// The second method from the start of the scenario.
    CompareFromStart,
    /// The present state as a ghost over the plots.
    Freeze,
    /// No ghosts.
    DropGhosts,
    /// Frames of a fast run at one phase of the motion, or as they come.
    HoldPhase,
    /// The next caption of the tour.
    Tour,
    /// Checks of the run.
    Accuracy,
    /// Read the curves at a radius.
    Cursor,
    /// The command palette.
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

/// A command, its keys and its help.
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

/// The user's own keys, which override those of the table.
static OWN: OnceLock<Vec<(Key, Command)>> = OnceLock::new();

/// Binds further keys to commands, once, before the explorer opens.
pub fn bind(keys: Vec<(Key, Command)>) {
    // A second explorer in the same process keeps the keys of the first.
    let _ = OWN.set(keys);
}

/// The command of a key.
pub fn of_key(key: Key) -> Option<Command> {
    let own = OWN.get().into_iter().flatten();
    let own = own.filter(|(bound, _)| *bound == key);
    own.map(|(_, command)| *command).next().or_else(|| {
        BINDINGS
            .iter()
            .find(|binding| binding.keys.contains(&key))
            .map(|binding| binding.command)
    })
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
