//! Proof from both ends of a flight that no pair meets and no storey yields in it.
//!
//! A penetration d differs from the cubic through its end values and slopes by at most h^4/384 max|d''''|
//! \[BirkhoffPriver1967\], and |d''''| is bounded by an energy of the motion. If the cubic plus this bound is below 0,
//! there is no contact.

use crate::engine::base::planned::{At, Planned};
use crate::engine::flight::workspace::Look;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::numerics::roots::highest_of_cubic;
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
                of.stays_elastic(storey, start, end, (h, deviation))
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
