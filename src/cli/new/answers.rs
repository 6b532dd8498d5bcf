//! The questions of `mdr-tui new`, how their answers are read, and the commented scenario made of them.

use std::collections::BTreeMap;

use toml::Value;

use crate::scenario::key::{Key, join};
use crate::scenario::value::literal;
use crate::scenario::{Refusal, Scenario, units, write};

/// A question: the option that answers it in advance, and whose help is its text; the key, or the table of a body, that
/// the answer is for; the unit of a bare number; and the default answer.
pub type Question = [&'static str; 4];

/// All questions, in the order in which they are asked.
pub const QUESTIONS: [Question; 14] = [
    ["ball", "indenter.radius", "mm", "5 mm"],
    ["punch", "indenter.radius", "mm", "1 mm"],
    ["cylinder", "indenter.radius", "mm", "6 mm"],
    ["length", "indenter.length", "mm", "10 mm"],
    ["material", "material.indenter", "", "steel"],
    ["against", "material.half_space", "", "steel"],
    ["load", "motion.normal.mean", "N", "10 N"],
    ["depth", "motion.normal.mean", "um", "1 um"],
    ["stroke", "motion.tangential.amplitude", "um", "20 um"],
    ["gauge", "motion.tangential.gauge_length", "mm", "10 mm"],
    ["friction", "friction.coefficient", "", "0.6"],
    ["frequency", "motion.tangential.frequency", "Hz", "10 Hz"],
    ["wear", "wear.coefficient_per_load", "mm3/Nm", "1e-6 mm3/Nm"],
    ["cycles", "run.cycles", "", "1000"],
];

/// The words that go with an option: the key, and its word.
const WORDS: [(&str, &str, &str); 6] = [
    ("ball", "indenter.shape", "paraboloid"),
    ("punch", "indenter.shape", "flat-punch"),
    ("cylinder", "indenter.shape", "paraboloid"),
    ("cylinder", "indenter.geometry", "line"),
    ("load", "motion.normal.control", "force"),
    ("depth", "motion.normal.control", "displacement"),
];

/// Materials by name: Young's modulus and Poisson's ratio, empty for a rigid body.
const MATERIALS: [(&str, &str); 12] = [
    ("steel", "210 GPa,0.3"),
    ("stainless steel", "193 GPa,0.29"),
    ("titanium alloy", "114 GPa,0.34"),
    ("aluminium alloy", "72 GPa,0.33"),
    ("bronze", "110 GPa,0.34"),
    ("alumina", "380 GPa,0.22"),
    ("silicon nitride", "310 GPa,0.27"),
    ("tungsten carbide", "630 GPa,0.22"),
    ("glass", "70 GPa,0.22"),
    ("PEEK", "3.8 GPa,0.4"),
    ("UHMWPE", "0.8 GPa,0.46"),
    ("rigid", ""),
];

/// A scenario with more cycles than this uses cycle jumps.
const JUMP_FROM: f64 = 1000.0;

/// An answer: as a title names it, and the keys that it sets.
#[derive(Debug, PartialEq)]
pub struct Reply {
    text: String,
    sets: Vec<(String, Value)>,
}

/// Reads the answer to a question; a bare number has the question's unit.
///
/// # Errors
/// The rule that the answer breaks.
pub fn read([option, key, unit, _]: Question, text: &str) -> Result<Reply, String> {
    let text = text.trim();
    let (text, mut sets) = match option {
        "material" | "against" => body(key, text)?,
        "wear" if text == "none" => (text.to_owned(), Vec::new()),
        _ => {
            let (text, value) = quantity(text, key, unit)?;
            let value = match option {
                "stroke" => Value::Float(0.5 * value),
                _ if unit.is_empty() => Value::Float(value),
                _ => Value::String(text.clone()),
            };
            (text, vec![(key.to_owned(), value)])
        }
    };
    let words = WORDS.iter().filter(|(of, ..)| *of == option);
    sets.extend(words.map(|(_, key, word)| ((*key).to_owned(), Value::from(*word))));
    Ok(Reply { text, sets })
}

/// Reads a material, a name of the list or `E,NU` such as `200 GPa,0.3`: its name, and the keys of its table.
fn body(table: &str, text: &str) -> Result<(String, Vec<(String, Value)>), String> {
    let known = MATERIALS
        .iter()
        .find(|(name, _)| name.eq_ignore_ascii_case(text));
    let key = |key: &str| join(table, key);
    if let Some((name, "")) = known {
        return Ok(((*name).to_owned(), vec![(key("rigid"), true.into())]));
    }
    let elastic = known.map_or(text, |(_, elastic)| elastic);
    let Some((modulus, poisson)) = elastic.split_once(',') else {
        let names = MATERIALS.map(|(name, _)| name).join(", ");
        return Err(format!(
            "must be one of {names}, or E,NU such as \"200 GPa,0.3\""
        ));
    };
    let (modulus, _) = quantity(modulus, &key("youngs_modulus"), "GPa")?;
    let (_, poisson) = quantity(poisson, &key("poisson"), "")?;
    let name = known.map_or(format!("E = {modulus}"), |(name, _)| (*name).to_owned());
    let sets = [
        ("youngs_modulus", modulus.into()),
        ("poisson", poisson.into()),
    ];
    Ok((name, sets.map(|(of, value)| (key(of), value)).into()))
}

/// Reads the value of a key: the text with its unit, and the number in SI units. A bare number has the unit `unit`.
fn quantity(text: &str, key: &str, unit: &str) -> Result<(String, f64), String> {
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
        Ok((text, value))
    } else {
        Err(format!("must be {}", known.range))
    }
}

