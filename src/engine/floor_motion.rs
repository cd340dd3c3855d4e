//! The floors of an observed solution. A floor is worked out when it is first asked for, and so are accelerations.

use super::model::Model;
use super::state::Coordinates;
use super::{Point, Side};
use crate::structure::{LANES, Lane};
use std::cell::{Cell, OnceCell, RefCell};

/// Some numbers of one floor or contact, and the observation that they are of.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Known<T> {
    pub observation: u64,
    pub numbers: T,
}

/// What is known of the floors at one time.
#[derive(Clone, Debug, Default)]
pub(super) struct FloorMotions {
    /// Number of this observation, from 1 on.
    pub observation: u64,
    /// Displacement, m, and velocity, m/s, relative to the ground; one per lane of a vector of all floors.
    motion: Vec<Cell<Known<[f64; 2]>>>,
    /// m/s2, absolute.
    acceleration: Vec<Cell<Known<f64>>>,
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

impl FloorMotions {
    /// Nothing is known of any floor.
    pub fn forget(&mut self, lanes: usize) {
        self.observation += 1;
        self.is_loaded = false;
        if let Some(accelerations) = self.accelerations.take() {
            *self.room.get_mut() = accelerations;
        }
        if self.motion.len() != lanes {
            self.motion = vec![Cell::default(); lanes];
            self.acceleration = vec![Cell::default(); lanes];
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
        self.floor_motion(point, side, floor)[0]
    }

    /// m/s, relative to the ground.
    #[inline]
    pub fn velocity(&self, point: &Point, side: Side, floor: usize) -> f64 {
        self.floor_motion(point, side, floor)[1]
    }

    /// m/s2, absolute.
    #[inline]
    pub fn acceleration(&self, point: &Point, side: Side, floor: usize) -> f64 {
        let floors = &point.floors;
        let known = &floors.acceleration[self.structure.floors.lane(side as usize, floor)];
        let Known { observation, numbers } = known.get();
        if observation == floors.observation {
            return numbers;
        }
        let accelerations = [&self.accelerations(point).absolute[..]];
        self.note_floors(point, side, floor, accelerations, &floors.acceleration, |[acceleration]| acceleration)
    }

    /// N, force of the building on the ground.
    #[inline(never)]
    pub fn base_shear(&self, point: &Point, side: Side) -> f64 {
        match point.coordinates {
            Coordinates::Modes => self.structure.base_shear(side, &point.q, &point.v),
            Coordinates::Floors => self.structure.floors.base_shear(side as usize, &self.accelerations(point).resisted),
        }
    }

    /// Displacement and velocity at once: it takes one pass over the floor's row.
    #[inline]
    fn floor_motion(&self, point: &Point, side: Side, floor: usize) -> [f64; 2] {
        let floors = &point.floors;
        let known = &floors.motion[self.structure.floors.lane(side as usize, floor)];
        let Known { observation, numbers } = known.get();
        if observation == floors.observation {
            return numbers;
        }
        self.note_floors(point, side, floor, [&point.q, &point.v], &floors.motion, |motion| motion)
    }

    /// Works out some motions of a floor and of those that share its block, and notes what they make up.
    #[inline(never)]
    fn note_floors<const N: usize, T: Copy>(
        &self,
        point: &Point,
        side: Side,
        floor: usize,
        motion: [&[f64]; N],
        known: &[Cell<Known<T>>],
        of: impl Fn([f64; N]) -> T,
    ) -> T {
        let floors = &self.structure.floors;
        let (lane, building) = (floors.lane(side as usize, floor), floors.lanes_of(side as usize));
        let observation = point.floors.observation;
        let first = lane / LANES * LANES;
        let blocks = self.floor_block(point, side, lane / LANES, motion);
        for i in first.max(building.start)..(first + LANES).min(building.end) {
            let numbers = of(blocks.map(|block| block[i - first]));
            known[i].set(Known { observation, numbers });
        }
        of(blocks.map(|block| block[lane - first]))
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
