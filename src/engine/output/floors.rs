//! The motion of the floors at an observed time. Displacements, velocities and accelerations are worked out when first
//! read.

use crate::engine::base::Coordinates;
use crate::engine::model::Model;
use crate::engine::output::instant::Instant;
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

impl<'a> Instant<'a> {
    /// Displacement of a lane relative to the ground, m.
    #[inline]
    pub(super) fn displacement(&self, lane: usize) -> f64 {
        self.motion_of(lane, 0)
    }

    /// Velocity of a lane relative to the ground, m/s.
    #[inline]
    pub(super) fn velocity(&self, lane: usize) -> f64 {
        self.motion_of(lane, 1)
    }

    /// Absolute acceleration of a lane, m/s2.
    #[inline]
    pub(super) fn acceleration(&self, lane: usize) -> f64 {
        let FloorMotions { acceleration, observation, .. } = &self.point.floors;
        let known = &acceleration[lane / LANES];
        if known.observation.get() != *observation {
            self.note_accelerations(lane / LANES, known);
        }
        known.numbers[0][lane % LANES].get()
    }

    /// Base shear, N: the force of the building on the ground.
    #[inline(never)]
    pub(super) fn base_shear(&self, side: Side) -> f64 {
        let Instant { model: Model { system, .. }, state, point } = self;
        let resisted = match point.coordinates {
            Coordinates::Modes => {
                let at_rest = match point.elements.is_empty() {
                    true => 0.0,
                    false => system.shear_at_rest(&point.elements, side, &point.rest),
                };
                system.structure.base_shear(side, &point.q, &point.v) + at_rest
            }
            Coordinates::Floors => system.structure.floors.base_shear(side as usize, &self.accelerations().resisted),
        };
        resisted - system.correction_of_base(&state.inputs, side, |line| line.at(state.time))
    }

    /// Displacement (`quantity` 0) or velocity (1) of a lane; both are worked out together, in one pass over its row.
    #[inline]
    fn motion_of(&self, lane: usize, quantity: usize) -> f64 {
        let FloorMotions { motion, observation, .. } = &self.point.floors;
        let known = &motion[lane / LANES];
        if known.observation.get() != *observation {
            self.note_motion(lane / LANES, known);
        }
        known.numbers[quantity][lane % LANES].get()
    }

    /// Works out displacements and velocities of a block of floors and stores them in `known`.
    #[inline(never)]
    fn note_motion(&self, block: usize, known: &KnownBlock<2>) {
        let point = self.point;
        let [mut moved, velocity] = self.floor_block(block, [&point.q, &point.v]);
        if !point.elements.is_empty() {
            let rest = &point.rest.as_chunks::<LANES>().0[block];
            moved = each(|i| moved[i] + rest[i]);
        }
        known.set(point.floors.observation, &[moved, velocity]);
    }

    /// Works out the accelerations of a block of floors and stores them in `known`.
    #[inline(never)]
    fn note_accelerations(&self, block: usize, known: &KnownBlock<1>) {
        known.set(self.point.floors.observation, &self.floor_block(block, [&self.accelerations().absolute]));
    }

    /// The accelerations at the observed time.
    pub(super) fn accelerations(&self) -> &'a Accelerations {
        let Instant { model: Model { system, .. }, point, .. } = *self;
        let floors = &point.floors;
        floors.accelerations.get_or_init(|| {
            let mut accelerations = floors.room.take();
            let Accelerations { absolute, resisted } = &mut accelerations;
            resisted.fill(0.0);
            system.resist(point.coordinates, &point.q, &point.v, 1.0, resisted);
            // Without the ground's inertia load these are absolute accelerations.
            absolute.copy_from_slice(resisted);
            if floors.is_loaded {
                absolute.iter_mut().zip(&floors.load).for_each(|(absolute, load)| *absolute += load);
            }
            accelerations
        })
    }

    /// One lane's components of some vectors of motion at the observed time.
    pub(super) fn at_lane<const N: usize>(&self, lane: usize, motion: [&[f64]; N]) -> [f64; N] {
        self.floor_block(lane / LANES, motion).map(|block| block[lane % LANES])
    }

    /// A block of floors of some vectors of motion.
    #[inline(always)]
    fn floor_block<const N: usize>(&self, block: usize, motion: [&[f64]; N]) -> [Lane; N] {
        let Instant { model, point, .. } = self;
        match point.coordinates {
            Coordinates::Modes => {
                point.floors.rows_read.set(point.floors.rows_read.get() + LANES as u64);
                model.system.structure.at_floors(block, motion)
            }
            Coordinates::Floors => motion.map(|motion| motion.as_chunks::<LANES>().0[block]),
        }
    }
}
