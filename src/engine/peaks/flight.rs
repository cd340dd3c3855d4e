//! Peaks over a flight, by the motion at both of its ends.
//!
//! A quantity y = A q + B q' differs from the cubic through its values and slopes at both ends by at most h^4/384
//! max|y''''| [BirkhoffPriver1967]. The load is linear in time, so q'' is a free oscillation, whose E = sqrt(q'''^2 +
//! w^2 q''^2) never grows, and |y''''| <= sum over modes of (|A| (w + c) + |B| (c (w + c) + w^2)) E. If the cubic's
//! control values plus this bound are below the peak, the peak stays; if the slope keeps its sign, the larger end is
//! the maximum.

use crate::engine::base::Base;
use crate::engine::base::peaks::Peaks;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::model::Model;
use crate::engine::peaks::ahead::values_of;
use crate::engine::peaks::room::{MOST_PIECES, ModeBounds, PeakRoom, PeakWork, Suspect};
use crate::engine::watched::rows::{Block, BuildingRows, PeakOf};
use crate::numerics::polynomial::{each, larger};
use crate::numerics::roots;
use crate::structure::{LANES, Lane};
use std::ops::Range;

/// Margin for rounding, relative to the terms of an amplitude.
const MARGIN: f64 = 1e-12;

/// A flight of both buildings, or a part of one.
pub struct Stretch<'a> {
    /// q and v of all modes at the start.
    pub start: (&'a [f64], &'a [f64]),
    /// q and v of all modes at the end.
    pub end: (&'a [f64], &'a [f64]),
    /// The modal load at the start and its rate, per second.
    pub loads: (&'a [f64], &'a [f64]),
    /// The watched quantities at rest, which those of the motion are added to.
    pub rest: &'a [f64],
    /// Ground acceleration at the start, m/s2, and its slope, m/s3.
    pub ground: (f64, f64),
    /// Length, s.
    pub length: f64,
    /// Whether the amplitudes of the modes have been compared with the peaks for some segments at once
    /// ([`super::ahead`]), so that doing so for this one is seldom worth it.
    pub is_watched: bool,
    /// The whole flight, of which this is the first part; `None` if it is whole itself.
    pub whole: Option<&'a Stretch<'a>>,
}

/// The quantities of a block over a flight.
#[derive(Clone, Copy, Default)]
pub struct Course {
    /// Values and slopes at the start.
    pub start: [Lane; 2],
    /// Values and slopes at the end.
    pub end: [Lane; 2],
    /// Bounds on their fourth derivatives.
    fourth: Lane,
}

impl Model {
    /// Raises the peaks over a flight of those blocks, by their numbers, that may exceed theirs.
    pub(in crate::engine) fn check_blocks(
        &self,
        flight: &Stretch,
        may_exceed: impl Fn(usize, &PeakRoom) -> bool,
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        work.peaks.start_flight();
        for building in &self.peak_rows.buildings {
            let mut is_bounded = false;
            for b in 0..building.blocks.len() {
                if !may_exceed(building.first + b, work.peaks) {
                    continue;
                }
                if !std::mem::replace(&mut is_bounded, true) {
                    self.bound_modes(building, flight, &mut work.peaks.bounds, &mut work.buffers.node_v);
                }
                self.check_block(building, b, (flight, None), peaks, work);
            }
        }
        self.search_flight(flight, peaks, work);
    }

    /// Raises peaks to the motion of the base, on modes and without contact forces. An input that has just been set
    /// does not count yet: it acts in the next step.
    pub(in crate::engine) fn raise_to_motion(&self, base: &Base, peaks: &mut Peaks) {
        for building in &self.peak_rows.buildings {
            let [q, v] = [&base.q, &base.v].map(|vector| &vector[building.modes.clone()]);
            for b in 0..building.blocks.len() {
                for (i, value) in self.values_at((building, b), &base.rest.watched, (q, v)).into_iter().enumerate() {
                    let place = (building.first + b) * LANES + i;
                    if !(self.system.floor_forces && matches!(self.peak_rows.at(place), Some(PeakOf::Acceleration(..))))
                    {
                        peaks.raise(place, value);
                    }
                }
            }
        }
    }

