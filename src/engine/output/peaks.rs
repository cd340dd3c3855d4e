//! The peaks at the communication time: those of the base, raised over the planned step up to that time.

use crate::engine::base::contact::Contact;
use crate::engine::model::Model;
use crate::engine::output::known::PointPeaks;
use crate::engine::output::point::Point;
use crate::engine::peaks::flight::Stretch;
use crate::engine::peaks::room::{PeakRoom, PeakWork};
use crate::engine::state::State;
use crate::engine::step::StepKind;
use crate::engine::watched::rows::PeakOf;

impl Model {
    /// The largest magnitude so far of the quantity `of`; 0 where the scene keeps no peaks. `state` has to be the one
    /// that `point` was observed from.
    pub fn peak(&self, state: &State, point: &Point, of: PeakOf) -> f64 {
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
        let is_in_contact = base.contacts.iter().any(Contact::in_contact);
        match () {
            _ if elapsed == 0.0 && is_in_contact => self.raise_to_contact(base, &mut known.peaks, work),
            _ if elapsed == 0.0 => self.raise_to_motion(base, &mut known.peaks),
            _ if elapsed > 0.0 && step.is_in_contact() => {
                self.raise_over_part((base, step, inputs), (elapsed, (&point.q, &point.v)), &mut known.peaks, work);
            }
            _ => {
                let (mut q, mut v) = (std::mem::take(&mut work.buffers.q), std::mem::take(&mut work.buffers.v));
                let length = self.end_of_flight(state, work, (&mut q, &mut v));
                self.with_flight(base, inputs, (length, &q, &v), work, |whole, work| {
                    let end = (&point.q[..], &point.v[..]);
                    let part = Stretch { end, length: elapsed, whole: Some(whole), ..*whole };
                    self.check_flight(&part, &mut known.peaks, work);
                });
                (work.buffers.q, work.buffers.v) = (q, v);
            }
        }
        known.work = Some(room);
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
