//! Studies of many points: one scenario, run for many values of some of its keys.
//!
//! A [`Study`] is read from a TOML file: a base scenario, settings for all points, the axes, the columns, and when a
//! point ends. Its points are numbered in the order of the axes, with the last one fastest. [`engine::run`] runs some
//! of them on several threads, and a [`record::Record`] is the table of their rows as text, which can be read back,
//! merged and continued.
//!
//! Points do not depend on each other or on threads, so a row is the same bit for bit in whatever order, on however
//! many threads and in however many pieces the study is run.

mod axis;
pub mod border;
mod design;
pub mod engine;
mod finder;
pub mod ledger;
mod point;
mod read;
pub mod record;
pub mod sensitivity;
mod shard;
mod shuffle;
pub mod slice;
mod study;

pub use axis::StudyAxis;
pub use design::Design;
pub use point::Success;
pub use shard::Shard;
pub use study::{Stop, Study};
