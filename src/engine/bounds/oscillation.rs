//! Oscillation about the quasi-static displacement, for however long a flight is.
//!
//! Under a load that is linear in time each mode oscillates about its quasi-static displacement s,
//!
//! ```text
//! q = s + h,   s = load / w^2 - c slope / w^4,   h'' + c h' + w^2 h = 0
//! ```
//!
//! and the envelope R = sqrt(h^2 + (h' / w)^2) never grows. Hence the quantity of a row exceeds the one by s alone,
//! which is largest at one of the ends, at most by the sum over modes of |row| R; with a row A over q and one B over q' by
//! that of (|A| + w |B|) R. So a motion that has died out needs
//! no further tests, nor does one that oscillates for ever without reaching a limit.

use crate::engine::quantities::flight_row::FlightRow;
use crate::structure::{Body, LinearLoad, Motion, Structure};

/// Margin for rounding, relative to the terms of a quantity.
const MARGIN: f64 = 1e-10;

/// A modal motion from which a flight begins, under a load that is linear in time.
pub struct Oscillation<'a> {
    structure: &'a Structure,
    motion: Motion<'a>,
    loads: LinearLoad<'a>,
    /// Length of the flight, s.
    length: f64,
}

impl<'a> Oscillation<'a> {
    /// From a motion on, under a load and its slope; `None` where damping couples modes and the load changes: then the
    /// quasi-static displacement is not worked out.
    pub fn of(
        structure: &'a Structure,
        motion: Motion<'a>,
        loads: LinearLoad<'a>,
        length: f64,
    ) -> Option<Oscillation<'a>> {
        let is_known = structure.is_classical() || loads.slope.iter().all(|slope| *slope == 0.0);
        is_known.then_some(Oscillation { structure, motion, loads, length })
    }

    /// Of a mode: quasi-static displacement, its change over the flight, radius of the envelope about it.
    fn of_mode(&self, m: usize) -> [f64; 3] {
        let (Motion { q, v }, LinearLoad { load, slope }) = (self.motion, self.loads);
        let (w2, c) = (self.structure.omega2[m], self.structure.damping[m]);
        if w2 == 0.0 {
            return [0.0; 3];
        }
        let rate = slope[m] / w2;
        let quasi_static = load[m] / w2 - c * rate / w2;
        let (h, dh) = (q[m] - quasi_static, v[m] - rate);
        let radius = (h * h + dh * dh / w2).sqrt() + MARGIN * (quasi_static.abs() + q[m].abs());
        [quasi_static, rate * self.length, radius]
    }

    /// Whether `sign` times the quantity of a row stays below a limit, m.
    pub fn stays_below(&self, row: FlightRow, sign: f64, limit: f64) -> bool {
        let (mut start, mut change, mut swing, mut size) = (0.0, 0.0, 0.0, limit.abs());
        for body in &self.structure.bodies {
            let shared = (!self.structure.is_classical()).then(|| self.shared_energy(body));
            for m in body.range.clone() {
                let [quasi_static, change_of_mode, radius] = self.of_mode(m);
                let ([a, b], w2) = (row.entries(m), self.structure.omega2[m]);
                let radius = shared.map_or(radius, |energy| (energy / w2).sqrt());
                let by_rate = if b == 0.0 { 0.0 } else { b * self.loads.slope[m] / w2 };
                let followed = a * quasi_static + by_rate;
                start += followed;
                change += a * change_of_mode;
                swing += (a.abs() + b.abs() * w2.sqrt()) * radius;
                size += followed.abs() + (a * change_of_mode).abs();
            }
        }
        // Written so that a NaN never counts as below.
        (sign * start).max(sign * (start + change)) - limit + swing + MARGIN * size < 0.0
    }

    /// Sum of w^2 R^2 over the modes of a body in which damping couples them, and which exchange energy: any may get all of it.
    fn shared_energy(&self, body: &Body) -> f64 {
        let energy = |m: usize| {
            let [.., radius] = self.of_mode(m);
            self.structure.omega2[m] * radius * radius
        };
        body.range.clone().map(energy).sum()
    }
}
