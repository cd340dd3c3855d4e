//! Bounds that show that nothing happens within a window but the event that it ends with.
//!
//! Between two nodes a penetration is known at both and bends by no more than all that acts on it: what the buildings would
//! do without contact forces, of which the power series is there; and the forces, whose size is known. One in contact must
//! not sag below 0, so what bends it upwards counts; a force in contact pushes apart, so it never bends its own pair's
//! penetration upwards. One apart must not swell above 0, so what bends it downwards counts: it may rise and fall again.

use super::model::Model;
use super::state::*;
use super::window::{Moments, Window};
use crate::collocation::{Ending, MOST_PAIRS, POWERS, Tables};
use crate::contact::Guard;
use crate::polynomial::SECOND;
use crate::structure::dot;

/// Pieces of a window are halved so many times to show that a pair stays apart: down to a distance of rounding.
const MOST_HALVINGS: u32 = 16;

impl Model {
    /// Whether nothing but its ending happens in the window of a step.
    pub(super) fn is_certain(&self, base: &Base, step: &Step, work: &mut Workspace, ending: Ending) -> bool {
        let window = &*step.window;
        let equation = &window.equation;
        let pairs_hold = (0..equation.pairs).all(|place| {
            let kernels = &equation.kernels[place];
            let at_once = |other: usize| if other == place { 0.0 } else { kernels[other][1].abs() };
            let way = if place < equation.closed { Way::Up } else { Way::Down };
            let free = &equation.free[place][..equation.terms];
            let bend = window.bend(way, free, |other| (at_once(other), &kernels[other]));
            let passage = Passage { window, place, contact: &base.contacts[window.contacts[place]], bend, ending };
            if place < equation.closed {
                return passage.stays_in_contact();
            }
            passage.stays_apart(&Approach { window, free, kernels, bend })
        });
        pairs_hold && self.others_stay_apart(base, step, work)
    }

    /// Whether all pairs that are not in the window stay apart.
    fn others_stay_apart(&self, base: &Base, step: &Step, work: &mut Workspace) -> bool {
        let Some(windows) = &self.windows else { return false };
        let (window, series) = (&*step.window, &step.series);
        let Window { contacts, equation, solution, .. } = window;
        let is_other = |p: usize, contact: &Contact| !contact.in_contact() && window.place(p).is_none();
        let mut others = base.contacts.iter().enumerate().filter(|(p, contact)| is_other(*p, contact));
        others.all(|(p, contact)| {
            let row = &self.pairs[p].row;
            let terms = &mut work.scalar[..=series.order];
            for (n, term) in terms.iter_mut().enumerate().skip(2) {
                *term = dot(row, series.term(n));
            }
            let kernels: [[f64; POWERS]; MOST_PAIRS] = std::array::from_fn(|q| match q < equation.closed {
                true => windows.kernel(&self.pairs, p, contacts[q]),
                false => [0.0; POWERS],
            });
            let bend = |way: Way| window.bend(way, terms, |q| (kernels[q][1].abs(), &kernels[q]));
            if keeps_off(contact, bend(Way::Up), solution.length) {
                return true;
            }
            let bend = bend(Way::Down);
            (terms[0], terms[1]) = (contact.flight_start(), contact.rate * series.scale);
            let approach = Approach { window, free: terms, kernels: &kernels, bend };
            let end = (solution.length, approach.depth(solution.length));
            end.1 < 0.0 && approach.stays_below((0.0, terms[0]), end, MOST_HALVINGS)
        })
    }
}

/// Which way a penetration bends.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    Up,
    Down,
}

/// Whether a pair apart, whose penetration bends upwards by `bend` at most, stays so over `h` seconds.
pub(super) fn keeps_off(contact: &Contact, bend: f64, h: f64) -> bool {
    let (start, rate) = (contact.flight_start(), contact.rate);
    // Below a parabola that only falls, or one that may rise.
    let falls = start <= 0.0 && rate + 0.5 * bend * h < 0.0;
    falls || start + h * (rate.max(0.0) + 0.5 * bend * h) < 0.0
}

impl Window {
    /// m/s^2, bound on what bends the penetration of a pair that way over the window: its motion without contact forces, of
    /// which the terms are given, and what the forces do, of which the kernels are and what they do at once.
    fn bend<'a>(&self, way: Way, free: &[f64], kernels: impl Fn(usize) -> (f64, &'a [f64; POWERS])) -> f64 {
        let Window { equation, solution, .. } = self;
        let (x, h) = (solution.length / equation.scale, solution.length);
        let later = free.iter().zip(&SECOND).skip(3).rev();
        let later = later.fold(0.0, |sum, (c, count)| sum * x + count * c.abs());
        let at_start = if way == Way::Up { 2.0 * free[2] } else { -2.0 * free[2] };
        let mut bend = (at_start + later * x) / (equation.scale * equation.scale);
        for q in 0..equation.closed {
            let (at_once, kernel) = kernels(q);
            let terms = kernel[..equation.powers].iter().zip(&SECOND).skip(2).rev();
            let later = terms.fold(0.0, |sum, (g, count)| sum * h + count * g.abs());
            bend += greatest(&solution.force[q][..solution.rule.count()]) * (at_once + later * h);
        }
        bend.max(0.0)
    }
}

/// Bound on the size of a force between its nodes too.
fn greatest(force: &[f64]) -> f64 {
    2.0 * force.iter().fold(0.0_f64, |most, force| most.max(force.abs()))
}

