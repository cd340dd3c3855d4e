//! The largest magnitude of a quantity in a step without a power series in time: an onset step or a window. Such a step
//! is part of one oscillation of the contact, and is no longer than a series of the fastest mode reaches, so that sixteen nodes
//! tell every turning point.

use crate::collocation::{AtNodes, MOST_PAIRS, Map, NODES, NodeCount, interpolants, nodes};
use crate::engine::base::Base;
use crate::engine::excitation::inputs::{Inputs, LinearInput};
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::quantity::{Quantity, highest_by};
use crate::engine::peaks::room::{FloorRoom, PeakRoom, PeakWork};
use crate::engine::quantities::rows::PeakOf;
use crate::engine::step::{Dense, Step};
use crate::engine::window::quantity::Share;
use crate::numerics::polynomial::{Coefficients, larger};
use crate::numerics::powers::Powers;
use crate::numerics::roots::{self, highest_between};
use crate::structure::{Motion, MotionMut};
use std::cell::OnceCell;

/// A node next to a turning point has at least this share of the value there.
const NODES_NEARLY: f64 = 0.9;

/// What the polynomial through the nodes may be off by at a turning point, relative to its value, without one that counts being
/// left out.
const NODES_ERROR: f64 = 1e-3;

/// A step in contact, or its first part.
#[derive(Clone, Copy)]
pub struct ContactStep<'a> {
    /// The start of the step.
    pub base: &'a Base,
    pub step: &'a Step,
    pub inputs: &'a Inputs,
    /// Length, s.
    pub length: f64,
    /// q and v at the end, in the coordinates of the base and relative to its position of rest.
    pub end: Motion<'a>,
}

impl<'a> ContactStep<'a> {
    /// The whole of a step.
    pub fn whole(base: &'a Base, step: &'a Step, inputs: &'a Inputs) -> ContactStep<'a> {
        let planned = &step.planned;
        ContactStep { base, step, inputs, length: planned.length, end: planned.motion() }
    }

    /// The largest magnitude of the ground acceleration, m/s2.
    pub fn strongest_ground(&self) -> f64 {
        let ground = self.base.ground();
        larger(ground.acceleration.abs(), ground.after(self.length).abs())
    }
}

impl PeakFinder<'_> {
    /// The largest magnitude of a quantity in the first part of a step that is no power series, or `known` if that is larger. Its
    /// values at sixteen nodes of the whole step tell where it turns, the motion there its value.
    pub(in crate::engine) fn highest_by_nodes(
        &self,
        quantity: &Quantity,
        known: f64,
        part: &ContactStep,
        work: &mut PeakWork,
    ) -> f64 {
        let Some((map, values)) = self.read_nodes(quantity, part, work) else { return known };
        let (of, curve) = (nodes(NodeCount::Sixteen), OnceCell::new());
        let knot = |x: f64| curve.get_or_init(|| interpolants(of, [&values]))[0].knot(x);
        let mut peak = known;
        for sign in [1.0, -1.0] {
            // Next to an end a node is compared with the other one beside it alone.
            let mut places = [(0.0, f64::NEG_INFINITY); NODES + 2];
            places[NODES + 1].0 = 1.0;
            for (place, (x, value)) in places[1..].iter_mut().zip(of.x.iter().zip(&values)) {
                *place = (*x, sign * value);
            }
            let exactly = |x: f64, best: f64| {
                let time = part.step.planned.length * map.at(x).0;
                let counts = time <= part.length && sign * knot(x).value > (1.0 - NODES_ERROR) * best;
                counts.then(|| sign * self.read(quantity, time, part, work))
            };
            let found = highest_between(&places, (peak, NODES_NEARLY), |x| knot(x).times(sign), exactly);
            peak = found.map_or(peak, |(_, value)| value);
        }
        peak
    }

    /// A quantity at sixteen nodes of the whole of a step that is no power series, and the map from their x to its time: in that
    /// x forces that begin like a root of the time are smooth.
    fn read_nodes(&self, quantity: &Quantity, part: &ContactStep, work: &mut PeakWork) -> Option<(Map, AtNodes)> {
        let length = part.step.planned.length;
        match part.step.dense() {
            Dense::Window(window, free) => {
                let moments = &mut work.buffers.moments;
                if moments.is_empty() {
                    window.set_moments(moments);
                }
                let (terms, order) = quantity.terms(free, None);
                let response = self.system.impulse_response.as_ref()?;
                let mut shares = [Share::default(); MOST_PAIRS];
                for (share, p) in shares.iter_mut().zip(&window.contacts).take(window.equation.closed) {
                    *share = quantity.share((response, window.equation.powers), &self.system.pairs[*p].row.modes);
                }
                Some((window.solution.map, window.quantity_at_nodes(&terms[..=order], &shares, moments)))
            }
            Dense::Onset(onset) => {
                let times = nodes(NodeCount::Sixteen).x.map(|x| length * Map::FourthStart.at(x).0);
                Some((Map::FourthStart, quantity.in_onset(onset, &times)?))
            }
            Dense::Taylor(_) | Dense::Flight => None,
        }
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

    /// A quantity at a time of a step, from the motion there: accelerations by the equations of motion, with the ground's
    /// acceleration from there on.
    fn read(&self, quantity: &Quantity, time: f64, part: &ContactStep, work: &mut PeakWork) -> f64 {
        let ContactStep { base, step, inputs, .. } = *part;
        let (coordinates, ground) = (base.coordinates, quantity.ground.later(time));
        let PeakRoom { pieces: [q, v, acceleration, _], pairs, .. } = &mut *work.peaks;
        let is_acceleration = matches!(quantity.of, PeakOf::Acceleration(..));
        let pairs = if is_acceleration { &mut pairs[..] } else { &mut [] };
        step.evaluate_with_pairs(self.system, time, &mut work.buffers.powers, MotionMut { q, v }, pairs);
        if !is_acceleration {
            let [added, rate] = quantity.added;
            return (added + rate * time) + (quantity.of_motion(q) + quantity.of_rate(v));
        }
        for (acceleration, share) in acceleration.iter_mut().zip(self.system.participation(coordinates)) {
            *acceleration = -share * ground.acceleration;
        }
        let at = |push: &LinearInput| push.after(base.segment.start, base.elapsed + time);
        self.system.add_pushes(inputs, coordinates, at, acceleration);
        self.system.resist(coordinates, q, v, 1.0, acceleration);
        for (p, (contact, (d, rate))) in base.contacts.iter().zip(pairs).enumerate() {
            if contact.in_contact() {
                self.system.push_apart_by(p, coordinates, contact.branch().value(*d, *rate), acceleration);
            }
        }
        quantity.of_motion(acceleration) + ground.acceleration
    }
}
