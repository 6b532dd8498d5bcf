//! Every command of the explorer, one row each: keys, name, group, help, and action.
//!
//! Footer, help, palette, configuration and manual are generated from these rows. The argument of a command is typed in
//! the palette.

use std::sync::OnceLock;

use super::completion::{self, Completion};
use super::explorer::{Explorer, Next};
use super::frame::Frame;
use super::ghosts::Since;
use super::keys::Keystroke::{self, Char, Ctrl, Named};
use super::keys::Named as N;
use super::panels::StressMap;
use super::undo::Way;
use super::worker::ghosts::Ghosts;
use super::worker::pace::Pace;
use super::worker::{Order, changes, ends_cycle, files};
use Act::{Argument, Open, Screen, Words, Worker as Work};

/// A command, its keys and its help.
pub struct CommandRow {
    /// The command.
    pub command: Command,
    /// Its keys; the first is shown in the footer.
    pub keys: &'static [Keystroke],
    /// Its name, in a word or two.
    pub name: &'static str,
    /// Its group in the help.
    pub group: &'static str,
    /// What it does, in one line of text.
    pub help: &'static str,
    /// The action.
    pub(super) act: Act,
}

/// What a command does.
#[derive(Clone, Copy)]
pub(super) enum Act {
    /// Changes something on the screen.
    Screen(fn(&mut Explorer)),
    /// Orders something of the worker.
    Worker(fn() -> Order),
    /// Takes an argument, with these completions.
    Argument(fn(&str, &Frame) -> Vec<Completion>),
    /// Opens the choices of a scenario's key.
    Words(&'static str),
    /// Opens its overlay.
    Open,
    /// Ends the program, or returns to the map from which the run was opened.
    Quit,
}

macro_rules! commands {
    ($($group:literal { $($id:ident [$($key:expr),*] $name:literal, $help:literal, $act:expr;)* })*) => {
        /// A command of the explorer.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Command { $($(#[doc = $help] $id,)*)* }

        /// Every command, in the order of the help.
        pub static COMMANDS: &[CommandRow] = &[$($(CommandRow {
            command: Command::$id,
            keys: &[$($key),*],
            name: $name,
            group: $group,
            help: $help,
            act: $act,
        },)*)*];
    };
}

commands! {
    "palette" {
        Set [] "set", "change keys of the scenario: set KEY=VALUE, KEY=VALUE", Argument(completion::set);
        Load [] "load", "another preset, or a file: load NAME", Argument(completion::load);
        Goto [] "goto", "show the run at a cycle, past or to come: goto CYCLE", Argument(completion::goto);
        Sweep [] "sweep", "run many values of a key up to this cycle: sweep KEY FROM..TO", Argument(completion::sweep);
        Figure [] "figure", "draw this state for a paper: figure FILE.svg", Argument(completion::figure);
        Overlay [] "overlay", "data, a run or a scenario over the plots: overlay FILE", Argument(completion::overlay);
    }
    "run" {
        RunPause [Char(' ')] "run/pause", "run or pause the simulation", Work(|| Order::Run(Pace::run_or_pause));
        Step [Char('.')] "step", "pause and take one step", Work(|| Order::Step(|_, _| true));
        Cycle [Char(',')] "cycle", "pause and step to the end of the cycle", Work(|| Order::Step(ends_cycle));
        Faster [Char('+'), Char('=')] "faster", "more cycles per second, up to full speed", Work(|| Order::Pace(1));
        Slower [Char('-')] "slower", "fewer cycles per second", Work(|| Order::Pace(-1));
        HoldPhase [Char('f')] "phase", "fast runs: frames at one phase of the motion, or at any",
            Work(|| Order::Run(Pace::hold_or_release_phase));
        Restart [Char('r')] "restart", "restart the scenario as it was loaded", Screen(|on| on.order_with_new_scales(Order::Restart));
    }
    "look" {
        Accept [Named(N::Enter)] "explain", "explain the focused panel; in a list, choose the entry", Open;
        Tour [Char('n')] "tour", "tour of this preset: next caption", Screen(Explorer::continue_tour);
        NextPanel [Named(N::Tab)] "panel", "focus the next panel", Screen(|on| on.stage.shift_focus(1));
        PreviousPanel [Named(N::BackTab)] "panel back", "focus the previous panel",
            Screen(|on| on.stage.shift_focus(-1));
        NextPage [Char('v')] "view", "the next page of panels", Screen(|on| on.stage.turn_page());
        Focus [Char('1'), Char('2'), Char('3'), Char('4'), Char('5'), Char('6'), Char('7'), Char('8'), Char('9')]
            "focus", "focus a panel of this page; by name: focus PANEL", Argument(completion::focus);
        Zoom [Char('z')] "zoom", "zoom the focused panel, or show all panels", Screen(|on| on.stage.toggle_zoom());
        Contact [Char('V')] "contact", "the contact itself, large and in motion, or all panels",
            Screen(|on| on.stage.toggle_contact());
        LogScale [Char('L')] "log", "logarithmic scale in the focused panel", Screen(Explorer::toggle_log);
        Cursor [Char('x')] "cursor", "a cursor that reads the curves; arrows move it and zoom", Screen(|on| on.cursor.toggle());
        Left [Named(N::Left), Char('h')] "left", "move the cursor to the left, or focus the previous panel",
            Screen(|on| on.move_sideways(-1));
        Right [Named(N::Right), Char('l')] "right", "move the cursor to the right, or focus the next panel",
            Screen(|on| on.move_sideways(1));
        Up [Named(N::Up), Char('k')] "up", "zoom in about the cursor; up in a list", Screen(|on| on.move_upwards(true));
        Down [Named(N::Down), Char('j')] "down", "zoom out; down in a list", Screen(|on| on.move_upwards(false));
        ShowAll [Char('0')] "show all", "show all of the charts that were zoomed", Screen(Explorer::show_all);
        Theory [Char('t')] "theory", "show or hide closed forms in the plots",
            Screen(|on| on.charts.with_theory ^= true);
        Stress [Char('o')] "stress", "next stress component in the cross-section", Screen(|on| on.change_stress(StressMap::next));
        StressOfCycle [Char('O')] "stress, cycle", "largest stress of a cycle, or of this moment",
            Screen(|on| on.change_stress(StressMap::toggle_cycle));
        Theme [Char('T')] "theme", "colours for a dark or light background, or none", Screen(Explorer::change_theme);
        Back [Named(N::Esc)] "back", "close what is open: cursor, zoomed panel, closed forms", Screen(Explorer::go_back);
    }
    "change" {
        Presets [Char('p')] "presets", "another preset, or a file of your own", Open;
        Edit [Char('e')] "edit", "edit any parameter while it runs; changes are recorded", Open;
        NextMethod [Char('m')] "method", "next transform method; the state is carried over",
            Work(|| Order::Method(1));
        PreviousMethod [Char('M')] "method back", "previous transform method", Work(|| Order::Method(-1));
        Methods [Char('i')] "methods", "all transform methods, and what each is", Words("numerics.method");
        NextLaw [Char('w')] "wear law", "next wear law; the state is carried over", Work(|| Order::Change(changes::shift_law(1)));
        PreviousLaw [Char('W')] "law back", "previous wear law", Work(|| Order::Change(changes::shift_law(-1)));
        Laws [Char('I')] "wear laws", "all wear laws, and what each is", Words("wear.law");
        Coarser [Char('<')] "coarser", "less accurate, faster: chooses method, cells, steps", Work(|| Order::Change(changes::refine(-1)));
        Finer [Char('>')] "finer", "more accurate, slower: chooses method, cells, steps", Work(|| Order::Change(changes::refine(1)));
    }
    "compare and check" {
        Compare [Char('c')] "compare", "compare with a second method; m and M change it",
            Screen(|on| on.compare(Ghosts::compare_or_stop));
        CompareFromStart [Char('C')] "compare from start", "compare from the start of the scenario",
            Screen(|on| on.compare(|with, run| with.compare(run, 0, Since::Start)));
        Freeze [Char('g')] "ghost", "freeze this state as a ghost in the plots", Work(|| Order::Ghosts(Box::new(Ghosts::freeze)));
        DropGhosts [Char('G')] "no ghosts", "remove all ghosts: frozen states and overlays", Screen(|on| on.order_with_new_scales(Order::Ghosts(Box::new(Ghosts::drop_fixed))));
        Accuracy [Char('a')] "accuracy", "checks of the run, and its estimated errors", Open;
    }
    "time and files" {
        TimeBack [Char('[')] "back in time", "back in time; running or editing branches from there",
            Work(|| Order::Travel(Way::Places(-1)));
        TimeForth [Char(']')] "forward in time", "forward in time, up to the present",
            Work(|| Order::Travel(Way::Places(1)));
        TimeFarBack [Named(N::PageUp)] "far back", "ten states back in time",
            Work(|| Order::Travel(Way::Places(-10)));
        TimeFarForth [Named(N::PageDown)] "far forward", "ten states forward in time",
            Work(|| Order::Travel(Way::Places(10)));
        TimeStart [Named(N::Home)] "start", "the start of the run",
            Work(|| Order::Travel(Way::Before(0.0)));
        TimePresent [Named(N::End)] "present", "the present of the run",
            Work(|| Order::Travel(Way::Present));
        StateBack [Char('{')] "state back", "back to a state that the scenario writes",
            Work(|| Order::GoToPlanned(false));
        StateForth [Char('}')] "state", "on to the next state that the scenario writes",
            Work(|| Order::GoToPlanned(true));
        Copy [Char('y')] "copy", "copy readings, scenario or run command", Argument(completion::copy);
        Snapshot [Char('s')] "snapshot", "write state, history and loop to a new directory",
            Work(|| files::snapshot(None));
        SnapshotNote [Char('S')] "snapshot, note", "the same, with a note in both files", Argument(completion::note);
    }
    "program" {
        Palette [Char(':')] "commands", "every command by name, and set KEY=VALUE", Open;
        Help [Char('?')] "help", "show or hide this help", Open;
        Search [Char('/')] "search", "search in the help", Open;
        Quit [Char('q'), Ctrl('c')] "quit", "quit; Ctrl-C quits from anywhere", Act::Quit;
        QuitKeepingScreen [Char('Q')] "quit, keep", "quit, and leave the last screen in the terminal",
            Screen(|on| on.next = Next::LeaveScreen);
        Repaint [Ctrl('l')] "repaint", "repaint the whole screen, from anywhere", Screen(|on| on.next = Next::Repaint);
        Suspend [Ctrl('z')] "suspend", "suspend to the shell; fg returns", Screen(|on| on.next = Next::Suspend);
    }
}

impl Command {
    /// Returns its row.
    pub fn row(self) -> &'static CommandRow {
        &COMMANDS[self as usize]
    }
}

