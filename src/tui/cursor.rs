//! The cursor over r, which reads all curves.

use super::frame::Frame;

/// The number of its places over the domain, and the initial one.
const PLACES: i16 = 100;
const START: i16 = 33;

/// Where it stands, in hundredths of the domain, if there is one.
#[derive(Debug, Default)]
pub struct Cursor(Option<i16>);

impl Cursor {
    /// Shows or hides it.
    pub fn toggle(&mut self) {
        self.0 = self.0.is_none().then_some(START);
    }

    /// Whether there is one.
    pub fn is_shown(&self) -> bool {
        self.0.is_some()
    }

    /// Moves it by hundredths of the domain.
    pub fn shift(&mut self, places: i16) {
        self.0 = self.0.map(|place| (place + places).clamp(0, PLACES));
    }

    /// Puts it to the place nearest to a radius, m.
    pub fn put(&mut self, frame: &Frame, radius: f64) {
        if let Some(edge) = frame.observation.radii.last() {
            let place = (radius / edge * f64::from(PLACES)).round();
            self.0 = Some((place as i16).clamp(0, PLACES));
        }
    }

    /// The radius under it, m.
    pub fn radius(&self, frame: &Frame) -> Option<f64> {
        let edge = frame.observation.radii.last()?;
        Some(edge * f64::from(self.0?) / f64::from(PLACES))
    }
}
