//! Length limit of flights for the energy account, which is integrated piece by piece.

use crate::engine::base::Base;
use crate::engine::excitation::record::GroundMotion;
use crate::engine::excitation::segment::Segment;
use crate::engine::system::System;
use crate::structure::{LinearLoad, PIECE_ANGLE};

/// Largest number of pieces of one flight; a longer flight takes several steps, unless its motion has died out.
const MOST_PIECES: f64 = 10_000.0;

/// Number of pieces up to which a flight of modes that damping does not couple takes less work by pieces than as a whole.
const FEW_PIECES: u64 = 100;

/// Share of the largest energy so far below which the energy that damping can still dissipate is negligible.
const QUIET: f64 = 1e-20;

impl System {
    /// Number of pieces, each within reach of one series, of a flight of that length, s; `None` if its work takes less as a whole.
    pub fn pieces(&self, length: f64) -> Option<u64> {
        let pieces = (self.structure.in_flight().fastest * length / PIECE_ANGLE).ceil().max(1.0) as u64;
        let is_long = length > self.longest_pieces();
        let is_sooner_whole = pieces > FEW_PIECES && self.has_work_of_any_length();
        (!is_long && !is_sooner_whole).then_some(pieces)
    }

    /// Whether the work over a flight of any length is found at once: where damping couples modes, that takes matrices.
    fn has_work_of_any_length(&self) -> bool {
        self.structure.is_classical() && !self.is_pushed
    }

    /// Length, s, of the flight from the base, at most `length`, under a load and its slope: limited to some thousand
    /// pieces for the energy account, unless nothing is left to integrate or the work is found at once.
    pub fn accounted_flight(&self, base: &Base, loads: LinearLoad, length: f64) -> f64 {
        let most = self.longest_pieces();
        let is_whole = base.elapsed == 0.0 && length == base.segment.length;
        let watched = self.watched_segment(base).filter(|_| is_whole);
        let is_prepared = watched.is_some_and(|(ground, _)| ground.work_over(length).is_some());
        let is_at_once = is_prepared || self.has_work_of_any_length();
        match &base.energy {
            Some(account) if length > most && !is_at_once && !self.is_quiet(base, loads, account.largest) => most,
            _ => length,
        }
    }

    /// Whether the work over the whole segment of the base needs no integration: no account is kept, or it has been
    /// prepared.
    pub fn is_accounted_at_once(&self, ground: &GroundMotion, base: &Base) -> bool {
        let Segment { length, .. } = base.segment;
        base.energy.is_none() || ground.work_over(length).is_some()
    }

    /// Length of the longest flight that is integrated in one step, s.
    pub fn longest_pieces(&self) -> f64 {
        MOST_PIECES * PIECE_ANGLE / self.structure.in_flight().fastest
    }

    /// Whether damping dissipates nothing from now on: there is none, or the oscillation about the static displacement
    /// has died out.
    pub fn is_quiet(&self, base: &Base, LinearLoad { load, slope }: LinearLoad, largest: f64) -> bool {
        if slope.iter().any(|slope| *slope != 0.0) {
            return false;
        }
        let flying = self.structure.in_flight();
        let (w2, damping) = (&flying.omega2, &flying.damping);
        let quasi_static = |m: usize| if w2[m] > 0.0 { load[m] / w2[m] } else { base.q[m] };
        let swing =
            |m: usize| w2[m] * (base.q[m] - quasi_static(m)) * (base.q[m] - quasi_static(m)) + base.v[m] * base.v[m];
        let moving: f64 = (0..damping.len()).filter(|m| damping[*m] > 0.0).map(swing).sum();
        moving <= QUIET * largest && flying.is_classical() || moving == 0.0
    }
}
