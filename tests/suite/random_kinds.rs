//! Random scenarios of a second family: those of the [first](crate::random_scenarios) with what makes or breaks a moment
//! inside a step.
//!
//! | what is added | range |
//! |---|---|
//! | threshold energy | 0.03 to 1 of the work of the run, as a closed form guesses it |
//! | course of μ or of k, over cycles or energy, exponential or a table | from 0.6 to 1.6 of the value; over 0.02 to 1 of the run |
//! | waveforms | triangles, and trapezoids that rest for 0.1 to 0.7 of a period |
//! | rig | 0.3 to 10 times as stiff as the contact |
//! | rounded tip | its flat 0.1 to 0.8 of the contact radius |
//! | scar | a bowl as wide as 0.5 to 0.95 of the contact, 0.1 to 0.5 of the depth deep |
//! | blocks | two or three, with other amplitudes and means |
//! | powers of the slip rate | 0.7 to 1.5 |
//! | words of [`CHOICES`] that none of these knows | its keys by their units |

use std::f64::consts::PI;

use mdr_tui::scenario::Scenario;
use mdr_tui::scenario::key::Key;
use toml::{Table, Value};

use crate::random::Random;

/// From this seed on, scenarios are of this family; each tenth one is long.
pub const KINDS: u64 = 2_000_000;

/// What is known of a scenario before it is given to the program.
pub struct Known {
    pub friction: f64,
    pub coefficient: f64,
    pub cycles: f64,
    /// F_z, N, contact radius, m, and depth, m, at the deepest moment.
    pub force: f64,
    pub radius: f64,
    pub depth: f64,
    /// 2G*a, N/m.
    pub stiffness: f64,
    /// Amplitude of the shift, m, and what makes all of the contact slip.
    pub shift: f64,
    pub gross_slip: f64,
    pub tangential_by_force: bool,
    pub lifts: bool,
}

impl Known {
    /// A guess at the work of the run, J, as for a sphere under a held load.
    fn work(&self) -> f64 {
        let share = self.shift / self.gross_slip;
        let per_cycle = match share < 1.0 {
            true => 0.2 * share * share,
            false => 1.0 - 0.8 / share,
        };
        4.0 * self.friction * self.force * self.shift * per_cycle * self.cycles
    }
}

/// A scenario of the first family, as TOML, with more kinds.
pub fn extend(text: &str, known: &Known, draw: &mut Random) -> String {
    let mut table: Table = text.parse().expect("TOML");
    let blocks = draw.chance(0.2);
    if draw.chance(0.25) {
        let threshold = known.work() * draw.log_between(0.03, 1.0);
        section(&mut table, "wear").insert("threshold_energy".into(), threshold.into());
    }
    if draw.chance(0.3) && !known.tangential_by_force {
        course(&mut table, "friction", known.friction, known, draw);
    }
    if draw.chance(0.25) {
        course(&mut table, "wear", known.coefficient, known, draw);
    }
    for direction in ["normal", "tangential"] {
        if draw.chance(0.35) {
            waveform(motion(&mut table, direction), draw);
        }
    }
    if draw.chance(0.15) && !known.tangential_by_force {
        let stiffness = known.stiffness * draw.log_between(0.3, 10.0);
        motion(&mut table, "tangential").insert("rig_stiffness".into(), stiffness.into());
    }
    if draw.chance(0.15) {
        round_tip(&mut table, known, draw);
    }
    if draw.chance(0.15) && !known.lifts {
        scar(section(&mut table, "wear"), known, draw);
    }
    if draw.chance(0.2) {
        let wear = section(&mut table, "wear");
        wear.insert("law".into(), "power".into());
        wear.entry("stress_exponent").or_insert(1.0.into());
        let exponent = draw.between(0.7, 1.5);
        wear.insert("slip_rate_exponent".into(), exponent.into());
    }
    if blocks {
        add_blocks(&mut table, known, draw);
    }
    // Last, so that a new word changes no scenario without it.
    for (path, drawn) in CHOICES {
        let mut new = words(path);
        new.retain(|word| !drawn.contains(word));
        if !new.is_empty() && draw.chance(0.2) {
            choose(&mut table, path, draw.pick(&new), known, draw);
        }
    }
    table.to_string()
}

/// What can be chosen, with the words that are drawn with keys of their own, or need a file.
pub const CHOICES: [(&str, &[&str]); 4] = [
    ("wear.law", &["archard", "power"]),
    ("motion.normal.waveform", WAVEFORMS),
    ("motion.tangential.waveform", WAVEFORMS),
    (
        "indenter.shape",
        &[
            "paraboloid",
            "cone",
            "power",
            "flat-punch",
            "truncated-paraboloid",
            "truncated-cone",
            "rounded-punch",
            "table",
        ],
    ),
];

const WAVEFORMS: &[&str] = &["sine", "triangle", "trapezoid", "table"];

/// The words of a key in `keys.toml`.
pub fn words(path: &str) -> Vec<&'static str> {
    let key = Key::find(path).expect(path);
    key.kind.words().expect("a choice of words")
}

