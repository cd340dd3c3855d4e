//! Peaks over a flight, from its ends.
//!
//! A quantity y = A q + B q' is as near to the cubic through its values and slopes at both ends as h^4/384 max|y''''|
//! [BirkhoffPriver1967]. The load is linear in time, so q'' is a free oscillation, whose E = sqrt(q'''^2 + w^2 q''^2) never
//! grows, and |y''''| <= sum over modes of (|A| (w + c) + |B| (c (w + c) + w^2)) E. Where the cubic's control values and that
//! bound stay below the peak, nothing has happened; where the slope keeps its sign, the larger end is the peak.

use super::rows::{Block, BuildingRows};
use super::{PeakOf, Peaks, larger};
use crate::engine::model::Model;
use crate::engine::roots;
use crate::engine::state::{Base, Inputs, Workspace};
use crate::polynomial::each;
use crate::structure::{LANES, Lane};
use std::ops::Range;

/// A flight of both buildings from start to end.
pub(super) struct Flight<'a> {
    /// q and v of all modes.
    pub start: (&'a [f64], &'a [f64]),
    pub end: (&'a [f64], &'a [f64]),
    /// The modal load at the start and its rate.
    pub loads: (&'a [f64], &'a [f64]),
    /// m/s2 and m/s3, of the ground at the start.
    pub ground: (f64, f64),
    /// s.
    pub length: f64,
    /// The whole flight of which this is the first part.
    pub whole: Option<&'a Flight<'a>>,
}

/// What is known of each mode over a flight.
#[derive(Clone, Debug, Default)]
pub(super) struct ModeBounds {
    /// Accelerations relative to the ground, at the start and at the end.
    first: Vec<f64>,
    last: Vec<f64>,
    /// How far each mode can swing in q' and in q.
    pub swing: Vec<f64>,
    pub swing_q: Vec<f64>,
    /// What |A| and |B| are multiplied by in the bound on a fourth derivative (for the look ahead: of others).
    pub slow: Vec<f64>,
    pub quick: Vec<f64>,
}

impl ModeBounds {
    pub fn new(lanes: usize) -> ModeBounds {
        let vector = || vec![0.0; lanes];
        ModeBounds {
            first: vector(),
            last: vector(),
            swing: vector(),
            swing_q: vector(),
            slow: vector(),
            quick: vector(),
        }
    }
}

/// How the quantities of a block go over a flight: at both ends their values and slopes.
#[derive(Clone, Copy, Default)]
pub(super) struct Course {
    pub start: [Lane; 2],
    pub end: [Lane; 2],
    /// Bounds on their fourth derivatives.
    fourth: Lane,
}

impl Model {
    /// Raises peaks to what a flight reaches, but for blocks that have been cleared for the segment that it is in.
    pub(super) fn check_flight(&self, flight: &Flight, peaks: &mut Peaks, work: &mut Workspace) {
        work.peaks.expanded = None;
        for building in &self.peak_rows.buildings {
            self.bound_modes(building, flight, &mut work.peaks.bounds, &mut work.node_v);
            for b in 0..building.blocks.len() {
                self.check_block(building, b, flight, peaks, work);
            }
        }
    }

    /// The same for the blocks that have not been cleared for the segment of that number.
    pub(super) fn check_due_blocks(&self, segment: u64, flight: &Flight, peaks: &mut Peaks, work: &mut Workspace) {
        work.peaks.expanded = None;
        for building in &self.peak_rows.buildings {
            let mut is_bounded = false;
            for b in 0..building.blocks.len() {
                if work.peaks.watch.is_clear(building.first + b, segment) {
                    continue;
                }
                if !std::mem::replace(&mut is_bounded, true) {
                    self.bound_modes(building, flight, &mut work.peaks.bounds, &mut work.node_v);
                }
                self.check_block(building, b, flight, peaks, work);
            }
        }
    }

