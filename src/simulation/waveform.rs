//! Waveforms: a sine, or straight lines between corners.
//!
//! To add a waveform: its word in [`Wave`], which does not compile until [`Waveform::new`] makes it; its keys, in
//! [`WaveParameters`]; word and keys in `keys.toml`, of both directions.
//!
//! A waveform has period 1, values from −1 to 1, and the phase of a sine: triangle and trapezoid
//! cross zero upwards at 0. Coulomb friction and wear by friction work are rate-independent, so at
//! constant depth only the turning points matter: triangle, trapezoid and sine wear alike.

use std::f64::consts::TAU;
use std::sync::Arc;

use strum::{EnumString, IntoStaticStr, VariantNames};

use crate::math::invalid::{Invalid, Unmade, check_table, need};

/// Maximum number of corners.
const MOST_CORNERS: usize = 100_000;

/// A table still counts as closed if its ends differ by no more than this fraction of its amplitude.
const CLOSED: f64 = 1e-6;

/// Search for a repetition within a table: maximum number of periods, number of phases compared, and allowed difference
/// in amplitudes.
const MOST_REPEATS: u32 = 50;
const REPEAT_PLACES: u32 = 211;
const ALIKE: f64 = 0.02;

/// A waveform, by its word in scenarios.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[expect(missing_docs, reason = "keys.toml describes each word")]
pub enum Wave {
    Sine,
    Triangle,
    Trapezoid,
    Table,
}

/// Keys of the waveforms as a scenario gives them; `None`: not given.
#[derive(Debug, Clone, PartialEq, Default)]
#[expect(missing_docs, reason = "keys.toml describes each key")]
pub struct WaveParameters {
    pub hold: Option<f64>,
    pub times: Option<Vec<f64>>,
    pub values: Option<Vec<f64>>,
}

/// A periodic motion between −1 and 1.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Waveform {
    /// sin 2πt.
    #[default]
    Sine,
    /// Straight lines between corners; cheap to clone.
    Polyline(Arc<Polyline>),
}

/// Straight lines between corners, periodic.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyline {
    /// Phases of the corners, from 0 to below 1, increasing.
    phases: Vec<f64>,
    /// Values there.
    values: Vec<f64>,
}

/// The scale of a motion that is given as a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableScale {
    /// Mean of the lowest and the highest value.
    pub mean: f64,
    /// Half of their difference.
    pub amplitude: f64,
    /// 2π over the time from the first row to the last, rad/s.
    pub angular_frequency: f64,
}

impl Waveform {
    /// Makes a waveform of the keys of a scenario, with the scale of its motion if they tell it.
    ///
    /// # Errors
    /// If one of its keys is not given or not allowed.
    pub fn new(wave: Wave, given: &WaveParameters) -> Result<(Self, Option<TableScale>), Unmade> {
        let waveform = match wave {
            Wave::Sine => Self::Sine,
            Wave::Triangle => Self::triangle(),
            Wave::Trapezoid => Self::trapezoid(need("hold", given.hold)?)?,
            Wave::Table => {
                let times = need("times", given.times.as_deref())?;
                let values = need("values", given.values.as_deref())?;
                let (waveform, scale) = Self::table(times, values)?;
                return Ok((waveform, Some(scale)));
            }
        };
        Ok((waveform, None))
    }

    /// Moves at constant speed there and back.
    pub fn triangle() -> Self {
        Self::polyline(vec![0.25, 0.75], vec![1.0, -1.0])
    }

    /// Moves at constant speed and rests at both ends, together for the share `hold` of a period, between 0 and 1.
    ///
    /// # Errors
    /// If the share is outside that range.
    pub fn trapezoid(hold: f64) -> Result<Self, Invalid> {
        if !(hold > 0.0 && hold < 1.0) {
            let rule = "must be greater than 0 and less than 1";
            return Err(Invalid::new("hold", hold, rule));
        }
        let half = 0.25 * hold;
        let phases = vec![0.25 - half, 0.25 + half, 0.75 - half, 0.75 + half];
        let values = vec![1.0, 1.0, -1.0, -1.0];
        Ok(Self::polyline(phases, values))
    }

