//! What a master sets, held or linear in time until it sets it again: the ground acceleration where there is no record, and
//! forces on the floors.

use crate::scene::Scene;
use crate::structure::Side;
use serde::{Deserialize, Serialize};

/// An input: a master sets it at any time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Input {
    /// Ground acceleration, m/s2; acts where the scene has no record.
    GroundAcceleration,
    /// Force on a floor, counted from 0, N, positive to the right; acts where the scene has floor forces.
    Force(Side, usize),
}

/// The inputs of a master, each constant or linear in time until it is set again.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Inputs {
    /// Ground acceleration, m/s2; used where there is no record.
    pub(in crate::engine) ground_acceleration: LinearInput,
    /// Forces on the floors, N, positive to the right: left floors, then right floors; empty without floor forces.
    pub(in crate::engine) floor_forces: Vec<LinearInput>,
    /// Number of floors of the left building.
    pub(in crate::engine) left_floors: usize,
}

impl Inputs {
    /// Those of a scene: all 0, until they are set.
    pub fn new(scene: &Scene) -> Inputs {
        Inputs::of([&scene.left, &scene.right].map(|building| building.mass.len()), scene.floor_forces)
    }

    /// Those of buildings with so many floors, with forces on them or without.
    pub(in crate::engine) fn of([left, right]: [usize; 2], has_floor_forces: bool) -> Inputs {
        let forces = if has_floor_forces { left + right } else { 0 };
        let (ground_acceleration, floor_forces) = (LinearInput::default(), vec![LinearInput::default(); forces]);
        Inputs { ground_acceleration, floor_forces, left_floors: left }
    }

    /// Index of a floor's force.
    pub(in crate::engine) fn place(&self, side: Side, floor: usize) -> usize {
        if side == Side::Left { floor } else { self.left_floors + floor }
    }

    /// The same, if there is a force on such a floor.
    fn place_of(&self, side: Side, floor: usize) -> Option<usize> {
        let is_of_side = side == Side::Right || floor < self.left_floors;
        Some(self.place(side, floor)).filter(|&place| is_of_side && place < self.floor_forces.len())
    }

    /// An input as a function of time; 0 where there is no such input.
    pub fn get(&self, input: Input) -> LinearInput {
        match input {
            Input::GroundAcceleration => self.ground_acceleration,
            Input::Force(side, floor) => {
                self.place_of(side, floor).map_or_else(LinearInput::default, |i| self.floor_forces[i])
            }
        }
    }

    /// Sets the value of an input at a time, s. It is constant from now on, unless a rate is set for the same time.
    pub fn set(&mut self, input: Input, value: f64, time: f64) {
        self.change(input, |line| line.set_value(value, time));
    }

    /// Sets the rate of an input, per second, from a time on, s, until the input or its rate is set again.
    pub fn set_rate(&mut self, input: Input, rate: f64, time: f64) {
        self.change(input, |line| line.set_slope(rate, time));
    }

    fn change(&mut self, input: Input, change: impl FnOnce(&mut LinearInput)) {
        match input {
            Input::GroundAcceleration => change(&mut self.ground_acceleration),
            Input::Force(side, floor) => {
                if let Some(place) = self.place_of(side, floor) {
                    change(&mut self.floor_forces[place]);
                }
            }
        }
    }

    /// The values set so far hold for this time, s.
    pub fn move_to(&mut self, time: f64) {
        self.floor_forces.iter_mut().chain([&mut self.ground_acceleration]).for_each(|input| input.since = time);
    }

    /// Whether any changes with time.
    pub fn are_moving(&self) -> bool {
        self.floor_forces.iter().chain([&self.ground_acceleration]).any(|input| input.slope != 0.0)
    }

    /// Whether they can be those of a scene: as many as it has, and finite numbers.
    pub fn fit(&self, scene: &Scene) -> bool {
        self.are_as_many_as(&Inputs::new(scene)) && self.numbers().all(f64::is_finite)
    }

