//! How long a flight may be for the energy account, which is integrated piece by piece.

use crate::engine::base::Base;
use crate::engine::system::System;

/// (Fastest rate) x (time) of a piece of a flight.
const REACH: f64 = 1.5;

/// Pieces of one flight: what is longer takes several, or none.
pub const MOST_PIECES: f64 = 10_000.0;

/// Share of the largest energy so far below which a motion has nothing to lose any more.
const QUIET: f64 = 1e-20;

impl System {
    /// Pieces of a flight of that length, s, each of which a series reaches.
    pub fn pieces(&self, length: f64) -> u64 {
        (self.structure.fastest * length / REACH).ceil().max(1.0) as u64
    }

    /// What a flight from the base over `length` seconds, under a load and its slope, is shortened to for the account:
    /// some thousand pieces, unless nothing is left to integrate.
    pub fn accounted_flight(&self, base: &Base, loads: (&[f64], &[f64]), length: f64) -> f64 {
        let most = self.longest_pieces();
        match &base.energy {
            Some(account) if length > most && !self.is_quiet(base, loads, account.largest) => most,
            _ => length,
        }
    }

    /// s.
    pub fn longest_pieces(&self) -> f64 {
        MOST_PIECES * REACH / self.structure.fastest
    }

    /// Whether damping takes nothing from now on: there is none, or the motion about where the load holds the buildings
    /// has died out.
    fn is_quiet(&self, base: &Base, (load, slope): (&[f64], &[f64]), largest: f64) -> bool {
        if slope.iter().any(|slope| *slope != 0.0) {
            return false;
        }
        let (w2, damping) = (&self.structure.omega2, &self.structure.damping);
        let held = |m: usize| if w2[m] > 0.0 { load[m] / w2[m] } else { base.q[m] };
        let swing = |m: usize| w2[m] * (base.q[m] - held(m)) * (base.q[m] - held(m)) + base.v[m] * base.v[m];
        let moving: f64 = (0..damping.len()).filter(|m| damping[*m] > 0.0).map(swing).sum();
        moving <= QUIET * largest && self.structure.is_classical() || moving == 0.0
    }
}
