//! Counts of the work of a run.

use serde::{Deserialize, Serialize};

/// How much work a run has been: counted, not timed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Counters {
    /// Internal flight steps.
    pub flight_steps: u64,
    /// Pieces of flights that were searched for an entry: expanded into a power series, or cleared by both of their
    /// ends.
    pub narrow_phase_pieces: u64,
    /// Flights for which no pair had to be evaluated: bounds on the closing velocities had cleared all of them.
    pub flights_cleared: u64,
    /// Evaluations of a pair's penetration for a flight.
    pub pairs_evaluated: u64,
    /// Internal steps in contact.
    pub contact_steps: u64,
    /// Internal steps in which a storey yields and no contact is closed.
    pub yielding_steps: u64,
    /// Contact forces that were expanded into a series or solved for over a window: one for each such step and pair
    /// whose law acts in it.
    pub law_evaluations: u64,
    /// Steps, or pieces of flights, over which the terms of the energy account were integrated.
    pub energy_steps: u64,
    /// Entries, releases and branch changes of contacts, yields and turns of storeys.
    pub events: u64,
}
