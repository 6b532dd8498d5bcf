//! What is known of a run before it is run: it changes with the scenario alone.

use std::sync::Arc;

use super::settings::Setting;
use crate::contact::indenter::Indenter;
use crate::reading::Passed;
use crate::scenario::session::Session;
use crate::studies::theory::Theory;

/// The present scenario in numbers and words.
#[derive(Debug, Clone)]
pub struct Facts {
    /// The scenario's title.
    pub title: String,
    /// The preset's name or the file.
    pub origin: String,
    /// Where the scenario's plan ends, cycles.
    pub planned_cycles: Option<f64>,
    /// About the deepest wear at the planned end of the scenario as it was loaded, m; 0 where it is not known. An
    /// edit does not change it: wear is drawn by one factor from the start of a run to its end.
    pub expected_wear: f64,
    /// Steps per cycle.
    pub steps_per_cycle: u32,
    /// The keys that can be changed, with their values.
    pub settings: Vec<Setting>,
    /// The unworn shape, also beyond the domain.
    pub indenter: Indenter,
    /// The wear coefficient k, 1/Pa; `None` without wear.
    pub wear_coefficient: Option<f64>,
    /// The indenter's share of the wear, where the scenario gives one.
    pub wear_share: Option<f64>,
    /// μ, for the scale of τ.
    pub friction: f64,
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
        let (scenario, simulation) = (session.scenario(), session.simulation());
        let setup = simulation.setup();
        let planned_cycles = session.loaded().run().cycles;
        let theory = Theory::of(setup);
        let loaded = session.loaded().setup();
        let expected_wear = Theory::of(loaded).expected_wear(loaded, planned_cycles);
        Arc::new(Self {
            title: scenario.title().to_owned(),
            origin: scenario.origin().to_owned(),
            planned_cycles,
            expected_wear: expected_wear.unwrap_or(0.0),
            steps_per_cycle: setup.steps_in_a_cycle() as u32,
            settings: Setting::all(scenario),
            indenter: setup.indenter.clone(),
            wear_coefficient: setup.wear.map(|law| law.coefficient()),
            wear_share: scenario.wear_share(),
            friction: setup.material.friction(),
            warnings: session.warnings(),
            passed_hardness: session.log().passed_hardness(),
            theory: Arc::new(theory),
        })
    }
}
