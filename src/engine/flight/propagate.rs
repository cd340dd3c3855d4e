//! The exact response of both buildings to a linear load.

use crate::engine::base::Base;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::structure::{exact_order, fly_in_one_series};

impl System {
    /// Writes to q, v the motion `h` seconds after the base, under `work.load` and its slope.
    pub fn fly(&self, base: &Base, h: f64, work: &mut Buffers, (q, v): (&mut [f64], &mut [f64])) {
        let Buffers { load, slope, scratch, series, interval, powers, .. } = work;
        let whole = base.elapsed == 0.0 && h == base.segment.length;
        let prepared = self.ground.as_ref().filter(|_| whole).and_then(|ground| ground.prepared(&base.segment));
        if prepared.is_none()
            && let Some(order) = exact_order(self.structure.fastest * h)
        {
            if !cfg!(without = "short_flight") && self.structure.is_classical() {
                return fly_in_one_series(&self.structure, (&base.q, &base.v), (load, slope), (h, order), (q, v));
            }
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
}