    /// Whether there are as many as of a scene whose inputs `others` are.
    pub(in crate::engine) fn are_as_many_as(&self, others: &Inputs) -> bool {
        (self.floor_forces.len(), self.left_floors) == (others.floor_forces.len(), others.left_floors)
    }

    /// All of their numbers.
    pub(in crate::engine) fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let Inputs { ground_acceleration, floor_forces, left_floors: _ } = self;
        floor_forces.iter().chain([ground_acceleration]).flat_map(|line| {
            let &LinearInput { value, slope, since } = line;
            [value, slope, since]
        })
    }
}

/// An input that is linear in time from the instant at which it was set until it is set again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LinearInput {
    /// Value at `since`.
    value: f64,
    /// Rate of change, per second.
    slope: f64,
    /// Time at which it was set, s.
    since: f64,
}

impl LinearInput {
    /// The value at a time, s.
    pub fn at(&self, time: f64) -> f64 {
        self.after(time, 0.0)
    }

    /// The value `elapsed` seconds after a time; far from time 0 the sum of the two would lose digits.
    pub fn after(&self, time: f64, elapsed: f64) -> f64 {
        self.value + self.slope * ((time - self.since) + elapsed)
    }

    /// Whether it has a value at a time, s, but for the rounding of its own line.
    pub fn leads_to(&self, value: f64, time: f64) -> bool {
        let rounding = 4.0 * f64::EPSILON * self.value.abs().max(value.abs());
        (self.at(time) - value).abs() <= rounding
    }

    /// Its rate of change, per second.
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// Sets the value at a time, s. A slope that was set for the same time stays; otherwise the value is constant from
    /// now on.
    pub fn set_value(&mut self, value: f64, time: f64) {
        let slope = if self.since == time { self.slope } else { 0.0 };
        *self = LinearInput { value, slope, since: time };
    }

    /// Sets the slope from a time on; the value there is the one set for that time, or else the present value of the
    /// line.
    pub fn set_slope(&mut self, slope: f64, time: f64) {
        *self = LinearInput { value: self.at(time), slope, since: time };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_goes_on_until_it_is_set_again() {
        let mut input = LinearInput::default();
        input.set_value(3.0, 1.0);
        input.set_slope(2.0, 1.0);
        assert_eq!([1.0, 1.5, 4.0].map(|time| input.at(time)), [3.0, 4.0, 9.0]);
        input.set_slope(-1.0, 4.0);
        assert_eq!([4.0, 6.0].map(|time| input.at(time)), [9.0, 7.0]);
        input.set_value(5.0, 6.0);
        assert_eq!((input.at(8.0), input.slope()), (5.0, 0.0), "held from here on");
    }

    #[test]
    fn value_and_slope_of_one_time_may_come_in_either_order() {
        let (mut one, mut other) = (LinearInput::default(), LinearInput::default());
        one.set_value(1.0, 7.0);
        one.set_slope(4.0, 7.0);
        other.set_slope(4.0, 7.0);
        other.set_value(1.0, 7.0);
        assert_eq!(one, other);
        assert_eq!(one.at(7.5), 3.0);
    }

    #[test]
    fn an_input_that_there_is_not_changes_no_other() {
        for has_floor_forces in [true, false] {
            let mut inputs = Inputs::of([1, 2], has_floor_forces);
            for (side, floor) in [(Side::Left, 1), (Side::Right, 2)] {
                inputs.set(Input::Force(side, floor), 3.0, 0.0);
                inputs.set_rate(Input::Force(side, floor), 3.0, 0.0);
                assert_eq!(inputs.get(Input::Force(side, floor)), LinearInput::default());
            }
            assert!(inputs.numbers().all(|number| number == 0.0), "{inputs:?}");
        }
    }

    #[test]
    fn far_from_0_no_digits_are_lost() {
        let mut input = LinearInput::default();
        input.set_slope(1.0, 1e6);
        assert_eq!(input.after(1e6, 1e-12), 1e-12);
    }
}
