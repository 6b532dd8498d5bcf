//! A study as a full-screen map, also while it runs: `:sweep`, and `mdr-tui sweep --view`.
//!
//! Two axes make a map in half blocks, one axis a curve; the cursor reads a point, Enter opens it.

pub mod draw;
pub mod live;
pub mod range;
pub mod view;
