//! Room to work in, and what is remembered from segment to segment and from quantity to quantity. It changes no result,
//! so no saved state holds it.

use crate::engine::system::buffers::Buffers;
use crate::engine::watched::rows::PeakRows;
use crate::structure::{LANES, Lane, Structure};

/// Places of a flight that are remembered.
pub const MOST_FLOWN: usize = 16;

/// The motion of all modes at a time of a flight, s since its start.
#[derive(Clone, Debug, Default)]
pub struct Flown {
    pub time: f64,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
}

/// Room to work in; between calls it means nothing but for what `floors` keeps of the end of a step and `ahead` of the time
/// to come.
#[derive(Clone, Debug, Default)]
pub struct PeakRoom {
    pub watch: PeakWatch,
    /// Of the modes over a flight, and over a piece of one.
    pub bounds: ModeBounds,
    pub piece: ModeBounds,
    /// The piece of a flight, from and to, s, over which the series in the workspace has been expanded.
    pub expanded: Option<(f64, f64)>,
    /// How many more pieces of a flight may be looked at.
    pub pieces_left: u32,
    /// Where the flight that is searched has been worked out, the latest last: halves of it are asked for by many
    /// quantities.
    pub flown: [Flown; MOST_FLOWN],
    pub next_flown: usize,
    /// q and v at both ends of a piece, and the load at its start.
    pub pieces: [Vec<f64>; 4],
    pub load: Vec<f64>,
    /// A row over q and one over v.
    pub rows: [Vec<f64>; 2],
    /// Of each place: what floor forces add to an acceleration at the start of a flight, m/s2, and its rate.
    pub direct: Vec<[f64; 2]>,
    pub floors: FloorRoom,
    pub reading: ReadingRoom,
    /// N, bounds on the sizes of the contact forces over a step.
    pub strongest: Vec<f64>,
    /// N, the contact forces at the start of a step and at its end.
    pub first_forces: Vec<f64>,
    pub last_forces: Vec<f64>,
    /// Penetrations, m, and rates, m/s, at the start.
    pub starts: Vec<(f64, f64)>,
    /// m/s2, what they push each floor by.
    pub first_push: Vec<f64>,
    pub last_push: Vec<f64>,
}

impl PeakRoom {
    pub fn new(structure: &Structure, rows: &PeakRows, pairs: usize) -> PeakRoom {
        let lanes = structure.lanes;
        PeakRoom {
            watch: PeakWatch::new(rows.blocks()),
            bounds: ModeBounds::new(lanes),
            piece: ModeBounds::new(lanes),
            expanded: None,
            pieces_left: 0,
            flown: std::array::from_fn(|_| Flown { time: f64::NAN, q: vec![0.0; lanes], v: vec![0.0; lanes] }),
            next_flown: 0,
            pieces: [(); 4].map(|()| vec![0.0; lanes]),
            load: vec![0.0; lanes],
            rows: [(); 2].map(|()| vec![0.0; lanes]),
            direct: vec![[0.0; 2]; rows.blocks() * LANES],
            floors: FloorRoom::new(lanes),
            reading: ReadingRoom::new(lanes),
            strongest: vec![0.0; pairs],
            first_forces: vec![0.0; pairs],
            last_forces: vec![0.0; pairs],
            starts: vec![(0.0, 0.0); pairs],
            first_push: vec![0.0; lanes],
            last_push: vec![0.0; lanes],
        }
    }

    /// Another flight is looked at.
    pub fn start_flight(&mut self) {
        self.expanded = None;
        self.flown.iter_mut().for_each(|flown| flown.time = f64::NAN);
    }

    /// Forgets what it keeps: the motion is another one.
    pub fn forget(&mut self) {
        self.floors.forget();
        self.watch.restart();
    }

    /// Forgets the time to come: a contact force or an impulse has acted.
    pub fn restart(&mut self) {
        if self.watch.looks_ahead() {
            self.watch.restart();
        }
    }
}

/// Room for one call: buffers that any may use, and what is kept for peaks.
pub struct PeakWork<'a> {
    pub buffers: &'a mut Buffers,
    pub peaks: &'a mut PeakRoom,
}

/// For how long what is clear of its peak.
#[derive(Clone, Debug, Default)]
pub struct PeakWatch {
    /// The first segment for which the bounds do not hold.
    pub until: u64,
    /// The first segment in which anything may exceed its peak, as far as is known.
    pub due: u64,
    /// s, the longest segment until then.
    pub longest: f64,
    pub blocks: Vec<WatchedBlock>,
}

