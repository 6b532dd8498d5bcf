//! Studies of many points: one scenario, run for many values of some of its keys.
//!
//! A [`Study`] is read from a TOML file: a base scenario, settings for all points, the axes, and the columns. Its points
//! are numbered in the order of the axes, with the last one fastest. [`engine::run`] runs some of them on several
//! threads and gives a [`Row`] for each; [`Results`] hold the rows of a study, and a [`record::StudyFile`] is a table as
//! text, which can be read back, merged and continued.
//!
//! Points do not depend on each other or on threads, so a row is the same bit for bit in whatever order, on however
//! many threads and in however many pieces the study is run.

mod axis;
pub mod border;
mod design;
pub mod engine;
mod point;
mod points;
mod read;
pub mod record;
mod refuse;
mod results;
mod row;
mod shard;
mod study;
mod written_axis;

pub use axis::StudyAxis;
pub use design::Design;
pub use results::{Doubles, Results};
pub use row::{Row, Status};
pub use shard::Shard;
pub use study::Study;
