//! One direction's oscillation about its mean, Eq. (14) of the paper, counted in its turns.

use super::super::waveform::Waveform;
use crate::math::invalid::{Invalid, finite, non_negative, positive};

/// mean + amplitude · sin(ωt + φ), of a displacement in m or
/// of a force in N; another [`Waveform`] may replace the sine.
#[derive(Debug, Clone, PartialEq)]
pub struct Oscillation {
    mean: f64,
    amplitude: f64,
    angular_frequency: f64,
    phase: f64,
    waveform: Waveform,
}

impl Oscillation {
    /// Makes an oscillation with an amplitude of 0 or more, ω greater than 0 in rad/s and φ in rad.
    pub fn new(
        mean: f64,
        amplitude: f64,
        angular_frequency: f64,
        phase: f64,
    ) -> Result<Self, Invalid> {
        Ok(Self {
            mean: finite("mean", mean)?,
            amplitude: non_negative("amplitude", amplitude)?,
            angular_frequency: positive("angular_frequency", angular_frequency)?,
            phase: finite("phase", phase)?,
            waveform: Waveform::Sine,
        })
    }

    /// Returns the same oscillation with another waveform.
    #[must_use]
    pub fn with_waveform(self, waveform: Waveform) -> Self {
        Self { waveform, ..self }
    }

    /// Returns the waveform.
    pub fn waveform(&self) -> &Waveform {
        &self.waveform
    }

    /// Whether it is a sine, or does not move at all.
    pub fn is_sine(&self) -> bool {
        self.waveform == Waveform::Sine || self.amplitude == 0.0
    }

    /// Returns the value around which the motion oscillates.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Returns half the distance from the lowest to the highest value.
    pub fn amplitude(&self) -> f64 {
        self.amplitude
    }

    /// ω, rad/s.
    pub fn angular_frequency(&self) -> f64 {
        self.angular_frequency
    }

    /// φ, rad.
    pub fn phase(&self) -> f64 {
        self.phase
    }

    /// The highest value.
    pub fn highest(&self) -> f64 {
        self.mean + self.amplitude
    }

    /// The lowest value.
    pub fn lowest(&self) -> f64 {
        self.mean - self.amplitude
    }

    /// Returns the value after `turns` of this oscillation. The waveform only gets the fraction of a turn, so that the
    /// millionth turn is like the first.
    pub fn after_turns(&self, turns: f64) -> f64 {
        self.mean + self.amplitude * self.waveform.at(turns, self.phase)
    }

    /// Returns the rate of the waveform after `turns`; the maximum for a sine is 1.
    pub(super) fn rate(&self, turns: f64) -> f64 {
        self.waveform.rate(turns, self.phase)
    }

    /// Whether it moves upwards at the beginning, or did so before coming to rest there.
    pub fn rises_at_start(&self) -> bool {
        self.waveform.rises_at_start(self.phase)
    }

    /// The greatest speed, per second.
    pub fn greatest_speed(&self) -> f64 {
        self.amplitude * self.angular_frequency * self.waveform.fastest()
    }

    /// Returns the position of the first corner after `turns`, if the waveform has corners.
    pub(super) fn next_corner(&self, turns: f64) -> Option<f64> {
        self.waveform.next_corner(turns, self.phase)
    }
}

/// The motion of the springs: an oscillation, and its effect in m per its unit.
///
/// A displacement moves the springs of a round contact directly. In a line contact it is a force that moves them, by
/// the same distance whatever has worn: F/(E*L).
#[derive(Debug, Clone, Copy)]
pub struct SpringMotion<'a> {
    pub(super) of: &'a Oscillation,
    pub(super) yields: f64,
}

impl SpringMotion<'_> {
    /// Returns the waveform.
    pub fn waveform(&self) -> &Waveform {
        &self.of.waveform
    }

    /// Returns the amplitude of the springs, m.
    pub fn amplitude(&self) -> f64 {
        self.yields * self.of.amplitude
    }

    /// Returns the value around which they oscillate, m.
    pub fn mean(&self) -> f64 {
        self.yields * self.of.mean
    }

    /// The highest value, m.
    pub fn highest(&self) -> f64 {
        self.yields * self.of.highest()
    }

    /// The lowest value, m.
    pub fn lowest(&self) -> f64 {
        self.yields * self.of.lowest()
    }

    /// The value after `turns`, m.
    pub fn after_turns(&self, turns: f64) -> f64 {
        self.yields * self.of.after_turns(turns)
    }

    /// The greatest speed, m/s.
    pub fn greatest_speed(&self) -> f64 {
        self.yields * self.of.greatest_speed()
    }

    /// Returns the rate of the waveform after `turns`; the maximum for a sine is 1.
    pub(super) fn rate(&self, turns: f64) -> f64 {
        self.of.rate(turns)
    }

    /// Whether it moves upwards at the beginning, or did so before coming to rest there.
    pub fn rises_at_start(&self) -> bool {
        self.of.rises_at_start()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_motions_are_refused() {
        assert!(Oscillation::new(f64::NAN, 0.0, 1.0, 0.0).is_err());
        assert!(Oscillation::new(0.0, -1.0, 1.0, 0.0).is_err());
        assert!(Oscillation::new(0.0, 1.0, 0.0, 0.0).is_err());
    }
}
