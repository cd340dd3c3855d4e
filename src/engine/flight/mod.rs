//! Flight: both buildings swing by themselves, exactly, until the segment ends or two floors meet.

use crate::engine::base::planned::At;
use crate::engine::base::planned::Planned;
use crate::engine::flight::broad_phase::ClosingSpeeds;
use crate::engine::flight::fast_certificate::NearPairs;
use crate::engine::flight::narrow_phase::Look;
use crate::engine::system::System;
pub mod accounted;
pub mod broad_phase;
pub mod envelope;
pub mod fast_certificate;
pub mod narrow_phase;
pub mod propagate;

use crate::engine::flight::narrow_phase::highest_of_cubic;
use crate::engine::system::buffers::Buffers;
use crate::structure::Scratch;

/// What stays the same during a run.
#[derive(Debug)]
pub struct Flight {
    closing: ClosingSpeeds,
    /// Where modes and pairs are few.
    pub near: Option<NearPairs>,
    /// Largest |row| entry of each mode over all pairs.
    pair_weight: Vec<f64>,
}

impl Flight {
    /// For the pairs of a system.
    pub fn new(System { structure, pairs, .. }: &System) -> Flight {
        let mut pair_weight = vec![0.0_f64; structure.lanes];
        for pair in pairs {
            for (weight, row) in pair_weight.iter_mut().zip(&pair.row) {
                *weight = weight.max(row.abs());
            }
        }
        Flight {
            closing: ClosingSpeeds::of(structure, pairs, &pair_weight),
            near: NearPairs::of(structure, pairs),
            pair_weight,
        }
    }

    /// Works out the flight from the base over `longest` seconds, under a load that is in `work`, or until the first entry.
    pub fn plan(
        &self,
        system: &System,
        at: &mut At,
        longest: f64,
        planned: &mut Planned,
        look: &mut Look,
        work: &mut Buffers,
    ) {
        at.counters.flight_steps += 1;
        planned.length = longest;
        planned.event = None;
        planned.next_length = None;
        planned.carried.fill(None);
        planned.ends.clear();
        system.fly(at.base, longest, work, (&mut planned.q, &mut planned.v));
        if system.pairs.is_empty() {
            return;
        }
        let watched = system.watched_segment(at.base);
        let segment = watched.map(|(_, segment)| segment);
        if let Some((ground, segment)) = watched
            && self.dismiss(system, ground, at.base, segment, at.counters, &mut work.node_v)
        {
            at.counters.flights_dismissed += 1;
            planned.ends.resize(system.pairs.len(), None);
        } else if !self.certify(system, at, planned, (look, work), segment) {
            let is_over = planned.ends.iter().flatten().any(|(penetration, _)| *penetration >= 0.0);
            planned.ends.clear();
            let loads = (&work.load[..], &work.slope[..]);
            if is_over || !system.swings_stay_apart((&at.base.q, &at.base.v), loads, longest) {
                self.look_closer(system, at.base, planned, at.counters, (look, work));
            }
        }
    }

    /// Whether no pair meets in the planned flight, shown by both ends alone; a pair that is dismissed for its segment
    /// does not.
    fn certify(
        &self,
        system: &System,
        At { base, counters, .. }: &mut At,
        planned: &mut Planned,
        (look, work): (&mut Look, &mut Buffers),
        segment: Option<u64>,
    ) -> bool {
        let h = planned.length;
        let loads = (&work.load[..], &work.slope[..]);
        let deviation = self.deviation_from_cubic(system, (&base.q, &base.v), loads, h, &mut work.scratch);
        for (p, (pair, contact)) in system.pairs.iter().zip(&mut base.contacts).enumerate() {
            if segment.is_some_and(|segment| base.watch.is_free(p, segment)) {
                planned.ends.push(None);
                look.stay_apart[p] = true;
                continue;
            }
            if !base.watch.is_known(p) {
                counters.pairs_evaluated += 1;
                (contact.penetration, contact.rate) = pair.penetration(&base.q, &base.v);
                base.watch.set_known(p);
            }
            counters.pairs_evaluated += 1;
            let (end, end_rate) = pair.penetration(&planned.q, &planned.v);
            planned.ends.push(Some((end, end_rate)));
            let highest = highest_of_cubic((contact.flight_start(), contact.rate), (end, end_rate), h);
            look.stay_apart[p] = highest + deviation < 0.0;
        }
        look.stay_apart.iter().all(|stays_apart| *stays_apart)
    }

    /// How far any penetration can be from its cubic interpolant over the `h` seconds that follow a modal motion: by the
    /// largest that any |d''''| can be.
    fn deviation_from_cubic(
        &self,
        system: &System,
        motion: (&[f64], &[f64]),
        loads: (&[f64], &[f64]),
        h: f64,
        scratch: &mut Scratch,
    ) -> f64 {
        (h * h) * (h * h) / 384.0 * system.structure.fourth_derivative_bound(motion, loads, &self.pair_weight, scratch)
    }
}
