//! The peaks at the communication time: those of the base, raised over the planned step up to that time.

use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::flights::{Flights, Load};
use crate::engine::bounds::stretch::Stretch;
use crate::engine::model::Model;
use crate::engine::output::instant::Instant;
use crate::engine::output::known::PointPeaks;
use crate::engine::output::point::Point;
use crate::engine::peaks::clearance::Unbroken;
use crate::engine::peaks::room::PeakWork;
use crate::engine::quantities::rows::PeakOf;
use crate::engine::state::State;
use crate::engine::step::StepKind;
use crate::structure::{LANES, Motion, MotionMut};

impl Point {
    /// Number of motions within flights that have been worked out for peaks.
    pub fn motions_searched(&self) -> u64 {
        self.peaks.borrow().work.as_ref().map_or(0, |room| room.1.motions)
    }

    /// Number of searches of flights for peaks that may have ended before the flight did.
    pub fn searches_cut_short(&self) -> u64 {
        self.peaks.borrow().work.as_ref().map_or(0, |room| room.1.cut_short)
    }
}

impl Instant<'_> {
    /// The largest magnitude so far of the quantity `of`; 0 where the scene keeps no peaks.
    pub(super) fn peak(&self, of: PeakOf) -> f64 {
        let Instant { model, state, point } = *self;
        if model.watched.rows.are_none() {
            return 0.0;
        }
        let place = model.watched.rows.place(of);
        let mut known = point.peaks.borrow_mut();
        let is_read = known.observation == point.floors.observation;
        if !is_read && !known.clearance.holds(model.peaks(), (&state.base, flights_of(state)), place / LANES) {
            known.observation = point.floors.observation;
            model.read_peaks(state, point, &mut known);
        }
        known.peaks.values[place]
    }
}

impl Model {
    /// Works out the peaks at the observed time.
    #[inline(never)]
    fn read_peaks(&self, state: &State, point: &Point, known: &mut PointPeaks) {
        let State { base, step, inputs, .. } = state;
        let mut room = known.work.take().unwrap_or_else(|| {
            Box::new((self.buffers(), self.peaks().peak_room(usize::from(self.peaks().logs_flights()))))
        });
        let (buffers, peaks) = &mut *room;
        let work = &mut PeakWork { buffers, peaks };
        self.fold_into_point(state, known, work);
        let PointPeaks { peaks, q, folded, .. } = known;
        peaks.clone_from(folded);
        let elapsed = state.since_base();
        match () {
            _ if elapsed == 0.0 && base.is_forced() => self.peaks().raise_to_contact(base, peaks, work),
            _ if elapsed == 0.0 && state.work.log.is_open() => {}
            _ if elapsed == 0.0 => self.peaks().raise_to_motion(base, peaks),
            _ if elapsed > 0.0 && step.is_in_contact() => {
                q.clone_from(&point.q);
                for ((of, element), now) in self.system.elements.iter().zip(&base.elements).zip(&point.elements) {
                    of.move_rest(point.coordinates, (now, element), q);
                }
                self.peaks().raise_over_part((base, step, inputs), (elapsed, Motion { q, v: &point.v }), peaks, work);
            }
            _ => self.read_peaks_of_flight(state, (point, elapsed), peaks, work),
        }
        known.work = Some(room);
        known.clearance.look(self.peaks(), (&state.base, flights_of(state)), &known.peaks);
    }

    /// Raises a copy of the base's peaks over the logged flights, of which it may have some already.
    fn fold_into_point(&self, state: &State, known: &mut PointPeaks, work: &mut PeakWork) {
        let (State { base, .. }, log) = (state, &state.work.log);
        if known.identity != log.identity {
            known.folded.clone_from(&base.peaks);
            (known.identity, known.entries) = (log.identity, 0);
        }
        // Steps in contact have raised the peaks of the base.
        known.folded.raise_all(&base.peaks);
        let flights = log.flights_from(known.entries, base.motion());
        self.peaks().fold(&flights, &base.rest.watched, None, &mut known.folded, work);
        known.entries = log.count();
    }

    /// Raises peaks over the first part of the planned flight, which ends at the observed time.
    fn read_peaks_of_flight(
        &self,
        state: &State,
        (point, elapsed): (&Point, f64),
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        let State { base, inputs, .. } = state;
        let (lanes, end) = (self.system.structure.lanes, Motion { q: &point.q, v: &point.v });
        let loads = [Load { ground: base.ground(), length: elapsed }];
        let part = Flights { lanes, q: &base.q, v: &base.v, loads: &loads, end, forces: None };
        let (mut q, mut v) = (std::mem::take(&mut work.buffers.q), std::mem::take(&mut work.buffers.v));
        let length = self.end_of_flight(state, work, MotionMut { q: &mut q, v: &mut v });
        let is_folded = self.peaks().logs_flights() && !self.system.is_pushed;
        let finder = self.peaks();
        finder.with_flight(base, inputs, (length, Motion { q: &q, v: &v }), work, |whole, work| match is_folded {
            true => finder.fold(&part, whole.rest, Some(whole), peaks, work),
            false => finder.check_blocks(&Stretch { end, length: elapsed, whole: Some(whole), ..*whole }, peaks, work),
        });
        (work.buffers.q, work.buffers.v) = (q, v);
    }

    /// Works out the end of the planned flight; returns its length, s.
    fn end_of_flight(&self, state: &State, work: &mut PeakWork, MotionMut { q, v }: MotionMut) -> f64 {
        let State { base, step, inputs, .. } = state;
        if step.kind == StepKind::Flight {
            MotionMut { q, v }.copy_from(step.planned.motion());
            return step.planned.length;
        }
        let length = base.segment.length;
        self.system.load(base, inputs, &mut work.buffers.load, &mut work.buffers.slope);
        self.system.fly(base, length, work.buffers, MotionMut { q, v });
        length
    }
}

/// The flights that a state has behind it since its last event.
fn flights_of(state: &State) -> Unbroken {
    (state.work.log.identity, state.counters.events)
}
