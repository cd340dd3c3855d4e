//! A closer look at a flight in which floors may meet: piece by piece, from the power series of the penetrations.
//!
//! Looking does not touch the motion: a flight in which nothing is found ends where the exact solution says, to the bit
//! the same whether it has been looked at or not. So it does not matter which pairs there are that never meet.

use crate::engine::base::counters::Counters;
use crate::engine::base::planned::Event;
use crate::engine::base::planned::Planned;
use crate::engine::base::{Base, Coordinates};
use crate::engine::flight::Flight;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::numerics::polynomial::ALL;
use crate::numerics::roots;
use crate::structure::{EXACT, flight_order};

/// (Fastest rate) x (time) that one series reaches.
const REACH: f64 = 1.5;

/// Pieces that one flight is looked at in; what is longer takes another planned.
const MOST_PIECES: u32 = 10_000;

/// Between series, pieces of this many times their length and more are tried without one.
const LONGER: u32 = 4;

impl Flight {
    /// Finds the first entry in the planned flight and shortens the step to it.
    pub fn look_closer(
        &self,
        system: &System,
        base: &Base,
        planned: &mut Planned,
        counters: &mut Counters,
        (look, work): (&mut Look, &mut Buffers),
    ) {
        let remaining = planned.length;
        let mut unit =
            if system.structure.fastest * remaining > REACH { REACH / system.structure.fastest } else { remaining };
        let is_carried = base.contacts.iter().any(|contact| contact.carried);
        look.start(base, &work.load);
        if is_carried {
            system.structure.accelerate(&base.q, &base.v, &work.load, &mut work.q);
            unit = unit.min(system.bounce_horizon(base, &work.q));
        }
        let (mut series_left, mut longer) = (1, f64::from(LONGER) * unit);
        for _ in 0..MOST_PIECES {
            counters.closer_looks += 1;
            let left = remaining - look.from;
            if series_left == 0 && left > unit {
                let length = left.min(longer);
                if system.swings_stay_apart((&look.q, &look.v), (&look.load, &work.slope), left) {
                    return;
                }
                if !self.piece_stays_apart(system, base, (look, work), length) {
                    (series_left, longer) = (LONGER, f64::from(LONGER) * unit);
                    continue;
                }
                longer *= 2.0;
            } else {
                series_left -= u32::from(series_left > 0);
                let length = left.min(unit);
                let entry = self.first_rise_in(system, base, (look, work), length);
                if entry.is_some() || is_carried {
                    return self.cut_flight(system, base, planned, (look, work), length, entry);
                }
                self.move_look(system, base, (look, work), length);
            }
            if look.from >= remaining {
                return;
            }
        }
        planned.q.copy_from_slice(&look.q);
        planned.v.copy_from_slice(&look.v);
        (planned.length, planned.reaches_limit) = (look.from, false);
    }

    /// Ends the step at the entry that has been found in the series of a piece, or with that piece.
    fn cut_flight(
        &self,
        system: &System,
        base: &Base,
        planned: &mut Planned,
        (look, work): (&Look, &mut Buffers),
        length: f64,
        entry: Option<(f64, usize)>,
    ) {
        let x = entry.map_or(1.0, |(x, _)| x);
        work.powers.set(x, work.series.order);
        if entry.is_some() || length < planned.length {
            work.series.evaluate(&work.powers, &mut planned.q, &mut planned.v);
            planned.length = look.from + x * length;
            planned.reaches_limit = false;
            planned.event = entry.map(|(_, p)| Event::Entry(p));
        }
        system.carry(base, &work.series, &work.powers, &mut work.scalar, &mut planned.carried);
    }

