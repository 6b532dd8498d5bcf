//! Completions and man pages, generated from the arguments and the table of keys.

use std::io::{self, Write};
use std::path::Path;

use anyhow::{Context, Result, bail};
use clap::{Command, CommandFactory};
use clap_complete::env::Shells;
use clap_mangen::Man;

use super::args::{Arguments, Manual};
use super::complete::VARIABLE;
use crate::export::file::write_whole;
use crate::scenario::Refusal;
use crate::scenario::hint::hint;
use crate::tui::manual;

/// Prints a script with which a shell asks this program for completions.
pub fn completions(shell: clap_complete::Shell) -> Result<()> {
    if shell == clap_complete::Shell::Bash {
        // The script of clap_complete does not quote blanks and completes nothing after `=`.
        io::stdout().write_all(include_bytes!("completion.bash"))?;
        return Ok(());
    }
    let mut script = Vec::new();
    let shells = Shells::builtins();
    let completer = shells.completer(&shell.to_string());
    let completer = completer.with_context(|| format!("no completions for {shell}"))?;
    completer.write_registration(VARIABLE, "mdr-tui", "mdr-tui", "mdr-tui", &mut script)?;
    io::stdout().write_all(&script)?;
    Ok(())
}

/// Prints one man page or all of them, or writes each to a file.
pub fn man(options: &Manual) -> Result<()> {
    let mut program = Arguments::command();
    // Gives the commands their full names, as in "mdr-tui run".
    program.build();
    let given = options.command.as_deref();
    let is_wanted = |command: &&Command| given.is_none_or(|given| command.get_name() == given);
    let commands = std::iter::once(&program).chain(program.get_subcommands());
    let commands: Vec<&Command> = commands.filter(is_wanted).collect();
    if commands.is_empty() {
        let given = given.unwrap_or_default();
        let names: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
        let hint = hint(given, names.into_iter());
        bail!(Refusal::new(format_args!("man {given}"), "no such command").or(hint));
    }
    for command in commands {
        let page = page(command)?;
        match &options.out {
            Some(directory) => write(directory, command, &page)?,
            None => io::stdout().write_all(&page)?,
        }
    }
    Ok(())
}

fn write(directory: &Path, command: &Command, page: &[u8]) -> Result<()> {
    let name = command.get_bin_name().unwrap_or(command.get_name());
    let name = name.replace(' ', "-");
    std::fs::create_dir_all(directory)
        .with_context(|| format!("{}: cannot make the directory", directory.display()))?;
    Ok(write_whole(&directory.join(name + ".1"), page)?)
}

fn page(command: &Command) -> Result<Vec<u8>> {
    let is_program = command.get_name() == "mdr-tui";
    let source = concat!("mdr-tui ", env!("CARGO_PKG_VERSION"));
    let man = Man::new(command.clone()).source(source);
    let mut page = Vec::new();
    man.render_title(&mut page)?;
    man.render_name_section(&mut page)?;
    man.render_synopsis_section(&mut page)?;
    man.render_description_section(&mut page)?;
    man.render_options_section(&mut page)?;
    if is_program {
        man.render_subcommands_section(&mut page)?;
        page.extend(manual::roff().into_bytes());
    }
    page.extend(examples(command).into_bytes());
    if !is_program {
        page.extend_from_slice(b".SH SEE ALSO\n.BR mdr\\-tui (1)\n");
    }
    Ok(page)
}

/// Returns the text after the options, line by line as written.
fn examples(command: &Command) -> String {
    let Some(text) = command.get_after_help().map(ToString::to_string) else {
        return String::new();
    };
    let lines = text.lines().skip_while(|line| line.starts_with("Example"));
    let body: String = lines.map(|line| format!("\\&{}\n", plain(line))).collect();
    format!(".SH EXAMPLES\n.nf\n{body}.fi\n")
}

fn plain(text: &str) -> String {
    text.replace('\\', "\\e").replace('-', "\\-")
}