    /// Makes one period from a table: increasing `times` (s), and `values`, the last of which equals the first.
    ///
    /// # Errors
    /// If the rows are not a closed motion; the field is `times` or `values`.
    pub fn table(times: &[f64], values: &[f64]) -> Result<(Self, TableScale), Invalid> {
        let number = times.len();
        check_table(("times", times), ("values", values), 3..=MOST_CORNERS)?;
        let lowest = values.iter().copied().fold(f64::INFINITY, f64::min);
        let highest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (mean, amplitude) = (0.5 * (lowest + highest), 0.5 * (highest - lowest));
        if amplitude <= 0.0 {
            return Err(Invalid::new("values", highest, "must not all be the same"));
        }
        let (first, last) = (values[0], values[number - 1]);
        if (last - first).abs() > CLOSED * amplitude {
            let rule = format!("must end where it begins, at {first:e}: the table is one period");
            return Err(Invalid::new("values", format!("{last:e}"), rule));
        }
        let (begin, period) = (times[0], times[number - 1] - times[0]);
        let inner = 0..number - 1;
        let phases = times[inner.clone()]
            .iter()
            .map(|time| (time - begin) / period)
            .collect();
        let shape = values[inner]
            .iter()
            .map(|value| (value - mean) / amplitude)
            .collect();
        let waveform = Self::polyline(phases, shape);
        if let Some(repeats) = waveform.repeats() {
            let rule = format!(
                "holds {repeats} periods, and the table is one: keep the rows of {:.3e} s",
                period / f64::from(repeats)
            );
            return Err(Invalid::new("times", format!("{period:e} s"), rule));
        }
        let scale = TableScale {
            mean,
            amplitude,
            angular_frequency: TAU / period,
        };
        Ok((waveform, scale))
    }

    /// Returns how often it repeats within its period; `None` if it does not.
    fn repeats(&self) -> Option<u32> {
        let Self::Polyline(line) = self else {
            return None;
        };
        let places = || (0..REPEAT_PLACES).map(|i| f64::from(i) / f64::from(REPEAT_PLACES));
        let is_same = |phase: f64, later: f64| {
            (line.at(phase) - line.at((phase + later).fract())).abs() < ALIKE
        };
        let mut counts = (2..=MOST_REPEATS).rev();
        counts.find(|count| places().all(|phase| is_same(phase, 1.0 / f64::from(*count))))
    }

    fn polyline(phases: Vec<f64>, values: Vec<f64>) -> Self {
        Self::Polyline(Arc::new(Polyline { phases, values }))
    }

    /// Returns its value after `turns`, which begin `phase` rad into the waveform. Only the fraction of a turn counts, so
    /// that the millionth turn is like the first.
    pub fn at(&self, turns: f64, phase: f64) -> f64 {
        match self {
            Self::Sine => (TAU * turns.fract() + phase).sin(),
            Self::Polyline(line) => line.at(line_phase(turns, phase)),
        }
    }

    /// Returns its rate after `turns`, relative to the largest one of a sine.
    pub fn rate(&self, turns: f64, phase: f64) -> f64 {
        match self {
            Self::Sine => (TAU * turns.fract() + phase).cos(),
            Self::Polyline(line) => line.rate(line_phase(turns, phase)) / TAU,
        }
    }

    /// Whether it rises at its beginning, or did so before it came to rest there.
    pub fn rises_at_start(&self, phase: f64) -> bool {
        match self {
            Self::Sine => phase.cos() >= 0.0,
            Self::Polyline(line) => line.last_rate(line_phase(0.0, phase)) >= 0.0,
        }
    }

    /// Returns the position of the first corner after `turns`; `None` if it is smooth.
    pub fn next_corner(&self, turns: f64, phase: f64) -> Option<f64> {
        match self {
            Self::Sine => None,
            Self::Polyline(line) => Some(turns + line.to_next_corner(line_phase(turns, phase))),
        }
    }

