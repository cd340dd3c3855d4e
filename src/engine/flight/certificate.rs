//! Proof from both ends of a flight that no pair meets and no storey yields in it.
//!
//! A penetration d differs from the cubic through its end values and slopes by at most h^4/384 max|d''''|
//! \[BirkhoffPriver1967\], and |d''''| is bounded by an energy of the motion. If the cubic plus this bound is below 0,
//! there is no contact.

use crate::engine::base::planned::{At, Planned};
use crate::engine::base::storey::{Sense, Storey};
use crate::engine::flight::workspace::Look;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::yielding::storey::YieldingStorey;
use crate::structure::{Scratch, Structure, dot};

/// Coefficients of the bounds; constant during a run.
#[derive(Debug)]
pub struct Certificate {
    /// Largest |row| entry of each mode over all pairs and storeys, kg^-1/2.
    pub weight: Vec<f64>,
}

impl Certificate {
    /// For the rows of all pairs and storeys of a structure.
    pub fn of<'a>(structure: &Structure, rows: impl Iterator<Item = &'a Vec<f64>>) -> Certificate {
        let mut weight = vec![0.0_f64; structure.lanes];
        for row in rows {
            weight.iter_mut().zip(row).for_each(|(weight, row)| *weight = weight.max(row.abs()));
        }
        Certificate { weight }
    }

    /// Whether both ends of the planned flight prove that no pair meets and no storey yields in it; what is cleared for its
    /// segment is not tested.
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
        let pairs = system.pairs.iter().zip(&base.rest.gaps);
        for (p, ((pair, &gap), contact)) in pairs.zip(&mut base.contacts).enumerate() {
            if segment.is_some_and(|segment| base.clearance.is_free(p, segment)) {
                planned.ends.push(None);
                look.stay_apart[p] = true;
                continue;
            }
            if !base.clearance.is_known(p) {
                counters.pairs_evaluated += 1;
                (contact.penetration, contact.rate) = pair.penetration(gap, (&base.q, &base.v));
                base.clearance.set_known(p);
            }
            counters.pairs_evaluated += 1;
            let (end, end_rate) = pair.penetration(gap, (&planned.q, &planned.v));
            planned.ends.push(Some((end, end_rate)));
            let highest = highest_of_cubic((contact.flight_start(), contact.rate), (end, end_rate), h);
            look.stay_apart[p] = !cfg!(without = "certificate") && highest + deviation < 0.0;
        }
        for (i, (of, storey)) in system.storeys.iter().zip(&base.storeys).enumerate() {
            let at = |q: &[f64], v: &[f64]| (dot(&of.row, q), dot(&of.row, v));
            let is_cleared = |segment| base.clearance.is_free(system.pairs.len(), segment);
            look.stay_elastic[i] = segment.is_some_and(is_cleared) || {
                let (start, end) = (at(&base.q, &base.v), at(&planned.q, &planned.v));
                stays_elastic((of, storey), start, end, (h, deviation))
            };
        }
        look.stay_apart.iter().chain(&look.stay_elastic).all(|holds| *holds)
    }

    /// Bound on the distance of any penetration or drift from its cubic interpolant over the next `h` seconds of a modal motion,
    /// m: h^4/384 max|d''''|.
    pub fn deviation(
        &self,
        structure: &Structure,
        motion: (&[f64], &[f64]),
        loads: (&[f64], &[f64]),
        h: f64,
        scratch: &mut Scratch,
    ) -> f64 {
        (h * h) * (h * h) / 384.0 * structure.fourth_derivative_bound(motion, loads, &self.weight, scratch)
    }
}

/// The largest control value of the cubic Hermite interpolant through values and rates at both ends: an upper bound of
/// it.
pub fn highest_of_cubic((start, rate): (f64, f64), (end, end_rate): (f64, f64), h: f64) -> f64 {
    start.max(start + h / 3.0 * rate).max(end - h / 3.0 * end_rate).max(end)
}

/// How far beyond the limit of one sense a storey is with that drift at the start of a flight, m: exactly 0 where it has
/// just turned, never above 0.
pub fn start_of(of: &YieldingStorey, storey: &Storey, sense: Sense, drift: f64) -> f64 {
    if storey.turned == Some(sense) { 0.0 } else { of.excess(storey, sense, drift).min(0.0) }
}

/// Whether a storey stays elastic in a flight of `h` seconds from a drift and its rate to others, from which the drift
/// differs by at most `deviation` from its cubic interpolant.
pub fn stays_elastic(
    (of, storey): (&YieldingStorey, &Storey),
    (start, rate): (f64, f64),
    (end, end_rate): (f64, f64),
    (h, deviation): (f64, f64),
) -> bool {
    Sense::BOTH.into_iter().all(|sense| {
        let sign = sense.sign();
        let from = (start_of(of, storey, sense, start), sign * rate);
        let to = (of.excess(storey, sense, end), sign * end_rate);
        highest_of_cubic(from, to, h) + deviation < 0.0
    })
}
