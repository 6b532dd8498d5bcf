//! The answers to `mdr-tui new`, and the commented scenario made from them.

use toml::Value;

use crate::scenario::schema::{self, Kind};
use crate::scenario::{Scenario, ScenarioError, units};

/// A scenario with more cycles than this jumps over those that are alike.
const JUMP_FROM: f64 = 1000.0;

/// A material of the short list: name, Young's modulus, Poisson's ratio.
pub const MATERIALS: [(&str, &str, f64); 12] = [
    ("steel", "210 GPa", 0.3),
    ("stainless steel", "193 GPa", 0.29),
    ("titanium alloy", "114 GPa", 0.34),
    ("aluminium alloy", "72 GPa", 0.33),
    ("bronze", "110 GPa", 0.34),
    ("alumina", "380 GPa", 0.22),
    ("silicon nitride", "310 GPa", 0.27),
    ("tungsten carbide", "630 GPa", 0.22),
    ("glass", "70 GPa", 0.22),
    ("PEEK", "3.8 GPa", 0.4),
    ("UHMWPE", "0.8 GPa", 0.46),
    (RIGID, "", 0.0),
];

/// The body that does not yield.
const RIGID: &str = "rigid";

/// One of the two bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    name: String,
    /// Young's modulus with its unit, and Poisson's ratio; none if it is rigid.
    elastic: Option<(String, f64)>,
}

impl Body {
    /// Reads a name of the list, or `E,NU` such as `200 GPa,0.3`.
    ///
    /// # Errors
    /// What would be right.
    pub fn read(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let mut materials = MATERIALS.iter();
        let known = materials.find(|(name, ..)| name.eq_ignore_ascii_case(text));
        if let Some(&(name, modulus, poisson)) = known {
            return Ok(Self {
                name: name.to_owned(),
                elastic: (name != RIGID).then(|| (modulus.to_owned(), poisson)),
            });
        }
        let Some((modulus, poisson)) = text.split_once(',') else {
            let names = MATERIALS.map(|(name, ..)| name).join(", ");
            return Err(format!(
                "must be one of {names}, or E,NU such as \"200 GPa,0.3\""
            ));
        };
        let modulus = quantity(modulus, "material.indenter.youngs_modulus", "GPa", false)?;
        let poisson = quantity(poisson, "material.indenter.poisson", "", false)?;
        Ok(Self {
            name: format!("E = {}", modulus.text),
            elastic: Some((modulus.text, poisson.value)),
        })
    }
}

/// A number with its unit, as typed, and in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// As written in the scenario.
    pub text: String,
    /// In the unit of its key.
    pub value: f64,
}

/// Reads a value of a key; a bare number is in `unit`.
///
/// # Errors
/// The rule that it breaks.
pub fn quantity(text: &str, key: &str, unit: &str, is_force: bool) -> Result<Quantity, String> {
    let text = text.trim();
    let known = schema::find(key).filter(|known| known.kind == Kind::Number);
    let known = known.ok_or_else(|| format!("{key} is no number"))?;
    let text = match text.parse::<f64>() {
        Ok(_) => format!("{text} {unit}").trim_end().to_owned(),
        Err(_) => text.to_owned(),
    };
    let value = match units::quantity(&text, known, is_force) {
        Some(value) => value?,
        None => text
            .parse::<f64>()
            .ok()
            .filter(|value| value.is_finite())
            .ok_or_else(|| match unit {
                "" => "must be a number".to_owned(),
                unit => format!("must be a number, in {unit} or with its unit"),
            })?,
    };
    match known.range.holds(value) {
        true => Ok(Quantity { text, value }),
        false => Err(format!("must be {}", known.range)),
    }
}

