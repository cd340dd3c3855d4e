//! Peaks, the largest magnitudes so far in continuous time: of displacements, drifts, absolute accelerations and base
//! shears.
//!
//! Nothing is sampled. A flight is exact, so that the values and slopes of a quantity at both ends and a bound on its
//! fourth derivative show whether it can have exceeded its peak in between ([`flight`]); for most segments of a record
//! not even these are needed, since the modal amplitudes give a number of segments in which no peak can be exceeded
//! ([`ahead`]). In contact the largest force and both ends of a step bound the motion of the floors ([`contact`]).
//! Where a peak may have been exceeded, the maximum is searched for: in the power series of the step ([`search`]), or
//! by evaluating the step where it has no series in time ([`reading`]).
//!
//! The peaks do not depend on the communication points: the base holds those of all whole steps, and the part of the
//! planned step so far is added when a peak is read. Velocities jump in an impact of `stereomechanical`: the motion
//! before and after counts, the impulse itself, in which accelerations are unbounded, does not.

pub mod ahead;
pub mod contact;
pub mod flight;
pub mod floors;
pub mod reading;
pub mod rest;
pub mod room;
pub mod search;

use crate::engine::base::Base;
use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::stretch::Stretch;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::model::Model;
use crate::engine::peaks::room::{PeakRoom, PeakWork};
use crate::engine::step::Step;

impl Model {
    /// Peaks of 0.
    pub(in crate::engine) fn start_peaks(&self) -> Peaks {
        Peaks::new(self.peak_rows.blocks())
    }

    /// Raises the peaks of the base over the planned flight.
    pub(in crate::engine) fn raise_over_flight(
        &self,
        base: &mut Base,
        step: &Step,
        inputs: &Inputs,
        work: &mut PeakWork,
    ) {
        let watched = self.system.watched_segment(base).filter(|_| self.system.structure.is_classical());
        if let Some((ground, segment)) = watched {
            self.watch_peaks(ground, base, segment, work);
        }
        let mut peaks = std::mem::take(&mut base.peaks);
        self.with_flight(
            base,
            inputs,
            (step.planned.length, &step.planned.q, &step.planned.v),
            work,
            |flight, work| {
                let is_watched = watched.is_some() && !cfg!(without = "peaks_ahead");
                let flight = &Stretch { is_watched, ..*flight };
                let may_exceed = |block: usize, room: &PeakRoom| {
                    watched.is_none_or(|(_, segment)| !room.watch.is_clear(block, segment))
                };
                self.check_blocks(flight, may_exceed, &mut peaks, work);
            },
        );
        base.peaks = peaks;
    }

    /// Raises the peaks of the base over a segment of the record, from the motion at its `start` to the base.
    pub(in crate::engine) fn raise_over_segment(
        &self,
        base: &mut Base,
        segment: u64,
        start: (&[f64], &[f64]),
        work: &mut PeakWork,
    ) {
        let ground = (base.segment.acceleration_at(0.0), base.segment.slope);
        let shares = self.system.structure.participation.iter();
        for ((load, slope), share) in work.buffers.load.iter_mut().zip(&mut work.buffers.slope).zip(shares) {
            (*load, *slope) = (-share * ground.0, -share * ground.1);
        }
        let (load, slope) = (std::mem::take(&mut work.buffers.load), std::mem::take(&mut work.buffers.slope));
        work.peaks.start_flight();
        for building in &self.peak_rows.buildings {
            let mut is_bounded = false;
            for b in 0..building.blocks.len() {
                let known_ends = match cfg!(without = "peaks_ahead") {
                    true => None,
                    false => match self.raise_to_end(building, b, segment, base, work) {
                        None => continue,
                        ends => ends,
                    },
                };
                let mut peaks = std::mem::take(&mut base.peaks);
                let flight = segment_flight(base, start, ground, (&load, &slope));
                if !std::mem::replace(&mut is_bounded, true) {
                    let jerk = &mut work.buffers.node_v;
                    work.peaks.bounds.set(&self.system.structure, building.modes.clone(), &flight, jerk);
                }
                self.check_block(building, b, (&flight, known_ends), &mut peaks, work);
                base.peaks = peaks;
            }
        }
        let mut peaks = std::mem::take(&mut base.peaks);
        self.search_flight(&segment_flight(base, start, ground, (&load, &slope)), &mut peaks, work);
        base.peaks = peaks;
        (work.buffers.load, work.buffers.slope) = (load, slope);
    }

    /// Calls a function with the flight from the base to a motion some seconds later.
    pub(in crate::engine) fn with_flight(
        &self,
        base: &Base,
        inputs: &Inputs,
        (length, q, v): (f64, &[f64], &[f64]),
        work: &mut PeakWork,
        then: impl FnOnce(&Stretch, &mut PeakWork),
    ) {
        self.system.load(base, inputs, &mut work.buffers.load, &mut work.buffers.slope);
        let (load, slope) = (std::mem::take(&mut work.buffers.load), std::mem::take(&mut work.buffers.slope));
        if self.system.floor_forces {
            self.note_floor_forces(base, inputs, &mut work.peaks.direct);
        }
        let ground = (base.segment.acceleration_at(base.elapsed), base.segment.slope);
        let loads = (&load[..], &slope[..]);
        let (start, is_watched) = ((&base.q[..], &base.v[..]), false);
        let rest = &base.rest.watched;
        then(&Stretch { start, end: (q, v), loads, rest, ground, length, is_watched, whole: None }, work);
        (work.buffers.load, work.buffers.slope) = (load, slope);
    }
}

/// The flight over a whole segment of the record to the base.
fn segment_flight<'a>(
    base: &'a Base,
    start: (&'a [f64], &'a [f64]),
    ground: (f64, f64),
    loads: (&'a [f64], &'a [f64]),
) -> Stretch<'a> {
    let (end, rest, length) = ((&base.q[..], &base.v[..]), &base.rest.watched[..], base.segment.length);
    Stretch { start, end, loads, rest, ground, length, is_watched: !cfg!(without = "peaks_ahead"), whole: None }
}
