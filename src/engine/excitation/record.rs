//! A ground motion record as a sequence of segments, in each of which the acceleration is linear in time.

use crate::engine::excitation::segment::{RecordPlace, Segment};
use crate::numerics::sum::Sum;
use crate::record::Record;
use crate::structure::{FlightWork, Interval, Structure};

/// Largest number of different segment lengths, from the shortest on, for which the exact flight is prepared.
const MOST_PREPARED: usize = 8;

/// A scaled record, divided into segments.
#[derive(Debug)]
pub(crate) struct GroundMotion {
    /// Times of the samples, s.
    times: Vec<f64>,
    /// Accelerations at the samples, m/s2.
    accelerations: Vec<f64>,
    /// Mean sample spacing, s: also the length of segments outside the record.
    spacing: f64,
    /// Length of each segment, s.
    lengths: Vec<f64>,
    /// At each sample, from the first: time, s, and the cumulative absolute velocity, m/s: the integral of
    /// |acceleration| or an upper bound.
    passed: Vec<(f64, f64)>,
    /// The exact flight over a segment, one for each length of a segment up to [`MOST_PREPARED`], and one for those after
    /// the record's end.
    prepared: Vec<Interval>,
    /// The work over these flights, where an energy account is kept.
    work: Vec<FlightWork>,
}

impl GroundMotion {
    /// Prepares a record, its accelerations times `factor`, for a structure.
    pub(crate) fn new(record: &Record, factor: f64, structure: &Structure, has_account: bool) -> GroundMotion {
        let times = record.times.clone();
        let accelerations: Vec<f64> = record.accelerations.iter().map(|a| a * factor).collect();
        let spacing = spacing_of(&times);
        let lengths = segment_lengths(&times);
        let passed = passed(&lengths, &accelerations);
        let mut distinct: Vec<f64> = lengths.clone();
        distinct.sort_by(f64::total_cmp);
        distinct.dedup();
        distinct.truncate(MOST_PREPARED);
        if !distinct.contains(&spacing) {
            distinct.push(spacing);
        }
        let accounted = if has_account { &distinct[..] } else { &[] };
        let work = accounted.iter().map(|length| FlightWork::of(structure, *length)).collect();
        let prepared = distinct.into_iter().map(|length| Interval::new(structure.in_flight(), length)).collect();
        GroundMotion { times, accelerations, spacing, lengths, passed, prepared, work }
    }

    /// The segment that contains a time, s.
    pub(crate) fn segment_at(&self, time: f64) -> Segment {
        let first = self.times.first().copied().unwrap_or(time);
        if time < first {
            return Segment::at_rest(time, self.spacing.min(first - time), RecordPlace::Outside);
        }
        let sample = self.times.partition_point(|t| *t <= time) - 1;
        if sample < self.lengths.len() {
            return self.sample(sample);
        }
        let end = self.times[sample];
        self.after(((time - end) / self.spacing).floor().max(0.0) as u64)
    }

    /// Number of segments between two times, s, other than those before and within the record.
    pub(crate) fn segments_after(&self, from: f64, until: f64) -> f64 {
        let end = self.times.last().copied().unwrap_or(from);
        (until - from.max(end)) / self.spacing
    }

    /// Whether the number of segments between two times, other than those before and within the record, exceeds
    /// `segments`.
    pub(crate) fn are_more_after(&self, (from, until): (f64, f64), segments: f64) -> bool {
        until - from > segments * self.spacing && self.segments_after(from, until) > segments
    }

    /// The segment that follows another.
    pub(crate) fn following(&self, segment: &Segment) -> Segment {
        match self.number(segment) {
            Some(number) => self.segment(number + 1),
            None => self.segment_at(segment.start + segment.length),
        }
    }

    /// The segment with a number, counted from the first sample and on after the record's end.
    #[inline(always)]
    pub(crate) fn segment(&self, number: u64) -> Segment {
        let samples = self.lengths.len() as u64;
        if number < samples { self.sample(number as usize) } else { self.after(number - samples) }
    }

