//! Studies: many runs and transforms made into one table. They know scenarios and closed forms, but
//! neither files nor screens: printing, drawing and writing is left to the layers above.

pub mod fit;
pub mod ghost;
pub mod measured;
pub mod refinement;
pub mod stability;
pub mod sweep;
pub mod table;
pub mod theory;
pub mod trade;
pub mod verify;