    /// Writes the accelerations by floor forces at the base, m/s2, and their rates, m/s3.
    pub(in crate::engine) fn note_floor_forces(&self, base: &Base, inputs: &Inputs, direct: &mut [[f64; 2]]) {
        for (place, direct) in direct.iter_mut().enumerate() {
            if let Some(PeakOf::Acceleration(side, floor)) = self.peak_rows.at(place) {
                let force = &inputs.floor_forces[inputs.place(side, floor)];
                let inverse =
                    self.system.structure.floors.inverse_mass(self.system.structure.floors.lane(side as usize, floor));
                let (start, elapsed) = (base.segment.start, base.elapsed);
                *direct = [force.after(start, elapsed) * inverse, force.slope() * inverse];
            }
        }
    }

    /// Works out bounds on a building's modes over a flight: on their derivatives, and on their oscillations.
    pub(in crate::engine) fn bound_modes(
        &self,
        building: &BuildingRows,
        flight: &Stretch,
        room: &mut ModeBounds,
        jerk: &mut [f64],
    ) {
        let structure = &self.system.structure;
        let (modes, h) = (building.modes.clone(), flight.length);
        let ((q, v), (end_q, end_v), (load, slope)) = (flight.start, flight.end, flight.loads);
        for m in modes.clone() {
            let (w2, c) = (structure.omega2[m], structure.damping[m]);
            room.first[m] = load[m] - c * v[m] - w2 * q[m];
            room.last[m] = load[m] + slope[m] * h - c * end_v[m] - w2 * end_q[m];
        }
        if !structure.is_classical() {
            structure.subtract_coupling(v, 1.0, &mut room.first);
            structure.subtract_coupling(end_v, 1.0, &mut room.last);
        }
        for m in modes.clone() {
            jerk[m] = slope[m] - structure.damping[m] * room.first[m] - structure.omega2[m] * v[m];
        }
        if !structure.is_classical() {
            structure.subtract_coupling(&room.first, 1.0, jerk);
        }
        for m in modes.clone() {
            let (w2, acceleration) = (structure.omega2[m], room.first[m]);
            room.slow[m] = (jerk[m] * jerk[m] + w2 * acceleration * acceleration).sqrt();
        }
        let is_coupled = structure.couples(building.modes.start);
        if is_coupled {
            share(&mut room.slow[modes.clone()]);
        }
        for m in modes {
            let (w2, c) = (structure.omega2[m], structure.damping[m]);
            let (speed, change) = match is_coupled {
                true => (2.0 * structure.fastest, 3.0 * structure.fastest * structure.fastest),
                false => (structure.quickness[m], c * structure.quickness[m] + w2),
            };
            room.quick[m] = change * room.slow[m];
            room.slow[m] *= speed;
        }
        if !flight.is_watched {
            self.bound_swings(building, flight, room, is_coupled);
        }
    }

    /// Works out bounds on the oscillation of a building's modes about their quasi-static displacements (see
    /// `flight/envelope.rs`).
    fn bound_swings(&self, building: &BuildingRows, flight: &Stretch, room: &mut ModeBounds, is_coupled: bool) {
        let ((q, v), (load, slope)) = (flight.start, flight.loads);
        let modes = building.modes.clone();
        // With coupled modes the quasi-static displacement under a changing load is not worked out: the whole load is
        // taken to increase the amplitude.
        let is_pushed = is_coupled && slope[modes.clone()].iter().any(|slope| *slope != 0.0);
        let [held, held_end] = &mut room.held;
        for m in modes.clone() {
            let (w2, c) = (self.system.structure.omega2[m], self.system.structure.damping[m]);
            let rate = if is_pushed { 0.0 } else { slope[m] / w2 };
            held[m] = if is_pushed { 0.0 } else { load[m] / w2 - c * rate / w2 };
            (room.held_rate[m], held_end[m]) = (rate, held[m] + rate * flight.length);
            let (h, dh) = (q[m] - held[m], v[m] - rate);
            room.swing[m] = (dh * dh + w2 * h * h).sqrt() + MARGIN * w2.sqrt() * (held[m].abs() + q[m].abs());
        }
        if is_coupled {
            share(&mut room.swing[modes.clone()]);
        }
        for m in modes {
            if is_pushed {
                let end = load[m] + slope[m] * flight.length;
                room.swing[m] += flight.length * larger(load[m].abs(), end.abs());
            }
            room.swing_q[m] = room.swing[m] / self.system.structure.omega2[m].sqrt();
        }
    }