    /// The first entry in a piece, from its power series: where, as a share of the piece, and which pair.
    fn first_rise_in(
        &self,
        system: &System,
        base: &Base,
        (look, work): (&mut Look, &mut Buffers),
        length: f64,
    ) -> Option<(f64, usize)> {
        let order =
            flight_order(system.structure.fastest * length, EXACT).unwrap_or(crate::numerics::polynomial::MAX_ORDER);
        let Look { from, q, v, load, stay_apart, .. } = &*look;
        work.series.expand_flight(&system.structure, (q, v), (load, &work.slope), (length, order));
        let mut first: Option<(f64, usize)> = None;
        for (p, (pair, contact)) in system.pairs.iter().zip(&base.contacts).enumerate() {
            if stay_apart[p] {
                continue;
            }
            let terms = &mut work.scalar[..=work.series.order];
            let mut noise = pair.noise(system.project(p, Coordinates::Modes, &work.series, &ALL, terms));
            if *from == 0.0 {
                noise = contact.begin_flight(terms, length, noise);
            } else {
                terms[0] -= pair.gap;
            }
            let end = first.map_or(1.0, |(x, _)| x);
            if let Some(x) = roots::first_rise(terms, end, noise) {
                first = Some((x, p));
            }
        }
        first
    }

    /// Whether no pair meets in a piece, shown by both ends as for a whole flight; if so, the look has moved on.
    fn piece_stays_apart(
        &self,
        system: &System,
        base: &Base,
        (look, work): (&mut Look, &mut Buffers),
        length: f64,
    ) -> bool {
        let Look { q, v, load, .. } = &*look;
        let deviation = self.deviation_from_cubic(system, (q, v), (load, &work.slope), length, &mut work.scratch);
        self.fly_look(system, base, (look, work), length);
        let Look { q, v, end_q, end_v, stay_apart, .. } = &*look;
        let stays_apart = system.pairs.iter().enumerate().all(|(p, pair)| {
            let (start, end) = (pair.penetration(q, v), pair.penetration(end_q, end_v));
            stay_apart[p] || highest_of_cubic(start, end, length) + deviation < 0.0
        });
        if stays_apart {
            look.move_on(length, &work.slope);
        }
        stays_apart
    }

    /// Moves the look on by the exact flight.
    fn move_look(&self, system: &System, base: &Base, (look, work): (&mut Look, &mut Buffers), length: f64) {
        self.fly_look(system, base, (look, work), length);
        look.move_on(length, &work.slope);
    }

    /// Flies from the base to the end of a piece.
    fn fly_look(&self, system: &System, base: &Base, (look, work): (&mut Look, &mut Buffers), length: f64) {
        let (mut q, mut v) = (std::mem::take(&mut look.end_q), std::mem::take(&mut look.end_v));
        system.fly(base, look.from + length, work, (&mut q, &mut v));
        (look.end_q, look.end_v) = (q, v);
    }
}

/// The largest control value of the cubic Hermite interpolant from values and rates at both ends.
pub fn highest_of_cubic((start, rate): (f64, f64), (end, end_rate): (f64, f64), h: f64) -> f64 {
    start.max(start + h / 3.0 * rate).max(end - h / 3.0 * end_rate).max(end)
}

/// Where a look has got to: content means nothing between calls.
#[derive(Clone, Debug)]
pub struct Look {
    /// s since the base.
    from: f64,
    /// The motion there and the load.
    q: Vec<f64>,
    v: Vec<f64>,
    load: Vec<f64>,
    /// The motion at the end of the present piece.
    end_q: Vec<f64>,
    end_v: Vec<f64>,
    /// Pairs that certainly do not meet in the whole flight.
    pub stay_apart: Vec<bool>,
}

impl Look {
    pub fn new(lanes: usize, pairs: usize) -> Look {
        let vector = || vec![0.0; lanes];
        let stay_apart = vec![false; pairs];
        Look { from: 0.0, q: vector(), v: vector(), load: vector(), end_q: vector(), end_v: vector(), stay_apart }
    }

    fn start(&mut self, base: &Base, load: &[f64]) {
        self.from = 0.0;
        self.q.copy_from_slice(&base.q);
        self.v.copy_from_slice(&base.v);
        self.load.copy_from_slice(load);
    }

    fn move_on(&mut self, length: f64, slope: &[f64]) {
        self.from += length;
        std::mem::swap(&mut self.q, &mut self.end_q);
        std::mem::swap(&mut self.v, &mut self.end_v);
        for (load, slope) in self.load.iter_mut().zip(slope) {
            *load += slope * length;
        }
    }
}
