//! Every key a scenario may hold: one table that feeds the checks, the edit form and the docs.

use super::nearest::nearest;

/// What a value looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A finite number.
    Number,
    /// A whole number.
    Whole,
    /// `true` or `false`.
    Flag,
    /// Any text.
    Text,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// A list of finite numbers.
    Numbers,
}

impl Kind {
    /// What must stand there, after "must be".
    pub fn wanted(self) -> String {
        match self {
            Self::Number => "a finite number".into(),
            Self::Whole => "a whole number".into(),
            Self::Flag => "true or false".into(),
            Self::Text => "a text".into(),
            Self::Choice([only]) => format!("\"{only}\""),
            Self::Choice(words) => {
                let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
                format!("one of {}", words.join(", "))
            }
            Self::Numbers => "a list of finite numbers".into(),
        }
    }
}

/// One key of a scenario.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parameter {
    /// The dotted path, as `--set` takes it.
    pub path: &'static str,
    /// The unit, or nothing for a pure number or a word.
    pub unit: &'static str,
    /// What it means, in one line.
    pub meaning: &'static str,
    /// What its value looks like.
    pub kind: Kind,
    /// The values that are allowed, after "must be"; empty where the kind says it all.
    pub range: &'static str,
    /// The indenter shapes that take the key; empty where the shape does not matter.
    pub shapes: &'static [&'static str],
}

impl Parameter {
    /// The table the key stands in: everything before the last dot.
    pub fn section(&self) -> &'static str {
        split(self.path).0
    }

    /// The key within its table: everything after the last dot.
    pub fn key(&self) -> &'static str {
        split(self.path).1
    }

    /// What it means, with the unit.
    pub fn described(&self) -> String {
        let range = match self.kind {
            Kind::Choice(_) => format!(", {}", self.kind.wanted()),
            _ => String::new(),
        };
        match self.unit {
            "" => format!("{}{range}", self.meaning),
            unit => format!("{}, {unit}", self.meaning),
        }
    }

    /// The rule that a value of the wrong kind breaks.
    pub(super) fn rule(&self) -> String {
        let range = match (self.kind, self.range) {
            (_, "") => String::new(),
            (Kind::Number | Kind::Whole, range) => format!(" {range}"),
            (_, range) => format!(", {range}"),
        };
        format!("must be {}{range}", self.kind.wanted())
    }
}

/// Splits a dotted path into its table and its key.
pub(super) fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('.').unwrap_or(("", path))
}

const POSITIVE: &str = "greater than 0";
const NOT_NEGATIVE: &str = "of 0 or greater";

const fn key(
    path: &'static str,
    unit: &'static str,
    kind: Kind,
    meaning: &'static str,
) -> Parameter {
    Parameter {
        path,
        unit,
        meaning,
        kind,
        range: "",
        shapes: &[],
    }
}

const fn number(
    path: &'static str,
    unit: &'static str,
    range: &'static str,
    meaning: &'static str,
) -> Parameter {
    Parameter {
        range,
        ..key(path, unit, Kind::Number, meaning)
    }
}

const fn shape(
    shapes: &'static [&'static str],
    path: &'static str,
    unit: &'static str,
    range: &'static str,
    meaning: &'static str,
) -> Parameter {
    Parameter {
        shapes,
        ..number(path, unit, range, meaning)
    }
}

const fn whole(path: &'static str, range: &'static str, meaning: &'static str) -> Parameter {
    Parameter {
        range,
        ..key(path, "", Kind::Whole, meaning)
    }
}

/// The shapes that `indenter.shape` names.
pub(super) const SHAPES: &[&str] = &["paraboloid", "cone", "power"];
/// The transform methods, as [`AbelMethod`](crate::math::abel::AbelMethod) names them.
const METHODS: &[&str] = &["a", "a+b", "b", "benad"];
const CONTROLS: Kind = Kind::Choice(&["displacement", "force"]);
const PRESCRIBED: &str = "m, or N where control = \"force\"";

