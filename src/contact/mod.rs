//! The contact: materials, indenters, and the Winkler springs that represent the half-space.

pub mod foundation;
pub mod indenter;
pub mod material;
pub mod measured;
pub mod normal;
pub mod scar;
pub mod tangential;