    /// The end of a segment, s: the start of the one that follows, from which the start and the length may differ by
    /// rounding.
    #[inline(always)]
    pub(crate) fn end_of(&self, segment: &Segment) -> f64 {
        match segment.place {
            RecordPlace::Outside => segment.start + segment.length,
            RecordPlace::Sample(i) => self.times[i + 1],
            RecordPlace::After(k) => self.start_after(k + 1),
        }
    }

    /// Whether a number is that of a segment of the record.
    pub(crate) fn is_in_record(&self, number: u64) -> bool {
        number < self.lengths.len() as u64
    }

    /// The exact flight over a whole segment, where its length has been prepared.
    pub(crate) fn prepared(&self, segment: &Segment) -> Option<&Interval> {
        self.prepared.iter().find(|interval| interval.length == segment.length)
    }

    /// The work over flights of the length of a segment, s, where it has been prepared.
    pub(crate) fn work_over(&self, length: f64) -> Option<&FlightWork> {
        self.work.iter().find(|work| work.length == length && !cfg!(without = "flight_work"))
    }

    /// The number of a segment, counted on after the record's end; `None` before the first sample.
    pub(crate) fn number(&self, segment: &Segment) -> Option<u64> {
        match segment.place {
            RecordPlace::Outside => None,
            RecordPlace::Sample(i) => Some(i as u64),
            RecordPlace::After(k) => Some(self.lengths.len() as u64 + k),
        }
    }

    /// Whether a segment is one of this record's.
    pub(crate) fn has(&self, segment: &Segment) -> bool {
        const MOST: u64 = 1 << 53;
        // A forged state may contain any number.
        let own = match segment.place {
            _ if segment.start.is_nan() => return false,
            RecordPlace::Outside => self.segment_at(segment.start),
            RecordPlace::Sample(i) if i < self.lengths.len() => self.sample(i),
            RecordPlace::After(k) if k < MOST => self.after(k),
            RecordPlace::Sample(_) | RecordPlace::After(_) => return false,
        };
        own == *segment
    }

    /// Bounds on the ground motion from the start of a segment on.
    pub(crate) fn ahead_of(&self, number: u64) -> Ahead<'_> {
        let (start, before) = self.passed_at(number);
        Ahead { ground: self, number, start, before }
    }

    /// From the first sample to the start of a segment: time, s, and integral of |acceleration|, m/s.
    #[inline(always)]
    fn passed_at(&self, number: u64) -> (f64, f64) {
        match self.passed.get(number as usize) {
            Some(passed) => *passed,
            None => self.passed_after(number),
        }
    }

    #[cold]
    fn passed_after(&self, number: u64) -> (f64, f64) {
        let last = self.lengths.len();
        let (time, cumulative) = self.passed[last];
        (time + (number - last as u64) as f64 * self.spacing, cumulative)
    }

    #[inline(always)]
    fn sample(&self, i: usize) -> Segment {
        let (start, length, ends) =
            (self.times[i], self.lengths[i], [self.accelerations[i], self.accelerations[i + 1]]);
        Segment { start, length, acceleration: ends[0], slope: slope(ends, length), place: RecordPlace::Sample(i) }
    }

    /// The start of a segment after the record's end, s.
    #[inline(always)]
    fn start_after(&self, k: u64) -> f64 {
        self.times[self.times.len() - 1] + k as f64 * self.spacing
    }

    #[inline(always)]
    fn after(&self, k: u64) -> Segment {
        Segment::at_rest(self.start_after(k), self.spacing, RecordPlace::After(k))
    }
}

/// Bounds on the ground motion from the start of a segment on.
pub(crate) struct Ahead<'a> {
    ground: &'a GroundMotion,
    /// Number of the segment.
    number: u64,
    /// Time, s, from the first sample to that start.
    start: f64,
    /// Integral of |acceleration|, m/s, from the first sample to that start.
    before: f64,
}

