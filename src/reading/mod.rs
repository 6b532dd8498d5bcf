//! Read-only views of a simulation: quantities that no step needs, computed on demand.

mod checks;
pub mod column;
mod cycle_figures;
mod errors;
pub mod fatigue;
mod limits;
mod log;
pub mod observation;
mod quantity;
mod recorder;
mod scar_end;
pub mod subsurface;
mod table;

pub use checks::{Check, CheckSubject, verdict};
pub use column::Column;
pub use cycle_figures::{CycleFigures, Regime};
pub use errors::Errors;
pub use log::{Log, Passed};
pub use observation::{Curves, Moment, Observation, Zone};
pub use quantity::Quantity;
pub use recorder::Recorder;
pub use table::Table;
