//! A record of displacements and forces: its cycles, their direction, and the figures of each.

use std::ops::Range;
use std::str::FromStr;

use super::{rises, span};
use crate::math::scan::range;
use crate::reading::Column;

/// Allowed gap between the ends of a loop, in distances between its rows.
const OPEN: f64 = 3.0;

/// Allowed gap, relative to the loop's ranges, between two least displacements, which noise moves: half a loop is no cycle.
const HALF: f64 = 0.25;

/// Share of the stroke, from either end, within which a motion counts as turned.
const NEAR_END: f64 = 0.25;

/// Cycles of a record, counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pick {
    /// The first cycle.
    pub first: usize,
    /// The last cycle.
    pub last: usize,
}

impl FromStr for Pick {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let rule = "cycles are picked as 40..50, counted from 1, or as one number";
        let (first, last) = text.split_once("..").unwrap_or((text, text));
        let number = |text: &str| text.trim().parse().map_err(|_| rule);
        let (first, last) = (number(first)?, number(last)?);
        if first == 0 || last < first {
            Err(rule)
        } else {
            Ok(Self { first, last })
        }
    }
}

/// One cycle of a record.
#[derive(Debug, Clone, PartialEq)]
pub struct Cycle {
    /// Number in the record, from 1.
    pub number: usize,
    /// Its points.
    pub points: Range<usize>,
    /// Which of them belong to the rising stroke.
    pub rising: Vec<bool>,
    /// Its figures.
    pub figures: Figures,
}

/// Figures that rigs report per cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Figures {
    /// E_d, the area of the loop, J.
    pub energy: f64,
    /// Half the range of the displacement, m.
    pub amplitude: f64,
    /// Q*, half the range of the force, N.
    pub force: f64,
    /// δ₀, half the width of the loop at the mean of its extreme forces, m.
    pub opening: f64,
    /// The means of the extreme displacements, m, and forces, N.
    pub means: [f64; 2],
}

/// The columns of a row of figures.
pub const COLUMNS: [Column; 10] = [
    Column::EnergyPerCycle,
    Column::ForceAmplitude,
    Column::ShiftAmplitude,
    Column::Opening,
    Column::EnergyRatio,
    Column::EnergyRatioB,
    Column::SlidingRatio,
    Column::EnergyFriction,
    Column::MeanShift,
    Column::MeanForce,
];

/// A value for each of [`COLUMNS`].
pub type FigureRow = [f64; COLUMNS.len()];

impl Figures {
    /// Returns the figures under a normal force, N; NaN for μ_e = E_d/(4 P δ₀) without one.
    pub fn row(&self, normal_force: Option<f64>) -> FigureRow {
        let a = self.energy / (4.0 * self.force * self.amplitude);
        let d = self.opening / self.amplitude;
        let load = normal_force.unwrap_or(f64::NAN);
        let friction = self.energy / (4.0 * load * self.opening);
        let [mean_shift, mean_force] = self.means;
        let Self {
            energy,
            force,
            amplitude,
            opening,
            ..
        } = *self;
        [
            energy,
            force,
            amplitude,
            opening,
            a,
            a / d,
            d,
            friction,
            mean_shift,
            mean_force,
        ]
    }

    fn new(u: &[f64], force: &[f64]) -> Self {
        let area = |i: usize| {
            let j = (i + 1) % u.len();
            0.5 * (force[i] + force[j]) * (u[j] - u[i])
        };
        let ends = |values: &[f64]| range(values.iter().copied()).unwrap_or_default();
        let ([u_low, u_high], [low, high]) = (ends(u), ends(force));
        let middle = 0.5 * (low + high);
        let mut crossings = [[0.0; 2]; 2];
        for i in 0..u.len() {
            let j = (i + 1) % u.len();
            let (before, after) = (force[i] - middle, force[j] - middle);
            if before * after < 0.0 {
                let at = u[i] + before / (before - after) * (u[j] - u[i]);
                let side = &mut crossings[usize::from(after > 0.0)];
                *side = [side[0] + at, side[1] + 1.0];
            }
        }
        let [falling, rising] = crossings.map(|[sum, count]| sum / count);
        Self {
            energy: (0..u.len()).map(area).sum(),
            amplitude: 0.5 * (u_high - u_low),
            force: 0.5 * (high - low),
            opening: 0.5 * (falling - rising).abs(),
            means: [0.5 * (u_low + u_high), middle],
        }
    }
}

/// The complete cycles of a record.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// The cycles.
    pub cycles: Vec<Cycle>,
}

impl Record {
    /// Cuts a record of displacements, m, and forces, N, at its least displacements. A record of one cycle may begin
    /// anywhere.
    ///
    /// # Errors
    /// If the record has no complete cycle, in words.
    pub fn new(u: &[f64], force: &[f64]) -> Result<Self, String> {
        let minima = minima(u);
        let mut whole: Vec<Range<usize>> = minima.windows(2).map(|ends| ends[0]..ends[1]).collect();
        // The last cycle includes the point at which it closes.
        if let Some(last) = whole.last_mut() {
            last.end = (last.end + 1).min(u.len());
        }
        if whole.is_empty() {
            check_closed(u, force, 0.0)?;
            whole.push(0..u.len());
        } else if let [one] = &whole[..] {
            check_closed(&u[one.clone()], &force[one.clone()], HALF)?;
        }
        let cycle = |(k, points): (usize, Range<usize>)| {
            let u = &u[points.clone()];
            Cycle {
                number: k + 1,
                rising: rises(u),
                figures: Figures::new(u, &force[points.clone()]),
                points,
            }
        };
        let cycles = whole.into_iter().enumerate().map(cycle);
        Ok(Self {
            cycles: cycles.collect(),
        })
    }