    /// Whether it is a sine, for which closed forms of two motions are known.
    pub fn is_harmonic(&self) -> bool {
        matches!(self, Self::Sine)
    }

    /// Whether it goes from one end to the other and back, with or without rests: one stroke each way.
    pub fn has_two_strokes(&self) -> bool {
        match self {
            Self::Sine => true,
            Self::Polyline(line) => line.turns() == 2,
        }
    }

    /// Returns its greatest speed, relative to a sine.
    pub fn fastest(&self) -> f64 {
        match self {
            Self::Sine => 1.0,
            Self::Polyline(line) => {
                let slopes = (0..line.phases.len()).map(|k| line.slope(k).abs());
                slopes.fold(0.0, f64::max) / TAU
            }
        }
    }
}

/// Returns the phase of a polyline, from 0 to below 1.
fn line_phase(turns: f64, phase: f64) -> f64 {
    let phase = (turns.fract() + phase / TAU).rem_euclid(1.0);
    if phase < 1.0 { phase } else { 0.0 }
}

impl Polyline {
    /// Returns the value at a phase from 0 to 1.
    fn at(&self, phase: f64) -> f64 {
        let k = self.segment(phase);
        let since = (phase - self.phases[k]).rem_euclid(1.0);
        self.values[k] + self.slope(k) * since
    }

    /// Returns the slope per period at a phase; at a corner, the slope behind it.
    fn rate(&self, phase: f64) -> f64 {
        self.slope(self.segment(phase))
    }

    /// Returns the slope per period at a phase; during a rest, the last slope before it.
    fn last_rate(&self, phase: f64) -> f64 {
        let (corners, k) = (self.phases.len(), self.segment(phase));
        let mut slopes = (0..corners).map(|back| self.slope((k + corners - back) % corners));
        slopes.find(|slope| *slope != 0.0).unwrap_or(0.0)
    }

    /// Returns the distance from `phase` to the next corner, in periods: greater than 0, at most 1.
    fn to_next_corner(&self, phase: f64) -> f64 {
        let next = self.phases.partition_point(|&corner| corner <= phase);
        match self.phases.get(next) {
            Some(corner) => corner - phase,
            None => 1.0 - phase + self.phases[0],
        }
    }

    /// Returns the segment that contains a phase, as the index of the corner at which it begins.
    fn segment(&self, phase: f64) -> usize {
        let behind = self.phases.partition_point(|&corner| corner <= phase);
        (behind + self.phases.len() - 1) % self.phases.len()
    }

    fn slope(&self, k: usize) -> f64 {
        let next = (k + 1) % self.phases.len();
        let mut width = self.phases[next] - self.phases[k];
        if width <= 0.0 {
            width += 1.0;
        }
        (self.values[next] - self.values[k]) / width
    }