/// All keys, in the order in which a scenario is written.
pub const PARAMETERS: &[Parameter] = &[
    key(
        "title",
        "",
        Kind::Text,
        "a short name, shown on screens and in files",
    ),
    key("description", "", Kind::Text, "what the scenario shows"),
    key(
        "indenter.shape",
        "",
        Kind::Choice(SHAPES),
        "shape of the unworn indenter",
    ),
    shape(
        &["paraboloid"],
        "indenter.radius",
        "m",
        POSITIVE,
        "radius of curvature",
    ),
    shape(
        &["cone"],
        "indenter.angle",
        "rad",
        "greater than 0 and less than pi/2",
        "rise of the flank, slope = tan(angle)",
    ),
    shape(
        &["power"],
        "indenter.coefficient",
        "m^(1-exponent)",
        POSITIVE,
        "coefficient of f = coefficient * r^exponent",
    ),
    shape(
        &["power"],
        "indenter.exponent",
        "",
        "from 1 to 20",
        "exponent of f = coefficient * r^exponent",
    ),
    number(
        "material.effective_modulus",
        "Pa",
        POSITIVE,
        "effective modulus E* of the pair",
    ),
    number(
        "material.poisson",
        "",
        "from 0 to 0.5",
        "Poisson's ratio of the elastic body",
    ),
    number(
        "material.indenter.youngs_modulus",
        "Pa",
        POSITIVE,
        "Young's modulus of the indenter",
    ),
    number(
        "material.indenter.poisson",
        "",
        "from 0 to 0.5",
        "Poisson's ratio of the indenter",
    ),
    key(
        "material.indenter.rigid",
        "",
        Kind::Flag,
        "whether the indenter is rigid",
    ),
    number(
        "material.half_space.youngs_modulus",
        "Pa",
        POSITIVE,
        "Young's modulus of the half-space",
    ),
    number(
        "material.half_space.poisson",
        "",
        "from 0 to 0.5",
        "Poisson's ratio of the half-space",
    ),
    key(
        "material.half_space.rigid",
        "",
        Kind::Flag,
        "whether the half-space is rigid",
    ),
    number(
        "friction.coefficient",
        "",
        NOT_NEGATIVE,
        "coefficient of friction",
    ),
    key(
        "motion.normal.control",
        "",
        CONTROLS,
        "what is prescribed in the normal direction",
    ),
    number(
        "motion.normal.mean",
        PRESCRIBED,
        "",
        "depth or normal force around which the motion swings",
    ),
    number(
        "motion.normal.amplitude",
        PRESCRIBED,
        NOT_NEGATIVE,
        "amplitude of the normal motion",
    ),
    number(
        "motion.normal.angular_frequency",
        "rad/s",
        POSITIVE,
        "angular frequency of the normal motion",
    ),
    number(
        "motion.normal.phase",
        "rad",
        "",
        "phase of the normal motion",
    ),
    key(
        "motion.tangential.control",
        "",
        CONTROLS,
        "what is prescribed in the tangential direction",
    ),
    number(
        "motion.tangential.mean",
        PRESCRIBED,
        "",
        "shift or tangential force around which the motion swings",
    ),
    number(
        "motion.tangential.amplitude",
        PRESCRIBED,
        NOT_NEGATIVE,
        "amplitude of the tangential motion",
    ),
    number(
        "motion.tangential.angular_frequency",
        "rad/s",
        POSITIVE,
        "angular frequency of the tangential motion; one period is a cycle",
    ),
    number(
        "motion.tangential.phase",
        "rad",
        "",
        "phase of the tangential motion",
    ),
    key(
        "wear.law",
        "",
        Kind::Choice(&["archard", "power"]),
        "law of wear",
    ),
    number(
        "wear.coefficient",
        "1/Pa",
        NOT_NEGATIVE,
        "wear coefficient k",
    ),
    number(
        "wear.stress_exponent",
        "",
        "from 0.1 to 10",
        "exponent of the stress, used by law = \"power\"",
    ),
    number(
        "wear.slip_rate_exponent",
        "",
        "from 0.1 to 10",
        "exponent of the slip rate, used by law = \"power\"",
    ),
    number(
        "wear.reference_stress",
        "Pa",
        POSITIVE,
        "stress at which the power law wears like archard",
    ),
    number(
        "wear.reference_slip_rate",
        "m/s",
        POSITIVE,
        "slip rate at which the power law wears like archard",
    ),
    key(
        "numerics.method",
        "",
        Kind::Choice(METHODS),
        "transform method",
    ),
    whole(
        "numerics.points",
        "from 4 to 8192",
        "grid cells from r = 0 to the domain's edge",
    ),
    whole(
        "numerics.steps_per_cycle",
        "from 1 to 1000000",
        "time steps in a cycle",
    ),
    number(
        "numerics.domain_radius",
        "m",
        POSITIVE,
        "the domain's edge; default: the largest radius that can touch",
    ),
    key(
        "numerics.grid",
        "",
        Kind::Choice(&["uniform"]),
        "how the nodes are spread",
    ),
    key(
        "numerics.integrator",
        "",
        Kind::Choice(&["direct"]),
        "how time is stepped",
    ),
    number("run.cycles", "cycles", NOT_NEGATIVE, "length of the run"),
    Parameter {
        range: "each 0 or greater",
        ..key(
            "run.snapshot_at",
            "cycles",
            Kind::Numbers,
            "moments at which the state is written",
        )
    },
    number(
        "changes.at_cycle",
        "cycles",
        NOT_NEGATIVE,
        "when a key was changed during the run",
    ),
    key(
        "changes.set",
        "",
        Kind::Text,
        "the key and its new value, as KEY = VALUE",
    ),
];

