//! Line contacts against their closed forms, and against a boundary-element code that knows no springs.

use std::f64::consts::PI;

use crate::closed_forms::line_contact::Cylinder;
use mdr_tui::math::scan::largest;
use mdr_tui::reading::Curves;
use mdr_tui::scenario::Scenario;
use mdr_tui::simulation::Simulation;
use nalgebra::{DMatrix, DVector};

use crate::random_scenarios::{self, LINES};

/// E* = R = a₀ = 1.
const CYLINDER: Cylinder = Cylinder {
    e_star: 1.0,
    radius: 1.0,
    friction: 0.5,
    load: PI / 4.0,
};

/// A line of two metres, in units in which the pressure of the cylinder is ½√(1 − x²).
const TEXT: &str = r#"
[indenter]
geometry = "line"
length = 2.0
shape = "power"
coefficient = 0.5
exponent = 2.0
[material]
effective_modulus = 1.0
poisson = 0.3
[friction]
coefficient = 0.5
[motion.normal]
control = "force"
mean = 1.5707963267948966
[motion.tangential]
control = "force"
amplitude = 0.4
angular_frequency = 1.0
[numerics]
points = 100
steps_per_cycle = 80
"#;

/// Q/L of [`TEXT`].
const FORCE: f64 = 0.2;

/// The simulation at a cycle.
fn run<S: ToString>(sets: &[S], cycles: f64) -> Simulation {
    let sets: Vec<String> = sets.iter().map(S::to_string).collect();
    let scenario = Scenario::from_toml(TEXT, "line.toml", &sets).expect("a scenario");
    let mut run = Simulation::new(scenario.setup().clone()).expect("a run");
    run.advance_to(cycles).expect("a result");
    run
}

fn is_near(found: f64, due: f64, error: f64) {
    assert!((found / due - 1.0).abs() < error, "{found:e} {due:e}");
}

/// Checks a value at some place within an absolute error.
fn is_at(found: f64, due: f64, error: f64, place: f64) {
    assert!((found - due).abs() < error, "{place}: {found:e} {due:e}");
}

#[test]
fn hertz_and_cattaneo_are_exact() {
    let run = run::<&str>(&[], 0.25);
    let (moment, seen) = (run.moment(), run.observe(Curves::all()));
    is_near(moment.contact_radius, 1.0, 1e-13);
    is_near(moment.normal_force, 2.0 * CYLINDER.load, 1e-14);
    is_near(moment.tangential_force, 2.0 * FORCE, 1e-14);
    is_near(
        moment.stick_radius.expect("c"),
        CYLINDER.stick_half_width(FORCE),
        1e-12,
    );
    let gauge = run.setup().drive.gauge_length().expect("a gauge");
    is_near(moment.shift, CYLINDER.shift(FORCE, gauge), 1e-10);
    assert!(run.force_residual(seen.pressure()).expect("a load").abs() < 1e-3);
    for (j, &x) in seen.radii().iter().enumerate() {
        is_at(seen.pressure()[j], CYLINDER.pressure(1.0, x), 1e-13, x);
        is_at(seen.shear()[j], CYLINDER.shear(FORCE, x), 1e-13, x);
        if x <= 1.0 {
            let slip = seen.spring()[0] - seen.surface()[j];
            is_at(slip, CYLINDER.slip(FORCE, x), 1e-13, x);
        }
    }
}

/// The pressure of a tip f = x⁴/4 is ¼(1 + 2x²)√(1 − x²), a = 1 under P = 3π/16; a wedge has p = (E*/π) tan θ arcosh(a/x).
#[test]
fn other_sections_press_as_they_should() {
    let quartic = run(
        &[
            "indenter.exponent=4",
            "indenter.coefficient=0.25",
            "motion.normal.mean=1.1780972450961724",
            "numerics.points=400",
        ],
        0.0,
    );
    is_near(quartic.moment().contact_radius, 1.0, 1e-5);
    for (&x, p) in quartic.setup().grid.nodes().iter().zip(quartic.pressure()) {
        let exact = 0.25 * (1.0 + 2.0 * x * x) * (1.0 - x * x).max(0.0).sqrt();
        is_at(p, exact, 1e-4, x);
    }
    let wedge = run(
        &[
            "indenter.shape=cone",
            "indenter.angle=0.01",
            "motion.normal.mean=0.02",
        ],
        0.0,
    );
    let slope = 0.01_f64.tan();
    is_near(wedge.moment().contact_radius, 0.01 / slope, 1e-6);
    let nodes = wedge.setup().grid.nodes();
    for (x, p) in nodes.iter().zip(wedge.pressure()).skip(10).take(40) {
        is_near(p, slope / PI * (0.01 / slope / x).acosh(), 5e-3);
    }
    let punch = run(&["indenter.shape=flat-punch", "indenter.radius=1.0"], 0.0);
    let nodes = punch.setup().grid.nodes();
    for (x, p) in nodes.iter().zip(punch.pressure()).take(90) {
        is_near(p, CYLINDER.load / (PI * (1.0 - x * x).sqrt()), 1e-12);
    }
}

