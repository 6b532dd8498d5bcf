//! Results of a fit: keys with their errors, nuisances, and how well each data set is matched.

use std::collections::BTreeMap;
use std::ops::Range;

use serde::Serialize;

use super::errors::{ErrorAnalysis, degrees_of_freedom};
use super::nuisance::NAMES;
use super::profile::Interval;
use super::search::{Found, Search, residuals};
use super::structure::Structure;
use crate::math::scan::rms;
use crate::scenario::Scenario;
use crate::studies::measured::Measured;

/// Beyond this standard error of a logarithm, or correlation, the data hardly determine a key.
const VAGUE: f64 = 0.5;
const ALIKE: f64 = 0.95;

/// A key that was fitted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedKey {
    /// The dotted path.
    #[serde(skip)]
    pub key: String,
    /// Its unit.
    #[serde(skip)]
    pub unit: &'static str,
    /// The value at the minimum.
    pub value: f64,
    /// Its standard error; `None` if the data do not determine it.
    pub stderr: Option<f64>,
    /// Possible change by a finer computation; `None` if not determined.
    pub numerical_error: Option<f64>,
    /// The ends of two standard errors by the profile of the likelihood, where its error is no symmetric one; an end is
    /// `None` if the data set none.
    pub interval: Option<[Option<f64>; 2]>,
    /// Its correlations with the other keys; 0 with an undetermined key.
    pub correlations: BTreeMap<String, f64>,
}

impl FittedKey {
    /// Whether the data set it a limit on one side at most.
    pub fn is_open(&self) -> bool {
        self.interval.is_some_and(|ends| ends.contains(&None))
    }
}

/// A zero, a centre or a tilt that was fitted in addition to the keys.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Nuisance {
    /// `baseline`, `level`, `centre`, `shift` or `tilt`.
    pub name: &'static str,
    /// Its unit: the values', the abscissae's, or their ratio.
    pub unit: String,
    /// The value at the minimum.
    pub value: f64,
    /// Its standard error.
    pub stderr: f64,
}

/// The match of a data set.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SetResult {
    /// Name of the file.
    pub file: String,
    /// Number of compared points.
    pub points: usize,
    /// What was left out or corrected beforehand.
    pub notes: Vec<String>,
    /// Nuisances fitted besides the keys.
    pub nuisances: Vec<Nuisance>,
    /// Whether its residuals are noise.
    #[serde(flatten)]
    pub structure: Structure,
    /// Where the points lie, in the unit of the file's abscissa in SI.
    pub at: Vec<f64>,
    /// Measured minus simulated values, without zeros and tilt.
    pub residuals: Vec<f64>,
}

/// The result of a fit.
#[derive(Debug)]
pub struct Fitted {
    /// The keys in the requested order.
    pub values: Vec<FittedKey>,
    /// The match of each data set.
    pub sets: Vec<SetResult>,
    /// One line for each key that the data do not determine, and each data set that the model does not match.
    pub remarks: Vec<String>,
    /// The scenario with the fitted values.
    pub scenario: Scenario,
    /// Whether the search has come to its end: not where its time was up before.
    pub has_converged: bool,
}