    /// Raises peaks to the motion of the base, which is that of modes without contact forces. What an input that has just
    /// been set does belongs to the step that begins: it has not acted yet.
    pub(super) fn raise_to_motion(&self, base: &Base, peaks: &mut Peaks) {
        for building in &self.peak_rows.buildings {
            let [q, v] = [&base.q, &base.v].map(|vector| &vector[building.modes.clone()]);
            for (b, block) in building.blocks.iter().enumerate() {
                for (i, value) in block.values(q, v).into_iter().enumerate() {
                    let place = (building.first + b) * LANES + i;
                    if !(self.floor_forces && matches!(self.peak_rows.at(place), Some(PeakOf::Acceleration(..)))) {
                        peaks.raise(place, value);
                    }
                }
            }
        }
    }

    /// What floor forces add to accelerations at the base, and how that changes.
    pub(super) fn note_floor_forces(&self, base: &Base, inputs: &Inputs, direct: &mut [[f64; 2]]) {
        for (place, direct) in direct.iter_mut().enumerate() {
            if let Some(PeakOf::Acceleration(side, floor)) = self.peak_rows.at(place) {
                let force = &inputs.floor_forces[inputs.place(side, floor)];
                let inverse = self.structure.floors.inverse_mass(self.structure.floors.lane(side as usize, floor));
                let (start, elapsed) = (base.segment.start, base.elapsed);
                *direct = [force.after(start, elapsed) * inverse, force.slope() * inverse];
            }
        }
    }

    /// How fast a building's modes are and how far they can swing over a flight.
    pub(super) fn bound_modes(
        &self,
        building: &BuildingRows,
        flight: &Flight,
        room: &mut ModeBounds,
        jerk: &mut [f64],
    ) {
        let structure = &self.structure;
        let (modes, h) = (building.modes.clone(), flight.length);
        let ((q, v), (end_q, end_v), (load, slope)) = (flight.start, flight.end, flight.loads);
        for m in modes.clone() {
            let (w2, c) = (structure.omega2[m], structure.damping[m]);
            room.first[m] = load[m] - c * v[m] - w2 * q[m];
            room.last[m] = load[m] + slope[m] * h - c * end_v[m] - w2 * end_q[m];
            room.swing[m] = (v[m] * v[m] + w2 * q[m] * q[m]).sqrt();
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
            room.quick[m] = larger(load[m].abs(), (load[m] + slope[m] * h).abs());
        }
        let is_coupled = structure.couples(building.modes.start);
        if is_coupled {
            // Coupled modes exchange energy: any may come to have all of it.
            for vector in [&mut room.slow, &mut room.swing, &mut room.quick] {
                let whole = vector[modes.clone()].iter().map(|e| e * e).sum::<f64>().sqrt();
                vector[modes.clone()].fill(whole);
            }
        }
        for m in modes {
            let (w2, c) = (structure.omega2[m], structure.damping[m]);
            room.swing[m] += h * room.quick[m];
            room.swing_q[m] = room.swing[m] / w2.sqrt();
            let (speed, change) = match is_coupled {
                true => (2.0 * structure.fastest, 3.0 * structure.fastest * structure.fastest),
                false => (structure.quickness[m], c * structure.quickness[m] + w2),
            };
            room.quick[m] = change * room.slow[m];
            room.slow[m] *= speed;
        }
    }

    pub(super) fn check_block(
        &self,
        building: &BuildingRows,
        b: usize,
        flight: &Flight,
        peaks: &mut Peaks,
        work: &mut Workspace,
    ) {
        let (block, modes, h) = (&building.blocks[b], building.modes.clone(), flight.length);
        let bounds = &work.peaks.bounds;
        let place = (building.first + b) * LANES;
        let mut swings = swing_of(block, &bounds.swing_q[modes.clone()], &bounds.swing[modes.clone()]);
        if self.floor_forces {
            for (swing, [force, rate]) in swings.iter_mut().zip(&work.peaks.direct[place..]) {
                *swing += larger(force.abs(), (force + rate * h).abs());
            }
        }
        let known = *peaks.block(building.first + b);
        if (0..LANES).all(|i| swings[i] <= known[i]) {
            return;
        }
        let mut course = course_of(block, flight, bounds, modes);
        if self.floor_forces {
            course.add(&work.peaks.direct[place..], 0.0, h);
        }
        let highest = course.highest(h);
        for i in (0..LANES).filter(|&i| !(highest[i] <= known[i])) {
            peaks.raise(place + i, larger(course.start[0][i].abs(), course.end[0][i].abs()));
            let peak = peaks.values[place + i];
            if course.may_turn_above(i, h, peak)
                && let Some(of) = self.peak_rows.at(place + i)
            {
                // In the whole flight, so that a turn has the same bits whatever part of it is looked at.
                let peak = self.highest_in_flight(flight.whole.unwrap_or(flight), of, (peak, h), work);
                peaks.raise(place + i, peak);
            }
        }
    }
}

