//! Peaks beside what is read at the same time.

use super::Run;
use pounding::engine::{Output, PeakOf, Side};

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
    for side in [Side::Left, Side::Right] {
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

/// Follows the peaks of a run.
#[derive(Default)]
pub struct Watch {
    before: Vec<f64>,
}

impl Watch {
    /// What is wrong with the peaks of a run that has been read: none is below the value at that time, but for the digits that a peak
    /// promises and the rounding of the quickest floor; none has fallen since the last time by
    /// more than the rounding of floors that are held or of storeys far beyond their yield drift.
    pub fn look(&mut self, run: &Run) -> Result<(), String> {
        let time = run.state.time();
        let mut peaks = Vec::with_capacity(self.before.len());
        for kind in all(run) {
            let largest = kind.iter().fold(0.0, |largest: f64, read| largest.max(read.peak));
            for Read { name, now, peak } in kind {
                if now.abs() > peak + 1e-10 * peak + 1e-14 * largest {
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
