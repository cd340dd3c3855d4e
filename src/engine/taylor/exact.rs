//! A step in which an element yields and no contact is closed: all is linear, and a power series within reach of the
//! fastest mode is exact. What both of its ends prove not to happen needs no search.

use crate::engine::base::kinds::Refusal;
use crate::engine::base::planned::{First, Horizon, Planned};
use crate::engine::base::{Base, touching};
use crate::engine::bounds::certificate::stays_below;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::solution::Solution;
use crate::numerics::roots::deviation;
use crate::structure::Motion;

/// (Fastest rate) x (time) that one exact series reaches.
const REACH: f64 = 2.0;

/// Plans a step from the base, under the load in `work`, if no contact is closed.
pub fn plan_exact(
    system: &System,
    base: &Base,
    Horizon { remaining, is_cut }: Horizon,
    planned: &mut Planned,
    solution: &mut Solution,
    work: &mut Buffers,
) -> Result<(), Refusal> {
    if touching(base).next().is_some() {
        return Err(Refusal::InContact);
    }
    let length = remaining.min(REACH / system.fastest);
    system.expand_exactly(base, solution, work, length);
    system.end_at(1.0, solution, planned);
    let First { until, event } = system.first_of_exact(base, (length, planned), solution, work);
    if event.is_some() {
        system.end_at(until, solution, planned);
    }
    let reaches_limit = length == remaining && !is_cut && event.is_none();
    // The scale of contact does not change while none is closed.
    planned.plan(length * solution.end.x, event, reaches_limit, None);
    system.track(base, &solution.series, &solution.end, &mut work.scalar, &mut planned.tracked);
    Ok(())
}

impl System {
    /// Ends the step at an x of its series.
    fn end_at(&self, x: f64, solution: &mut Solution, planned: &mut Planned) {
        solution.end_at(x);
        solution.end.set_in_time(&solution.series.time_map);
        solution.series.evaluate(&solution.end, &mut planned.q, &mut planned.v);
    }

    /// The first event in a step of that length, s, whose end is planned.
    fn first_of_exact(
        &self,
        base: &Base,
        (h, planned): (f64, &Planned),
        solution: &mut Solution,
        work: &mut Buffers,
    ) -> First {
        let coordinates = base.coordinates;
        let fourths = &mut work.node_q;
        solution.series.bound_fourths(&solution.end, fourths);
        let mut first = First::up_to(1.0);
        for &(i, sense) in &solution.drifts.yielding {
            self.first_change(base, solution, (i, sense), &mut first);
        }
        for (i, (of, present)) in self.elements_at(&base.elements).enumerate() {
            let at = |Motion { q, v }: Motion| (of.drift(coordinates, q), of.drift(coordinates, v));
            let (start, end) = (at(base.motion()), at(planned.motion()));
            let off = deviation(h, of.row.difference(coordinates, fourths).1);
            if present.0.yields.is_none() && !of.stays_elastic(present, start, end, (h, off)) {
                let expanded = ((&solution.series, solution.end.in_time().0), None, true);
                self.first_yield(base, i, expanded, &mut first);
            }
        }
        for (p, (pair, contact)) in self.pairs.iter().zip(&base.contacts).enumerate() {
            let at = |q: &[f64], v: &[f64]| (pair.relative(coordinates, q), pair.relative(coordinates, v));
            let (end, rate) = at(&planned.q, &planned.v);
            let (from, to) = ((contact.flight_start(), contact.rate), (end - base.rest.gaps[p], rate));
            let off = deviation(h, pair.row.difference(coordinates, fourths).1);
            if !stays_below(from, to, (h, off)) {
                let expanded = ((&solution.series, &*solution.substitution), &mut solution.end);
                self.first_entry_of(base, p, expanded, &mut work.scalar, &mut first);
            }
        }
        first
    }
}
