//! What has been worked out of an observed solution: each quantity when it is first asked for.

use crate::engine::base::peaks::Peaks;
use crate::engine::peaks::room::PeakRoom;
use crate::engine::system::buffers::Buffers;
use crate::structure::{LANES, Lane};
use std::cell::{Cell, OnceCell, RefCell};

/// Some quantities of a block of floors, and the observation that they are of.
#[derive(Clone, Debug)]
pub struct KnownBlock<const N: usize> {
    pub observation: Cell<u64>,
    pub numbers: [[Cell<f64>; LANES]; N],
}

/// What is known of the floors at one time.
#[derive(Clone, Debug, Default)]
pub struct FloorMotions {
    /// Number of this observation, from 1 on.
    pub observation: u64,
    /// Displacement, m, and velocity, m/s, relative to the ground.
    pub motion: Vec<KnownBlock<2>>,
    /// m/s2, absolute.
    pub acceleration: Vec<KnownBlock<1>>,
    pub rows_read: Cell<u64>,
    /// Of the floor and contact forces, per unit of mass and in the coordinates of the point; of use where `is_loaded`.
    pub load: Vec<f64>,
    pub is_loaded: bool,
    pub accelerations: OnceCell<Accelerations>,
    /// Memory for them.
    pub room: RefCell<Accelerations>,
}

/// Accelerations in the coordinates of a point, m/s2.
#[derive(Clone, Debug, Default)]
pub struct Accelerations {
    /// Relative to a ground at rest.
    pub absolute: Vec<f64>,
    /// The part that comes from the buildings' own stiffness and damping.
    pub resisted: Vec<f64>,
}

impl<const N: usize> KnownBlock<N> {
    /// Nothing is known of so many lanes.
    fn unknown(lanes: usize) -> Vec<KnownBlock<N>> {
        let numbers = || std::array::from_fn(|_| std::array::from_fn(|_| Cell::new(0.0)));
        (0..lanes / LANES).map(|_| KnownBlock { observation: Cell::new(0), numbers: numbers() }).collect()
    }

    #[inline]
    pub fn set(&self, observation: u64, blocks: &[Lane; N]) {
        self.observation.set(observation);
        for (numbers, block) in self.numbers.iter().zip(blocks) {
            for i in 0..LANES {
                numbers[i].set(block[i]);
            }
        }
    }
}

impl FloorMotions {
    /// Makes room for vectors of all floors of that length.
    pub fn make_room(&mut self, lanes: usize) {
        self.motion = KnownBlock::unknown(lanes);
        self.acceleration = KnownBlock::unknown(lanes);
        self.load = vec![0.0; lanes];
        self.accelerations.take();
        *self.room.get_mut() = Accelerations { absolute: vec![0.0; lanes], resisted: vec![0.0; lanes] };
    }

    /// Nothing is known of any floor.
    pub fn forget(&mut self) {
        self.observation += 1;
        self.is_loaded = false;
        if let Some(accelerations) = self.accelerations.take() {
            *self.room.get_mut() = accelerations;
        }
    }

    /// The load to add forces to.
    pub fn start_load(&mut self) -> &mut [f64] {
        self.is_loaded = true;
        self.load.fill(0.0);
        &mut self.load
    }
}

/// The peaks at an observed time, worked out when one is first asked for.
#[derive(Clone, Debug, Default)]
pub struct PointPeaks {
    pub observation: u64,
    pub peaks: Peaks,
    pub work: Option<Box<(Buffers, PeakRoom)>>,
}

/// For [`Point`], which is read through a shared reference.
pub type PeakCell = RefCell<PointPeaks>;
