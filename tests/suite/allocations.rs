//! A step allocates nothing, once its buffers have grown.

use mdr_tui::scenario::Scenario;
use mdr_tui::simulation::Simulation;

/// The scenario, changes to it, and whether its steps are stiff.
const CASES: [(&str, &[&str], bool); 8] = [
    ("li2019-fig3", &[], false),
    ("li2019-fig3", &["numerics.method=a"], false),
    ("li2019-fig3", &["numerics.points=400"], false),
    ("cone", &[], false),
    ("separation", &[], false),
    ("two-frequencies", &[], false),
    // In stages, and in sub-steps.
    ("li2019-fig3", &["wear.coefficient=1e-8"], true),
    ("gross-slip", &["wear.coefficient=5e-9"], true),
];

#[test]
fn a_step_allocates_nothing() {
    for (name, changes, is_stiff) in CASES {
        let owned: Vec<String> = changes.iter().map(|&change| change.to_owned()).collect();
        let scenario = Scenario::load(name, &owned).expect("a preset");
        let mut simulation = Simulation::new(scenario.setup().clone()).expect("a simulation");
        simulation.advance_to(6.0).expect("six cycles");
        let parts = simulation.stats().parts;
        let counted = allocation_counter::measure(|| {
            simulation.advance_to(7.0).expect("a cycle");
        });
        let parts = simulation.stats().parts - parts;
        assert_eq!(parts > 0, is_stiff, "{name} {changes:?}: {parts} sub-steps");
        assert_eq!(counted.count_total, 0, "{name} {changes:?}");
    }
}
