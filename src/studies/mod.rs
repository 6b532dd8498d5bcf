//! Studies: many runs and transforms, gathered in one table. They use scenarios and closed forms, but neither files nor
//! screens: printing, drawing and writing are left to higher layers.

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