/// A pair that is apart while a window is under way, whose distance can be read anywhere. However near it comes: where it
/// does not touch the window stays as it is, so that a contact that never closes changes nothing.
struct Approach<'a> {
    window: &'a Window,
    /// Terms of its motion without contact forces.
    free: &'a [f64],
    kernels: &'a [[f64; POWERS]; MOST_PAIRS],
    /// m/s^2, see [`Window::bend`].
    bend: f64,
}

impl Approach<'_> {
    /// m, penetration after so many seconds.
    fn depth(&self, elapsed: f64) -> f64 {
        let mut room = Moments::default();
        self.window.depth_of((self.free, self.kernels), elapsed, self.window.moments(elapsed, &mut room)).0
    }

    /// Whether it stays below 0 between two times at which it is; pieces are halved up to so many times.
    fn stays_below(&self, (start, from): (f64, f64), (end, to): (f64, f64), halvings: u32) -> bool {
        let gone = end - start;
        if from.max(to) < -0.125 * self.bend * gone * gone {
            return true;
        }
        let middle = start + 0.5 * gone;
        if halvings == 0 || middle <= start || middle >= end {
            return false;
        }
        let middle = (middle, self.depth(middle));
        middle.1 < 0.0
            && self.stays_below((start, from), middle, halvings - 1)
            && self.stays_below(middle, (end, to), halvings - 1)
    }
}

/// One pair on its way through a window.
struct Passage<'a> {
    window: &'a Window,
    place: usize,
    contact: &'a Contact,
    /// m/s^2, see [`Window::bend`].
    bend: f64,
    ending: Ending,
}

/// From one node to the next: seconds, penetration at both, rate at the second.
struct Piece {
    gone: f64,
    from: f64,
    to: f64,
    rate: f64,
    is_last: bool,
}

impl Passage<'_> {
    /// From the start by all nodes to the end.
    fn pieces(&self) -> impl Iterator<Item = Piece> {
        let Window { solution, .. } = self.window;
        let theta = &Tables::of(solution.map, solution.rule).theta[..solution.rule.count()];
        let (depth, rate) = (&solution.depth[self.place], &solution.rate[self.place]);
        let nodes = theta.iter().zip(depth).zip(rate).map(|((theta, d), v)| (theta * solution.length, *d, *v));
        let (d, v) = solution.end[self.place];
        let start = match self.contact.in_contact() {
            true => self.contact.penetration.max(0.0),
            false => self.contact.flight_start(),
        };
        let (mut time, mut from) = (0.0, start);
        nodes.chain([(solution.length, d, v)]).map(move |(next, to, rate)| {
            let piece = Piece { gone: next - time, from, to, rate, is_last: next == solution.length };
            (time, from) = (next, to);
            piece
        })
    }

    /// Whether the pair stays in contact, and on its side of the guard.
    fn stays_in_contact(&self) -> bool {
        let is_released = self.ending == Ending::Release(self.place);
        let holds = |piece: Piece| {
            // Above the chord but for the bend.
            let sag = 0.5 * self.bend * piece.gone;
            match () {
                _ if is_released && piece.is_last => piece.from / piece.gone > sag,
                _ if piece.from == 0.0 => piece.to / piece.gone > sag,
                _ => piece.from.min(piece.to) > 0.25 * sag * piece.gone,
            }
        };
        self.pieces().all(holds)
            && match self.contact.force.guard {
                None => true,
                Some(_) if self.contact.phase == Phase::Slack => self.recedes(),
                Some(guard) => self.is_engaged(&guard),
            }
    }

    /// Whether the pair stays apart.
    fn stays_apart(&self, approach: &Approach) -> bool {
        let touches = self.ending == Ending::Touch(self.place);
        let mut time = 0.0;
        self.pieces().all(|piece| {
            let (start, end) = ((time, piece.from), (time + piece.gone, piece.to));
            time = end.0;
            // Below the chord but for the bend.
            let swell = 0.5 * self.bend * piece.gone;
            match () {
                _ if touches && piece.is_last => -piece.from / piece.gone > swell,
                _ if piece.from >= 0.0 => -piece.to / piece.gone > swell,
                _ => piece.to < 0.0 && approach.stays_below(start, end, MOST_HALVINGS),
            }
        })
    }

    /// m, least penetration on a piece of a pair that stays in contact.
    fn least(&self, piece: &Piece) -> f64 {
        piece.from.min(piece.to) - 0.125 * self.bend * piece.gone * piece.gone
    }

    /// m/s^2, what the spring at a depth takes off the rate.
    fn brake(&self, depth: f64) -> f64 {
        self.contact.branch().value(depth.max(0.0), 0.0) * self.window.equation.kernels[self.place][self.place][1]
    }

    /// Whether the guard of an engaged pair stays positive, which it does while the pair approaches fast enough.
    fn is_engaged(&self, guard: &Guard) -> bool {
        let turns = self.ending == Ending::Turn(self.place);
        self.pieces().all(|piece| {
            // Up to a turn the depth only grows.
            let depth = if turns { piece.from } else { self.least(&piece) };
            let falls = || self.brake(depth) > self.bend;
            if turns && piece.is_last {
                return falls();
            }
            let is_positive = |rate: f64| guard.value(piece.to, rate) > 0.0;
            is_positive(piece.rate - self.bend * piece.gone) || is_positive(piece.rate) && falls()
        })
    }

    /// Whether a pair goes apart all the time, of which only penetrations are known.
    fn recedes(&self) -> bool {
        let mut rate = self.contact.rate;
        self.pieces().all(|piece| {
            let falls = || self.brake(self.least(&piece)) > self.bend;
            let recedes = rate + self.bend * piece.gone < 0.0 || falls();
            rate = rate.min((piece.to - piece.from) / piece.gone) + self.bend * piece.gone;
            recedes
        })
    }
}
