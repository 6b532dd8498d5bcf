//! The table of all scenario keys: name in the code, type, unit, range, default, meaning and
//! effect.

use super::schema::Default::{Derived, Implied, Written};
use super::schema::Range::{Acute, Any, NotNegative, Positive, UpTo, Within};
use super::schema::{Key, Parameter, choice, count, flag, quantities, quantity, text};
use crate::math::abel::AbelMethod;
use crate::math::grid::{MAX_CELLS, MIN_CELLS};
use crate::simulation::{Integrator, Scheme, Spacing, Stability};

/// Makes a constant of each key, and the list of all, those of the groups that are named in brackets among them.
macro_rules! keys {
    ($({ $($name:ident: $type:ty = $key:expr;)* } $([$($of:ident.$field:ident)*])?)*) => {
        $($(pub(super) const $name: Key<$type> = $key;)*)*

        /// All keys, in the order in which a scenario is written.
        pub const PARAMETERS: &[Parameter] = &[$($($name.parameter,)* $($($of.$field.parameter,)*)?)*];
    };
}

/// The keys of one direction of the motion.
pub(super) struct Motion {
    pub section: &'static str,
    pub control: Key<String>,
    pub mean: Key<f64>,
    pub amplitude: Key<f64>,
    pub frequency: Key<f64>,
    pub hertz: Key<f64>,
    pub phase: Key<f64>,
    pub waveform: Key<String>,
    pub hold: Key<f64>,
    pub file: Key<String>,
    pub times: Key<Vec<f64>>,
    pub values: Key<Vec<f64>>,
}

/// The keys of a direction, with what is said of it alone.
macro_rules! motion {
    (
        $way:literal beside $other:literal: control $control:literal,
        mean $mean:literal $mean_effect:literal $(default $default:literal)?, amplitude $amplitude:literal,
        frequency $cycle:literal $frequency:literal, phase $phase:literal
    ) => {
        Motion {
            section: concat!("motion.", $way),
            control: choice(concat!("motion.", $way, ".control"), CONTROLS,
                    concat!("what is prescribed in the ", $way, " direction"))
                .default(Written("\"displacement\""))
                .effect($control),
            mean: quantity(concat!("motion.", $way, ".mean"), PRESCRIBED, Any, $mean)
                $(.default(Implied($default)))?
                .effect($mean_effect),
            amplitude: quantity(concat!("motion.", $way, ".amplitude"), PRESCRIBED, NotNegative,
                    concat!("amplitude of the ", $way, " motion"))
                .default(Implied("0.0"))
                .effect($amplitude),
            frequency: quantity(concat!("motion.", $way, ".angular_frequency"), "rad/s", Positive,
                    concat!("angular frequency of the ", $way, " motion", $cycle))
                .default(Derived(concat!("that of the ", $other, " motion if the amplitude is 0")))
                .effect($frequency),
            hertz: quantity(concat!("motion.", $way, ".frequency"), "Hz", Positive,
                    concat!("frequency of the ", $way, " motion, instead of angular_frequency", $cycle))
                .effect($frequency),
            phase: quantity(concat!("motion.", $way, ".phase"), "rad", Any, concat!("phase of the ", $way, " motion"))
                .default(Implied("0.0"))
                .effect($phase),
            waveform: choice(concat!("motion.", $way, ".waveform"), WAVEFORMS,
                    concat!("waveform of the ", $way, " motion"))
                .default(Implied("\"sine\""))
                .effect("at constant depth only the turning points count"),
            hold: quantity(concat!("motion.", $way, ".hold"), "", UpTo(0.99),
                    "fraction of a period spent at rest, for waveform = \"trapezoid\"")
                .effect("raising it: longer rests, faster strokes"),
            file: text(concat!("motion.", $way, ".file"),
                    "CSV file of waveform = \"table\": one period, columns time_s and u_m, or F_N, or value")
                .effect("another table of one period"),
            times: quantities(concat!("motion.", $way, ".times"), "s", Any,
                    concat!("times of the table, as read from motion.", $way, ".file"))
                .effect("the times of the table"),
            values: quantities(concat!("motion.", $way, ".values"), PRESCRIBED, Any,
                    concat!("values of the table, as read from motion.", $way, ".file"))
                .effect("the values of the table"),
        }
    };
}

