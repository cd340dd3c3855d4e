//! Modes that have settled: what is left of their quick motion is less than rounding, so that they follow the load, which is
//! linear in time, or creep after it.
//!
//! Storeys can be so stiff, and dashpots so heavy, that a mode swings or dies out a million times as fast as the others. Its
//! series in time reaches no further than that, however little it moves. Its motion is
//!
//! ```text
//! q = s(t) + x,    s = (load - c slope / w^2) / w^2,    s' = slope / w^2,    x'' + c x' + w^2 x = 0
//! ```
//!
//! and x never grows: sqrt(x^2 + (x' / w)^2) falls, and of a mode with two real rates, x = a exp(-r t) + b exp(-R t), so does
//! b. Where x, or b, is below rounding in all quantities of a body, the mode is s, or s + a exp(-r t), from there to the end of
//! the flight. What has settled depends on the flight alone, not on the peaks so far: a turning point keeps its bits.

use crate::engine::bounds::stretch::Stretch;
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::room::{PeakRoom, PeakWork, Suspect};
use crate::engine::peaks::search::{LEAF_ANGLE, Piece};
use crate::engine::quantities::rows::RowBlock;
use crate::structure::{LANES, Lane, Structure};
use std::ops::Range;

/// What is left of a mode is below rounding in a quantity if it is less than this share of the terms of that.
const ROUNDING: f64 = 1e-14;

/// c / w from which on a mode is taken as two real rates.
const HEAVY: f64 = 2.5;

/// What is left of a mode apart from the load that it follows.
struct Rest {
    /// x and x'.
    lag: [f64; 2],
    /// The rate at which it creeps on once the quick part is gone, 1/s.
    creep: f64,
    /// Bounds on the quick part, in x and in x'.
    quick: [f64; 2],
}

impl Rest {
    fn of(structure: &Structure, m: usize, (q, v): (f64, f64), (load, slope): (f64, f64)) -> Rest {
        let (w2, c) = (structure.omega2[m], structure.damping[m]);
        let (w, rate) = (w2.sqrt(), slope / w2);
        let [x, dx] = [q - (load / w2 - c * rate / w2), v - rate];
        let (creep, size, fastest) = if c > HEAVY * w {
            let spread = ((c - 2.0 * w) * (c + 2.0 * w)).sqrt();
            let fastest = 0.5 * (c + spread);
            let creep = w2 / fastest;
            (creep, ((dx + creep * x) / spread).abs(), fastest)
        } else {
            (0.0, (x * x + dx * dx / w2).sqrt(), w)
        };
        Rest { lag: [x, dx], creep, quick: [size, fastest * size] }
    }
}

impl PeakFinder<'_> {
    /// Notes which modes have settled at the start of a piece, at which the first two of the vectors `pieces` have the motion;
    /// returns the fastest rate of what still moves, 1/s.
    pub(super) fn find_settled(
        &self,
        flight: &Stretch,
        piece: Piece,
        suspects: &[Suspect],
        work: &mut PeakWork,
    ) -> f64 {
        let moving = self.system.structure.in_flight();
        let body = &self.watched.in_flight().bodies[self.body_of(&suspects[0])];
        let modes = body.modes.clone();
        if !moving.is_classical() {
            return moving.fastest;
        }
        self.set_load(flight, piece.from, work);
        let PeakRoom { pieces: [q, v, left_q, left_v], load, creeps, .. } = &mut *work.peaks;
        for m in modes.clone() {
            let is_quick = !cfg!(without = "settled") && fastest_of(moving, m) * (piece.to - piece.from) > LEAF_ANGLE;
            let Rest { creep, quick, .. } = Rest::of(moving, m, (q[m], v[m]), (load[m], flight.loads.slope[m]));
            ([left_q[m], left_v[m]], creeps[m]) = (quick, if is_quick { creep } else { f64::NAN });
        }
        let [q, v, left_q, left_v] = [q, v, left_q, left_v].map(|vector| &vector[modes.clone()]);
        for block in &body.blocks {
            unsettle(block, [q, v], [left_q, left_v], &mut creeps[modes.clone()]);
        }
        modes.fold(0.0, |most: f64, m| most.max(if creeps[m].is_nan() { fastest_of(moving, m) } else { creeps[m] }))
    }

    /// Replaces the series of the modes that have settled, by the motion and the load at its start.
    pub(super) fn expand_settled(&self, modes: Range<usize>, slopes: &[f64], work: &mut PeakWork) {
        let PeakRoom { pieces: [q, v, ..], load, creeps, .. } = &*work.peaks;
        let series = &mut work.buffers.series;
        let scale = series.scale;
        for m in modes.filter(|m| !creeps[*m].is_nan()) {
            let moving = self.system.structure.in_flight();
            let Rest { lag: [x, _], .. } = Rest::of(moving, m, (q[m], v[m]), (load[m], slopes[m]));
            let (rate, creep) = (slopes[m] / moving.omega2[m], -creeps[m] * scale);
            let mut left = x;
            series.set_terms_of(
                m,
                (0..).map(|n| match n {
                    0 => q[m],
                    _ => {
                        left *= creep / f64::from(n);
                        left + if n == 1 { rate * scale } else { 0.0 }
                    }
                }),
            );
        }
    }
}

/// The faster one of w and c of a mode, 1/s.
fn fastest_of(structure: &Structure, m: usize) -> f64 {
    structure.omega2[m].sqrt().max(structure.damping[m])
}

/// Notes the modes as moving of which more than rounding is left in a quantity of a block.
fn unsettle(block: &RowBlock, [q, v]: [&[f64]; 2], [left_q, left_v]: [&[f64]; 2], creeps: &mut [f64]) {
    let of = |m: usize, [q, v]: [&[f64]; 2]| -> Lane {
        let on_v = block.on_v.get(m).unwrap_or(&[0.0; LANES]);
        std::array::from_fn(|i| (block.on_q[m][i] * q[m]).abs() + (on_v[i] * v[m]).abs())
    };
    let mut whole = [0.0; LANES];
    for m in 0..q.len() {
        let term = of(m, [q, v]);
        (0..LANES).for_each(|i| whole[i] += term[i]);
    }
    for (m, creep) in creeps.iter_mut().enumerate() {
        let left = of(m, [left_q, left_v]);
        // Written so that a NaN never counts as settled.
        if !(0..LANES).all(|i| left[i] <= ROUNDING * whole[i]) {
            *creep = f64::NAN;
        }
    }
}
