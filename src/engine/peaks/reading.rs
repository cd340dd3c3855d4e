//! The largest magnitude of a quantity in a step without a power series in time: an onset step or a window. Such a step
//! is part of one oscillation of the contact, so that a few readings find every turning point.

use crate::engine::base::Base;
use crate::engine::excitation::inputs::{Inputs, LinearInput};
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::quantity::{Quantity, highest_by};
use crate::engine::peaks::room::{FloorRoom, PeakRoom, PeakWork, ReadingRoom};
use crate::engine::quantities::rows::PeakOf;
use crate::engine::step::Step;
use crate::numerics::polynomial::{Coefficients, larger};
use crate::numerics::powers::Powers;
use crate::numerics::roots::{self, Knot, highest_by_readings};
use crate::structure::{LinearGround, Motion, MotionMut};

/// A step in contact, or its first part.
#[derive(Clone, Copy)]
pub struct ContactStep<'a> {
    /// The start of the step.
    pub base: &'a Base,
    pub step: &'a Step,
    pub inputs: &'a Inputs,
    /// Penetrations, m, and rates, m/s, at the start.
    pub starts: &'a [(f64, f64)],
    /// Length, s.
    pub length: f64,
    /// q and v at the end, in the coordinates of the base and relative to its position of rest.
    pub end: Motion<'a>,
}

impl<'a> ContactStep<'a> {
    /// The whole of a step.
    pub fn whole((base, step, inputs): (&'a Base, &'a Step, &'a Inputs), starts: &'a [(f64, f64)]) -> ContactStep<'a> {
        let planned = &step.planned;
        ContactStep { base, step, inputs, starts, length: planned.length, end: planned.motion() }
    }

    /// The largest magnitude of the ground acceleration, m/s2.
    pub fn strongest_ground(&self) -> f64 {
        let ground = self.base.ground();
        larger(ground.acceleration.abs(), ground.after(self.length).abs())
    }
}

