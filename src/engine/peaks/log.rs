//! The log of flights over which the peaks have not been raised yet.
//!
//! Most quantities never come near their peaks, and which do is known best when the peaks are almost known. So flights
//! are only logged; the log is folded into the peaks (`fold.rs`) when it is full, before a contact if it is long, when a
//! storey begins to yield, and before a state is saved. Whoever reads a peak folds what is logged into a copy.

use crate::engine::base::Base;
use crate::engine::bounds::flights::{Flights, Load};
use crate::engine::flight::fast_account::SegmentAccount;
use crate::structure::Lane;
use std::sync::atomic::{AtomicU64, Ordering};

/// Largest number of logged motions, and of bytes.
const MOST: usize = 1024;
const MOST_BYTES: usize = 4 << 20;
/// Least number: a flight with a gap before and one after it.
const LEAST: usize = 4;

/// Change of the ground's acceleration from one flight to the next, relative to it, that is no rounding.
const JUMP: f64 = 1e-12;

/// The motions at the starts of flights that follow each other, oldest first. The last flight ends at the base, unless the
/// log is closed: then a gap is its last entry.
#[derive(Debug, Default)]
pub struct PeakLog {
    lanes: usize,
    most: usize,
    q: Vec<f64>,
    v: Vec<f64>,
    loads: Vec<Load>,
    /// A number that no other log has had, and this one not before it was last emptied.
    pub identity: u64,
}

impl PeakLog {
    pub fn new(lanes: usize) -> PeakLog {
        PeakLog::with_room(lanes, if lanes == 0 { 0 } else { MOST.min(MOST_BYTES / (16 * lanes)).max(LEAST) })
    }

    /// A log for so many entries.
    pub fn with_room(lanes: usize, most: usize) -> PeakLog {
        let room = || Vec::with_capacity(most * lanes);
        PeakLog { lanes, most, q: room(), v: room(), loads: Vec::with_capacity(most), identity: next_identity() }
    }

    /// Empties the log.
    pub fn clear(&mut self) {
        self.q.clear();
        self.v.clear();
        self.loads.clear();
        self.identity = next_identity();
    }

    /// Keeps only the first entries.
    pub fn truncate(&mut self, count: usize) {
        self.q.truncate(count * self.lanes);
        self.v.truncate(count * self.lanes);
        self.loads.truncate(count);
    }

    /// Number of entries.
    pub fn count(&self) -> usize {
        self.loads.len()
    }

    /// Number of entries that still fit.
    pub fn room(&self) -> usize {
        self.most - self.loads.len()
    }

    /// Whether the last flight ends at the base.
    pub fn is_open(&self) -> bool {
        self.loads.last().is_some_and(|load| load.length > 0.0)
    }

    /// Adds a flight by the motion at its start.
    pub fn push(&mut self, (q, v): (&[f64], &[f64]), load: Load) {
        self.q.extend_from_slice(q);
        self.v.extend_from_slice(v);
        self.loads.push(load);
    }

    /// Ends the last flight at a motion, where something other than the ground is about to move the buildings.
    pub fn close(&mut self, motion: (&[f64], &[f64])) {
        if let Some(Load { acceleration, slope, length }) = self.loads.last().copied().filter(|load| load.length > 0.0)
        {
            self.push(motion, Load { acceleration: acceleration + slope * length, slope: 0.0, length: 0.0 });
        }
    }

    /// Makes the log ready for a flight that starts with a motion and an acceleration of the ground, m/s2: ends the last
    /// one there if the acceleration jumps.
    pub fn go_on(&mut self, motion: (&[f64], &[f64]), acceleration: f64) {
        if let Some(load) = self.loads.last() {
            let end = load.acceleration + load.slope * load.length;
            if (end - acceleration).abs() > JUMP * (load.acceleration.abs() + end.abs()) {
                self.close(motion);
            }
        }
    }

    /// The logged flights from an entry on; the last one ends at the base, with the motion `end`.
    pub fn flights_from<'a>(&'a self, entry: usize, end: (&'a [f64], &'a [f64])) -> Flights<'a> {
        let from = entry * self.lanes;
        Flights { lanes: self.lanes, q: &self.q[from..], v: &self.v[from..], loads: &self.loads[entry..], end }
    }
}

impl Clone for PeakLog {
    fn clone(&self) -> PeakLog {
        let mut log = PeakLog::new(self.lanes);
        log.q.extend_from_slice(&self.q);
        log.v.extend_from_slice(&self.v);
        log.loads.extend_from_slice(&self.loads);
        log
    }
}

fn next_identity() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

/// An account that logs the segments as well.
pub struct Logged<'a, A> {
    pub account: A,
    pub log: &'a mut PeakLog,
    /// Length of the segments, s.
    pub length: f64,
}

impl<A: SegmentAccount> SegmentAccount for Logged<'_, A> {
    #[inline(always)]
    fn covers(&self, length: f64) -> bool {
        self.length == length && self.account.covers(length)
    }

    #[inline(always)]
    fn add(&mut self, motion: (&[Lane], &[Lane]), load: (f64, f64)) {
        let (q, v) = (motion.0.as_flattened(), motion.1.as_flattened());
        self.log.push((q, v), Load { acceleration: load.0, slope: load.1, length: self.length });
        self.account.add(motion, load);
    }

    #[inline(always)]
    fn store(self, base: &mut Base) {
        self.account.store(base);
    }
}