    /// Raises the peaks of block `b` to both ends of a flight, with the bounds on its modes, and notes the quantities
    /// that have to be searched for; `known_ends` are the values at both ends, if they are known.
    pub(in crate::engine) fn check_block(
        &self,
        building: &BuildingRows,
        b: usize,
        (flight, known_ends): (&Stretch, Option<[Lane; 2]>),
        peaks: &mut Peaks,
        work: &mut PeakWork,
    ) {
        let (block, modes, h) = (&building.blocks[b], building.modes.clone(), flight.length);
        let bounds = &work.peaks.bounds;
        let place = (building.first + b) * LANES;
        let direct = &work.peaks.direct[place..];
        let known = *peaks.block(building.first + b);
        let added = self.system.floor_forces.then_some((direct, 0.0, h));
        let at_rest = flight.rest.as_chunks::<LANES>().0[building.first + b];
        if !flight.is_watched && stay_below(&known, (block, &at_rest), (bounds, &modes), added) == [true; LANES] {
            return;
        }
        let mut course = course_of((block, &at_rest), (flight, known_ends), bounds, modes);
        if self.system.floor_forces {
            course.add(&work.peaks.direct[place..], 0.0, h);
        }
        let highest = course.highest(h);
        for i in 0..LANES {
            if highest[i] <= known[i] {
                continue;
            }
            peaks.raise(place + i, larger(course.start[0][i].abs(), course.end[0][i].abs()));
            let peak = peaks.values[place + i];
            if course.may_turn_above(i, h, peak)
                && let Some(of) = self.peak_rows.at(place + i)
            {
                work.peaks.suspects.push(Suspect {
                    of,
                    place: place + i,
                    peak,
                    pieces_left: MOST_PIECES,
                    cleared_in: None,
                });
            }
        }
    }
}

impl Block {
    /// The values of the quantities.
    #[inline(always)]
    pub fn values(&self, q: &[f64], v: &[f64]) -> Lane {
        let mut sum = [0.0; LANES];
        for (row, q) in self.on_q.iter().zip(q) {
            for i in 0..LANES {
                sum[i] += row[i] * q;
            }
        }
        for (row, v) in self.on_v.iter().zip(v) {
            for i in 0..LANES {
                sum[i] += row[i] * v;
            }
        }
        sum
    }
}

/// Gives each of some coupled modes the amplitude of all together: they exchange energy, and any may get all of it.
fn share(modes: &mut [f64]) {
    let whole = modes.iter().map(|e| e * e).sum::<f64>().sqrt();
    modes.fill(whole);
}

/// Whether the modes' oscillations are too small for each quantity of a block to exceed its peak by more than rounding;
/// `direct` is an addition to them that is linear in time, with the start and the length of its interval, s.
pub fn stay_below(
    peaks: &Lane,
    (block, at_rest): (&Block, &Lane),
    (bounds, modes): (&ModeBounds, &Range<usize>),
    direct: Option<(&[[f64; 2]], f64, f64)>,
) -> [bool; LANES] {
    let [held, held_end] = &bounds.held;
    let of_modes =
        [held, held_end, &bounds.held_rate, &bounds.swing_q, &bounds.swing].map(|vector| &vector[modes.clone()]);
    let swings = swing_of(block, of_modes);
    let added = |i: usize| {
        direct.map_or(0.0, |(direct, from, h)| {
            let [value, rate] = direct[i];
            larger((value + rate * from).abs(), (value + rate * (from + h)).abs())
        })
    };
    std::array::from_fn(|i| swings[i] + at_rest[i].abs() + added(i) <= (1.0 + MARGIN) * peaks[i])
}