/// All answers.
#[derive(Debug, Clone, PartialEq)]
pub struct Answers {
    /// Whether the indenter is a flat disc, and else a ball near its pole.
    pub is_punch: bool,
    /// Its radius.
    pub radius: Quantity,
    /// The indenter's material.
    pub indenter: Body,
    /// The half-space's.
    pub half_space: Body,
    /// Whether a depth is held, and else a load.
    pub holds_depth: bool,
    /// Load or depth.
    pub press: Quantity,
    /// From turning point to turning point.
    pub stroke: Quantity,
    /// Cycles per second.
    pub frequency: Quantity,
    /// The coefficient of friction.
    pub friction: Quantity,
    /// Archard's k of a pin test; none: no wear.
    pub wear: Option<Quantity>,
    /// The length of the test.
    pub cycles: Quantity,
}

impl Answers {
    /// The scenario of the answers.
    ///
    /// # Errors
    /// Answers that make no contact together.
    pub fn scenario(&self, origin: &str) -> Result<Scenario, ScenarioError> {
        Scenario::from_toml(&self.to_toml(), origin, &[])
    }

    /// The scenario as a commented file.
    pub fn to_toml(&self) -> String {
        let quoted = |text: &str| Value::from(text).to_string();
        let (name, shape, of_what) = match self.is_punch {
            false => ("Ball", "paraboloid", "of the ball"),
            true => ("Flat punch", "flat-punch", "of the flat face"),
        };
        let (control, meaning) = match self.holds_depth {
            false => (
                "force",
                "the load is held: the contact sinks in as it wears",
            ),
            true => (
                "displacement",
                "the depth is held: wear unloads the contact",
            ),
        };
        let (press, stroke) = (&self.press.text, &self.stroke.text);
        let half = format!("{:e}", self.stroke.value / 2.0);
        let keys = "mdr-tui guide scenarios lists all shapes and keys";
        // Section, key, value, and what it means.
        let mut rows = vec![
            ("indenter", "shape", quoted(shape), keys.to_owned()),
            (
                "indenter",
                "radius",
                quoted(&self.radius.text),
                of_what.into(),
            ),
        ];
        for (section, body) in [
            ("material.indenter", &self.indenter),
            ("material.half_space", &self.half_space),
        ] {
            match &body.elastic {
                None => rows.push((section, "rigid", "true".into(), String::new())),
                Some((modulus, poisson)) => rows.extend([
                    (
                        section,
                        "youngs_modulus",
                        quoted(modulus),
                        body.name.clone(),
                    ),
                    (section, "poisson", poisson.to_string(), String::new()),
                ]),
            }
        }
        let friction = self.friction.text.clone();
        let frequency = quoted(&self.frequency.text);
        let half_stroke = format!("m: half the stroke of {stroke}");
        let tangential = "motion.tangential";
        rows.extend([
            ("friction", "coefficient", friction, String::new()),
            ("motion.normal", "control", quoted(control), meaning.into()),
            ("motion.normal", "mean", quoted(press), String::new()),
            (tangential, "amplitude", half, half_stroke),
            (
                tangential,
                "frequency",
                frequency,
                "one period is a cycle".into(),
            ),
        ]);
        if let Some(wear) = &self.wear {
            let note = "of a pin test: per load and sliding distance".to_owned();
            rows.push(("wear", "coefficient_per_load", quoted(&wear.text), note));
            if self.cycles.value > JUMP_FROM {
                let note = "jumps over cycles that are alike; \"direct\": every step".to_owned();
                rows.push(("numerics", "integrator", quoted("cycle-jump"), note));
            }
        }
        let cycles = format!("{:?}", self.cycles.value);
        rows.push(("run", "cycles", cycles, String::new()));
        let (of, on) = (&self.indenter.name, &self.half_space.name);
        let title = quoted(&format!("{name} of {of} on {on}, {press}, stroke {stroke}"));
        let (mut text, mut open) = (format!("title = {title}\n"), "");
        for (section, key, value, note) in rows {
            if section != open {
                text += &format!("\n[{section}]\n");
                open = section;
            }
            let row = format!("{key} = {value}");
            text += &match note.is_empty() {
                true => row + "\n",
                false => format!("{row:38} # {note}\n"),
            };
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn materials_are_names_or_two_numbers() {
        for (name, ..) in MATERIALS {
            assert_eq!(Body::read(name).expect("a material").name, *name);
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
        let of = |text: &str| quantity(text, "indenter.radius", "mm", false);
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
