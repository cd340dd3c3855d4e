//! The motion of the floors at an observed time. Displacements, velocities and accelerations are worked out when first
//! read.

use crate::engine::base::Coordinates;
use crate::engine::model::Model;
use crate::engine::output::known::{Accelerations, FloorMotions, KnownBlock};
use crate::engine::output::point::Point;
use crate::numerics::polynomial::each;
use crate::structure::{LANES, Lane, Side};

impl Point {
    /// Number of rows of the modal matrix that have been multiplied since this point was made. Rows are counted by
    /// blocks of four, as the floors of a block are worked out together, once per observation for displacements and
    /// velocities and once for accelerations. 0 where the motion is that of the floors.
    pub fn rows_read(&self) -> u64 {
        self.floors.rows_read.get()
    }
}

impl Model {
    /// Displacement of a floor, counted from 0, relative to the ground, m.
    #[inline]
    pub(in crate::engine) fn displacement(&self, point: &Point, side: Side, floor: usize) -> f64 {
        self.motion_of(point, self.system.structure.floors.lane(side as usize, floor), 0)
    }

    /// Velocity of a floor relative to the ground, m/s.
    #[inline]
    pub(in crate::engine) fn velocity(&self, point: &Point, side: Side, floor: usize) -> f64 {
        self.motion_of(point, self.system.structure.floors.lane(side as usize, floor), 1)
    }

    /// Absolute acceleration of a floor, m/s2.
    #[inline]
    pub(in crate::engine) fn acceleration(&self, point: &Point, side: Side, floor: usize) -> f64 {
        self.acceleration_of(point, self.system.structure.floors.lane(side as usize, floor))
    }

    /// Absolute acceleration of a lane, m/s2.
    #[inline]
    pub(in crate::engine) fn acceleration_of(&self, point: &Point, lane: usize) -> f64 {
        let FloorMotions { acceleration, observation, .. } = &point.floors;
        let known = &acceleration[lane / LANES];
        if known.observation.get() != *observation {
            self.note_floors(point, lane / LANES, [&self.accelerations(point).absolute], known);
        }
        known.numbers[0][lane % LANES].get()
    }

    /// Base shear, N: the force of the building on the ground.
    #[inline(never)]
    pub(in crate::engine) fn base_shear(&self, point: &Point, side: Side) -> f64 {
        match point.coordinates {
            Coordinates::Modes => {
                let at_rest = match point.storeys.is_empty() {
                    true => 0.0,
                    false => self.system.shear_at_rest(&point.storeys, side, &point.rest),
                };
                self.system.structure.base_shear(side, &point.q, &point.v) + at_rest
            }
            Coordinates::Floors => {
                self.system.structure.floors.base_shear(side as usize, &self.accelerations(point).resisted)
            }
        }
    }

    /// Displacement (`quantity` 0) or velocity (1) of a lane; both are worked out together, in one pass over its row.
    #[inline]
    pub(in crate::engine) fn motion_of(&self, point: &Point, lane: usize, quantity: usize) -> f64 {
        let FloorMotions { motion, observation, .. } = &point.floors;
        let known = &motion[lane / LANES];
        if known.observation.get() != *observation {
            self.note_motion(point, lane / LANES, known);
        }
        known.numbers[quantity][lane % LANES].get()
    }

    /// Works out displacements and velocities of a block of floors and stores them in `known`.
    #[inline(never)]
    fn note_motion(&self, point: &Point, block: usize, known: &KnownBlock<2>) {
        let [mut moved, velocity] = self.floor_block(point, block, [&point.q, &point.v]);
        if !point.storeys.is_empty() {
            let rest = &point.rest.as_chunks::<LANES>().0[block];
            moved = each(|i| moved[i] + rest[i]);
        }
        known.set(point.floors.observation, &[moved, velocity]);
    }

    /// Works out a block of floors of some vectors of motion and stores it in `known`.
    #[inline(never)]
    fn note_floors<const N: usize>(&self, point: &Point, block: usize, motion: [&[f64]; N], known: &KnownBlock<N>) {
        known.set(point.floors.observation, &self.floor_block(point, block, motion));
    }

    /// The accelerations at the observed time.
    pub(in crate::engine) fn accelerations<'p>(&self, point: &'p Point) -> &'p Accelerations {
        let floors = &point.floors;
        floors.accelerations.get_or_init(|| {
            let mut accelerations = floors.room.take();
            let Accelerations { absolute, resisted } = &mut accelerations;
            resisted.fill(0.0);
            self.system.resist(point.coordinates, &point.q, &point.v, 1.0, resisted);
            // Without the ground's inertia load these are absolute accelerations.
            absolute.copy_from_slice(resisted);
            if floors.is_loaded {
                absolute.iter_mut().zip(&floors.load).for_each(|(absolute, load)| *absolute += load);
            }
            accelerations
        })
    }

    /// One lane's components of some vectors of motion at the observed time.
    pub(in crate::engine) fn at_lane<const N: usize>(
        &self,
        point: &Point,
        lane: usize,
        motion: [&[f64]; N],
    ) -> [f64; N] {
        self.floor_block(point, lane / LANES, motion).map(|block| block[lane % LANES])
    }

    /// A block of floors of some vectors of motion.
    #[inline(always)]
    fn floor_block<const N: usize>(&self, point: &Point, block: usize, motion: [&[f64]; N]) -> [Lane; N] {
        match point.coordinates {
            Coordinates::Modes => {
                point.floors.rows_read.set(point.floors.rows_read.get() + LANES as u64);
                self.system.structure.at_floors(block, motion)
            }
            Coordinates::Floors => motion.map(|motion| motion.as_chunks::<LANES>().0[block]),
        }
    }
}
