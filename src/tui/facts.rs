//! What is known of a run before it is run: it changes with the scenario alone.

use std::sync::Arc;

use super::settings::Setting;
use crate::reading::Passed;
use crate::scenario::Scenario;
use crate::scenario::session::Session;
use crate::studies::theory::Theory;

/// The present scenario in numbers and words.
#[derive(Debug, Clone)]
pub struct Facts {
    /// The scenario that the run follows now.
    pub scenario: Scenario,
    /// Where the scenario's plan ends, cycles.
    pub planned_cycles: Option<f64>,
    /// About the deepest wear at the planned end of the scenario as it was loaded, m; 0 where it is not known. An
    /// edit does not change it: wear is drawn by one factor from the start of a run to its end.
    pub expected_wear: f64,
    /// The keys that can be changed, with their values.
    pub settings: Vec<Setting>,
    /// Where the scenario leaves the theory.
    pub warnings: Vec<String>,
    /// What the warnings say of the hardness, which any step may pass.
    pub passed_hardness: Option<Passed>,
    /// Closed forms for the scenario.
    pub theory: Arc<Theory>,
}

impl Facts {
    /// Those of the scenario that `session` runs now.
    pub fn of(session: &Session) -> Arc<Self> {
        let scenario = session.scenario();
        let planned_cycles = session.loaded().run().cycles;
        let loaded = session.loaded().setup();
        let expected_wear = Theory::of(loaded).expected_wear(loaded, planned_cycles);
        Arc::new(Self {
            scenario: scenario.clone(),
            planned_cycles,
            expected_wear: expected_wear.unwrap_or(0.0),
            settings: Setting::all(scenario),
            warnings: session.warnings(),
            passed_hardness: session.log().passed_hardness(),
            theory: Arc::new(Theory::of(session.simulation().setup())),
        })
    }
}
