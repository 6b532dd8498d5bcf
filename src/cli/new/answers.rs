//! The questions of `mdr-tui new`, the parsing of their answers, and the commented scenario made from them.
//!
//! `questions.toml` holds each question with its meaning, its default, and the key that it sets.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;
use toml::Value;

use crate::scenario::key::{Key, join};
use crate::scenario::value::literal;
use crate::scenario::{Refusal, Scenario, units, write};

/// The contents of `questions.toml`.
#[derive(Deserialize)]
struct Form {
    #[serde(rename = "question")]
    questions: Vec<Question>,
    #[serde(rename = "material")]
    materials: Vec<Body>,
}

static FORM: LazyLock<Form> = LazyLock::new(|| {
    toml::from_str(include_str!("questions.toml")).expect("the questions are whole")
});

/// A question that is answered with one line and sets a key of the scenario.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Question {
    /// The option that answers it in advance.
    pub option: String,
    /// Its subject, as named in a title.
    pub name: String,
    /// Its name in a list.
    pub item: String,
    with: Option<[String; 3]>,
    key: String,
    share: Option<f64>,
    unit: String,
    /// The question.
    pub prompt: String,
    /// What it means.
    pub meaning: String,
    /// Default answer.
    pub default: String,
    note: String,
}

/// Returns the question that an option answers.
pub fn question(option: &str) -> &'static Question {
    let mut questions = FORM.questions.iter();
    let found = questions.find(|question| question.option == option);
    found.expect("a question of the form")
}

impl Question {
    /// Reads an answer; a bare number has the question's unit.
    ///
    /// # Errors
    /// The rule that the answer breaks.
    pub fn read(&self, text: &str) -> Result<Quantity, String> {
        quantity(text, &self.key, &self.unit)
    }
}

/// One of the two bodies.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Body {
    /// The material's name.
    pub name: String,
    /// Young's modulus with its unit, and Poisson's ratio; `None` if it is rigid.
    pub elastic: Option<(String, f64)>,
}

/// Returns the materials of the short list.
pub fn materials() -> &'static [Body] {
    &FORM.materials
}

impl Body {
    /// Reads a name from the list, or `E,NU` such as `200 GPa,0.3`.
    ///
    /// # Errors
    /// Says what would be valid.
    pub fn read(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let mut known = materials().iter();
        if let Some(body) = known.find(|body| body.name.eq_ignore_ascii_case(text)) {
            return Ok(body.clone());
        }
        let Some((modulus, poisson)) = text.split_once(',') else {
            let names: Vec<&str> = materials().iter().map(|body| &*body.name).collect();
            let names = names.join(", ");
            return Err(format!(
                "must be one of {names}, or E,NU such as \"200 GPa,0.3\""
            ));
        };
        let modulus = quantity(modulus, "material.indenter.youngs_modulus", "GPa")?;
        let poisson = quantity(poisson, "material.indenter.poisson", "")?;
        Ok(Self {
            name: format!("E = {}", modulus.text),
            elastic: Some((modulus.text, poisson.value)),
        })
    }
}

/// A number with its unit, as typed, and its value in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// As written in the scenario.
    pub text: String,
    /// In the unit of its key.
    pub value: f64,
}

/// Reads the value of a key; a bare number has the unit `unit`.
fn quantity(text: &str, key: &str, unit: &str) -> Result<Quantity, String> {
    let text = text.trim();
    let known = Key::find(key).expect("a key of the table");
    let text = match text.parse::<f64>() {
        Ok(_) => format!("{text} {unit}").trim_end().to_owned(),
        Err(_) => text.to_owned(),
    };
    let with_unit = units::quantity(&text, &known, unit == "N");
    let value = match (with_unit, text.parse::<f64>()) {
        (Some(value), _) => value?,
        (None, Ok(value)) if value.is_finite() => value,
        (None, _) if unit.is_empty() => return Err("must be a number".into()),
        (None, _) => return Err(format!("must be a number, in {unit} or with its unit")),
    };
    if known.range.holds(value) {
        Ok(Quantity { text, value })
    } else {
        Err(format!("must be {}", known.range))
    }
}

/// The scenario so far: its keys, each with a value and a note.
#[derive(Debug, Default)]
pub struct Draft(BTreeMap<String, (Value, String)>);

impl Draft {
    /// Sets a key, with a note beside it.
    pub fn set(&mut self, path: &str, value: impl Into<Value>, note: impl Into<String>) {
        self.0.insert(path.to_owned(), (value.into(), note.into()));
    }

    /// Sets the key of a question to its answer, and any second key that goes with it.
    pub fn answer(&mut self, question: &Question, given: &Quantity) {
        let value = match question.share {
            Some(share) => Value::Float(share * given.value),
            None if question.unit.is_empty() => Value::Float(given.value),
            None => Value::String(given.text.clone()),
        };
        let note = question.note.replace("{}", &given.text);
        self.set(&question.key, value, note);
        if let Some([key, value, note]) = &question.with {
            self.set(key, value.as_str(), note);
        }
    }

    /// Sets the keys of the body that a question is about.
    pub fn body(&mut self, question: &Question, body: &Body) {
        let mut set = |key: &str, value: Value, note: &str| {
            self.set(&join(&question.key, key), value, note);
        };
        match &body.elastic {
            None => set("rigid", true.into(), ""),
            Some((modulus, poisson)) => {
                set("youngs_modulus", modulus.as_str().into(), &body.name);
                set("poisson", (*poisson).into(), "");
            }
        }
    }

    /// Makes the scenario.
    ///
    /// # Errors
    /// If the answers together do not make a contact.
    pub fn scenario(&self, origin: &str) -> Result<Scenario, Refusal> {
        Scenario::from_toml(&self.to_toml(), origin, &[])
    }

    /// Returns the scenario as a commented file.
    pub fn to_toml(&self) -> String {
        write::sections(|known| {
            let (value, note) = self.0.get(known.path)?;
            let row = format!("{} = {}", known.key(), literal(value));
            Some(if note.is_empty() {
                row
            } else {
                format!("{row:38} # {note}")
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn materials_are_names_or_two_numbers() {
        for known in materials() {
            assert_eq!(Body::read(&known.name).as_ref(), Ok(known));
        }
        let body = Body::read(" 200 GPa , 0.28").expect("two numbers");
        assert_eq!(body.elastic, Some(("200 GPa".into(), 0.28)));
        assert_eq!(
            Body::read("70,0.2").expect("in GPa").elastic,
            Some(("70 GPa".into(), 0.2))
        );
        for text in ["stone", "200 GPa", "200 GPa,0.7", "200 mm,0.3", "-1,0.3"] {
            assert!(Body::read(text).is_err(), "{text}");
        }
    }

    #[test]
    fn quantities_are_in_the_unit_that_is_asked_for_unless_they_say() {
        let of = |text: &str| question("ball").read(text);
        assert_eq!(of("10").expect("a length").value, 0.01);
        assert_eq!(of("200 um").expect("a length").value, 2e-4);
        for (text, rule) in [
            ("0", "greater than 0"),
            ("ten", "in mm"),
            ("1 N", "compatible"),
            ("0,3", "point"),
        ] {
            let told = of(text).expect_err(text);
            assert!(told.contains(rule), "{text}: {told}");
        }
    }
}