impl Ahead<'_> {
    /// Duration of the next `segments` segments, s, and integral of |acceleration| over them, m/s: upper bounds.
    #[inline(always)]
    pub(crate) fn over(&self, segments: u64) -> (f64, f64) {
        const ROUNDING: f64 = 4.0 * f64::EPSILON;
        let (end, after) = self.ground.passed_at(self.number + segments);
        (end - self.start + ROUNDING * end, after - self.before + ROUNDING * after)
    }
}

#[inline(always)]
fn slope([start, end]: [f64; 2], length: f64) -> f64 {
    (end - start) / length
}

/// Time, s, and integral of |acceleration|, m/s, up to each sample. The sums are compensated (Neumaier), since their
/// differences are used.
fn passed(lengths: &[f64], accelerations: &[f64]) -> Vec<(f64, f64)> {
    let (mut time, mut cumulative) = (Sum::default(), Sum::default());
    let mut passed = vec![(0.0, 0.0)];
    for (length, ends) in lengths.iter().zip(accelerations.windows(2)) {
        time.add(*length);
        // The trapezoid rule is an upper bound for |a|, which is convex where a is linear.
        cumulative.add(0.5 * length * (ends[0].abs() + ends[1].abs()));
        passed.push((time.exact(), cumulative.exact()));
    }
    passed
}

/// The mean spacing of sample times, s.
fn spacing_of(times: &[f64]) -> f64 {
    let n = times.len() - 1;
    (times[n] - times[0]) / n as f64
}

/// Differences of the sample times. If the times are multiples of one spacing but for their rounding, all segments get
/// exactly that length, so that one prepared flight serves them all.
fn segment_lengths(times: &[f64]) -> Vec<f64> {
    let (n, spacing) = (times.len() - 1, spacing_of(times));
    let rounding = 4.0 * f64::EPSILON * times[0].abs().max(times[n].abs());
    let even = times.iter().enumerate().all(|(k, t)| (t - (times[0] + k as f64 * spacing)).abs() <= rounding);
    if even { vec![spacing; n] } else { times.windows(2).map(|pair| pair[1] - pair[0]).collect() }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::scene::Scene;

    fn motion_of(times: Vec<f64>) -> GroundMotion {
        let building = "mass = [1e3]\nstiffness = [1e5]\ndamping = { ratio = 0.05 }\n";
        let scene = format!("name = \"Two\"\n[left]\n{building}[right]\n{building}");
        let scene = Scene::from_toml(&scene).unwrap();
        let structure = Structure::of(&scene).ok().unwrap();
        let record = Record::new(times.clone(), times.iter().map(|time| time.sin()).collect());
        GroundMotion::new(&record, 1.0, &structure, true)
    }

    /// Without that a run long beyond its record costs ten times as much.
    #[test]
    fn the_flight_over_a_segment_after_the_end_is_prepared() {
        let even = (0..2001).map(|k| f64::from(k) * 0.01).collect();
        let uneven = (0..30).map(|k| 0.1 * f64::from(k) + 1e-3 * f64::from(k * k % 7)).collect();
        for motion in [even, uneven].map(motion_of) {
            let end = motion.times.len() as u64 - 1;
            assert!(motion.prepared(&motion.segment(end - 1)).is_some() || motion.prepared.len() > MOST_PREPARED);
            for segment in [motion.segment(end), motion.segment(end + 1000)] {
                assert!(
                    motion.prepared(&segment).is_some() && motion.work_over(segment.length).is_some(),
                    "{segment:?}"
                );
            }
        }
    }

    #[test]
    fn a_segment_that_starts_nowhere_is_none_of_the_motion() {
        let motion = motion_of(vec![1.0, 2.0, 3.0]);
        for time in [0.0, 1.5, 10.0] {
            let segment = motion.segment_at(time);
            assert!(motion.has(&segment));
            assert!(!motion.has(&Segment { start: f64::NAN, ..segment }));
        }
    }
}
