//! A flight that has begun, and whose peaks are read on the way: what has been searched of it is kept from one read to the next.
//!
//! A record whose samples are far apart, or one that has ended, makes flights of any length. Searched from its start at each
//! read, a flight costs the square of the number of reads. What is kept ends with a piece of the search, and no read motion
//! counts in it: the peaks are the same as without it.

use crate::engine::base::Base;
use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::stretch::Stretch;
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::room::PeakWork;
use crate::structure::Motion;

/// The peaks over the first part of a flight.
#[derive(Clone, Debug, Default)]
pub(in crate::engine) struct BegunFlight {
    /// What the flight starts with: motion, quantities at rest and peaks.
    start: [Vec<f64>; 4],
    /// When it starts: the start of its segment, s, and the time since then.
    time: [f64; 2],
    /// Length of the part, s, and the motion at its end.
    until: f64,
    end: [Vec<f64>; 2],
    peaks: Peaks,
}

impl BegunFlight {
    /// Begins anew, unless it is this flight and no more of it has been searched than `until`.
    fn begin(&mut self, base: &Base, peaks: &Peaks, until: f64) {
        let BegunFlight { start: [q, v, rest, known], time, .. } = self;
        let now = [base.segment.start, base.elapsed];
        let is_same =
            *q == base.q && *v == base.v && *rest == base.rest.watched && *known == peaks.values && *time == now;
        if is_same && self.until <= until {
            return;
        }
        q.clone_from(&base.q);
        v.clone_from(&base.v);
        rest.clone_from(&base.rest.watched);
        known.clone_from(&peaks.values);
        (self.time, self.until) = (now, 0.0);
        self.peaks.clone_from(peaks);
    }
}

impl PeakFinder<'_> {
    /// Raises peaks over the first part of a `whole` flight from the base, up to a motion `elapsed` seconds after its start, by
    /// `raise`: over as much of the `whole` as has not been searched yet, up to a motion.
    pub(in crate::engine) fn raise_over_begun(
        &self,
        (base, begun): (&Base, &mut BegunFlight),
        (whole, elapsed, end): (&Stretch, f64, Motion),
        (peaks, work): (&mut Peaks, &mut PeakWork),
        raise: impl Fn(&Stretch, f64, Motion, &mut Peaks, &mut PeakWork),
    ) {
        let until = self.end_of_pieces(whole, elapsed);
        if until == 0.0 || cfg!(without = "begun") {
            return raise(whole, elapsed, end, peaks, work);
        }
        begun.begin(base, peaks, until);
        if begun.until < until {
            self.fly_within(whole, until, &mut begun.end, work);
            let [q, v] = &begun.end;
            raise(&Stretch { searched: begun.until, ..*whole }, until, Motion { q, v }, &mut begun.peaks, work);
            begun.until = until;
        }
        peaks.raise_all(&begun.peaks);
        raise(&Stretch { searched: until, ..*whole }, elapsed, end, peaks, work);
    }
}
