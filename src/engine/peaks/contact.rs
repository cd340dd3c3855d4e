//! Peaks over a step in contact: only what both ends, the length and the largest contact forces cannot rule out is
//! searched.

use crate::engine::base::contact::Contact;
use crate::engine::base::peaks::Peaks;
use crate::engine::base::{Base, Coordinates};
use crate::engine::excitation::inputs::{Inputs, LinearInput};
use crate::engine::pairs::row::FloorShare;
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::quantity::{Quantity, highest_by};
use crate::engine::peaks::reading::ContactStep;
use crate::engine::peaks::room::{FloorRoom, FloorState, OpenQuantity, PeakRoom, PeakWork};
use crate::engine::quantities::rows::PeakOf;
use crate::engine::step::{Dense, Step};
use crate::engine::taylor::solution::Solution;
use crate::numerics::polynomial::{larger, value_and_slope};
use crate::numerics::powers::Powers;
use crate::structure::{BuildingId, LANES, Motion};

/// Largest error of a quantity's series at the end of a step, relative to its peak, with which the series is searched.
/// The step length controls velocities only: in an extremely short step an acceleration may be off by any amount, and
/// its values at both ends suffice. In any other it tells at least the time of a peak.
const TRUSTED: f64 = 1e-6;

/// The same with which the series tells the value too.
const EXACT: f64 = 1e-11;

/// Largest number of quantities that are searched at once: the bounds of a series, which leave fewer, cost as much.
const FEW: u64 = 6;

