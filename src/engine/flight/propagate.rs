//! The exact response of all buildings to a linear load.

use crate::engine::base::Base;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::numerics::polynomial::MAX_ORDER;
use crate::structure::{Interval, LONGEST_ANGLE, LinearLoad, Motion, MotionMut, exact_order, fly_in_one_series};

/// Up to so many series cost less than matrices and lose no digits.
const MOST_PIECES: f64 = 32.0;

impl System {
    /// Writes to `end` the motion `h` seconds after the base, under `work.load` and its slope.
    pub fn fly(&self, base: &Base, h: f64, work: &mut Buffers, end: MotionMut) {
        let Buffers { load, slope, scratch, interval, .. } = work;
        if self.structure.in_flight().is_classical() {
            return self.fly_uncoupled(base, h, LinearLoad { load, slope }, interval, end);
        }
        let prepared = self.prepared(base, h);
        let pieces = (self.structure.fastest * h / LONGEST_ANGLE).ceil().max(1.0);
        // Written so that a NaN is not few.
        if prepared.is_none() && pieces <= MOST_PIECES {
            return self.fly_in_pieces(base, h, pieces as usize, work, end);
        }
        let interval = prepared.unwrap_or_else(|| {
            interval.prepare(&self.structure, h);
            interval
        });
        interval.fly(base.motion(), LinearLoad { load, slope }, end, scratch);
    }

    /// The same; leaves the motion in `work.q`, `work.v`.
    pub fn fly_in(&self, base: &Base, h: f64, work: &mut Buffers) {
        let (mut q, mut v) = (std::mem::take(&mut work.q), std::mem::take(&mut work.v));
        self.fly(base, h, work, MotionMut { q: &mut q, v: &mut v });
        (work.q, work.v) = (q, v);
    }

    /// The motion `h` seconds after the base where damping couples no modes, under a load and its slope; `interval` is memory.
    pub fn fly_uncoupled(&self, base: &Base, h: f64, loads: LinearLoad, interval: &mut Interval, end: MotionMut) {
        let start = base.motion();
        if let Some(prepared) = self.prepared(base, h) {
            return prepared.fly_uncoupled(start, loads, end);
        }
        let flying = self.structure.in_flight();
        let order = exact_order(flying.fastest * h).filter(|_| !cfg!(without = "short_flight"));
        if let Some(order) = order {
            return fly_in_one_series(flying, start, loads, (h, order), end);
        }
        interval.prepare(flying, h);
        interval.fly_uncoupled(start, loads, end);
    }

    /// The same by series of all modes, one after another: where damping couples modes, matrices for a flight of a
    /// length that no other flight has would cost much more.
    fn fly_in_pieces(&self, base: &Base, h: f64, pieces: usize, work: &mut Buffers, MotionMut { q, v }: MotionMut) {
        let Buffers { load, slope, scratch, series, powers, .. } = work;
        let piece = h / pieces as f64;
        let order = exact_order(self.structure.fastest * piece).unwrap_or(MAX_ORDER);
        MotionMut { q, v }.copy_from(base.motion());
        for i in 0..pieces {
            let start = i as f64 * piece;
            let moved = &mut scratch.room()[..load.len()];
            moved
                .iter_mut()
                .zip(load.iter().zip(&*slope))
                .for_each(|(moved, (load, slope))| *moved = load + slope * start);
            series.expand_flight(&self.structure, Motion { q, v }, LinearLoad { load: moved, slope }, (piece, order));
            powers.set(1.0, series.order);
            series.evaluate(powers, q, v);
        }
    }

    /// The prepared flight from the base over `h` seconds, if that is a whole segment.
    fn prepared(&self, base: &Base, h: f64) -> Option<&Interval> {
        let whole = base.elapsed == 0.0 && h == base.segment.length;
        self.ground.as_ref().filter(|_| whole).and_then(|ground| ground.prepared(&base.segment))
    }
}
