//! `mdr-tui new`: asks for what its options leave open, a line each with its default, and writes a commented scenario.
//! Predictions of closed forms appear at once below the answers. Without a terminal the defaults are the answers.

use std::io::{self, IsTerminal, Write};
use std::{process, thread};

use anyhow::{Context, Result, ensure};
use clap::{CommandFactory, Parser};
use signal_hook::iterator::{Handle, Signals};

use super::args::{Arguments, New};
use super::guide::columns;
use super::{FAILED, complain, explore, stop};
use crate::export::file::shell_path;
use crate::export::target::Target;
use crate::scenario::{Refusal, printable};
use crate::tui::line::wrapped;

mod answers;
mod forecast;

use answers::{Answers, QUESTIONS, Question, Reply, read};
use forecast::Forecast;

/// Writes a new scenario.
pub fn new(options: &New) -> Result<()> {
    let path = options.file.as_path();
    // Only a check: the file is not claimed while questions wait for answers.
    drop(Target::claim(path, options.force)?);
    let asks = io::stdin().is_terminal() && io::stderr().is_terminal();
    let watch = asks.then(end_on_signals).transpose()?;
    let interview = Interview {
        options: serde_json::to_value(options)?,
        asks,
    };
    let answers = interview.ask_all()?;
    let scenario = answers.scenario(&options.file.to_string_lossy())?;
    let opens = options.open
        || asks && read_line("Open it in the explorer?", "yes")?.starts_with(['y', 'Y']);
    if let Some(watch) = watch {
        watch.close();
    }
    Target::claim(path, options.force)?.write(answers.to_toml().as_bytes())?;
    let file = shell_path(path);
    let mut out = io::stdout().lock();
    if let Some(forecast) = Forecast::from_scenario(&scenario) {
        writeln!(out, "{}: {}", scenario.title(), forecast.contact())?;
        writeln!(out, "  {}", forecast.regime())?;
        writeln!(out, "  {}", forecast.a_day())?;
    }
    let hint = format!("mdr-tui {file} opens it, mdr-tui run {file} --out DIR runs it");
    writeln!(out, "written to {file}; {hint}")?;
    drop(out);
    if opens {
        // `--` keeps a name that begins with a dash from being taken for an option.
        let words = ["mdr-tui".as_ref(), "--".as_ref(), options.file.as_os_str()];
        let explorer = Arguments::parse_from(words).explore;
        explore::explore(&explorer, None)?;
    }
    Ok(())
}

/// Ends the program in one line on a signal, until the handle is closed.
fn end_on_signals() -> Result<Handle> {
    let mut signals = Signals::new(stop::ENDING).context("cannot listen for signals")?;
    let handle = signals.handle();
    thread::spawn(move || {
        if signals.forever().next().is_some() {
            complain("interrupted; nothing was written");
            process::exit(FAILED.into());
        }
    });
    Ok(handle)
}

/// Takes each answer from its option, from the user, or from its default.
struct Interview {
    /// The options, by name.
    options: serde_json::Value,
    /// Whether there is a user to ask.
    asks: bool,
}

impl Interview {
    fn ask_all(&self) -> Result<Answers> {
        let shape = self.choose(&["ball", "punch", "cylinder"])?;
        let is_line = shape == "cylinder";
        // A line has no depth: in the plane it is infinite.
        let press = if is_line {
            "load"
        } else {
            self.choose(&["load", "depth"])?
        };
        let is_open = |[option, ..]: &Question| match *option {
            option @ ("ball" | "punch" | "cylinder") => option == shape,
            option @ ("load" | "depth") => option == press,
            "length" | "gauge" => is_line,
            _ => true,
        };
        for option in ["length", "gauge"] {
            let place = format!("--{option}");
            let fits = is_line || self.given(option).is_none();
            ensure!(fits, Refusal::new(place, "needs --cylinder"));
        }
        // What is not asked yet has its default, so that the contact can be described already.
        let mut answers = Answers::default();
        for question @ [option, .., usual] in QUESTIONS.into_iter().filter(is_open) {
            let usual = read(question, usual).map_err(Refusal::from)?;
            answers.0.insert(option, usual);
        }
        for question @ [option, ..] in QUESTIONS.into_iter().filter(is_open) {
            answers.0.insert(option, self.ask(question)?);
            match option {
                "load" | "depth" => self.show(&answers, |of| of.contact())?,
                "friction" => self.show(&answers, |of| of.regime())?,
                "frequency" => self.show(&answers, |of| of.a_day())?,
                _ => {}
            }
        }
        Ok(answers)
    }

    /// Returns the value of an option, if given.
    fn given(&self, option: &str) -> Option<&str> {
        self.options[option].as_str()
    }

    /// Returns the one of some options that is given, or that the user names; the first without a user.
    fn choose<'a>(&self, options: &[&'a str]) -> Result<&'a str> {
        if let Some(given) = options.iter().find(|option| self.given(option).is_some()) {
            return Ok(given);
        }
        if !self.asks {
            return Ok(options[0]);
        }
        let prompt = format!("Which one: {}?", options.join(", "));
        loop {
            let word = read_line(&prompt, options[0])?.to_lowercase();
            if let Some(named) = options.iter().find(|option| option.starts_with(&word)) {
                return Ok(named);
            }
        }
    }

    /// Returns the answer to a question; asks the user again if it breaks a rule.
    fn ask(&self, question: Question) -> Result<Reply> {
        let [option, .., usual] = question;
        while self.asks && self.given(option).is_none() {
            match read(question, &read_line(&help(option), usual)?) {
                Ok(answer) => return Ok(answer),
                Err(rule) => say(&rule)?,
            }
        }
        let text = self.given(option).unwrap_or(usual);
        let place = format!("--{option} {}", printable(text));
        Ok(read(question, text).map_err(|rule| Refusal::new(place, rule))?)
    }

    /// Shows the user what closed forms predict from the answers so far.
    fn show(&self, answers: &Answers, what: fn(&Forecast) -> String) -> Result<()> {
        if self.asks
            && let Ok(scenario) = answers.scenario("so far")
            && let Some(forecast) = Forecast::from_scenario(&scenario)
        {
            say(&format!("= {}", what(&forecast)))?;
        }
        Ok(())
    }
}

/// Returns the help of an option, which is the text of its question.
fn help(option: &str) -> String {
    let program = Arguments::command();
    let new = program.find_subcommand("new");
    let option = new.and_then(|new| new.get_arguments().find(|known| known.get_id() == option));
    let help = option.and_then(|option| option.get_help());
    help.map(ToString::to_string).unwrap_or_default()
}

/// Reads a line from the terminal; an empty one is the default.
fn read_line(prompt: &str, default: &str) -> Result<String> {
    write!(io::stderr(), "{prompt} [{default}] ")?;
    let mut line = String::new();
    ensure!(io::stdin().read_line(&mut line)? > 0, "nothing was written");
    let line = line.trim();
    Ok(if line.is_empty() { default } else { line }.to_owned())
}

/// Writes a text between the questions, in lines that fit the terminal.
fn say(text: &str) -> io::Result<()> {
    for line in wrapped(text, columns().max(20) - 3) {
        writeln!(io::stderr(), "  {line}")?;
    }
    Ok(())
}
