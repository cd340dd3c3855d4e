//! The motion of the buildings without contact forces during a window: a power series, or, where modes are many, exact
//! flights and prepared rows for the distances of the pairs.

use crate::engine::base::Base;
use crate::engine::excitation::inputs::Inputs;
use crate::engine::system::System;
use crate::engine::system::buffers::Buffers;
use crate::numerics::powers::Powers;
use crate::structure::{FreeRows, Interval, LinearLoad, MotionMut, MotionSeries, dot};

/// The source of the polynomials of the pairs' distances.
#[derive(Clone, Copy)]
pub enum FreeTerms<'a> {
    /// The series of all modes.
    Series(&'a MotionSeries),
    /// Rows over all modes, for the base.
    Rows(&'a FreeRows, &'a Base),
}

impl FreeTerms<'_> {
    /// The unit of time of the powers, s.
    pub fn scale(&self) -> f64 {
        match self {
            FreeTerms::Series(series) => series.scale,
            FreeTerms::Rows(rows, _) => rows.length,
        }
    }

    /// Number of terms.
    pub fn count(&self) -> usize {
        match self {
            FreeTerms::Series(series) => series.order + 1,
            FreeTerms::Rows(..) => FreeRows::TERMS,
        }
    }

    /// Writes the terms of a pair's distance, m, from power 2 on.
    pub fn enter(&self, system: &System, p: usize, out: &mut [f64]) {
        match self {
            FreeTerms::Series(series) => series.dot_each(&system.pairs[p].row.modes, 2, out),
            FreeTerms::Rows(rows, base) => {
                rows.enter(p, base.motion(), base.ground(), out);
            }
        }
    }

    /// Second derivative of a pair's distance at the start, m/s2, where it is positive; `room` gets terms.
    pub fn curvature_at_start(&self, system: &System, p: usize, room: &mut [f64]) -> f64 {
        let scale = self.scale();
        let term = match self {
            FreeTerms::Series(series) => dot(&system.pairs[p].row.modes, series.term(2)),
            FreeTerms::Rows(..) => {
                self.enter(system, p, room);
                room[2]
            }
        };
        2.0 * term.max(0.0) / (scale * scale)
    }
}

/// The motion without contact forces, to be evaluated at any time of a window.
pub enum FreeMotion<'a> {
    Series(&'a MotionSeries, &'a mut Powers),
    /// The exact flight from the base, under a load and its slope; with memory for it.
    Flight(&'a Base, LinearLoad<'a>, &'a mut Interval),
}

impl<'a> FreeMotion<'a> {
    /// That of a window from the base; `series` holds it where it is one.
    pub fn of(
        system: &System,
        (base, inputs): (&'a Base, &Inputs),
        series: &'a MotionSeries,
        work: &'a mut Buffers,
    ) -> FreeMotion<'a> {
        if !system.flies_in_windows() {
            return FreeMotion::Series(series, &mut work.powers);
        }
        system.load(base, inputs, &mut work.load, &mut work.slope);
        FreeMotion::Flight(base, LinearLoad { load: &work.load, slope: &work.slope }, &mut work.interval)
    }

    /// q and v at a time, s.
    pub fn evaluate(self, system: &System, elapsed: f64, MotionMut { q, v }: MotionMut) {
        match self {
            FreeMotion::Series(series, powers) => {
                powers.set(elapsed / series.scale, series.order);
                series.evaluate(powers, q, v);
            }
            FreeMotion::Flight(base, loads, interval) => {
                system.fly_uncoupled(base, elapsed, loads, interval, MotionMut { q, v });
            }
        }
    }
}