#[derive(Clone, Debug, Default)]
pub struct WatchedBlock {
    pub clear_until: u64,
    /// The values at the start of a segment.
    pub value: Lane,
    pub known_at: Option<u64>,
    /// Bounds on |y'|, and on how far it bends away from the chord of a segment: h^2/8 |y''|.
    pub rate: Lane,
    pub sag: Lane,
}

impl PeakWatch {
    pub fn new(blocks: usize) -> PeakWatch {
        PeakWatch { blocks: vec![WatchedBlock::default(); blocks], ..PeakWatch::default() }
    }

    /// Forgets all: the motion is another one, or a contact force or an impulse has acted.
    pub fn restart(&mut self) {
        (self.until, self.due) = (0, 0);
        for block in &mut self.blocks {
            (block.clear_until, block.known_at) = (0, None);
        }
    }

    /// Whether it knows anything of the time to come.
    pub fn looks_ahead(&self) -> bool {
        self.until > 0
    }

    pub fn is_clear(&self, block: usize, segment: u64) -> bool {
        self.blocks[block].clear_until > segment
    }
}

/// What is known of each mode over a flight.
#[derive(Clone, Debug, Default)]
pub struct ModeBounds {
    /// Accelerations relative to the ground, at the start and at the end.
    pub first: Vec<f64>,
    pub last: Vec<f64>,
    /// How far each mode can swing in q' and in q, about where the load holds it: q at the start and at the end, and q'.
    pub swing: Vec<f64>,
    pub swing_q: Vec<f64>,
    pub held: [Vec<f64>; 2],
    pub held_rate: Vec<f64>,
    /// What |A| and |B| are multiplied by in the bound on a fourth derivative (in the look ahead: on a first and a second).
    pub slow: Vec<f64>,
    pub quick: Vec<f64>,
}

impl ModeBounds {
    pub fn new(lanes: usize) -> ModeBounds {
        let vector = || vec![0.0; lanes];
        ModeBounds {
            first: vector(),
            last: vector(),
            swing: vector(),
            swing_q: vector(),
            held: [vector(), vector()],
            held_rate: vector(),
            slow: vector(),
            quick: vector(),
        }
    }
}

/// The floors of both buildings at one time.
#[derive(Clone, Debug, Default)]
pub struct FloorState {
    /// m and m/s.
    pub u: Vec<f64>,
    pub v: Vec<f64>,
    /// m/s2, by stiffness and damping of the buildings and by floor forces.
    pub resisted: Vec<f64>,
}

/// Room for a step.
#[derive(Clone, Debug, Default)]
pub struct FloorRoom {
    pub start: FloorState,
    pub end: FloorState,
    /// m/s2, the least and the most that contact forces may push each floor by.
    pub least: Vec<f64>,
    pub most: Vec<f64>,
    /// B, and how far r strays from its chord, m/s2; at last A.
    pub largest: Vec<f64>,
    pub strays: Vec<f64>,
    /// By how much a peak may be exceeded.
    pub excess: Vec<f64>,
    pub modal: Vec<f64>,
    /// The time that `end` is of, as the start of a segment and the time since then.
    pub known: Option<[u64; 2]>,
}

impl FloorRoom {
    pub fn new(lanes: usize) -> FloorRoom {
        let vector = || vec![0.0; lanes];
        let state = || FloorState { u: vector(), v: vector(), resisted: vector() };
        FloorRoom {
            start: state(),
            end: state(),
            least: vector(),
            most: vector(),
            largest: vector(),
            strays: vector(),
            excess: vector(),
            modal: vector(),
            known: None,
        }
    }

    pub fn forget(&mut self) {
        self.known = None;
    }

    /// Goes on from the end of the step before, if it is at that time; whether it is.
    pub fn go_on(&mut self, time: [f64; 2]) -> bool {
        let goes_on = self.known == Some(time.map(f64::to_bits));
        if goes_on {
            std::mem::swap(&mut self.start, &mut self.end);
        }
        goes_on
    }

    /// The end is that of a time.
    pub fn keep(&mut self, time: [f64; 2]) {
        self.known = Some(time.map(f64::to_bits));
    }
}

/// Vectors to read into.
#[derive(Clone, Debug, Default)]
pub struct ReadingRoom {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub acceleration: Vec<f64>,
    pub jerk: Vec<f64>,
}

impl ReadingRoom {
    pub fn new(lanes: usize) -> ReadingRoom {
        let vector = || vec![0.0; lanes];
        ReadingRoom { q: vector(), v: vector(), acceleration: vector(), jerk: vector() }
    }
}
