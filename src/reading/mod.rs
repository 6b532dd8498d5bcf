//! What only reads a simulation: quantities that no step needs, computed where somebody asks for them.

pub mod fatigue;
