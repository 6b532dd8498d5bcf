//! An accuracy of 1e-2, held against a second code that shares nothing with the program but the scenario.
//!
//! [`Plain`] is slow and plain: uniform cells, product integration in r², equal steps whose wear is corrected twice,
//! forces found by bisection. Its own error is what half its cells and steps change. It knows dual oscillation under a
//! held depth or force, with lift-off, and Archard's wear.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use mdr_tui::scenario::Scenario;

use mdr_tui::studies::refinement::{Budget, Verdict, run_to_accuracy};
use toml::Table;

use crate::random_scenarios;

const ACCURACY: f64 = 1e-2;

/// The most cycles of a run: the second code takes every step.
const CYCLES: f64 = 4.0;

/// Scenarios that the second code knows are taken from here on.
const FIRST_SEED: u64 = 900;
const SCENARIOS: usize = 8;

/// The cells of the second code.
const COARSEST: usize = 80;
const FINEST: usize = 320;

#[test]
fn an_accuracy_holds_against_a_code_of_its_own() {
    let known = (FIRST_SEED..).filter_map(|seed| Some((seed, Plain::read(seed)?)));
    let mut misses = Vec::new();
    for (seed, plain) in known.take(SCENARIOS) {
        let text = plain.text.as_str();
        let scenario = Scenario::from_toml(text, "second code", &[]).expect("a scenario");
        let met = run_to_accuracy(
            &scenario,
            plain.cycles,
            ACCURACY,
            Budget::UNLIMITED,
            &|| true,
        );
        let met = met.expect("a run");
        assert_eq!(met.verdict, Verdict::Met, "seed {seed}");
        let simulation = met.rung.session.simulation();
        let (fine, own) = plain.resolved();
        let wear = simulation.worn_depth();
        let grid = &simulation.setup().grid;
        let found = Ended {
            worn: fine.at.iter().map(|&r| grid.interpolate(wear, r)).collect(),
            at: fine.at.clone(),
            volume: simulation.wear_volume(),
            work: simulation.moment().dissipated_energy,
        };
        for ((what, off), (_, own)) in found.against(&fine).into_iter().zip(own) {
            let cells = fine.at.len() - 1;
            let line = format!("seed {seed}, {what}: {off:.1e}; {cells} cells err by {own:.1e}");
            eprintln!("{line}");
            if off > ACCURACY + own {
                misses.push(format!("{line}\n{text}"));
            }
        }
    }
    assert!(misses.is_empty(), "{misses:#?}");
}

/// What a run has come to.
struct Ended {
    /// Radii, m, and the worn depth there, m.
    at: Vec<f64>,
    worn: Vec<f64>,
    /// V, m³, and E_d, J.
    volume: f64,
    work: f64,
}