    /// Returns how often it turns per period.
    fn turns(&self) -> usize {
        let slopes = (0..self.phases.len()).map(|k| self.slope(k));
        let signs: Vec<f64> = slopes.filter(|s| *s != 0.0).map(f64::signum).collect();
        let after = signs.iter().cycle().skip(1);
        signs.iter().zip(after).filter(|(a, b)| a != b).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(waveform: &Waveform) -> &Polyline {
        match waveform {
            Waveform::Polyline(line) => line,
            Waveform::Sine => panic!("a sine has no corners"),
        }
    }

    #[test]
    fn a_triangle_has_the_phase_of_a_sine() {
        let triangle = Waveform::triangle();
        let line = line(&triangle);
        for (phase, value) in [
            (0.0, 0.0),
            (0.125, 0.5),
            (0.25, 1.0),
            (0.5, 0.0),
            (0.875, -0.5),
        ] {
            assert!((line.at(phase) - value).abs() < 1e-15, "{phase}");
        }
        assert_eq!(
            [0.0, 0.25, 0.5, 0.75].map(|p| line.rate(p)),
            [4.0, -4.0, -4.0, 4.0]
        );
        assert!((line.to_next_corner(0.8) - 0.45).abs() < 1e-15);
        assert_eq!(line.to_next_corner(0.25), 0.5);
        assert!((triangle.fastest() - 4.0 / TAU).abs() < 1e-15);
    }

    #[test]
    fn a_trapezoid_rests_at_its_ends() {
        let trapezoid = Waveform::trapezoid(0.4).expect("a trapezoid");
        let line = line(&trapezoid);
        for phase in [0.16, 0.25, 0.34] {
            assert!((line.at(phase) - 1.0).abs() < 1e-15 && line.rate(phase) == 0.0);
        }
        assert!(line.at(0.0).abs() < 1e-15 && line.at(0.5).abs() < 1e-15);
        assert!(trapezoid.has_two_strokes());
        assert!(line.last_rate(0.2) > 0.0 && line.last_rate(0.8) < 0.0);
        for hold in [0.0, 1.0, f64::NAN] {
            assert!(Waveform::trapezoid(hold).is_err());
        }
    }

    #[test]
    fn a_table_keeps_its_shape_its_size_and_its_period() {
        let (waveform, scale) =
            Waveform::table(&[1.0, 1.5, 2.0, 3.0], &[2e-6, 6e-6, 2e-6, 2e-6]).expect("a motion");
        assert_eq!(scale.angular_frequency, TAU / 2.0);
        assert!((scale.mean - 4e-6).abs() < 1e-20 && (scale.amplitude - 2e-6).abs() < 1e-20);
        let line = line(&waveform);
        assert!((line.at(0.125) - 0.0).abs() < 1e-12);
        assert!((line.at(0.75) + 1.0).abs() < 1e-12);
        assert!(waveform.has_two_strokes());
        let double = Waveform::table(&[0.0, 1.0, 2.0, 3.0, 4.0], &[0.0, 1.0, 0.5, 1.0, 0.0]);
        assert!(!double.expect("a motion").0.has_two_strokes());
    }

    #[test]
    fn a_table_that_is_no_closed_motion_is_refused() {
        let field = |times: &[f64], values: &[f64]| {
            Waveform::table(times, values).map_err(|refused| refused.field)
        };
        assert_eq!(field(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.5]), Err("values"));
        assert_eq!(field(&[0.0, 1.0, 1.0], &[0.0, 1.0, 0.0]), Err("times"));
        assert_eq!(field(&[0.0, 1.0], &[0.0, 0.0]), Err("times"));
        assert_eq!(field(&[0.0, 1.0, 2.0], &[1.0, 1.0, 1.0]), Err("values"));
        assert_eq!(
            field(&[0.0, 1.0, 2.0], &[1.0, f64::NAN, 1.0]),
            Err("values")
        );
        assert_eq!(field(&[0.0, 1.0, 2.0], &[1.0, 1.0]), Err("values"));
    }

    #[test]
    fn a_table_of_three_periods_is_not_one_cycle() {
        let record = |turns: f64, wobble: f64| {
            let at = |i: i32| f64::from(i) / 300.0;
            let value = |t: f64| (TAU * turns * t).sin() + wobble * (TAU * t).cos();
            let times: Vec<f64> = (0..=300).map(|i| 0.15 * at(i)).collect();
            let values: Vec<f64> = (0..=300)
                .map(|i| value(if i == 300 { 0.0 } else { at(i) }))
                .collect();
            Waveform::table(&times, &values).map_err(|why| why.rule)
        };
        assert!(record(1.0, 0.0).is_ok());
        assert!(record(3.0, 0.3).is_ok());
        assert!(
            record(3.0, 0.0)
                .expect_err("refused")
                .contains("holds 3 periods")
        );
        assert!(
            record(3.0, 0.0)
                .expect_err("refused")
                .contains("keep the rows of 5.000e-2 s")
        );
    }
}
