//! `mdr-tui new`: a few questions, each with what it means and a default, and a commented scenario of the
//! answers. What closed forms say of them stands at once below the question. Without a terminal the
//! options are the answers.

use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;

use anyhow::{Context, Result};
use clap::Parser;
use dialoguer::theme::{ColorfulTheme, SimpleTheme, Theme};
use dialoguer::{Confirm, Input, Select};

use super::args::{Arguments, New};
use super::explore;
use crate::export::file::shell_word;
use crate::export::target::Target;
use crate::scenario::{Refusal, printable};

mod answers;
mod forecast;

use answers::{Answers, Body, MATERIALS, Press, Quantity, Shape, quantity};
use forecast::Forecast;

/// Writes a new scenario.
pub fn new(options: &New) -> Result<ExitCode> {
    let path = Path::new(&options.file);
    let target = Target::claim(path, options.force)?;
    let asks = io::stdin().is_terminal() && io::stderr().is_terminal();
    let answers = Interview {
        options,
        theme: asks.then(theme),
    }
    .answers()?;
    let text = answers.to_toml();
    let scenario = answers.scenario(&options.file)?;
    target.write(text.as_bytes())?;
    drop(target);
    let file = shell_word(path);
    let mut out = io::stdout().lock();
    if let Some(forecast) = Forecast::of(&scenario) {
        writeln!(out, "{}: {}", scenario.title(), forecast.contact())?;
        writeln!(out, "  {}", forecast.regime())?;
        writeln!(out, "  {}", forecast.a_day())?;
    }
    writeln!(
        out,
        "written to {file}; mdr-tui {file} opens it, mdr-tui run {file} --out DIR runs it"
    )?;
    drop(out);
    let opens = match asks && !options.open {
        true => Confirm::with_theme(&*theme())
            .with_prompt("Open it now?")
            .default(true)
            .interact()
            .context("the scenario is written, but not opened")?,
        false => options.open,
    };
    match opens {
        // A name that begins with a dash is not an option.
        true => explore::explore(&Arguments::parse_from(["mdr-tui", "--", &options.file]).explore),
        false => Ok(ExitCode::SUCCESS),
    }
}

fn theme() -> Box<dyn Theme> {
    match std::env::var_os("NO_COLOR") {
        Some(_) => Box::new(SimpleTheme),
        None => Box::new(ColorfulTheme::default()),
    }
}

/// Takes each answer from its option, from the user, or from its default.
struct Interview<'a> {
    options: &'a New,
    /// How questions look; `None` without a terminal.
    theme: Option<Box<dyn Theme>>,
}

/// A question that is answered by a line.
struct Question<'a> {
    flag: &'a str,
    given: Option<&'a String>,
    prompt: &'a str,
    meaning: &'a str,
    default: &'a str,
}

