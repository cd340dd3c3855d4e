//! Peaks over a step in contact: only what both ends, the length and the largest contact forces cannot rule out is
//! searched.

use crate::engine::base::contact::Contact;
use crate::engine::base::peaks::Peaks;
use crate::engine::base::{Base, Coordinates};
use crate::engine::excitation::inputs::Inputs;
use crate::engine::pairs::row::FloorShare;
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::quantity::{Quantity, highest};
use crate::engine::peaks::reading::{ContactStep, highest_in_onset};
use crate::engine::peaks::room::{FloorRoom, PeakRoom, PeakWork};
use crate::engine::quantities::rows::PeakOf;
use crate::engine::step::{Dense, Step};
use crate::engine::taylor::solution::Solution;
use crate::numerics::polynomial::{larger, value_and_slope};
use crate::numerics::powers::Powers;
use crate::structure::{LANES, Side};

/// Largest error of a quantity's series at the end of a step, relative to its peak, with which the series is searched.
/// The step length controls velocities only: in an extremely short step an acceleration may be off by any amount, and
/// its values at both ends suffice. In any other it tells at least the time of a peak.
const TRUSTED: f64 = 1e-6;

/// The same with which the series tells the value too.
const EXACT: f64 = 1e-11;

impl PeakFinder<'_> {
    /// Notes forces, penetrations and rates of the contacts at the start of a step.
    pub(in crate::engine) fn note_starts(&self, contacts: &[Contact], work: &mut PeakWork) {
        let starts = work.peaks.first_forces.iter_mut().zip(&mut work.peaks.starts);
        for ((force, start), contact) in starts.zip(contacts) {
            *force = contact.present_force();
            *start = (contact.penetration, contact.rate);
        }
    }

    /// Raises the peaks of the base over the planned step, after the contacts have been moved to its end.
    pub(in crate::engine) fn raise_over_step(
        &self,
        base: &mut Base,
        step: &Step,
        inputs: &Inputs,
        end: f64,
        work: &mut PeakWork,
    ) {
        let mut peaks = std::mem::take(&mut base.peaks);
        for (force, contact) in work.peaks.last_forces.iter_mut().zip(&base.contacts) {
            *force = contact.present_force();
        }
        step.bound_forces(
            self.system,
            &base.contacts,
            (step.planned.length, step.end_powers()),
            &mut work.peaks.strongest,
        );
        let part =
            ContactStep { base, step, inputs, length: step.planned.length, end: (&step.planned.q, &step.planned.v) };
        self.check_contact_step(&part, &mut peaks, work);
        // Only where nothing changes the motion between two steps, not even the last bit of its sums: rigid pairs, floor forces
        // and another position of rest may.
        if self.system.rigid.pairs.is_empty() && !self.system.floor_forces && !base.is_yielding() {
            work.peaks.floors.keep([base.segment.start, end]);
        }
        base.peaks = peaks;
    }

    /// Raises peaks over the first part of the planned step, up to a motion `elapsed` seconds after the base.
    pub(in crate::engine) fn raise_over_part(
        &self,
        (base, step, inputs): (&Base, &Step, &Inputs),
        (elapsed, end): (f64, (&[f64], &[f64])),
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        let mut powers = Powers::default();
        step.set_powers(elapsed, &mut powers);
        self.note_starts(&base.contacts, work);
        for p in 0..self.system.pairs.len() {
            work.peaks.last_forces[p] = step.contact_at(self.system, base, p, elapsed, &powers).present_force();
        }
        step.bound_forces(self.system, &base.contacts, (elapsed, &powers), &mut work.peaks.strongest);
        work.peaks.floors.forget();
        let part = ContactStep { base, step, inputs, length: elapsed, end };
        self.check_contact_step(&part, peaks, work);
        work.peaks.floors.forget();
    }

    /// Raises peaks to the motion of the base with its contact forces. An input that has just been set does not count
    /// yet: it acts in the next step.
    pub(in crate::engine) fn raise_to_contact(&self, base: &Base, peaks: &mut Peaks, work: &mut PeakWork) {
        self.note_starts(&base.contacts, work);
        work.peaks.strongest.fill(0.0);
        work.peaks.last_forces.copy_from_slice(&work.peaks.first_forces);
        self.find_pushes(base, work);
        let room = &mut work.peaks.floors;
        let mut modal = std::mem::take(&mut room.modal);
        self.find_floors(base.coordinates, (&base.rest, (&base.q, &base.v)), &mut room.start, &mut modal);
        room.modal = modal;
        let FloorRoom { start, pushes: [pushed, _], .. } = &work.peaks.floors;
        for side in Side::BOTH {
            for (floor, lane) in self.system.structure.floors.lanes_of(side as usize).enumerate() {
                let now = [
                    (PeakOf::Displacement(side, floor), start.u[lane]),
                    (PeakOf::Drift(side, floor), start.drift[lane]),
                    (PeakOf::Acceleration(side, floor), start.resisted[lane] + pushed[lane]),
                ];
                // Accelerations depend on the floor forces, which may have just been set.
                let known = if self.system.floor_forces { &now[..2] } else { &now };
                known.iter().for_each(|&(of, value)| peaks.raise(self.watched.rows.place(of), value));
            }
            peaks.raise(self.watched.rows.place(PeakOf::BaseShear(side)), start.shear[side as usize]);
        }
        self.raise_to_links(base, peaks, work);
    }

    fn check_contact_step(&self, part: &ContactStep, peaks: &mut Peaks, work: &mut PeakWork) {
        work.peaks.readings.restart();
        self.find_ends(part, work);
        self.find_pushes(part.base, work);
        // The bounds of `floors.rs` cost less than those of a series, and often suffice.
        for b in 0..self.system.structure.bodies.len() {
            self.bound_body(b, part, &mut work.peaks.floors);
        }
        let is_open =
            Side::BOTH.map(|side| self.find_excess(side, (part.length, false), peaks, &mut work.peaks.floors));
        let are_links_open = self.links_may_exceed(part, peaks, work);
        if is_open == [false; 2] && !are_links_open {
            return;
        }
        let has_series = self.bound_by_series(part, work);
        let room = &mut work.peaks.floors;
        for side in Side::BOTH.into_iter().filter(|side| has_series && (are_links_open || is_open[*side as usize])) {
            self.bound_building_by_series(side, part, room);
        }
        for side in Side::BOTH.into_iter().filter(|side| is_open[*side as usize]) {
            if has_series {
                self.find_excess(side, (part.length, true), peaks, &mut work.peaks.floors);
            }
            self.search_building(side, part, peaks, work);
        }
        if are_links_open {
            self.check_links(part, peaks, work);
        }
    }

    /// Works out the floors at both ends.
    fn find_ends(&self, part: &ContactStep, work: &mut PeakWork) {
        let ContactStep { base, length, end, .. } = *part;
        let room = &mut work.peaks.floors;
        let mut modal = std::mem::take(&mut room.modal);
        if !room.go_on([base.segment.start, base.elapsed]) {
            self.find_floors(base.coordinates, (&base.rest, (&base.q, &base.v)), &mut room.start, &mut modal);
        }
        self.find_floors(base.coordinates, (&base.rest, end), &mut room.end, &mut modal);
        self.soften(base, end.0, &mut room.end);
        room.modal = modal;
        if self.system.floor_forces {
            self.add_forces((base, part.inputs), 0.0, &mut room.start.resisted);
            self.add_forces((base, part.inputs), length, &mut room.end.resisted);
        }
    }

    /// Adds the accelerations by floor forces, some seconds after the base.
    pub(in crate::engine) fn add_forces(&self, (base, inputs): (&Base, &Inputs), time: f64, resisted: &mut [f64]) {
        let at = base.elapsed + time;
        self.system.add_floor_forces(
            inputs,
            Coordinates::Floors,
            |force| force.after(base.segment.start, at),
            resisted,
        );
    }

    /// Works out the floors' accelerations by contact forces, m/s2: at both ends, and their least and largest values.
    fn find_pushes(&self, base: &Base, work: &mut PeakWork) {
        let PeakRoom { floors, first_forces, last_forces, strongest, .. } = &mut *work.peaks;
        let FloorRoom { pushes: [first, last], least, most, .. } = floors;
        [&mut *first, last, least, most].into_iter().for_each(|vector| vector.fill(0.0));
        for (p, pair) in self.system.pairs.iter().enumerate().filter(|(p, _)| base.contacts[*p].in_contact()) {
            // A truncated series of a force may lie below the law's force at an end.
            let ends = larger(first_forces[p].abs(), last_forces[p].abs());
            let (strongest, pulls) = (larger(strongest[p], ends), pair.law.kind.info().pulls);
            let pulled = if pulls { strongest } else { 0.0 };
            for FloorShare { lane, push, .. } in pair.row.floors {
                // Pushed to the left, which a pull does to the right; or the other way round.
                let (by_push, by_pull) = (push * strongest, -push * pulled);
                let of_force = if push < 0.0 { [by_push, by_pull] } else { [by_pull, by_push] };
                least[lane] += of_force[0];
                most[lane] += of_force[1];
                first[lane] += push * first_forces[p];
                last[lane] += push * last_forces[p];
            }
        }
    }

    /// Raises the peaks of a building within the step, of which it is known by how much each floor's may be exceeded.
    fn search_building(&self, side: Side, part: &ContactStep, peaks: &mut Peaks, work: &mut PeakWork) {
        let kinds = [PeakOf::Displacement, PeakOf::Drift, PeakOf::Acceleration];
        for (kind, of) in kinds.into_iter().enumerate() {
            for (floor, lane) in self.system.structure.floors.lanes_of(side as usize).enumerate() {
                // Written so that a NaN is never below anything.
                if work.peaks.floors.excess[kind][lane] <= 0.0 {
                    continue;
                }
                let FloorRoom { end, pushes: [_, pushed], .. } = &work.peaks.floors;
                let at_end = [end.u[lane], end.drift[lane], end.resisted[lane] + pushed[lane]][kind];
                let place = self.watched.rows.place(of(side, floor));
                let peak = self.highest_in_contact(of(side, floor), (peaks.values[place], at_end), part, work);
                peaks.raise(place, peak);
            }
        }
        let (shears, bound) = self.bound_shear(side, part.length, &work.peaks.floors);
        self.check_one(PeakOf::BaseShear(side), shears, (bound, false), part, peaks, work);
    }

    /// Raises one peak from the values at both ends, a bound on it, and whether the quantity is monotonic.
    #[inline(always)]
    pub(in crate::engine) fn check_one(
        &self,
        of: PeakOf,
        ends: [f64; 2],
        (bound, goes_on): (f64, bool),
        part: &ContactStep,
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        let place = self.watched.rows.place(of);
        // Written so that a NaN is never below anything.
        let is_below = bound <= peaks.values[place];
        if !is_below {
            ends.into_iter().for_each(|end| peaks.raise(place, end));
            if !goes_on {
                let peak = self.highest_in_contact(of, (peaks.values[place], ends[1]), part, work);
                peaks.raise(place, peak);
            }
        }
    }

    /// The largest magnitude of a quantity within a part of a step, or `known` if that is larger; `at_end` is its value
    /// at the end of the part. Turning points are searched for in the whole step, so that each has the same bits
    /// whatever part is asked for.
    #[inline(never)]
    fn highest_in_contact(
        &self,
        of: PeakOf,
        (known, at_end): (f64, f64),
        part: &ContactStep,
        work: &mut PeakWork,
    ) -> f64 {
        let mut rows = std::mem::take(&mut work.peaks.rows);
        let lanes = self.set_rows(of, part.base.coordinates, &mut rows);
        let span = self.span_of(self.watched.rows.body_of(self.watched.rows.place(of) / LANES), part.base.coordinates);
        let step = part.step;
        let at_rest = part.base.rest.watched[self.watched.rows.place(of)] + self.soften_row(of, part.base, &mut rows);
        let quantity = Quantity { of, rows: &rows, lanes, span, at_rest, ground: part.ground(), oscillates: false };
        let peak = match step.dense() {
            Dense::Flight => known,
            Dense::Onset(onset) => highest_in_onset(&quantity, known, onset, part),
            Dense::Window(window, series) => self.highest_in_window(&quantity, known, (window, series), part, work),
            Dense::Taylor(Solution { series, substitution, end, .. }) => {
                let (terms, order) = quantity.terms(series, Some(substitution));
                let end = if part.length == step.planned.length { end.x } else { series.x_at(part.length) };
                let off = value_and_slope(&terms[..=order], end).0 - at_end;
                let largest = larger(known, at_end.abs());
                match of {
                    _ if off.abs() > TRUSTED * largest => known,
                    PeakOf::Acceleration(..) if off.abs() > EXACT * largest => {
                        self.highest_acceleration(of, (&terms, end, order), known, part, work)
                    }
                    _ => highest(&terms, (end, order), known, &mut work.buffers.powers),
                }
            }
        };
        work.peaks.rows = rows;
        peak
    }
}
