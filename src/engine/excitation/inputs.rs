//! What a master sets, held or linear in time until it sets it again: the ground acceleration where there is no record, and
//! what it pushes on the buildings with: forces on the floors, and corrections of what the buildings resist with.

use crate::engine::excitation::first_floors::FirstFloors;
use crate::scene::Scene;
use crate::structure::BuildingId;
use serde::{Deserialize, Serialize};

/// An input: a master sets it at any time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Input {
    /// Ground acceleration, m/s2; acts where the scene has no record.
    GroundAcceleration,
    /// Force on a floor, counted from 0, N, positive to the right; acts where the scene has floor forces.
    Force(BuildingId, usize),
    /// By how much a storey of a shear building, or a floor of one with a stiffness matrix, counted from 0, resists
    /// with less than its stiffness says, N; acts where the scene has restoring corrections.
    Correction(BuildingId, usize),
}

/// What a master pushes on the buildings with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::engine) enum Push {
    /// Forces on floors.
    Force,
    /// Corrections of what buildings resist with.
    Correction,
}

impl Push {
    pub(in crate::engine) const BOTH: [Push; 2] = [Push::Force, Push::Correction];
}

/// The inputs of a master, each constant or linear in time until it is set again.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Inputs {
    /// Ground acceleration, m/s2; used where there is no record.
    pub(in crate::engine) ground_acceleration: LinearInput,
    /// Forces on the floors, N, positive to the right: building by building from left to right; empty without floor forces.
    pub(in crate::engine) floor_forces: Vec<LinearInput>,
    /// Corrections of storeys, or floors, N, in the same order; empty without corrections.
    pub(in crate::engine) corrections: Vec<LinearInput>,
    /// Where those of each building begin among these.
    pub(in crate::engine) first: FirstFloors,
}

impl Inputs {
    /// Those of a scene: all 0, until they are set.
    pub fn new(scene: &Scene) -> Inputs {
        let floors = scene.buildings.iter().map(|building| building.mass.len());
        Inputs::of(&floors.collect::<Vec<_>>(), scene.floor_forces, scene.restoring_corrections)
    }

    /// Those of buildings with so many floors, with forces on them and corrections or without.
    pub(in crate::engine) fn of(floors: &[usize], has_forces: bool, has_corrections: bool) -> Inputs {
        let lines = |exist: bool| vec![LinearInput::default(); if exist { floors.iter().sum() } else { 0 }];
        let (floor_forces, corrections) = (lines(has_forces), lines(has_corrections));
        let first = FirstFloors::of(floors);
        Inputs { ground_acceleration: LinearInput::default(), floor_forces, corrections, first }
    }

    /// An input as a function of time; 0 where there is no such input.
    pub fn get(&self, input: Input) -> LinearInput {
        let of = |lines: &[LinearInput], id, floor| self.first.place(id, floor).and_then(|i| lines.get(i).copied());
        match input {
            Input::GroundAcceleration => Some(self.ground_acceleration),
            Input::Force(id, floor) => of(&self.floor_forces, id, floor),
            Input::Correction(id, storey) => of(&self.corrections, id, storey),
        }
        .unwrap_or_default()
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
        let line = match input {
            Input::GroundAcceleration => Some(&mut self.ground_acceleration),
            Input::Force(id, floor) => self.first.place(id, floor).and_then(|i| self.floor_forces.get_mut(i)),
            Input::Correction(id, storey) => self.first.place(id, storey).and_then(|i| self.corrections.get_mut(i)),
        };
        if let Some(line) = line {
            change(line);
        }
    }

    /// All of one kind; none where the scene does not have them.
    pub(in crate::engine) fn of_kind(&self, push: Push) -> &[LinearInput] {
        match push {
            Push::Force => &self.floor_forces,
            Push::Correction => &self.corrections,
        }
    }

    /// All that a master pushes with, in one order: forces on floors, then corrections.
    pub(in crate::engine) fn pushes(&self) -> impl Iterator<Item = &LinearInput> {
        Push::BOTH.into_iter().flat_map(|push| self.of_kind(push))
    }

    /// One of these.
    pub(in crate::engine) fn push(&self, number: usize) -> &LinearInput {
        let correction = || &self.corrections[number - self.floor_forces.len()];
        self.floor_forces.get(number).unwrap_or_else(correction)
    }

    /// The values set so far hold for this time, s.
    pub fn move_to(&mut self, time: f64) {
        let Inputs { ground_acceleration, floor_forces, corrections, first: _ } = self;
        let all = floor_forces.iter_mut().chain(corrections).chain([ground_acceleration]);
        all.for_each(|input| input.since = time);
    }

    /// Whether any changes with time.
    #[inline]
    pub fn are_moving(&self) -> bool {
        let is_moving = |input: &LinearInput| input.slope != 0.0;
        // Asked at each communication step: kind by kind, which costs less than one walk over all.
        is_moving(&self.ground_acceleration)
            || self.floor_forces.iter().any(is_moving)
            || self.corrections.iter().any(is_moving)
    }

    /// Whether they can be those of a scene: as many as it has, and finite numbers.
    pub fn fit(&self, scene: &Scene) -> bool {
        self.are_as_many_as(&Inputs::new(scene)) && self.numbers().all(f64::is_finite)
    }

    /// Whether there are as many as of a scene whose inputs `others` are.
    pub(in crate::engine) fn are_as_many_as(&self, others: &Inputs) -> bool {
        let sizes = |of: &Inputs| [of.floor_forces.len(), of.corrections.len()];
        self.first == others.first && sizes(self) == sizes(others)
    }

    /// All of their numbers.
    pub(in crate::engine) fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let Inputs { ground_acceleration, floor_forces, corrections, first: _ } = self;
        floor_forces.iter().chain(corrections).chain([ground_acceleration]).flat_map(|line| {
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
        for has in [true, false] {
            let mut inputs = Inputs::of(&[1, 2], has, has);
            for (id, floor) in [(BuildingId::LEFT, 1), (BuildingId::RIGHT, 2)] {
                for input in [Input::Force(id, floor), Input::Correction(id, floor)] {
                    inputs.set(input, 3.0, 0.0);
                    inputs.set_rate(input, 3.0, 0.0);
                    assert_eq!(inputs.get(input), LinearInput::default());
                }
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