/// Chooses a word, with a value for each key that it then misses, and without the keys that belong to other words.
pub fn choose(table: &mut Table, path: &str, word: &str, known: &Known, draw: &mut Random) {
    let (name, key) = path.rsplit_once('.').expect("SECTION.KEY");
    let keys = name.split('.').fold(&mut *table, section);
    keys.insert(key.into(), word.into());
    keys.retain(|key, _| {
        let key = Key::find(&format!("{name}.{key}"));
        let users = key.and_then(|key| key.used_by.get(path).cloned());
        users.is_none_or(|users| users.contains(&word))
    });
    // Any other error is reported where the scenario is used.
    while let Err(error) = Scenario::from_toml(&table.to_string(), word, &[])
        && let Some((missing, _)) = error.to_string().split_once(" is missing: ")
        && let Some(missing) = missing.rsplit(' ').next().and_then(Key::find)
    {
        let value = usual(missing.unit, known, draw);
        let keys = missing.section().split('.').fold(&mut *table, section);
        keys.insert(missing.key().into(), value.into());
    }
}

/// A value of a key of which its unit alone is known.
fn usual(unit: &str, known: &Known, draw: &mut Random) -> f64 {
    match unit {
        "Pa" => known.force / (PI * known.radius * known.radius) * draw.log_between(0.1, 1.0),
        "m" => known.radius * draw.between(0.1, 0.8),
        "rad" => draw.log_between(3e-3, 0.1),
        _ => draw.between(0.2, 0.8),
    }
}

fn section<'a>(table: &'a mut Table, name: &str) -> &'a mut Table {
    table[name].as_table_mut().expect("a section")
}

fn motion<'a>(table: &'a mut Table, direction: &str) -> &'a mut Table {
    section(section(table, "motion"), direction)
}

/// A coefficient that runs in from its value.
fn course(table: &mut Table, name: &str, value: f64, known: &Known, draw: &mut Random) {
    let by_energy = draw.chance(0.5);
    let whole = if by_energy {
        known.work()
    } else {
        known.cycles
    };
    let keys = section(table, name);
    let [one, other] = [0; 2].map(|_| value * draw.log_between(0.6, 1.6));
    if draw.chance(0.6) {
        keys.insert("settled".into(), one.into());
        let constant = if by_energy {
            "running_in_energy"
        } else {
            "running_in_cycles"
        };
        keys.insert(
            constant.into(),
            (whole * draw.log_between(0.02, 1.0)).into(),
        );
        return;
    }
    keys.remove("coefficient");
    let ends = [0.0, 0.3, 1.0].map(|share| share * whole * 0.7);
    let values = [value, one, other];
    let at = if by_energy { "at_energy" } else { "at_cycle" };
    keys.insert(at.into(), floats(&ends));
    keys.insert("values".into(), floats(&values));
}

fn floats(values: &[f64]) -> Value {
    values
        .iter()
        .copied()
        .map(Value::Float)
        .collect::<Vec<_>>()
        .into()
}

fn waveform(motion: &mut Table, draw: &mut Random) {
    if draw.chance(0.5) {
        motion.insert("waveform".into(), "triangle".into());
        return;
    }
    motion.insert("waveform".into(), "trapezoid".into());
    motion.insert("hold".into(), draw.between(0.1, 0.7).into());
}

/// A flat tip with a rounded edge, as deep as the shape was; other shapes than a paraboloid stay.
fn round_tip(table: &mut Table, known: &Known, draw: &mut Random) {
    let indenter = section(table, "indenter");
    if indenter["shape"].as_str() == Some("paraboloid") {
        indenter.insert("shape".into(), "rounded-punch".into());
        let tip = known.radius * draw.between(0.1, 0.8);
        indenter.insert("tip_radius".into(), tip.into());
    }
}

/// A bowl within the contact.
fn scar(wear: &mut Table, known: &Known, draw: &mut Random) {
    let (edge, depth) = (
        known.radius * draw.between(0.5, 0.95),
        known.depth * draw.between(0.1, 0.5),
    );
    let rows: Vec<f64> = (0..=40).map(|i| f64::from(i) / 40.0).collect();
    let radii: Vec<f64> = rows.iter().map(|x| x * edge).collect();
    let depths: Vec<f64> = rows.iter().map(|x| depth * (1.0 - x * x)).collect();
    wear.insert("initial_radii".into(), floats(&radii));
    wear.insert("initial_depths".into(), floats(&depths));
}

fn add_blocks(table: &mut Table, known: &Known, draw: &mut Random) {
    table.remove("changes");
    section(table, "run").remove("cycles");
    let number = draw.pick(&[2, 2, 3]);
    let (amplitude, mean) = (
        number_of(table, "tangential", "amplitude"),
        number_of(table, "normal", "mean"),
    );
    let shares: Vec<f64> = (0..number).map(|_| draw.between(0.5, 1.5)).collect();
    let whole: f64 = shares.iter().sum();
    let blocks = shares.iter().enumerate().map(|(i, share)| {
        let mut block = Table::new();
        let cycles = known.cycles * share / whole;
        let cycles = if draw.chance(0.5) {
            cycles.round().max(1.0)
        } else {
            cycles
        };
        block.insert("cycles".into(), cycles.into());
        if i > 0 {
            let change =
                |key: &str, value: f64| Table::from_iter([(key.to_owned(), Value::Float(value))]);
            let mut motion = Table::new();
            motion.insert(
                "tangential".into(),
                change("amplitude", amplitude * draw.between(0.5, 1.1)).into(),
            );
            if draw.chance(0.4) {
                motion.insert(
                    "normal".into(),
                    change("mean", mean * draw.between(0.9, 1.1)).into(),
                );
            }
            block.insert("motion".into(), motion.into());
        }
        Value::Table(block)
    });
    let blocks: Vec<Value> = blocks.collect();
    table.insert("blocks".into(), blocks.into());
}

fn number_of(table: &mut Table, direction: &str, key: &str) -> f64 {
    motion(table, direction)[key].as_float().expect("a number")
}
