//! Storage of the quantities of a point that are worked out when first read.

use crate::engine::base::peaks::Peaks;
use crate::engine::peaks::clearance::PeakClearance;
use crate::engine::peaks::room::PeakRoom;
use crate::engine::system::buffers::Buffers;
use std::cell::{Cell, OnceCell, RefCell};

/// The floors' motions at one time.
#[derive(Clone, Debug, Default)]
pub(crate) struct FloorMotions {
    /// Number of this observation, from 1 on.
    pub observation: u64,
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
    /// Displacements and velocities of the modes where oscillators move, once they have been worked out.
    pub of_modes: OnceCell<[Vec<f64>; 2]>,
    /// Memory for them.
    pub room_of_modes: RefCell<[Vec<f64>; 2]>,
}

/// Accelerations in the coordinates of a point, m/s2.
#[derive(Clone, Debug, Default)]
pub(crate) struct Accelerations {
    /// Absolute accelerations: without the ground's inertia load.
    pub absolute: Vec<f64>,
    /// The part by the buildings' own stiffness and damping.
    pub resisted: Vec<f64>,
}

impl FloorMotions {
    /// Allocates for vectors of all floors of that length.
    pub(crate) fn make_room(&mut self, lanes: usize) {
        self.load = vec![0.0; lanes];
        self.accelerations.take();
        *self.room.get_mut() = Accelerations { absolute: vec![0.0; lanes], resisted: vec![0.0; lanes] };
        self.of_modes.take();
        *self.room_of_modes.get_mut() = [vec![0.0; lanes], vec![0.0; lanes]];
    }

    /// Begins a new observation, of which nothing is known.
    #[inline]
    pub(crate) fn forget(&mut self) {
        self.observation += 1;
        self.is_loaded = false;
        if let Some(accelerations) = self.accelerations.take() {
            *self.room.get_mut() = accelerations;
        }
        if let Some(of_modes) = self.of_modes.take() {
            *self.room_of_modes.get_mut() = of_modes;
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
    /// For which segments they are known beforehand.
    pub clearance: PeakClearance,
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
