//! Scratch memory for peaks, and results that are kept from segment to segment and from quantity to quantity. None of
//! it changes a result, so no saved state holds it.

use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::stretch::ModeBounds;
use crate::engine::peaks::fold_room::FoldRoom;
use crate::engine::quantities::rows::{PeakOf, PeakRows};
use crate::engine::quantities::span_rows::SpanRows;
use crate::engine::system::buffers::Buffers;
use crate::structure::{BuildingId, Interval, LANES, Structure};

/// Number of parts of flights that are kept prepared.
const MOST_PARTS: usize = 32;

/// Largest number of leaves of a piece of a flight, whose ends are read together; a power of 2.
pub const LEAVES: usize = 16;

/// Number of motions within a flight that are kept.
const MOST_FLOWN: usize = 32;

/// Largest number of pieces in which a flight is searched for one quantity. Only the undamped free vibration of several
/// modes over thousands of periods in one communication step needs more; maxima that it reaches later are missed, which
/// `cut_short` counts.
pub const MOST_PIECES: u32 = 10_000;

/// The latest results of something that is worked out for one time, s, and then for another.
#[derive(Clone, Debug, Default)]
pub struct Latest<T> {
    /// By their times; NaN: none yet.
    kept: Vec<(f64, T)>,
    /// Index of the next one to be replaced.
    next: usize,
}

impl<T: Clone> Latest<T> {
    fn new(room: T, count: usize) -> Latest<T> {
        Latest { kept: vec![(f64::NAN, room); count], next: 0 }
    }

    /// The result for a time, and whether it is known; otherwise it is to be worked out in place of the oldest one.
    pub fn of(&mut self, time: f64) -> (&mut T, bool) {
        let known = self.kept.iter().position(|(of, _)| *of == time);
        let place = known.unwrap_or_else(|| {
            let place = self.next;
            self.next = (place + 1) % self.kept.len();
            self.kept[place].0 = time;
            place
        });
        (&mut self.kept[place].1, known.is_some())
    }

    /// Forgets all results.
    fn forget(&mut self) {
        self.kept.iter_mut().for_each(|(time, _)| *time = f64::NAN);
    }
}

/// A quantity that may exceed its peak within a flight.
#[derive(Clone, Copy, Debug)]
pub struct Suspect {
    pub of: PeakOf,
    /// Its index among the quantities of all blocks.
    pub place: usize,
    /// The largest magnitude that has been found.
    pub peak: f64,
    /// Its values at the ends of the leaves that are searched.
    pub values: [f64; LEAVES + 1],
    /// The leaves in which it may turn above its peak, as bits.
    pub leaves: u32,
    /// A bound on its second derivative, from the start of the piece that is searched on.
    pub bend: f64,
    /// Number of pieces in which the flight may still be searched for it.
    pub pieces_left: u32,
    /// If it is known not to exceed its peak in the piece that is searched, or in one that this is a half of: the
    /// number of times that the latter may be halved.
    pub cleared_in: Option<u32>,
}

/// A quantity that may exceed its peak within a step in contact.
#[derive(Clone, Copy, Debug)]
pub struct OpenQuantity {
    pub of: PeakOf,
    /// Its index among the quantities of all blocks.
    pub place: usize,
    /// Its values at both ends of the step.
    pub ends: [f64; 2],
    /// An upper bound on its magnitude.
    pub upper: f64,
}

impl OpenQuantity {
    /// Whether it may exceed its peak; a NaN may.
    pub fn may_exceed(&self, peaks: &Peaks) -> bool {
        let is_below = self.upper <= peaks.values[self.place];
        !is_below
    }
}

