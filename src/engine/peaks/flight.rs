//! Peaks over a flight, by the motion at both of its ends.
//!
//! A quantity y = A q + B q' differs from the cubic through its values and slopes at both ends by at most h^4/384
//! max|y''''| [BirkhoffPriver1967]. The load is linear in time, so q'' is a free oscillation, whose E = sqrt(q'''^2 +
//! w^2 q''^2) never grows, and |y''''| <= sum over modes of (|A| (w + c) + |B| (c (w + c) + w^2)) E. If the cubic's
//! control values plus this bound are below the peak, the peak stays; if the slope keeps its sign, the larger end is
//! the maximum.

use crate::engine::base::Base;
use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::cubic::course_of;
use crate::engine::bounds::envelope::stay_below;
use crate::engine::bounds::stretch::Stretch;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::room::{LEAVES, MOST_PIECES, PeakWork, Suspect};
use crate::engine::quantities::rows::BodyRows;
use crate::numerics::polynomial::larger;
use crate::structure::{LANES, Lane, Motion};

impl PeakFinder<'_> {
    /// Raises the peaks over a flight.
    pub(in crate::engine) fn check_blocks(&self, flight: &Stretch, peaks: &mut Peaks, work: &mut PeakWork) {
        work.peaks.start_flight();
        for body in &self.watched.in_flight().bodies {
            work.peaks.bounds.set(self.system.structure.in_flight(), body.modes.clone(), flight);
            for b in 0..body.blocks.len() {
                self.check_block(body, b, (flight, None), peaks, work);
            }
        }
        self.search_flight(flight, peaks, work);
    }

    /// Raises peaks to the motion of the base, without contact forces. An input that has just been set
    /// does not count yet: it acts in the next step.
    pub(in crate::engine) fn raise_to_motion(&self, base: &Base, peaks: &mut Peaks) {
        let rows = if base.oscillates { self.watched.in_flight() } else { &self.watched.rows };
        for body in &rows.bodies {
            let [q, v] = [&base.q, &base.v].map(|vector| &vector[body.modes.clone()]);
            for b in 0..body.blocks.len() {
                for (i, value) in self.values_at((body, b), &base.rest.watched, Motion { q, v }).into_iter().enumerate()
                {
                    let place = (body.first + b) * LANES + i;
                    if !(self.system.is_pushed && self.watched.is_pushed(place)) {
                        peaks.raise(place, value);
                    }
                }
            }
        }
    }

    /// Writes what a master's pushes add at once to all quantities at the base, and the rates of that.
    pub(in crate::engine) fn note_pushes(&self, base: &Base, inputs: &Inputs, direct: &mut [[f64; 2]]) {
        for (block, direct) in direct.chunks_exact_mut(LANES).enumerate() {
            let [values, rates] = self.pushes_at(block, (base, 0.0), inputs);
            (0..LANES).for_each(|i| direct[i] = [values[i], rates[i]]);
        }
    }

    /// The same of a block of quantities, some seconds after the base.
    pub(super) fn pushes_at(&self, block: usize, (base, time): (&Base, f64), inputs: &Inputs) -> [Lane; 2] {
        let Some(pushed) = self.watched.pushed(block) else { return [[0.0; LANES]; 2] };
        let (start, elapsed) = (base.segment.start, base.elapsed + time);
        [
            pushed.add_up(|number| inputs.push(number).after(start, elapsed)),
            pushed.add_up(|number| inputs.push(number).slope()),
        ]
    }

    /// Raises the peaks of block `b` to both ends of a flight, with the bounds on its modes, and notes the quantities
    /// that have to be searched for; `known_ends` are the values at both ends, if they are known.
    pub(in crate::engine) fn check_block(
        &self,
        body: &BodyRows,
        b: usize,
        (flight, known_ends): (&Stretch, Option<[Lane; 2]>),
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        let (block, modes, h) = (&body.blocks[b], body.modes.clone(), flight.length);
        let bounds = &work.peaks.bounds;
        let place = (body.first + b) * LANES;
        let direct = &work.peaks.direct[place..];
        let known = *peaks.block(body.first + b);
        let added = self.system.is_pushed.then_some((direct, 0.0, h));
        let at_rest = flight.rest.as_chunks::<LANES>().0[body.first + b];
        if !flight.is_suspect && stay_below(&known, (block, &at_rest), (bounds, &modes), added) == [true; LANES] {
            return;
        }
        let mut course = course_of((block, &at_rest), (flight, known_ends), bounds, modes);
        if self.system.is_pushed {
            course.add_rates(&work.peaks.direct[place..]);
            if known_ends.is_none() {
                course.add_values(&work.peaks.direct[place..], h);
            }
        }
        let highest = course.highest(h);
        for i in 0..LANES {
            if highest[i] <= known[i] {
                continue;
            }
            peaks.raise(place + i, larger(course.start[0][i].abs(), course.end[0][i].abs()));
            let peak = peaks.values[place + i];
            if course.may_turn_above(i, h, peak)
                && let Some(of) = self.watched.rows.at(place + i)
            {
                work.peaks.suspects.push(Suspect {
                    of,
                    place: place + i,
                    peak,
                    values: [0.0; LEAVES + 1],
                    leaves: 0,
                    bend: f64::INFINITY,
                    pieces_left: MOST_PIECES,
                    cleared_in: None,
                });
            }
        }
    }
}
