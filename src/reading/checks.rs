//! The checks of a run. Most compare two independent ways to
//! compute the same number; one compares the cells with the scar.
//!
//! One list serves the status line, the accuracy panel, the header of every file and the end of a run. The guide's
//! chapter on checks, which the panel also shows, explains each.

use super::Log;
use crate::math::abel::worn;
use crate::math::scan::largest;
use crate::simulation::{Simulation, Unworn};

/// The guide's chapter, with one section per check.
const GUIDE: &str = include_str!("../guide/checks.md");

/// A larger difference fails the check.
const FAILS: f64 = 0.015;

/// Typical ratio of a run's error to the interpolation error of its last profile: the median over 256 random scenarios
/// is 4.6.
const OVER_RUN: f64 = 4.0;

/// Subject of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CheckSubject {
    /// V against k E_d since the start.
    Energy,
    /// The interpolation error of the worn depth on its cells.
    Interpolation,
    /// F_x against the closed form, if nothing wears.
    TangentialForce,
    /// E_d per cycle against the closed form, if nothing wears.
    Dissipation,
    /// The most negative p against the largest: no contact pulls.
    Tension,
}

impl CheckSubject {
    /// Returns the name in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Energy => "energy",
            Self::Interpolation => "interpolation",
            Self::TangentialForce => "tangential force",
            Self::Dissipation => "dissipation",
            Self::Tension => "tension",
        }
    }

    /// Says in one line what is compared.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Energy => "V of the profile against k E_d since the start",
            Self::Interpolation => "curvature of the worn depth against the widths of the cells",
            Self::TangentialForce => "F_x against the closed form (Mindlin)",
            Self::Dissipation => "E_d of a cycle against the closed form (Mindlin)",
            Self::Tension => "the most negative p against the largest",
        }
    }

    /// Explains in two sentences of the guide what is compared and what a difference means.
    pub fn explanation(self) -> &'static str {
        let heading = format!("## {}\n", self.name());
        let after = GUIDE
            .split_once(heading.as_str())
            .map_or("", |(_, text)| text);
        after.split("\n## ").next().unwrap_or_default().trim()
    }
}

/// A check and the difference between its two sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Check {
    /// What is compared.
    pub subject: CheckSubject,
    /// Relative difference, signed.
    pub error: f64,
}

impl Check {
    /// Whether both sides agree closely enough.
    pub fn holds(&self) -> bool {
        self.error.abs() <= FAILS
    }

    /// Describes the difference, such as `energy off by 2 %`.
    pub fn complaint(&self) -> String {
        let (name, percent) = (self.subject.name(), 100.0 * self.error.abs());
        if !percent.is_finite() {
            return format!("{name} is not finite");
        }
        let percent = match percent {
            p if p < 9.95 => format!("{p:.1} %"),
            p if p < 1000.0 => format!("{p:.0} %"),
            _ => "more than 1000 %".to_owned(),
        };
        match self.subject {
            CheckSubject::Tension => format!("p below zero by {percent}"),
            _ => format!("{name} off by {percent}"),
        }
    }
}

/// Returns `checks ok`, or the worst of the `checks` that fail; `None` before there is any check.
pub fn verdict(checks: &[Check]) -> Option<String> {
    // NaN counts as the worst.
    let worst = checks
        .iter()
        .max_by(|a, b| a.error.abs().total_cmp(&b.error.abs()))?;
    Some(if worst.holds() {
        "checks ok".into()
    } else {
        worst.complaint()
    })
}

impl Simulation {
    /// Returns all checks available at the present moment, using the log of the run.
    pub fn checks(&self, log: &Log) -> Vec<Check> {
        let moment = self.moment();
        let mut checks = Vec::new();
        let mut add = |subject, error: Option<f64>| {
            checks.extend(error.map(|error| Check { subject, error }));
        };
        add(CheckSubject::Energy, moment.energy_residual);
        // A limit of the method; a run within it has nothing to report.
        add(
            CheckSubject::Tension,
            self.tension().filter(|tension| *tension < -FAILS),
        );
        let period = f64::from(self.setup().drive.cycles_to_settle());
        // Within the first period the scar has edges that the rest of the period wears away.
        if moment.cycle >= period {
            let left_out = worn::interpolation_error(&self.setup().grid, self.worn_depth());
            add(
                CheckSubject::Interpolation,
                left_out.map(|error| OVER_RUN * error),
            );
        }
        if moment.cycle >= 2.0 * period {
            let [force, energy] = self
                .closed_forms(log)
                .map_or([None; 2], |both| both.map(Some));
            add(CheckSubject::TangentialForce, force);
            add(CheckSubject::Dissipation, energy);
        }
        checks
    }

    /// Returns the most negative p relative to the largest; `None` without contact.
    fn tension(&self) -> Option<f64> {
        let pressure = self.pressure();
        let most = largest(&pressure);
        (most > 0.0).then(|| pressure.iter().fold(0.0, |least: f64, &p| least.min(p)) / most)
    }

    /// Returns F_x and E_d of the last period, divided by the
    /// closed forms of a held load, minus 1; only if nothing wears.
    fn closed_forms(&self, log: &Log) -> Option<[f64; 2]> {
        let worn = self.setup().wear.is_some_and(|law| law.coefficient() > 0.0);
        if worn || self.state().wear.iter().any(|&worn| worn > 0.0) {
            return None;
        }
        let figures = log.stepped_figures()?;
        let ring = Unworn::new(self.setup()).ring()?;
        let of = |seen: f64, due: f64| seen / due - 1.0;
        let both = [
            of(figures.force_amplitude, ring.force),
            of(figures.energy, ring.energy),
        ];
        both.iter().all(|error| error.is_finite()).then_some(both)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_certificate_is_explained_in_two_sentences() {
        for subject in [
            CheckSubject::Energy,
            CheckSubject::Interpolation,
            CheckSubject::TangentialForce,
            CheckSubject::Dissipation,
            CheckSubject::Tension,
        ] {
            let text = subject.explanation();
            assert_eq!(text.matches(". ").count() + 1, 2, "{subject:?}: {text}");
            assert!(text.ends_with('.'), "{subject:?}: {text}");
        }
    }

    #[test]
    fn the_verdict_names_the_worst() {
        let check = |subject, error| Check { subject, error };
        assert_eq!(verdict(&[]), None);
        let good = [
            check(CheckSubject::Energy, 1e-3),
            check(CheckSubject::Dissipation, -9e-3),
        ];
        assert_eq!(verdict(&good).as_deref(), Some("checks ok"));
        let bad = [
            check(CheckSubject::Energy, 0.02),
            check(CheckSubject::TangentialForce, -0.07),
        ];
        assert_eq!(
            verdict(&bad).as_deref(),
            Some("tangential force off by 7.0 %")
        );
        let broken = [
            check(CheckSubject::Dissipation, 9.0),
            check(CheckSubject::Energy, f64::NAN),
        ];
        assert_eq!(verdict(&broken).as_deref(), Some("energy is not finite"));
    }
}
