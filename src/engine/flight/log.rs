//! Logs of flights that are looked at later, many at once.
//!
//! Most quantities never come near their peaks, and which do is known best when the peaks are almost known. So flights
//! are only logged; the log is folded into the peaks (`peaks/fold.rs`) when it is full, when an element begins to yield, and
//! before a state is saved. Whoever reads a peak folds what is logged into a copy.
//!
//! Where damping couples modes, a second log holds the flights that wait to be added to the energy account (`energy.rs`).

use crate::engine::bounds::flights::{Flights, Forces, Load};
use crate::numerics::identity::next_identity;
use crate::structure::{LANES, Motion};

/// Number of entries of a log: that many, so many more for each lane of modes, and at most. A long log leaves less to be
/// searched, which counts where there are many quantities; a short one touches less memory for the first time, which counts in
/// short runs.
const FEW: usize = 448;
const FOR_LANE: usize = 4;
const MOST: usize = 1024;
/// Largest number of bytes.
const MOST_BYTES: usize = 4 << 20;
/// Least number: a flight with a gap after it, and as many more.
const LEAST: usize = 4;

/// The motions at the starts of flights that follow each other, oldest first. The last flight ends at the base, unless the
/// log is closed: then a gap is its last entry.
#[derive(Debug, Default)]
pub struct FlightLog {
    lanes: usize,
    most: usize,
    q: Vec<f64>,
    v: Vec<f64>,
    loads: Vec<Load>,
    /// In scenes in which a master pushes on the buildings.
    forces: Option<ForceLog>,
    /// A number that no other log has had, and this one not before it was last emptied.
    pub identity: u64,
}

/// The forces of a master during the logged flights, as [`Forces`] has them.
#[derive(Debug)]
struct ForceLog {
    /// Number of them.
    count: usize,
    energies: Vec<f64>,
    of: Vec<usize>,
    sets: Vec<f64>,
}

impl FlightLog {
    /// For vectors of that many lanes, with so many forces of a master.
    pub fn new(lanes: usize, forces: usize) -> FlightLog {
        let numbers = 2 * lanes + if forces == 0 { 0 } else { lanes + 2 * forces };
        let wanted = (FEW + FOR_LANE * lanes).min(MOST);
        let most = if lanes == 0 { 0 } else { wanted.min(MOST_BYTES / (8 * numbers)).max(LEAST) };
        FlightLog::with_room((lanes, forces), most)
    }

    /// A log for so many entries.
    pub fn with_room((lanes, forces): (usize, usize), most: usize) -> FlightLog {
        let room = || Vec::with_capacity(most * lanes);
        FlightLog {
            lanes,
            most,
            q: room(),
            v: room(),
            loads: Vec::with_capacity(most),
            forces: (forces > 0).then(|| ForceLog::new(lanes, forces, most)),
            identity: next_identity(),
        }
    }

    /// Empties the log.
    pub fn clear(&mut self) {
        self.truncate(0);
        self.identity = next_identity();
    }

    /// Keeps only the first entries.
    pub fn truncate(&mut self, count: usize) {
        self.q.truncate(count * self.lanes);
        self.v.truncate(count * self.lanes);
        self.loads.truncate(count);
        self.forces.iter_mut().for_each(|forces| forces.truncate(count, self.lanes));
    }

    /// Number of entries.
    pub fn count(&self) -> usize {
        self.loads.len()
    }

    /// Whether anything is logged at all.
    pub fn is_kept(&self) -> bool {
        self.most > 0
    }

    /// Largest number of entries.
    pub fn capacity(&self) -> usize {
        self.most
    }

    /// Number of flights that still fit, with a gap after them.
    pub fn room(&self) -> usize {
        (self.most - self.loads.len()).saturating_sub(1)
    }

    /// Whether no flight fits any more.
    pub fn is_full(&self) -> bool {
        self.is_kept() && self.room() == 0
    }

    /// Whether the last flight ends at the base.
    pub fn is_open(&self) -> bool {
        self.loads.last().is_some_and(|load| load.length > 0.0)
    }

