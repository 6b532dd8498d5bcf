//! Completions and the manual pages, made from the arguments and the table of keys themselves.

use std::io::{self, Write};
use std::process::ExitCode;

use anyhow::{Context, Result};
use clap::CommandFactory;
use clap_complete::env::Shells;
use clap_mangen::Man;

use super::args::Arguments;
use super::complete::VARIABLE;
use crate::tui::manual;

/// Prints a script with which the shell asks this program for completions.
pub fn completions(shell: clap_complete::Shell) -> Result<ExitCode> {
    let mut script = Vec::new();
    let shells = Shells::builtins();
    let completer = shells
        .completer(&shell.to_string())
        .with_context(|| format!("no completions for {shell}"))?;
    completer.write_registration(VARIABLE, "mdr-tui", "mdr-tui", "mdr-tui", &mut script)?;
    io::stdout().write_all(&script)?;
    Ok(ExitCode::SUCCESS)
}

/// Prints the manual page, and after it one page for each command.
pub fn man() -> Result<ExitCode> {
    let mut command = Arguments::command();
    // Gives the commands their full names, "mdr-tui run".
    command.build();
    let source = concat!("mdr-tui ", env!("CARGO_PKG_VERSION"));
    let mut pages = Vec::new();
    for command in std::iter::once(&command).chain(command.get_subcommands()) {
        Man::new(command.clone())
            .source(source)
            .render(&mut pages)?;
        if command.get_name() == "mdr-tui" {
            pages.extend(manual::roff().into_bytes());
        }
    }
    io::stdout().write_all(&pages)?;
    Ok(ExitCode::SUCCESS)
}
