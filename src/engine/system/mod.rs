//! X

pub mod tolerance;