    /// Adds a flight by the motion at its start.
    pub fn push(&mut self, Motion { q, v }: Motion, load: Load) {
        for (all, one) in [(&mut self.q, q), (&mut self.v, v)] {
            // Block by block: most have one or two, for which a call that copies any number costs more.
            one.as_chunks::<LANES>().0.iter().for_each(|block| all.extend(block));
        }
        self.loads.push(load);
    }

    /// Adds the forces of a master during the flight that has just been added, N, with their rates, and the energies of
    /// its modes, which are to be written.
    pub fn push_forces(&mut self, forces: impl Iterator<Item = (f64, f64)>, set_energies: impl FnOnce(&mut [f64])) {
        if let Some(of) = &mut self.forces {
            let start = of.energies.len();
            of.energies.resize(start + self.lanes, 0.0);
            set_energies(&mut of.energies[start..]);
            of.push_set(forces);
        }
    }

    /// Ends the last flight at a motion, where something other than the ground and a master's forces is about to move
    /// the buildings.
    pub fn close(&mut self, motion: Motion) {
        if let Some(load) = self.loads.last().copied().filter(|load| load.length > 0.0) {
            self.push(motion, load.gap());
            self.push_forces(std::iter::empty(), |_| ());
        }
    }

    /// The logged flights from an entry on; the last one ends at the base, with the motion `end`.
    pub fn flights_from<'a>(&'a self, entry: usize, end: Motion<'a>) -> Flights<'a> {
        let from = entry * self.lanes;
        let forces = self.forces.as_ref().map(|ForceLog { count, energies, of, sets }| Forces {
            energies: &energies[from..],
            of: &of[entry..],
            sets,
            width: *count,
        });
        Flights { lanes: self.lanes, q: &self.q[from..], v: &self.v[from..], loads: &self.loads[entry..], end, forces }
    }
}

impl ForceLog {
    fn new(lanes: usize, count: usize, most: usize) -> ForceLog {
        let mut sets = Vec::with_capacity((most + 2) * 2 * count);
        sets.resize(2 * count, 0.0);
        ForceLog { count, energies: Vec::with_capacity(most * lanes), of: Vec::with_capacity(most), sets }
    }

    fn truncate(&mut self, count: usize, lanes: usize) {
        self.energies.truncate(count * lanes);
        self.of.truncate(count);
        let used = self.of.iter().max().map_or(1, |last| last + 1);
        self.sets.truncate(used * 2 * self.count);
    }

    /// Notes all forces, or none, as those of the next flight; those of the last one, or none, need no new set.
    fn push_set(&mut self, forces: impl Iterator<Item = (f64, f64)>) {
        let (start, width) = (self.sets.len(), self.count);
        self.sets.resize(start + 2 * width, 0.0);
        let (before, new) = self.sets.split_at_mut(start);
        let (values, rates) = new.split_at_mut(width);
        for ((value, rate), force) in values.iter_mut().zip(rates).zip(forces) {
            (*value, *rate) = force;
        }
        let known = match before {
            _ if new.iter().all(|number| *number == 0.0) => Some(0),
            _ if before.ends_with(new) => Some(start / (2 * width) - 1),
            _ => None,
        };
        if known.is_some() {
            self.sets.truncate(start);
        }
        self.of.push(known.unwrap_or(start / (2 * width)));
    }
}

impl Clone for FlightLog {
    fn clone(&self) -> FlightLog {
        let forces = self.forces.as_ref().map_or(0, |forces| forces.count);
        let mut log = FlightLog::with_room((self.lanes, forces), self.most);
        log.q.extend_from_slice(&self.q);
        log.v.extend_from_slice(&self.v);
        log.loads.extend_from_slice(&self.loads);
        if let (Some(copy), Some(forces)) = (&mut log.forces, &self.forces) {
            copy.energies.extend_from_slice(&forces.energies);
            copy.of.extend_from_slice(&forces.of);
            copy.sets.clone_from(&forces.sets);
        }
        log
    }
}