impl PeakFinder<'_> {
    /// The largest magnitude of a quantity in the first part of a step that is no power series, or `known` if that is larger: in
    /// the x of a map, in which forces that begin like a root of the time are smooth.
    pub(in crate::engine) fn highest_by_readings(
        &self,
        quantity: &Quantity,
        known: f64,
        part: &ContactStep,
        work: &mut PeakWork,
    ) -> f64 {
        let ((map, start), length) = (part.step.smooth_in(), part.step.planned.length);
        let until = if part.length < length { map.inverse(part.length / length) } else { 1.0 };
        highest_by_readings((known, until), [start, 1.0], |x| {
            let (theta, rate) = map.at(x);
            let Knot { value, slope, .. } = self.read_step(quantity, length * theta, part, work);
            Knot { x, value, slope: length * rate * slope }
        })
    }

    /// The largest magnitude of an acceleration within a part of a step that is a power series, from its terms up to an x and
    /// to an order, or `known` if that is larger. The values at both ends are known without the series, which only tells the
    /// time of the peak.
    pub(in crate::engine) fn highest_acceleration(
        &self,
        of: PeakOf,
        (terms, end, order): (&Coefficients, f64, usize),
        known: f64,
        part: &ContactStep,
        work: &mut PeakWork,
    ) -> f64 {
        let mut powers = std::mem::take(&mut work.buffers.powers);
        let within = |at: f64, _| match at > 0.0 && at < end {
            true => self.acceleration_within(of, at, part, work).abs(),
            false => known,
        };
        let peak = highest_by(terms, (end, order), known, &mut powers, within);
        work.buffers.powers = powers;
        peak
    }

    /// The absolute acceleration of a floor, m/s2, at an x of a step that is a power series, from the motion and the
    /// contact forces there: in the series itself it has lost as many digits as its last terms have of the motion.
    fn acceleration_within(&self, of: PeakOf, x: f64, part: &ContactStep, work: &mut PeakWork) -> f64 {
        let PeakOf::Acceleration(id, floor) = of else { return 0.0 };
        let ContactStep { base, step, inputs, .. } = *part;
        let time = step.taylor.series.time(roots::roughly(x));
        let PeakRoom { within: floors, floors: FloorRoom { modal, .. }, pieces: [q, v, ..], .. } = &mut *work.peaks;
        let mut powers = Powers::default();
        step.set_powers(time, &mut powers);
        step.taylor.series.evaluate(&powers, q, v);
        self.find_floors(base.coordinates, (&base.rest, Motion { q, v }), floors, modal);
        self.soften(base, q, floors);
        if self.system.is_pushed {
            self.add_pushes((base, inputs), time, floors);
        }
        let lane = self.system.structure.floors.lane(id, floor);
        let closed = self.system.pairs.iter().enumerate().filter(|(p, _)| base.contacts[*p].in_contact());
        let pushes = closed.flat_map(|(p, pair)| pair.row.floors.into_iter().map(move |share| (p, share)));
        let pushed = pushes
            .filter(|(_, share)| share.lane == lane && share.push != 0.0)
            .map(|(p, share)| share.push * step.contact_at(self.system, base, p, time, &powers).present_force());
        floors.resisted[lane] + pushed.sum::<f64>()
    }

    /// Evaluates a quantity and its slope at a time of a step.
    fn read_step(&self, quantity: &Quantity, time: f64, part: &ContactStep, work: &mut PeakWork) -> Knot {
        let ground = quantity.ground.later(time);
        let (place, is_known, mut room) = work.peaks.readings.take(time);
        if !is_known {
            self.read_motion(ground, part, &mut room, work);
        }
        let ReadingRoom { q, v, acceleration, jerk, .. } = &room;
        let (value, slope) = match quantity.of {
            PeakOf::Acceleration(..) => {
                (quantity.of_motion(acceleration) + ground.acceleration, quantity.of_motion(jerk) + ground.slope)
            }
            _ => {
                let [added, rate] = quantity.added;
                let value = (added + rate * time) + (quantity.of_motion(q) + quantity.of_rate(v));
                (value, rate + (quantity.of_motion(v) + quantity.of_rate(acceleration)))
            }
        };
        work.peaks.readings.put(place, room);
        Knot { x: time, value, slope }
    }

    /// Evaluates the motion at the time of a room, its accelerations and their rates, from the equations of motion with the
    /// ground's acceleration from there on.
    fn read_motion(
        &self,
        ground: LinearGround,
        part: &ContactStep,
        ReadingRoom { time, q, v, acceleration, jerk }: &mut ReadingRoom,
        work: &mut PeakWork,
    ) {
        let ContactStep { base, step, inputs, .. } = *part;
        let (time, coordinates) = (*time, base.coordinates);
        let mut pairs = std::mem::take(&mut work.peaks.pairs);
        if time == 0.0 {
            MotionMut { q, v }.copy_from(base.motion());
            pairs.copy_from_slice(part.starts);
        } else {
            step.evaluate_with_pairs(self.system, time, &mut work.buffers.powers, MotionMut { q, v }, &mut pairs);
        }
        let closed = || base.contacts.iter().zip(&pairs).enumerate().filter(|(_, (contact, _))| contact.in_contact());
        for (lane, share) in self.system.participation(coordinates).iter().enumerate() {
            (acceleration[lane], jerk[lane]) = (-share * ground.acceleration, -share * ground.slope);
        }
        let at = base.elapsed + time;
        self.system.add_pushes(inputs, coordinates, |push| push.after(base.segment.start, at), acceleration);
        self.system.add_pushes(inputs, coordinates, LinearInput::slope, jerk);
        self.system.resist(coordinates, q, v, 1.0, acceleration);
        for (p, (contact, (d, rate))) in closed() {
            self.system.push_apart_by(p, coordinates, contact.branch().value(*d, *rate), acceleration);
        }
        self.system.resist(coordinates, v, acceleration, 1.0, jerk);
        for (p, (contact, (d, rate))) in closed() {
            let bend = self.system.pairs[p].relative(coordinates, acceleration);
            let rates = contact.branch().rates([*d, *rate, bend, 0.0]);
            self.system.push_apart_by(p, coordinates, rates.map_or(0.0, |[first, _]| first), jerk);
        }
        work.peaks.pairs = pairs;
    }
}
