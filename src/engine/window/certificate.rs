//! Proof that within a window no event happens but the one with which it ends.
//!
//! Between two nodes a penetration is known at both, and its second derivative is bounded: that of the motion without
//! contact forces by its power series, that of the contact forces by their magnitudes. A closed pair's penetration must
//! not fall to 0: only upward curvature can take it below its chord, and as its own force pushes the floors apart and
//! so curves it downwards, that force may be left out. An open pair's penetration must not rise to 0: there downward
//! curvature counts.

use crate::collocation::{Ending, Kernel, MOST_PAIRS, POWERS, SolvedWindow, Tables};
use crate::contact::Guard;
use crate::engine::base::Base;
use crate::engine::base::contact::{Contact, ContactPhase};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::window::kernels::Windows;
use crate::engine::window::solution::Window;
use crate::numerics::polynomial::{MAX_TERMS, SECOND};
use crate::structure::MotionSeries;

/// Halvings of a piece of a window to show that a pair stays apart in it: down to a distance of rounding.
const MOST_HALVINGS: u32 = 16;

impl Windows {
    /// Whether no event happens in the window of a step but its ending.
    pub fn is_certain(
        &self,
        system: &System,
        base: &Base,
        (window, free): (&Window, &MotionSeries),
        work: &mut Buffers,
        ending: Ending,
    ) -> bool {
        let equation = &window.equation;
        let pairs_hold = (0..equation.pairs).all(|place| {
            let kernels = &equation.kernels[place].each_ref();
            let curved = if place < equation.closed { Curved::Up } else { Curved::Down };
            let terms = &equation.free[place][..equation.terms];
            let curvature = window.curvature(curved, terms, kernels, Some(place));
            let passage =
                PairPath { window, place, contact: &base.contacts[window.contacts[place]], curvature, ending };
            if place < equation.closed {
                return passage.stays_in_contact();
            }
            passage.stays_apart(&Approach { window, free: terms, kernels, curvature })
        });
        pairs_hold && self.others_stay_apart(system, base, (window, free)) && window.stays_elastic(system, base, work)
    }

    /// Whether all pairs outside the window stay apart.
    fn others_stay_apart(&self, system: &System, base: &Base, (window, free): (&Window, &MotionSeries)) -> bool {
        let Window { contacts, equation, solution, .. } = window;
        let is_other = |p: usize, contact: &Contact| !contact.in_contact() && window.place(p).is_none();
        let mut others = base.contacts.iter().enumerate().filter(|(p, contact)| is_other(*p, contact));
        others.all(|(p, contact)| {
            let terms = &mut [0.0; MAX_TERMS][..=free.order];
            free.dot_each(&system.pairs[p].row.modes, 2, terms);
            let (mut kernels, mut room) = ([&[0.0; POWERS]; MOST_PAIRS], [None; MOST_PAIRS]);
            for ((kernel, room), q) in kernels.iter_mut().zip(&mut room).zip(&contacts[..equation.closed]) {
                *kernel = self.kernel(system, p, *q, room);
            }
            let curvature = |curved: Curved| window.curvature(curved, terms, &kernels, None);
            if keeps_off(contact, curvature(Curved::Up), solution.length) {
                return true;
            }
            let curvature = curvature(Curved::Down);
            (terms[0], terms[1]) = (contact.flight_start(), contact.rate * free.scale);
            let approach = Approach { window, free: terms, kernels: &kernels, curvature };
            let end = (solution.length, approach.depth(solution.length));
            end.1 < 0.0 && approach.stays_below((0.0, terms[0]), end, MOST_HALVINGS)
        })
    }
}

/// Sign of the curvature (second derivative) that a bound is for.
#[derive(Clone, Copy, PartialEq)]
enum Curved {
    Up,
    Down,
}

/// Whether an open pair, whose penetration has at most the second derivative `curvature`, m/s2, stays apart for `h`
/// seconds.
pub fn keeps_off(contact: &Contact, curvature: f64, h: f64) -> bool {
    let (start, rate) = (contact.flight_start(), contact.rate);
    // The penetration is below a parabola, which either falls throughout or may rise.
    let falls = start <= 0.0 && rate + 0.5 * curvature * h < 0.0;
    falls || start + h * (rate.max(0.0) + 0.5 * curvature * h) < 0.0
}

