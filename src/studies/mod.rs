//! Studies: many runs and transforms made into one table. They know scenarios and closed forms, and
//! neither files nor screens: what is printed, drawn and written is for the floors above.

pub mod fit;
pub mod ghost;
pub mod judge;
pub mod measured;
pub mod random_scenarios;
pub mod refinement;
pub mod stability;
pub mod sweep;
pub mod table;
pub mod theory;
pub mod trade;
pub mod verify;
