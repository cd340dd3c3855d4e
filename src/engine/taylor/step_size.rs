//! How far a Taylor step reaches: the last two terms of its velocities stay below the tolerance \[JorbaZou2005\].

use crate::engine::base::{Base, Coordinates, touching};
use crate::engine::system::System;
use crate::engine::taylor::solution::Solution;
use crate::numerics::polynomial::{MAX_TERMS, rough_root};
use crate::structure::MotionSeries;

/// Velocity that a force neglected at the singular start of a power law may have caused, as a share of a step's
/// tolerance.
const START_SHARE: f64 = 0.1;

/// Largest reach of a series, in units of its scale. Beyond it, terms that have underflowed in a scale far too short
/// would be missed, and the powers of the step would overflow. The next series has a better scale.
pub const FURTHEST: f64 = 1e9;

/// Step tolerance below which a step keeps away from the end of its time map and of its reach: there the rounding
/// errors of the terms in time are amplified a thousand times at the high orders that such a tolerance needs.
const NEAR_ROUNDING: f64 = 1e-13;

/// Share of the time map up to a release that a step with such a tolerance takes.
const KEEPING_AWAY: f64 = 0.9;

impl System {
    /// Share of the way to the end of a time map, or of the remaining time, that a step may take.
    pub fn safety_factor(&self) -> f64 {
        if self.tolerance.step < NEAR_ROUNDING { KEEPING_AWAY } else { 1.0 }
    }

    /// The step length for a series whose terms show that it is accurate up to about `reach`: 0.9 of it, or the `whole`
    /// remaining length if that is within reach.
    pub fn with_safety(&self, reach: f64, whole: f64) -> f64 {
        if self.safety_factor() * reach >= whole { whole } else { 0.9 * reach }
    }

    /// Reach at which the last two terms of the velocity are below the tolerance, in units of the series' scale; with
    /// safety.
    ///
    /// The velocity is controlled, not the displacement: over a contact of a millisecond a displacement error
    /// corresponds to a velocity error a thousand times as large.
    pub fn accurate_reach(&self, base: &Base, solution: &Solution, is_singular: bool, whole: f64) -> f64 {
        let series = &solution.series;
        let mut reach = self.reach_of_terms(base, series, self.tolerance.step * base.velocity_scale * series.scale);
        reach = self.with_safety(reach, whole);
        if !is_singular {
            return reach.min(FURTHEST);
        }
        for (p, contact) in touching(base).filter(|(_, contact)| contact.is_singular()) {
            let law = contact.branch();
            let mut terms = [0.0; MAX_TERMS];
            let (block, lane) = solution.closed.packed.of(p);
            block.copy_penetration(lane, &mut terms);
            let left_out = |x: f64| {
                let (penetration, rate) =
                    terms.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * x + c.abs(), slope * x + value));
                law.value(penetration, rate / series.scale) * x * series.scale / self.pairs[p].mass
            };
            reach = reach.min(self.forceless_reach(left_out, base, series, whole));
        }
        reach.min(FURTHEST)
    }

    /// Reach at which the last two terms, each times its power, are below `allowed`, m.
    fn reach_of_terms(&self, base: &Base, series: &MotionSeries, allowed: f64) -> f64 {
        let mut reach = f64::INFINITY;
        for n in [series.order - 1, series.order] {
            let term = n as f64 * self.floor_norm(base.coordinates, series.term(n));
            if term > 0.0 {
                reach = reach.min(match allowed {
                    0.0 => self.reach_from_rest(base.coordinates, series, n, term),
                    _ => rough_root(allowed / term, n - 1),
                });
            }
        }
        reach
    }

    /// Reach at which the last term is below the tolerance where nothing has moved yet, so that no velocity scale is
    /// known: it is compared with the velocity by the largest of the earlier terms at that reach.
    fn reach_from_rest(&self, coordinates: Coordinates, series: &MotionSeries, last: usize, last_term: f64) -> f64 {
        (2..last / 2)
            .map(|n| {
                let term = n as f64 * self.floor_norm(coordinates, series.term(n));
                libm::pow(self.tolerance.step * term / last_term, 1.0 / (last - n) as f64)
            })
            .fold(0.0, f64::max)
    }

    /// Reach up to which the force of a power law may be neglected after an entry: the velocity that it would have
    /// caused, `left_out`, m/s, is a small share of the velocity scale and of the velocity gained in the step.
    fn forceless_reach(&self, left_out: impl Fn(f64) -> f64, base: &Base, series: &MotionSeries, whole: f64) -> f64 {
        let (speed, coordinates) = (base.velocity_scale, base.coordinates);
        let gained = [2, 3, 4].map(|n| n as f64 * self.floor_norm(coordinates, series.term(n)) / series.scale);
        let mut x = whole;
        while x > 1e-30 {
            let gained = x * (gained[0] + x * (gained[1] + x * gained[2]));
            if left_out(x) <= START_SHARE * self.tolerance.step * (speed + gained) {
                break;
            }
            x *= 0.5;
        }
        x
    }
}
