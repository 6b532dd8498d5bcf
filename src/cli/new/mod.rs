//! `mdr-tui new`: asks a few questions, each with its meaning and a default, and writes a commented scenario from the
//! answers. Predictions of closed forms appear at once below each question. Without a terminal, the options are the
//! answers.

use std::io::{self, IsTerminal, Write};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::time::Duration;
use std::{process, thread};

use anyhow::{Context, Result};
use clap::Parser;
use dialoguer::console::Term;
use dialoguer::theme::{ColorfulTheme, SimpleTheme, Theme};
use dialoguer::{Confirm, Input, Select};
use signal_hook::iterator::Signals;

use super::args::{Arguments, New};
use super::guide::columns;
use super::{FAILED, complain, explore, stop};
use crate::export::file::shell_path;
use crate::export::target::Target;
use crate::scenario::{Refusal, printable};
use crate::tui::line::wrapped;
use crate::tui::modes::Modes;

mod answers;
mod forecast;

use answers::{Body, Draft, Quantity, Question, materials, question};
use forecast::Forecast;

/// A scenario with more cycles than this uses cycle jumps.
const JUMP_FROM: f64 = 1000.0;

/// Writes a new scenario.
pub fn new(options: &New) -> Result<()> {
    let path = options.file.as_path();
    // Only a check: the file is not claimed while questions wait for answers.
    drop(Target::claim(path, options.force)?);
    let asks = io::stdin().is_terminal() && io::stderr().is_terminal();
    let interview = Interview {
        options: serde_json::to_value(options)?,
        theme: asks.then(theme),
    };
    let draft = interview.ask_all()?;
    let scenario = draft.scenario(&options.file.to_string_lossy())?;
    Target::claim(path, options.force)?.write(draft.to_toml().as_bytes())?;
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
    let mut opens = options.open;
    if let (false, Some(theme)) = (opens, &interview.theme) {
        let question = Confirm::with_theme(&**theme).with_prompt("Open it now?");
        let _cursor = Cursor;
        let answer = question.default(true).interact();
        opens = answer.context("the scenario is written, but not opened")?;
    }
    if opens {
        // `--` keeps a name that begins with a dash from being taken for an option.
        let words = ["mdr-tui".as_ref(), "--".as_ref(), options.file.as_os_str()];
        let explorer = Arguments::parse_from(words).explore;
        explore::explore(&explorer, None)?;
    }
    Ok(())
}

/// Whether a signal or Ctrl-C interrupted a question.
fn is_interrupted(error: &anyhow::Error) -> bool {
    let cause = error.downcast_ref();
    matches!(cause, Some(dialoguer::Error::IO(cause)) if cause.kind() == io::ErrorKind::Interrupted)
}

fn theme() -> Box<dyn Theme> {
    match std::env::var_os("NO_COLOR") {
        Some(_) => Box::new(SimpleTheme),
        None => Box::new(ColorfulTheme::default()),
    }
}

/// Shows the cursor again, which questions hide, however they end.
struct Cursor;

impl Drop for Cursor {
    fn drop(&mut self) {
        let _ = Term::stderr().show_cursor();
    }
}

/// Minimum number of rows and columns for questions.
const LEAST: (u16, u16) = (3, 20);

/// Refuses a terminal that is too small for questions.
fn check_room() -> Result<(), Refusal> {
    let (rows, columns) = Term::stderr().size();
    if rows >= LEAST.0 && columns >= LEAST.1 {
        return Ok(());
    }
    let place = format!("a terminal of {columns} by {rows} characters");
    let rule = format!("questions need {} by {}; options answer", LEAST.1, LEAST.0);
    Err(Refusal::new(
        place,
        format!("{rule} them too, see mdr-tui new --help"),
    ))
}

/// Maximum time that a question takes to switch the terminal to raw mode.
const SETTLES: Duration = Duration::from_millis(20);

