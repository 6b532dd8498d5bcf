//! Changes on the way: another value, method or law for the run, or another scenario in its place.

use std::sync::Arc;

use super::Worker;
use crate::math::abel::AbelMethod;
use crate::scenario::Scenario;
use crate::scenario::accuracy;
use crate::scenario::parameters::{Kind, find};
use crate::scenario::session::Session;
use crate::simulation::Integrator;
use crate::tui::frame::Activity;
use crate::tui::past::Past;
use crate::tui::settings::Setting;
use crate::tui::theory::Theory;
use crate::tui::trend::Trend;

/// Laws that keys step through.
const LAWS: [&str; 2] = ["archard", "power"];

impl Worker {
    /// The transform method so many places after the present one.
    pub(super) fn change_method(&mut self, places: isize) {
        let now = self.session.simulation().setup().method;
        let method = shifted(&AbelMethod::ALL, |method| *method == now, places);
        self.change("numerics.method", method.name());
    }

    /// The wear law so many places after the present one.
    pub(super) fn change_law(&mut self, places: isize) {
        match self.session.simulation().setup().wear {
            None => self.notice("this scenario has no wear: there is no law to change"),
            Some(now) => {
                let law = shifted(&LAWS, |law| *law == now.name(), places);
                self.change("wear.law", law);
            }
        }
    }

    /// Goes along the front of speed and accuracy, from where the present numerics stand on it.
    pub(super) fn refine(&mut self, places: isize) {
        let scenario = self.session.scenario();
        let now = scenario.present_accuracy();
        let next = accuracy::rung(now, places);
        if scenario.value("numerics.accuracy").is_some() && next == now {
            let end = if places > 0 { "finest" } else { "coarsest" };
            return self.notice(&format!("{next:e} is the {end} accuracy there is"));
        }
        self.change("numerics.accuracy", &format!("{next:e}"));
        let setup = self.session.scenario().setup();
        if self.session.scenario().expected_error() == Some(next) {
            let jumps = match setup.integrator {
                Integrator::Direct => String::new(),
                Integrator::CycleJump { tolerance } => format!(", jumps to {tolerance:.0e}"),
            };
            self.notice(&format!(
                "expected error {next:e} of the depth: N = {}, {} steps a cycle{jumps}",
                setup.grid.cells(),
                setup.steps_per_cycle
            ));
        }
    }

    /// Another value for a key, from here on.
    pub(super) fn change(&mut self, key: &str, value: &str) {
        self.keep();
        let quoted = format!("\"{value}\"");
        let is_word = find(key).is_some_and(|known| matches!(known.kind, Kind::Choice(_)));
        match self
            .session
            .change(key, if is_word { &quoted } else { value })
        {
            Ok(()) => {
                self.branch();
                self.learn();
                if matches!(self.activity, Activity::Stopped(_)) {
                    self.activity = Activity::Paused;
                }
                let cycle = self.session.simulation().cycle();
                self.notice(&format!("{key} = {value} from cycle {cycle:.2} on"));
            }
            Err(error) => self.notice(&error.to_string()),
        }
    }

    /// What follows from the scenario as it is now.
    pub(super) fn learn(&mut self) {
        self.theory = Arc::new(Theory::of(self.session.simulation().setup()));
        self.settings = Arc::new(Setting::all(self.session.scenario()));
    }

    /// Another scenario, from its beginning.
    pub(super) fn load(&mut self, scenario: Scenario) {
        match Session::start(scenario) {
            Ok(session) => {
                if let Some(keeping) = &mut self.keeping {
                    keeping.turn_over(self.past.line(&self.session), &session);
                }
                self.session = session;
                self.rival = None;
                self.past = Past::default();
                self.whole_trend = None;
                self.learn();
                self.trend = Trend::default();
                self.trend.record(&self.session.simulation().moment());
                if self.activity != Activity::Running {
                    self.activity = Activity::Paused;
                }
            }
            Err(error) => self.notice(&error.to_string()),
        }
    }
}

/// The element so many places after the one that is `now`, around the ends.
fn shifted<T: Copy>(all: &[T], now: impl Fn(&T) -> bool, places: isize) -> T {
    let at = all.iter().position(now).unwrap_or(0) as isize;
    all[(at + places).rem_euclid(all.len() as isize) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn methods_go_around() {
        assert_eq!(shifted(&[1, 2, 3], |n| *n == 3, 1), 1);
        assert_eq!(shifted(&[1, 2, 3], |n| *n == 1, -1), 3);
    }
}
