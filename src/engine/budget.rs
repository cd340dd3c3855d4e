//! How much work one communication step may be.
//!
//! Work is counted, not timed: the same step is given up at the same place on every machine.

use crate::engine::base::counters::Counters;
use crate::structure::Structure;

/// Work that one communication step may be: some ten seconds. A whole earthquake takes some thousandths of that.
pub const MOST_WORK: f64 = 1e7;

/// Steps that may follow each other without any time passing.
pub const MOST_STEPS_AT_ONCE: u32 = 100_000;

/// Flights that are as much work as so many microseconds: an internal step with a series takes as long as some twenty.
pub fn most_flights(structure: &Structure, pairs: usize, work: f64) -> f64 {
    let step_work = 2.0 + 0.2 * structure.lanes as f64 + 0.5 * pairs as f64;
    work / (0.05 * step_work)
}

/// What one communication step has taken so far.
pub struct Progress {
    /// s, where it began.
    pub start: f64,
    /// The counts at its beginning.
    pub before: Counters,
    pub impacts_before: u64,
    /// Steps in a row without any time passing.
    pub stalled: u32,
    /// What it may take, in flights.
    pub most: u64,
}

impl Progress {
    /// Work of a communication step so far, in that of flights.
    pub fn work(&self, counters: &Counters) -> u64 {
        let before = &self.before;
        let with_series = counters.contact_steps - before.contact_steps;
        let looked = counters.narrow_phase_pieces - before.narrow_phase_pieces;
        let flown = counters.flight_steps - before.flight_steps;
        let accounted = counters.energy_steps - before.energy_steps;
        20 * with_series + 10 * looked + 6 * accounted + flown
    }

    /// Flights that may be taken without looking at the work again.
    pub fn flights_left(&self, counters: &Counters) -> u64 {
        self.most.saturating_sub(self.work(counters))
    }

    /// Notes whether a step takes any time.
    pub fn note(&mut self, takes_time: bool) {
        self.stalled = if takes_time { 0 } else { self.stalled + 1 };
    }
}