impl Window {
    /// Bound on the second derivative of a pair's penetration over the window, in that curved, m/s2: of its motion
    /// without contact forces, from the terms `free`, and of all contact forces, from the `kernels`. The direct effect
    /// of its own force is left out if it is number `itself` in the window.
    fn curvature(&self, curved: Curved, free: &[f64], kernels: &[&Kernel; MOST_PAIRS], itself: Option<usize>) -> f64 {
        let Window { equation, solution, greatest, .. } = self;
        let (x, h) = (solution.length / equation.scale, solution.length);
        let at_start = if curved == Curved::Up { 2.0 * free[2] } else { -2.0 * free[2] };
        let mut curvature = (at_start + sum_of_sizes(free, 3, x) * x) / (equation.scale * equation.scale);
        for q in 0..equation.closed {
            let at_once = if itself == Some(q) { 0.0 } else { kernels[q][1].abs() };
            let later = sum_of_sizes(&kernels[q][..equation.powers], 2, h);
            curvature += greatest[q] * (at_once + later * h);
        }
        curvature.max(0.0)
    }
}

/// Sum of the magnitudes of the second derivatives of the terms from number `first` on, divided by the power of x in
/// the first of them.
fn sum_of_sizes(terms: &[f64], first: usize, x: f64) -> f64 {
    let last = terms.len().min(SECOND.len());
    let terms = terms[first..last].iter().zip(&SECOND[first..last]);
    terms.rev().fold(0.0, |sum, (c, count)| sum * x + count * c.abs())
}

/// An open pair during a window, whose penetration can be evaluated at any time. The window stays as it is however near
/// the pair comes, as long as it does not touch: so a contact that never closes changes no result.
struct Approach<'a> {
    /// The solved window.
    window: &'a Window,
    /// Terms of its motion without contact forces.
    free: &'a [f64],
    kernels: &'a [&'a Kernel; MOST_PAIRS],
    /// Bound on the second derivative of its penetration, m/s2, see [`Window::curvature`].
    curvature: f64,
}

impl Approach<'_> {
    /// Penetration after `elapsed` seconds, m.
    fn depth(&self, elapsed: f64) -> f64 {
        let mut room = None;
        self.window.depth_of((self.free, self.kernels), elapsed, self.window.moments(elapsed, &mut room)).0
    }

    /// Whether the penetration stays below 0 between two times, at which it is below 0; `start` and `end` are (time,
    /// penetration). Pieces are halved at most `halvings` times.
    fn stays_below(&self, (start, from): (f64, f64), (end, to): (f64, f64), halvings: u32) -> bool {
        let gone = end - start;
        if from.max(to) < -0.125 * self.curvature * gone * gone {
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

/// One pair over a window.
struct PairPath<'a> {
    window: &'a Window,
    /// Index of the pair in the window.
    place: usize,
    contact: &'a Contact,
    /// Bound on the second derivative of its penetration, m/s2, see [`Window::curvature`].
    curvature: f64,
    ending: Ending,
}

/// The piece of a window from one node to the next.
struct Stride {
    /// Its length, s.
    gone: f64,
    /// Penetration at its start, m.
    from: f64,
    /// Penetration at its end, m.
    to: f64,
    /// Rate at its end, m/s.
    rate: f64,
    is_last: bool,
}

/// Whether a penetration that is above 0 at the nodes is so between them: it is below its chord by at most h^2/8
/// `curvature`.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn stays_above((theta, length): (&[f64], f64), depth: &[f64], curvature: f64) -> bool {
    let mut holds = true;
    for ((from, to), (start, end)) in theta.iter().zip(&theta[1..]).zip(depth.iter().zip(&depth[1..])) {
        let gone = to * length - from * length;
        holds &= start.min(*end) > 0.25 * (0.5 * curvature * gone) * gone;
    }
    holds
}

