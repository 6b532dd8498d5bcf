//! The table of all scenario keys: name in the code, type, unit, range, default, meaning and
//! effect.

use super::schema::Default::{Derived, Implied, Written};
use super::schema::Range::{Acute, Any, NotNegative, Positive, UpTo, Within};
use super::schema::{Key, Parameter, choice, count, flag, quantities, quantity, text};
use crate::math::abel::AbelMethod;
use crate::math::grid::{MAX_CELLS, MIN_CELLS};
use crate::simulation::{Integrator, Scheme, Spacing, Stability};

/// Makes a constant of each key, and the list of all.
macro_rules! keys {
    ($($name:ident: $type:ty = $key:expr;)*) => {
        $(pub(super) const $name: Key<$type> = $key;)*

        /// All keys, in the order in which a scenario is written.
        pub const PARAMETERS: &[Parameter] = &[$($name.parameter),*];
    };
}

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

keys! {
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

    FRICTION_SETTLED: f64 = quantity("friction.settled", "", NotNegative,
            "coefficient of friction after running in")
        .effect("friction after running in");
    FRICTION_CYCLES: f64 = quantity("friction.running_in_cycles", "cycles", Positive,
            "cycles in which the distance to settled falls by a factor e")
        .effect("raising it: friction settles later");
    FRICTION_ENERGY: f64 = quantity("friction.running_in_energy", "J", Positive,
            "friction work in which the distance to settled falls by a factor e")
        .effect("raising it: friction settles later");
    FRICTION_FILE: String = text("friction.file",
            "CSV file with columns coefficient and cycle or energy_J, instead of coefficient")
        .effect("another course of the friction coefficient");
    FRICTION_AT_CYCLE: Vec<f64> = quantities("friction.at_cycle", "cycles", NotNegative,
            "cycles of the table, as read from friction.file")
        .effect("the cycles of the course");
    FRICTION_AT_ENERGY: Vec<f64> = quantities("friction.at_energy", "J", NotNegative,
            "energies of the table, as read from friction.file")
        .effect("the energies of the course");
    FRICTION_VALUES: Vec<f64> = quantities("friction.values", "", NotNegative,
            "coefficients of the table, as read from friction.file")
        .effect("the coefficients of the course");

    NORMAL_CONTROL: String = choice("motion.normal.control", CONTROLS,
            "what is prescribed in the normal direction")
        .default(Written("\"displacement\""))
        .effect("displacement: wear unloads the contact; force: it sinks in");
    NORMAL_MEAN: f64 = quantity("motion.normal.mean", PRESCRIBED, Any,
            "mean depth or mean normal force")
        .effect("raising it: a wider contact, a wider stick zone");
    NORMAL_AMPLITUDE: f64 = quantity("motion.normal.amplitude", PRESCRIBED, NotNegative,
            "amplitude of the normal motion")
        .default(Implied("0.0"))
        .effect("raising it: the edge of the contact opens and closes further");
    NORMAL_FREQUENCY: f64 = quantity("motion.normal.angular_frequency", "rad/s", Positive,
            "angular frequency of the normal motion")
        .default(Derived("that of the tangential motion if the amplitude is 0"))
        .effect("a different ratio to the tangential one: a different loop");
    NORMAL_HERTZ: f64 = quantity("motion.normal.frequency", "Hz", Positive,
            "frequency of the normal motion, instead of angular_frequency")
        .effect("a different ratio to the tangential one: a different loop");
    NORMAL_PHASE: f64 = quantity("motion.normal.phase", "rad", Any, "phase of the normal motion")
        .default(Implied("0.0"))
        .effect("when the contact is deepest, relative to the tangential motion");
    NORMAL_WAVEFORM: String = choice("motion.normal.waveform", WAVEFORMS,
            "waveform of the normal motion")
        .default(Implied("\"sine\""))
        .effect("at constant depth only the turning points count");
    NORMAL_HOLD: f64 = quantity("motion.normal.hold", "", UpTo(0.99),
            "fraction of a period spent at rest, for waveform = \"trapezoid\"")
        .effect("raising it: longer rests, faster strokes");
    NORMAL_FILE: String = text("motion.normal.file",
            "CSV file of waveform = \"table\": one period, columns time_s and u_m, or F_N, or value")
        .effect("another table of one period");
    NORMAL_TIMES: Vec<f64> = quantities("motion.normal.times", "s", Any,
            "times of the table, as read from motion.normal.file")
        .effect("the times of the table");
    NORMAL_VALUES: Vec<f64> = quantities("motion.normal.values", PRESCRIBED, Any,
            "values of the table, as read from motion.normal.file")
        .effect("the values of the table");

    TANGENTIAL_CONTROL: String = choice("motion.tangential.control", CONTROLS,
            "what is prescribed in the tangential direction")
        .default(Written("\"displacement\""))
        .effect("displacement or force oscillates");
    TANGENTIAL_MEAN: f64 = quantity("motion.tangential.mean", PRESCRIBED, Any,
            "mean displacement or mean tangential force")
        .default(Implied("0.0"))
        .effect("where the motion is centred; forgotten after a cycle");
    TANGENTIAL_AMPLITUDE: f64 = quantity("motion.tangential.amplitude", PRESCRIBED, NotNegative,
            "amplitude of the tangential motion")
        .default(Implied("0.0"))
        .effect("raising it: a wider slip ring, then gross slip");
    TANGENTIAL_FREQUENCY: f64 = quantity("motion.tangential.angular_frequency", "rad/s", Positive,
            "angular frequency of the tangential motion; one period is a cycle")
        .default(Derived("that of the normal motion if the amplitude is 0"))
        .effect("one period is a cycle; matters for powers of the slip rate");
    TANGENTIAL_HERTZ: f64 = quantity("motion.tangential.frequency", "Hz", Positive,
            "frequency of the tangential motion, instead of angular_frequency; one period is a cycle")
        .effect("one period is a cycle; matters for powers of the slip rate");
    TANGENTIAL_PHASE: f64 = quantity("motion.tangential.phase", "rad", Any,
            "phase of the tangential motion")
        .default(Implied("0.0"))
        .effect("when the shift is largest, relative to the depth");
    RIG_STIFFNESS: f64 = quantity("motion.tangential.rig_stiffness", "N/m", Positive,
            "stiffness of the rig in series with the contact: the motion is then that of the \
             actuator")
        .default(Derived("infinite: the contact gets the whole motion"))
        .effect("raising it: the contact gets more of the actuator's motion");
    TANGENTIAL_WAVEFORM: String = choice("motion.tangential.waveform", WAVEFORMS,
            "waveform of the tangential motion")
        .default(Implied("\"sine\""))
        .effect("at constant depth only the turning points count");
    TANGENTIAL_HOLD: f64 = quantity("motion.tangential.hold", "", UpTo(0.99),
            "fraction of a period spent at rest, for waveform = \"trapezoid\"")
        .effect("raising it: longer rests, faster strokes");
    TANGENTIAL_FILE: String = text("motion.tangential.file",
            "CSV file of waveform = \"table\": one period, columns time_s and u_m, or F_N, or value")
        .effect("another table of one period");
    TANGENTIAL_TIMES: Vec<f64> = quantities("motion.tangential.times", "s", Any,
            "times of the table, as read from motion.tangential.file")
        .effect("the times of the table");
    TANGENTIAL_VALUES: Vec<f64> = quantities("motion.tangential.values", PRESCRIBED, Any,
            "values of the table, as read from motion.tangential.file")
        .effect("the values of the table");

    LAW: String = choice("wear.law", LAWS, "law of wear")
        .default(Written("\"archard\""))
        .effect("archard: by friction work; power: by powers of stress and slip rate");
    WEAR_COEFFICIENT: f64 = quantity("wear.coefficient", "1/Pa", NotNegative,
            "wear coefficient k per friction work: V = k E_d")
        .effect("raising it: the same wear in fewer cycles, until steps are too coarse");
    WEAR_PER_LOAD: f64 = quantity("wear.coefficient_per_load", "m^3/(N*m)", NotNegative,
            "Archard's, of a pin test: volume per load and sliding distance, instead of coefficient")
        .effect("as coefficient: k = coefficient_per_load / friction, of each moment");
    WEAR_SETTLED: f64 = quantity("wear.settled", "1/Pa", NotNegative,
            "wear coefficient per friction work after running in")
        .effect("the wear coefficient after running in");
    WEAR_CYCLES: f64 = quantity("wear.running_in_cycles", "cycles", Positive,
            "cycles in which the distance to settled falls by a factor e")
        .effect("raising it: the wear coefficient settles later");
    WEAR_ENERGY: f64 = quantity("wear.running_in_energy", "J", Positive,
            "friction work in which the distance to settled falls by a factor e")
        .effect("raising it: the wear coefficient settles later");
    WEAR_THRESHOLD: f64 = quantity("wear.threshold_energy", "J", NotNegative,
            "friction work below which nothing wears: V = k (E_d - threshold)")
        .default(Implied("0.0"))
        .effect("raising it: wear begins later");
    WEAR_FILE: String = text("wear.file",
            "CSV file with columns coefficient (1/Pa) and cycle or energy_J, instead of \
             coefficient")
        .effect("another course of the wear coefficient");
    WEAR_AT_CYCLE: Vec<f64> = quantities("wear.at_cycle", "cycles", NotNegative,
            "cycles of the table, as read from wear.file")
        .effect("the cycles of the course");
    WEAR_AT_ENERGY: Vec<f64> = quantities("wear.at_energy", "J", NotNegative,
            "energies of the table, as read from wear.file")
        .effect("the energies of the course");
    WEAR_VALUES: Vec<f64> = quantities("wear.values", "1/Pa", NotNegative,
            "wear coefficients of the table, as read from wear.file")
        .effect("the coefficients of the course");
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
    METHOD: String = choice("numerics.method", AbelMethod::NAMES, "transform method")
        .default(Written("\"product\""))
        .effect("how the three transforms are computed");
    POINTS: i64 = count("numerics.points", Within(MIN_CELLS as f64, MAX_CELLS as f64),
            "grid cells from r = 0 to the domain's edge")
        .default(Written("100"))
        .effect("raising it: finer and slower");
    STEPS_PER_CYCLE: i64 = count("numerics.steps_per_cycle", Within(1.0, 1e6), "time steps per period of the faster motion")
        .default(Written("100"))
        .effect("raising it: finer in time and slower");
    DOMAIN_RADIUS: f64 = quantity("numerics.domain_radius", "m", Positive,
            "outer radius of the computed domain; it grows when the contact reaches it")
        .default(Derived("the largest radius that can touch"))
        .effect("raising it: room to grow, coarser at the same number of points");
    GRID: String = choice("numerics.grid", Spacing::NAMES,
            "spacing of the nodes; the default depends on the method")
        .default(Derived("graded with method = \"product\", else uniform"))
        .effect("graded: narrow cells where the worn profile is steep");
    NODES: Vec<f64> = quantities("numerics.nodes", "m", NotNegative,
            "nodes of the grid, from 0 to the domain's edge, as numerics.accuracy placed them by a coarser run")
        .effect("other cells; numerics.points or numerics.grid takes their place");
    SCHEME: String = choice("numerics.scheme", Scheme::NAMES,
            "time-stepping scheme; the default depends on the method")
        .default(Derived("trapezoid with method = \"product\", else euler"))
        .effect("trapezoid: second order in time; euler: the paper's");
    STABILITY: String = choice("numerics.stability", Stability::NAMES,
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