impl Block {
    /// As `sum_course` adds them up.
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

/// How far the quantities of a block can swing where the modes can so far. Wide instructions give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn swing_of(block: &Block, swing_q: &[f64], swing: &[f64]) -> Lane {
    let mut sum = [0.0; LANES];
    for (a, swing) in block.on_q.iter().zip(swing_q) {
        sum = each(|i| sum[i] + a[i].abs() * swing);
    }
    for (b, swing) in block.on_v.iter().zip(swing) {
        sum = each(|i| sum[i] + b[i].abs() * swing);
    }
    sum
}

/// The course of a block over a flight.
pub(super) fn course_of(block: &Block, flight: &Flight, bounds: &ModeBounds, modes: Range<usize>) -> Course {
    let ends = [flight.start.0, flight.start.1, &bounds.first, flight.end.0, flight.end.1, &bounds.last];
    let [slow, quick] = [&bounds.slow[modes.clone()], &bounds.quick[modes.clone()]];
    sum_course(block, ends.map(|vector| &vector[modes.clone()]), [slow, quick])
}

/// The same from the modes' q, v and accelerations at both ends and what bounds their fourth derivatives. Wide instructions
/// give the same bits.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn sum_course(block: &Block, ends: [&[f64]; 6], [slow, quick]: [&[f64]; 2]) -> Course {
    let count = block.on_q.len();
    // Says once that no index below leaves its vector.
    let [q, v, a, end_q, end_v, end_a] = ends.map(|vector| &vector[..count]);
    let (slow, quick) = (&slow[..count], &quick[..count]);
    let mut course = Course::default();
    let Course { start: [start, rate], end: [end, end_rate], fourth } = &mut course;
    for m in 0..count {
        let row = &block.on_q[m];
        for i in 0..LANES {
            start[i] += row[i] * q[m];
            rate[i] += row[i] * v[m];
            end[i] += row[i] * end_q[m];
            end_rate[i] += row[i] * end_v[m];
            fourth[i] += row[i].abs() * slow[m];
        }
    }
    for (m, row) in block.on_v.iter().enumerate().take(count) {
        for i in 0..LANES {
            start[i] += row[i] * v[m];
            rate[i] += row[i] * a[m];
            end[i] += row[i] * end_v[m];
            end_rate[i] += row[i] * end_a[m];
            fourth[i] += row[i].abs() * quick[m];
        }
    }
    course
}

impl Course {
    /// Adds what is linear in time, over h seconds from a time on.
    pub fn add(&mut self, direct: &[[f64; 2]], from: f64, h: f64) {
        for (i, [value, rate]) in direct.iter().enumerate().take(LANES) {
            self.start[0][i] += value + rate * from;
            self.start[1][i] += rate;
            self.end[0][i] += value + rate * (from + h);
            self.end[1][i] += rate;
        }
    }

    /// Bounds on the magnitudes over the flight.
    fn highest(&self, h: f64) -> Lane {
        let ([start, rate], [end, end_rate]) = (&self.start, &self.end);
        let (third, share) = (h / 3.0, (h * h) * (h * h) / 384.0);
        each(|i| {
            let controls = larger((start[i] + third * rate[i]).abs(), (end[i] - third * end_rate[i]).abs());
            larger(larger(start[i].abs(), end[i].abs()), controls) + share * self.fourth[i]
        })
    }

    /// Whether one of them may turn round in between, above its peak.
    pub fn may_turn_above(&self, i: usize, h: f64, peak: f64) -> bool {
        let (start, rate, end, end_rate) = (self.start[0][i], self.start[1][i], self.end[0][i], self.end[1][i]);
        roots::may_turn_above((start, rate), (end, end_rate), (h, self.fourth[i]), peak)
            || roots::may_turn_above((-start, -rate), (-end, -end_rate), (h, self.fourth[i]), peak)
    }
}
