//! A closed contact is moved through a step, or the first part of it: penetration, impulse, work and peaks, in the same
//! way whatever kind of step holds it.
//!
//! Peaks are searched between the nodes of the whole step even where only a part of it is read: they are the same to
//! the last bit for every reader, and none ever falls.

use crate::collocation::NODES;
use crate::contact::Force;
use crate::engine::base::contact::{Contact, Passage};
use crate::numerics::roots::{Knot, highest_between, roughly};

/// A closed contact in a step, as the solution of its kind of step tells it. Times are in seconds since the start of
/// the step.
pub(super) trait Course<const N: usize> {
    /// The contact at the end of the step.
    fn last(&self) -> Reached;

    /// Penetration, m, and its first two derivatives by time, near enough to find where a peak is.
    fn near(&self, time: f64) -> [f64; 3];

    /// Penetration, m, and its rate, m/s, with all digits.
    fn at(&self, time: f64) -> (f64, f64) {
        let [penetration, rate, _] = self.near(time);
        (penetration, rate)
    }

    /// The nodes of a quadrature from the start until there, for the work of damping.
    fn nodes(&self, until: &Reached) -> Nodes<N>;

    /// Whether its penetration and a damped force may turn inside the step above their peaks of the episode so far.
    fn may_turn(&self, contact: &Contact) -> [bool; 2];
}

/// How far a contact has come in a step.
#[derive(Clone, Copy)]
pub(super) struct Reached {
    /// s.
    pub time: f64,
    /// m.
    pub penetration: f64,
    /// m/s.
    pub rate: f64,
    /// Integral of the force so far, N s.
    pub impulse: f64,
}

/// A contact at the nodes of a quadrature.
pub(super) struct Nodes<const N: usize> {
    /// Number of nodes; behind them, weights are 0.
    pub count: usize,
    /// s, in ascending order.
    pub times: [f64; N],
    /// s.
    pub weights: [f64; N],
    /// Penetrations, m.
    pub depths: [f64; N],
    /// m/s; without meaning under a law without damping.
    pub rates: [f64; N],
}

/// A node next to a peak has at least this share of it.
pub(super) const NEARLY: f64 = 0.97;

/// Most nodes, and both ends.
const MOST_PLACES: usize = NODES + 2;

/// Share of a step, from either end, within which a force may have no slope. A peak there differs from the force at
/// that end only relatively by the square of this.
const EDGE: f64 = 1e-6;

impl Contact {
    /// Moves the contact on its course to where it has been `reached`, in a step that began at the time `start`, s.
    pub(super) fn follow<const N: usize>(&mut self, course: &impl Course<N>, reached: Reached, start: f64) {
        let (law, [may_turn, force_may_turn]) = (self.branch(), course.may_turn(self));
        let Reached { time, penetration, rate, impulse } = reached;
        let mut passage = Passage { impulse, ..Passage::default() };
        let mut deepest = (time, penetration);
        if law.is_damped() || may_turn {
            let last = course.last();
            let (start, nodes) = ((self.penetration, self.rate), course.nodes(&last));
            let search = Search { course, start, nodes: &nodes, last, until: time };
            if may_turn {
                let known = self.episode.peak_penetration.max(penetration);
                deepest = search.highest(|depth, _| depth, |[_, rate, _]| rate, known).unwrap_or(deepest);
            }
            if force_may_turn {
                let slope = |[d, v, a]: [f64; 3]| law.rates([d, v, a, 0.0]).map_or(0.0, |rates| rates[0]);
                passage.strongest = search.highest(|d, v| law.value(d, v), slope, self.episode.peak_force);
            }
            if law.is_damped() {
                passage.work = if time == last.time { nodes.work(&law) } else { course.nodes(&reached).work(&law) };
            }
        }
        if deepest.1 > self.episode.peak_penetration {
            passage.deepest = Some(deepest.1);
            if !law.is_damped() {
                // The force of a spring is largest where the penetration is.
                passage.strongest = Some((deepest.0, law.value(deepest.1, 0.0)));
            }
        }
        passage.strongest = passage.strongest.map(|(time, force)| (force, start + time));
        self.book(passage);
        (self.penetration, self.rate) = (penetration, rate);
        if law.is_damped() {
            self.raise_peak(law.value(penetration, rate), start + time);
        }
    }
}

impl<const N: usize> Nodes<N> {
    /// Work of the damping part of a force, J.
    fn work(&self, law: &Force) -> f64 {
        let powers = law.damping_powers(&self.depths, &self.rates);
        self.weights.iter().zip(&powers).map(|(weight, power)| weight * power).sum()
    }
}

/// A search for peaks in a step.
struct Search<'a, const N: usize, C> {
    course: &'a C,
    /// (penetration, m, rate, m/s) at the start of the step.
    start: (f64, f64),
    /// Of the whole step.
    nodes: &'a Nodes<N>,
    last: Reached,
    /// Peaks count up to this time, s.
    until: f64,
}

impl<const N: usize, C: Course<N>> Search<'_, N, C> {
    /// (time, value) of the largest value inside of a quantity, if it exceeds a `known` one. The quantity has this
    /// value for a penetration and its rate, and this slope for a penetration and its first two derivatives.
    fn highest(
        &self,
        value: impl Fn(f64, f64) -> f64,
        slope: impl Fn([f64; 3]) -> f64,
        known: f64,
    ) -> Option<(f64, f64)> {
        let Search { course, start, nodes, last, until } = *self;
        let mut places = [(last.time, value(last.penetration, last.rate)); MOST_PLACES];
        places[0] = (0.0, value(start.0, start.1));
        let inside = nodes.times.iter().zip(nodes.depths.iter().zip(&nodes.rates)).take(nodes.count);
        for (place, (time, (depth, rate))) in places[1..].iter_mut().zip(inside) {
            *place = (*time, value(*depth, *rate));
        }
        let knot = |time: f64| {
            let [depth, rate, second] = course.near(time.clamp(EDGE * last.time, (1.0 - EDGE) * last.time));
            Knot { x: time, value: value(depth, rate), slope: slope([depth, rate, second]) }
        };
        let exactly = |time: f64, _| {
            let (depth, rate) = course.at(roughly(time));
            (roughly(time) <= until).then(|| value(depth, rate))
        };
        let found = highest_between(&places[..nodes.count + 2], (known, NEARLY), knot, exactly);
        found.map(|(time, value)| (roughly(time), value))
    }
}
