//! Peaks over a step in contact: only what both ends, the length and the largest contact forces cannot rule out is
//! searched.

use crate::engine::base::contact::Contact;
use crate::engine::base::peaks::Peaks;
use crate::engine::base::{Base, Coordinates};
use crate::engine::excitation::inputs::Inputs;
use crate::engine::model::Model;
use crate::engine::pairs::row::FloorShare;
use crate::engine::peaks::quantity::{Quantity, highest};
use crate::engine::peaks::reading::{ContactStep, highest_in_onset};
use crate::engine::peaks::room::{FloorRoom, PeakRoom, PeakWork};
use crate::engine::quantities::rows::PeakOf;
use crate::engine::step::{Dense, Step};
use crate::engine::taylor::solution::Solution;
use crate::numerics::polynomial::{larger, value_and_slope};
use crate::numerics::powers::Powers;
use crate::structure::{LANES, MotionSeries, Side};
use std::ops::Range;

/// Largest error of a quantity's series at the end of a step, relative to its peak, with which the series is searched.
/// The step length controls velocities only: in an extremely short step an acceleration may be off by any amount, and
/// its values at both ends suffice. In any other it tells at least the time of a peak.
const TRUSTED: f64 = 1e-6;

/// The same with which the series tells the value too.
const EXACT: f64 = 1e-11;

