//! The command line: arguments in, one line on stderr and an exit code out.

use std::env;
use std::io::{self, IsTerminal, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::mpsc::channel;
use std::thread;
use std::time::Duration;

use clap::error::{ContextKind, ErrorKind};
use clap::{CommandFactory, Parser};
use clap_complete::CompleteEnv;

use crate::export::claim;
use crate::export::file::WriteError;
use crate::scenario::hint::nearest;
use crate::scenario::session::SessionError;
use crate::scenario::{Refusal, preset, printable};
use crate::tui::NoTerminal;

mod accuracy;
mod args;
mod complete;
mod config;
mod cycles;
mod documents;
mod explore;
mod figure;
mod fit;
mod given;
mod guide;
mod inspect;
mod job;
mod new;
mod presets;
mod progress;
mod report;
mod run;
mod stability;
mod stop;
mod sweep;
mod trade;
mod verify;

use args::{Arguments, CliCommand};

/// Exit code of a run that failed.
const FAILED: u8 = 1;
/// Exit code of wrong use or wrong input.
const MISUSED: u8 = 2;

/// Exit code of an interrupted study (EX_TEMPFAIL): its rows are saved, and `--resume` continues it.
const UNFINISHED: u8 = 75;

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    // If a shell asks for completions, prints them and exits.
    CompleteEnv::with_factory(Arguments::command)
        .var(complete::VARIABLE)
        .complete();
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return refuse(&error),
    };
    crate::panics::capture();
    // Ignores SIGXFSZ, so that a file at its size limit is an error like a full disk.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
    let outcome = catch_unwind(AssertUnwindSafe(|| dispatch(arguments)));
    claim::release_all();
    let Ok(outcome) = outcome else {
        let word = crate::panics::take_message().unwrap_or_default();
        complain(&format!("bug in mdr-tui: {word}"));
        return ExitCode::from(FAILED);
    };
    match outcome {
        Ok(code) => code,
        Err(error) if is_closed_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            let lines = error.downcast_ref().map(Refusal::lines);
            match lines.unwrap_or_default() {
                [] | [_] => complain(&format!("{error:#}")),
                several => several.iter().for_each(|line| complain(line)),
            }
            ExitCode::from(exit_code(&error))
        }
    }
}

fn dispatch(arguments: Arguments) -> anyhow::Result<ExitCode> {
    crate::failpoint::hit("command");
    let command = &arguments.command;
    if let Some(CliCommand::Figure(_) | CliCommand::Fit(_) | CliCommand::Verify(_)) = command {
        stop::end_at_signal()?;
    }
    match arguments.command {
        None => explore::explore(&arguments.explore, None)?,
        Some(CliCommand::New(options)) => new::new(&options)?,
        Some(CliCommand::Presets(options)) => presets::presets(&options)?,
        Some(CliCommand::Verify(options)) => verify::verify(&options)?,
        Some(CliCommand::Fit(options)) => fit::fit(&options)?,
        Some(CliCommand::Inspect(options)) => inspect::inspect(&options)?,
        Some(CliCommand::Guide(options)) => guide::guide(&options)?,
        Some(CliCommand::Figure(options)) => figure::figure(&options)?,
        Some(CliCommand::Completions { shell }) => documents::completions(shell)?,
        Some(CliCommand::Man(options)) => documents::man(&options)?,
        // These may end with less computed than was asked for.
        Some(CliCommand::Run(options)) => return run::run(&options),
        Some(CliCommand::Trade(options)) => return trade::trade(&options),
        Some(CliCommand::Stability(options)) => return stability::stability(&options),
        Some(CliCommand::Sweep(options)) => return sweep::sweep(&options),
    }
    Ok(ExitCode::SUCCESS)
}

/// Returns the exit code of a study.
fn succeeded(has_succeeded: bool) -> ExitCode {
    if has_succeeded {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(FAILED)
    }
}

/// Longest wait for a terminal that has stopped reading.
pub(crate) const TERMINAL_TIMEOUT: Duration = Duration::from_millis(400);

/// Prints one line on stderr, even if names from the user contain line breaks.
pub(crate) fn complain(message: &str) {
    let line = format!("mdr-tui: {}\n", printable(message.trim_end()));
    let is_terminal = io::stderr().is_terminal();
    without_waiting(is_terminal, move || {
        let _ = io::stderr().write_all(line.as_bytes());
    });
}