impl Ended {
    /// How far it is from a finer one: worn depth (rms over the scar, relative to its largest value), V and E_d.
    fn against(&self, fine: &Self) -> [(&'static str, f64); 3] {
        let here = |r: f64| {
            let step = self.at[1];
            let cell = ((r / step) as usize).min(self.at.len() - 2);
            let share = (r - self.at[cell]) / step;
            self.worn[cell] + share * (self.worn[cell + 1] - self.worn[cell])
        };
        let deepest = fine.worn.iter().copied().fold(0.0, f64::max);
        let scar = || (fine.at.iter().zip(&fine.worn)).filter(|(_, worn)| **worn > 1e-3 * deepest);
        let sum: f64 = scar().map(|(r, worn)| (here(*r) - worn).powi(2)).sum();
        [
            ("worn depth", (sum / scar().count() as f64).sqrt() / deepest),
            ("volume", (self.volume / fine.volume - 1.0).abs()),
            ("work", (self.work / fine.work - 1.0).abs()),
        ]
    }
}

/// mean + amplitude sin(ωt + φ), the time in cycles of the tangential motion.
struct Wave {
    mean: f64,
    amplitude: f64,
    /// Radians per cycle.
    speed: f64,
    phase: f64,
}

impl Wave {
    fn at(&self, cycle: f64) -> f64 {
        self.mean + self.amplitude * (self.speed * cycle + self.phase).sin()
    }
}

/// A scenario in the second code.
struct Plain {
    /// What the program reads.
    text: String,
    /// f₀′(r) and f₀(r) of the unworn shape.
    slope: Box<dyn Fn(f64) -> f64>,
    shape: Box<dyn Fn(f64) -> f64>,
    /// E*, G*, Pa, μ and k, 1/Pa.
    modulus: f64,
    tangential_modulus: f64,
    friction: f64,
    wear: f64,
    /// Depth, m, or force, N; u_x, m.
    normal: Wave,
    is_force: bool,
    shift: Wave,
    cycles: f64,
}

impl Plain {
    /// The random scenario of a seed, cut to a few cycles; `None` if it has what this code does not know.
    fn read(seed: u64) -> Option<Self> {
        let mut table: Table = random_scenarios::text(seed).parse().expect("TOML");
        let is_known = !table.contains_key("changes") && !table.contains_key("numerics");
        let number = |table: &Table, path: &str| -> Option<f64> {
            let (section, key) = path.rsplit_once('.')?;
            let mut inner = table;
            for part in section.split('.') {
                inner = inner.get(part)?.as_table()?;
            }
            let value = inner.get(key)?;
            value
                .as_float()
                .or(value.as_integer().map(|whole| whole as f64))
        };
        let word = |table: &Table, section: &[&str], key: &str| {
            let inner = |table: &Table, part: &&str| table.get(*part)?.as_table().cloned();
            let inner = section
                .iter()
                .try_fold(table.clone(), |table, part| inner(&table, part));
            inner?.get(key)?.as_str().map(str::to_owned)
        };
        let is_force = word(&table, &["motion", "normal"], "control")? == "force";
        let by_force = word(&table, &["motion", "tangential"], "control")? == "force";
        if !is_known || by_force || word(&table, &["wear"], "law").is_some() {
            return None;
        }
        let cycles = number(&table, "run.cycles")?.min(CYCLES);
        table
            .get_mut("run")?
            .as_table_mut()?
            .insert("cycles".into(), cycles.into());
        let size = |key: &str| number(&table, &format!("indenter.{key}"));
        type Function = Box<dyn Fn(f64) -> f64>;
        let (shape, slope): (Function, Function) =
            match word(&table, &["indenter"], "shape")?.as_str() {
                "paraboloid" => {
                    let radius = size("radius")?;
                    (
                        Box::new(move |r| r * r / (2.0 * radius)),
                        Box::new(move |r| r / radius),
                    )
                }
                "cone" => {
                    let rise = size("angle")?.tan();
                    (Box::new(move |r| rise * r), Box::new(move |_| rise))
                }
                "power" => {
                    let (factor, exponent) = (size("coefficient")?, size("exponent")?);
                    (
                        Box::new(move |r| factor * r.powf(exponent)),
                        Box::new(move |r| factor * exponent * r.powf(exponent - 1.0)),
                    )
                }
                _ => return None,
            };
        let tangential = number(&table, "motion.tangential.angular_frequency")?;
        let wave = |name: &str| -> Option<Wave> {
            let part = |key: &str| number(&table, &format!("motion.{name}.{key}"));
            Some(Wave {
                mean: part("mean")?,
                amplitude: part("amplitude")?,
                speed: std::f64::consts::TAU * part("angular_frequency")? / tangential,
                phase: part("phase")?,
            })
        };
        let (normal, shift) = (wave("normal")?, wave("tangential")?);
        let modulus = number(&table, "material.effective_modulus")?;
        let poisson = number(&table, "material.poisson")?;
        Some(Self {
            shape,
            slope,
            modulus,
            tangential_modulus: modulus * 2.0 * (1.0 - poisson) / (2.0 - poisson),
            friction: number(&table, "friction.coefficient")?,
            wear: number(&table, "wear.coefficient")?,
            normal,
            is_force,
            shift,
            cycles,
            text: table.to_string(),
        })
    }

    /// g₀(x) = x ∫f₀′(x sin θ) dθ, by midpoints.
    fn image(&self, x: f64) -> f64 {
        const PARTS: u32 = 400;
        let angle = |i: u32| FRAC_PI_2 * (f64::from(i) + 0.5) / f64::from(PARTS);
        let sum: f64 = (0..PARTS).map(|i| (self.slope)(x * angle(i).sin())).sum();
        x * sum * FRAC_PI_2 / f64::from(PARTS)
    }

    /// How far the nodes must reach: where the deepest indentation ends, or, under a force, a contact that has
    /// grown to one and a half times its radius.
    fn reach(&self) -> f64 {
        let most = self.normal.mean + self.normal.amplitude.abs();
        let is_enough = |r: f64| match self.is_force {
            false => (self.shape)(r) >= most,
            true => {
                let (nodes, depth) = (200, self.image(r / 1.5));
                let load = |i: u32| (depth - self.image(r / 1.5 * f64::from(i) / 200.0)).max(0.0);
                let step = r / 1.5 / f64::from(nodes);
                2.0 * self.modulus * step * (0..nodes).map(load).sum::<f64>() >= most
            }
        };
        let (mut low, mut high) = (1e-12, 1.0);
        for _ in 0..60 {
            let middle = f64::sqrt(low * high);
            *if is_enough(middle) {
                &mut high
            } else {
                &mut low
            } = middle;
        }
        1.02 * high
    }

