//! The peaks at the communication time: those of the base, raised over the planned step up to that time.

use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::stretch::Stretch;
use crate::engine::model::Model;
use crate::engine::output::known::PointPeaks;
use crate::engine::output::point::Point;
use crate::engine::peaks::room::{PeakRoom, PeakWork};
use crate::engine::quantities::rows::PeakOf;
use crate::engine::state::State;
use crate::engine::step::StepKind;

impl Model {
    /// The largest magnitude so far of the quantity `of`; 0 where the scene keeps no peaks.
    pub(in crate::engine) fn peak(&self, state: &State, point: &Point, of: PeakOf) -> f64 {
        if self.peak_rows.are_none() {
            return 0.0;
        }
        let place = self.peak_rows.place(of);
        let mut known = point.peaks.borrow_mut();
        if known.observation != point.floors.observation {
            known.observation = point.floors.observation;
            self.read_peaks(state, point, &mut known);
        }
        known.peaks.values[place]
    }

    /// Works out the peaks at the observed time.
    #[inline(never)]
    fn read_peaks(&self, state: &State, point: &Point, known: &mut PointPeaks) {
        let State { base, step, inputs, .. } = state;
        let mut room = known.work.take().unwrap_or_else(|| {
            Box::new((self.buffers(), PeakRoom::new(&self.system.structure, &self.peak_rows, self.system.pairs.len())))
        });
        let (buffers, peaks) = &mut *room;
        let work = &mut PeakWork { buffers, peaks };
        known.peaks.clone_from(&base.peaks);
        let elapsed = state.since_base();
        match () {
            _ if elapsed == 0.0 && base.is_forced() => self.raise_to_contact(base, &mut known.peaks, work),
            _ if elapsed == 0.0 => self.raise_to_motion(base, &mut known.peaks),
            _ if elapsed > 0.0 && step.is_in_contact() => {
                let q = &mut known.q;
                q.clone_from(&point.q);
                for ((of, storey), now) in self.system.storeys.iter().zip(&base.storeys).zip(&point.storeys) {
                    of.move_rest(point.coordinates, (now, storey), q);
                }
                self.raise_over_part((base, step, inputs), (elapsed, (q, &point.v)), &mut known.peaks, work);
            }
            _ => self.read_peaks_of_flight(state, point, elapsed, &mut known.peaks, work),
        }
        known.work = Some(room);
    }

    /// Raises peaks over the first part of the planned flight, which ends at the observed time: of most blocks by what
    /// is known about the segment, of the others by the motion at both ends.
    fn read_peaks_of_flight(&self, state: &State, point: &Point, elapsed: f64, peaks: &mut Peaks, work: &mut PeakWork) {
        let State { base, inputs, .. } = state;
        let end = (&point.q[..], &point.v[..]);
        if !self.raise_to_point(state, end, peaks, &mut work.peaks.open) {
            return;
        }
        let (mut q, mut v) = (std::mem::take(&mut work.buffers.q), std::mem::take(&mut work.buffers.v));
        let length = self.end_of_flight(state, work, (&mut q, &mut v));
        self.with_flight(base, inputs, (length, &q, &v), work, |whole, work| {
            let part = Stretch { end, length: elapsed, whole: Some(whole), ..*whole };
            self.check_blocks(&part, |block, room| room.open[block], peaks, work);
        });
        (work.buffers.q, work.buffers.v) = (q, v);
    }

    /// Raises peaks to the observed motion where what is known about the base's segment shows that they are not
    /// exceeded before; notes the blocks of which that is open, and returns whether there are any.
    fn raise_to_point(&self, state: &State, end: (&[f64], &[f64]), peaks: &mut Peaks, open: &mut [bool]) -> bool {
        let (base, watch) = (&state.base, &state.work.peaks.watch);
        let is_whole = base.elapsed == 0.0 && self.system.structure.is_classical();
        let Some((_, segment)) = self.system.watched_segment(base).filter(|_| is_whole) else {
            open.fill(true);
            return true;
        };
        for building in &self.peak_rows.buildings {
            for b in 0..building.blocks.len() {
                open[building.first + b] =
                    self.raise_to_part(building, b, (watch, segment), (&base.rest.watched, end), peaks);
            }
        }
        open.contains(&true)
    }

    /// Works out the end of the planned flight; returns its length, s.
    fn end_of_flight(&self, state: &State, work: &mut PeakWork, (q, v): (&mut [f64], &mut [f64])) -> f64 {
        let State { base, step, inputs, .. } = state;
        if step.kind == StepKind::Flight {
            q.copy_from_slice(&step.planned.q);
            v.copy_from_slice(&step.planned.v);
            return step.planned.length;
        }
        let length = base.segment.length;
        self.system.load(base, inputs, &mut work.buffers.load, &mut work.buffers.slope);
        self.system.fly(base, length, work.buffers, (q, v));
        length
    }
}
