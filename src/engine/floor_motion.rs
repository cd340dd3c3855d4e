//! The floors of an observed solution. A floor is worked out when it is first asked for, and so are accelerations.

use super::model::Model;
use super::state::Coordinates;
use super::{Point, Side};
use crate::structure::{LANES, Lane};
use std::cell::{Cell, OnceCell, RefCell};

/// Quantities of all floors, each building's in lanes of its own, and the observation that each block of them is of.
#[derive(Clone, Debug)]
struct KnownFloors<const N: usize> {
    observations: Vec<Cell<u64>>,
    numbers: [Vec<Cell<f64>>; N],
}

/// What is known of the floors at one time.
#[derive(Clone, Debug, Default)]
pub(super) struct FloorMotions {
    /// Number of this observation, from 1 on.
    pub observation: u64,
    /// Displacement, m, and velocity, m/s, relative to the ground.
    motion: KnownFloors<2>,
    /// m/s2, absolute.
    acceleration: KnownFloors<1>,
    rows_read: Cell<u64>,
    /// Of the floor and contact forces, per unit of mass and in the coordinates of the point; of use where `is_loaded`.
    load: Vec<f64>,
    is_loaded: bool,
    accelerations: OnceCell<Accelerations>,
    /// Memory for them.
    room: RefCell<Accelerations>,
}

/// Accelerations in the coordinates of a point, m/s2.
#[derive(Clone, Debug, Default)]
pub(super) struct Accelerations {
    /// Relative to a ground at rest.
    pub absolute: Vec<f64>,
    /// The part that comes from the buildings' own stiffness and damping.
    pub resisted: Vec<f64>,
}

impl<const N: usize> Default for KnownFloors<N> {
    fn default() -> KnownFloors<N> {
        KnownFloors::new(0)
    }
}

impl<const N: usize> KnownFloors<N> {
    /// For vectors of all floors of that length.
    fn new(lanes: usize) -> KnownFloors<N> {
        let numbers = std::array::from_fn(|_| vec![Cell::new(0.0); 2 * lanes]);
        KnownFloors { observations: vec![Cell::new(0); 2 * lanes / LANES], numbers }
    }

    /// A quantity at a place, if it is known in this observation.
    #[inline]
    fn get(&self, quantity: usize, place: usize, observation: u64) -> Option<f64> {
        (self.observations[place / LANES].get() == observation).then(|| self.numbers[quantity][place].get())
    }

    /// Notes what the floors about a place have.
    #[inline]
    fn set(&self, place: usize, observation: u64, blocks: &[Lane; N]) {
        self.observations[place / LANES].set(observation);
        for (numbers, block) in self.numbers.iter().zip(blocks) {
            let cells = &numbers.as_chunks::<LANES>().0[place / LANES];
            for i in 0..LANES {
                cells[i].set(block[i]);
            }
        }
    }
}

impl FloorMotions {
    /// Nothing is known of any floor.
    pub fn forget(&mut self, lanes: usize) {
        self.observation += 1;
        self.is_loaded = false;
        if let Some(accelerations) = self.accelerations.take() {
            *self.room.get_mut() = accelerations;
        }
        if self.load.len() != lanes {
            self.motion = KnownFloors::new(lanes);
            self.acceleration = KnownFloors::new(lanes);
            self.load = vec![0.0; lanes];
            *self.room.get_mut() = Accelerations { absolute: vec![0.0; lanes], resisted: vec![0.0; lanes] };
        }
    }

    /// The load to add forces to.
    pub fn start_load(&mut self) -> &mut [f64] {
        self.is_loaded = true;
        self.load.fill(0.0);
        &mut self.load
    }
}

impl Point {
    /// Rows of the modal matrix that have been summed up, since this point was made: of the floor that is asked for and of
    /// those that share its block of four, which come with it at no cost; once for an observation where a displacement or
    /// velocity is asked for, once for accelerations. None where the solution is that of the floors.
    pub fn rows_read(&self) -> u64 {
        self.floors.rows_read.get()
    }
}

impl Model {
    /// m, relative to the ground; floors counted from 0.
    #[inline]
    pub fn displacement(&self, point: &Point, side: Side, floor: usize) -> f64 {
        self.floor_motion(point, side, floor, 0)
    }