pub(super) const NORMAL: Motion = motion!(
    "normal" beside "tangential": control "displacement: wear unloads the contact; force: it sinks in",
    mean "mean depth or mean normal force" "raising it: a wider contact, a wider stick zone",
    amplitude "raising it: the edge of the contact opens and closes further",
    frequency "" "a different ratio to the tangential one: a different loop",
    phase "when the contact is deepest, relative to the tangential motion"
);

pub(super) const TANGENTIAL: Motion = motion!(
    "tangential" beside "normal": control "displacement or force oscillates",
    mean "mean displacement or mean tangential force" "where the motion is centred; forgotten after a cycle"
        default "0.0",
    amplitude "raising it: a wider slip ring, then gross slip",
    frequency "; one period is a cycle" "one period is a cycle; matters for powers of the slip rate",
    phase "when the shift is largest, relative to the depth"
);

/// The keys of a coefficient that runs in, but for that which it begins with.
pub(super) struct RunsIn {
    pub section: &'static str,
    pub settled: Key<f64>,
    pub cycles: Key<f64>,
    pub energy: Key<f64>,
    pub file: Key<String>,
    pub at_cycle: Key<Vec<f64>>,
    pub at_energy: Key<Vec<f64>>,
    pub values: Key<Vec<f64>>,
}

impl RunsIn {
    /// The keys of an exponential course.
    fn exponential(&self) -> [&'static str; 3] {
        [&self.settled, &self.cycles, &self.energy].map(Key::path)
    }
}

/// The keys of a coefficient in a unit, with what is said of it alone.
macro_rules! runs_in {
    (
        $of:literal $unit:literal: settled $settled:literal $settled_effect:literal, later $later:literal,
        file $file:literal $file_effect:literal, values $values:literal
    ) => {
        RunsIn {
            section: $of,
            settled: quantity(concat!($of, ".settled"), $unit, NotNegative, $settled)
                .effect($settled_effect),
            cycles: quantity(
                concat!($of, ".running_in_cycles"),
                "cycles",
                Positive,
                "cycles in which the distance to settled falls by a factor e",
            )
            .effect($later),
            energy: quantity(
                concat!($of, ".running_in_energy"),
                "J",
                Positive,
                "friction work in which the distance to settled falls by a factor e",
            )
            .effect($later),
            file: text(concat!($of, ".file"), $file).effect($file_effect),
            at_cycle: quantities(
                concat!($of, ".at_cycle"),
                "cycles",
                NotNegative,
                concat!("cycles of the table, as read from ", $of, ".file"),
            )
            .effect("the cycles of the course"),
            at_energy: quantities(
                concat!($of, ".at_energy"),
                "J",
                NotNegative,
                concat!("energies of the table, as read from ", $of, ".file"),
            )
            .effect("the energies of the course"),
            values: quantities(
                concat!($of, ".values"),
                $unit,
                NotNegative,
                concat!($values, " of the table, as read from ", $of, ".file"),
            )
            .effect("the coefficients of the course"),
        }
    };
}

pub(super) const FRICTION_COURSE: RunsIn = runs_in!(
    "friction" "": settled "coefficient of friction after running in" "friction after running in",
    later "raising it: friction settles later",
    file "CSV file with columns coefficient and cycle or energy_J, instead of coefficient"
        "another course of the friction coefficient",
    values "coefficients"
);

pub(super) const WEAR_COURSE: RunsIn = runs_in!(
    "wear" "1/Pa": settled "wear coefficient per friction work after running in"
        "the wear coefficient after running in",
    later "raising it: the wear coefficient settles later",
    file "CSV file with columns coefficient (1/Pa) and cycle or energy_J, instead of coefficient"
        "another course of the wear coefficient",
    values "wear coefficients"
);

/// The shapes that `indenter.shape` names.
pub(super) const SHAPES: &[&str] = &[
    "paraboloid",
    "cone",
    "power",
    "flat-punch",
    "truncated-paraboloid",
    "truncated-cone",
    "rounded-punch",
    "table",
];
const CONTROLS: &[&str] = &["displacement", "force"];
/// The waveforms, as [`Waveform`](crate::simulation::waveform::Waveform) names it.
const WAVEFORMS: &[&str] = &["sine", "triangle", "trapezoid", "table"];
const LAWS: &[&str] = &["archard", "power"];

