//! What only reads a simulation: quantities that no step needs, computed where somebody asks for them.

mod checks;
pub mod fatigue;
mod limits;
pub mod observation;
pub mod subsurface;

pub use checks::{Check, Subject, verdict};
pub use observation::{Curves, Moment, Observation, Zone};
