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

/// The work of impacts of rigid floors, in flights. At one instant there may be thousands without a step between them.
pub(super) fn work_of_impacts(impacts: u64) -> u64 {
    20 * impacts
}

/// The work of one communication step so far.
pub(super) struct Progress {
    /// Time at which the communication step began, s.
    pub start: f64,
    /// The steps at its beginning.
    pub before: Steps,
    /// The number of impacts at its beginning.
    pub impacts_before: u64,
    /// Number of consecutive steps of length 0.
    pub stalled: u32,
    /// Limit on the work of the run up to its end, in flights.
    pub most: u64,
}

/// The counts that the limit knows, by kinds of work ([`Counters`]).
#[derive(Clone, Copy)]
pub(super) struct Steps {
    pub in_contact: u64,
    pub yielding: u64,
    pub apart: u64,
    pub searched: u64,
    pub energy: u64,
}

impl Steps {
    /// The work of all, in flights.
    pub(super) fn work(&self) -> u64 {
        20 * (self.in_contact + self.yielding) + 10 * self.searched + 6 * self.energy + self.apart
    }
}

impl Counters {
    /// Those of the run so far.
    #[inline]
    pub(super) fn steps(&self) -> Steps {
        Steps {
            in_contact: self.contact_steps(),
            yielding: self.yielding_steps(),
            apart: self.flight_steps(),
            searched: self.narrow_phase_pieces,
            energy: self.energy_steps,
        }
    }
}

impl Progress {
    /// Notes whether a step has a length above 0.
    pub(super) fn note(&mut self, takes_time: bool) {
        self.stalled = if takes_time { 0 } else { self.stalled + 1 };
    }
}