/// The unit of what a motion prescribes.
pub const PRESCRIBED: &str = "m, or N if control = \"force\"";

/// The keys chosen by `numerics.accuracy`.
pub(super) const CHOSEN_BY_ACCURACY: [&str; 4] = [
    POINTS.path(),
    STEPS_PER_CYCLE.path(),
    TOLERANCE.path(),
    NODES.path(),
];

/// Keys that exclude each other: each of the first, each of the others.
pub(super) struct Exclusive {
    pub keys: Vec<&'static str>,
    pub others: Vec<&'static str>,
    /// What one of the keys conflicts with, `{}` for the one of the others, and what would be right.
    pub rule: &'static str,
    /// Whether they stand for the same thing, so that an assignment to one takes the place of the others.
    pub are_twins: bool,
}

/// Keys for different ways to say something, of which a scenario takes one.
fn rivals(keys: &[&'static str], others: &[&'static str], rule: &'static str) -> Exclusive {
    Exclusive {
        keys: keys.to_vec(),
        others: others.to_vec(),
        rule,
        are_twins: false,
    }
}

/// Keys for the same thing.
fn twins(keys: &[&'static str], others: &[&'static str], rule: &'static str) -> Exclusive {
    Exclusive {
        are_twins: true,
        ..rivals(keys, others, rule)
    }
}

/// Every kind of value that a scenario can give in one of several ways.
pub(super) fn exclusive() -> Vec<Exclusive> {
    const EITHER: &str = "{}; give one of them";
    const OF_LOAD: &str = "{}, which is per friction work; give one of them";
    const BODIES: [&str; 2] = ["material.indenter", "material.half_space"];
    let accuracy = "{}, which it chooses; give one of them";
    let pair = "two bodies; give either effective_modulus and poisson, or [material.indenter] and \
                [material.half_space]";
    let hardness = "two bodies; give material.indenter.hardness or material.half_space.hardness";
    let per_load = [WEAR_PER_LOAD.path()];
    let mut all = vec![
        twins(&[ACCURACY.path()], &CHOSEN_BY_ACCURACY, accuracy),
        twins(&per_load, &[WEAR_COEFFICIENT.path()], OF_LOAD),
        rivals(&per_load, &WEAR_COURSE.exponential(), OF_LOAD),
        rivals(&per_load, &[WEAR_COURSE.values.path()], OF_LOAD),
        rivals(&[EFFECTIVE_MODULUS.path(), POISSON.path()], &BODIES, pair),
        rivals(&[HARDNESS.path()], &BODIES, hardness),
    ];
    for motion in [NORMAL, TANGENTIAL] {
        let (hertz, angular) = (motion.hertz.path(), motion.frequency.path());
        all.push(twins(&[hertz], &[angular], EITHER));
    }
    for course in [FRICTION_COURSE, WEAR_COURSE] {
        let exponential = course.exponential();
        let table = [course.at_energy.path(), course.at_cycle.path()];
        let rule = "a table of values; give one of them";
        all.push(rivals(&exponential, &table, rule));
        all.push(rivals(&exponential[2..], &exponential[1..2], EITHER));
        all.push(rivals(&table[..1], &table[1..], EITHER));
    }
    all
}