/// The parameter with this dotted path.
pub fn find(path: &str) -> Option<&'static Parameter> {
    PARAMETERS.iter().find(|parameter| parameter.path == path)
}

/// Whether `path` is a table that holds parameters, directly or in tables of its own.
pub(super) fn is_section(path: &str) -> bool {
    PARAMETERS.iter().any(|parameter| {
        let rest = parameter.path.strip_prefix(path);
        rest.is_some_and(|rest| rest.starts_with('.'))
    })
}

/// What to write instead of the unknown `path`.
pub(super) fn hint(path: &str) -> String {
    let mut known: Vec<&str> = Vec::new();
    for parameter in PARAMETERS {
        let dots = parameter
            .path
            .match_indices('.')
            .map(|(at, _)| &parameter.path[..at]);
        for candidate in dots.chain([parameter.path]) {
            if !known.contains(&candidate) {
                known.push(candidate);
            }
        }
    }
    if let Some(near) = nearest(path, known.iter().copied()) {
        return format!("did you mean {near}?");
    }
    let section = split(path).0;
    let section = if is_section(section) { section } else { "" };
    let keys: Vec<&str> = known
        .into_iter()
        .filter(|key| split(key).0 == section)
        .collect();
    format!("known are {}", keys.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::abel::AbelMethod;
    use crate::math::grid::{MAX_CELLS, MIN_CELLS};

    #[test]
    fn every_key_says_what_it_means_and_stands_once() {
        for (i, parameter) in PARAMETERS.iter().enumerate() {
            assert!(!parameter.meaning.is_empty(), "{}", parameter.path);
            assert!(
                PARAMETERS[..i]
                    .iter()
                    .all(|other| other.path != parameter.path),
                "{} stands twice",
                parameter.path
            );
            assert!(parameter.shapes.iter().all(|shape| SHAPES.contains(shape)));
        }
    }

    #[test]
    fn the_table_says_what_the_floors_below_hold() {
        assert_eq!(AbelMethod::ALL.map(AbelMethod::name), METHODS);
        let points = find("numerics.points").expect("a parameter");
        assert_eq!(points.range, format!("from {MIN_CELLS} to {MAX_CELLS}"));
    }

    #[test]
    fn unknown_keys_are_led_to_the_nearest() {
        for (typed, near) in [
            ("numerics.pointz", "numerics.points"),
            ("points", "numerics.points"),
            ("numerics.steps", "numerics.steps_per_cycle"),
            ("motion.normal.frequency", "motion.normal.angular_frequency"),
            ("frictoin", "friction"),
            ("material.friction", "friction"),
            ("motion.tangental", "motion.tangential"),
            ("indenter.raduis", "indenter.radius"),
            ("youngs_modulus", "material.indenter.youngs_modulus"),
        ] {
            assert_eq!(hint(typed), format!("did you mean {near}?"), "{typed}");
        }
        assert!(hint("wear.k").starts_with("known are wear.law, wear.coefficient"));
        assert!(hint("zzz").starts_with("known are title, description, indenter"));
    }
}