    /// Returns the number of points in complete cycles.
    pub fn points(&self) -> usize {
        self.cycles.iter().map(|cycle| cycle.points.len()).sum()
    }

    /// Keeps the picked cycles.
    ///
    /// # Errors
    /// If they do not exist, in words.
    pub fn pick(&mut self, pick: Pick) -> Result<(), String> {
        let count = self.cycles.len();
        if pick.last > count {
            return Err(format!(
                "--pick {}..{}: has {count} whole cycles",
                pick.first, pick.last
            ));
        }
        self.cycles = self.cycles[pick.first - 1..pick.last].to_vec();
        Ok(())
    }

    /// Returns the sum of all areas, J: negative if the loop is traversed backwards.
    pub fn area(&self) -> f64 {
        self.cycles.iter().map(|cycle| cycle.figures.energy).sum()
    }

    /// Reverses the direction of all cycles.
    pub fn turn(&mut self) {
        for cycle in &mut self.cycles {
            cycle.figures.energy = -cycle.figures.energy;
            cycle
                .rising
                .iter_mut()
                .for_each(|rising| *rising = !*rising);
        }
    }
}

/// Returns the points of least displacement between two times at
/// which it is large, including those at the ends of the record.
fn minima(u: &[f64]) -> Vec<usize> {
    let [least, most] = range(u.iter().copied()).unwrap_or_default();
    let (low, high) = (
        least + NEAR_END * (most - least),
        most - NEAR_END * (most - least),
    );
    let mut found = Vec::new();
    let mut lowest: Option<usize> = None;
    for (i, &at) in u.iter().enumerate() {
        if at > high {
            found.extend(lowest.take());
        } else if at < low && lowest.is_none_or(|lowest| at < u[lowest]) {
            lowest = Some(i);
        }
    }
    found.extend(lowest);
    found
}

/// Refuses a record whose end is far from its beginning, and by more than is `allowed`.
fn check_closed(u: &[f64], force: &[f64], allowed: f64) -> Result<(), String> {
    let spans = [u, force].map(span);
    let distance =
        |i: usize, j: usize| ((u[i] - u[j]) / spans[0]).hypot((force[i] - force[j]) / spans[1]);
    let last = u.len() - 1;
    let mut steps: Vec<f64> = (1..u.len()).map(|i| distance(i, i - 1)).collect();
    steps.sort_by(f64::total_cmp);
    let gap = distance(last, 0);
    if gap > allowed.max(OPEN * steps[last / 2].max(1e-3)) && gap > steps[last - 1] {
        return Err(format!(
            "the loop does not close: it begins at u = {:e} m, F = {:e} N and ends at {:e} m, {:e} N; \
             give one whole cycle or more",
            u[0], force[0], u[last], force[last]
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A parallelogram-like loop of `count` cycles from a phase on, in turns, with noise from a sawtooth.
    fn recorded(from: f64, count: f64, sense: f64) -> (Vec<f64>, Vec<f64>) {
        let points = (200.0 * count) as usize;
        let at = |i: usize| sense * TAU * (from + i as f64 / 200.0);
        let noise = |i: usize| 0.01 * ((i * 7919 % 101) as f64 / 50.0 - 1.0);
        let u = (0..=points).map(|i| 1e-6 * (at(i).sin() + noise(i)));
        let force = (0..=points).map(|i| 5.0 * (at(i) + 0.4).sin() + noise(i + 3));
        (u.collect(), force.collect())
    }

    #[test]
    fn cycles_are_counted_from_any_phase() {
        for from in [0.0, 0.3, 0.5, 0.75, 0.8] {
            for count in 1..6 {
                let (u, force) = recorded(from, f64::from(count), 1.0);
                let record = Record::new(&u, &force).expect("a record");
                let whole = if from == 0.75 || count == 1 {
                    count
                } else {
                    count - 1
                };
                let found = record.cycles.len() as i32;
                assert!(found == whole || found == count, "{from} {count}: {found}");
                for cycle in &record.cycles {
                    // ∮ F du of an ellipse, half its width where F = 0.
                    let (energy, opening) = (
                        5e-6 * std::f64::consts::PI * 0.4f64.sin(),
                        1e-6 * 0.4f64.sin(),
                    );
                    assert!(
                        (cycle.figures.energy / energy - 1.0).abs() < 0.05,
                        "{:?}",
                        cycle.figures
                    );
                    assert!(
                        (cycle.figures.opening / opening - 1.0).abs() < 0.1,
                        "{:?}",
                        cycle.figures
                    );
                }
            }
        }
    }

    #[test]
    fn sense_and_choice_of_cycles() {
        let (u, force) = recorded(0.75, 4.0, -1.0);
        let mut record = Record::new(&u, &force).expect("a record");
        assert!(record.area() < 0.0);
        record.turn();
        assert!(record.area() > 0.0);
        record
            .pick("2..3".parse().expect("a pick"))
            .expect("cycles");
        assert_eq!(
            record
                .cycles
                .iter()
                .map(|cycle| cycle.number)
                .collect::<Vec<_>>(),
            [2, 3]
        );
        let refused = record
            .pick("40..50".parse().expect("a pick"))
            .expect_err("refused");
        assert!(refused.contains("has 2 whole cycles"));
        assert!("5..3".parse::<Pick>().is_err());
    }
}
