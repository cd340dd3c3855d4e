//! The motion of the floors at an observed time. Each number is worked out when it is read: a row of the modal matrix
//! times the motion.

use crate::engine::base::Coordinates;
use crate::engine::model::Model;
use crate::engine::output::instant::Instant;
use crate::engine::output::known::Accelerations;
use crate::engine::output::point::Point;
use crate::engine::quantities::flight_row::FlightRow;
use crate::structure::{BuildingId, Motion, MotionMut};

impl Point {
    /// Number of rows of the modal matrix that have been multiplied since this point was made; 0 where the motion is
    /// that of the floors.
    pub fn rows_read(&self) -> u64 {
        self.floors.rows_read.get()
    }
}

impl<'a> Instant<'a> {
    /// The motion relative to the position of rest, in the coordinates of the point; that of the modes where it oscillates.
    #[inline(always)]
    pub(super) fn motion(&self) -> Motion<'a> {
        if self.point.oscillates { self.motion_of_modes() } else { self.moved() }
    }

    /// The same as the step has it.
    #[inline(always)]
    fn moved(&self) -> Motion<'a> {
        let Instant { state, point, .. } = *self;
        if point.is_at_base { state.base.motion() } else { Motion { q: &point.q, v: &point.v } }
    }

    #[inline(never)]
    fn motion_of_modes(&self) -> Motion<'a> {
        let floors = &self.point.floors;
        let [q, v] = floors.of_modes.get_or_init(|| {
            let [mut q, mut v] = floors.room_of_modes.take();
            let oscillators = self.model.system.structure.oscillators();
            oscillators.into_iter().for_each(|of| of.to_modes(self.moved(), MotionMut { q: &mut q, v: &mut v }));
            [q, v]
        });
        Motion { q, v }
    }

    /// What `of` reads of a lane where oscillators move.
    #[inline(never)]
    fn of_oscillators(&self, lane: usize, of: fn(FlightRow<'a>, Motion<'a>) -> f64) -> f64 {
        let Instant { model, point, .. } = *self;
        point.floors.rows_read.set(point.floors.rows_read.get() + 1);
        of(FlightRow::OfOscillators(&model.system.floors_in_flight[lane]), self.moved())
    }

    /// Displacement of a lane relative to the ground, m.
    #[inline]
    pub(super) fn displacement(&self, lane: usize) -> f64 {
        let moved = match self.point.oscillates {
            true => self.of_oscillators(lane, FlightRow::value),
            false => self.at_lane(lane, self.moved().q),
        };
        if self.point.elements.is_empty() { moved } else { moved + self.point.rest[lane] }
    }

    /// Velocity of a lane relative to the ground, m/s.
    #[inline]
    pub(super) fn velocity(&self, lane: usize) -> f64 {
        match self.point.oscillates {
            true => self.of_oscillators(lane, FlightRow::rate),
            false => self.at_lane(lane, self.moved().v),
        }
    }

    /// Absolute acceleration of a lane, m/s2.
    #[inline(never)]
    pub(super) fn acceleration(&self, lane: usize) -> f64 {
        self.at_lane(lane, &self.accelerations().absolute)
    }

    /// Base shear, N: the force of the building on the ground.
    #[inline(never)]
    pub(super) fn base_shear(&self, id: BuildingId) -> f64 {
        let (Instant { model: Model { system, .. }, state, point }, motion) = (self, self.motion());
        let resisted = match point.coordinates {
            Coordinates::Modes => {
                let at_rest = match point.elements.is_empty() {
                    true => 0.0,
                    false => system.shear_at_rest(&point.elements, id, &point.rest),
                };
                system.structure.base_shear(id, motion.q, motion.v) + at_rest
            }
            Coordinates::Floors => system.structure.floors.base_shear(id, &self.accelerations().resisted),
        };
        resisted - system.correction_of_base(&state.inputs, id, |line| line.at(state.time))
    }

    /// The accelerations at the observed time.
    pub(super) fn accelerations(&self) -> &'a Accelerations {
        let Instant { model: Model { system, .. }, point, .. } = *self;
        let floors = &point.floors;
        floors.accelerations.get_or_init(|| {
            let mut accelerations = floors.room.take();
            let Accelerations { absolute, resisted } = &mut accelerations;
            resisted.fill(0.0);
            let Motion { q, v } = self.motion();
            system.resist(point.coordinates, q, v, 1.0, resisted);
            // Without the ground's inertia load these are absolute accelerations.
            absolute.copy_from_slice(resisted);
            if floors.is_loaded {
                absolute.iter_mut().zip(&floors.load).for_each(|(absolute, load)| *absolute += load);
            }
            accelerations
        })
    }

    /// One lane's component of a vector of motion at the observed time.
    #[inline]
    pub(super) fn at_lane(&self, lane: usize, motion: &[f64]) -> f64 {
        let Instant { model, point, .. } = *self;
        match point.coordinates {
            Coordinates::Modes => {
                point.floors.rows_read.set(point.floors.rows_read.get() + 1);
                model.system.structure.at_floor(lane, motion)
            }
            Coordinates::Floors => motion[lane],
        }
    }
}