keys! {
    {
    TITLE: String = text("title", "a short name, shown on screens and in files");
    DESCRIPTION: String = text("description", "what the scenario shows");

    SHAPE: String = choice("indenter.shape", SHAPES, "shape of the unworn indenter")
        .effect("where pressure concentrates: a rim, a tip, or the middle");
    RADIUS: f64 = quantity("indenter.radius", "m", Positive,
            "radius of curvature, of the flat punch, or of a punch's rounded edge")
        .of_shapes(&["paraboloid", "flat-punch", "truncated-paraboloid", "rounded-punch"])
        .effect("raising it: a wider contact and less pressure at the same depth");
    ANGLE: f64 = quantity("indenter.angle", "rad", Acute, "rise of the flank, slope = tan(angle)")
        .of_shapes(&["cone", "truncated-cone"])
        .effect("raising it: a sharper tip, a smaller contact, more pressure");
    TIP_RADIUS: f64 = quantity("indenter.tip_radius", "m", Positive, "radius of the flat tip")
        .of_shapes(&["truncated-paraboloid", "truncated-cone", "rounded-punch"])
        .effect("raising it: the contact begins wider, its rim carries more");
    SHAPE_COEFFICIENT: f64 = quantity("indenter.coefficient", "m^(1-exponent)", Positive,
            "coefficient of f = coefficient * r^exponent")
        .of_shapes(&["power"])
        .effect("raising it: a steeper profile, a smaller contact");
    SHAPE_EXPONENT: f64 = quantity("indenter.exponent", "", Within(1.0, 20.0),
            "exponent of f = coefficient * r^exponent")
        .of_shapes(&["power"])
        .effect("raising it: flatter in the middle, steeper outside");
    TABLE_FILE: String = text("indenter.file",
            "CSV file with columns r_m and f_m, relative to the scenario's file")
        .of_shapes(&["table"])
        .effect("another measured profile");
    SMOOTHING: f64 = quantity("indenter.smoothing", "m", NotNegative,
            "length over which noise of the table is smoothed")
        .of_shapes(&["table"])
        .default(Implied("0.0"))
        .effect("raising it: less noise of the table, rounder edges");
    RADII: Vec<f64> = quantities("indenter.radii", "m", Any,
            "radii of the table, as read from indenter.file")
        .of_shapes(&["table"])
        .effect("the radii of the measured profile");
    HEIGHTS: Vec<f64> = quantities("indenter.heights", "m", Any,
            "heights f of the table, as read from indenter.file")
        .of_shapes(&["table"])
        .effect("the heights of the measured profile");

    EFFECTIVE_MODULUS: f64 = quantity("material.effective_modulus", "Pa", Positive,
            "effective modulus E* of the pair")
        .effect("raising it: more pressure and force at the same depth");
    POISSON: f64 = quantity("material.poisson", "", Within(0.0, 0.5), "Poisson's ratio of the elastic body")
        .effect("raising it: tangentially softer, so a wider stick zone");
    HARDNESS: f64 = quantity("material.hardness", "Pa", Positive,
            "hardness of the softer body: the pressure beyond which a warning is given")
        .effect("lowering it: the warning that the material yields comes earlier");
    FATIGUE_LIMIT: f64 = quantity("material.fatigue_limit", "Pa", Positive,
            "fully reversed fatigue limit of the half-space in tension or bending")
        .effect("lowering it: cracks are expected sooner");
    SHEAR_FATIGUE_LIMIT: f64 = quantity("material.shear_fatigue_limit", "Pa", Positive,
            "fully reversed fatigue limit of the half-space in torsion")
        .effect("lowering it: cracks are expected sooner");
    INDENTER_MODULUS: f64 = quantity("material.indenter.youngs_modulus", "Pa", Positive,
            "Young's modulus of the indenter")
        .effect("raising it: a stiffer pair");
    INDENTER_POISSON: f64 = quantity("material.indenter.poisson", "", Within(0.0, 0.5),
            "Poisson's ratio of the indenter")
        .effect("raising it: tangentially softer, so a wider stick zone");
    INDENTER_HARDNESS: f64 = quantity("material.indenter.hardness", "Pa", Positive,
            "hardness of the indenter: the pressure beyond which a warning is given")
        .effect("lowering it: the warning that the material yields comes earlier");
    INDENTER_RIGID: bool = flag("material.indenter.rigid", "whether the indenter is rigid")
        .default(Implied("false"))
        .effect("rigid: only the half-space yields");
    HALF_SPACE_MODULUS: f64 = quantity("material.half_space.youngs_modulus", "Pa", Positive,
            "Young's modulus of the half-space")
        .effect("raising it: a stiffer pair");
    HALF_SPACE_POISSON: f64 = quantity("material.half_space.poisson", "", Within(0.0, 0.5),
            "Poisson's ratio of the half-space")
        .effect("raising it: tangentially softer, so a wider stick zone");
    HALF_SPACE_HARDNESS: f64 = quantity("material.half_space.hardness", "Pa", Positive,
            "hardness of the half-space: the pressure beyond which a warning is given")
        .effect("lowering it: the warning that the material yields comes earlier");
    HALF_SPACE_RIGID: bool = flag("material.half_space.rigid", "whether the half-space is rigid")
        .default(Implied("false"))
        .effect("rigid: only the indenter yields");

    FRICTION: f64 = quantity("friction.coefficient", "", NotNegative, "coefficient of friction")
        .effect("raising it: a wider stick zone, higher shear where it slips");

    }
    [
        FRICTION_COURSE.settled FRICTION_COURSE.cycles FRICTION_COURSE.energy FRICTION_COURSE.file
        FRICTION_COURSE.at_cycle FRICTION_COURSE.at_energy FRICTION_COURSE.values
        NORMAL.control NORMAL.mean NORMAL.amplitude NORMAL.frequency NORMAL.hertz NORMAL.phase NORMAL.waveform
        NORMAL.hold NORMAL.file NORMAL.times NORMAL.values
        TANGENTIAL.control TANGENTIAL.mean TANGENTIAL.amplitude TANGENTIAL.frequency TANGENTIAL.hertz TANGENTIAL.phase
    ]
    {
    RIG_STIFFNESS: f64 = quantity("motion.tangential.rig_stiffness", "N/m", Positive,
            "stiffness of the rig in series with the contact: the motion is then that of the \
             actuator")
        .default(Derived("infinite: the contact gets the whole motion"))
        .effect("raising it: the contact gets more of the actuator's motion");
    }
    [TANGENTIAL.waveform TANGENTIAL.hold TANGENTIAL.file TANGENTIAL.times TANGENTIAL.values]
    {
    LAW: String = choice("wear.law", LAWS, "law of wear")
        .default(Written("\"archard\""))
        .effect("archard: by friction work; power: by powers of stress and slip rate");
    WEAR_COEFFICIENT: f64 = quantity("wear.coefficient", "1/Pa", NotNegative,
            "wear coefficient k per friction work: V = k E_d")
        .effect("raising it: the same wear in fewer cycles, until steps are too coarse");
    WEAR_PER_LOAD: f64 = quantity("wear.coefficient_per_load", "m^3/(N*m)", NotNegative,
            "Archard's, of a pin test: volume per load and sliding distance, instead of coefficient")
        .effect("as coefficient: k = coefficient_per_load / friction, of each moment");
    }
    [WEAR_COURSE.settled WEAR_COURSE.cycles WEAR_COURSE.energy]
    {
    WEAR_THRESHOLD: f64 = quantity("wear.threshold_energy", "J", NotNegative,
            "friction work below which nothing wears: V = k (E_d - threshold)")
        .default(Implied("0.0"))
        .effect("raising it: wear begins later");
    }
    [WEAR_COURSE.file WEAR_COURSE.at_cycle WEAR_COURSE.at_energy WEAR_COURSE.values]
    {
    WEAR_INITIAL: String = text("wear.initial",
            "CSV file of the scar that the run begins with: columns r_m and depth_m, or wear_m as in state.csv")
        .effect("another scar to begin with; fixed during a run");
    WEAR_INITIAL_RADII: Vec<f64> = quantities("wear.initial_radii", "m", NotNegative,
            "radii of the scar, as read from wear.initial")
        .effect("the radii of the scar; fixed during a run");
    WEAR_INITIAL_DEPTHS: Vec<f64> = quantities("wear.initial_depths", "m", NotNegative,
            "worn depths of the scar, as read from wear.initial")
        .effect("the depths of the scar; fixed during a run");
    WEAR_SHARE: f64 = quantity("wear.share", "", Within(0.0, 1.0),
            "share of the wear that the indenter takes, the rest is the half-space's")
        .default(Derived("1, and nothing is said of the half-space"))
        .effect("raising it: the indenter wears, not the half-space; fixed during a run");
    STRESS_EXPONENT: f64 = quantity("wear.stress_exponent", "", Within(0.1, 10.0),
            "exponent of the stress, used by law = \"power\"")
        .default(Implied("1.5"))
        .effect("raising it: wear gathers where the stress is high");
    SLIP_RATE_EXPONENT: f64 = quantity("wear.slip_rate_exponent", "", Within(0.1, 10.0),
            "exponent of the slip rate, used by law = \"power\"")
        .default(Implied("1.0"))
        .effect("raising it: wear gathers where slip is fast");
    REFERENCE_STRESS: f64 = quantity("wear.reference_stress", "Pa", Positive,
            "stress at which the power law wears like archard")
        .default(Derived("friction coefficient times the mean pressure of the unworn contact"))
        .effect("raising it: less wear if the stress exponent is above 1");
    REFERENCE_SLIP_RATE: f64 = quantity("wear.reference_slip_rate", "m/s", Positive,
            "slip rate at which the power law wears like archard")
        .default(Derived("the largest tangential velocity"))
        .effect("raising it: less wear if the slip-rate exponent is above 1");

    ACCURACY: f64 = quantity("numerics.accuracy", "", Within(1e-5, 0.1),
            "largest error of the worn depth (rms over the scar, relative to its largest value) and of the volume: \
             chooses points, steps and jumps")
        .default(Derived("1e-2 with wear, unless points, steps_per_cycle, tolerance or nodes are given"))
        .effect("lowering it: finer and slower; chooses points, steps, jumps");
    METHOD: AbelMethod = choice("numerics.method", AbelMethod::NAMES, "transform method")
        .default(Written("\"product\""))
        .effect("how the three transforms are computed");
    POINTS: u32 = count("numerics.points", Within(MIN_CELLS as f64, MAX_CELLS as f64),
            "grid cells from r = 0 to the domain's edge")
        .default(Written("100"))
        .effect("raising it: finer and slower");
    STEPS_PER_CYCLE: u32 = count("numerics.steps_per_cycle", Within(1.0, 1e6), "time steps per period of the faster motion")
        .default(Written("100"))
        .effect("raising it: finer in time and slower");
    DOMAIN_RADIUS: f64 = quantity("numerics.domain_radius", "m", Positive,
            "outer radius of the computed domain; it grows when the contact reaches it")
        .default(Derived("the largest radius that can touch"))
        .effect("raising it: room to grow, coarser at the same number of points");
    GRID: Spacing = choice("numerics.grid", Spacing::NAMES,
            "spacing of the nodes; the default depends on the method")
        .default(Derived("graded with method = \"product\", else uniform"))
        .effect("graded: narrow cells where the worn profile is steep");
    NODES: Vec<f64> = quantities("numerics.nodes", "m", NotNegative,
            "nodes of the grid, from 0 to the domain's edge, as numerics.accuracy placed them by a coarser run")
        .effect("other cells; numerics.points or numerics.grid takes their place");
    SCHEME: Scheme = choice("numerics.scheme", Scheme::NAMES,
            "time-stepping scheme; the default depends on the method")
        .default(Derived("trapezoid with method = \"product\", else euler"))
        .effect("trapezoid: second order in time; euler: the paper's");
    STABILITY: Stability = choice("numerics.stability", Stability::NAMES,
            "whether steps too stiff for the method are split or taken as they are")
        .default(Written("\"sub-step\""))
        .effect("sub-step: splits stiff steps; off: the raw method");
    INTEGRATOR: String = choice("numerics.integrator", &Integrator::NAMES,
            "every step of every cycle, or jumps over many similar cycles")
        .default(Written("\"direct\""))
        .effect("direct: every step; cycle-jump: over similar cycles");
    TOLERANCE: f64 = quantity("numerics.tolerance", "", UpTo(0.1),
            "error that cycle jumps aim at, relative to the largest depth")
        .default(Implied("2e-4"))
        .effect("raising it: longer jumps over cycles, less accurate");

    CYCLES: f64 = quantity("run.cycles", "cycles", NotNegative, "length of the run");
    SNAPSHOT_AT: Vec<f64> = quantities("run.snapshot_at", "cycles", NotNegative,
            "cycles at which the state is written")
        .default(Implied("[]"));
    SHORTENED_AT: Vec<f64> = quantities("run.shortened_at", "cycles", NotNegative,
            "cycles at which a step was cut short although the run continued (written by the \
             program)")
        .default(Implied("[]"));
    NOTE: String = text("run.note", "a note written into the files");
    STATED: String = text("run.stated",
        "errors that the recorded run stated, for a replay to state again; an edit of the scenario ends that (written by \
         the program)");

    AT_CYCLE: f64 = quantity("changes.at_cycle", "cycles", NotNegative,
        "when a key was changed during the run");
    SET: String = text("changes.set", "the key and its new value, as KEY = VALUE");
    }
}
