//! The floors of an observed solution. A floor is worked out when it is first asked for.

use super::model::Model;
use super::state::Coordinates;
use super::{Point, Side};
use std::cell::{Cell, OnceCell};

/// One floor at one time.
#[derive(Clone, Debug)]
struct FloorMotion {
    /// m, relative to the ground.
    displacement: f64,
    /// m/s, relative to the ground.
    velocity: f64,
    /// m/s2, absolute.
    acceleration: f64,
}

/// What is known of the floors at one time.
#[derive(Clone, Debug, Default)]
pub(super) struct FloorMotions {
    /// One per lane of a vector of all floors.
    known: Vec<OnceCell<FloorMotion>>,
    rows_read: Cell<u64>,
}

impl FloorMotions {
    /// Nothing is known of any floor.
    pub fn forget(&mut self, lanes: usize) {
        self.known.clear();
        self.known.resize(lanes, OnceCell::new());
    }
}

impl Point {
    /// Rows of the modal matrix that have been summed up for floors, since this point was made: one for each floor and
    /// observation, if any of its motion is asked for; none where the solution is that of the floors.
    pub fn rows_read(&self) -> u64 {
        self.floors.rows_read.get()
    }
}

impl Model {
    /// m, relative to the ground; floors counted from 0.
    #[inline]
    pub fn displacement(&self, point: &Point, side: Side, floor: usize) -> f64 {
        self.floor_motion(point, side, floor).displacement
    }

    /// m/s, relative to the ground.
    #[inline]
    pub fn velocity(&self, point: &Point, side: Side, floor: usize) -> f64 {
        self.floor_motion(point, side, floor).velocity
    }

    /// m/s2, absolute.
    #[inline]
    pub fn acceleration(&self, point: &Point, side: Side, floor: usize) -> f64 {
        self.floor_motion(point, side, floor).acceleration
    }

    /// N, force of the building on the ground.
    #[inline(never)]
    pub fn base_shear(&self, point: &Point, side: Side) -> f64 {
        match point.coordinates {
            Coordinates::Modes => self.structure.base_shear(side, &point.q, &point.v),
            Coordinates::Floors => self.structure.floors.base_shear(side as usize, &point.resisted),
        }
    }

    #[inline]
    fn floor_motion<'p>(&self, point: &'p Point, side: Side, floor: usize) -> &'p FloorMotion {
        let known = &point.floors.known[self.structure.floors.lane(side as usize, floor)];
        match known.get() {
            Some(motion) => motion,
            None => known.get_or_init(|| self.work_out_floor(point, side, floor)),
        }
    }

    /// All of a floor's motion at once: it takes one pass over its row.
    #[inline(never)]
    fn work_out_floor(&self, point: &Point, side: Side, floor: usize) -> FloorMotion {
        let motion = [&point.q[..], &point.v, &point.acceleration];
        let [displacement, velocity, acceleration] = match point.coordinates {
            Coordinates::Modes => {
                point.floors.rows_read.set(point.floors.rows_read.get() + 1);
                self.structure.at_floor(side, floor, motion)
            }
            Coordinates::Floors => {
                let lane = self.structure.floors.lane(side as usize, floor);
                motion.map(|motion| motion[lane])
            }
        };
        FloorMotion { displacement, velocity, acceleration }
    }
}
