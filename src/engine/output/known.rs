//! Storage of the quantities of a point that are worked out when first read.

use crate::engine::base::peaks::Peaks;
use crate::engine::peaks::room::PeakRoom;
use crate::engine::system::buffers::Buffers;
use crate::structure::{LANES, Lane};
use std::cell::{Cell, OnceCell, RefCell};

/// Some quantities of a block of floors, and the number of the observation to which they belong.
#[derive(Clone, Debug)]
pub(crate) struct KnownBlock<const N: usize> {
    pub observation: Cell<u64>,
    pub numbers: [[Cell<f64>; LANES]; N],
}

/// The floors' motions at one time.
#[derive(Clone, Debug, Default)]
pub(crate) struct FloorMotions {
    /// Number of this observation, from 1 on.
    pub observation: u64,
    /// Displacements, m, and velocities, m/s, relative to the ground.
    pub motion: Vec<KnownBlock<2>>,
    /// Absolute accelerations, m/s2.
    pub acceleration: Vec<KnownBlock<1>>,
    /// Number of rows of the modal matrix that have been multiplied.
    pub rows_read: Cell<u64>,
    /// Load by a master's pushes and contact forces per unit of mass, in the coordinates of the point; meaningful where
    /// `is_loaded`.
    pub load: Vec<f64>,
    /// The accelerations, once they have been worked out.
    pub is_loaded: bool,
    pub accelerations: OnceCell<Accelerations>,
    /// Memory for the accelerations.
    pub room: RefCell<Accelerations>,
}

/// Accelerations in the coordinates of a point, m/s2.
#[derive(Clone, Debug, Default)]
pub(crate) struct Accelerations {
    /// Absolute accelerations: without the ground's inertia load.
    pub absolute: Vec<f64>,
    /// The part by the buildings' own stiffness and damping.
    pub resisted: Vec<f64>,
}

impl<const N: usize> KnownBlock<N> {
    /// Blocks for that many lanes, of which nothing is known.
    fn unknown(lanes: usize) -> Vec<KnownBlock<N>> {
        let numbers = || std::array::from_fn(|_| std::array::from_fn(|_| Cell::new(0.0)));
        (0..lanes / LANES).map(|_| KnownBlock { observation: Cell::new(0), numbers: numbers() }).collect()
    }

    /// Stores the quantities of a block for an observation.
    #[inline]
    pub(crate) fn set(&self, observation: u64, blocks: &[Lane; N]) {
        self.observation.set(observation);
        for (numbers, block) in self.numbers.iter().zip(blocks) {
            for i in 0..LANES {
                numbers[i].set(block[i]);
            }
        }
    }
}

impl FloorMotions {
    /// Allocates for vectors of all floors of that length.
    pub(crate) fn make_room(&mut self, lanes: usize) {
        self.motion = KnownBlock::unknown(lanes);
        self.acceleration = KnownBlock::unknown(lanes);
        self.load = vec![0.0; lanes];
        self.accelerations.take();
        *self.room.get_mut() = Accelerations { absolute: vec![0.0; lanes], resisted: vec![0.0; lanes] };
    }

    /// Begins a new observation, of which nothing is known.
    pub(crate) fn forget(&mut self) {
        self.observation += 1;
        self.is_loaded = false;
        if let Some(accelerations) = self.accelerations.take() {
            *self.room.get_mut() = accelerations;
        }
    }

    /// The load, to which forces are to be added.
    pub(crate) fn start_load(&mut self) -> &mut [f64] {
        self.is_loaded = true;
        self.load.fill(0.0);
        &mut self.load
    }
}

/// The peaks at an observed time, worked out when one is first read.
#[derive(Clone, Debug, Default)]
pub(crate) struct PointPeaks {
    pub observation: u64,
    pub peaks: Peaks,
    /// The peaks at the base of the step: those of the base, raised over so many entries of the log with that identity.
    pub folded: Peaks,
    pub identity: u64,
    pub entries: usize,
    /// The displacements relative to the position of rest at the start of the step.
    pub q: Vec<f64>,
    pub work: Option<Box<(Buffers, PeakRoom)>>,
}

/// Shared mutable, since a [`Point`] is read through a shared reference.
pub(crate) type PeakCell = RefCell<PointPeaks>;
