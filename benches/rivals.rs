//! What `benches/compare.py` compares with other programs, as lines `name,n,seconds`; lower deciles.
//!
//! `cargo bench --bench rivals`: transforms in their forms, nalgebra's matrix–vector product on the same
//! weights, the formulas of the paper evaluated on the fly, and the run of the paper's Fig. 3, also with
//! those formulas.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};
use std::hint::black_box;
use std::time::{Duration, Instant};

use mdr_tui::math::abel::{AbelMethod, AbelPlan, fast, product};
use mdr_tui::math::grid::RadialGrid;
use mdr_tui::scenario::Scenario;
use mdr_tui::simulation::Simulation;
use nalgebra::DVector;

/// Time spent on a number at least, and repetitions at least.
const ENOUGH: Duration = Duration::from_millis(200);
const FEWEST: usize = 5;

/// How often each size has its turn.
const TURNS: usize = 20;

fn report(name: &str, n: usize, mut run: impl FnMut()) {
    run();
    let (begin, mut times) = (Instant::now(), Vec::new());
    while begin.elapsed() < ENOUGH || times.len() < FEWEST {
        let start = Instant::now();
        run();
        times.push(start.elapsed());
    }
    report_decile(name, n, times);
}

fn report_decile(name: &str, n: usize, mut times: Vec<Duration>) {
    times.sort();
    report_once(name, n, times[times.len() / 10]);
}

fn main() {
    for cells in [100, 300, 1000, 3000, 10_000, 30_000, 100_000] {
        transforms(cells);
    }
    for method in ["product", "a"] {
        let scenario = Scenario::load("li2019-fig3", &[])
            .and_then(|scenario| scenario.assigned(&[("numerics.method", method)]))
            .expect("the preset");
        report(&format!("fig3 {method}"), 100, || {
            let mut simulation = Simulation::new(scenario.setup().clone()).expect("a contact");
            simulation.advance_to(200.0).expect("a run");
            black_box(simulation.wear_volume());
        });
    }
    steps(&[100, 1000, 3000, 10_000, 30_000, 100_000]);
    let mut literal = Literal::fig3();
    let start = Instant::now();
    for step in 1..=20_000 {
        literal.step(step);
    }
    black_box(&literal.f);
    report_once("fig3 literal", 100, start.elapsed());
}

/// A step of Fig. 3 on so many cells, turn by turn: what else runs on the machine hits all sizes alike.
fn steps(sizes: &[usize]) {
    let simulation = |cells: &usize| {
        let points = cells.to_string();
        let scenario = Scenario::load("li2019-fig3", &[])
            .and_then(|scenario| scenario.assigned(&[("numerics.points", &points)]))
            // So mild that no step is taken in parts: on 100 000 cells they would be.
            .and_then(|scenario| scenario.assigned(&[("wear.coefficient", "1.3e-13")]))
            .expect("the preset");
        Simulation::new(scenario.setup().clone()).expect("a contact")
    };
    let mut runs: Vec<_> = sizes
        .iter()
        .map(|cells| (simulation(cells), Vec::new()))
        .collect();
    for _ in 0..TURNS {
        for (simulation, times) in &mut runs {
            // The first ones fetch the run back into the caches.
            for _ in 0..3 {
                simulation.step().expect("a step");
            }
            let begin = Instant::now();
            while begin.elapsed() < ENOUGH / 4 {
                let start = Instant::now();
                simulation.step().expect("a step");
                times.push(start.elapsed());
            }
        }
    }
    for (cells, (_, times)) in sizes.iter().zip(runs) {
        report_decile("step", *cells, times);
    }
}

#[allow(clippy::print_stdout, reason = "a program whose output is its result")]
fn report_once(name: &str, n: usize, time: Duration) {
    println!("{name},{n},{:e}", time.as_secs_f64());
}

/// Eq. (3) of a smooth load; Eqs. (1) and (2) cost the same to within a few per cent.
fn transforms(cells: usize) {
    let uniform = RadialGrid::uniform(cells, 1.0).expect("a grid");
    let graded = RadialGrid::graded(cells, 0.4, 1.0).expect("a grid");
    let mut p = vec![0.0; uniform.len()];
    for (name, grid) in [("uniform", &uniform), ("graded", &graded)] {
        let q: Vec<f64> = grid.squares().iter().map(|t| (1.0 - t).powi(3)).collect();
        let plan = AbelPlan::fast(grid, fast::TOLERANCE).expect("a plan");
        report(&format!("fast {name}"), cells, || {
            plan.stress(black_box(&q), black_box(&mut p));
        });
        if cells > 3000 {
            continue;
        }
        let exact = AbelPlan::dense(AbelMethod::Product, grid);
        report(&format!("dense {name}"), cells, || {
            exact.stress(black_box(&q), black_box(&mut p));
        });
    }
    if cells > 3000 {
        return;
    }
    let q: Vec<f64> = uniform
        .squares()
        .iter()
        .map(|t| (1.0 - t).powi(3))
        .collect();
    let matrix = product::stress(uniform.nodes());
    let (q_vector, mut p_vector) = (DVector::from_column_slice(&q), DVector::zeros(q.len()));
    report("nalgebra", cells, || {
        p_vector.gemv(1.0, black_box(&matrix), black_box(&q_vector), 0.0);
        black_box(&mut p_vector);
    });
    report("literal", cells, || {
        literal_stress(uniform.nodes(), black_box(&q), black_box(&mut p));
    });
}