#[test]
fn a_cycle_dissipates_what_the_closed_form_says_and_the_area_of_its_loop() {
    let mut run = run(&["numerics.points=400"], 1.0);
    let before = run.moment();
    let (mut area, mut last) = (0.0, before);
    while run.cycle() < 2.0 {
        run.step().expect("a step");
        let now = run.moment();
        area += 0.5 * (now.tangential_force + last.tangential_force) * (now.shift - last.shift);
        last = now;
    }
    let energy = last.dissipated_energy - before.dissipated_energy;
    is_near(energy, 2.0 * CYLINDER.energy_per_cycle(FORCE), 1e-4);
    is_near(area, energy, 5e-3);
}

/// Q/(μP) at the lowest of P + Q/μ and of P − Q/μ, half a cycle apart.
#[test]
fn the_permanent_stick_zone_is_melans_under_a_load_that_moves() {
    for phase in [0.0, 1.0] {
        let phase_set = format!("motion.tangential.phase={phase}");
        let run = run(
            &[
                "motion.normal.amplitude=0.2",
                "motion.normal.angular_frequency=1.0",
                "motion.tangential.amplitude=0.25",
                &phase_set,
                "wear.coefficient=0.01",
                "numerics.integrator=direct",
            ],
            6.0,
        );
        let swing = |sign: f64| {
            let (sine, cosine) = f64::sin_cos(phase);
            (0.1 + sign * 0.25 * cosine).hypot(sign * 0.25 * sine)
        };
        let share = (CYLINDER.load - 0.5 * (swing(1.0) + swing(-1.0))) / CYLINDER.load;
        let stick = run.moment().permanent_stick_radius.expect("a zone");
        is_near(stick, share.sqrt(), 1e-3);
    }
}

#[test]
fn partial_slip_wears_to_its_limit() {
    let run = run(
        &[
            "wear.coefficient=1.0",
            "numerics.integrator=cycle-jump",
            "numerics.tolerance=1e-4",
            "numerics.points=200",
        ],
        20_000.0,
    );
    let c = CYLINDER.stick_half_width(FORCE);
    let deepest = largest(run.worn_depth());
    let grid = &run.setup().grid;
    let (mut sum, mut length) = (0.0, 0.0);
    for ((&x, worn), width) in grid.nodes().iter().zip(run.worn_depth()).zip(grid.widths()) {
        sum += width * (worn - CYLINDER.limit_depth(c, x)).powi(2);
        length += if *worn > 0.0 { width } else { 0.0 };
    }
    let rms = (sum / length).sqrt() / deepest;
    assert!(rms < 1e-2, "{rms:e}");
    is_near(run.wear_volume(), 2.0 * CYLINDER.limit_volume(c), 1e-2);
    assert!(run.moment().energy_residual.expect("wear").abs() < 1e-2);
}

/// Against a point at the depth of 10 half-widths, on a rig or stiff: the border of gross slip, and how the volume and
/// the half-width belong together beyond it.
#[test]
fn gross_slip_begins_and_wears_as_it_should() {
    let limit = CYLINDER.friction * CYLINDER.load;
    for stiffness in [f64::INFINITY, 2.0] {
        let border = CYLINDER.shift(limit, 10.0) + 2.0 * limit / stiffness;
        let sets = |share: f64| {
            let mut sets = vec![
                "motion.tangential.control=displacement".to_owned(),
                "motion.tangential.gauge_length=10.0".to_owned(),
                format!("motion.tangential.amplitude={}", share * border),
            ];
            if stiffness.is_finite() {
                sets.push(format!("motion.tangential.rig_stiffness={stiffness}"));
            }
            sets
        };
        let at = |share: f64| run(&sets(share), 2.0).moment();
        let (below, beyond) = (at(0.999), at(1.001));
        assert!(below.permanent_stick_radius > Some(0.0));
        assert_eq!(beyond.permanent_stick_radius, Some(0.0));
        let mut sets = sets(1.5);
        sets.extend(["wear.coefficient=0.6", "numerics.integrator=direct"].map(str::to_owned));
        let worn = run(&sets, 12.0).moment();
        assert!(worn.contact_radius > 1.5, "{}", worn.contact_radius);
        let volume = 2.0 * CYLINDER.sliding_volume(worn.contact_radius);
        // b is known to a part of a cell, and its error counts thrice.
        is_near(worn.wear_volume, volume, 4e-2);
        is_near(worn.wear_volume, 0.6 * worn.dissipated_energy, 1e-2);
    }
}

