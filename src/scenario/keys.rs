//! The keys of a scenario as the program names them, each with the type that it is read as. `keys.toml` describes them.

use super::schema::{Key, flag, number, numbers, whole, word};
use crate::math::abel::AbelMethod;
use crate::simulation::{Scheme, Spacing, Stability};

/// Makes a constant of each key.
macro_rules! keys {
    ($($name:ident: $type:ty = $read:path, $path:literal;)*) => {
        $(pub(super) const $name: Key<$type> = Key::new($path, $read);)*

        #[cfg(test)]
        pub(super) const NAMED: &[&str] = &[$($path),*];
    };
}

keys! {
    TITLE: String = word, "title";
    DESCRIPTION: String = word, "description";
    SHAPE: String = word, "indenter.shape";
    RADIUS: f64 = number, "indenter.radius";
    ANGLE: f64 = number, "indenter.angle";
    TIP_RADIUS: f64 = number, "indenter.tip_radius";
    SHAPE_COEFFICIENT: f64 = number, "indenter.coefficient";
    SHAPE_EXPONENT: f64 = number, "indenter.exponent";
    TABLE_FILE: String = word, "indenter.file";
    SMOOTHING: f64 = number, "indenter.smoothing";
    RADII: Vec<f64> = numbers, "indenter.radii";
    HEIGHTS: Vec<f64> = numbers, "indenter.heights";
    EFFECTIVE_MODULUS: f64 = number, "material.effective_modulus";
    POISSON: f64 = number, "material.poisson";
    HARDNESS: f64 = number, "material.hardness";
    FATIGUE_LIMIT: f64 = number, "material.fatigue_limit";
    SHEAR_FATIGUE_LIMIT: f64 = number, "material.shear_fatigue_limit";
    FRICTION: f64 = number, "friction.coefficient";
    RIG_STIFFNESS: f64 = number, "motion.tangential.rig_stiffness";
    LAW: String = word, "wear.law";
    WEAR_COEFFICIENT: f64 = number, "wear.coefficient";
    WEAR_PER_LOAD: f64 = number, "wear.coefficient_per_load";
    WEAR_THRESHOLD: f64 = number, "wear.threshold_energy";
    WEAR_INITIAL_RADII: Vec<f64> = numbers, "wear.initial_radii";
    WEAR_INITIAL_DEPTHS: Vec<f64> = numbers, "wear.initial_depths";
    WEAR_SHARE: f64 = number, "wear.share";
    STRESS_EXPONENT: f64 = number, "wear.stress_exponent";
    SLIP_RATE_EXPONENT: f64 = number, "wear.slip_rate_exponent";
    REFERENCE_STRESS: f64 = number, "wear.reference_stress";
    REFERENCE_SLIP_RATE: f64 = number, "wear.reference_slip_rate";
    ACCURACY: f64 = number, "numerics.accuracy";
    METHOD: AbelMethod = word, "numerics.method";
    POINTS: u32 = whole, "numerics.points";
    STEPS_PER_CYCLE: u32 = whole, "numerics.steps_per_cycle";
    DOMAIN_RADIUS: f64 = number, "numerics.domain_radius";
    GRID: Spacing = word, "numerics.grid";
    NODES: Vec<f64> = numbers, "numerics.nodes";
    SCHEME: Scheme = word, "numerics.scheme";
    STABILITY: Stability = word, "numerics.stability";
    INTEGRATOR: String = word, "numerics.integrator";
    TOLERANCE: f64 = number, "numerics.tolerance";
}

/// Makes the type of a group of keys that several tables have, and the group of each of these tables.
macro_rules! groups {
    (@type $(#[$doc:meta])* $group:ident { $($field:ident: $type:ty = $read:path, $key:literal;)* }) => {
        $(#[$doc])*
        pub(super) struct $group {
            pub section: &'static str,
            $(pub $field: Key<$type>,)*
        }
    };
    (@keys $group:ident $name:ident $section:literal { $($field:ident: $type:ty = $read:path, $key:literal;)* }) => {
        pub(super) const $name: $group = $group {
            section: $section,
            $($field: Key::new(concat!($section, ".", $key), $read),)*
        };
    };
    ($(#[$doc:meta])* $group:ident $keys:tt $($name:ident = $section:literal),*) => {
        groups!(@type $(#[$doc])* $group $keys);
        $(groups!(@keys $group $name $section $keys);)*
    };
}

groups! {
    /// The keys of one of two bodies.
    BodyKeys {
        modulus: f64 = number, "youngs_modulus";
        poisson: f64 = number, "poisson";
        hardness: f64 = number, "hardness";
        rigid: bool = flag, "rigid";
    }
    INDENTER = "material.indenter", HALF_SPACE = "material.half_space"
}

groups! {
    /// The keys of one direction of the motion.
    Motion {
        control: String = word, "control";
        mean: f64 = number, "mean";
        amplitude: f64 = number, "amplitude";
        frequency: f64 = number, "angular_frequency";
        hertz: f64 = number, "frequency";
        phase: f64 = number, "phase";
        waveform: String = word, "waveform";
        hold: f64 = number, "hold";
        file: String = word, "file";
        times: Vec<f64> = numbers, "times";
        values: Vec<f64> = numbers, "values";
    }
    NORMAL = "motion.normal", TANGENTIAL = "motion.tangential"
}

groups! {
    /// The keys of a coefficient that runs in, but for that which it begins with.
    RunsIn {
        settled: f64 = number, "settled";
        cycles: f64 = number, "running_in_cycles";
        energy: f64 = number, "running_in_energy";
        at_cycle: Vec<f64> = numbers, "at_cycle";
        at_energy: Vec<f64> = numbers, "at_energy";
        values: Vec<f64> = numbers, "values";
    }
    FRICTION_COURSE = "friction", WEAR_COURSE = "wear"
}

/// The unit of what a motion prescribes.
pub(super) const PRESCRIBED: &str = "m, or N if control = \"force\"";

/// The keys chosen by `numerics.accuracy`.
pub(super) const CHOSEN_BY_ACCURACY: [&str; 4] = [
    POINTS.path(),
    STEPS_PER_CYCLE.path(),
    TOLERANCE.path(),
    NODES.path(),
];