/// Eq. (3), Benad's form, as printed: one inverse hyperbolic cosine a pair of nodes and end.
fn literal_stress(x: &[f64], q: &[f64], p: &mut [f64]) {
    let last = x.len() - 1;
    for (j, p) in p.iter_mut().enumerate() {
        let mut sum = 0.0;
        for k in j..last {
            let slope = (q[k + 1] - q[k]) / (x[k + 1] - x[k]);
            let step = if j == 0 {
                if k == 0 { 2.0 } else { (x[k + 1] / x[k]).ln() }
            } else {
                (x[k + 1] / x[j]).acosh() - (x[k] / x[j]).acosh()
            };
            sum += slope * step;
        }
        *p = -FRAC_1_PI * sum;
    }
}

/// Eq. (1), Benad's form.
fn literal_profile(x: &[f64], f: &[f64], g: &mut [f64]) {
    for (j, g) in g.iter_mut().enumerate() {
        let mut sum = 0.0;
        for k in 0..j {
            let slope = (f[k + 1] - f[k]) / (x[k + 1] - x[k]);
            sum += slope * ((x[k + 1] / x[j]).asin() - (x[k] / x[j]).asin());
        }
        *g = f[0] + x[j] * sum;
    }
}

/// Eq. (7).
fn literal_displacement(x: &[f64], u: &[f64], w: &mut [f64]) {
    w[0] = u[0];
    for j in 1..x.len() {
        let mut sum = 0.0;
        for k in 0..j {
            let slope = (u[k + 1] - u[k]) / (x[k + 1] - x[k]);
            let root = |x: f64, r: f64| (r * r - x * x).max(0.0).sqrt();
            sum += slope * (root(x[k], x[j]) - root(x[k + 1], x[j]))
                + (u[k] - slope * x[k]) * ((x[k + 1] / x[j]).asin() - (x[k] / x[j]).asin());
        }
        w[j] = FRAC_2_PI * sum;
    }
}

/// The paper's loop with Method A, explicit Euler and the formulas on the fly; SI values of the preset.
struct Literal {
    x: Vec<f64>,
    f: Vec<f64>,
    g: Vec<f64>,
    spring: Vec<f64>,
    load: Vec<f64>,
    shear: Vec<f64>,
    before: Vec<f64>,
    slip: Vec<f64>,
    shift: f64,
}

impl Literal {
    fn fig3() -> Self {
        let (cells, radius): (usize, f64) = (100, (0.01_f64 * 1.1e-6).sqrt() * 2.0_f64.sqrt());
        let x: Vec<f64> = (0..=cells)
            .map(|i| radius * i as f64 / cells as f64)
            .collect();
        let zeros = vec![0.0; x.len()];
        Self {
            f: x.iter().map(|r| r * r / 0.02).collect(),
            g: zeros.clone(),
            spring: zeros.clone(),
            load: zeros.clone(),
            shear: zeros.clone(),
            before: zeros.clone(),
            slip: zeros,
            shift: 0.0,
            x,
        }
    }

    fn step(&mut self, step: usize) {
        const NORMAL: f64 = 2.3077e11;
        const TANGENTIAL: f64 = NORMAL * 2.0 * (1.0 - 0.3) / (2.0 - 0.3);
        const FRICTION: f64 = 0.1;
        const WEAR: f64 = 1.3e-10;
        let angle = std::f64::consts::TAU * step as f64 / 100.0;
        let depth = 1e-6 + 1e-7 * angle.sin();
        let shift = 1e-7 * (angle + std::f64::consts::FRAC_PI_4).sin();
        let increment = shift - self.shift;
        self.shift = shift;
        literal_profile(&self.x, &self.f, &mut self.g);
        for k in 0..self.x.len() {
            let limit = FRICTION * NORMAL * (depth - self.g[k]).max(0.0) / TANGENTIAL;
            let predicted = self.spring[k] + increment;
            let after = if limit > 0.0 {
                predicted.clamp(-limit, limit)
            } else {
                0.0
            };
            self.slip[k] = increment - (after - self.spring[k]);
            self.spring[k] = after;
            self.load[k] = TANGENTIAL * after;
        }
        literal_stress(&self.x, &self.load, &mut self.shear);
        literal_displacement(&self.x, &self.slip, &mut self.before);
        for ((f, shear), slip) in self.f.iter_mut().zip(&self.shear).zip(&self.before) {
            *f += WEAR * (shear * slip).max(0.0);
        }
    }
}