/// On the axis σ_z = −1/s, σ_x = −(1 + 2z²)/s + 2z, s = √(1 + z²), in p₀; under full sliding σ_xx = 2μ(√(x² − 1) − |x|) ahead
/// of the contact, and as much tension behind it.
#[test]
fn stresses_inside_are_those_of_plane_strain() {
    let at_turn = run(
        &[
            "motion.tangential.control=displacement",
            "motion.tangential.gauge_length=10.0",
            "motion.tangential.amplitude=2.0",
        ],
        0.25,
    );
    let load = at_turn.observe(Curves::SPRINGS).spring_load(0.3);
    let peak = 0.5;
    for z in [0.1, 0.5, 0.786, 2.0] {
        let (found, s) = (load.stress(0.0, z), f64::hypot(1.0, z));
        // Of the tangential load, only σ_xz does not vanish there.
        is_at(found.zz / peak, -1.0 / s, 1e-9, z);
        is_at(found.xx / peak, 2.0 * z - (1.0 + 2.0 * z * z) / s, 1e-9, z);
        is_at(found.yy, 0.3 * (found.xx + found.zz), 1e-12, z);
    }
    for x in [-0.6_f64, 0.3, 1.5, -2.0] {
        let normal = -(1.0 - x * x).max(0.0).sqrt();
        let outside = (x * x - 1.0).max(0.0).sqrt();
        let tangential = -(x - outside.copysign(x));
        let found = load.stress(x, 0.0).xx;
        is_at(found / peak, normal + tangential, 1e-6, x);
    }
}

#[test]
fn random_lines_are_scenarios_and_keep_their_energy() {
    for seed in LINES..LINES + 300 {
        let scenario = random_scenarios::scenario(seed);
        assert!(scenario.setup().geometry.is_line());
    }
    for seed in LINES..LINES + 6 {
        let scenario = random_scenarios::scenario(seed);
        let mut run = Simulation::new(scenario.setup().clone()).expect("a run");
        run.advance_to(2.0).expect("two cycles");
        let residual = run.moment().energy_residual.unwrap_or(0.0);
        assert!(residual.abs() < 2e-2, "{seed}: {residual:e}");
    }
}

/// Flamant boundary elements: the pressure and the shear stress of a symmetric strip, constant in each of equal cells.
struct Bem {
    /// Displacements of all cells under a unit stress of each, up to a constant.
    response: DMatrix<f64>,
    x: Vec<f64>,
    h: f64,
}

impl Bem {
    fn new(cells: usize, end: f64) -> Self {
        let h = end / cells as f64;
        let x: Vec<f64> = (0..cells).map(|i| h * (i as f64 + 0.5)).collect();
        let part = |z: f64| z * z.abs().ln() - z;
        let of = |y: f64| part(y + 0.5 * h) - part(y - 0.5 * h);
        let entry = |i: usize, j: usize| -2.0 / PI * (of(x[i] - x[j]) + of(x[i] + x[j]));
        let response = DMatrix::from_fn(cells, cells, entry);
        Self { response, x, h }
    }