impl Fitted {
    pub(super) fn new(
        search: &Search,
        found: &Found,
        (errors, numerical): (&ErrorAnalysis, Option<Vec<f64>>),
        intervals: &[Option<Interval>],
        scenario: Scenario,
    ) -> Self {
        let (mut values, mut remarks, mut alike) = (Vec::new(), Vec::new(), Vec::new());
        let covariance = &errors.covariance;
        let correlation = |i: usize, j: usize| {
            let norm = (covariance[(i, i)] * covariance[(j, j)]).sqrt();
            if norm > 0.0 {
                covariance[(i, j)] / norm
            } else {
                0.0
            }
        };
        let keys = &search.fit.free;
        for (i, (free, &theta)) in keys.iter().zip(&found.theta).enumerate() {
            let error = errors.standard_error(i);
            let at_bound = free.is_at_bound(theta);
            let is_known = error.is_finite() && error > 0.0 && !at_bound;
            let numerical = numerical.as_ref().map(|numerical| numerical[i]);
            // Chosen cells and steps have a chosen error.
            if is_known && search.fit.scenario.accuracy().is_some() && numerical > Some(error) {
                remarks.push(format!(
                    "{}: the numerical error exceeds the statistical one; a smaller numerics.accuracy lowers it",
                    free.key.path
                ));
            }
            let numerical_error = numerical.map(|numerical| free.error(theta, numerical));
            let (key, unit) = (free.key.path.to_owned(), free.unit);
            if let Some(interval_text) = intervals[i].and_then(|ends| limits(&key, unit, ends)) {
                remarks.push(interval_text);
            } else if at_bound {
                remarks.push(format!(
                    "the data do not determine {key}: it reached the end of its range"
                ));
            } else if !is_known {
                remarks.push(format!("the data do not determine {key}"));
            } else if error > VAGUE * free.size(theta) {
                remarks.push(format!(
                    "the data hardly determine {key}: its standard error is as large as itself"
                ));
            }
            let others = keys.iter().enumerate().filter(|(j, _)| *j != i);
            let others = others.map(|(j, other)| (other.key.path.to_owned(), correlation(i, j)));
            for (other, correlation) in others.clone().take(i) {
                if correlation.abs() > ALIKE {
                    alike.push(format!(
                        "the data hardly distinguish {other} from {key}: their correlation is {correlation:.4}"
                    ));
                }
            }
            values.push(FittedKey {
                unit: free.unit,
                value: free.value(theta),
                stderr: is_known.then(|| free.error(theta, error)),
                numerical_error: numerical_error.filter(|_| is_known),
                interval: intervals[i],
                correlations: others.collect(),
                key,
            });
        }
        remarks.extend(alike);
        let sets = sets(search, found, errors);
        remarks.extend(
            sets.iter()
                .filter_map(|set| set.structure.remark(&set.file)),
        );
        Self {
            values,
            sets,
            remarks,
            scenario,
            has_converged: true,
        }
    }

    /// Says that the time was up before the end of the search: what it has not come to is not undetermined.
    pub(super) fn cut_off(&mut self, budget: f64) {
        self.has_converged = false;
        self.remarks = vec![format!(
            "ended by the budget of {budget} s, not converged: these are the best values so far"
        )];
    }
}

/// Says where a key may lie; `None` if it has no end on either side.
fn limits(key: &str, unit: &str, ends: Interval) -> Option<String> {
    match ends {
        [Some(low), None] => Some(format!(
            "the data give {key} a lower limit alone: {key} ≥ {low:.3e} {unit} (2 σ)"
        )),
        [None, Some(high)] => Some(format!(
            "the data give {key} an upper limit alone: {key} ≤ {high:.3e} {unit} (2 σ)"
        )),
        [Some(low), Some(high)] => Some(format!(
            "{key} lies between {low:.3e} and {high:.3e} {unit} (2 σ)"
        )),
        [None, None] => None,
    }
}

fn sets(search: &Search, found: &Found, errors: &ErrorAnalysis) -> Vec<SetResult> {
    let mut next = found.theta.len();
    let mut result = |i: usize, (set, place): (&Measured, Range<usize>), simulated: &Vec<f64>| {
        let left = residuals(set, simulated);
        let spent: f64 = errors.leverages[place].iter().sum();
        let freedom = degrees_of_freedom(left.len(), spent);
        let (values, abscissae) = (set.axes.y.unit(), set.axes.x.unit());
        let column = usize::from(!set.axes.over_r());
        let mut nuisances = Vec::new();
        for k in (0..3).filter(|&k| search.nuisances[i].active[k]) {
            nuisances.push(Nuisance {
                name: NAMES[k][column],
                unit: match k {
                    0 => values.to_owned(),
                    1 => abscissae.to_owned(),
                    _ if values == abscissae => "rad".to_owned(),
                    _ => format!("{values}/{abscissae}"),
                },
                value: found.nuisances[i][k],
                stderr: errors.standard_error(next),
            });
            next += 1;
        }
        SetResult {
            file: set.name.clone(),
            points: left.len(),
            notes: set.notes.clone(),
            nuisances,
            structure: Structure::new(&left, set.errors.as_deref(), freedom),
            at: set.at.clone(),
            residuals: left,
        }
    };
    let sets = search.places().zip(&found.simulated).enumerate();
    sets.map(|(i, (set, simulated))| result(i, set, simulated))
        .collect()
}

impl SetResult {
    /// Returns the root mean square of its residuals.
    pub fn rms(&self) -> f64 {
        rms(&self.residuals)
    }
}
