//! Observed order of convergence of the time stepping.

use crate::common::{Scene, apart, holds, run};

/// The Fig. 3 motion at K = 1 over 20 cycles: the change when the step is halved halves too.
#[test]
fn explicit_stepping_is_of_first_order() {
    let worn = |steps| {
        let simulation = run(Scene::fig3(1.0).steps(steps), 20.0);
        simulation.state().wear.clone()
    };
    let ladder = [100, 200, 400, 800, 1600].map(worn);
    let changes = ladder.windows(2).map(|pair| apart(&pair[0], &pair[1]));
    let changes: Vec<f64> = changes.collect();
    // Measured 1.0e-4, 5.1e-5, 2.5e-5, 1.3e-5 of d: 0.0195/steps to 0.0202/steps.
    for (change, steps) in changes.iter().zip([100.0, 200.0, 400.0, 800.0]) {
        holds(format!("change from {steps} steps"), *change, 0.025 / steps);
    }
    for pair in changes.windows(2) {
        let observed = (pair[0] / pair[1]).log2();
        holds(format!("order {observed:.3}"), (observed - 1.0).abs(), 0.12);
    }
}