impl PairPath<'_> {
    /// Whether something holds for all pieces: from the start to the first node, between nodes, and from the last one
    /// to the end.
    #[inline(always)]
    fn all(&self, mut holds: impl FnMut(Stride) -> bool) -> bool {
        let Window { solution, .. } = self.window;
        let theta = &Tables::of(solution.map, solution.rule).theta[..solution.rule.count()];
        let (depth, rate) = (&solution.depth[self.place], &solution.rate[self.place]);
        let (mut time, mut from) = (0.0, self.start());
        for ((theta, to), rate) in theta.iter().zip(depth).zip(rate) {
            let next = theta * solution.length;
            if !holds(Stride { gone: next - time, from, to: *to, rate: *rate, is_last: false }) {
                return false;
            }
            (time, from) = (next, *to);
        }
        let (to, rate) = solution.end[self.place];
        holds(Stride { gone: solution.length - time, from, to, rate, is_last: true })
    }

    /// Penetration at the start, m.
    fn start(&self) -> f64 {
        match self.contact.in_contact() {
            true => self.contact.penetration.max(0.0),
            false => self.contact.flight_start(),
        }
    }

    /// Whether the pair stays in contact, and on its side of the guard.
    fn stays_in_contact(&self) -> bool {
        let is_released = self.ending == Ending::Release(self.place);
        let SolvedWindow { map, rule, length, ref depth, ref end, .. } = self.window.solution;
        let theta = &Tables::of(map, rule).theta[..rule.count()];
        let (depth, start, (end, _)) = (&depth[self.place][..rule.count()], self.start(), end[self.place]);
        let (before, after) = (theta[0] * length, length - theta[theta.len() - 1] * length);
        let sag = |gone: f64| 0.5 * self.curvature * gone;
        let begins = match start == 0.0 {
            true => depth[0] / before > sag(before),
            false => start.min(depth[0]) > 0.25 * sag(before) * before,
        };
        let last = depth[depth.len() - 1];
        let ends = match is_released {
            true => last / after > sag(after),
            false => last.min(end) > 0.25 * sag(after) * after,
        };
        begins
            && ends
            && stays_above((theta, length), depth, self.curvature)
            && match self.contact.force.guard {
                None => true,
                Some(_) if self.contact.phase == ContactPhase::Slack => self.recedes(),
                Some(guard) => self.is_engaged(&guard),
            }
    }

    /// Whether the pair stays apart.
    fn stays_apart(&self, approach: &Approach) -> bool {
        let touches = self.ending == Ending::Touch(self.place);
        let mut time = 0.0;
        self.all(|piece| {
            let (start, end) = ((time, piece.from), (time + piece.gone, piece.to));
            time = end.0;
            // The penetration exceeds its chord by at most `swell` times the distance from an end.
            let swell = 0.5 * self.curvature * piece.gone;
            match () {
                _ if touches && piece.is_last => -piece.from / piece.gone > swell,
                _ if piece.from >= 0.0 => -piece.to / piece.gone > swell,
                _ => piece.to < 0.0 && approach.stays_below(start, end, MOST_HALVINGS),
            }
        })
    }

    /// Least penetration on a piece of a pair that stays in contact, m.
    fn least(&self, piece: &Stride) -> f64 {
        piece.from.min(piece.to) - 0.125 * self.curvature * piece.gone * piece.gone
    }

    /// Deceleration of the penetration by the spring at a depth, m/s2.
    fn brake(&self, depth: f64) -> f64 {
        self.contact.branch().value(depth.max(0.0), 0.0) * self.window.equation.kernels[self.place][self.place][1]
    }

    /// Whether the guard of an engaged pair stays positive, as it does while the pair approaches fast enough.
    fn is_engaged(&self, guard: &Guard) -> bool {
        let turns = self.ending == Ending::Turn(self.place);
        self.all(|piece| {
            // Until a turn the penetration only grows.
            let depth = if turns { piece.from } else { self.least(&piece) };
            let falls = || self.brake(depth) > self.curvature;
            if turns && piece.is_last {
                return falls();
            }
            let is_positive = |rate: f64| guard.value(piece.to, rate) > 0.0;
            is_positive(piece.rate - self.curvature * piece.gone) || is_positive(piece.rate) && falls()
        })
    }

    /// Whether a pair separates throughout, shown by its penetrations alone.
    fn recedes(&self) -> bool {
        let mut rate = self.contact.rate;
        self.all(|piece| {
            let falls = || self.brake(self.least(&piece)) > self.curvature;
            let recedes = rate + self.curvature * piece.gone < 0.0 || falls();
            rate = rate.min((piece.to - piece.from) / piece.gone) + self.curvature * piece.gone;
            recedes
        })
    }
}