impl Interview<'_> {
    fn answers(&self) -> Result<Answers> {
        let options = self.options;
        let (shape, radius) = self.indenter()?;
        let indenter = self.body(
            "--material",
            &options.material,
            "What is the indenter made of?",
        )?;
        let half_space = self.body("--against", &options.against, "And the flat body?")?;
        let press = self.press()?;
        // Questions not asked yet have their defaults, so that the contact can be described already.
        let mut answers = Answers {
            shape,
            radius,
            indenter,
            half_space,
            press,
            stroke: default("20 um", "motion.tangential.amplitude", "um")?,
            frequency: default("10 Hz", "motion.tangential.frequency", "Hz")?,
            friction: default("0.6", "friction.coefficient", "")?,
            wear: None,
            cycles: default("1000", "run.cycles", "")?,
        };
        self.tell(&answers, Forecast::contact)?;
        answers.stroke = self.ask(
            &Question {
                flag: "--stroke",
                given: options.stroke.as_ref(),
                prompt: "Stroke",
                meaning: "from turning point to turning point, at the contact; in um unless said otherwise",
                default: "20 um",
            },
            |text| quantity(text, "motion.tangential.amplitude", "um", false),
        )?;
        answers.friction = self.ask(
            &Question {
                flag: "--friction",
                given: options.friction.as_ref(),
                prompt: "Coefficient of friction",
                meaning: "dry metals 0.5 to 0.9, ceramics 0.3 to 0.6, lubricated 0.1",
                default: "0.6",
            },
            |text| quantity(text, "friction.coefficient", "", false),
        )?;
        self.tell(&answers, Forecast::regime)?;
        answers.frequency = self.ask(
            &Question {
                flag: "--frequency",
                given: options.frequency.as_ref(),
                prompt: "Frequency",
                meaning: "cycles a second, in Hz; it matters for powers of the slip rate alone",
                default: "10 Hz",
            },
            |text| quantity(text, "motion.tangential.frequency", "Hz", false),
        )?;
        self.tell(&answers, Forecast::a_day)?;
        answers.wear = self.ask(
            &Question {
                flag: "--wear",
                given: options.wear.as_ref(),
                prompt: "Wear coefficient of a pin test, or none",
                meaning: "volume per load and sliding distance, in mm3/Nm: mild wear 1e-7 to 1e-5, severe 1e-4",
                default: "1e-6 mm3/Nm",
            },
            |text| match text.trim() {
                "none" => Ok(None),
                text => quantity(text, "wear.coefficient_per_load", "mm3/Nm", false).map(Some),
            },
        )?;
        answers.cycles = self.ask(
            &Question {
                flag: "--cycles",
                given: options.cycles.as_ref(),
                prompt: "Cycles",
                meaning: "the length of the test; above 1000 cycles that are alike are jumped over",
                default: "1000",
            },
            |text| quantity(text, "run.cycles", "", false),
        )?;
        Ok(answers)
    }

    fn indenter(&self) -> Result<(Shape, Quantity)> {
        let options = self.options;
        let shape = match (&options.ball, &options.punch) {
            (None, None) => {
                let items = [
                    "ball: pressure is highest in the middle, slip begins at the edge",
                    "flat punch: a disc whose edge carries most; the contact keeps its size",
                ];
                match self.choose("Which shape presses on the flat body?", &items)? {
                    0 => Shape::Ball,
                    _ => Shape::Punch,
                }
            }
            (Some(_), _) => Shape::Ball,
            (None, Some(_)) => Shape::Punch,
        };
        let question = match shape {
            Shape::Ball => Question {
                flag: "--ball",
                given: options.ball.as_ref(),
                prompt: "Radius of the ball",
                meaning: "in mm unless said otherwise; for two curved bodies 1/R = 1/R1 + 1/R2",
                default: "5 mm",
            },
            Shape::Punch => Question {
                flag: "--punch",
                given: options.punch.as_ref(),
                prompt: "Radius of the punch",
                meaning: "of its flat face, in mm unless said otherwise",
                default: "1 mm",
            },
        };
        let radius = self.ask(&question, |text| {
            quantity(text, "indenter.radius", "mm", false)
        })?;
        Ok((shape, radius))
    }

    fn body(&self, flag: &str, given: &Option<String>, prompt: &str) -> Result<Body> {
        if given.is_none() && self.theme.is_some() {
            let mut items: Vec<String> = MATERIALS
                .iter()
                .map(|(name, modulus, poisson)| match *modulus {
                    "" => format!("{name}: does not yield"),
                    modulus => format!("{name}: E = {modulus}, Poisson's ratio {poisson}"),
                })
                .collect();
            items.push("another: type E and Poisson's ratio".to_owned());
            let at = self.choose(prompt, &items)?;
            if let Some((name, ..)) = MATERIALS.get(at) {
                return Body::read(name).map_err(|rule| Refusal::from(rule).into());
            }
        }
        let question = Question {
            flag,
            given: given.as_ref(),
            prompt: "E,NU",
            meaning: "Young's modulus and Poisson's ratio, a comma between them",
            default: if self.theme.is_some() {
                "210 GPa,0.3"
            } else {
                "steel"
            },
        };
        self.ask(&question, Body::read)
    }

    fn press(&self) -> Result<Press> {
        let options = self.options;
        let is_depth = match (&options.load, &options.depth) {
            (None, None) => {
                let items = [
                    "a load: it is held while the contact wears, as by a dead weight",
                    "a depth: it is held, and wear unloads the contact",
                ];
                self.choose("What presses the bodies together?", &items)? == 1
            }
            (load, _) => load.is_none(),
        };
        if is_depth {
            let question = Question {
                flag: "--depth",
                given: options.depth.as_ref(),
                prompt: "Depth",
                meaning: "by which the bodies approach, in um unless said otherwise",
                default: "1 um",
            };
            return self
                .ask(&question, |text| {
                    quantity(text, "motion.normal.mean", "um", false)
                })
                .map(Press::Depth);
        }
        let question = Question {
            flag: "--load",
            given: options.load.as_ref(),
            prompt: "Load",
            meaning: "in N unless said otherwise",
            default: "10 N",
        };
        self.ask(&question, |text| {
            quantity(text, "motion.normal.mean", "N", true)
        })
        .map(Press::Load)
    }

    /// An answer of one line: the option's, the user's, or the default.
    fn ask<T>(&self, question: &Question, read: impl Fn(&str) -> Result<T, String>) -> Result<T> {
        let refused = |text: &str, rule: String| {
            let flag = question.flag;
            Refusal::new(format_args!("{flag} {}", printable(text)), rule)
        };
        let text = match (question.given, &self.theme) {
            (Some(given), _) => given.clone(),
            (None, None) => question.default.to_owned(),
            (None, Some(theme)) => {
                writeln!(io::stderr(), "  {}", question.meaning)?;
                Input::<String>::with_theme(&**theme)
                    .with_prompt(question.prompt)
                    .default(question.default.to_owned())
                    .validate_with(|text: &String| read(text).map(drop))
                    .interact_text()
                    .context("nothing was written")?
            }
        };
        Ok(read(&text).map_err(|rule| refused(&text, rule))?)
    }

    /// The place of the item that is chosen; the first without a terminal.
    fn choose(&self, prompt: &str, items: &[impl std::fmt::Display]) -> Result<usize> {
        let Some(theme) = &self.theme else {
            return Ok(0);
        };
        Select::with_theme(&**theme)
            .with_prompt(prompt)
            .items(items)
            .default(0)
            .interact()
            .context("nothing was written")
    }

    /// Tells a user what closed forms say of the answers so far.
    fn tell(&self, answers: &Answers, what: fn(&Forecast) -> String) -> Result<()> {
        if self.theme.is_some()
            && let Some(forecast) = answers
                .scenario("so far")
                .ok()
                .as_ref()
                .and_then(Forecast::of)
        {
            writeln!(io::stderr(), "  = {}", what(&forecast))?;
        }
        Ok(())
    }
}

/// A default, which is right.
fn default(text: &str, key: &str, unit: &str) -> Result<Quantity> {
    Ok(quantity(text, key, unit, false).map_err(Refusal::from)?)
}