/// Bounds on the magnitudes of a block's quantities: from the quasi-static displacements at the start and at the end,
/// their rate, and the amplitudes of the oscillation about them in q and in q'.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn swing_of(block: &Block, [held, held_end, rate, swing_q, swing]: [&[f64]; 5]) -> Lane {
    let count = block.on_q.len();
    // Equal lengths: no bounds checks below.
    let (held, held_end, rate) = (&held[..count], &held_end[..count], &rate[..count]);
    let (swing_q, swing) = (&swing_q[..count], &swing[..count]);
    let (mut start, mut end, mut sum) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for m in 0..count {
        let row = &block.on_q[m];
        for i in 0..LANES {
            start[i] += row[i] * held[m];
            end[i] += row[i] * held_end[m];
            sum[i] += row[i].abs() * swing_q[m];
        }
    }
    for (m, row) in block.on_v.iter().enumerate().take(count) {
        for i in 0..LANES {
            start[i] += row[i] * rate[m];
            end[i] += row[i] * rate[m];
            sum[i] += row[i].abs() * swing[m];
        }
    }
    each(|i| larger(start[i].abs(), end[i].abs()) + sum[i])
}

/// The quantities of a block, with their values at rest, at both ends of a flight, of which its values may be known.
pub fn course_of(
    (block, at_rest): (&Block, &Lane),
    (flight, known_ends): (&Stretch, Option<[Lane; 2]>),
    bounds: &ModeBounds,
    modes: Range<usize>,
) -> Course {
    let [q, rate] = [flight.start.0, flight.start.1].map(|vector| &vector[modes.clone()]);
    let [end_q, end_rate] = [flight.end.0, flight.end.1].map(|vector| &vector[modes.clone()]);
    let [first, last, slow, quick] =
        [&bounds.first, &bounds.last, &bounds.slow, &bounds.quick].map(|vector| &vector[modes.clone()]);
    let mut course = sum_course(block, [rate, first, end_rate, last], [slow, quick]);
    [course.start[0], course.end[0]] = known_ends.unwrap_or_else(|| {
        let ends = [values_of(block, q, rate), values_of(block, end_q, end_rate)];
        ends.map(|values| each(|i| values[i] + at_rest[i]))
    });
    course
}

/// Their slopes and the bounds on their fourth derivatives, from the modes' v and accelerations at both ends and the
/// factors of these bounds.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn sum_course(block: &Block, ends: [&[f64]; 4], [slow, quick]: [&[f64]; 2]) -> Course {
    let count = block.on_q.len();
    // Equal lengths: no bounds checks below.
    let [v, a, end_v, end_a] = ends.map(|vector| &vector[..count]);
    let (slow, quick) = (&slow[..count], &quick[..count]);
    let mut course = Course::default();
    let Course { start: [_, rate], end: [_, end_rate], fourth } = &mut course;
    for m in 0..count {
        let row = &block.on_q[m];
        for i in 0..LANES {
            rate[i] += row[i] * v[m];
            end_rate[i] += row[i] * end_v[m];
            fourth[i] += row[i].abs() * slow[m];
        }
    }
    for (m, row) in block.on_v.iter().enumerate().take(count) {
        for i in 0..LANES {
            rate[i] += row[i] * a[m];
            end_rate[i] += row[i] * end_a[m];
            fourth[i] += row[i].abs() * quick[m];
        }
    }
    course
}

impl Course {
    /// Adds to the quantities numbers that are linear in time, over an interval of h seconds that starts at `from`.
    pub fn add(&mut self, direct: &[[f64; 2]], from: f64, h: f64) {
        for (i, [value, rate]) in direct.iter().enumerate().take(LANES) {
            self.start[0][i] += value + rate * from;
            self.start[1][i] += rate;
            self.end[0][i] += value + rate * (from + h);
            self.end[1][i] += rate;
        }
    }

    /// Upper bounds on the magnitudes over the flight.
    fn highest(&self, h: f64) -> Lane {
        let ([start, rate], [end, end_rate]) = (&self.start, &self.end);
        let (third, share) = (h / 3.0, (h * h) * (h * h) / 384.0);
        each(|i| {
            let controls = larger((start[i] + third * rate[i]).abs(), (end[i] - third * end_rate[i]).abs());
            larger(larger(start[i].abs(), end[i].abs()), controls) + share * self.fourth[i]
        })
    }

    /// Whether quantity `i` may have a turning point in between, above its peak.
    pub fn may_turn_above(&self, i: usize, h: f64, peak: f64) -> bool {
        let (start, rate, end, end_rate) = (self.start[0][i], self.start[1][i], self.end[0][i], self.end[1][i]);
        roots::may_turn_above((start, rate), (end, end_rate), (h, self.fourth[i]), peak)
            || roots::may_turn_above((-start, -rate), (-end, -end_rate), (h, self.fourth[i]), peak)
    }
}