/// The answers so far, by option.
#[derive(Debug, Default)]
pub struct Answers(pub BTreeMap<&'static str, Reply>);

impl Answers {
    /// Makes the scenario.
    ///
    /// # Errors
    /// If the answers together do not make a contact.
    pub fn scenario(&self, origin: &str) -> Result<Scenario, Refusal> {
        Scenario::from_toml(&self.to_toml(), origin, &[])
    }

    /// Returns the scenario as a file, each key with its meaning.
    pub fn to_toml(&self) -> String {
        let answers = self.0.values().flat_map(|answer| &answer.sets);
        let mut sets: BTreeMap<&str, Value> = answers
            .map(|(key, value)| (key.as_str(), value.clone()))
            .collect();
        let cycles = sets.get("run.cycles").and_then(Value::as_float);
        if cycles > Some(JUMP_FROM) && sets.contains_key("wear.coefficient_per_load") {
            sets.insert("numerics.integrator", "cycle-jump".into());
        }
        sets.insert("title", self.title().into());
        write::sections(|known| {
            let value = sets.get(known.path)?;
            let row = format!("{} = {}", known.key(), literal(value));
            let meaning = match value.as_str().and_then(|word| known.meaning_of(word)) {
                _ if known.path == "title" => return Some(row),
                Some(meaning) => meaning.to_owned(),
                None if value.is_float() => known.described(),
                None => known.meaning.to_owned(),
            };
            Some(format!("{row:38} # {meaning}"))
        })
    }

    fn title(&self) -> String {
        let text = |option: &str| self.0.get(option).map_or("", |answer| answer.text.as_str());
        let [of, on, stroke] = ["material", "against", "stroke"].map(text);
        let shapes = ["ball", "punch", "cylinder"].into_iter();
        let shape: String = shapes.filter(|shape| !text(shape).is_empty()).collect();
        format!(
            "{shape} of {of} on {on}, {}{}, stroke {stroke}",
            text("load"),
            text("depth")
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(option: &str, text: &str) -> Result<Reply, String> {
        let found = QUESTIONS.iter().find(|[of, ..]| *of == option);
        read(*found.expect("a question"), text)
    }

    #[test]
    fn every_default_is_an_answer() {
        for question in QUESTIONS {
            read(question, question[3]).expect(question[0]);
        }
    }

    #[test]
    fn materials_are_names_or_two_numbers() {
        for (name, _) in MATERIALS {
            assert_eq!(
                answer("material", name).map(|body| body.text).as_deref(),
                Ok(name)
            );
        }
        for (text, modulus, poisson) in [
            (" 200 GPa , 0.28", "200 GPa", 0.28),
            ("70,0.2", "70 GPa", 0.2),
        ] {
            let body = answer("against", text).expect("two numbers");
            let values = body.sets.into_iter().map(|(_, value)| value);
            assert!(values.eq([Value::from(modulus), Value::from(poisson)]));
        }
        for text in ["stone", "200 GPa", "200 GPa,0.7", "200 mm,0.3", "-1,0.3"] {
            assert!(answer("material", text).is_err(), "{text}");
        }
    }

    #[test]
    fn quantities_are_in_the_unit_that_is_asked_for_unless_they_say() {
        let of = |text: &str| quantity(text, "indenter.radius", "mm");
        assert_eq!(of("10"), Ok(("10 mm".into(), 0.01)));
        assert_eq!(of("200 um"), Ok(("200 um".into(), 2e-4)));
        for (text, rule) in [
            ("0", "greater than 0"),
            ("ten", "in mm"),
            ("1 N", "compatible"),
            ("0,3", "point"),
        ] {
            let refused = of(text).expect_err(text);
            assert!(refused.contains(rule), "{text}: {refused}");
        }
    }
}
