//! Largest magnitudes so far, in continuous time: of displacements, drifts, absolute accelerations and base shears.
//!
//! Nothing is sampled. A flight is exact, so what a quantity is at both ends of it, how fast it changes there and a
//! bound on its fourth derivative tell whether it can have exceeded its peak in between ([`flight`]); most segments of
//! a record need not even that, since the amplitudes of the modes tell for how long nothing can ([`ahead`]). In contact
//! the largest force and both ends of a step bound what the floors have done ([`contact`]). What may have exceeded its
//! peak is searched for where it did: in the power series of the step ([`search`]), or by readings of the step where it
//! has none in time ([`reading`]).
//!
//! Between communication points a peak belongs to the scene: the base holds that of all whole steps, and what the step
//! under way adds is worked out from its start when somebody asks. Velocities jump in an impact of `stereomechanical`:
//! the motion before and after counts, the impulse itself, in which accelerations have no size, does not.

pub mod ahead;
pub mod contact;
pub mod flight;
pub mod floors;
pub mod reading;
pub mod room;
pub mod search;

use crate::engine::base::Base;
use crate::engine::base::peaks::Peaks;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::model::Model;
use crate::engine::peaks::room::PeakWork;
use crate::engine::step::Step;
use flight::Stretch;

impl Model {
    /// No peak yet.
    pub(in crate::engine) fn start_peaks(&self) -> Peaks {
        Peaks::new(self.peak_rows.blocks())
    }

    /// Raises the peaks of the base over the flight that is planned.
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
            |flight, work| match watched {
                Some((_, segment)) => self.check_due_blocks(segment, flight, &mut peaks, work),
                None => self.check_flight(flight, &mut peaks, work),
            },
        );
        base.peaks = peaks;
    }

    /// Raises the peaks of the base, to which a segment of the record has been flown from a motion before.
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
                if !cfg!(without = "peaks_ahead") && !self.raise_to_end(building, b, segment, base, work) {
                    continue;
                }
                let mut peaks = std::mem::take(&mut base.peaks);
                let (end, loads) = ((&base.q[..], &base.v[..]), (&load[..], &slope[..]));
                let flight = Stretch { start, end, loads, ground, length: base.segment.length, whole: None };
                if !std::mem::replace(&mut is_bounded, true) {
                    self.bound_modes(building, &flight, &mut work.peaks.bounds, &mut work.buffers.node_v);
                }
                self.check_block(building, b, &flight, &mut peaks, work);
                base.peaks = peaks;
            }
        }
        (work.buffers.load, work.buffers.slope) = (load, slope);
    }

    /// Calls with the flight from the base to an end after some seconds.
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
        then(&Stretch { start: (&base.q, &base.v), end: (q, v), loads, ground, length, whole: None }, work);
        (work.buffers.load, work.buffers.slope) = (load, slope);
    }
}
