//! The quantities whose peaks are kept, and the coupling of floors that bounds on them need; constant during a run.

pub mod resistance;
pub mod rows;
pub mod storeys;
pub mod truncated;
