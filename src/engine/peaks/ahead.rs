//! Peaks that are read at every communication point: the next flights on the record are flown ahead and bounded at once, as
//! a fold bounds those that are logged, so that a read has little to do where nothing rises.
//!
//! What has been flown ahead is a guess. It counts only for flights that start with the same motion, to the last bit, and
//! under the same load.

use crate::engine::base::Base;
use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::flights::{Flights, Load};
use crate::engine::flight::log::FlightLog;
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::fold::is_below;
use crate::engine::peaks::fold_room::{LONG, Survivor};
use crate::engine::peaks::room::PeakWork;
use crate::structure::{Interval, LANES, Motion, MotionMut};

/// Number of flights that are flown ahead: those of one span.
const AHEAD: usize = LONG - 1;

/// Flights that are expected, and the blocks of quantities that may exceed their peaks in them.
#[derive(Clone, Debug, Default)]
pub(in crate::engine) struct FlightsAhead {
    log: FlightLog,
    /// Number of flights that have come.
    come: usize,
    /// The watched quantities at rest.
    rest: Vec<f64>,
    survivors: Vec<Survivor>,
}

impl FlightsAhead {
    /// Whether all flights that were expected have come.
    pub fn are_none(&self) -> bool {
        self.come == self.log.count()
    }

    /// Forgets what is expected.
    pub fn forget(&mut self) {
        self.log.clear();
        self.survivors.clear();
        self.come = 0;
    }

    /// Whether these flights are those that are expected next, or the first part of the one that is, with these
    /// quantities at rest.
    fn are(&self, flights: &Flights, rest: &[f64]) -> bool {
        let count = flights.loads.len();
        if self.come + count > self.log.count() || self.rest != rest {
            return false;
        }
        let expected = self.log.flights_from(self.come, Motion::default());
        (0..count).all(|k| {
            let (load, whole) = (flights.load(k), expected.load(k));
            let is_part = count == 1 && 0.0 < load.length && load.length < whole.length;
            load == Load { length: if is_part { load.length } else { whole.length }, ..whole }
                && flights.motion(k) == expected.motion(k)
        })
    }

    /// Whether no quantity can exceed its peak in the first part of the next flight, if that is the one that is expected.
    pub fn stay_below(&self, part: &Flights, rest: &[f64], peaks: &Peaks) -> bool {
        let all = peaks.values.as_chunks::<LANES>().0;
        let mut next = self.survivors.iter().filter(|survivor| survivor.flight == self.come);
        self.are(part, rest) && next.all(|survivor| is_below(&survivor.upper, &all[survivor.block]))
    }
}

impl PeakFinder<'_> {
    /// Raises peaks over the flights, if they are those that are expected; returns whether they are.
    pub(in crate::engine) fn fold_expected(
        &self,
        (flights, rest): (&Flights, &[f64]),
        ahead: &mut FlightsAhead,
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) -> bool {
        if !ahead.are(flights, rest) {
            return false;
        }
        let FlightsAhead { come, survivors, .. } = ahead;
        let now = *come..*come + flights.loads.len();
        let of_these = survivors.iter().filter(|survivor| now.contains(&survivor.flight));
        let mut room = std::mem::take(&mut work.peaks.fold);
        room.survivors.clear();
        room.survivors.extend(of_these.map(|survivor| Survivor { flight: survivor.flight - *come, ..*survivor }));
        self.read_survivors((flights, rest, None), &mut room.survivors, peaks, work);
        work.peaks.fold = room;
        *come = now.end;
        true
    }

    /// Flies ahead from the base of a flight, and notes which quantities may exceed their peaks in which flight.
    pub(in crate::engine) fn look_at_flights_ahead(
        &self,
        base: &Base,
        ahead: &mut FlightsAhead,
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        ahead.forget();
        let FlightsAhead { log, rest, survivors, .. } = ahead;
        if !log.is_kept() {
            *log = FlightLog::with_room((self.system.structure.lanes, 0), AHEAD + 1);
        }
        let is_flight = self.system.is_in_flight(base) && base.elapsed == 0.0 && !base.is_forced();
        let Some((ground, first)) = self.system.watched_segment(base).filter(|_| is_flight) else { return };
        let participation = &self.system.structure.in_flight().participation;
        let [mut q, mut v, mut end_q, mut end_v] = std::mem::take(&mut work.peaks.pieces);
        MotionMut { q: &mut q, v: &mut v }.copy_from(base.motion());
        for number in first..first + AHEAD as u64 {
            let segment = ground.segment(number);
            let acceleration = segment.ground_from(0.0);
            let is_finite = |interval: &Interval| {
                let end = MotionMut { q: &mut end_q, v: &mut end_v };
                interval.fly_on_ground(Motion { q: &q, v: &v }, (participation, acceleration), end)
            };
            if !ground.prepared(&segment).is_some_and(is_finite) {
                break;
            }
            log.push(Motion { q: &q, v: &v }, Load { ground: acceleration, length: segment.length });
            std::mem::swap(&mut q, &mut end_q);
            std::mem::swap(&mut v, &mut end_v);
        }
        rest.clone_from(&base.rest.watched);
        let mut room = std::mem::take(&mut work.peaks.fold);
        self.find_survivors(&log.flights_from(0, Motion { q: &q, v: &v }), (rest, false), peaks, &mut room);
        survivors.extend_from_slice(&room.survivors);
        work.peaks.fold = room;
        work.peaks.pieces = [q, v, end_q, end_v];
    }
}
