//! What a master sets, held or linear in time until it sets it again: the ground acceleration where there is no record, and
//! forces on the floors.

use crate::structure::Side;
use serde::{Deserialize, Serialize};

/// An input: a master sets it at any time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// Ground acceleration, m/s2; acts where the scene has no record.
    GroundAcceleration,
    /// Force on a floor, counted from 0, N, positive to the right; acts where the scene has floor forces.
    Force(Side, usize),
}

/// The inputs of a master, each constant or linear in time until it is set again.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Inputs {
    /// Ground acceleration, m/s2; used where there is no record.
    pub ground_acceleration: LinearInput,
    /// Forces on the floors, N, positive to the right: left floors, then right floors; empty without floor forces.
    pub floor_forces: Vec<LinearInput>,
    /// Number of floors of the left building.
    pub left_floors: usize,
}

impl Inputs {
    /// Index of a floor's force.
    pub fn place(&self, side: Side, floor: usize) -> usize {
        if side == Side::Left { floor } else { self.left_floors + floor }
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

    /// Whether all of its numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.numbers().into_iter().all(f64::is_finite)
    }

    /// Value, rate of change per second, and the time at which it was set, s.
    pub(in crate::engine) fn numbers(&self) -> [f64; 3] {
        let &LinearInput { value, slope, since } = self;
        [value, slope, since]
    }

    /// Moves the start of the line to another time, s, with the same value and slope.
    pub fn move_to(&mut self, time: f64) {
        self.since = time;
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
    fn far_from_0_no_digits_are_lost() {
        let mut input = LinearInput::default();
        input.set_slope(1.0, 1e6);
        assert_eq!(input.after(1e6, 1e-12), 1e-12);
    }
}