/// Takes each answer from its option, from the user, or from its default.
struct Interview {
    /// The options, by name.
    options: serde_json::Value,
    /// The look of the questions; `None` without a terminal.
    theme: Option<Box<dyn Theme>>,
}

impl Interview {
    /// Returns the answers; restores the terminal if a signal or a key interrupts the questions.
    fn ask_all(&self) -> Result<Draft> {
        if self.theme.is_none() {
            return self.answers();
        }
        check_room()?;
        let mut signals = Signals::new(stop::ENDING).context("cannot listen for signals")?;
        let (closing, modes, _cursor) = (signals.handle(), Modes::note()?, Cursor);
        let watch = thread::spawn(move || {
            if signals.forever().next().is_some() {
                modes.restore();
                drop(Cursor);
                complain("interrupted; nothing was written");
                // A question that was just being asked may have switched to raw mode after the first restore.
                thread::sleep(SETTLES);
                modes.restore();
                process::exit(FAILED.into());
            }
        });
        let answers = catch_unwind(AssertUnwindSafe(|| self.answers()));
        if !matches!(&answers, Ok(Err(error)) if is_interrupted(error)) {
            closing.close();
        }
        // A signal ends the process here, and so does Ctrl-C, which a question reports as a signal.
        let _ = watch.join();
        // The terminal may have been made too small in the meantime.
        answers.unwrap_or_else(|panic| match check_room() {
            Err(refusal) => Err(refusal.into()),
            Ok(()) => resume_unwind(panic),
        })
    }

    fn answers(&self) -> Result<Draft> {
        let mut draft = Draft::default();
        // What is not asked yet has its default, so that the contact can be described already.
        let usual = |option| {
            let question = question(option);
            question.read(&question.default).map_err(Refusal::from)
        };
        for option in ["stroke", "friction", "frequency", "cycles"] {
            draft.answer(question(option), &usual(option)?);
        }
        let what = "Which shape presses on the flat body?";
        let (shape, _) = self.one_of(&["ball", "punch", "cylinder"], what, &mut draft)?;
        let of_line = ["length", "gauge"];
        let is_line = shape.option == "cylinder";
        if is_line {
            self.number("length", &mut draft)?;
            draft.answer(question("gauge"), &usual("gauge")?);
        } else if let Some(option) = of_line.iter().find(|option| self.given(option).is_some()) {
            let place = format!("--{option}");
            return Err(Refusal::new(place, "needs --cylinder").into());
        }
        let of = self.body("material", &mut draft)?;
        let on = self.body("against", &mut draft)?;
        let what = "What presses the bodies together?";
        // A line has no depth: in the plane it is infinite.
        let presses = if is_line {
            &["load"][..]
        } else {
            &["load", "depth"]
        };
        let (_, press) = self.one_of(presses, what, &mut draft)?;
        self.show_forecast(&draft, |of| of.contact())?;
        let stroke = self.number("stroke", &mut draft)?;
        if is_line {
            self.number("gauge", &mut draft)?;
        }
        self.number("friction", &mut draft)?;
        self.show_forecast(&draft, |of| of.regime())?;
        self.number("frequency", &mut draft)?;
        self.show_forecast(&draft, |of| of.a_day())?;
        let wear = question("wear");
        let coefficient = self.ask(wear, |text| match text.trim() {
            "none" => Ok(None),
            text => wear.read(text).map(Some),
        })?;
        let cycles = self.number("cycles", &mut draft)?;
        if let Some(coefficient) = &coefficient {
            draft.answer(wear, coefficient);
            if cycles.value > JUMP_FROM {
                let note = "jumps over cycles that are alike; \"direct\": every step";
                draft.set("numerics.integrator", "cycle-jump", note);
            }
        }
        let (name, press, stroke) = (&shape.name, press.text, stroke.text);
        let title = format!("{name} of {of} on {on}, {press}, stroke {stroke}");
        draft.set("title", title, "");
        Ok(draft)
    }

