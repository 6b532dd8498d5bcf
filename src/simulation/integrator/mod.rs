//! How the state is carried forward in time.

pub(super) mod direct;
