//! One step and a whole run.
//!
//! `cargo bench --bench stepping`

use divan::Bencher;
use mdr_tui::scenario::Scenario;
use mdr_tui::simulation::Simulation;

fn main() {
    divan::main();
}

fn fig3(method: &str, cells: usize) -> Simulation {
    let scenario = Scenario::load("li2019-fig3", &[])
        .and_then(|scenario| {
            let points = cells.to_string();
            scenario.assigned(&[
                ("numerics.points", points.as_str()),
                ("numerics.method", method),
            ])
        })
        .expect("the preset");
    Simulation::new(scenario.setup().clone()).expect("a contact")
}

/// A step of the Fig. 3 scenario after its transient, at most 100 cycles on.
#[divan::bench(args = [100, 200, 400, 1000, 4000, 16_000, 100_000], max_time = 3)]
fn step(bencher: Bencher, cells: usize) {
    let mut simulation = fig3("product", cells);
    for _ in 0..30 {
        simulation.step().expect("a step");
    }
    bencher.bench_local(move || simulation.step());
}

/// 200 cycles of the Fig. 3 scenario, 100 steps each.
#[divan::bench(args = ["product", "a"], sample_count = 5)]
fn fig3_run(bencher: Bencher, method: &str) {
    bencher
        .with_inputs(|| fig3(method, 100))
        .bench_local_values(|mut simulation| {
            simulation.advance_to(200.0).expect("a run");
            simulation
        });
}
