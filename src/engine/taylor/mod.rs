//! A Taylor step in contact, or while an element yields: power series in time of the motion and of the contact forces.
//!
//! Each power follows from the ones before by a few vector operations; only the contact forces need products of series.
//! The last terms determine the step length. The motion is that of the floors where these are many and coupled to their
//! neighbours only, else that of the modes, as always near rigid contacts.
//!
//! Under a power law the series in time converges only up to the singularity at the entry or at the release. There it
//! is re-expanded in the x of a [`TimeMap`], in which the motion is analytic at that point, and reaches several times
//! as far.

pub mod assignment;
pub mod closed_pairs;
pub mod departures;
pub mod drifts;
pub mod expansion;
pub mod follow;
pub mod pair_forces;
pub mod reached;
pub mod solution;
pub mod step_size;
pub mod switches;
pub mod time_map;

use crate::engine::base::kinds::Kind;
use crate::engine::base::planned::{Event, First, Horizon, Planned};
use crate::engine::base::{Base, touching};
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::engine::taylor::solution::Solution;

/// (Fastest rate) x (time) that one exact series reaches.
const EXACT_REACH: f64 = 2.0;

/// Plans a step from the base, under the load in `work`; returns of which kind it is.
pub fn plan(
    system: &System,
    base: &mut Base,
    Horizon { remaining, is_cut }: Horizon,
    planned: &mut Planned,
    solution: &mut Solution,
    work: &mut Buffers,
) -> Kind {
    let is_exact = touching(base).next().is_none();
    let reach = match is_exact {
        true => system.expand_exactly(base, solution, work, remaining.min(EXACT_REACH / system.fastest)),
        false => system.expand_accurately(base, solution, work, remaining),
    };
    let series = &solution.series;
    let is_whole = series.x_at(remaining) <= reach;
    let end = if is_whole { series.x_at(remaining) } else { reach };
    // The scale of contact does not change while none is closed.
    let next_length = (!is_exact).then(|| series.time(reach));
    let event = system.first_event(base, solution, work, end);
    solution.series.evaluate(&solution.end, &mut planned.q, &mut planned.v);
    let reaches_limit = is_whole && !is_cut && event.is_none();
    let length = if reaches_limit { remaining } else { solution.series.time(solution.end.x) };
    planned.plan(length, event, reaches_limit, next_length);
    system.track(base, &solution.series, &solution.end, &mut planned.tracked);
    for (reaction, &p) in solution.reactions.iter().zip(&system.rigid.pairs) {
        if base.contacts[p].is_held() {
            base.contacts[p].reaction = reaction[0];
        }
    }
    match solution.series.time_map.is_curved() {
        _ if is_exact => Kind::Exact,
        true => Kind::Mapped,
        false => Kind::Series,
    }
}

impl System {
    /// Expands the motion and the forces of contacts; returns how far the series are accurate, in x.
    fn expand_accurately(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, remaining: f64) -> f64 {
        let is_singular = touching(base).any(|(_, contact)| contact.is_singular());
        self.expand(base, solution, work, self.series_scale(base, remaining));
        self.reach(base, solution, work, (is_singular, remaining))
    }

    /// How far the series are accurate, in x: with more powers where these are cheap, and in the x of a time map where
    /// it takes them further.
    fn reach(
        &self,
        base: &Base,
        solution: &mut Solution,
        work: &mut Buffers,
        (is_singular, remaining): (bool, f64),
    ) -> f64 {
        let whole = remaining / solution.series.scale;
        let mut reach = self.accurate_reach(base, solution, is_singular, whole);
        if reach < whole && self.expand_further(base, solution, work, reach) {
            reach = self.accurate_reach(base, solution, is_singular, whole);
        }
        if !cfg!(without = "time_map") && reach < whole && !self.has_close_rigid_pair(base) && !is_singular {
            reach = self.reach_by_map(base, solution, work, (reach, remaining));
        }
        reach
    }

    /// The first event up to x = `end`; sets the end of the step in the solution, which is there or at the event.
    fn first_event(&self, base: &Base, solution: &mut Solution, work: &mut Buffers, end: f64) -> Option<Event> {
        solution.end_at(end);
        let mut first = First::up_to(end);
        // Only the last two need the motion; they are searched for only up to the first departure.
        for look_for in [System::first_leaving, System::first_turning, System::first_reached] {
            look_for(self, base, solution, work, &mut first);
            if first.until < solution.end.x {
                solution.end_at(first.until);
            }
        }
        first.event
    }
}