impl Model {
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
            &self.system,
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
            work.peaks.last_forces[p] = step.contact_at(&self.system, base, p, elapsed, &powers).present_force();
        }
        step.bound_forces(&self.system, &base.contacts, (elapsed, &powers), &mut work.peaks.strongest);
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
        for side in Side::BOTH {
            let FloorRoom { start, .. } = &work.peaks.floors;
            for (floor, lane) in self.system.structure.floors.lanes_of(side as usize).enumerate() {
                let below = self.system.structure.floors.below(side, floor, &start.u);
                let now = [
                    (PeakOf::Displacement(side, floor), start.u[lane]),
                    (PeakOf::Drift(side, floor), start.u[lane] - below),
                    (PeakOf::Acceleration(side, floor), start.resisted[lane] + work.peaks.first_push[lane]),
                ];
                // Accelerations depend on the floor forces, which may have just been set.
                let known = if self.system.floor_forces { &now[..2] } else { &now };
                known.iter().for_each(|&(of, value)| peaks.raise(self.peak_rows.place(of), value));
            }
            peaks.raise(self.peak_rows.place(PeakOf::BaseShear(side)), start.shear[side as usize]);
        }
        self.raise_to_links(base, peaks, work);
    }

    fn check_contact_step(&self, part: &ContactStep, peaks: &mut Peaks, work: &mut PeakWork) {
        work.peaks.readings.restart();
        self.find_ends(part, work);
        self.find_pushes(part.base, work);
        // The bounds of `floors.rs` cost less than those of a series, and often suffice.
        for b in 0..self.system.structure.bodies.len() {
            self.bound_body(b, part, work);
        }
        let is_open = Side::BOTH.map(|side| self.may_exceed(side, part, peaks, work));
        let are_links_open = self.links_may_exceed(part, peaks, work);
        if is_open == [false; 2] && !are_links_open {
            return;
        }
        let has_series = self.bound_by_series(part, work);
        for side in Side::BOTH.into_iter().filter(|side| is_open[*side as usize]) {
            if has_series {
                self.bound_building_by_series(side, part, work);
                self.may_exceed(side, part, peaks, work);
            }
            self.check_building(side, part, peaks, work);
        }
        if are_links_open {
            if has_series {
                Side::BOTH.into_iter().for_each(|side| self.bound_building_by_series(side, part, work));
            }
            self.check_links(part, peaks, work);
        }
    }

    /// Whether a peak of a building may be exceeded over the step, by the bounds on its floors; works out by how much those of
    /// each floor.
    fn may_exceed(&self, side: Side, part: &ContactStep, peaks: &Peaks, work: &mut PeakWork) -> bool {
        let lanes = self.system.structure.floors.lanes_of(side as usize);
        let places = [PeakOf::Displacement(side, 0), PeakOf::Drift(side, 0), PeakOf::Acceleration(side, 0)];
        let known = places.map(|of| &peaks.values[self.peak_rows.place(of)..][..lanes.len()]);
        find_excess(&mut work.peaks.floors, lanes.clone(), part.length, [known[0], known[2]]);
        match self.system.structure.floors.places(side).are_of_floors() {
            true => find_excess_of_drifts(&mut work.peaks.floors, lanes.clone(), part.length, known[1]),
            false => self.find_excess_on_soil(side, part.length, known[1], &mut work.peaks.floors),
        }
        let shear = self.bound_shear(side, part.length, &work.peaks.floors).1;
        // Written so that a NaN is never below anything.
        let are_below = work.peaks.floors.excess[lanes].iter().all(|excess| *excess <= 0.0);
        !(are_below && shear <= peaks.values[self.peak_rows.place(PeakOf::BaseShear(side))])
    }

    /// Raises the excess of each floor to that of the storey below it over its peak of drift, for a building on soil.
    fn find_excess_on_soil(&self, side: Side, h: f64, drift: &[f64], room: &mut FloorRoom) {
        let floors = &self.system.structure.floors;
        let FloorRoom { start, end, largest, excess, .. } = room;
        for (storey, lane) in floors.lanes_of(side as usize).enumerate() {
            let at = |u: &[f64]| (u[lane] - floors.below(side, storey, u)).abs();
            let fastest = largest[lane] + floors.bound_below(side, storey, largest);
            let moved = larger(at(&start.u), at(&end.u)) + 0.125 * h * h * fastest - drift[storey];
            excess[lane] = if moved <= excess[lane] { excess[lane] } else { moved };
        }
    }

    /// The base shears at both ends of a step, and a bound on their magnitudes in between, N.
    fn bound_shear(
        &self,
        side: Side,
        length: f64,
        FloorRoom { start, end, largest, .. }: &FloorRoom,
    ) -> ([f64; 2], f64) {
        let shears = [start, end].map(|at| at.shear[side as usize]);
        (shears, larger(shears[0].abs(), shears[1].abs()) + self.shear_strays(side, length, largest))
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
        let room = &mut work.peaks;
        for vector in [&mut room.first_push, &mut room.last_push, &mut room.floors.least, &mut room.floors.most] {
            vector.fill(0.0);
        }
        for (p, pair) in self.system.pairs.iter().enumerate().filter(|(p, _)| base.contacts[*p].in_contact()) {
            // A truncated series of a force may lie below the law's force at an end.
            let ends = larger(room.first_forces[p].abs(), room.last_forces[p].abs());
            let (strongest, pulls) = (larger(room.strongest[p], ends), pair.law.kind.info().pulls);
            let pulled = if pulls { strongest } else { 0.0 };
            for FloorShare { lane, push, .. } in pair.row.floors {
                // Pushed to the left, which a pull does to the right; or the other way round.
                let (by_push, by_pull) = (push * strongest, -push * pulled);
                let [least, most] = if push < 0.0 { [by_push, by_pull] } else { [by_pull, by_push] };
                room.floors.least[lane] += least;
                room.floors.most[lane] += most;
                room.first_push[lane] += push * room.first_forces[p];
                room.last_push[lane] += push * room.last_forces[p];
            }
        }
    }

    /// Bounds by the series of a step: a floor's absolute acceleration a deviates from the chord of its values at both ends
    /// by at most h^2/8 max|u''''| in time, and by x^2/8 max|d^2a/dx^2| in the x of a time map. Writes these deviations,
    /// m/s2, and takes the forces at both ends for the least and largest ones, since the chord has them; returns whether
    /// the step has such a series.
    ///
    /// However long the step, and however quick the building's highest modes: the bounds of `floors.rs` need a short step.
    fn bound_by_series(&self, part: &ContactStep, work: &mut PeakWork) -> bool {
        let Dense::Taylor(solution) = part.step.dense() else { return false };
        let PeakRoom { floors: FloorRoom { strays, modal, least, most, .. }, first_push, last_push, .. } =
            &mut *work.peaks;
        let is_on_modes = part.base.coordinates == Coordinates::Modes;
        let bounds = if is_on_modes { &mut *modal } else { &mut *strays };
        let of_ground = match solution.series.time_map.is_curved() {
            false => {
                solution.series.bound_fourths(&solution.end, bounds);
                let sag = 0.125 * part.length * part.length;
                bounds.iter_mut().for_each(|stray| *stray *= sag);
                0.0
            }
            true => bound_in_time_map(solution, part, &mut work.buffers.series, bounds),
        };
        if is_on_modes {
            self.system.structure.bound_floors(modal, strays);
        }
        strays.iter_mut().for_each(|stray| *stray += of_ground);
        for (lane, (first, last)) in first_push.iter().zip(&*last_push).enumerate() {
            (least[lane], most[lane]) = (-larger(-first, -last), larger(*first, *last));
        }
        true
    }

    /// Works out upper bounds on the accelerations of a body's floors.
    fn bound_body(&self, b: usize, part: &ContactStep, work: &mut PeakWork) {
        let (ground, slope) = part.ground();
        let ground = larger(ground.abs(), (ground + slope * part.length).abs());
        let room = &mut work.peaks.floors;
        for lane in self.system.structure.bodies[b].lanes.clone() {
            let resisted = larger(room.start.resisted[lane].abs(), room.end.resisted[lane].abs());
            room.largest[lane] = resisted + larger(room.most[lane], -room.least[lane]) + ground;
        }
        self.find_strays(b, part.length, room);
    }

    /// Works out upper bounds on the floors' accelerations from those at both ends and the deviations in between.
    fn bound_building_by_series(&self, side: Side, part: &ContactStep, work: &mut PeakWork) {
        let (ground, slope) = part.ground();
        let ground = larger(ground.abs(), (ground + slope * part.length).abs());
        let PeakRoom { floors, first_push, last_push, .. } = &mut *work.peaks;
        let FloorRoom { start, end, largest, strays, .. } = floors;
        for lane in self.system.structure.floors.lanes_with_foundation(side as usize) {
            let ends = [start.resisted[lane] + first_push[lane], end.resisted[lane] + last_push[lane]];
            largest[lane] = larger(ends[0].abs(), ends[1].abs()) + strays[lane] + ground;
        }
    }

    /// Raises the peaks of a building over the step, of which it is known by how much each floor's may be exceeded.
    fn check_building(&self, side: Side, part: &ContactStep, peaks: &mut Peaks, work: &mut PeakWork) {
        for (floor, lane) in self.system.structure.floors.lanes_of(side as usize).enumerate() {
            // Written so that a NaN is never below anything.
            let is_below = work.peaks.floors.excess[lane] <= 0.0;
            if !is_below {
                self.check_floor(side, (floor, lane), part, peaks, work);
            }
        }
        let (shears, bound) = self.bound_shear(side, part.length, &work.peaks.floors);
        self.check_one(PeakOf::BaseShear(side), shears, (bound, false), part, peaks, work);
    }

    /// Raises the peaks of a floor and of the storey below it.
    fn check_floor(
        &self,
        side: Side,
        (floor, lane): (usize, usize),
        part: &ContactStep,
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        let sag = 0.125 * part.length * part.length;
        let FloorRoom { start, end, least, most, largest, strays, .. } = &work.peaks.floors;
        let floors = &self.system.structure.floors;
        let at = |of: &[f64]| floors.below(side, floor, of);
        let (fastest, slower) = (largest[lane], floors.bound_below(side, floor, largest));
        let speed = start.v[lane] + end.v[lane];
        let drifting = speed - (at(&start.v) + at(&end.v));
        let moved = [start.u[lane], end.u[lane]];
        let drift = [moved[0] - at(&start.u), moved[1] - at(&end.u)];
        let resisted = [start.resisted[lane], end.resisted[lane]];
        let pushed = [resisted[0] + work.peaks.first_push[lane], resisted[1] + work.peaks.last_push[lane]];
        let top = larger(resisted[0], resisted[1]) + most[lane] + strays[lane];
        let bottom = larger(-resisted[0], -resisted[1]) - least[lane] + strays[lane];
        let acceleration = larger(top, bottom);
        // A monotonic quantity is largest at an end; it is monotonic if its rate is larger than the acceleration could
        // reverse.
        let goes_on = |rates: f64, fastest: f64| rates.abs() > part.length * fastest;
        let moving = [
            (PeakOf::Displacement(side, floor), moved, sag * fastest, goes_on(speed, fastest)),
            (PeakOf::Drift(side, floor), drift, sag * (fastest + slower), goes_on(drifting, fastest + slower)),
        ];
        for (of, ends, sag, goes_on) in moving {
            let bound = larger(ends[0].abs(), ends[1].abs()) + if goes_on { 0.0 } else { sag };
            self.check_one(of, ends, (bound, goes_on), part, peaks, work);
        }
        self.check_one(PeakOf::Acceleration(side, floor), pushed, (acceleration, false), part, peaks, work);
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
        let place = self.peak_rows.place(of);
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
        let span = self.span_of(self.peak_rows.body_of(self.peak_rows.place(of) / LANES), part.base.coordinates);
        let step = part.step;
        let at_rest = part.base.rest.watched[self.peak_rows.place(of)] + self.soften_row(of, part.base, &mut rows);
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

/// The deviations from the chord in the x of the step's time map, without that of the ground's acceleration, which it
/// returns; `accelerations` is scratch.
fn bound_in_time_map(
    Solution { series, substitution, .. }: &Solution,
    part: &ContactStep,
    accelerations: &mut MotionSeries,
    strays: &mut [f64],
) -> f64 {
    let x = series.x_at(part.length);
    accelerations.set_accelerations(series, substitution);
    accelerations.bound_seconds(x, strays);
    // The ground's acceleration is linear in time, which is quadratic in x.
    let of_ground = 2.0 * (series.time_map.curvature * series.scale * part.ground().1).abs();
    let sag = 0.125 * x * x;
    strays.iter_mut().for_each(|stray| *stray *= sag);
    sag * of_ground
}

/// Bounds on the excess of the floors of a building over their peaks of displacement and acceleration, whichever is largest, in a step of h seconds: the bounds of [`Model::check_floor`] for all floors.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn find_excess(room: &mut FloorRoom, lanes: Range<usize>, h: f64, [displacement, acceleration]: [&[f64]; 2]) {
    let FloorRoom { start, end, least, most, largest, strays, excess, .. } = room;
    let (sag, count) = (0.125 * h * h, lanes.len());
    // Equal lengths: no bounds checks below.
    let (from, to) = (lanes.start, lanes.end);
    let (u0, u1) = (&start.u[from..to][..count], &end.u[from..to][..count]);
    let (r0, r1) = (&start.resisted[from..to][..count], &end.resisted[from..to][..count]);
    let (least, most) = (&least[from..to][..count], &most[from..to][..count]);
    let (largest, strays) = (&largest[from..to][..count], &strays[from..to][..count]);
    let (displacement, acceleration) = (&displacement[..count], &acceleration[..count]);
    let excess = &mut excess[lanes][..count];
    for i in 0..count {
        let moved = larger(u0[i].abs(), u1[i].abs()) + sag * largest[i] - displacement[i];
        let top = larger(r0[i], r1[i]) + most[i];
        let bottom = larger(-r0[i], -r1[i]) - least[i];
        let pushed = larger(top, bottom) + strays[i] - acceleration[i];
        excess[i] = if pushed <= moved { moved } else { pushed };
    }
}

/// The same for the peaks of drift, added to what is known of the others.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn find_excess_of_drifts(room: &mut FloorRoom, lanes: Range<usize>, h: f64, drift: &[f64]) {
    let FloorRoom { start, end, largest, excess, .. } = room;
    let (sag, count) = (0.125 * h * h, lanes.len());
    // Equal lengths: no bounds checks below.
    let (from, to) = (lanes.start, lanes.end);
    let (u0, u1) = (&start.u[from..to][..count], &end.u[from..to][..count]);
    let (largest, drift, excess) = (&largest[from..to][..count], &drift[..count], &mut excess[lanes][..count]);
    for i in 0..count {
        let (below, slower) = if i == 0 { ((0.0, 0.0), 0.0) } else { ((u0[i - 1], u1[i - 1]), largest[i - 1]) };
        let moved = larger((u0[i] - below.0).abs(), (u1[i] - below.1).abs()) + sag * (largest[i] + slower) - drift[i];
        excess[i] = if moved <= excess[i] { excess[i] } else { moved };
    }
}
