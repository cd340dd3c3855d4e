//! Proof from both ends of a flight that no pair meets in it.
//!
//! A penetration d differs from the cubic through its end values and slopes by at most h^4/384 max|d''''|
//! \[BirkhoffPriver1967\], and |d''''| is bounded by an energy of the motion. If the cubic plus this bound is below 0,
//! there is no contact.

use crate::engine::base::planned::{At, Planned};
use crate::engine::flight::workspace::Look;
use crate::engine::pairs::pair::Pair;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::structure::{Scratch, Structure};

/// Coefficients of the bounds; constant during a run.
#[derive(Debug)]
pub struct Certificate {
    /// Largest |row| entry of each mode over all pairs, kg^-1/2.
    pub pair_weight: Vec<f64>,
}

impl Certificate {
    /// For the pairs of a structure.
    pub fn of(structure: &Structure, pairs: &[Pair]) -> Certificate {
        let mut pair_weight = vec![0.0_f64; structure.lanes];
        for pair in pairs {
            for (weight, row) in pair_weight.iter_mut().zip(&pair.row) {
                *weight = weight.max(row.abs());
            }
        }
        Certificate { pair_weight }
    }

    /// Whether both ends of the planned flight prove that no pair meets in it; pairs that are cleared for its segment
    /// are not tested.
    pub fn holds(
        &self,
        system: &System,
        At { base, counters, .. }: &mut At,
        planned: &mut Planned,
        (look, work): (&mut Look, &mut Buffers),
        segment: Option<u64>,
    ) -> bool {
        let h = planned.length;
        let loads = (&work.load[..], &work.slope[..]);
        let deviation = self.deviation(&system.structure, (&base.q, &base.v), loads, h, &mut work.scratch);
        for (p, (pair, contact)) in system.pairs.iter().zip(&mut base.contacts).enumerate() {
            if segment.is_some_and(|segment| base.clearance.is_free(p, segment)) {
                planned.ends.push(None);
                look.stay_apart[p] = true;
                continue;
            }
            if !base.clearance.is_known(p) {
                counters.pairs_evaluated += 1;
                (contact.penetration, contact.rate) = pair.penetration(&base.q, &base.v);
                base.clearance.set_known(p);
            }
            counters.pairs_evaluated += 1;
            let (end, end_rate) = pair.penetration(&planned.q, &planned.v);
            planned.ends.push(Some((end, end_rate)));
            let highest = highest_of_cubic((contact.flight_start(), contact.rate), (end, end_rate), h);
            look.stay_apart[p] = !cfg!(without = "certificate") && highest + deviation < 0.0;
        }
        look.stay_apart.iter().all(|stays_apart| *stays_apart)
    }

    /// Bound on the distance of any penetration from its cubic interpolant over the next `h` seconds of a modal motion,
    /// m: h^4/384 max|d''''|.
    pub fn deviation(
        &self,
        structure: &Structure,
        motion: (&[f64], &[f64]),
        loads: (&[f64], &[f64]),
        h: f64,
        scratch: &mut Scratch,
    ) -> f64 {
        (h * h) * (h * h) / 384.0 * structure.fourth_derivative_bound(motion, loads, &self.pair_weight, scratch)
    }
}

/// The largest control value of the cubic Hermite interpolant through values and rates at both ends: an upper bound of
/// it.
pub fn highest_of_cubic((start, rate): (f64, f64), (end, end_rate): (f64, f64), h: f64) -> f64 {
    start.max(start + h / 3.0 * rate).max(end - h / 3.0 * end_rate).max(end)
}
