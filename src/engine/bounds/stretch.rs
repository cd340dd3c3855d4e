//! An exact motion between two times, and bounds on its modes in between.

use crate::engine::bounds::amplitude::share;
use crate::numerics::polynomial::larger;
use crate::structure::{LinearGround, LinearLoad, Motion, Structure};
use std::ops::Range;

/// Margin for rounding, relative to the terms of an amplitude.
pub const MARGIN: f64 = 1e-12;

/// A flight of all buildings, or a part of one.
pub struct Stretch<'a> {
    /// q and v of all modes at the start.
    pub start: Motion<'a>,
    /// q and v of all modes at the end.
    pub end: Motion<'a>,
    /// The modal load at the start and its rate, per second.
    pub loads: LinearLoad<'a>,
    /// The watched quantities at rest, which those of the motion are added to.
    pub rest: &'a [f64],
    /// Ground acceleration at the start, m/s2, and its slope, m/s3.
    pub ground: LinearGround,
    /// Length, s.
    pub length: f64,
    /// Whether a peak may well be exceeded in it, as other bounds have shown, so that those by amplitudes are left out.
    pub is_suspect: bool,
    /// The whole flight, of which this is the first part; `None` if it is whole itself.
    pub whole: Option<&'a Stretch<'a>>,
}

/// Bounds on each mode over a flight.
#[derive(Clone, Debug, Default)]
pub struct ModeBounds {
    /// Modal accelerations relative to the ground at the start.
    pub first: Vec<f64>,
    /// Modal accelerations relative to the ground at the end.
    pub last: Vec<f64>,
    /// Modal third derivatives at the start.
    jerk: Vec<f64>,
    /// E = sqrt(q'''^2 + w^2 q''^2), which never grows: a bound on |q'''|; and E / w, one on |q''|.
    pub energy: Vec<f64>,
    pub energy_over_w: Vec<f64>,
    /// Amplitude of each mode's oscillation about its quasi-static displacement, in q'.
    pub swing: Vec<f64>,
    /// The same amplitude in q.
    pub swing_q: Vec<f64>,
    /// Quasi-static displacements at the start and at the end.
    pub quasi_static: [Vec<f64>; 2],
    /// Rate of the quasi-static displacements.
    pub quasi_static_rate: Vec<f64>,
    /// Factors of |A| in the bound on a fourth derivative.
    pub fourth_on_q: Vec<f64>,
    /// Factors of |B| in the bound on a fourth derivative.
    pub fourth_on_v: Vec<f64>,
}

impl ModeBounds {
    pub fn new(lanes: usize) -> ModeBounds {
        let vector = || vec![0.0; lanes];
        ModeBounds {
            first: vector(),
            last: vector(),
            jerk: vector(),
            energy: vector(),
            energy_over_w: vector(),
            swing: vector(),
            swing_q: vector(),
            quasi_static: [vector(), vector()],
            quasi_static_rate: vector(),
            fourth_on_q: vector(),
            fourth_on_v: vector(),
        }
    }

    /// Works out bounds on a building's modes over a flight: on their derivatives, and on their oscillations.
    pub fn set(&mut self, structure: &Structure, modes: Range<usize>, flight: &Stretch) {
        self.set_accelerations(structure, modes.clone(), flight);
        let (v, slope) = (flight.start.v, flight.loads.slope);
        for m in modes.clone() {
            self.jerk[m] = slope[m] - structure.damping[m] * self.first[m] - structure.omega2[m] * v[m];
        }
        structure.subtract_coupling_of(&modes, &self.first, 1.0, &mut self.jerk);
        for m in modes.clone() {
            let (w2, acceleration, jerk) = (structure.omega2[m], self.first[m], self.jerk[m]);
            self.energy[m] = (jerk * jerk + w2 * acceleration * acceleration).sqrt();
        }
        let is_coupled = structure.couples(modes.start);
        if is_coupled {
            share(&mut self.energy[modes.clone()]);
        }
        for m in modes.clone() {
            let (w2, c) = (structure.omega2[m], structure.damping[m]);
            let (speed, change) = match is_coupled {
                true => (2.0 * structure.fastest, 3.0 * structure.fastest * structure.fastest),
                false => (structure.quickness[m], c * structure.quickness[m] + w2),
            };
            self.fourth_on_v[m] = change * self.energy[m];
            self.fourth_on_q[m] = speed * self.energy[m];
            self.energy_over_w[m] = self.energy[m] / w2.sqrt();
        }
        if !flight.is_suspect {
            self.set_swings(structure, modes, flight, is_coupled);
        }
    }

    /// Works out the accelerations of a building's modes at both ends of a flight.
    fn set_accelerations(&mut self, structure: &Structure, modes: Range<usize>, flight: &Stretch) {
        let (Motion { q, v }, end, LinearLoad { load, slope }) = (flight.start, flight.end, flight.loads);
        for m in modes.clone() {
            let (w2, c) = (structure.omega2[m], structure.damping[m]);
            self.first[m] = load[m] - c * v[m] - w2 * q[m];
            self.last[m] = load[m] + slope[m] * flight.length - c * end.v[m] - w2 * end.q[m];
        }
        structure.subtract_coupling_of(&modes, v, 1.0, &mut self.first);
        structure.subtract_coupling_of(&modes, end.v, 1.0, &mut self.last);
    }

    /// Works out bounds on the oscillation of a building's modes about their quasi-static displacements (see
    /// `envelope.rs`).
    fn set_swings(&mut self, structure: &Structure, modes: Range<usize>, flight: &Stretch, is_coupled: bool) {
        let (Motion { q, v }, LinearLoad { load, slope }) = (flight.start, flight.loads);
        // With coupled modes the quasi-static displacement under a changing load is not worked out: the whole load is
        // taken to increase the amplitude.
        let is_pushed = is_coupled && slope[modes.clone()].iter().any(|slope| *slope != 0.0);
        let [quasi_static, quasi_static_end] = &mut self.quasi_static;
        for m in modes.clone() {
            let (w2, c) = (structure.omega2[m], structure.damping[m]);
            let rate = if is_pushed { 0.0 } else { slope[m] / w2 };
            quasi_static[m] = if is_pushed { 0.0 } else { load[m] / w2 - c * rate / w2 };
            (self.quasi_static_rate[m], quasi_static_end[m]) = (rate, quasi_static[m] + rate * flight.length);
            let (h, dh) = (q[m] - quasi_static[m], v[m] - rate);
            self.swing[m] = (dh * dh + w2 * h * h).sqrt() + MARGIN * w2.sqrt() * (quasi_static[m].abs() + q[m].abs());
        }
        if is_coupled {
            share(&mut self.swing[modes.clone()]);
        }
        for m in modes {
            if is_pushed {
                let end = load[m] + slope[m] * flight.length;
                self.swing[m] += flight.length * larger(load[m].abs(), end.abs());
            }
            self.swing_q[m] = self.swing[m] / structure.omega2[m].sqrt();
        }
    }
}
