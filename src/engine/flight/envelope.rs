//! Proof by the envelopes of the modal oscillations that no pair meets and no storey yields in a flight, however long it
//! is.
//!
//! Under a load that is linear in time each mode oscillates about its quasi-static displacement s,
//!
//! ```text
//! q = s + h,   s = load / w^2 - c slope / w^4,   h'' + c h' + w^2 h = 0
//! ```
//!
//! and the envelope R = sqrt(h^2 + (h' / w)^2) never grows. Hence a penetration exceeds the one by s alone, which is
//! largest at one of the ends, at most by the sum over modes of |row| R. So a motion that has died out needs no further
//! tests, nor does one that oscillates for ever without reaching the other floor.

use crate::engine::base::Base;
use crate::engine::base::storey::Sense;
use crate::engine::system::System;
use crate::structure::Side;

/// Margin for rounding, relative to the terms of a penetration.
const MARGIN: f64 = 1e-10;

impl System {
    /// Whether no pair meets and no storey yields within `length` seconds from a modal motion on, under a load and its
    /// slope. Gaps and limits are those of the base.
    pub fn envelopes_stay_apart(
        &self,
        base: &Base,
        (q, v): (&[f64], &[f64]),
        (load, slope): (&[f64], &[f64]),
        length: f64,
    ) -> bool {
        let structure = &self.structure;
        // With coupled modes the quasi-static displacement under a changing load is not worked out here.
        if cfg!(without = "envelopes") || !structure.is_classical() && slope.iter().any(|slope| *slope != 0.0) {
            return false;
        }
        let of_mode = |m: usize| {
            let (w2, c) = (structure.omega2[m], structure.damping[m]);
            if w2 == 0.0 {
                return [0.0; 3];
            }
            let drift = slope[m] / w2;
            let held = load[m] / w2 - c * drift / w2;
            let (h, rate) = (q[m] - held, v[m] - drift);
            [held, drift * length, (h * h + rate * rate / w2).sqrt() + MARGIN * (held.abs() + q[m].abs())]
        };
        // Whether `sign` times a row stays below a limit.
        let stays_below = |row: &[f64], sign: f64, limit: f64| {
            let (mut start, mut change, mut swing, mut size) = (0.0, 0.0, 0.0, limit.abs());
            for side in [Side::Left, Side::Right] {
                for m in structure.range(side) {
                    let [held, drift, radius] = of_mode(m);
                    let reach = if structure.is_classical() { radius } else { self.shared_radius(side, &of_mode, m) };
                    start += row[m] * held;
                    change += row[m] * drift;
                    swing += row[m].abs() * reach;
                    size += (row[m] * held).abs() + (row[m] * drift).abs();
                }
            }
            // Written so that a NaN never counts as below.
            (sign * start).max(sign * (start + change)) - limit + swing + MARGIN * size < 0.0
        };
        let mut pairs = self.pairs.iter().zip(&base.rest.gaps);
        let mut storeys = self.storeys.iter().zip(&base.storeys);
        pairs.all(|(pair, gap)| stays_below(&pair.row, 1.0, *gap))
            && storeys.all(|(of, storey)| {
                Sense::BOTH.into_iter().all(|sense| {
                    let sign = sense.sign();
                    stays_below(&of.row, sign, of.limit + sign * of.ratio * storey.plastic)
                })
            })
    }

    /// Envelope radius of a mode: its own, or that of all modes if damping couples them, since they exchange energy.
    fn shared_radius(&self, side: Side, of_mode: &impl Fn(usize) -> [f64; 3], mode: usize) -> f64 {
        let w2 = &self.structure.omega2;
        let energy: f64 = self.structure.range(side).map(|m| w2[m] * of_mode(m)[2] * of_mode(m)[2]).sum();
        (energy / w2[mode]).sqrt()
    }
}