    /// The end of a run whose own error is small enough to judge by, or the finest that is tried, and by how
    /// much it differs from one on half the cells.
    fn resolved(&self) -> (Ended, [(&'static str, f64); 3]) {
        let mut coarse = self.run(COARSEST);
        loop {
            let fine = self.run(2 * (coarse.at.len() - 1));
            let own = coarse.against(&fine);
            let is_enough = own.iter().all(|(_, own)| *own < 0.5 * ACCURACY);
            if is_enough || fine.at.len() > FINEST {
                return (fine, own);
            }
            coarse = fine;
        }
    }

    /// Runs to the end on `cells` cells.
    fn run(&self, cells: usize) -> Ended {
        let reach = self.reach();
        let at: Vec<f64> = (0..=cells)
            .map(|i| reach * i as f64 / cells as f64)
            .collect();
        let unworn: Vec<f64> = at.iter().map(|&x| self.image(x)).collect();
        let operators = Operators::new(&at);
        // An explicit step must not wear more than the contact can give way to.
        let rate = self.friction * self.wear * self.modulus * 4.0 * self.shift.amplitude;
        let steps = (0.7 * cells as f64).max(3.0 * rate * cells as f64 / reach);
        let steps = (steps * self.cycles).ceil() as usize;
        let mut worn = vec![0.0; at.len()];
        let mut work = 0.0;
        let spot = |worn: &[f64], springs: &[f64], from: f64, cycle: f64| {
            Spot::solve(self, &operators, &unworn, worn, springs, [from, cycle])
        };
        let none = vec![0.0; at.len()];
        let mut now = spot(&worn, &none, f64::NAN, 0.0);
        let stored = now.stored;
        let mut last = none.clone();
        for i in 1..=steps {
            let [before, cycle] = [i - 1, i].map(|i| self.cycles * i as f64 / steps as f64);
            let add = |worn: &[f64], step: &[f64]| -> Vec<f64> {
                worn.iter().zip(step).map(|(a, b)| a + b).collect()
            };
            // What wears takes load off and so lets the contact slip, by as much as the motion does and however short
            // the step: wear by the old profile alone loses 13 % of V under a strong swing of the depth.
            let mut next = spot(&add(&worn, &last), &now.springs, before, cycle);
            for _ in 0..2 {
                for (i, step) in last.iter_mut().enumerate() {
                    let slip = next.slip[i] - now.slip[i];
                    let stress = 0.5 * (now.stress[i] + next.stress[i]);
                    *step = (self.wear * stress * slip).max(0.0);
                }
                next = spot(&add(&worn, &last), &now.springs, before, cycle);
            }
            let after = add(&worn, &last);
            let force = 0.5 * (now.force + next.force);
            let shift = self.shift.at(cycle) - self.shift.at(before);
            work += force * shift;
            (now, worn) = (next, after);
        }
        let ring = |i: usize| {
            let (inner, outer) = (at[i] * worn[i], at[i + 1] * worn[i + 1]);
            0.5 * (inner + outer) * (at[i + 1] - at[i])
        };
        Ended {
            volume: std::f64::consts::TAU * (0..cells).map(ring).sum::<f64>(),
            // What the springs hold is not dissipated.
            work: work - (now.stored - stored),
            worn,
            at,
        }
    }
}

/// Product integration in r² between nodes, as rows of weights.
struct Operators {
    at: Vec<f64>,
    /// g − f(0), the surface's displacement of springs, and the stress of a line load.
    image: Vec<Vec<f64>>,
    displacement: Vec<Vec<f64>>,
    stress: Vec<Vec<f64>>,
}

impl Operators {
    fn new(at: &[f64]) -> Self {
        let n = at.len();
        let square: Vec<f64> = at.iter().map(|r| r * r).collect();
        let mut image = vec![vec![0.0; n]; n];
        let (mut displacement, mut stress) = (image.clone(), image.clone());
        displacement[0][0] = 1.0;
        for j in 0..n {
            for k in 0..n - 1 {
                let width = square[k + 1] - square[k];
                let root = |a: f64, b: f64| (a - b).max(0.0).sqrt();
                if k < j {
                    let weight = 2.0 * at[j] / width
                        * (root(square[j], square[k]) - root(square[j], square[k + 1]));
                    image[j][k + 1] += weight;
                    image[j][k] -= weight;
                    // ∫dx/√(r² − x²) and ∫x² dx/√(r² − x²).
                    let r = at[j];
                    let zeroth = |x: f64| (x / r).min(1.0).asin();
                    let second = |x: f64| 0.5 * r * r * zeroth(x) - 0.5 * x * root(r * r, x * x);
                    let flat = zeroth(at[k + 1]) - zeroth(at[k]);
                    let bent = second(at[k + 1]) - second(at[k]);
                    let outer = (bent - square[k] * flat) / width;
                    displacement[j][k + 1] += FRAC_2_PI * outer;
                    displacement[j][k] += FRAC_2_PI * (flat - outer);
                }
                if k >= j {
                    let weight = -FRAC_2_PI / width
                        * (root(square[k + 1], square[j]) - root(square[k], square[j]));
                    stress[j][k + 1] += weight;
                    stress[j][k] -= weight;
                }
            }
        }
        Self {
            at: at.to_vec(),
            image,
            displacement,
            stress,
        }
    }

    /// All rows look inwards or all outwards: `values` beyond their node are zero to them.
    fn of(rows: &[Vec<f64>], values: &[f64]) -> Vec<f64> {
        let dot = |row: &[f64], values: &[f64]| row.iter().zip(values).map(|(a, b)| a * b).sum();
        let looks_inwards = rows[0][1..].iter().all(|weight| *weight == 0.0);
        let row = |(j, row): (usize, &Vec<f64>)| match looks_inwards {
            true => dot(&row[..=j], values),
            false => dot(&row[j..], &values[j..]),
        };
        rows.iter().enumerate().map(row).collect()
    }
}

/// The contact at one moment.
struct Spot {
    /// Displacements of the springs, m.
    springs: Vec<f64>,
    /// τ, Pa, and how far the indenter has gone beyond the surface, m.
    stress: Vec<f64>,
    slip: Vec<f64>,
    /// F_x, N, and the energy that the springs hold, J.
    force: f64,
    stored: f64,
}

impl Spot {
    /// The contact at the second of two cycles, with springs that have come from the first one.
    fn solve(
        plain: &Plain,
        operators: &Operators,
        unworn: &[f64],
        worn: &[f64],
        springs: &[f64],
        [from, cycle]: [f64; 2],
    ) -> Self {
        let image = Operators::of(&operators.image, worn);
        let g: Vec<f64> = (unworn.iter().zip(&image))
            .map(|(g, image)| g + image + worn[0])
            .collect();
        let step = operators.at[1];
        let load = |depth: f64| -> f64 {
            // Springs stand at nodes; a line through two of them ends where it meets zero.
            let cell = |pair: &[f64]| {
                let [a, b] = [depth - pair[0], depth - pair[1]];
                match (a > 0.0, b > 0.0) {
                    (true, true) => 0.5 * (a + b),
                    (true, false) => 0.5 * a * a / (a - b),
                    (false, true) => 0.5 * b * b / (b - a),
                    (false, false) => 0.0,
                }
            };
            2.0 * plain.modulus * step * g.windows(2).map(cell).sum::<f64>()
        };
        let target = plain.normal.at(cycle);
        let depth = match plain.is_force {
            false => target,
            true => {
                let lowest = g.iter().copied().fold(f64::INFINITY, f64::min);
                let (mut low, mut high) = (lowest, g[g.len() - 1]);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    *if load(middle) < target {
                        &mut low
                    } else {
                        &mut high
                    } = middle;
                }
                high
            }
        };
        let shift = plain.shift.at(cycle);
        let moved = if from.is_nan() {
            shift
        } else {
            shift - plain.shift.at(from)
        };
        let stiffness = plain.tangential_modulus;
        let most = |g: f64| plain.friction * plain.modulus * (depth - g).max(0.0) / stiffness;
        let springs: Vec<f64> = springs
            .iter()
            .zip(&g)
            .map(|(u, &g)| (u + moved).clamp(-most(g), most(g)))
            .collect();
        let loads: Vec<f64> = springs.iter().map(|u| stiffness * u).collect();
        let surface = Operators::of(&operators.displacement, &springs);
        let sum = |of: &dyn Fn(f64) -> f64| {
            let cell = |pair: &[f64]| 0.5 * (of(pair[0]) + of(pair[1]));
            2.0 * step * springs.windows(2).map(cell).sum::<f64>()
        };
        Self {
            stress: Operators::of(&operators.stress, &loads),
            slip: surface.iter().map(|u| shift - u).collect(),
            force: sum(&|u| stiffness * u),
            stored: 0.5 * sum(&|u| stiffness * u * u),
            springs,
        }
    }
}
