//! `mdr-tui new`: a few questions, each with what it means and a default, and a commented scenario of the
//! answers. What closed forms say of them stands at once below the question. Without a terminal the
//! options are the answers.

use std::io::{self, IsTerminal, Write};
use std::path::Path;

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

use answers::{Answers, Body, MATERIALS, Quantity, quantity};
use forecast::Forecast;

/// Writes a new scenario.
pub fn new(options: &New) -> Result<()> {
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
        true => {
            let explorer = Arguments::parse_from(["mdr-tui", "--", &options.file]).explore;
            explore::explore(&explorer, None)
        }
        false => Ok(()),
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

/// A question that is answered by a line, about a key of the scenario.
struct Question {
    flag: &'static str,
    given: fn(&New) -> &Option<String>,
    prompt: &'static str,
    meaning: &'static str,
    default: &'static str,
    key: &'static str,
    /// The unit of a bare number.
    unit: &'static str,
}

macro_rules! questions {
    ($($name:ident --$option:ident in $unit:literal: $prompt:literal ($meaning:literal), $default:literal, $key:literal;)*) => {
        $(const $name: Question = Question {
            flag: concat!("--", stringify!($option)),
            given: |options| &options.$option,
            prompt: $prompt,
            meaning: $meaning,
            default: $default,
            key: $key,
            unit: $unit,
        };)*
    };
}

questions! {
    MATERIAL --material in "": "What is the indenter made of?"
        ("Young's modulus and Poisson's ratio, a comma between them"), "steel", "";
    AGAINST --against in "": "And the flat body?"
        ("Young's modulus and Poisson's ratio, a comma between them"), "steel", "";
    BALL --ball in "mm": "Radius of the ball"
        ("in mm unless said otherwise; for two curved bodies 1/R = 1/R1 + 1/R2"), "5 mm", "indenter.radius";
    PUNCH --punch in "mm": "Radius of the punch"
        ("of its flat face, in mm unless said otherwise"), "1 mm", "indenter.radius";
    LOAD --load in "N": "Load" ("in N unless said otherwise"), "10 N", "motion.normal.mean";
    DEPTH --depth in "um": "Depth"
        ("by which the bodies approach, in um unless said otherwise"), "1 um", "motion.normal.mean";
    STROKE --stroke in "um": "Stroke"
        ("from turning point to turning point, at the contact; in um unless said otherwise"), "20 um",
        "motion.tangential.amplitude";
    FRICTION --friction in "": "Coefficient of friction"
        ("dry metals 0.5 to 0.9, ceramics 0.3 to 0.6, lubricated 0.1"), "0.6", "friction.coefficient";
    FREQUENCY --frequency in "Hz": "Frequency"
        ("cycles a second, in Hz; it matters for powers of the slip rate alone"), "10 Hz",
        "motion.tangential.frequency";
    WEAR --wear in "mm3/Nm": "Wear coefficient of a pin test, or none"
        ("volume per load and sliding distance, in mm3/Nm: mild wear 1e-7 to 1e-5, severe 1e-4"), "1e-6 mm3/Nm",
        "wear.coefficient_per_load";
    CYCLES --cycles in "": "Cycles"
        ("the length of the test; above 1000 cycles that are alike are jumped over"), "1000", "run.cycles";
}

impl Question {
    fn read(&self, text: &str) -> Result<Quantity, String> {
        quantity(text, self.key, self.unit, self.unit == "N")
    }
}

impl Interview<'_> {
    fn answers(&self) -> Result<Answers> {
        let shapes = [
            "ball: pressure is highest in the middle, slip begins at the edge",
            "flat punch: a disc whose edge carries most; the contact keeps its size",
        ];
        let presses = [
            "a load: it is held while the contact wears, as by a dead weight",
            "a depth: it is held, and wear unloads the contact",
        ];
        let what = "Which shape presses on the flat body?";
        let (is_punch, radius) = self.one_of([&BALL, &PUNCH], what, shapes)?;
        let indenter = self.body(&MATERIAL)?;
        let half_space = self.body(&AGAINST)?;
        let what = "What presses the bodies together?";
        let (holds_depth, press) = self.one_of([&LOAD, &DEPTH], what, presses)?;
        // Questions not asked yet have their defaults, so that the contact can be described already.
        let default = |question: &Question| question.read(question.default).map_err(Refusal::from);
        let mut answers = Answers {
            is_punch,
            radius,
            indenter,
            half_space,
            holds_depth,
            press,
            stroke: default(&STROKE)?,
            frequency: default(&FREQUENCY)?,
            friction: default(&FRICTION)?,
            wear: None,
            cycles: default(&CYCLES)?,
        };
        self.tell(&answers, Forecast::contact)?;
        answers.stroke = self.number(&STROKE)?;
        answers.friction = self.number(&FRICTION)?;
        self.tell(&answers, Forecast::regime)?;
        answers.frequency = self.number(&FREQUENCY)?;
        self.tell(&answers, Forecast::a_day)?;
        answers.wear = self.ask(&WEAR, |text| match text.trim() {
            "none" => Ok(None),
            text => WEAR.read(text).map(Some),
        })?;
        answers.cycles = self.number(&CYCLES)?;
        Ok(answers)
    }

    /// The answer to one of two questions, and whether it is the second: by the option that is given, or by the
    /// user's choice of an item.
    fn one_of(
        &self,
        both: [&Question; 2],
        prompt: &str,
        items: [&str; 2],
    ) -> Result<(bool, Quantity)> {
        let is_second = match both.map(|question| (question.given)(self.options)) {
            [None, None] => self.choose(prompt, &items)? == 1,
            [first, _] => first.is_none(),
        };
        Ok((is_second, self.number(both[usize::from(is_second)])?))
    }

    /// A material: by its option, from the list, or by two numbers.
    fn body(&self, question: &Question) -> Result<Body> {
        let is_asked = self.theme.is_some() && (question.given)(self.options).is_none();
        if !is_asked {
            return self.ask(question, Body::read);
        }
        let items = MATERIALS.map(|(name, modulus, poisson)| match modulus {
            "" => format!("{name}: does not yield"),
            modulus => format!("{name}: E = {modulus}, Poisson's ratio {poisson}"),
        });
        let another = "another: type E and Poisson's ratio".to_owned();
        let items: Vec<String> = items.into_iter().chain([another]).collect();
        match MATERIALS.get(self.choose(question.prompt, &items)?) {
            Some((name, ..)) => Body::read(name).map_err(|rule| Refusal::from(rule).into()),
            None => {
                let by_numbers = Question {
                    prompt: "E,NU",
                    default: "210 GPa,0.3",
                    ..*question
                };
                self.ask(&by_numbers, Body::read)
            }
        }
    }

    fn number(&self, question: &Question) -> Result<Quantity> {
        self.ask(question, |text| question.read(text))
    }

    /// An answer of one line: the option's, the user's, or the default.
    fn ask<T>(&self, question: &Question, read: impl Fn(&str) -> Result<T, String>) -> Result<T> {
        let text = match ((question.given)(self.options), &self.theme) {
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
        let place = format!("{} {}", question.flag, printable(&text));
        Ok(read(&text).map_err(|rule| Refusal::new(place, rule))?)
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
            && let Ok(scenario) = answers.scenario("so far")
            && let Some(forecast) = Forecast::of(&scenario)
        {
            writeln!(io::stderr(), "  = {}", what(&forecast))?;
        }
        Ok(())
    }
}
