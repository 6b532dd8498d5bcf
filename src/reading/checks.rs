//! The checks of a run: each compares two independent ways to compute the same number.
//!
//! One list serves the status line, the accuracy panel, the header of every file and the end of a
//! run. The guide's chapter on checks, which the panel shows too, explains each.

use crate::simulation::{Simulation, Unworn, cycles_to_settle};

/// The guide's chapter: a section a certificate.
const GUIDE: &str = include_str!("../guide/checks.md");

/// Above this difference a check fails.
const FAILS: f64 = 0.015;

/// What a certificate is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Subject {
    /// V against k E_d since the start.
    Energy,
    /// V of the worn profile against that of its 1D image.
    WearBalance,
    /// F_x against the closed form, where nothing wears.
    TangentialForce,
    /// E_d of a cycle against the closed form, where nothing wears.
    Dissipation,
}

impl Subject {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::Energy,
        Self::WearBalance,
        Self::TangentialForce,
        Self::Dissipation,
    ];

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Energy => "energy",
            Self::WearBalance => "wear balance",
            Self::TangentialForce => "tangential force",
            Self::Dissipation => "dissipation",
        }
    }

    /// What is compared, in a line.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Energy => "V of the profile against k E_d since the start",
            Self::WearBalance => "V of the profile against that of its 1D image",
            Self::TangentialForce => "F_x against the closed form (Mindlin)",
            Self::Dissipation => "E_d of a cycle against the closed form (Mindlin)",
        }
    }

    /// What is compared and what a difference means, in two sentences of the guide.
    pub fn explanation(self) -> &'static str {
        let heading = format!("## {}\n", self.name());
        let after = GUIDE
            .split_once(heading.as_str())
            .map_or("", |(_, text)| text);
        after.split("\n## ").next().unwrap_or_default().trim()
    }
}

/// One certificate and by how much its two sides differ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Check {
    /// What is compared.
    pub subject: Subject,
    /// The relative difference, signed.
    pub error: f64,
}

impl Check {
    /// Whether both sides agree as well as they should.
    pub fn holds(&self) -> bool {
        self.error.abs() <= FAILS
    }

    /// `energy off by 2 %`.
    pub fn complaint(&self) -> String {
        let (name, percent) = (self.subject.name(), 100.0 * self.error.abs());
        match percent {
            p if !p.is_finite() => format!("{name} is not finite"),
            p if p < 9.95 => format!("{name} off by {p:.1} %"),
            p if p < 1000.0 => format!("{name} off by {p:.0} %"),
            _ => format!("{name} off by more than 1000 %"),
        }
    }
}

/// `checks ok`, or the worst of the `checks` that fail; none before there is any check.
pub fn verdict(checks: &[Check]) -> Option<String> {
    // What is no number is the worst.
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
    /// Every certificate that the present moment has.
    pub fn checks(&self) -> Vec<Check> {
        let moment = self.moment();
        let mut checks = Vec::new();
        let mut add = |subject, error: Option<f64>| {
            checks.extend(error.map(|error| Check { subject, error }));
        };
        add(Subject::Energy, moment.energy_residual);
        add(Subject::WearBalance, self.wear_balance());
        let period = f64::from(cycles_to_settle(&self.setup().drive));
        if moment.cycle >= 2.0 * period {
            let [force, energy] = self.closed_forms().map_or([None; 2], |both| both.map(Some));
            add(Subject::TangentialForce, force);
            add(Subject::Dissipation, energy);
        }
        checks
    }

    /// 1 − V of the nodes over that of the 1D image, V = 4 ∫ g √(L² − x²) dx: f is (2/π) ∫ g/√(r² − x²) dx,
    /// integrated over the area. For laws that follow no energy; none before anything has worn, and where the
    /// scar is too narrow for the integral.
    fn wear_balance(&self) -> Option<f64> {
        self.setup()
            .wear
            .as_ref()
            .filter(|law| !law.follows_energy())?;
        let nodal = self.wear_volume();
        let edge = self.setup().grid.radius();
        // With x = L sin θ the root at the edge is gone.
        let points = self.setup().grid.nodes().iter().zip(&self.state().image);
        let points: Vec<[f64; 2]> = points
            .map(|(x, g)| {
                let sine = (x / edge).min(1.0);
                [sine.asin(), g * (1.0 - sine * sine)]
            })
            .collect();
        let volume = |step: usize| {
            let last = points
                .last()
                .filter(|_| !(points.len() - 1).is_multiple_of(step));
            let points: Vec<_> = points.iter().step_by(step).chain(last).collect();
            let pairs = points.windows(2);
            let area: f64 = pairs
                .map(|pair| 0.5 * (pair[1][0] - pair[0][0]) * (pair[0][1] + pair[1][1]))
                .sum();
            4.0 * edge * edge * area
        };
        let (fine, coarse) = (volume(1), volume(2));
        let is_seen = nodal > 0.0 && (fine - coarse).abs() < FAILS * nodal;
        is_seen.then(|| 1.0 - nodal / fine)
    }

    /// F_x and E_d of the last period over the closed forms of a held load, less 1, where nothing wears.
    fn closed_forms(&self) -> Option<[f64; 2]> {
        let worn = self.setup().wear.is_some_and(|law| law.coefficient() > 0.0);
        if worn || self.state().wear.iter().any(|&worn| worn > 0.0) {
            return None;
        }
        let figures = self.state().figures.as_ref()?;
        let ring = Unworn(self.setup()).ring()?;
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
        for subject in Subject::ALL {
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
            check(Subject::Energy, 1e-3),
            check(Subject::Dissipation, -9e-3),
        ];
        assert_eq!(verdict(&good).as_deref(), Some("checks ok"));
        let bad = [
            check(Subject::Energy, 0.02),
            check(Subject::TangentialForce, -0.07),
        ];
        assert_eq!(
            verdict(&bad).as_deref(),
            Some("tangential force off by 7.0 %")
        );
        let broken = [
            check(Subject::Dissipation, 9.0),
            check(Subject::Energy, f64::NAN),
        ];
        assert_eq!(verdict(&broken).as_deref(), Some("energy is not finite"));
    }
}