    /// m/s, relative to the ground.
    #[inline]
    pub fn velocity(&self, point: &Point, side: Side, floor: usize) -> f64 {
        self.floor_motion(point, side, floor, 1)
    }

    /// m/s2, absolute.
    #[inline]
    pub fn acceleration(&self, point: &Point, side: Side, floor: usize) -> f64 {
        let FloorMotions { acceleration, observation, .. } = &point.floors;
        acceleration.get(0, self.place(side, floor), *observation).unwrap_or_else(|| {
            let accelerations = [&self.accelerations(point).absolute[..]];
            self.note_floors(point, side, floor, accelerations, acceleration)[0]
        })
    }

    /// Where the quantities of a floor are noted.
    #[inline]
    fn place(&self, side: Side, floor: usize) -> usize {
        let lane = self.structure.floors.lane(side as usize, floor);
        match side {
            Side::Left => lane,
            Side::Right => self.structure.lanes + lane,
        }
    }

    /// N, force of the building on the ground.
    #[inline(never)]
    pub fn base_shear(&self, point: &Point, side: Side) -> f64 {
        match point.coordinates {
            Coordinates::Modes => self.structure.base_shear(side, &point.q, &point.v),
            Coordinates::Floors => self.structure.floors.base_shear(side as usize, &self.accelerations(point).resisted),
        }
    }

    /// Displacement or velocity; both are worked out at once: it takes one pass over the floor's row.
    #[inline]
    fn floor_motion(&self, point: &Point, side: Side, floor: usize, quantity: usize) -> f64 {
        let FloorMotions { motion, observation, .. } = &point.floors;
        motion
            .get(quantity, self.place(side, floor), *observation)
            .unwrap_or_else(|| self.note_floors(point, side, floor, [&point.q, &point.v], motion)[quantity])
    }

    /// Works out some motions of a floor and of those that share its block, and notes them.
    #[inline(never)]
    fn note_floors<const N: usize>(
        &self,
        point: &Point,
        side: Side,
        floor: usize,
        motion: [&[f64]; N],
        known: &KnownFloors<N>,
    ) -> [f64; N] {
        let lane = self.structure.floors.lane(side as usize, floor);
        let blocks = self.floor_block(point, side, lane / LANES, motion);
        known.set(self.place(side, floor), point.floors.observation, &blocks);
        blocks.map(|block| block[lane % LANES])
    }

    /// The accelerations of an observed solution.
    pub(super) fn accelerations<'p>(&self, point: &'p Point) -> &'p Accelerations {
        let floors = &point.floors;
        floors.accelerations.get_or_init(|| {
            let mut accelerations = floors.room.take();
            let Accelerations { absolute, resisted } = &mut accelerations;
            resisted.fill(0.0);
            self.resist(point.coordinates, &point.q, &point.v, 1.0, resisted);
            // Without the ground's load these are absolute accelerations.
            absolute.copy_from_slice(resisted);
            if floors.is_loaded {
                absolute.iter_mut().zip(&floors.load).for_each(|(absolute, load)| *absolute += load);
            }
            accelerations
        })
    }

    /// One floor of some vectors of motion at the observed time.
    pub(super) fn at_floor<const N: usize>(
        &self,
        point: &Point,
        side: Side,
        floor: usize,
        motion: [&[f64]; N],
    ) -> [f64; N] {
        let lane = self.structure.floors.lane(side as usize, floor);
        self.floor_block(point, side, lane / LANES, motion).map(|block| block[lane % LANES])
    }

    /// A block of floors of one building.
    #[inline]
    fn floor_block<const N: usize>(&self, point: &Point, side: Side, block: usize, motion: [&[f64]; N]) -> [Lane; N] {
        match point.coordinates {
            Coordinates::Modes => {
                let floors = self.structure.floors.lanes_of(side as usize);
                let rows = (block * LANES).max(floors.start)..((block + 1) * LANES).min(floors.end);
                point.floors.rows_read.set(point.floors.rows_read.get() + rows.len() as u64);
                self.structure.at_floors(side, block, motion)
            }
            Coordinates::Floors => motion.map(|motion| motion.as_chunks::<LANES>().0[block]),
        }
    }
}
