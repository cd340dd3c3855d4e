//! Peaks beside what is read at the same time.

use super::Run;
use pounding::engine::{FoundationOutput, Output, PeakOf};

/// A quantity whose peak is kept.
pub struct Read {
    pub name: String,
    /// Its value now.
    pub now: f64,
    pub peak: f64,
}

/// All of them, each kind by itself.
pub fn all(run: &Run) -> [Vec<Read>; 5] {
    let [mut displacements, mut drifts, mut accelerations, mut shears] = [const { Vec::new() }; 4];
    let read = |of: PeakOf, now: f64| Read { name: format!("{of:?}"), now, peak: run.peak(of) };
    for &side in &run.ids {
        for floor in 0..run.model.floors(side) {
            let moved = run.displacement(side, floor);
            displacements.push(read(PeakOf::Displacement(side, floor), moved));
            drifts.push(read(PeakOf::Drift(side, floor), run.drift(side, floor)));
            let acceleration = run.read(Output::Acceleration(side, floor));
            accelerations.push(read(PeakOf::Acceleration(side, floor), acceleration));
        }
        shears.push(read(PeakOf::BaseShear(side), run.read(Output::BaseShear(side))));
    }
    // A pull is no peak.
    let contacts = run.contacts().into_iter().enumerate().map(|(p, contact)| Read {
        name: format!("force of contact {}", p + 1),
        now: contact.force.max(0.0),
        peak: contact.peak_force,
    });
    [displacements, drifts, accelerations, shears, contacts.collect()]
}

/// What the rounding of each kind that `all` returns is a share of: the terms that its values are sums of.
///
/// The foundations are floors like any other in the modes of their building, or of both where they are linked, and the
/// values of the floors above them are differences of large terms. A drift that is read is a difference of displacements.
/// A contact force is read as it is added to its peak.
fn sizes(run: &Run, kinds: &[Vec<Read>; 5], foundations: f64) -> [f64; 5] {
    let [displacements, _, accelerations, shears, _] =
        kinds.each_ref().map(|kind| kind.iter().fold(0.0, |largest: f64, read| largest.max(read.peak)));
    let (mut moved, mut sheared) = (displacements, shears);
    for &side in &run.ids {
        let of = |of| run.read(Output::Foundation(side, of));
        let height: f64 = run.leaning[side.index()].iter().sum();
        moved = moved.max(of(FoundationOutput::PeakDisplacement)).max(height * of(FoundationOutput::PeakRotation));
        sheared = sheared.max(of(FoundationOutput::PeakForce));
    }
    [moved, moved, accelerations.max(foundations), sheared, 0.0]
}

/// Follows the peaks of a run.
#[derive(Default)]
pub struct Watch {
    before: Vec<f64>,
    /// Largest acceleration of a foundation that has been read, m/s2.
    foundations: f64,
}

/// Rounding of a value, as a share of the terms that it is the sum of: 45 units in the last place, for two sums of up to
/// a dozen modes each in another order, one of numbers that are sums themselves.
const ROUNDING: f64 = 1e-14;

/// Digits that a peak promises.
const PROMISED: f64 = 1e-10;

impl Watch {
    /// What is wrong with the peaks of a run that has been read: none is below the value at that time, but for the digits
    /// that a peak promises and the rounding of the terms of the value, and no peak of a contact force by more than its
    /// last digit; none has fallen since the last time by more than the rounding of floors that are held or of storeys far
    /// beyond their yield drift.
    pub fn look(&mut self, run: &Run) -> Result<(), String> {
        let time = run.state.time();
        for &side in &run.ids {
            let now = run.read(Output::Foundation(side, FoundationOutput::Acceleration)).abs();
            self.foundations = self.foundations.max(now);
        }
        let kinds = all(run);
        let (sizes, mut peaks) = (sizes(run, &kinds, self.foundations), Vec::with_capacity(self.before.len()));
        for (kind, size) in kinds.into_iter().zip(sizes) {
            let promised = if size == 0.0 { f64::EPSILON } else { PROMISED };
            for Read { name, now, peak } in kind {
                if now.abs() > peak + promised * peak + ROUNDING * size {
                    return Err(format!("{name} at {time} s: {now:e} beyond its peak {peak:e}"));
                }
                if let Some(before) = self.before.get(peaks.len()).filter(|before| **before * (1.0 - 1e-11) > peak) {
                    return Err(format!("{name} at {time} s: its peak falls from {before:e} to {peak:e}"));
                }
                peaks.push(peak);
            }
        }
        self.before = peaks;
        Ok(())
    }
}
