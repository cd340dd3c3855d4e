//! Proof that no storey yields in some segments: for all storeys at once, by the amplitudes of the modes, or for each as the
//! broad phase does it for pairs.
//!
//! With the amplitude e of each mode and its growth A S (see [`super::broad_phase`]), a drift relative to the position of
//! rest is at most the sum over modes of |row| (e + A S) / w.

use crate::engine::base::Base;
use crate::engine::base::storey::Sense;
use crate::engine::bounds::all_storeys::Reach;
use crate::engine::bounds::amplitude::{BoundedModes, Closing, Ends, Growth, MARGIN, Seen, TRIED, bound_one};
use crate::engine::system::System;

/// Coefficients of the bounds on storeys; constant during a run.
#[derive(Debug)]
pub struct ElasticBounds {
    /// Increase of the bound on all storeys together per unit of cumulative absolute velocity, 1 m/s.
    shaken: f64,
    /// For each storey, the increase of its bounds.
    pub growth: Vec<Growth>,
}

impl ElasticBounds {
    /// For storeys with that reach, the increases of whose bounds are known; `shaken` is |participation| of each mode.
    pub fn of(reach: &Reach, shaken: &[f64], growth: Vec<Growth>) -> ElasticBounds {
        ElasticBounds { shaken: reach.swing(shaken), growth }
    }

    /// The largest of the tested numbers of segments for which all storeys stay elastic; 0 if they do for none.
    pub fn longest(
        &self,
        (modes, system): (&[BoundedModes], &System),
        base: &Base,
        (amplitude, size): (&[f64], f64),
        ends: &[Ends; TRIED.len()],
    ) -> u64 {
        let together = self.longest_together(system, base, amplitude, ends);
        if together > 0 {
            return together;
        }
        let mut least = u64::MAX;
        for ((of, storey), growth) in system.storeys.iter().zip(&base.storeys).zip(&self.growth) {
            let Seen { bounds: sums, pull, moved, rate } = bound_one(modes, base, &of.row, amplitude);
            for sense in Sense::BOTH {
                let (start, sign) = (of.start_of_flight(storey, sense, moved), sense.sign());
                let closing = Closing {
                    start: start + MARGIN * (of.limit + size),
                    rate: sign * rate,
                    pull: sign * pull + MARGIN * sums.change,
                    sums,
                    growth,
                };
                least = least.min(closing.longest(ends));
            }
            if least == 0 {
                break;
            }
        }
        least
    }

    /// The same by the amplitudes of all modes together.
    fn longest_together(&self, system: &System, base: &Base, amplitude: &[f64], ends: &[Ends; TRIED.len()]) -> u64 {
        let moved = Reach::moved(&system.storeys, &base.storeys);
        let swing = system.reach_of_storeys.swing(amplitude);
        let mut free = 0;
        for (segments, ends) in TRIED.iter().zip(ends) {
            for (segments, cumulative) in segments.iter().zip(&ends.cumulative) {
                // Written so that a NaN never counts as elastic.
                if (1.0 + MARGIN) * (swing + self.shaken * cumulative) + moved < 1.0 {
                    free = *segments;
                }
            }
        }
        free
    }
}