/// Scratch memory; between calls only the end of the last step in `floors` means anything.
#[derive(Clone, Debug)]
pub struct PeakRoom {
    pub fold: FoldRoom,
    /// Bounds on the modes over a flight.
    pub bounds: ModeBounds,
    /// Bounds on the modes over a piece of a flight.
    pub piece: ModeBounds,
    /// The quantities for which the flight is to be searched, by their places.
    pub suspects: Vec<Suspect>,
    /// q and v at times of the flight that is searched: several quantities need those at the same halvings.
    pub flown: Latest<[Vec<f64>; 2]>,
    /// Number of motions that have been worked out there, of all flights.
    pub motions: u64,
    /// Number of searches of a flight for one quantity that took all of their pieces, so that they may have ended before it.
    pub cut_short: u64,
    /// Exact flights over the first parts of flights: those of equal lengths have the same parts.
    pub parts: Latest<Interval>,
    /// q and v at the start and at the end of a piece.
    pub pieces: [Vec<f64>; 4],
    /// The modal load at the start of a piece.
    pub load: Vec<f64>,
    /// For each mode that has settled in a piece, the rate at which it creeps, 1/s; NaN for all others (`settled.rs`).
    pub creeps: Vec<f64>,
    /// A row over the motion and one over its rate.
    pub rows: [Vec<f64>; 2],
    /// For each watched quantity what a master's pushes add at once at the start of a flight, and the rate of that; 0 without a
    /// master.
    pub direct: Vec<[f64; 2]>,
    pub floors: FloorRoom,
    /// The floors within a step that is a power series.
    pub within: FloorState,
    /// Those of which some quantity may exceed its peak.
    pub open_buildings: Vec<BuildingId>,
    /// What may exceed its peak within a step in contact.
    pub open: Vec<OpenQuantity>,
    /// Bounds on the magnitudes of the contact forces over a step, N.
    pub strongest: Vec<f64>,
    /// The contact forces at the start of a step, N.
    pub first_forces: Vec<f64>,
    /// The contact forces at its end, N.
    pub last_forces: Vec<f64>,
    /// Penetrations, m, and rates, m/s, at a time within a step.
    pub pairs: Vec<(f64, f64)>,
}

impl PeakRoom {
    pub fn new(
        structure: &Structure,
        (rows, of_spans): (&PeakRows, &SpanRows),
        pairs: usize,
        flights: usize,
    ) -> PeakRoom {
        let (lanes, buildings) = (structure.lanes, structure.ids().count());
        PeakRoom {
            fold: FoldRoom::new(rows, of_spans, flights),
            bounds: ModeBounds::new(lanes),
            piece: ModeBounds::new(lanes),
            suspects: Vec::with_capacity(rows.blocks() * LANES),
            flown: Latest::new([(); 2].map(|()| vec![0.0; lanes]), if rows.are_none() { 0 } else { MOST_FLOWN }),
            motions: 0,
            cut_short: 0,
            parts: Latest::new(Interval::room(structure), if rows.are_none() { 0 } else { MOST_PARTS }),
            pieces: [(); 4].map(|()| vec![0.0; lanes]),
            load: vec![0.0; lanes],
            creeps: vec![f64::NAN; lanes],
            rows: [(); 2].map(|()| vec![0.0; lanes]),
            direct: vec![[0.0; 2]; rows.blocks() * LANES],
            floors: FloorRoom::new(lanes, buildings),
            within: FloorState::new(lanes, buildings),
            open_buildings: Vec::with_capacity(buildings),
            open: Vec::with_capacity(rows.blocks() * LANES),
            strongest: vec![0.0; pairs],
            first_forces: vec![0.0; pairs],
            last_forces: vec![0.0; pairs],
            pairs: vec![(0.0, 0.0); pairs],
        }
    }

    /// Begins the search of another flight.
    pub fn start_flight(&mut self) {
        self.suspects.clear();
        self.flown.forget();
    }

    /// Forgets all results that are kept: the motion has been replaced.
    pub fn forget(&mut self) {
        self.floors.forget();
    }
}

/// The scratch memory of one call: the vectors that all kinds of steps share, and the peaks' own.
pub struct PeakWork<'a> {
    pub buffers: &'a mut Buffers,
    pub peaks: &'a mut PeakRoom,
}

