//! The instants at which storeys yield, and at which those that yield turn, while the motion is a power series.

use crate::engine::base::Base;
use crate::engine::base::planned::Event;
use crate::engine::base::storey::{Sense, Storey};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::solution::Solution;
use crate::engine::yielding::storey::YieldingStorey;
use crate::numerics::polynomial::{COUNT, MAX_TERMS};
use crate::numerics::roots;

impl System {
    /// A storey that yields although its drift goes back: an impulse has turned it, or rounding.
    pub fn turned_at_once(&self, base: &Base) -> Option<usize> {
        let goes_back = |(of, storey): (&YieldingStorey, &Storey)| {
            storey.yields.is_some_and(|sense| sense.sign() * of.drift(base.coordinates, &base.v) < 0.0)
        };
        self.storeys.iter().zip(&base.storeys).position(goes_back)
    }

    /// The first instant up to the end of the step at which a storey yields or turns, as (x, event).
    pub fn first_switch(&self, base: &Base, solution: &mut Solution, work: &mut Buffers) -> Option<(f64, Event)> {
        if self.storeys.is_empty() {
            return None;
        }
        let mut first = None;
        for &(i, sense) in &solution.drifts.yielding {
            first = first_turn(solution, (i, sense), first).or(first);
        }
        let Solution { series, end, substitution, .. } = solution;
        let reach = end.x + series.time_map.curvature.abs() * end.x * end.x;
        series.sum_sizes(2, reach, &mut work.node_q);
        for (i, (of, storey)) in self.storeys.iter().zip(&base.storeys).enumerate() {
            let [drift, step] = [0, 1].map(|n| of.drift(base.coordinates, series.term(n)));
            let wandered = of.size(base.coordinates, &work.node_q);
            let stays_elastic = |sense: Sense| {
                of.excess(storey, sense, drift) + reach * (sense.sign() * step).max(0.0) + wandered < 0.0
            };
            if storey.yields.is_some() || Sense::BOTH.into_iter().all(stays_elastic) {
                continue;
            }
            end.set_in_time(&series.time_map);
            let expanded = ((&*series, end.in_time().0), Some(&**substitution), true);
            first = self.first_yield(base, i, expanded, first, end.x).or(first);
        }
        first
    }
}

/// The first instant at which the drift of a storey that yields turns, if before the first event known so far.
pub fn first_turn(
    solution: &Solution,
    (i, sense): (usize, Sense),
    first: Option<(f64, Event)>,
) -> Option<(f64, Event)> {
    let Solution { series, drifts, substitution, end, .. } = solution;
    let mut terms = [0.0; MAX_TERMS];
    let count = series.order;
    for n in 0..count {
        terms[n] = -sense.sign() * (COUNT[n + 1] * drifts.drifts[i][n + 1]);
    }
    if series.time_map.is_curved() {
        substitution.apply_to_one(&mut terms[..count]);
    }
    let until = first.map_or(end.x, |(x, _)| x);
    roots::first_upcrossing(&mut terms[..count], until, 0.0).map(|x| (x, Event::Turn(i)))
}
