//! Studies: many runs and transforms made into one table. They know scenarios and closed forms, and
//! neither files nor screens: what is printed, drawn and written is for the floors above.

pub mod stability;
pub mod table;
pub mod trade;
pub mod verify;