/// Writes to stderr, but does not wait for a terminal that has stopped reading.
pub(crate) fn without_waiting(is_terminal: bool, write: impl FnOnce() + Send + 'static) {
    if !is_terminal {
        return write();
    }
    let (done, finished) = channel();
    thread::spawn(move || {
        write();
        let _ = done.send(());
    });
    let _ = finished.recv_timeout(TERMINAL_TIMEOUT);
}

/// Returns 2 for wrong use and wrong input, 1 for a run that failed.
fn exit_code(error: &anyhow::Error) -> u8 {
    let is_misuse = |cause: &(dyn std::error::Error + 'static)| {
        let wraps_misuse = matches!(cause.downcast_ref(), Some(SessionError::Scenario(_)));
        let written = cause.downcast_ref::<WriteError>();
        wraps_misuse
            || cause
                .downcast_ref()
                .is_some_and(|refusal: &Refusal| !refusal.is_failure())
            || cause.is::<NoTerminal>()
            || written.is_some_and(WriteError::is_misuse)
    };
    if error.chain().any(is_misuse) {
        MISUSED
    } else {
        FAILED
    }
}

/// Whether the reader of a pipe has left: `mdr-tui presets | head -1` is not an error.
fn is_closed_pipe(error: &anyhow::Error) -> bool {
    let io_error = |cause: &'_ (dyn std::error::Error + 'static)| {
        let error = match cause.downcast_ref() {
            Some(WriteError::Io { cause, .. }) => Some(cause),
            _ => cause.downcast_ref::<io::Error>(),
        };
        error.is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
    };
    error.chain().any(io_error)
}

/// Returns an error that suggests the nearest command, or the option of that name, if `word` looks like a mistyped one
/// and is neither a preset nor a path.
fn mistyped_command(word: &str) -> Option<Refusal> {
    let program = Arguments::command();
    let commands = program.get_subcommands().map(clap::Command::get_name);
    let is_path = preset::is_path(word) || Path::new(word).exists();
    let is_known = word.starts_with('-') || is_path || preset::find(word).is_some();
    let command = nearest(word, commands).filter(|command| *command != word);
    let mut options = program.get_arguments().filter_map(clap::Arg::get_long);
    let option = options
        .find(|option| *option == word)
        .map(|option| format!("--{option}"));
    let meant = option
        .or(command.map(str::to_owned))
        .filter(|_| !is_known)?;
    let refusal = Refusal::new(printable(word), "no such command or preset");
    Some(refusal.or(format_args!("did you mean mdr-tui {meant}?")))
}

/// Options that older versions had, and what to use instead.
const GONE: [(&str, &str); 2] = [
    (
        "--format",
        "--print prints text; mdr-tui figure draws charts as SVG, PNG or PDF",
    ),
    (
        "--each",
        "fit one file at a time: for f in *.csv; do mdr-tui fit SCENARIO --scar $f --free KEYS; done",
    ),
];

/// Prints help and version on stdout; reports a mistake in one line.
fn refuse(error: &clap::Error) -> ExitCode {
    let kind = error.kind();
    if matches!(kind, ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        let _ = error.print();
        return ExitCode::SUCCESS;
    }
    let first = env::args_os().nth(1).unwrap_or_default();
    let first = first.to_string_lossy();
    if let Some(refusal) = mistyped_command(&first) {
        complain(&refusal.to_string());
        return ExitCode::from(MISUSED);
    }
    let unknown = error.get(ContextKind::InvalidArg).map(ToString::to_string);
    let gone = GONE
        .iter()
        .find(|(option, _)| unknown.as_deref() == Some(option));
    if let (ErrorKind::UnknownArgument, Some((option, instead))) = (kind, gone) {
        complain(&format!(
            "{option}: there is no such option any more: {instead}"
        ));
        return ExitCode::from(MISUSED);
    }
    let text = error.render().to_string();
    let is_end =
        |line: &&str| line.starts_with("Usage:") || line.starts_with("For more information");
    let lines = text.lines().take_while(|line| !is_end(line)).map(str::trim);
    let lines: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
    let words = lines.join(" ").replace(" tip: ", "; ");
    let command = match Arguments::command().find_subcommand(&*first) {
        Some(_) => format!("mdr-tui {first}"),
        None => "mdr-tui".into(),
    };
    let words = words.trim_start_matches("error: ");
    complain(&format!("{words}; see {command} --help"));
    ExitCode::from(MISUSED)
}
