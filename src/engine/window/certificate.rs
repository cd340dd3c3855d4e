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
use crate::engine::window::free::FreeTerms;
use crate::engine::window::kernels::Windows;
use crate::engine::window::solution::Window;
use crate::numerics::polynomial::SECOND;
use crate::structure::FreeRows;
use std::array::from_fn;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Halvings of a piece of a window to show that a pair stays apart in it: down to a distance of rounding.
const MOST_HALVINGS: u32 = 16;

impl Windows {
    /// Whether no event happens in the window of a step but its ending.
    pub fn is_certain(
        &self,
        system: &System,
        base: &Base,
        (window, free): (&Window, FreeTerms),
        work: &mut Buffers,
        ending: Ending,
    ) -> bool {
        let equation = &window.equation;
        let pairs_hold = (0..equation.pairs).all(|place| {
            let kernels = &equation.kernels[place].each_ref();
            let curved = if place < equation.closed { Curved::Up } else { Curved::Down };
            let terms = &equation.free[place][..equation.terms];
            let of_kernels = self.of_kernels(system, window, window.contacts[place]);
            let curvature = window.curvature(curved, terms, (kernels, &of_kernels), Some(place));
            let passage =
                PairPath { window, place, contact: &base.contacts[window.contacts[place]], curvature, ending };
            if place < equation.closed {
                return passage.stays_in_contact();
            }
            passage.stays_apart(&Approach { window, free: terms, kernels, curvature })
        });
        pairs_hold
            && self.others_stay_apart(system, base, (window, free), work)
            && window.stays_elastic(system, base, work)
    }

    /// Bounds on the integrals of the second derivatives of a pair's kernels, for the closed pairs of a window.
    fn of_kernels(&self, system: &System, window: &Window, p: usize) -> [f64; MOST_PAIRS] {
        window.contacts.map(|q| self.curvature_of_kernel(system, p, q))
    }

