//! The largest magnitude of one quantity in a step that has no power series in time: the first one after an entry under a
//! power law, or a window. Such a step is a part of one swing of the contact, so a few readings show every turn.

use super::contact::ContactStep;
use super::search::Quantity;
use super::{PeakOf, larger};
use crate::engine::input::LinearInput;
use crate::engine::model::Model;
use crate::engine::state::{StepKind, Workspace};

/// Parts that a step is read in.
const PARTS: u32 = 6;

/// Share of a peak that the cubic through a part's ends has to reach for the part to be searched.
const NEARLY: f64 = 0.98;

/// What is left to gain at a turn, relative to its value, where the search ends; and most readings that this takes.
const CLOSE: f64 = 1e-14;
const MOST_READINGS: usize = 20;

/// Vectors to read into.
#[derive(Clone, Debug, Default)]
pub(super) struct ReadingRoom {
    q: Vec<f64>,
    v: Vec<f64>,
    acceleration: Vec<f64>,
    jerk: Vec<f64>,
}

impl ReadingRoom {
    pub fn new(lanes: usize) -> ReadingRoom {
        let vector = || vec![0.0; lanes];
        ReadingRoom { q: vector(), v: vector(), acceleration: vector(), jerk: vector() }
    }
}

/// A quantity at a time of a step.
#[derive(Clone, Copy)]
struct Reading {
    /// s since its start.
    time: f64,
    value: f64,
    slope: f64,
}

impl Model {
    /// See above; or `known` if that is larger.
    pub(super) fn highest_by_reading(
        &self,
        quantity: &Quantity,
        known: f64,
        part: &ContactStep,
        work: &mut Workspace,
    ) -> f64 {
        let mut peak = known;
        let mut last = self.read_quantity(quantity, 0.0, part, work);
        for i in 1..=PARTS {
            let time = part.length * f64::from(i) / f64::from(PARTS);
            let next = self.read_quantity(quantity, time, part, work);
            for sign in [1.0, -1.0] {
                let ends = (last.times(sign), next.times(sign));
                if ends.0.slope > 0.0 && ends.1.slope < 0.0 && top(ends.0, ends.1).1 > NEARLY * peak {
                    let read = |time: f64| self.read_quantity(quantity, time, part, work).times(sign);
                    peak = larger(peak, turn(ends.0, ends.1, read));
                }
            }
            peak = larger(peak, next.value.abs());
            last = next;
        }
        peak
    }

    /// Reads a quantity and its slope at a time of a step.
    fn read_quantity(&self, quantity: &Quantity, time: f64, part: &ContactStep, work: &mut Workspace) -> Reading {
        let ContactStep { base, step, inputs, .. } = part;
        let coordinates = base.coordinates;
        let mut room = std::mem::take(&mut work.peaks.reading);
        let ReadingRoom { q, v, acceleration, jerk } = &mut room;
        match step.kind {
            _ if time == 0.0 => {
                q.copy_from_slice(&base.q);
                v.copy_from_slice(&base.v);
            }
            StepKind::Window => self.read_window(step, time, &mut work.powers, (q, v)),
            _ => step.onset.evaluate(time / step.onset.scale, q, v),
        }
        let (ground, ground_slope) = part.ground();
        let ground = ground + ground_slope * time;
        let shares = self.participation(coordinates);
        for (lane, share) in shares.iter().enumerate() {
            acceleration[lane] = -share * ground;
            jerk[lane] = -share * ground_slope;
        }
        let at = base.elapsed + time;
        self.add_floor_forces(inputs, coordinates, |force| force.after(base.segment.start, at), acceleration);
        self.add_floor_forces(inputs, coordinates, LinearInput::slope, jerk);
        self.resist(coordinates, q, v, 1.0, acceleration);
        let starts = &work.peaks.starts;
        let penetration = |p: usize| if time == 0.0 { starts[p] } else { step.penetration_at(p, time) };
        let in_contact = || base.contacts.iter().enumerate().filter(|(_, contact)| contact.in_contact());
        for (p, contact) in in_contact() {
            let (d, rate) = penetration(p);
            self.push_apart_by(p, coordinates, contact.branch().value(d, rate), acceleration);
        }
        self.resist(coordinates, v, acceleration, 1.0, jerk);
        for (p, contact) in in_contact() {
            let (d, rate) = penetration(p);
            let bend = self.pairs[p].relative(coordinates, acceleration);
            let rates = contact.branch().rates([d, rate, bend, 0.0]);
            self.push_apart_by(p, coordinates, rates.map_or(0.0, |[first, _]| first), jerk);
        }
        let [row, row_v] = quantity.rows;
        let dot = |row: &[f64], vector: &[f64]| row.iter().zip(vector).map(|(a, b)| a * b).sum::<f64>();
        let (value, slope) = match quantity.of {
            PeakOf::Acceleration(..) => (dot(row, acceleration) + ground, dot(row, jerk) + ground_slope),
            PeakOf::BaseShear(_) => (dot(row, q) + dot(row_v, v), dot(row, v) + dot(row_v, acceleration)),
            PeakOf::Displacement(..) | PeakOf::Drift(..) => (dot(row, q), dot(row, v)),
        };
        work.peaks.reading = room;
        Reading { time, value, slope }
    }
}

impl Reading {
    fn times(self, sign: f64) -> Reading {
        Reading { time: self.time, value: sign * self.value, slope: sign * self.slope }
    }
}

/// Where the cubic through two ends, between which it rises first and falls then, is highest, and how high.
fn top(a: Reading, b: Reading) -> (f64, f64) {
    let w = b.time - a.time;
    let (first, rise, last) = (w * a.slope, b.value - a.value, w * b.slope);
    let (second, third) = (3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise);
    let root = (second * second - 3.0 * third * first).max(0.0).sqrt();
    let s = (first / (root - second)).clamp(0.0, 1.0);
    (a.time + w * s, a.value + s * (first + s * (second + s * third)))
}

/// The value where a quantity turns from rising to falling between two readings: cubics through readings ever closer to it.
fn turn(mut a: Reading, mut b: Reading, mut read: impl FnMut(f64) -> Reading) -> f64 {
    let mut best = larger(a.value, b.value);
    for _ in 0..MOST_READINGS {
        let (time, _) = top(a, b);
        if !(time > a.time && time < b.time) {
            break;
        }
        let middle = read(time);
        // What a parabola as bent as the bracket has left to gain.
        let gain = 0.5 * middle.slope * middle.slope * (b.time - a.time) / (a.slope - b.slope);
        best = larger(best, middle.value);
        if gain <= CLOSE * best.abs() {
            break;
        }
        if middle.slope > 0.0 {
            a = middle;
        } else {
            b = middle;
        }
    }
    best
}
