//! Quantities as rows over the motion: those with limits in flights, those whose peaks are kept, with what a master's
//! pushes add to these at once, and the coupling of floors that bounds on them need; constant during a run.

pub(super) mod corrections;
pub(super) mod flight_row;
pub(super) mod pushed;
pub(super) mod resistance;
pub(super) mod rows;
pub(super) mod span_rows;
pub(super) mod storeys;
pub(super) mod watched;