impl CommandRow {
    /// Returns the names of its keys; a row of digits is abbreviated.
    pub fn key_names(&self) -> Vec<String> {
        match self.keys {
            [first, .., last] if self.keys.len() > 3 => vec![format!("{first}-{last}")],
            keys => keys.iter().map(ToString::to_string).collect(),
        }
    }
}

/// The user's keys, which override those in the table.
static OWN: OnceLock<Vec<(Keystroke, Command)>> = OnceLock::new();

/// Binds additional keys to commands, once, before the explorer opens.
pub fn bind(keys: Vec<(Keystroke, Command)>) {
    // A second explorer in the same process keeps the keys of the first.
    let _ = OWN.set(keys);
}

/// Returns the command of a key.
pub fn of_key(key: Keystroke) -> Option<Command> {
    let mut own = OWN.get().into_iter().flatten();
    let own = own.find(|(bound, _)| *bound == key);
    own.map(|(_, command)| *command).or_else(|| {
        let mut rows = COMMANDS.iter();
        rows.find(|row| row.keys.contains(&key))
            .map(|row| row.command)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_has_two_commands() {
        let keys: Vec<Keystroke> = COMMANDS.iter().flat_map(|row| row.keys).copied().collect();
        for (i, key) in keys.iter().enumerate() {
            assert!(!keys[..i].contains(key), "{key} is bound twice");
        }
    }

    #[test]
    fn every_command_says_what_it_does_and_can_be_called() {
        for row in COMMANDS {
            assert_eq!(row.command.row().name, row.name);
            assert!(!row.help.is_empty() && row.help.len() < 66, "{}", row.name);
            let is_typed = matches!(row.act, Argument(_));
            assert!(is_typed || !row.keys.is_empty(), "{}", row.name);
        }
    }
}
