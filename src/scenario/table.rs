//! Every key a scenario may hold, with its unit, its meaning and its range.

use super::parameters::{Kind, Parameter};
use crate::simulation::Integrator;

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
pub(super) const SHAPES: &[&str] = &[
    "paraboloid",
    "cone",
    "power",
    "flat-punch",
    "truncated-paraboloid",
    "truncated-cone",
];
/// The transform methods, as [`AbelMethod`](crate::math::abel::AbelMethod) names them.
pub(super) const METHODS: &[&str] = &["product", "a", "a+b", "b", "benad"];
/// Where the nodes lie, as [`Spacing`](crate::simulation::Spacing) names it.
pub(super) const SPACINGS: &[&str] = &["graded", "uniform"];
/// How a step is taken, as [`Scheme`](crate::simulation::Scheme) names it.
pub(super) const SCHEMES: &[&str] = &["trapezoid", "euler"];
/// What is done about harsh steps, as [`Stability`](crate::simulation::Stability) names it.
pub(super) const STABILITIES: &[&str] = &["sub-step", "off"];
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
        &["paraboloid", "flat-punch", "truncated-paraboloid"],
        "indenter.radius",
        "m",
        POSITIVE,
        "radius of curvature, or of the flat punch",
    ),
    shape(
        &["cone", "truncated-cone"],
        "indenter.angle",
        "rad",
        "greater than 0 and less than pi/2",
        "rise of the flank, slope = tan(angle)",
    ),
    shape(
        &["truncated-paraboloid", "truncated-cone"],
        "indenter.tip_radius",
        "m",
        POSITIVE,
        "radius of the flat tip",
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
    Parameter {
        range: "from 1e-5 to 0.1",
        ..number(
            "numerics.accuracy",
            "",
            POSITIVE,
            "error of the worn profile, in largest depths: chooses method, points, steps and jumps",
        )
    },
    key(
        "numerics.method",
        "",
        Kind::Choice(METHODS),
        "transform method",
    ),
    whole(
        "numerics.points",
        "from 4 to 100000",
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
        Kind::Choice(SPACINGS),
        "where the nodes lie; the default follows the method",
    ),
    key(
        "numerics.scheme",
        "",
        Kind::Choice(SCHEMES),
        "how a time step is taken; the default follows the method",
    ),
    key(
        "numerics.stability",
        "",
        Kind::Choice(STABILITIES),
        "whether steps too harsh for the method are taken in parts, or as they are",
    ),
    key(
        "numerics.integrator",
        "",
        Kind::Choice(&Integrator::NAMES),
        "every step of every cycle, or jumps over many cycles that are alike",
    ),
    Parameter {
        range: "greater than 0, at most 0.1",
        ..number(
            "numerics.tolerance",
            "",
            POSITIVE,
            "error that cycle jumps aim at, in units of the largest depth; default 2e-4",
        )
    },
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
        "run.planned",
        "cycles",
        NOT_NEGATIVE,
        "length that an accuracy has chosen by, where the run ended elsewhere",
    ),
    key(
        "run.note",
        "",
        Kind::Text,
        "a remark that is kept with the files",
    ),
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