/// All floors at one time.
#[derive(Clone, Debug, Default)]
pub struct FloorState {
    /// Displacements, m.
    pub u: Vec<f64>,
    /// Velocities, m/s.
    pub v: Vec<f64>,
    /// Drifts of the storeys below the floors, m.
    pub drift: Vec<f64>,
    /// Their rates, m/s.
    pub drifting: Vec<f64>,
    /// Accelerations by stiffness and damping of the buildings and by what a master pushes with, m/s2.
    pub resisted: Vec<f64>,
    /// Base shears of the buildings, N.
    pub shear: Vec<f64>,
    /// Shears of the storeys below the floors, where these can be corrected, N.
    pub storey_shear: Vec<f64>,
}

impl FloorState {
    pub fn new(lanes: usize, buildings: usize) -> FloorState {
        let vector = || vec![0.0; lanes];
        FloorState {
            u: vector(),
            v: vector(),
            drift: vector(),
            drifting: vector(),
            resisted: vector(),
            shear: vec![0.0; buildings],
            storey_shear: vector(),
        }
    }
}

/// Scratch memory for the floors over a step in contact.
#[derive(Clone, Debug, Default)]
pub struct FloorRoom {
    pub start: FloorState,
    pub end: FloorState,
    /// Accelerations of each floor by contact forces at the start and at the end, m/s2.
    pub pushes: [Vec<f64>; 2],
    /// Least accelerations of each floor by contact forces, m/s2.
    pub least: Vec<f64>,
    /// Largest accelerations of each floor by contact forces, m/s2.
    pub most: Vec<f64>,
    /// B, and at last A, m/s2 (see `floors.rs`).
    pub largest: Vec<f64>,
    /// Largest second derivatives of the drifts, m/s2.
    pub largest_of_drifts: Vec<f64>,
    /// Accelerations of each floor relative to the ground at the start and at the end, m/s2.
    pub accelerations: [Vec<f64>; 2],
    /// The same relative to the floor below, or on soil to what a foundation moves it by.
    pub drift_accelerations: [Vec<f64>; 2],
    /// Bounds on the deviation of r from its chord, m/s2.
    pub strays: Vec<f64>,
    /// The same of the accelerations relative to the floor below.
    pub drift_strays: Vec<f64>,
    /// Upper bounds on the magnitudes of displacement, drift and acceleration of each floor.
    pub upper: [Vec<f64>; 3],
    /// Scratch vector on modes.
    pub modal: Vec<f64>,
    /// The time of `end`: bits of the start of its segment and of the time since then.
    pub known: Option<[u64; 2]>,
}

impl FloorRoom {
    pub fn new(lanes: usize, buildings: usize) -> FloorRoom {
        let vector = || vec![0.0; lanes];
        FloorRoom {
            start: FloorState::new(lanes, buildings),
            end: FloorState::new(lanes, buildings),
            pushes: [vector(), vector()],
            least: vector(),
            most: vector(),
            largest: vector(),
            largest_of_drifts: vector(),
            accelerations: [vector(), vector()],
            drift_accelerations: [vector(), vector()],
            strays: vector(),
            drift_strays: vector(),
            upper: [vector(), vector(), vector()],
            modal: vector(),
            known: None,
        }
    }

    /// Forgets the time of `end`, so that the next step works out its start again.
    pub fn forget(&mut self) {
        self.known = None;
    }

    /// Takes the end of the last step as the start of the next one if that is at the given time; returns whether it is.
    pub fn go_on(&mut self, time: [f64; 2]) -> bool {
        let goes_on = self.known == Some(time.map(f64::to_bits));
        if goes_on {
            std::mem::swap(&mut self.start, &mut self.end);
        }
        goes_on
    }

    /// Notes the time of the end.
    pub fn keep(&mut self, time: [f64; 2]) {
        self.known = Some(time.map(f64::to_bits));
    }
}
