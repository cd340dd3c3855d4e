//! The quantities whose peaks are kept, and the coupling of floors that bounds on them need; constant during a run.

pub(super) mod resistance;
pub(super) mod rows;
pub(super) mod storeys;
