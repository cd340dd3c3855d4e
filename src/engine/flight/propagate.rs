//! The exact response of both buildings to a linear load.

use crate::engine::base::Base;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::structure::{Interval, exact_order, fly_in_one_series};

impl System {
    /// Writes to q, v the motion `h` seconds after the base, under `work.load` and its slope.
    pub fn fly(&self, base: &Base, h: f64, work: &mut Buffers, (q, v): (&mut [f64], &mut [f64])) {
        let Buffers { load, slope, scratch, series, interval, powers, .. } = work;
        if self.structure.is_classical() && !cfg!(without = "short_flight") {
            return self.fly_uncoupled(base, h, (load, slope), interval, (q, v));
        }
        let prepared = self.prepared(base, h);
        if prepared.is_none()
            && let Some(order) = exact_order(self.structure.fastest * h)
        {
            series.expand_flight(&self.structure, (&base.q, &base.v), (load, slope), (h, order));
            powers.set(1.0, series.order);
            return series.evaluate(powers, q, v);
        }
        let interval = prepared.unwrap_or_else(|| {
            interval.prepare(&self.structure, h);
            interval
        });
        interval.fly((&base.q, &base.v), (load, slope), (q, v), scratch);
    }

    /// The same where damping couples no modes, under a load and its slope; `interval` is memory.
    pub fn fly_uncoupled(
        &self,
        base: &Base,
        h: f64,
        loads: (&[f64], &[f64]),
        interval: &mut Interval,
        end: (&mut [f64], &mut [f64]),
    ) {
        let start = (&base.q[..], &base.v[..]);
        if let Some(prepared) = self.prepared(base, h) {
            return prepared.fly_uncoupled(start, loads, end);
        }
        if let Some(order) = exact_order(self.structure.fastest * h) {
            return fly_in_one_series(&self.structure, start, loads, (h, order), end);
        }
        interval.prepare(&self.structure, h);
        interval.fly_uncoupled(start, loads, end);
    }

    /// The prepared flight from the base over `h` seconds, if that is a whole segment.
    fn prepared(&self, base: &Base, h: f64) -> Option<&Interval> {
        let whole = base.elapsed == 0.0 && h == base.segment.length;
        self.ground.as_ref().filter(|_| whole).and_then(|ground| ground.prepared(&base.segment))
    }
}
