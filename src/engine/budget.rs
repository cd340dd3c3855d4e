//! The limit on the work of one communication step.
//!
//! Work is counted, not timed: the same step is given up at the same place on every machine.

use crate::engine::base::counters::Counters;
use crate::structure::Structure;

/// Limit on the work of one communication step, in microseconds: some ten seconds. A whole earthquake takes some
/// thousandths of that.
pub(super) const MOST_WORK: f64 = 1e7;

/// Limit on the number of consecutive steps of length 0.
pub(super) const MOST_STEPS_AT_ONCE: u32 = 100_000;

/// Number of flights that take `work` microseconds; one internal step with a series takes as long as some twenty
/// flights.
pub(super) fn most_flights(structure: &Structure, pairs: usize, work: f64) -> f64 {
    let step_work = 2.0 + 0.2 * structure.lanes as f64 + 0.5 * pairs as f64;
    work / (0.05 * step_work)
}

/// The work of one communication step so far.
pub(super) struct Progress {
    /// Time at which the communication step began, s.
    pub start: f64,
    /// The counts at its beginning.
    pub before: Counters,
    /// The number of impacts at its beginning.
    pub impacts_before: u64,
    /// Number of consecutive steps of length 0.
    pub stalled: u32,
    /// Limit on the work of the run up to its end, in flights.
    pub most: u64,
}

impl Counters {
    /// Work so far, in flights.
    pub(super) fn work(&self) -> u64 {
        let with_series = self.contact_steps() + self.yielding_steps();
        20 * with_series + 10 * self.narrow_phase_pieces + 6 * self.energy_steps + self.flight_steps()
    }
}

impl Progress {
    /// Notes whether a step has a length above 0.
    pub(super) fn note(&mut self, takes_time: bool) {
        self.stalled = if takes_time { 0 } else { self.stalled + 1 };
    }
}
