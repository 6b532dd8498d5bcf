//! The command line: arguments in, one line on stderr and an exit code out.

use std::io::{self, Write};
use std::process::ExitCode;

use clap::Parser;
use clap::error::ErrorKind;

use crate::export::file::WriteError;
use crate::scenario::checkpoint::CheckpointError;
use crate::scenario::session::SessionError;
use crate::scenario::{ScenarioError, printable};
use crate::tui::NoTerminal;

mod args;
mod documents;
mod errand;
mod error_curves;
mod explore;
mod presets;
mod progress;
mod results;
mod run;
mod small_multiples;
mod stability;
mod stop;
mod trade;
mod verify;

use args::{Arguments, Command};

/// Exit code of a run that failed.
const FAILED: u8 = 1;
/// Exit code of wrong use or wrong input.
const MISUSED: u8 = 2;

/// Wrong use that no other error type stands for.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub(crate) struct Misuse(pub String);

/// Runs the program on the arguments of the process.
pub fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return refuse(&error),
    };
    match dispatch(arguments) {
        Ok(code) => code,
        Err(error) if is_closed_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            complain(&format!("{error:#}"));
            ExitCode::from(exit_code(&error))
        }
    }
}

fn dispatch(arguments: Arguments) -> anyhow::Result<ExitCode> {
    match arguments.command {
        None => explore::explore(&arguments.explore),
        Some(Command::Run(options)) => run::run(&options),
        Some(Command::Presets(options)) => presets::presets(&options),
        Some(Command::Verify(options)) => verify::verify(&options),
        Some(Command::Trade(options)) => trade::trade(&options),
        Some(Command::Stability(options)) => stability::stability(&options),
        Some(Command::Completions { shell }) => documents::completions(shell),
        Some(Command::Man) => documents::man(),
    }
}

/// Prints one line on stderr, whatever names the user gave.
pub(crate) fn complain(message: &str) {
    let _ = writeln!(io::stderr(), "mdr-tui: {}", printable(message.trim_end()));
}

/// Wrong use and wrong input are 2, a run that failed is 1.
fn exit_code(error: &anyhow::Error) -> u8 {
    for cause in error.chain() {
        if cause.is::<Misuse>()
            || cause.is::<ScenarioError>()
            || cause.is::<CheckpointError>()
            || cause.is::<NoTerminal>()
        {
            return MISUSED;
        }
        if let Some(SessionError::Scenario(_)) = cause.downcast_ref() {
            return MISUSED;
        }
        if let Some(error) = cause.downcast_ref::<WriteError>() {
            return if error.is_misuse() { MISUSED } else { FAILED };
        }
    }
    FAILED
}

/// `mdr-tui presets | head -1` is no error.
fn is_closed_pipe(error: &anyhow::Error) -> bool {
    error
        .chain()
        .filter_map(|cause| cause.downcast_ref::<io::Error>())
        .any(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

/// Help and version go to stdout as they are; a mistake becomes one line.
fn refuse(error: &clap::Error) -> ExitCode {
    if matches!(
        error.kind(),
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion
    ) {
        let _ = error.print();
        return ExitCode::SUCCESS;
    }
    let text = error.render().to_string();
    let words = text
        .lines()
        .take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more information"))
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
        .replace(" tip: ", "; ");
    complain(&format!(
        "{}; see mdr-tui --help",
        words.trim_start_matches("error: ")
    ));
    ExitCode::from(MISUSED)
}