    /// One of some questions, and its answer: the one whose option is given, or whose item the user chooses.
    fn one_of(
        &self,
        all: &[&str],
        prompt: &str,
        draft: &mut Draft,
    ) -> Result<(&'static Question, Quantity)> {
        let given = all.iter().position(|option| self.given(option).is_some());
        let items = all.iter().map(|option| &question(option).item);
        let which = match given {
            None if all.len() > 1 => self.choose(prompt, &items.collect::<Vec<_>>())?,
            given => given.unwrap_or(0),
        };
        Ok((question(all[which]), self.number(all[which], draft)?))
    }

    /// Adds a material to the draft: from its option, from the list, or from two numbers. Returns its name.
    fn body(&self, option: &str, draft: &mut Draft) -> Result<String> {
        let mut question = question(option).clone();
        let mut listed = None;
        if self.theme.is_some() && self.given(option).is_none() {
            let items = materials().iter().map(|body| match &body.elastic {
                None => format!("{}: does not yield", body.name),
                Some((modulus, poisson)) => {
                    format!("{}: E = {modulus}, Poisson's ratio {poisson}", body.name)
                }
            });
            let another = "another: type E and Poisson's ratio".to_owned();
            let items: Vec<String> = items.chain([another]).collect();
            listed = materials().get(self.choose(&question.prompt, &items)?);
            (question.prompt, question.default) = ("E,NU".into(), "210 GPa,0.3".into());
        }
        let body = match listed {
            Some(body) => body.clone(),
            None => self.ask(&question, Body::read)?,
        };
        draft.body(&question, &body);
        Ok(body.name)
    }

    /// Asks the question of an option and adds the answer to the draft.
    fn number(&self, option: &str, draft: &mut Draft) -> Result<Quantity> {
        let question = question(option);
        let answer = self.ask(question, |text| question.read(text))?;
        draft.answer(question, &answer);
        Ok(answer)
    }

    /// Returns the value of an option, if given.
    fn given(&self, option: &str) -> Option<&str> {
        self.options[option].as_str()
    }

    /// Returns a one-line answer: the option's, the user's, or the default.
    fn ask<T>(&self, question: &Question, read: impl Fn(&str) -> Result<T, String>) -> Result<T> {
        let text = match (self.given(&question.option), &self.theme) {
            (Some(given), _) => given.to_owned(),
            (None, None) => question.default.clone(),
            (None, Some(theme)) => {
                say(&question.meaning)?;
                Input::<String>::with_theme(&**theme)
                    .with_prompt(&question.prompt)
                    .default(question.default.clone())
                    .validate_with(|text: &String| read(text).map(drop))
                    .interact_text()
                    .context("nothing was written")?
            }
        };
        let place = format!("--{} {}", question.option, printable(&text));
        Ok(read(&text).map_err(|rule| Refusal::new(place, rule))?)
    }

    /// Returns the index of the item that the user chooses; the first without a terminal.
    fn choose(&self, prompt: &str, items: &[impl std::fmt::Display]) -> Result<usize> {
        let Some(theme) = &self.theme else {
            return Ok(0);
        };
        let question = Select::with_theme(&**theme).with_prompt(prompt);
        let answer = question.items(items).default(0).interact();
        answer.context("nothing was written")
    }

    /// Shows the user what closed forms predict from the answers so far.
    fn show_forecast(&self, draft: &Draft, what: fn(&Forecast) -> String) -> Result<()> {
        if self.theme.is_some()
            && let Ok(scenario) = draft.scenario("so far")
            && let Some(forecast) = Forecast::from_scenario(&scenario)
        {
            say(&format!("= {}", what(&forecast)))?;
        }
        Ok(())
    }
}

/// Writes a text between the questions, in lines that fit the terminal.
fn say(text: &str) -> io::Result<()> {
    for line in wrapped(text, columns().saturating_sub(3)) {
        writeln!(io::stderr(), "  {line}")?;
    }
    Ok(())
}
