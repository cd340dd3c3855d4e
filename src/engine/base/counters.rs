//! Counts of the work of a run.

use crate::engine::base::kinds::{Kind, Refusal};
use serde::{Deserialize, Serialize};

/// How much work a run has been: counted, not timed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Counters {
    /// Steps by their kinds, in the order of [`Kind::ALL`].
    pub(in crate::engine) taken: [u64; Kind::ALL.len()],
    /// How often a kind was refused, by the reasons, in the order of [`Refusal::ALL`].
    pub(in crate::engine) refused: [u64; Refusal::ALL.len()],
    /// Pieces of flights that were searched for an entry: expanded into a power series, or cleared by both of their
    /// ends.
    pub narrow_phase_pieces: u64,
    /// Evaluations of a pair's penetration for a flight.
    pub pairs_evaluated: u64,
    /// Contact forces that were expanded into a series or solved for over a window: one for each such step and pair
    /// whose law acts in it.
    pub law_evaluations: u64,
    /// Steps, or pieces of flights, over which the terms of the energy account were integrated.
    pub energy_steps: u64,
    /// Entries, releases and branch changes of contacts, yields and turns of storeys.
    pub events: u64,
}

impl Counters {
    /// Steps of a kind.
    pub fn taken(&self, kind: Kind) -> u64 {
        self.taken[kind as usize]
    }

    /// How often a kind of step was refused for a reason.
    pub fn refused(&self, why: Refusal) -> u64 {
        self.refused[why as usize]
    }

    /// Steps apart.
    pub fn flight_steps(&self) -> u64 {
        self.flights_cleared() + self.sum([Kind::ByEnds, Kind::ByAmplitudes, Kind::Searched])
    }

    /// Flights for which no pair had to be evaluated: bounds on the closing velocities had cleared all of them.
    pub fn flights_cleared(&self) -> u64 {
        self.taken(Kind::Cleared)
    }

    /// Steps in contact.
    pub fn contact_steps(&self) -> u64 {
        self.sum([Kind::Window, Kind::Onset, Kind::Series, Kind::Mapped])
    }

    /// Steps in which an element yields and no contact is closed.
    pub fn yielding_steps(&self) -> u64 {
        self.taken(Kind::Exact)
    }

    fn sum<const N: usize>(&self, kinds: [Kind; N]) -> u64 {
        kinds.map(|kind| self.taken(kind)).iter().sum()
    }

    pub(in crate::engine) fn take(&mut self, kind: Kind) {
        self.taken[kind as usize] += 1;
    }

    pub(in crate::engine) fn refuse(&mut self, why: Refusal) {
        self.refused[why as usize] += 1;
    }
}