    /// Whether all pairs outside the window stay apart.
    fn others_stay_apart(
        &self,
        system: &System,
        base: &Base,
        (window, free): (&Window, FreeTerms),
        work: &mut Buffers,
    ) -> bool {
        let Window { contacts, equation, solution, .. } = window;
        let is_other = |p: usize, contact: &Contact| !contact.in_contact() && window.place(p).is_none();
        let mut others = base.contacts.iter().enumerate().filter(|(p, contact)| is_other(*p, contact));
        others.all(|(p, contact)| {
            let terms = &mut work.scalar[..free.count()];
            free.enter(system, p, terms);
            let (mut kernels, mut room) = ([&[0.0; POWERS]; MOST_PAIRS], [None; MOST_PAIRS]);
            for ((kernel, room), q) in kernels.iter_mut().zip(&mut room).zip(&contacts[..equation.closed]) {
                *kernel = self.kernel(system, p, *q, room);
            }
            let of_kernels = self.of_kernels(system, window, p);
            let curvature = |curved: Curved| window.curvature(curved, terms, (&kernels, &of_kernels), None);
            if keeps_off(contact, curvature(Curved::Up), solution.length) {
                return true;
            }
            let curvature = curvature(Curved::Down);
            (terms[0], terms[1]) = (contact.flight_start(), contact.rate * free.scale());
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
    fn curvature(
        &self,
        curved: Curved,
        free: &[f64],
        (kernels, of_kernels): (&[&Kernel; MOST_PAIRS], &[f64; MOST_PAIRS]),
        itself: Option<usize>,
    ) -> f64 {
        let Window { equation, solution, greatest, .. } = self;
        let (x, h) = (solution.length / equation.scale, solution.length);
        let mut curvature = match free.len() == FreeRows::TERMS {
            // Powers of quick modes cancel: their magnitudes would say nothing.
            true => highest_curvature(free, x, curved),
            false => {
                let at_start = if curved == Curved::Up { 2.0 * free[2] } else { -2.0 * free[2] };
                at_start + sum_of_sizes(free, 3, x) * x
            }
        };
        curvature /= equation.scale * equation.scale;
        for q in 0..equation.closed {
            let at_once = if itself == Some(q) { 0.0 } else { kernels[q][1].abs() };
            let later = sum_of_sizes(&kernels[q][..equation.powers], 2, h);
            curvature += greatest[q] * (at_once + (later * h).min(of_kernels[q]));
        }
        curvature.max(0.0)
    }
}

/// Points at which the second derivative of a polynomial of [`FreeRows::TERMS`] terms is evaluated for a bound on it.
const POINTS: usize = 36;

/// The zeros of the Chebyshev polynomial of that degree on 0..=1, by fours.
static CHEBYSHEV: LazyLock<[[f64; 4]; POINTS / 4]> = LazyLock::new(|| {
    from_fn(|c| from_fn(|i| 0.5 - 0.5 * libm::cos((2 * (4 * c + i) + 1) as f64 * PI / (2 * POINTS) as f64)))
});

/// A polynomial of degree n is at most 1 / cos(n pi / (2 N)) times as large as at N such points \[EhlichZeller1964\]:
/// for the second derivative of one of [`FreeRows::TERMS`] terms.
const BETWEEN_POINTS: f64 = 1.36;

/// A bound on the second derivative of a polynomial, of that curved, over 0..=x.
fn highest_curvature(terms: &[f64], x: f64, curved: Curved) -> f64 {
    let (lowest, highest) = curvatures(&CHEBYSHEV, terms, x);
    let (middle, half) = (0.5 * (highest + lowest), 0.5 * (highest - lowest));
    let bound = BETWEEN_POINTS * half + if curved == Curved::Up { middle } else { -middle };
    if bound.is_nan() { f64::INFINITY } else { bound }
}

/// The least and the largest second derivative at the points; NaN where any is.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn curvatures(points: &[[f64; 4]; POINTS / 4], terms: &[f64], x: f64) -> (f64, f64) {
    let mut factors = [0.0; FreeRows::TERMS];
    for n in 2..FreeRows::TERMS {
        factors[n] = terms[n] * SECOND[n];
    }
    let (mut low, mut high, mut all) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4], [0.0; 4]);
    for points in points {
        let mut sum = [0.0; 4];
        for n in (2..FreeRows::TERMS).rev() {
            for i in 0..4 {
                sum[i] = sum[i] * (points[i] * x) + factors[n];
            }
        }
        for i in 0..4 {
            low[i] = if sum[i] < low[i] { sum[i] } else { low[i] };
            high[i] = if sum[i] > high[i] { sum[i] } else { high[i] };
            all[i] += 0.0 * sum[i];
        }
    }
    let spoiled: f64 = all.iter().sum();
    (low.into_iter().fold(low[0], f64::min) + spoiled, high.into_iter().fold(high[0], f64::max) + spoiled)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Polynomials with terms that cancel, such as quick modes have: the bound is above the curvature at all times, and
    /// not far above the largest.
    #[test]
    fn a_bound_by_values_at_points_holds_between_them() {
        for (rate, swing) in [(0.0, 3.0), (-13.0, 0.0), (-2.0, 9.0), (0.5, 1.0)] {
            // exp(rate x) cos(swing x), by its first terms.
            let (mut power, mut terms) = ([1.0, 0.0], [0.0; FreeRows::TERMS]);
            for (n, term) in terms.iter_mut().enumerate() {
                *term = power[0];
                let k = n as f64 + 1.0;
                power = [(rate * power[0] - swing * power[1]) / k, (rate * power[1] + swing * power[0]) / k];
            }
            for end in [0.1, 0.77, 1.0] {
                let at = |k: u32| end * f64::from(k) / 1000.0;
                let curvature = |x: f64| (2..terms.len()).rev().fold(0.0, |sum, n| sum * x + SECOND[n] * terms[n]);
                for (curved, sign) in [(Curved::Up, 1.0), (Curved::Down, -1.0)] {
                    let largest = (0..=1000).map(|k| sign * curvature(at(k))).fold(f64::NEG_INFINITY, f64::max);
                    let size = (0..=1000).map(|k| curvature(at(k)).abs()).fold(0.0, f64::max);
                    let bound = highest_curvature(&terms, end, curved);
                    assert!(
                        bound >= largest && bound <= largest + 0.5 * size,
                        "{rate} {swing} {end}: {bound}, {largest}"
                    );
                }
            }
        }
        assert_eq!(highest_curvature(&[f64::NAN; FreeRows::TERMS], 1.0, Curved::Up), f64::INFINITY);
    }
}