    /// Stresses on the cells of `set` alone with the displacement `given` there, up to a constant, and the total `force`.
    fn solve(&self, set: &[usize], given: &[f64], force: f64) -> (Vec<f64>, f64) {
        let n = set.len();
        let matrix = DMatrix::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
            (true, true) => self.response[(set[i], set[j])],
            (true, false) => -1.0,
            (false, true) => 2.0 * self.h,
            (false, false) => 0.0,
        });
        let right = DVector::from_fn(n + 1, |i, _| if i < n { given[set[i]] } else { force });
        let solved = matrix.lu().solve(&right).expect("a solution");
        let mut stress = vec![0.0; self.x.len()];
        set.iter()
            .zip(solved.iter())
            .for_each(|(&i, &value)| stress[i] = value);
        (stress, solved[n])
    }

    fn displacement(&self, stress: &[f64]) -> Vec<f64> {
        (&self.response * DVector::from_column_slice(stress))
            .as_slice()
            .to_vec()
    }

    fn press(&self, f: &[f64], load: f64) -> Vec<f64> {
        let gap: Vec<f64> = f.iter().map(|f| -f).collect();
        let mut set: Vec<usize> = (0..self.x.len() / 2).collect();
        loop {
            let (p, approach) = self.solve(&set, &gap, load);
            let u = self.displacement(&p);
            let touches = |&i: &usize| p[i] > 0.0 || p[i] == 0.0 && u[i] + f[i] < approach - 1e-13;
            let next: Vec<usize> = (0..self.x.len()).filter(touches).collect();
            if next == set {
                return p;
            }
            set = next;
        }
    }

    /// The shear stress under a tangential `force` from `before` on, and the slip.
    fn shift(&self, p: &[f64], before: &[f64], force: f64) -> (Vec<f64>, Vec<f64>) {
        let old = self.displacement(before);
        let mut signs: Vec<f64> = vec![0.0; p.len()];
        loop {
            let fixed: Vec<f64> = signs
                .iter()
                .zip(p)
                .map(|(sign, p)| 0.5 * sign * p)
                .collect();
            let sticks: Vec<usize> = (0..p.len())
                .filter(|&i| p[i] > 0.0 && signs[i] == 0.0)
                .collect();
            let of_fixed = self.displacement(&fixed);
            let given: Vec<f64> = old.iter().zip(&of_fixed).map(|(old, u)| old - u).collect();
            let rest = force - 2.0 * self.h * fixed.iter().sum::<f64>();
            let (stuck, approach) = self.solve(&sticks, &given, rest);
            let tau: Vec<f64> = fixed.iter().zip(&stuck).map(|(a, b)| a + b).collect();
            let now = self.displacement(&tau);
            let slip = |i: usize| approach - (now[i] - old[i]);
            let next = |i: usize| match signs[i] {
                _ if p[i] <= 0.0 => 0.0,
                0.0 if tau[i].abs() > 0.5 * p[i] * (1.0 + 1e-12) => tau[i].signum(),
                sign if slip(i) * sign < -1e-15 => 0.0,
                sign => sign,
            };
            let next: Vec<f64> = (0..p.len()).map(next).collect();
            if next == signs {
                let slips = (0..p.len()).map(|i| if signs[i] == 0.0 { 0.0 } else { slip(i) });
                return (tau, slips.collect());
            }
            signs = next;
        }
    }
}

/// Thirty cycles of wear in partial slip, by both codes.
#[test]
fn boundary_elements_wear_alike() {
    let (k, cycles, steps) = (0.2, 30, 64);
    let bem = Bem::new(100, 1.25);
    let mut f: Vec<f64> = bem.x.iter().map(|x| 0.5 * x * x).collect();
    let (unworn, mut tau) = (f.clone(), vec![0.0; f.len()]);
    for step in 1..=cycles * steps {
        let p = bem.press(&f, CYLINDER.load);
        let force = FORCE * (2.0 * PI * f64::from(step) / f64::from(steps)).sin();
        let (now, slip) = bem.shift(&p, &tau, force);
        for (i, f) in f.iter_mut().enumerate() {
            let mean = if tau[i] * now[i] > 0.0 {
                0.5 * (tau[i] + now[i])
            } else {
                0.5 * now[i]
            };
            *f += k * (mean * slip[i]).max(0.0);
        }
        tau = now;
    }
    let worn: Vec<f64> = f
        .iter()
        .zip(&unworn)
        .map(|(f, unworn)| f - unworn)
        .collect();
    let ours = run(
        &[
            "wear.coefficient=0.2",
            "numerics.integrator=direct",
            "numerics.points=200",
        ],
        f64::from(cycles),
    );
    let volume = 2.0 * 2.0 * bem.h * worn.iter().sum::<f64>();
    let of_volume = (ours.wear_volume() / volume - 1.0).abs();
    let deepest = largest(&worn);
    let errors = bem.x.iter().zip(&worn);
    let errors =
        errors.map(|(&x, worn)| ours.setup().grid.interpolate(ours.worn_depth(), x) - worn);
    let mean = errors.map(|error| error * error).sum::<f64>() / bem.x.len() as f64;
    let rms = mean.sqrt() / deepest;
    assert!(rms < 2e-3 && of_volume < 4e-3, "{rms:e} {of_volume:e}");
}