impl PeakFinder<'_> {
    /// Notes the forces of the contacts at the start of a step.
    pub(in crate::engine) fn note_first_forces(&self, contacts: &[Contact], work: &mut PeakWork) {
        for (force, contact) in work.peaks.first_forces.iter_mut().zip(contacts) {
            *force = contact.present_force();
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
        let part = ContactStep::whole(base, step, inputs);
        self.find_open(&part, &mut peaks, work);
        self.search_noted(&part, &mut peaks, work);
        // Only where nothing changes the motion between two steps, not even the last bit of its sums: rigid pairs, a
        // master's pushes and another position of rest may.
        if self.system.rigid.pairs.is_empty() && !self.system.is_pushed && !base.is_yielding() {
            work.peaks.floors.keep([base.segment.start, end]);
        }
        base.peaks = peaks;
    }

    /// Raises peaks over the first part of the planned step, up to a motion `elapsed` seconds after the base.
    pub(in crate::engine) fn raise_over_part(
        &self,
        (base, step, inputs): (&Base, &Step, &Inputs),
        (elapsed, end): (f64, Motion),
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        let mut powers = Powers::default();
        step.set_powers(elapsed, &mut powers);
        self.note_first_forces(&base.contacts, work);
        for p in 0..self.system.pairs.len() {
            work.peaks.last_forces[p] = step.contact_at(self.system, base, p, elapsed, &powers).present_force();
        }
        step.bound_forces(self.system, &base.contacts, (elapsed, &powers), &mut work.peaks.strongest);
        work.peaks.floors.forget();
        let part = ContactStep { base, step, inputs, length: elapsed, end };
        self.find_open(&part, peaks, work);
        self.search_noted(&part, peaks, work);
        work.peaks.floors.forget();
    }

    /// Raises peaks to the motion of the base with its contact forces. An input that has just been set does not count
    /// yet: it acts in the next step.
    pub(in crate::engine) fn raise_to_contact(&self, base: &Base, peaks: &mut Peaks, work: &mut PeakWork) {
        self.note_first_forces(&base.contacts, work);
        work.peaks.strongest.fill(0.0);
        work.peaks.last_forces.copy_from_slice(&work.peaks.first_forces);
        self.find_pushes(base, work);
        let room = &mut work.peaks.floors;
        let mut modal = std::mem::take(&mut room.modal);
        self.find_floors(base.coordinates, (&base.rest, base.motion()), &mut room.start, &mut modal);
        room.modal = modal;
        let FloorRoom { start, pushes: [pushed, _], .. } = &work.peaks.floors;
        for id in self.system.structure.ids() {
            for (floor, lane) in self.system.structure.floors.lanes_of(id).enumerate() {
                let now = [
                    (PeakOf::Displacement(id, floor), start.u[lane]),
                    (PeakOf::Drift(id, floor), start.drift[lane]),
                    (PeakOf::Acceleration(id, floor), start.resisted[lane] + pushed[lane]),
                ];
                // Accelerations depend on what a master pushes with, which may have just been set.
                let known = if self.system.is_pushed { &now[..2] } else { &now };
                known.iter().for_each(|&(of, value)| peaks.raise(self.watched.rows.place(of), value));
            }
            // So do shears that can be corrected.
            if self.system.corrections.is_empty() {
                peaks.raise(self.watched.rows.place(PeakOf::BaseShear(id)), start.shear[id.index()]);
            }
        }
        self.raise_to_links(base, peaks, work);
    }

    /// Raises peaks to both ends of a part of a step, and notes what may exceed its peak in between.
    fn find_open(&self, part: &ContactStep, peaks: &mut Peaks, work: &mut PeakWork) {
        work.peaks.open.clear();
        self.find_ends(part, work);
        self.find_pushes(part.base, work);
        // The bounds of `floors.rs` cost less than those of a series, and often suffice.
        for b in 0..self.system.structure.bodies.len() {
            self.bound_body(b, part, &mut work.peaks.floors);
        }
        let mut open = std::mem::take(&mut work.peaks.open_buildings);
        open.clear();
        let mut count = 0;
        for id in self.system.structure.ids() {
            let above = self.bound_building(id, (part.length, false), peaks, &mut work.peaks.floors);
            open.extend((above > 0).then_some(id));
            count += above;
        }
        let are_links_open = self.links_may_exceed(part, peaks, work);
        let has_series = (are_links_open || count > FEW) && self.bound_by_series(part, work);
        if !open.is_empty() || are_links_open {
            self.note_open_of((&open, are_links_open), has_series, part, peaks, work);
        }
        work.peaks.open_buildings = open;
    }

    /// Notes what may exceed its peak, of some buildings and of the links: by the bounds of a series where the step has one.
    fn note_open_of(
        &self,
        (open, are_links_open): (&[BuildingId], bool),
        has_series: bool,
        part: &ContactStep,
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        let is_wanted = |id: &BuildingId| has_series && (are_links_open || open.contains(id));
        for id in self.system.structure.ids().filter(is_wanted) {
            self.bound_building_by_series(id, part, &mut work.peaks.floors);
        }
        for &id in open {
            if has_series {
                self.bound_building(id, (part.length, true), peaks, &mut work.peaks.floors);
            }
            self.note_open_floors(id, part.length, peaks, work.peaks);
        }
        if are_links_open {
            self.note_open_links(part, peaks, work);
        }
    }

    /// Works out the floors at both ends.
    fn find_ends(&self, part: &ContactStep, work: &mut PeakWork) {
        let ContactStep { base, length, end, .. } = *part;
        let room = &mut work.peaks.floors;
        let mut modal = std::mem::take(&mut room.modal);
        if !room.go_on([base.segment.start, base.elapsed]) {
            self.find_floors(base.coordinates, (&base.rest, base.motion()), &mut room.start, &mut modal);
        }
        self.find_floors(base.coordinates, (&base.rest, end), &mut room.end, &mut modal);
        self.soften(base, end.q, &mut room.end);
        room.modal = modal;
        if self.system.is_pushed {
            self.add_pushes((base, part.inputs), 0.0, &mut room.start);
            self.add_pushes((base, part.inputs), length, &mut room.end);
        }
    }

    /// Adds what a master pushes with to accelerations and shears, some seconds after the base.
    pub(in crate::engine) fn add_pushes(&self, (base, inputs): (&Base, &Inputs), time: f64, floors: &mut FloorState) {
        let at = |push: &LinearInput| push.after(base.segment.start, base.elapsed + time);
        self.system.add_pushes(inputs, Coordinates::Floors, at, &mut floors.resisted);
        for id in self.system.structure.ids() {
            floors.shear[id.index()] -= self.system.correction_of_base(inputs, id, at);
        }
        for (of, line) in self.system.corrections.iter().zip(&inputs.corrections) {
            floors.storey_shear[self.system.structure.floors.lane(of.building, of.number)] -= at(line);
        }
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
            for FloorShare { lane, push, .. } in pair.row.floors.into_iter().filter(|floor| floor.push != 0.0) {
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

    /// Notes the quantities of a building that may exceed their peaks within a step of `h` seconds.
    fn note_open_floors(
        &self,
        id: BuildingId,
        h: f64,
        peaks: &mut Peaks,
        PeakRoom { floors, open, .. }: &mut PeakRoom,
    ) {
        let lanes = self.system.structure.floors.lanes_of(id);
        let FloorRoom { start, end, pushes, upper, .. } = &*floors;
        let kinds = [PeakOf::Displacement, PeakOf::Drift, PeakOf::Acceleration];
        for (kind, (of, upper)) in kinds.into_iter().zip(upper).enumerate() {
            let first = self.watched.rows.place(of(id, 0));
            let bounds = upper[lanes.clone()].iter().zip(&peaks.values[first..]);
            for (floor, (&upper, &peak)) in bounds.enumerate() {
                if upper <= peak {
                    continue;
                }
                let lane = lanes.start + floor;
                let of_motion = [start, end].map(|at| [at.u[lane], at.drift[lane], at.resisted[lane]][kind]);
                let of_forces = pushes.each_ref().map(|pushed| if kind == 2 { pushed[lane] } else { 0.0 });
                let ends = [of_motion[0] + of_forces[0], of_motion[1] + of_forces[1]];
                // The peaks have been raised to the ends.
                open.push(OpenQuantity { of: of(id, floor), place: first + floor, ends, upper });
            }
        }
        let (ends, upper) = self.bound_shear(id, h, floors);
        self.note_open((PeakOf::BaseShear(id), upper), ends, peaks, open);
        for (bound, ends) in self.bound_storey_shears(id, h, floors) {
            self.note_open(bound, ends, peaks, open);
        }
    }

    /// Raises the peak of a quantity to its values at both ends of a step, and notes it if an upper bound is above that.
    pub(super) fn note_open(
        &self,
        (of, upper): (PeakOf, f64),
        ends: [f64; 2],
        peaks: &mut Peaks,
        open: &mut Vec<OpenQuantity>,
    ) {
        let place = self.watched.rows.place(of);
        let quantity = OpenQuantity { of, place, ends, upper };
        if quantity.may_exceed(peaks) {
            ends.into_iter().for_each(|end| peaks.raise(place, end));
            open.extend(quantity.may_exceed(peaks).then_some(quantity));
        }
    }

    /// Raises the peaks that have been noted over a part of a step.
    fn search_noted(&self, part: &ContactStep, peaks: &mut Peaks, work: &mut PeakWork) {
        let open = std::mem::take(&mut work.peaks.open);
        // Those of the window at hand are worked out when they are first asked for.
        work.buffers.moments.clear();
        for quantity in &open {
            if quantity.may_exceed(peaks) {
                let known = peaks.values[quantity.place];
                peaks.raise(quantity.place, self.highest_in_contact(quantity, known, part, work));
            }
        }
        work.peaks.open = open;
    }

    /// The largest magnitude of a quantity within a part of a step if it exceeds its `known` peak, or a number up to that peak.
    /// Turning points are searched for in the whole step, so that each has the same bits whatever part is asked for.
    #[inline(never)]
    fn highest_in_contact(
        &self,
        &OpenQuantity { of, place, ends: [_, at_end], .. }: &OpenQuantity,
        known: f64,
        part: &ContactStep,
        work: &mut PeakWork,
    ) -> f64 {
        let mut rows = std::mem::take(&mut work.peaks.rows);
        let lanes = self.set_rows(of, part.base.coordinates, &mut rows);
        let span = self.span_of(self.watched.rows.body_of(place / LANES), part.base.coordinates);
        let step = part.step;
        let at_rest = part.base.rest.watched[place] + self.soften_row(of, part.base, &mut rows);
        let [pushed, rates] = self.pushes_at(place / LANES, (part.base, 0.0), part.inputs).map(|of| of[place % LANES]);
        let added = [at_rest + pushed, rates];
        let quantity = Quantity { of, rows: &rows, lanes, span, added, ground: part.base.ground(), oscillates: false };
        let peak = match step.dense() {
            Dense::Flight => known,
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
                    _ => {
                        // The values at both ends are known, without the last digits of the series there.
                        let within = |at, value| if at > 0.0 && at < end { value } else { known };
                        highest_by(&terms, (end, order), known, &mut work.buffers.powers, within)
                    }
                }
            }
            _ => self.highest_by_nodes(&quantity, known, part, work),
        };
        work.peaks.rows = rows;
        peak
    }
}
